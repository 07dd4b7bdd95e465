// SPDX-License-Identifier: MIT
//
// Indirect operations on acceleration structures whose arguments no application means: counts,
// strides and addresses in GPU memory that are mostly right, and often wrong in one place. Whatever
// they are, every call ends, the device goes on, and nothing is written but results.
#pragma once

#include <rtapi/rtapi.h>
#include <rtapi/rtas_operations.h>

#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace kaamos::test {

class OperationsFuzzer {
 public:
  // What it does depends on the backend and the seed alone.
  OperationsFuzzer(const std::string& backend, bool checked, uint64_t seed);

  // One call with a few operations. Returns what went wrong; "": nothing.
  std::string round();
  // Traces rays through a top level of what there is, and through a partitioned one. Returns what
  // went wrong.
  std::string look();
  uint64_t hits() const { return hits_; }        // of the rays of look()
  uint64_t refused() const { return refused_; }  // calls that never executed
  uint64_t notes() const { return notes_; }      // warnings about arguments

 private:
  // The desc and the memory of one operation, of whatever type.
  struct Operation {
    rtapi::RtasClusterTrianglesInputsDesc triangles;
    rtapi::RtasClusterTemplateTrianglesInputsDesc templates;
    rtapi::RtasInstantiateClusterTemplateInputsDesc instances;
    rtapi::RtasClasInputsDesc levels;
    rtapi::RtasClusterMovesDesc moves;
    rtapi::RtasPartitionedTlasInputsDesc partitioned;
    rtapi::RtasOperationInputs inputs;
    rtapi::RtasBatchedOperationData batch;
    rtapi::RtasPartitionedTlasOperationData partitioned_data;
    rtapi::RtasOperationDesc desc;
  };

  uint64_t below(uint64_t n) { return random_() % n; }
  bool rarely() { return below(16) == 0; }
  template <class T>
  T one_of(std::initializer_list<T> all) {
    return *(all.begin() + below(all.size()));
  }
  // `usual`, or now and then any number of the type.
  template <class T>
  T mostly(T usual) {
    return rarely() ? static_cast<T>(random_() >> below(64)) : usual;
  }

  // A copy in GPU memory, at times so near the end of the buffer that less than all of it is
  // inside.
  template <class T>
  uint64_t put(const std::vector<T>& elements) {
    return put(elements.data(), elements.size() * sizeof(T));
  }
  uint64_t put(const void* bytes, size_t count);
  uint64_t wild_address();
  uint64_t readable(uint64_t usual);  // `usual` or a wild address
  uint64_t target();                  // where 64-bit results may be written
  uint64_t structure();               // where a structure is, or may be
  uint64_t place();                   // where one may go
  uint64_t partitioned_place();       // where a partitioned top level may go
  void resolve(uint64_t& address, rtapi::RtasOperationAddressResolutionFlags flag,
               Operation& operation);

  void build_micromaps();
  void fill_data();
  rtapi::RtasClusterLimits limits();
  rtapi::RtasOperationFlags flags();
  rtapi::RtasOperationMode mode();
  rtapi::RtasVertexFormat vertex_format();
  rtapi::RtasIndexFormat index_format(bool may_be_none);
  rtapi::RtasBuildClasFromTrianglesArgs triangles();
  void make_triangles(Operation& operation);
  void make_templates(Operation& operation);
  void make_instances(Operation& operation);
  void make_levels(Operation& operation);
  void make_moves(Operation& operation);
  void make_partitioned(Operation& operation);
  template <class Args>
  void make_batch(Operation& operation, rtapi::RtasOperationMode mode,
                  const std::vector<Args>& args);
  rtapi::RtasPartitionedTlasOperation partitioned_operation(
      const rtapi::RtasPartitionedTlasInputsDesc& inputs);
  rtapi::RtasPartitionedTlasWriteInstanceArgs write(
      const rtapi::RtasPartitionedTlasInputsDesc& inputs);
  void make(Operation& operation);
  void trace(rtapi::CommandList& list, uint64_t top_level);
  std::string execute(rtapi::CommandList& list);

  std::mt19937_64 random_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::RootSignature root_signature_;
  rtapi::PipelineState pipeline_;
  rtapi::Buffer data_, structures_, results_, scratch_, hits_buffer_, readback_, top_, top_scratch_,
      micromaps_;
  std::byte* host_ = nullptr;    // of data_
  size_t used_ = 0;              // bytes of arguments, from kArguments on
  size_t slots_ = 0;             // addresses that are read from GPU memory so far
  std::vector<uint64_t> known_;  // where structures may be
  uint64_t hits_ = 0;
  uint64_t refused_ = 0;
  uint64_t notes_ = 0;
};

}  // namespace kaamos::test

// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: clusters and bottom levels of them step by step, for the rules about them.
#pragma once

#include <string>
#include <vector>

#include "tests/conformance/ptl.h"
#include "tests/conformance/structures.h"

namespace kaamos::conformance::cls {

using namespace rtapi;

using Own = ptl::Partitioned;  // a context of a device that has operations
using ClusterArgs = RtasBuildClasFromTrianglesArgs;
using LevelArgs = RtasBuildBlasFromClasArgs;
using TrianglesDesc = RtasClusterTrianglesInputsDesc;
using Type = RtasOperationType;
using Mode = RtasOperationMode;
using Flags = RtasOperationFlags;

RtasOperationInputs inputs_of(const TrianglesDesc& desc);
RtasOperationInputs inputs_of(const RtasClasInputsDesc& desc);
RtasOperationInputs inputs_of(const RtasClusterTemplateTrianglesInputsDesc& desc);
RtasOperationInputs inputs_of(const RtasInstantiateClusterTemplateInputsDesc& desc);
RtasOperationInputs inputs_of(const RtasClusterMovesDesc& desc);

// Room for `count` clusters of every size.
TrianglesDesc triangles_desc(uint32_t count = 8, Flags flags = Flags::kNone);
RtasClasInputsDesc level_desc(uint32_t count = 4, uint32_t clusters = 64);

// An operation with many arguments and all its memory: arrays of `room` results, which hold
// kUntouched.
inline constexpr uint64_t kUntouched = 0x7777777777777777;
struct Batch {
  RtasBatchedOperationData data = {};
  Buffer memory = {};     // of results
  Buffer addresses = {};  // of results
  Buffer sizes = {};      // of results
};
Batch batch_of(Context& t, const RtasOperationInputs& inputs, const Buffer& arguments,
               uint32_t room = 16);
void add_operation(CommandList& list, const RtasOperationInputs& inputs, const Batch& batch);
Status run(Context& t, const RtasOperationInputs& inputs, const Batch& batch);
std::vector<uint64_t> addresses_in(Context& t, const Batch& batch);
std::vector<uint64_t> sizes_in(Context& t, const Batch& batch);

// Runs one operation with implicit destinations, and returns the addresses of its results.
template <class Desc, class Args>
std::vector<uint64_t> build(Context& t, const Desc& desc, const std::vector<Args>& args) {
  const auto count = static_cast<uint32_t>(args.size());
  const Buffer arguments = t.upload(args);
  const Batch batch = batch_of(t, inputs_of(desc), arguments, count);
  Batch counted = batch;
  counted.data.IndirectArgumentArraySize =
      t.upload(std::vector<uint32_t>{count}).GetGPUVirtualAddress();
  t.accepted("a build", run(t, inputs_of(desc), counted));
  auto addresses = addresses_in(t, batch);
  addresses.resize(count);
  return addresses;
}

// Float vertices and 8-bit indices, in buffers of their own; opaque triangles.
ClusterArgs cluster(Context& t, const std::vector<float>& vertices,
                    const std::vector<uint8_t>& indices);
// The triangles of a geometry of the context, with its flags.
ClusterArgs cluster(Context& t, const Geometry& geometry, uint32_t geometry_index = 0,
                    uint32_t cluster_id = 0);

// The address of a bottom level of clusters at these addresses.
uint64_t level_of(Context& t, const std::vector<uint64_t>& clusters);
// Of clusters that are built for it.
uint64_t level_from(Context& t, const std::vector<ClusterArgs>& clusters,
                    Flags flags = Flags::kNone);
RaytracingInstanceDesc instance_of(uint64_t level);
Buffer top_of(Context& t, uint64_t level);

// What rays along z see of a top level at each x.
std::vector<Seen> look(Context& t, const Buffer& top, const std::vector<float>& places);
// t of the first hit; -1: a miss.
std::vector<float> depths_at(Context& t, const Buffer& top, const std::vector<float>& places);

// The tests of cls_tests that are about templates and moves.
std::vector<RuleTest> template_tests();
// The tests of cls_tests that are about opacity micromaps.
std::vector<RuleTest> micromap_tests();
// The tests of cls_tests that are about copies, also of partitioned top levels.
std::vector<RuleTest> copy_tests();
// The tests of cls_tests that are about arguments and results in GPU memory.
std::vector<RuleTest> memory_tests();

}  // namespace kaamos::conformance::cls

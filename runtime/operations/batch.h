// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Operations with many arguments, each of which makes one object: where the arguments
// and results are, and where the objects go. [DXR 2.0: D3D12_RTAS_BATCHED_OPERATION_DATA]
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <rtapi/result.h>
#include <rtapi/rtas_operations.h>

#include "runtime/backend/commands.h"
#include "runtime/operations/notes.h"
#include "runtime/operations/operation_sizes.h"
#include "runtime/structures/structure_commands.h"

namespace kaamos::runtime {

// What an argument makes.
struct BatchObject {
  uint64_t bytes = 0;                   // 0: the argument is left out
  AccelerationStructure structure;      // not with kGetSizes; without a place
  uint64_t moved_from = 0;              // moves: the source's address
  std::vector<uint64_t> clusters = {};  // bottom levels: the addresses of their clusters
};

// An array in GPU memory whose extent was checked.
struct ArrayInMemory {
  uint8_t* first = nullptr;  // null: there is none
  uint64_t stride = 0;

  uint8_t* at(uint64_t index) const { return first + index * stride; }
  // From the first to the end of the last of `count` elements.
  uint64_t bytes(uint64_t count, uint64_t element_bytes) const {
    return first == nullptr || count == 0 ? 0 : (count - 1) * stride + element_bytes;
  }
};
// Reads an element that is `bytes` large.
template <class T>
T load_element(const ArrayInMemory& array, uint64_t index) {
  T value;
  std::memcpy(&value, array.at(index), sizeof(T));
  return value;
}

// The array of `count` elements, or null with the reason in `why`.
ArrayInMemory find_array(const AddressMap& addresses, uint64_t address, uint64_t stride,
                         uint64_t count, uint64_t element_bytes, uint64_t alignment,
                         std::string& why);

class Batch {
 public:
  Batch(const StructureEnvironment& environment, const rtapi::RtasBatchedOperationData& data,
        const BatchFacts& facts, OperationNotes& notes)
      : environment_(environment),
        addresses_(*environment.context.addresses),
        data_(data),
        facts_(facts),
        notes_(notes) {}

  // Finds arguments and results. False: the operation is left out.
  bool open();
  uint32_t count() const { return count_; }
  bool only_sizes() const { return facts_.mode == rtapi::RtasOperationMode::kGetSizes; }
  template <class Args>
  Args read(uint32_t index) const {
    return load_element<Args>(arguments_, index);
  }
  // Places the objects, by argument, and writes addresses and sizes. `results` gets what was
  // placed.
  void finish(std::vector<BatchObject> objects, std::vector<RtasResult>& results);

 private:
  using Resolution = rtapi::RtasOperationAddressResolutionFlags;
  bool resolve(uint64_t& address, Resolution flag, const char* what);
  bool resolve_all();
  bool read_count();
  bool find_results();
  // Where the object goes; 0: nowhere.
  uint64_t destination(uint32_t index, uint64_t bytes);
  uint64_t implicit_destination(uint32_t index, uint64_t bytes);
  uint64_t explicit_destination(uint32_t index, uint64_t bytes);
  void note_overlaps(std::vector<RtasResult> placed);
  void write_tools_info(const std::vector<uint64_t>& sizes, const std::vector<uint64_t>& at);

  const StructureEnvironment& environment_;
  const AddressMap& addresses_;
  rtapi::RtasBatchedOperationData data_;
  BatchFacts facts_;
  OperationNotes& notes_;
  uint32_t count_ = 0;
  ArrayInMemory arguments_;
  ArrayInMemory result_addresses_;
  ArrayInMemory result_sizes_;
  uint64_t next_ = 0;  // kImplicitDestinations: the first free byte
};

}  // namespace kaamos::runtime

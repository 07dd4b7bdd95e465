// SPDX-License-Identifier: MIT
#include "runtime/operations/batch.h"

#include <algorithm>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/structures/cluster.h"

namespace kaamos::runtime {

using rtapi::HasAny;
using Mode = rtapi::RtasOperationMode;

ArrayInMemory find_array(const AddressMap& addresses, uint64_t address, uint64_t stride,
                         uint64_t count, uint64_t element_bytes, uint64_t alignment,
                         std::string& why) {
  if (stride == 0) stride = element_bytes;
  if (count == 0) return {};
  if (address % alignment != 0 || stride % alignment != 0) {
    why = at_address(addresses, address) + " with stride " + std::to_string(stride) +
          "; address and stride must be multiples of " + std::to_string(alignment);
    return {};
  }
  const uint64_t available = addresses.bytes_from(address);
  const bool fits = available >= element_bytes && (available - element_bytes) / stride >= count - 1;
  if (fits) return {addresses.host(address), stride};
  why = at_address(addresses, address) + " are " + std::to_string(count) + " with stride " +
        std::to_string(stride) + ", but the buffer has " + std::to_string(available) +
        " bytes from there on";
  return {};
}

bool Batch::resolve(uint64_t& address, Resolution flag, const char* what) {
  if (!HasAny(data_.AddressResolutionFlags, flag)) return true;
  std::string why;
  const ArrayInMemory found = find_array(addresses_, address, 0, 1, 8, 8, why);
  if (found.first == nullptr) {
    notes_.add(std::string("the address of ") + what + " " + why +
               ", so the operation is left out");
    return false;
  }
  address = load_element<uint64_t>(found, 0);
  return true;
}

bool Batch::resolve_all() {
  const bool counted = data_.IndirectArgumentArraySize != 0;
  return resolve(data_.BatchResultData, Resolution::kIndirectedBatchResult, "the results") &&
         resolve(data_.ResultAddressArray.StartAddress,
                 Resolution::kIndirectedDestinationAddressArray, "ResultAddressArray") &&
         resolve(data_.ResultSizeArray.StartAddress, Resolution::kIndirectedResultSizeArray,
                 "ResultSizeArray") &&
         resolve(data_.IndirectArgumentArray.StartAddress,
                 Resolution::kIndirectedIndirectArgumentArray, "arguments") &&
         (!counted || resolve(data_.IndirectArgumentArraySize,
                              Resolution::kIndirectedIndirectArgumentCount, "the count"));
}

bool Batch::read_count() {
  count_ = facts_.max_args;
  if (data_.IndirectArgumentArraySize == 0) return true;
  std::string why;
  const ArrayInMemory found =
      find_array(addresses_, data_.IndirectArgumentArraySize, 0, 1, 4, 4, why);
  if (found.first == nullptr) {
    notes_.add("the number of arguments " + why + ", so the operation is left out");
    return false;
  }
  notes_.reads(data_.IndirectArgumentArraySize, 4, "number of arguments");
  count_ = std::min(count_, load_element<uint32_t>(found, 0));
  return true;
}

bool Batch::find_results() {
  const auto find = [&](const rtapi::GpuVirtualAddressAndStride& array, const char* what,
                        ArrayInMemory& out) {
    std::string why;
    out = find_array(addresses_, array.StartAddress, array.StrideInBytes, count_, 8, 8, why);
    if (out.first != nullptr || count_ == 0) return true;
    notes_.add(std::string(what) + " " + why + "; the operation is left out");
    return false;
  };
  const bool needs_addresses = facts_.mode == Mode::kExplicitDestinations;
  if (facts_.mode != Mode::kGetSizes &&
      (needs_addresses || data_.ResultAddressArray.StartAddress != 0) &&
      !find(data_.ResultAddressArray, "ResultAddressArray", result_addresses_)) {
    return false;
  }
  if (!only_sizes() && data_.ResultSizeArray.StartAddress == 0) return true;
  return find(data_.ResultSizeArray, "ResultSizeArray", result_sizes_);
}

bool Batch::open() {
  if (!resolve_all() || !read_count()) return false;
  std::string why;
  arguments_ =
      find_array(addresses_, data_.IndirectArgumentArray.StartAddress,
                 data_.IndirectArgumentArray.StrideInBytes, count_, facts_.arg_bytes, 8, why);
  if (arguments_.first == nullptr && count_ != 0) {
    notes_.add("the arguments " + why + "; they are left out");
    return false;
  }
  notes_.reads(data_.IndirectArgumentArray.StartAddress, arguments_.bytes(count_, facts_.arg_bytes),
               "the arguments");
  if (!find_results()) return false;
  next_ = data_.BatchResultData;
  if (facts_.mode != Mode::kImplicitDestinations || next_ % facts_.alignment == 0) return true;
  notes_.add("the results are to go " + at_address(addresses_, next_) +
             "; the address must be a multiple of " + std::to_string(facts_.alignment) +
             ", so the operation is left out");
  return false;
}

uint64_t Batch::implicit_destination(uint32_t index, uint64_t bytes) {
  const auto allocation = addresses_.find(next_);
  const uint64_t used = next_ - data_.BatchResultData;
  const bool fits = allocation && allocation->acceleration_structure && used <= facts_.all_bytes &&
                    bytes <= facts_.all_bytes - used && addresses_.contains(next_, bytes);
  if (fits) {
    const uint64_t address = next_;
    next_ += bytes;
    return address;
  }
  notes_.add_about(index, "its result takes " + std::to_string(bytes) +
                              " bytes, which do not fit what is left of the " +
                              std::to_string(facts_.all_bytes) + " bytes for results " +
                              at_address(addresses_, data_.BatchResultData) + "; it is left out");
  return 0;
}

uint64_t Batch::explicit_destination(uint32_t index, uint64_t bytes) {
  const auto address = load_element<uint64_t>(result_addresses_, index);
  const auto leave_out = [&](const std::string& why) {
    notes_.add_about(
        index, "its result is to go " + at_address(addresses_, address) + why + "; it is left out");
    return uint64_t{0};
  };
  if (address % facts_.alignment != 0) {
    return leave_out(", which is not a multiple of " + std::to_string(facts_.alignment));
  }
  const auto allocation = addresses_.find(address);
  if (!allocation || !allocation->acceleration_structure) {
    return leave_out(", where no buffer for acceleration structures is");
  }
  if (!addresses_.contains(address, bytes)) {
    return leave_out(", where there are " + std::to_string(addresses_.bytes_from(address)) +
                     " bytes, but it takes " + std::to_string(bytes));
  }
  return address;
}

uint64_t Batch::destination(uint32_t index, uint64_t bytes) {
  return facts_.mode == Mode::kExplicitDestinations ? explicit_destination(index, bytes)
                                                    : implicit_destination(index, bytes);
}

void Batch::note_overlaps(std::vector<RtasResult> placed) {
  const auto by_address = [](const auto& a, const auto& b) { return a.address < b.address; };
  std::sort(placed.begin(), placed.end(), by_address);
  for (size_t i = 1; i < placed.size(); ++i) {
    const RtasResult& before = placed[i - 1];
    if (placed[i].address - before.address >= before.size_bytes) continue;
    notes_.add("two results overlap: " + std::to_string(before.size_bytes) + " bytes " +
               at_address(addresses_, before.address) + " and one " +
               at_address(addresses_, placed[i].address) + "; the later one counts");
  }
}

void Batch::write_tools_info(const std::vector<uint64_t>& sizes, const std::vector<uint64_t>& at) {
  if (data_.ToolsInfo == 0) return;
  std::vector<uint64_t> words = {count_};
  words.insert(words.end(), sizes.begin(), sizes.end());
  if (!only_sizes()) words.insert(words.end(), at.begin(), at.end());
  if (!addresses_.contains(data_.ToolsInfo, words.size() * 8)) {
    return notes_.add("ToolsInfo " + at_address(addresses_, data_.ToolsInfo) + " needs " +
                      std::to_string(words.size() * 8) + " bytes; it is not written");
  }
  std::memcpy(addresses_.host(data_.ToolsInfo), words.data(), words.size() * 8);
}

// The micromap array of a cluster or template, if it has one.
static std::vector<uint64_t> arrays_of(const AccelerationStructure& structure) {
  const Cluster* cluster = structure.cluster.get();
  if (structure.cluster_template != nullptr) cluster = &structure.cluster_template->cluster;
  if (cluster == nullptr || cluster->linkage == nullptr) return {};
  return {cluster->linkage->address};
}

void Batch::finish(std::vector<BatchObject> objects, std::vector<RtasResult>& results) {
  std::vector<uint64_t> sizes(count_);
  std::vector<uint64_t> at(count_);
  std::vector<RtasResult> placed;
  for (uint32_t i = 0; i < count_; ++i) {
    sizes[i] = objects[i].bytes;
    if (only_sizes() || sizes[i] == 0) continue;
    at[i] = destination(i, sizes[i]);
    if (at[i] == 0) {
      sizes[i] = 0;
      continue;
    }
    const bool is_level = objects[i].structure.of_clusters;
    placed.push_back({at[i], sizes[i], objects[i].moved_from, is_level, objects[i].structure.flags,
                      std::move(objects[i].clusters), arrays_of(objects[i].structure)});
    notes_.writes(at[i], sizes[i], "result");
    AccelerationStructure& structure = objects[i].structure;
    structure.address = at[i];
    structure.host = addresses_.host(at[i]);
    structure.size_bytes = sizes[i];
    structure.compacted_bytes = sizes[i];
    environment_.structures.place(std::move(structure));
  }
  if (facts_.mode == Mode::kExplicitDestinations) note_overlaps(placed);
  for (uint32_t i = 0; i < count_; ++i) {
    if (result_sizes_.first != nullptr) std::memcpy(result_sizes_.at(i), &sizes[i], 8);
    const bool writes =
        result_addresses_.first != nullptr && facts_.mode == Mode::kImplicitDestinations;
    if (writes) std::memcpy(result_addresses_.at(i), &at[i], 8);
  }
  if (count_ != 0) {
    const bool implicit = facts_.mode == Mode::kImplicitDestinations;
    const uint64_t addresses = result_addresses_.bytes(count_, 8);
    if (implicit) {
      notes_.writes(data_.ResultAddressArray.StartAddress, addresses, "result addresses");
    } else {
      notes_.reads(data_.ResultAddressArray.StartAddress, addresses, "result addresses");
    }
    notes_.writes(data_.ResultSizeArray.StartAddress, result_sizes_.bytes(count_, 8),
                  "result sizes");
  }
  write_tools_info(sizes, at);
  results.insert(results.end(), placed.begin(), placed.end());
}

}  // namespace kaamos::runtime

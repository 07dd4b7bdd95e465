// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: indirect operations. What their arguments say is known once they have run.
#include <algorithm>
#include <set>
#include <utility>
#include <variant>

#include "runtime/checks/layer.h"
#include "runtime/checks/names.h"
#include "runtime/operations/operation_sizes.h"

namespace kaamos::checks {

using rtapi::HasAny;
using rtapi::ResourceStates;
using runtime::RtasAccess;

namespace {

bool before(const RtasAccess& a, const RtasAccess& b) {
  return a.address < b.address;
}

// Those that read, or write, by address; what touches is put together.
std::vector<RtasAccess> merged(std::span<const RtasAccess> accesses, bool written) {
  std::vector<RtasAccess> sorted;
  for (const RtasAccess& access : accesses) {
    if (access.written == written) sorted.push_back(access);
  }
  std::stable_sort(sorted.begin(), sorted.end(), before);
  std::vector<RtasAccess> out;
  for (const RtasAccess& access : sorted) {
    const uint64_t end = access.address + access.size_bytes;
    const bool joins = !out.empty() && out.back().operation == access.operation &&
                       out.back().what == access.what &&
                       access.address - out.back().address <= out.back().size_bytes;
    if (!joins) {
      out.push_back(access);
    } else {
      out.back().size_bytes = std::max(out.back().size_bytes, end - out.back().address);
    }
  }
  return out;
}

// What an operation of the call writes there, another one's before its own; null: nothing.
const RtasAccess* writer_of(const RtasAccess& read, const std::vector<RtasAccess>& writes) {
  const uint64_t end = read.address + read.size_bytes;
  const RtasAccess* own = nullptr;
  for (const RtasAccess& write : writes) {
    if (write.address >= end) break;
    if (read.address >= write.address + write.size_bytes) continue;
    if (write.operation != read.operation) return &write;
    own = &write;
  }
  return own;
}

}  // namespace

// The operations' arguments are read, and reported, by what runs them.
void Layer::check(const runtime::RtasOperationsCommand& command) {
  for (const runtime::RtasOperation& operation : command.operations) {
    if (std::holds_alternative<rtapi::RtasPartitionedTlasInputsDesc>(operation.inputs)) {
      check_partitioned(operation);
    } else {
      check_batch(operation);
    }
  }
}

void Layer::check_partitioned(const runtime::RtasOperation& operation) {
  const rtapi::RtasPartitionedTlasOperationData& data = operation.partitioned;
  const auto sizes = runtime::operation_sizes(operation.inputs);
  hazards_.use(data.IndirectPartitionedTlasOpCount, ResourceStates::kNonPixelShaderResource,
               "the number of operations");
  if (data.IndirectPartitionedTlasOps != 0) {
    hazards_.use(data.IndirectPartitionedTlasOps, ResourceStates::kNonPixelShaderResource,
                 "the operations");
  }
  const uint64_t scratch = data.ScratchAccelerationStructureData;
  hazards_.use(scratch, ResourceStates::kUnorderedAccess, "the operation's scratch memory");
  hazards_.use_scratch(scratch, sizes.ScratchDataSizeInBytes);
}

void Layer::check_batch(const runtime::RtasOperation& operation) {
  using Resolution = rtapi::RtasOperationAddressResolutionFlags;
  const rtapi::RtasBatchedOperationData& data = operation.batch;
  const auto mode = runtime::facts_of(operation.inputs).mode;
  const auto sizes = runtime::operation_sizes(operation.inputs);
  const auto use = [&](uint64_t address, Resolution flag, ResourceStates state, const char* what) {
    const bool indirected = HasAny(data.AddressResolutionFlags, flag);
    if (address == 0) return;
    hazards_.use(address, indirected ? ResourceStates::kNonPixelShaderResource : state, what);
  };
  use(data.IndirectArgumentArray.StartAddress, Resolution::kIndirectedIndirectArgumentArray,
      ResourceStates::kNonPixelShaderResource, "the operation's arguments");
  use(data.IndirectArgumentArraySize, Resolution::kIndirectedIndirectArgumentCount,
      ResourceStates::kNonPixelShaderResource, "the number of arguments");
  use(data.ResultSizeArray.StartAddress, Resolution::kIndirectedResultSizeArray,
      ResourceStates::kUnorderedAccess, "the array of result sizes");
  const bool implicit = mode == rtapi::RtasOperationMode::kImplicitDestinations;
  if (mode != rtapi::RtasOperationMode::kGetSizes) {
    use(data.ResultAddressArray.StartAddress, Resolution::kIndirectedDestinationAddressArray,
        implicit ? ResourceStates::kUnorderedAccess : ResourceStates::kNonPixelShaderResource,
        "the array of result addresses");
  }
  if (!HasAny(data.AddressResolutionFlags, Resolution::kIndirectedBatchScratch)) {
    hazards_.use(data.BatchScratchData, ResourceStates::kUnorderedAccess,
                 "the operation's scratch memory");
    hazards_.use_scratch(data.BatchScratchData, sizes.ScratchDataSizeInBytes);
  }
}

// The operations of a call may run in any order, so none may use another's results.
// [DXR 2.0: ExecuteIndirectRTASOperations]
void Layer::note(const runtime::RtasOperationsCommand& command) {
  const auto writes = merged(command.results->accesses, true);
  std::set<std::pair<uint32_t, uint32_t>> told;
  for (const RtasAccess& read : merged(command.results->accesses, false)) {
    const std::string by = "operation " + std::to_string(read.operation);
    if (const RtasAccess* write = writer_of(read, writes)) {
      // In place: its write is held against what comes before.
      if (write->operation == read.operation ||
          !told.insert({read.operation, write->operation}).second) {
        continue;
      }
      reporter_.report(Id::kUavBarrierMissing,
                       by + " reads " + read.what + " at " +
                           address_name(addresses_, read.address) + ", where operation " +
                           std::to_string(write->operation) + " of the same call writes " +
                           write->what + ". Operations of a call may run in any order: record " +
                           "them in two calls with a UAV barrier between them.");
      continue;
    }
    const auto allocation = addresses_.find(read.address);
    if (allocation && allocation->acceleration_structure) {
      hazards_.read_structure(read.address, read.size_bytes, by + "'s " + read.what);
    } else {
      hazards_.use(read.address, ResourceStates::kNonPixelShaderResource, by + "'s " + read.what);
    }
  }
  for (const RtasAccess& write : writes) {
    const auto allocation = addresses_.find(write.address);
    if (!allocation || !allocation->acceleration_structure) continue;
    hazards_.write_structure(write.address, write.size_bytes,
                             "operation " + std::to_string(write.operation) + "'s " + write.what);
  }
  structures_.operated(command.results->placed);
}

}  // namespace kaamos::checks

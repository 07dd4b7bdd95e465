// SPDX-License-Identifier: MIT
#include "runtime/operations/operations.h"

#include <new>
#include <numeric>
#include <utility>
#include <variant>
#include <vector>

#include "runtime/operations/cluster_operations.h"
#include "runtime/operations/notes.h"
#include "runtime/operations/partitioned_top_level.h"

namespace kaamos::runtime {

namespace {

// Operations of a call may run in any order. Checked mode makes use of it, so that what depends on
// an order shows; the same for the same call of the same list, so that it can be found.
// [DXR 2.0: ExecuteIndirectRTASOperations]
std::vector<uint32_t> order_of(const StructureEnvironment& environment, size_t count,
                               const std::string& label) {
  std::vector<uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  if (environment.context.reporter == nullptr) return order;
  uint64_t seed = 0xCBF29CE484222325;
  for (const char c : label) seed = (seed ^ static_cast<uint8_t>(c)) * 0x100000001B3;
  for (size_t left = count; left > 1; --left) {
    seed = seed * 6364136223846793005 + 1442695040888963407;
    std::swap(order[left - 1], order[(seed >> 33) % left]);
  }
  return order;
}

}  // namespace

rtapi::Status execute_operations(const StructureEnvironment& environment,
                                 const RtasOperationsCommand& command, const std::string& label,
                                 const RebuildLevel& build) {
  *command.results = {};
  for (const uint32_t i : order_of(environment, command.operations.size(), label)) {
    const RtasOperation& operation = command.operations[i];
    const std::string where = label + ", operation " + std::to_string(i);
    OperationNotes notes(environment, where, *command.results, i);
    const bool partitioned =
        std::holds_alternative<rtapi::RtasPartitionedTlasInputsDesc>(operation.inputs);
    try {
      auto s = partitioned ? build_partitioned(environment, operation, notes, build,
                                               command.results->placed)
                           : run_cluster_operation(environment, operation, notes, build,
                                                   command.results->placed);
      if (!s) return s;
    } catch (const std::bad_alloc&) {
      return make_error(Id::kOutOfMemory, where + ": its results could not be allocated.");
    }
  }
  return {};
}

}  // namespace kaamos::runtime

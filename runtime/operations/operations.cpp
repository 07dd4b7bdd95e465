// SPDX-License-Identifier: MIT
#include "runtime/operations/operations.h"

#include <new>
#include <variant>

#include "runtime/operations/cluster_operations.h"
#include "runtime/operations/notes.h"
#include "runtime/operations/partitioned_top_level.h"

namespace kaamos::runtime {

rtapi::Status execute_operations(const StructureEnvironment& environment,
                                 const RtasOperationsCommand& command, const std::string& label,
                                 const RebuildLevel& build) {
  *command.results = {};
  for (uint32_t i = 0; i < command.operations.size(); ++i) {
    const RtasOperation& operation = command.operations[i];
    const std::string where = label + ", operation " + std::to_string(i);
    OperationNotes notes(environment, where, *command.results, i);
    const bool partitioned =
        std::holds_alternative<rtapi::RtasPartitionedTlasInputsDesc>(operation.inputs);
    try {
      auto s = partitioned ? build_partitioned(environment, operation, notes, build)
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

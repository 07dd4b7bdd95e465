// SPDX-License-Identifier: MIT
#include "runtime/operations/operations.h"

#include "runtime/operations/partitioned_top_level.h"

namespace kaamos::runtime {

rtapi::Status execute_operations(const StructureEnvironment& environment,
                                 const RtasOperationsCommand& command, const std::string& label,
                                 const RebuildLevel& build) {
  for (size_t i = 0; i < command.operations.size(); ++i) {
    const std::string where = label + ", operation " + std::to_string(i);
    if (auto s = build_partitioned(environment, command.operations[i], where, build); !s) {
      return s;
    }
  }
  return {};
}

}  // namespace kaamos::runtime

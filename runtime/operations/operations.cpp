// SPDX-License-Identifier: MIT
#include "runtime/operations/operations.h"

namespace kaamos::runtime {

rtapi::Status execute_operations(const StructureEnvironment& environment,
                                 const RtasOperationsCommand& command, const std::string& label,
                                 const BuildOperationLevels& build) {
  for (size_t i = 0; i < command.operations.size(); ++i) {
    const std::string where = label + ", operation " + std::to_string(i);
    if (auto s = build_partitioned(environment, command.operations[i], where, build.partitioned);
        !s) {
      return s;
    }
  }
  return {};
}

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Bottom levels of clusters. [DXR 2.0: BUILD_BLAS_FROM_CLAS]
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <rtapi/result.h>
#include <rtapi/rtas_operations.h>

#include "runtime/operations/notes.h"
#include "runtime/structures/clustered_level.h"
#include "runtime/structures/structure_commands.h"
#include "runtime/structures/structure_copies.h"

namespace kaamos::runtime {

// Builds the bottom levels of one operation.
class ClusterLevelBuilder {
 public:
  using Args = rtapi::RtasBuildBlasFromClasArgs;
  ClusterLevelBuilder(const StructureEnvironment& environment,
                      const rtapi::RtasClasInputsDesc& inputs, OperationNotes& notes)
      : environment_(environment), inputs_(inputs), notes_(notes) {}

  // False: the argument is left out.
  bool check_counts(const Args& args, uint32_t index);
  // `at` gets the clusters' addresses.
  bool read(const Args& args, uint32_t index, Clusters& clusters, std::vector<uint64_t>& at);
  // Builds the level into `result`. False: the argument is left out.
  rtapi::Result<bool> build(const Clusters& clusters, uint32_t index, const RebuildLevel& build,
                            AccelerationStructure& result);

 private:
  bool leave_out(uint32_t index, const std::string& why);
  void note(uint32_t index, const std::string& what);
  void check_clusters(const Clusters& clusters, uint32_t index);

  const StructureEnvironment& environment_;
  rtapi::RtasClasInputsDesc inputs_;
  OperationNotes& notes_;
  uint64_t total_ = 0;
  bool beyond_total_ = false;
};

}  // namespace kaamos::runtime

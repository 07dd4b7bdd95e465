// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Copies of clusters, templates and bottom levels of clusters.
// [DXR 2.0: D3D12_RTAS_CLUSTER_MOVES_DESC]
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <rtapi/rtas_operations.h>

#include "runtime/backend/commands.h"
#include "runtime/operations/notes.h"
#include "runtime/structures/structure_commands.h"

namespace kaamos::runtime {

// Finds what the arguments of one operation move.
class ClusterMover {
 public:
  using Args = rtapi::RtasMoveClusterObjectsArgs;
  ClusterMover(const StructureEnvironment& environment, const rtapi::RtasClusterMovesDesc& inputs,
               OperationNotes& notes)
      : environment_(environment), inputs_(inputs), notes_(notes) {}

  // Null: the argument is left out.
  std::shared_ptr<const AccelerationStructure> find(const Args& args, uint32_t index);

 private:
  const StructureEnvironment& environment_;
  rtapi::RtasClusterMovesDesc inputs_;
  OperationNotes& notes_;
  uint64_t total_bytes_ = 0;
};

// Notes sources that results overlap although kNoOverlap says that there are none.
void note_overlapping_moves(const rtapi::RtasClusterMovesDesc& inputs,
                            const std::vector<RtasResult>& sources, std::vector<RtasResult> results,
                            OperationNotes& notes);

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
//
// The baseline of dispatch/same-tlas: a loop that calls the Embree backend's own two levels,
// without shaders, shader tables or a dispatch. The difference is the price of running HLSL.
#pragma once

#include <tbb/task_arena.h>

#include <memory>
#include <vector>

#include "dxr_scene.h"
#include "embree_loops.h"
#include "runtime/embree/top_level.h"

namespace kaamos::bench {

class OwnTopLevel {
 public:
  // Uses the very structure that DispatchRays traverses: a copy would lie elsewhere in memory,
  // which alone makes a difference of a few per cent.
  explicit OwnTopLevel(const DxrScene& scene);

  void closest(tbb::task_arena& arena, const RayGrid& grid,
               std::vector<ClosestResult>& results) const;
  void visible(tbb::task_arena& arena, const RayGrid& grid, std::vector<uint32_t>& results) const;

 private:
  std::shared_ptr<const embree::TopLevel> top_level_;
};

}  // namespace kaamos::bench

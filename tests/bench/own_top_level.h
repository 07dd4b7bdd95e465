// SPDX-License-Identifier: MIT
//
// The baseline of dispatch/same-tlas: the Embree backend's own two levels, called by a loop without
// shaders, shader tables or a dispatch. What is left is the price of running HLSL.
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
  // The very structure that DispatchRays traverses: a copy of it lies elsewhere in memory, which
  // alone makes differences of some per cent.
  explicit OwnTopLevel(const DxrScene& scene);

  void closest(tbb::task_arena& arena, const RayGrid& grid,
               std::vector<ClosestResult>& results) const;
  void visible(tbb::task_arena& arena, const RayGrid& grid, std::vector<uint32_t>& results) const;

 private:
  std::shared_ptr<const embree::TopLevel> top_level_;
};

}  // namespace kaamos::bench

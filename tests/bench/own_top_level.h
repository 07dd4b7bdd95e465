// SPDX-License-Identifier: MIT
//
// The baseline of dispatch/same-tlas: the Embree backend's own two levels, called by a loop without
// shaders, shader tables or a dispatch. What is left is the price of running HLSL.
#pragma once

#include <tbb/task_arena.h>

#include <memory>
#include <vector>

#include "embree_loops.h"
#include "runtime/embree/top_level.h"

namespace kaamos::bench {

class OwnTopLevel {
 public:
  explicit OwnTopLevel(const SceneData& data);  // everything opaque
  ~OwnTopLevel();
  OwnTopLevel(const OwnTopLevel&) = delete;
  OwnTopLevel& operator=(const OwnTopLevel&) = delete;

  void closest(tbb::task_arena& arena, const RayGrid& grid,
               std::vector<ClosestResult>& results) const;
  void visible(tbb::task_arena& arena, const RayGrid& grid, std::vector<uint32_t>& results) const;

 private:
  RTCDevice device_ = nullptr;
  std::vector<std::shared_ptr<const embree::BottomLevel>> meshes_;
  std::shared_ptr<const embree::TopLevel> top_level_;
};

}  // namespace kaamos::bench

// SPDX-License-Identifier: MIT
//
// What several cases need, each made when first asked for.
#pragma once

#include <tbb/task_arena.h>

#include <memory>
#include <optional>

#include "dxr_scene.h"
#include "embree_loops.h"
#include "own_top_level.h"
#include "suite.h"

namespace kaamos::bench {

class HandVulkan;

class Fixtures {
 public:
  explicit Fixtures(const Options& options);
  ~Fixtures();

  const Options& options() const { return options_; }
  uint32_t threads() const { return options_.threads; }
  tbb::task_arena& arena() { return arena_; }

  const SceneData& scene();
  const RayGrid& rays(RaySet set);
  const EmbreeScene& embree_scene(bool alpha_tested);
  DxrScene& dxr_scene(bool alpha_tested);
  DxrScene& exact_scene();  // in exact precision, everything opaque
  const OwnTopLevel& own_top_level();
  DxrScene& vulkan_scene();  // everything opaque
  bool has_vulkan_scene() const { return vulkan_ != nullptr; }
  HandVulkan& hand_vulkan();

 private:
  const Options& options_;
  tbb::task_arena arena_;
  std::optional<SceneData> scene_;
  std::unique_ptr<EmbreeScene> embree_[2];
  std::unique_ptr<DxrScene> dxr_[2];
  std::unique_ptr<DxrScene> exact_;
  std::unique_ptr<OwnTopLevel> own_;
  std::unique_ptr<DxrScene> vulkan_;
  std::unique_ptr<HandVulkan> hand_;
  std::vector<SurfacePoint> points_;
  RayGrid rays_[5];
};

}  // namespace kaamos::bench

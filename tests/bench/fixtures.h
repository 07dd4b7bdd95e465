// SPDX-License-Identifier: MIT
//
// The objects that several cases need; each is made on first use.
#pragma once

#include <tbb/task_arena.h>

#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "dxr_scene.h"
#include "embree_loops.h"
#include "own_top_level.h"
#include "suite.h"

namespace kaamos::bench {

class FrameRun;
class HandVulkan;

class Fixtures {
 public:
  explicit Fixtures(const Options& options);
  ~Fixtures();

  const Options& options() const { return options_; }
  uint32_t threads() const { return options_.threads; }
  tbb::task_arena& arena() { return arena_; }

  const SceneData& scene();
  // `distance`: from the origin, as in DxrScene.
  const RayGrid& rays(RaySet set, float distance = 0);
  const EmbreeScene& embree_scene(bool alpha_tested);
  DxrScene& dxr_scene(bool alpha_tested);
  // Everything is opaque. A scene at a distance replaces the previous one.
  DxrScene& scene_of(rtapi::TraversalPrecision precision, float distance = 0);
  DxrScene& checked_scene();  // on a checked device, everything opaque
  const OwnTopLevel& own_top_level();
  FrameRun& frame_run();
  DxrScene& vulkan_scene();  // everything opaque
  bool has_vulkan_scene() const { return vulkan_ != nullptr; }
  HandVulkan& hand_vulkan();

 private:
  const Options& options_;
  tbb::task_arena arena_;
  std::optional<SceneData> scene_;
  std::unique_ptr<EmbreeScene> embree_[2];
  std::unique_ptr<DxrScene> dxr_[2];
  std::unique_ptr<DxrScene> of_precision_[3];
  struct Distant {
    float distance = 0;
    std::unique_ptr<DxrScene> scene;
  };
  Distant distant_[3];
  std::unique_ptr<DxrScene> checked_;
  std::unique_ptr<OwnTopLevel> own_;
  std::unique_ptr<FrameRun> frame_;
  std::unique_ptr<DxrScene> vulkan_;
  std::unique_ptr<HandVulkan> hand_;
  std::vector<SurfacePoint> points_;
  RayGrid rays_[5];
  std::map<std::pair<int, float>, RayGrid> distant_rays_;
};

}  // namespace kaamos::bench

// SPDX-License-Identifier: MIT
//
// The baseline of raster/...: the least Vulkan program that draws the same triangles to the same
// targets.
#pragma once

#include <memory>

#include "raster_scene.h"

namespace kaamos::bench {

// Throws std::runtime_error with what failed.
class HandVulkanRaster {
 public:
  // Settles how this process's heap grows, for good: see the .cpp.
  explicit HandVulkanRaster(const RasterScene& scene);
  ~HandVulkanRaster();

  void run();
  // After run().
  RasterPictures pictures();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kaamos::bench

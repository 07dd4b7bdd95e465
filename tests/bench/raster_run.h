// SPDX-License-Identifier: MIT
//
// Kaamos's side of raster/...: the targets of a pass, and a list that clears them and draws.
#pragma once

#include <rtapi/rtapi.h>

#include <string>
#include <vector>

#include "raster_scene.h"

namespace kaamos::bench {

class RasterRun {
 public:
  RasterRun(const RasterScene& scene, const std::string& backend, uint32_t threads);

  void run();
  // After run().
  RasterPictures pictures();

 private:
  void create_targets();
  void create_pipeline();
  void record();

  const RasterScene& scene_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::RootSignature root_;
  rtapi::PipelineState pipeline_;
  rtapi::Buffer vertices_;
  rtapi::Buffer indices_;
  rtapi::Texture depth_;
  std::vector<rtapi::Texture> colors_;
  rtapi::DescriptorHeap dsvs_;
  rtapi::DescriptorHeap rtvs_;
  rtapi::CommandList list_;
};

}  // namespace kaamos::bench

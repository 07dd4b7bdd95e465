// SPDX-License-Identifier: MIT
//
// Runs one effect over the lounge, with its rays in pixel order or sorted by direction.
#pragma once

#include <cstdint>
#include <optional>

#include "effects/frame/ray_pass.h"
#include "effects/indirect_diffuse/volume.h"
#include "effects/lights/lighting.h"
#include "effects/ray_order/ray_order.h"
#include "fixtures.h"

namespace kaamos::bench {

struct BenchEffect {
  const char* name;
  effects::RayPassDesc (*pass)(rtapi::ShaderLibrary);
  rtapi::Result<rtapi::ShaderLibrary> (*library)();
  bool own_picture;  // it adds to a picture of its own, not to one of the frame's
};
extern const BenchEffect kAoEffect, kSunEffect, kReflectionsEffect;

class EffectRun {
 public:
  EffectRun(const BenchEffect& effect, Fixtures& fixtures);

  // Computes the rays' keys and sorts them.
  void sort();
  // One dispatch with `samples` rays per pixel.
  void trace(bool sorted, uint32_t samples = 1);

 private:
  void bind_picture();

  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  effects::GpuScene gpu_;
  effects::Frame frame_;
  std::optional<effects::Lighting> lighting_;
  effects::GpuVolume volume_;
  effects::RaySorter sorter_;
  effects::RayPass pass_, keys_;
  rtapi::Texture picture_;
  effects::PassViews views_;
  effects::PassArguments arguments_;
  rtapi::CommandList list_;
};

}  // namespace kaamos::bench

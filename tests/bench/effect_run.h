// SPDX-License-Identifier: MIT
//
// One effect over the lounge, with its rays in the pixels' order or sorted by direction.
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
  bool own_picture;  // it adds to one of its own, not to one of the frame's
};
extern const BenchEffect kAoEffect, kSunEffect, kReflectionsEffect;

class EffectRun {
 public:
  EffectRun(const BenchEffect& effect, Fixtures& fixtures);

  // Keys of the rays, and their order.
  void sort();
  // One dispatch, `samples` rays a pixel.
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

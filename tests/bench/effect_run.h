// SPDX-License-Identifier: MIT
//
// Runs one effect over the lounge, with its rays in pixel order or sorted.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "effects/northlight/frame_renderer.h"
#include "fixtures.h"

namespace kaamos::bench {

class EffectRun {
 public:
  // `effect`: its name in the registry; `order`: of sorted rays.
  EffectRun(const std::string& effect, Fixtures& fixtures,
            effects::RayOrder order = effects::RayOrder::kDirection);

  // Computes the rays' keys and sorts them.
  void sort();
  // One dispatch with `samples` rays per pixel.
  void trace(bool sorted, uint32_t samples = 1);

 private:
  std::string effect_;
  std::unique_ptr<effects::FrameRenderer> renderer_;
  rtapi::CommandList list_;
};

}  // namespace kaamos::bench

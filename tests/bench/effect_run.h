// SPDX-License-Identifier: MIT
//
// One effect over the lounge, with its rays in the pixels' order or sorted by direction.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "effects/northlight/frame_renderer.h"
#include "fixtures.h"

namespace kaamos::bench {

class EffectRun {
 public:
  // `effect`: its name in the registry.
  EffectRun(const std::string& effect, Fixtures& fixtures);

  // Keys of the rays, and their order.
  void sort();
  // One dispatch, `samples` rays a pixel.
  void trace(bool sorted, uint32_t samples = 1);

 private:
  std::string effect_;
  std::unique_ptr<effects::FrameRenderer> renderer_;
  rtapi::CommandList list_;
};

}  // namespace kaamos::bench

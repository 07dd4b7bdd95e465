// SPDX-License-Identifier: MIT
//
// This file holds what a pass of draws works on: the textures that it writes and the bytes that it
// reads.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "runtime/backend/draw_commands.h"
#include "runtime/backend/linked_graphics.h"

namespace kaamos::raster {

// One mip level of a target's view.
struct Surface {
  uint8_t* texels = nullptr;  // texel (0, 0) of the view's first slice; null: no target
  uint64_t row_pitch = 0;     // bytes
  uint64_t slice_pitch = 0;   // bytes
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t slices = 1;
  rtapi::Format format = rtapi::Format::kUnknown;  // of the view
  bool read_only = false;                          // depth: tested but never written
  bool read_only_stencil = false;                  // the same
  // The texels count as `value`, whatever they hold, and the pass writes all of them.
  bool cleared = false;
  std::array<uint32_t, 4> value = {};  // words of a texel, as of TargetCodec
  uint32_t samples = 1;
  uint64_t sample_pitch = 0;  // bytes from a pixel's sample to the next one
};

struct Targets {
  std::array<Surface, rtapi::kSimultaneousRenderTargetCount> color;
  Surface depth;
  uint32_t samples = 1;  // of all of them
};

// `linked`, `state` and all bytes outlive the pass.
struct Draw {
  const runtime::LinkedGraphics* linked = nullptr;
  const runtime::DrawState* state = nullptr;
  bool indexed = false;
  bool counted = false;                   // what it does counts although nobody may see it
  rtapi::DrawIndexedArguments arguments;  // as in runtime::DrawCommand
  // The bytes that the views of `state` stand for; a span without data means that nothing is bound.
  // Strides and the format of indices are those of the views.
  std::array<std::span<const uint8_t>, rtapi::kIAVertexInputResourceSlotCount> vertex_buffers;
  std::span<const uint8_t> indices;
};

}  // namespace kaamos::raster

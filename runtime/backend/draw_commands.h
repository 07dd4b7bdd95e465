// SPDX-License-Identifier: MIT
//
// Recorded draws and clears of targets, and the state that they share.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <rtapi/graphics_pipeline.h>
#include <rtapi/render_target.h>

#include "runtime/backend/root_bindings.h"

namespace kaamos::runtime {

class BackendPipeline;
class BackendTexture;
struct LinkedGraphics;

inline bool is_strip(rtapi::PrimitiveTopology topology) {
  return topology == rtapi::PrimitiveTopology::kLineStrip ||
         topology == rtapi::PrimitiveTopology::kTriangleStrip;
}

// The view that a render target or depth-stencil descriptor stood for when a call read it.
struct TargetView {
  std::shared_ptr<BackendTexture> texture;  // null: no target
  rtapi::Format format = rtapi::Format::kUnknown;
  uint32_t mip = 0;
  uint32_t first_slice = 0;
  uint32_t slice_count = 1;
  uint32_t width = 0;  // of the mip, in texels
  uint32_t height = 0;
  uint32_t samples = 1;
  bool is_volume = false;  // slices are of the mip's depth, in the only array element
  bool read_only_depth = false;
  bool read_only_stencil = false;

  bool operator==(const TargetView&) const = default;
};

struct DrawTargets {
  std::array<TargetView, rtapi::kSimultaneousRenderTargetCount> color;
  uint32_t color_count = 0;
  TargetView depth;

  bool operator==(const DrawTargets&) const = default;
};

// The state that a list has set when it draws. Draws share it if nothing was set between them.
struct DrawState {
  DrawTargets targets;
  std::array<rtapi::Viewport, rtapi::kViewportAndScissorRectCount> viewports;
  uint32_t viewport_count = 0;
  std::array<rtapi::Rect, rtapi::kViewportAndScissorRectCount> scissors;
  uint32_t scissor_count = 0;
  rtapi::PrimitiveTopology topology = rtapi::PrimitiveTopology::kUndefined;
  std::array<rtapi::VertexBufferView, rtapi::kIAVertexInputResourceSlotCount> vertex_buffers;
  rtapi::IndexBufferView index_buffer;
  float blend_factor[4] = {1, 1, 1, 1};
  uint8_t front_stencil = 0;  // references
  uint8_t back_stencil = 0;
};

struct DrawCommand {
  std::shared_ptr<BackendPipeline> pipeline;
  std::shared_ptr<const LinkedGraphics> linked;  // what `pipeline` was made from
  RootBindings bindings;
  std::shared_ptr<const DrawState> state;  // never null
  bool indexed = false;
  // Those of DrawInstanced have no BaseVertexLocation; their counts and starts are of vertices.
  rtapi::DrawIndexedArguments arguments;
};

struct ClearTargetCommand {
  TargetView view;
  bool depth_stencil = false;
  float color[4] = {0, 0, 0, 0};
  bool clear_depth = false;
  bool clear_stencil = false;
  float depth = 0;
  uint8_t stencil = 0;
  bool whole = true;               // else `rects`
  std::vector<rtapi::Rect> rects;  // cut to the view; none of them is empty
};

}  // namespace kaamos::runtime

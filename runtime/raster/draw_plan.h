// SPDX-License-Identifier: MIT
//
// Everything about a draw that does not change from triangle to triangle.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/raster/draw.h"
#include "runtime/raster/stencil.h"
#include "runtime/raster/target_codec.h"
#include "runtime/raster/viewport.h"

namespace kaamos::raster {

enum class DepthKind : uint8_t { kNone, kFloat32, kUnorm16, kUnorm24 };

// kNone if nothing or no depth format.
DepthKind depth_kind(rtapi::Format format);

// A component of the pixel shader's inputs, fed from a word of a vertex's row.
struct RowAttribute {
  uint32_t pixel_column;
  uint32_t word;
  uint32_t vertex = 0;  // of the primitive, if it is not interpolated
};

// Numbers of attributes in a list: those before them are in the middle of the pixel.
struct AttributePlaces {
  size_t centroid = 0;
  size_t sample = 0;
};

// A render target that the pixel shader writes.
struct PlannedTarget {
  const TargetCodec* codec = nullptr;
  uint32_t slot = 0;
  uint32_t first_column = 0;
  uint32_t components = 0;
  uint32_t mask[4] = {};     // bits of each word that are written
  bool whole_texels = true;  // all bits are written, whatever is there
  bool blends = false;
  rtapi::RenderTargetBlendDesc blend;
};

struct DrawPlan {
  const runtime::LinkedGraphics* linked = nullptr;
  const runtime::DrawState* state = nullptr;
  bool draws_nothing = false;
  uint32_t samples = 1;
  uint32_t sample_mask = 1;
  bool runs_per_sample = false;
  bool observed = false;      // counts what becomes of vertices and triangles
  bool has_shading = false;   // triangles come with their TriangleShading
  bool keeps_culled = false;  // for a log of a pixel: triangles go on, marked kCulled

  // Vertices. Column row_columns[i] of the outputs of the last shader before the rasterizer becomes
  // word i of the row: first what is linear, then what is linear on the screen, then what is flat.
  std::vector<uint32_t> row_columns;
  uint32_t vertex_inputs = 0;   // columns
  uint32_t vertex_outputs = 0;  // columns
  bool has_geometry = false;
  bool depth_clip = true;
  uint32_t clip_count = 0;
  uint32_t cull_count = 0;
  bool picks_viewport = false;
  bool picks_slice = false;
  bool numbers_primitives = false;  // the geometry shader, in a column
  bool shades_each_once = false;    // vertices that no triangle uses must not be shaded
  uint32_t slices = 1;
  std::array<ViewportState, rtapi::kViewportAndScissorRectCount> viewports;

  // Lines and triangles.
  bool wireframe = false;             // of triangles only the edges are drawn
  bool lines_are_rectangles = false;  // 1.4 pixels wide; else one pixel of each column or row
  bool cull_front = false;
  bool cull_back = false;
  bool front_is_clockwise = true;
  bool biased = false;
  DepthKind bias_kind = DepthKind::kFloat32;
  float depth_bias = 0;
  float bias_clamp = 0;
  float slope_bias = 0;
  // Where a pixel's samples begin and end in x and y, in subpixels from its corner.
  int32_t least_sample = kPixelCenter;
  int32_t greatest_sample = kPixelCenter;

  // Pixels. A test or write is early if it happens before the pixel shader runs. Stencil is tested
  // and written where depth is tested.
  std::shared_ptr<const StencilTables> stencil;  // null: neither tested nor written
  DepthKind depth = DepthKind::kNone;            // kNone: neither tested nor written
  uint32_t depth_func = 7;  // bit 0: passes if less, bit 1: if equal, bit 2: if greater
  bool early_test = false;
  bool early_write = false;
  bool late_test = false;
  bool late_write = false;
  bool reads_depth_output = false;  // SV_Depth replaces z
  bool has_pixel = false;
  bool masks_output = false;  // SV_Coverage or alpha to coverage takes samples out
  bool discards = false;
  uint32_t pixel_inputs = 0;   // columns
  uint32_t pixel_outputs = 0;  // columns
  // The first two by their places: in the middle of the pixel, at the centroid, at the sample.
  std::vector<RowAttribute> linear, screen_linear, flat;
  AttributePlaces linear_places, screen_places;
  bool needs_perspective = false;  // weights in perspective
  bool needs_screen = false;       // weights on the screen
  bool needs_z = false;            // pixels keep z for the shader or a late test
  std::vector<PlannedTarget> targets;
  float blend_factor[4] = {1, 1, 1, 1};
};

// `width` x `height`: what all bound targets have in common, or the largest target if there is
// none.
DrawPlan plan_draw(const Draw& draw, const Targets& targets, uint32_t width, uint32_t height,
                   uint32_t slices);

}  // namespace kaamos::raster

// SPDX-License-Identifier: MIT
//
// The notes that a backend that rasterizes by itself can take while it draws: sums for each draw,
// counts for each pixel, and all that became of one pixel.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <rtapi/format.h>
#include <rtapi/graphics_pipeline.h>

namespace kaamos::runtime {

struct LinkedGraphics;  // linked_graphics.h

// The pixel where something was found first, in the order of drawing as far as it has one.
struct FirstPixel {
  uint32_t x = 0;
  uint32_t y = 0;
  uint32_t primitive_id = 0;
};

// Pixels whose shader gave an output that is no number.
struct OddOutputs {
  uint64_t not_a_number = 0;
  uint64_t infinite = 0;
  FirstPixel first = {};

  void add(const OddOutputs& other) {
    if (not_a_number + infinite == 0) first = other.first;
    not_a_number += other.not_a_number;
    infinite += other.infinite;
  }
};

// Sums of a draw. Which pixel is a first one may depend on threads; nothing else does.
struct DrawCounts {
  // Vertices: each may count several times, as it may be shaded several times.
  uint64_t vertices = 0;          // of the vertex shader
  uint64_t not_finite = 0;        // positions with NaN or infinity
  uint32_t first_not_finite = 0;  // its SV_VertexID
  uint64_t far_away = 0;          // |x| or |y| more than 1e7 w
  uint32_t first_far_away = 0;

  // Primitives that the input assembler made, and calls of the geometry shader.
  uint64_t assembled = 0;
  uint64_t geometry_calls = 0;

  // Triangles, of the geometry shader if there is one.
  uint64_t triangles = 0;
  uint64_t not_a_triangle = 0;  // with a vertex that is not finite
  uint64_t outside = 0;         // of what can be seen
  uint64_t zero_area = 0;
  uint64_t culled = 0;    // by facing
  uint64_t no_pixel = 0;  // between centres of pixels, or outside of the scissor rectangle

  // Pixels, once for each triangle.
  uint64_t covered = 0;
  uint64_t failed_stencil = 0;
  uint64_t failed_depth = 0;
  uint64_t shaded = 0;  // without helpers
  uint64_t discarded = 0;
  uint64_t written = 0;  // passed everything

  OddOutputs targets[rtapi::kSimultaneousRenderTargetCount];
  OddOutputs depth;

  void add(const DrawCounts& other);
};

inline void DrawCounts::add(const DrawCounts& other) {
  if (not_finite == 0) first_not_finite = other.first_not_finite;
  if (far_away == 0) first_far_away = other.first_far_away;
  vertices += other.vertices;
  assembled += other.assembled;
  geometry_calls += other.geometry_calls;
  not_finite += other.not_finite;
  far_away += other.far_away;
  triangles += other.triangles;
  not_a_triangle += other.not_a_triangle;
  outside += other.outside;
  zero_area += other.zero_area;
  culled += other.culled;
  no_pixel += other.no_pixel;
  covered += other.covered;
  failed_stencil += other.failed_stencil;
  failed_depth += other.failed_depth;
  shaded += other.shaded;
  discarded += other.discarded;
  written += other.written;
  for (uint32_t i = 0; i < rtapi::kSimultaneousRenderTargetCount; ++i) {
    targets[i].add(other.targets[i]);
  }
  depth.add(other.depth);
}

// Counts of the triangles at a pixel, by what they did there.
struct PixelCounts {
  uint32_t covered = 0;
  uint32_t shaded = 0;
  uint32_t written = 0;
};

// The counts of one slice of the targets; row by row.
struct PixelMap {
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t slice = 0;
  std::vector<PixelCounts> pixels;
};

// A texel of a render target before and after a write.
struct TexelChange {
  uint32_t slot = 0;
  rtapi::Format format = rtapi::Format::kUnknown;
  std::array<uint8_t, 16> before = {};
  std::array<uint8_t, 16> after = {};
};

// A triangle that covers the logged pixel.
struct PixelEvent {
  uint32_t draw = 0;  // of the list, as in DrawObservation
  uint32_t instance = 0;
  uint32_t primitive_id = 0;
  bool front_facing = false;
  bool culled = false;           // by facing; nothing else happened
  float weights[3] = {0, 0, 0};  // of its corners on the screen
  float z = 0;                   // of the triangle
  bool stencil_tested = false;
  bool stencil_passed = true;       // true if not tested
  uint8_t stored_stencil = 0;       // before the test
  bool tested = false;              // against the depth buffer
  bool late = false;                // after the pixel shader
  float tested_depth = 0;           // as converted, or SV_Depth
  float stored_depth = 0;           // before the test
  bool passed = true;               // true if not tested
  bool writes_depth = false;        // and it did, if it passed
  bool shaded = false;              // a pixel shader ran
  bool discarded = false;           // by it
  bool written = false;             // it passed everything
  std::vector<uint32_t> outputs;    // of the pixel shader, by column
  std::vector<TexelChange> texels;  // written
};

struct PixelLog {
  uint32_t x = 0;
  uint32_t y = 0;
  uint32_t slice = 0;
  std::vector<PixelEvent> events;
};

// Draws are numbered from 0 in the order of execution, those of ExecuteIndirect too. Only draws to
// targets of one size are noted, that of the first that is noted.
struct DrawObservation {
  uint32_t first_draw = 0;
  uint32_t draw_count = UINT32_MAX;
  bool counts_pixels = false;  // fills in `map`
  bool logs_pixel = false;     // fills in `log`
  PixelMap map;
  PixelLog log;
  uint32_t next_draw = 0;
  uint32_t noted = 0;     // draws
  uint32_t left_out = 0;  // draws to targets of another size
  uint32_t width = 0;     // of what targets have in common; 0: nothing noted yet
  uint32_t height = 0;
  // The draws in the log, by number.
  struct LoggedDraw {
    std::shared_ptr<const LinkedGraphics> linked;
    std::string label;  // "DrawInstanced, command 3"
  };
  std::map<uint32_t, LoggedDraw> logged;
};

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
//
// Notes what happens in a tile, for checked mode, counts of pixels and explanations. Only
// draw_tile_observed calls it.
#pragma once

#include <array>
#include <mutex>
#include <vector>

#include "runtime/backend/draw_observation.h"
#include "runtime/raster/tile.h"

namespace kaamos::raster {

// The draws of a pass that are observed, and where the results go.
struct Observation {
  struct OfDraw {
    uint32_t number = 0;  // for the log
    bool noted = false;   // in `map` and `log`
    runtime::DrawCounts counts;
  };
  std::vector<OfDraw> draws;         // of the pass
  runtime::PixelMap* map = nullptr;  // null: no counts of pixels
  runtime::PixelLog* log = nullptr;  // null: no log
  std::mutex mutex;                  // guards `counts`
};

// A triangle in a block of 4 x 2 pixels, two quads of a tile.
struct ObservedBlock {
  uint32_t quad;                  // the first quad's number in the tile
  uint32_t covered;               // bits, in the order of pixel shaders
  uint32_t passed;                // the early tests
  const float* z;                 // of the eight pixels; null if nothing needs it
  const uint32_t* stored_depth;   // words before the test; null if there is none
  const uint8_t* stored_stencil;  // the same
  uint32_t failed_stencil;        // of `covered`
};

// Two quads after the pixel shader.
struct ObservedQuads {
  const uint16_t* quad;  // their numbers in the tile; one if not `pair`
  bool pair;
  uint32_t covered;
  uint32_t live;     // after the shader
  uint32_t written;  // after late tests
  const shader::Column* outputs;
  const uint32_t* stored_depth;   // of both quads before a late test; null if there is none
  const uint8_t* stored_stencil;  // the same
  uint32_t failed_stencil;        // of `live`
};

// Lives outside of the frames of a task, as a fault may leave the task.
class TileObserver {
 public:
  void begin_tile(const TileJob& job, TileColors& colors);
  void end_tile();
  void begin_batch(const Batch& batch, const DrawPlan& plan);
  // Before its blocks.
  void begin_triangle(const TriangleShading& shading) { shading_ = &shading; }
  void block(const Triangle& triangle, const ObservedBlock& block);
  // Before the render targets are written, and after it.
  void before_write(const uint16_t* quad, bool pair);
  void shaded(const Triangle& triangle, const ObservedQuads& quads);

 private:
  runtime::PixelCounts* pixel(uint32_t quad, uint32_t lane) const;
  runtime::PixelEvent begin_event(const Triangle& triangle) const;
  float depth_of(uint32_t word) const;
  float converted(float z, const Triangle& triangle) const;
  void read_texels(std::array<uint8_t, 16> runtime::TexelChange::*into);
  void note_odd(const ObservedQuads& quads);

  void finish_draw();

  const TileJob* job_ = nullptr;
  TileColors* colors_ = nullptr;
  Observation* observation_ = nullptr;
  const Batch* batch_ = nullptr;
  const DrawPlan* plan_ = nullptr;
  const TriangleShading* shading_ = nullptr;  // of the triangle
  Observation::OfDraw* draw_ = nullptr;
  runtime::DrawCounts counts_;
  runtime::PixelMap* map_ = nullptr;  // null where this tile or draw has none
  runtime::PixelLog* log_ = nullptr;
  uint32_t log_quad_ = 0;
  uint32_t log_lane_ = 0;
  const Triangle* logged_ = nullptr;  // whose event is the last one
  runtime::TexelChange texels_[rtapi::kSimultaneousRenderTargetCount];  // before a write
  uint32_t texel_count_ = 0;
};

}  // namespace kaamos::raster

// SPDX-License-Identifier: MIT
//
// From a range of a draw's triangles to a batch: fetches and shades its vertices, cuts, snaps and
// sets up its triangles, and sorts them into tiles. One for each thread.
#pragma once

#include "runtime/raster/bins.h"
#include "runtime/raster/draw_plan.h"
#include "runtime/raster/primitives.h"
#include "runtime/raster/screen.h"
#include "runtime/raster/vertex_fetch.h"
#include "runtime/raster/workers.h"

namespace kaamos::raster {

class FrontEnd {
 public:
  void run(const TriangleRange& range, const Draw& draw, const DrawPlan& plan, const TileGrid& grid,
           ShaderThread& thread, Batch& batch);

 private:
  static constexpr uint32_t kGroup = shader::kGraphicsLanes;
  using Vertices = ClipVertices<kGroup>;
  using Screen = ScreenVertices<kGroup>;

  void collect_vertices();
  void collect_by_range(uint32_t lowest, uint32_t size);
  void collect_by_hash();
  void shade_vertices(ShaderThread& thread);
  void take_outputs(uint32_t first, uint32_t count, const shader::Column* outputs);
  void add_triangles();
  void add_triangle(const uint32_t vertex[3], uint32_t primitive_id);
  // The vertices on the screen; adds to `codes`, the outcodes of any of them.
  void gather(const uint32_t vertex[3], ScreenVertex screen[3], uint32_t& codes) const;
  void add_clipped(uint32_t primitive_id, const uint32_t vertex[3], const ScreenVertex corners[3],
                   uint32_t codes);
  // Adds a triangle; null if it need not be drawn.
  Triangle* emit(const ScreenVertex screen[3]);
  // Adds the shading of the triangle that was added last; leaves `vertex` and `clip` to the caller.
  TriangleShading& add_shading(const ScreenVertex screen[3], uint32_t primitive_id);
  void count_vertices(uint32_t first, uint32_t count);

  const TriangleRange* range_ = nullptr;
  const Draw* draw_ = nullptr;
  const DrawPlan* plan_ = nullptr;
  Batch* batch_ = nullptr;
  runtime::DrawCounts* counts_ = nullptr;  // null: nothing is counted
  // The viewport that the triangle being added is drawn to.
  const ViewportState* viewport_ = nullptr;
  uint32_t viewport_flags_ = 0;
  uint32_t slice_ = 0;

  VertexFetch fetch_;
  Bins bins_;
  // By corner of a triangle: the number of its vertex in the batch.
  Storage<uint32_t> corners_;
  Storage<uint32_t> table_;  // from an index to its vertex
  Storage<Triangle> triangles_;
  // By vertex.
  Storage<uint32_t> ids_;  // SV_VertexID
  Storage<Vertices> clip_;
  Storage<Screen> screen_;
  Storage<float> distances_;  // clip distances
  Storage<uint32_t> viewports_;
  Storage<uint32_t> slices_;
  Storage<uint32_t> columns_;  // of the vertex shader
};

}  // namespace kaamos::raster

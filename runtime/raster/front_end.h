// SPDX-License-Identifier: MIT
//
// From a range of a draw's primitives to a batch: fetches and shades its vertices, runs the
// geometry shader, cuts, snaps and sets up triangles and lines, and sorts them into tiles. One for
// each thread.
#pragma once

#include <array>

#include "runtime/raster/bins.h"
#include "runtime/raster/clip.h"
#include "runtime/raster/draw_plan.h"
#include "runtime/raster/primitives.h"
#include "runtime/raster/screen.h"
#include "runtime/raster/triangle_setup.h"
#include "runtime/raster/vertex_fetch.h"
#include "runtime/raster/workers.h"

namespace kaamos::raster {

class FrontEnd {
 public:
  void run(const PrimitiveRange& range, const Draw& draw, const DrawPlan& plan,
           const TileGrid& grid, ShaderThread& thread, Batch& batch);

 private:
  static constexpr uint32_t kGroup = shader::kGraphicsLanes;
  using Vertices = ClipVertices<kGroup>;
  using Screen = ScreenVertices<kGroup>;

  void collect_vertices();
  void collect_by_range(uint32_t lowest, uint32_t size);
  void collect_by_hash();
  void shade_vertices(ShaderThread& thread);
  // Makes room for so many vertices of the last shader before the rasterizer.
  void reserve_vertices(uint32_t count);
  void take_outputs(uint32_t first, uint32_t count, const shader::Column* outputs);
  // A primitive that is being added. Points have one vertex three times, lines the first one twice.
  struct Primitive {
    uint32_t vertex[3];  // numbers in the batch
    uint32_t id;         // SV_PrimitiveID
    ScreenVertex screen[3];
    uint32_t codes;  // outcodes of any of its vertices
  };
  // What is left of a primitive inside of all planes.
  struct Polygon {
    ClipVertex vertex[kMaxClippedVertices];
    ScreenVertex screen[kMaxClippedVertices];
    float original_w[3];
    int count;

    // The weights of the primitive's vertices that make up a vertex, as of ClipWeights.
    void weights_of(int number, float perspective[3], float on_screen[3]) const {
      const ClipVertex& from = vertex[number];
      for (int k = 0; k < 3; ++k) {
        perspective[k] = static_cast<float>(from.weight[k]);
        on_screen[k] =
            static_cast<float>(from.weight[k] * static_cast<double>(original_w[k]) / from.w);
      }
    }
  };
  // Calls each(vertex, id) with the three vertices of each primitive as Primitive has them.
  template <class Each>
  [[gnu::always_inline]] static void each_primitive(const PrimitiveRange& range,
                                                    const uint32_t* corners, const Each& each) {
    const uint32_t step = range.strip ? 1 : range.corners;
    const bool triangles = range.corners == 3;
    for (uint32_t i = 0; i < range.count; ++i) {
      const uint32_t* first = corners + size_t{i} * step;
      if (triangles) {
        const bool odd = range.strip && ((i & 1) != 0) != range.odd;
        const uint32_t vertex[3] = {first[0], first[odd ? 2 : 1], first[odd ? 1 : 2]};
        each(vertex, range.primitive_id + i);
      } else {
        const uint32_t vertex[3] = {first[0], first[range.corners - 1], first[0]};
        each(vertex, range.primitive_id + i);
      }
    }
  }
  void add_primitives();
  // Fills in the rest; false if nothing can be seen of it.
  bool begin_primitive(Primitive& primitive);
  void add_triangle(const Primitive& primitive);
  // The vertices on the screen; adds to `codes`, the outcodes of any of them.
  void gather(const uint32_t vertex[3], ScreenVertex screen[3], uint32_t& codes) const;
  // False if nothing is left. `corners`: 3, or 2 of a line.
  bool clip_primitive(const Primitive& primitive, int corners, Polygon& polygon);
  void add_clipped(const Primitive& primitive);
  // Adds a triangle; null if it need not be drawn.
  Triangle* emit(const ScreenVertex screen[3], PartOf part_of = PartOf::kTriangle);
  // Counts what is not drawn.
  void note(SetUp set_up);
  // Adds the shading of the triangle that was added last; leaves `vertex` and `clip` to the caller.
  TriangleShading& add_shading(const ScreenVertex screen[3], uint32_t primitive_id);
  // The same of a part of a primitive.
  void add_part_shading(const ScreenVertex screen[3], const Primitive& primitive,
                        const ClipWeights& weights);

  // front_end_geometry.cpp
  void keep_rows(uint32_t first, uint32_t count, const shader::Column* outputs);
  void run_geometry(ShaderThread& thread);
  void call_geometry(ShaderThread& thread, const uint32_t vertex[3], uint32_t id);
  void assemble(const shader::GeometryStream& stream, uint32_t first);
  void take_emitted();

  // front_end_lines.cpp
  struct LineEnd {
    ScreenVertex screen;
    float perspective[3];  // weights of the primitive's vertices, as of ClipWeights
    float on_screen[3];
  };
  // Returns the weights of a part whose vertices are these of the two ends.
  static ClipWeights weights_of(const LineEnd ends[2], const std::array<int, 3>& vertices);
  static LineEnd end_at_corner(const Primitive& primitive, int corner);
  static LineEnd end_at_vertex(const Polygon& polygon, int vertex);
  void add_point(const Primitive& primitive);
  void add_line(const Primitive& primitive);
  void add_edges(const Primitive& primitive);
  void add_edges(const Primitive& primitive, const LineEnd* corners, int count);
  void emit_line(const LineEnd ends[2], const Primitive& primitive, bool front);
  void emit_rectangle(const LineEnd ends[2], const Primitive& primitive, bool front);

  // Those that are nowhere, or far away.
  void note_vertices(uint32_t first, uint32_t count);

  // What is drawn: the draw's primitives, or those that the geometry shader makes of them.
  const PrimitiveRange* range_ = nullptr;
  PrimitiveRange made_;
  const Draw* draw_ = nullptr;
  const DrawPlan* plan_ = nullptr;
  Batch* batch_ = nullptr;
  runtime::DrawCounts* counts_ = nullptr;  // null: nothing is counted
  // The viewport that the primitive being added is drawn to.
  const ViewportState* viewport_ = nullptr;
  uint32_t viewport_flags_ = 0;
  uint32_t slice_ = 0;

  VertexFetch fetch_;
  Bins bins_;
  // By corner of a primitive: the number of its vertex in the batch.
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
  Storage<uint32_t> primitive_ids_;

  // The geometry shader takes primitives from corners_in_, vertices from rows_in_ and those of one
  // primitive from corner_rows_, and writes vertices to rows_out_ and begins_.
  Storage<uint32_t> corners_in_;
  Storage<uint32_t> rows_in_;
  Storage<uint32_t> corner_rows_;
  Storage<uint32_t> rows_out_;
  Storage<bool> begins_;
};

}  // namespace kaamos::raster

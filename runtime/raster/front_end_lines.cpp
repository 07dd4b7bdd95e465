// SPDX-License-Identifier: MIT
//
// The front end's points, lines, and edges of triangles. Depth and attributes change along a line
// alone: it is a part of its primitive, as a triangle is that was cut.
#include "runtime/raster/front_end.h"

#include <algorithm>
#include <array>

#include "runtime/raster/line_setup.h"

namespace kaamos::raster {

FrontEnd::LineEnd FrontEnd::end_at_corner(const Primitive& primitive, int corner) {
  LineEnd end = {primitive.screen[corner], {}, {}};
  end.perspective[corner] = end.on_screen[corner] = 1;
  return end;
}

FrontEnd::LineEnd FrontEnd::end_at_vertex(const Polygon& polygon, int vertex) {
  LineEnd end = {polygon.screen[vertex], {}, {}};
  polygon.weights_of(vertex, end.perspective, end.on_screen);
  return end;
}

ClipWeights FrontEnd::weights_of(const LineEnd ends[2], const std::array<int, 3>& vertices) {
  ClipWeights out;
  for (size_t v = 0; v < 3; ++v) {
    std::copy_n(ends[vertices[v]].perspective, 3, out.perspective[v]);
    std::copy_n(ends[vertices[v]].on_screen, 3, out.screen[v]);
  }
  return out;
}

// A square of two triangles, which has the vertex's attributes everywhere. [D3D11.3: 3.4.4]
void FrontEnd::add_point(const Primitive& primitive) {
  if ((primitive.codes & kNeedsClip) != 0) return;
  ScreenVertex corners[4];
  point_square(primitive.screen[0], corners);
  for (const auto& half : {std::array{0, 2, 1}, std::array{1, 2, 3}}) {
    const ScreenVertex part[3] = {corners[half[0]], corners[half[1]], corners[half[2]]};
    if (emit(part, PartOf::kPointOrLine) == nullptr || !plan_->has_shading) continue;
    TriangleShading& shading = add_shading(part, primitive.id);
    for (uint32_t& vertex : shading.vertex) vertex = primitive.vertex[0];
  }
}

void FrontEnd::add_line(const Primitive& primitive) {
  if ((primitive.codes & kNeedsClip) == 0) {
    const LineEnd ends[2] = {end_at_corner(primitive, 0), end_at_corner(primitive, 1)};
    return emit_line(ends, primitive, true);
  }
  Polygon polygon;
  if (!clip_primitive(primitive, 2, polygon)) return;
  const LineEnd ends[2] = {end_at_vertex(polygon, 0), end_at_vertex(polygon, 1)};
  emit_line(ends, primitive, true);
}

void FrontEnd::add_edges(const Primitive& primitive) {
  LineEnd corners[kMaxClippedVertices];
  if ((primitive.codes & kNeedsClip) == 0) {
    for (int i = 0; i < 3; ++i) corners[i] = end_at_corner(primitive, i);
    return add_edges(primitive, corners, 3);
  }
  Polygon polygon;
  if (!clip_primitive(primitive, 3, polygon)) return;
  for (int i = 0; i < polygon.count; ++i) corners[i] = end_at_vertex(polygon, i);
  add_edges(primitive, corners, polygon.count);
}

// Where a triangle was cut there is no edge.
void FrontEnd::add_edges(const Primitive& primitive, const LineEnd* corners, int count) {
  Orientation orientation;
  SetUp oriented = SetUp::kZeroArea;
  for (int i = 1; i + 1 < count && oriented == SetUp::kZeroArea; ++i) {
    const ScreenVertex part[3] = {corners[0].screen, corners[i].screen, corners[i + 1].screen};
    oriented = orient_triangle(*plan_, part, orientation);
  }
  if (oriented != SetUp::kDone) return note(oriented);
  for (int i = 0; i < count; ++i) {
    LineEnd ends[2] = {corners[i], corners[(i + 1) % count]};
    bool of_triangle = false;
    for (int k = 0; k < 3; ++k) {
      of_triangle = of_triangle || (ends[0].perspective[k] == 0 && ends[1].perspective[k] == 0);
    }
    if (!of_triangle) continue;
    for (LineEnd& end : ends) end.screen.z += orientation.bias;
    emit_line(ends, primitive, orientation.front);
  }
}

void FrontEnd::emit_line(const LineEnd ends[2], const Primitive& primitive, bool front) {
  if (plan_->lines_are_rectangles) return emit_rectangle(ends, primitive, front);
  const ScreenVertex screen[3] = {ends[0].screen, ends[1].screen, ends[0].screen};
  const size_t number = triangles_.size();
  Triangle& line = triangles_.resize(number + 1)[number];
  const SetUp set_up = set_up_line(viewport_->rect, screen, line);
  if (set_up != SetUp::kDone) {
    triangles_.resize(number);
    return note(set_up);
  }
  line.flags |= viewport_flags_ | kClipped | (front ? kFrontFacing : 0u);
  bins_.add(line, slice_, static_cast<uint32_t>(number));
  if (!plan_->has_shading) return;
  add_part_shading(screen, primitive, weights_of(ends, {0, 1, 0}));
}

void FrontEnd::emit_rectangle(const LineEnd ends[2], const Primitive& primitive, bool front) {
  const ScreenVertex screen[2] = {ends[0].screen, ends[1].screen};
  ScreenVertex corners[4];
  line_rectangle(screen, corners);
  for (const auto& half : {std::array{0, 2, 1}, std::array{1, 2, 3}}) {
    const ScreenVertex part[3] = {corners[half[0]], corners[half[1]], corners[half[2]]};
    Triangle* added = emit(part, PartOf::kPointOrLine);
    if (added == nullptr) continue;
    if (!front) added->flags &= ~kFrontFacing;
    added->flags |= kClipped;
    if (!plan_->has_shading) continue;
    const bool swapped = (added->flags & kSwapped) != 0;
    const std::array of_ends = {half[0] / 2, half[swapped ? 2 : 1] / 2, half[swapped ? 1 : 2] / 2};
    add_part_shading(part, primitive, weights_of(ends, of_ends));
  }
}

}  // namespace kaamos::raster

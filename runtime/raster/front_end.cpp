// SPDX-License-Identifier: MIT
#include "runtime/raster/front_end.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace kaamos::raster {
namespace {

constexpr uint32_t kNoVertex = 0xFFFFFFFFu;

ScreenVertex project(const ClipVertex& v, const ViewportState& viewport) {
  const auto wide = [](float value) { return static_cast<double>(value); };
  const double x = v.x / v.w * wide(viewport.scale_x) + wide(viewport.offset_x);
  const double y = v.y / v.w * wide(viewport.scale_y) + wide(viewport.offset_y);
  const double z = v.z / v.w * wide(viewport.scale_z) + wide(viewport.offset_z);
  constexpr double kLargest = 0x1.fffffep127;
  return {snap(x), snap(y), static_cast<float>(std::clamp(z, -kLargest, kLargest)),
          static_cast<float>(1 / v.w)};
}

// The vertex from which the others form a fan without overlaps: snapping can make a corner of a
// polygon turn the other way.
int fan_center(const ScreenVertex* polygon, int count) {
  for (int center = 0; center < count; ++center) {
    bool clockwise = false;
    bool counter_clockwise = false;
    for (int i = 1; i + 1 < count; ++i) {
      const ScreenVertex& a = polygon[center];
      const ScreenVertex& b = polygon[(center + i) % count];
      const ScreenVertex& c = polygon[(center + i + 1) % count];
      const int64_t area = static_cast<int64_t>(b.x - a.x) * (c.y - a.y) -
                           static_cast<int64_t>(c.x - a.x) * (b.y - a.y);
      clockwise = clockwise || area > 0;
      counter_clockwise = counter_clockwise || area < 0;
    }
    if (!(clockwise && counter_clockwise)) return center;
  }
  return 0;
}

}  // namespace

void FrontEnd::run(const PrimitiveRange& range, const Draw& draw, const DrawPlan& plan,
                   const TileGrid& grid, ShaderThread& thread, Batch& batch) {
  range_ = &range;
  draw_ = &draw;
  plan_ = &plan;
  batch_ = &batch;
  batch.clear();
  batch.draw = range.draw;
  batch.instance = range.instance;
  counts_ = nullptr;
  if (plan.observed) {
    batch.counts = {};
    batch.counts.assembled = batch.counts.triangles = range.count;
    counts_ = &batch.counts;
  }
  collect_vertices();
  shade_vertices(thread);
  if (plan.has_geometry) run_geometry(thread);
  bins_.begin(grid, plan.samples > 1);
  triangles_.clear();
  triangles_.reserve(range_->count);
  if (plan.has_shading) batch.shading.reserve(range_->count);
  add_primitives();
  bins_.finish(triangles_.data(), plan.has_shading, batch);
}

// ---------------------------------------------------------------------------------------------
// Collecting vertices

void FrontEnd::collect_vertices() {
  const uint32_t corners =
      range_->strip ? range_->count + range_->corners - 1 : range_->count * range_->corners;
  uint32_t* corner = corners_.resize(corners);
  if (!draw_->indexed) {
    uint32_t* ids = ids_.resize(corners);
    for (uint32_t i = 0; i < corners; ++i) {
      corner[i] = i;
      ids[i] = static_cast<uint32_t>(range_->first + i);
    }
    return;
  }
  const Indices indices(*draw_);
  uint32_t lowest = 0xFFFFFFFFu;
  uint32_t highest = 0;
  for (uint32_t i = 0; i < corners; ++i) {
    corner[i] = indices.at(range_->first + i);
    lowest = std::min(lowest, corner[i]);
    highest = std::max(highest, corner[i]);
  }
  ids_.clear();
  if (highest - lowest < 4 * corners + 1024) {
    collect_by_range(lowest, highest - lowest + 1);
  } else {
    collect_by_hash();
  }
}

void FrontEnd::collect_by_range(uint32_t lowest, uint32_t size) {
  uint32_t* table = table_.resize(size);
  std::fill(table, table + size, kNoVertex);
  for (uint32_t& corner : corners_) {
    uint32_t& vertex = table[corner - lowest];
    if (vertex == kNoVertex) {
      vertex = static_cast<uint32_t>(ids_.size());
      ids_.push_back(corner);
    }
    corner = vertex;
  }
}

// Open addressing: slots hold numbers of vertices.
void FrontEnd::collect_by_hash() {
  const uint32_t size = std::bit_ceil(static_cast<uint32_t>(corners_.size()) * 2);
  uint32_t* table = table_.resize(size);
  std::fill(table, table + size, kNoVertex);
  for (uint32_t& corner : corners_) {
    uint32_t slot = (corner * 0x9E3779B1u) >> 7 & (size - 1);
    while (table[slot] != kNoVertex && ids_[table[slot]] != corner) slot = (slot + 1) & (size - 1);
    if (table[slot] == kNoVertex) {
      table[slot] = static_cast<uint32_t>(ids_.size());
      ids_.push_back(corner);
    }
    corner = table[slot];
  }
}

// ---------------------------------------------------------------------------------------------
// Vertices

void FrontEnd::shade_vertices(ShaderThread& thread) {
  const auto count = static_cast<uint32_t>(ids_.size());
  fetch_.bind(*draw_);
  if (plan_->has_geometry) {
    rows_in_.resize(size_t{count} * plan_->vertex_outputs);
  } else {
    reserve_vertices(count);
  }
  columns_.resize((plan_->vertex_inputs + plan_->vertex_outputs) * kGroup);
  auto* inputs = reinterpret_cast<shader::Column*>(columns_.data());
  shader::Column* outputs = inputs + plan_->vertex_inputs;
  for (uint32_t first = 0; first < count; first += kGroup) {
    const uint32_t active = std::min(kGroup, count - first);
    fetch_.read(range_->instance, ids_.data() + first, active, inputs);
    thread.vertices(range_->draw, {inputs, outputs, (1u << active) - 1});
    if (counts_ != nullptr) counts_->vertices += active;
    if (plan_->has_geometry) {
      keep_rows(first, active, outputs);
    } else {
      take_outputs(first, active, outputs);
    }
  }
}

void FrontEnd::reserve_vertices(uint32_t count) {
  const uint32_t groups = (count + kGroup - 1) / kGroup;
  clip_.resize(groups);
  screen_.resize(groups);
  distances_.resize(size_t{groups} * kGroup * plan_->clip_count);
  if (plan_->picks_viewport) viewports_.resize(groups * kGroup);
  if (plan_->picks_slice) slices_.resize(groups * kGroup);
  if (plan_->numbers_primitives) primitive_ids_.resize(groups * kGroup);
  batch_->rows.resize(size_t{count} * plan_->row_columns.size());
}

void FrontEnd::take_outputs(uint32_t first, uint32_t count, const shader::Column* outputs) {
  const runtime::VertexSystemColumns& columns = plan_->linked->vertex_columns;
  Vertices& clip = clip_[first / kGroup];
  Screen& screen = screen_[first / kGroup];
  std::memcpy(&clip, outputs[columns.position], sizeof(clip));
  clip_outcodes(clip, plan_->depth_clip, screen.outcode);
  if (counts_ != nullptr) note_vertices(first, count);
  for (uint32_t c = 0; c < plan_->clip_count; ++c) {
    for (uint32_t i = 0; i < count; ++i) {
      const auto distance = std::bit_cast<float>(outputs[columns.clip_distances[c]][i]);
      distances_[(first + i) * plan_->clip_count + c] = distance;
      if (!std::isfinite(distance)) screen.outcode[i] |= kNotFinite;
      if (distance < 0) screen.outcode[i] |= kOutClip << c;
    }
  }
  for (uint32_t c = 0; c < plan_->cull_count; ++c) {
    for (uint32_t i = 0; i < count; ++i) {
      const auto distance = std::bit_cast<float>(outputs[columns.cull_distances[c]][i]);
      if (!(distance >= 0)) screen.outcode[i] |= kOutCull << c;
    }
  }
  if (plan_->picks_viewport) {
    std::memcpy(&viewports_[first], outputs[columns.viewport_array_index], sizeof(shader::Column));
  } else {
    to_screen(clip, plan_->viewports[0], screen);
  }
  if (plan_->picks_slice) {
    std::memcpy(&slices_[first], outputs[columns.target_array_index], sizeof(shader::Column));
  }
  if (plan_->numbers_primitives) {
    std::memcpy(&primitive_ids_[first], outputs[columns.primitive_id], sizeof(shader::Column));
  }
  const auto words = static_cast<uint32_t>(plan_->row_columns.size());
  uint32_t* rows = batch_->rows.data() + size_t{first} * words;
  for (uint32_t word = 0; word < words; ++word) {
    const shader::Column& column = outputs[plan_->row_columns[word]];
    for (uint32_t i = 0; i < count; ++i) rows[i * words + word] = column[i];
  }
}

void FrontEnd::note_vertices(uint32_t first, uint32_t count) {
  const Vertices& clip = clip_[first / kGroup];
  constexpr float kFar = 1e7f;
  for (uint32_t i = 0; i < count; ++i) {
    if ((screen_[first / kGroup].outcode[i] & kNotFinite) != 0) {
      if (counts_->not_finite++ == 0) counts_->first_not_finite = ids_[first + i];
    } else if (std::max(std::fabs(clip.x[i]), std::fabs(clip.y[i])) > kFar * std::fabs(clip.w[i])) {
      if (counts_->far_away++ == 0) counts_->first_far_away = ids_[first + i];
    }
  }
}

// ---------------------------------------------------------------------------------------------
// Primitives

// Once for each primitive.
[[gnu::always_inline]] inline bool FrontEnd::begin_primitive(Primitive& primitive) {
  uint32_t all = ~0u;
  uint32_t any = 0;
  for (const uint32_t vertex : primitive.vertex) {
    const uint32_t code = screen_[vertex / kGroup].outcode[vertex % kGroup];
    all &= code;
    any |= code;
  }
  if ((all & kOutside) != 0 || (any & kNotFinite) != 0) {
    if (counts_ != nullptr)
      ++((any & kNotFinite) != 0 ? counts_->not_a_triangle : counts_->outside);
    return false;
  }
  const uint32_t leading = primitive.vertex[0];
  uint32_t number = plan_->picks_viewport ? viewports_[leading] : 0;
  if (number >= rtapi::kViewportAndScissorRectCount) number = 0;
  viewport_ = &plan_->viewports[number];
  if (viewport_->rect.empty()) {
    note(SetUp::kNoPixel);
    return false;
  }
  viewport_flags_ = number << kViewportShift;
  slice_ = plan_->picks_slice ? slices_[leading] : 0;
  if (slice_ >= plan_->slices) slice_ = 0;
  if (plan_->numbers_primitives) primitive.id = primitive_ids_[leading];
  gather(primitive.vertex, primitive.screen, any);
  primitive.codes = any;
  return true;
}

void FrontEnd::add_primitives() {
  const bool triangles = range_->corners == 3;
  each_primitive(*range_, corners_.data(), [&](const uint32_t vertex[3], uint32_t id) {
    Primitive primitive;
    primitive.id = id;
    for (int i = 0; i < 3; ++i) primitive.vertex[i] = vertex[i];
    if (!begin_primitive(primitive)) return;
    if (triangles && !plan_->wireframe) [[likely]] {
      add_triangle(primitive);
    } else if (triangles) {
      add_edges(primitive);
    } else if (range_->corners == 2) {
      add_line(primitive);
    } else {
      add_point(primitive);
    }
  });
}

void FrontEnd::add_triangle(const Primitive& primitive) {
  if ((primitive.codes & kNeedsClip) != 0) return add_clipped(primitive);
  const Triangle* added = emit(primitive.screen);
  if (added == nullptr || !plan_->has_shading) return;
  TriangleShading& shading = add_shading(primitive.screen, primitive.id);
  const bool swapped = (added->flags & kSwapped) != 0;
  shading.vertex[0] = primitive.vertex[0];
  shading.vertex[1] = primitive.vertex[swapped ? 2 : 1];
  shading.vertex[2] = primitive.vertex[swapped ? 1 : 2];
}

// If each primitive may choose its viewport, vertices are transformed here.
void FrontEnd::gather(const uint32_t vertex[3], ScreenVertex screen[3], uint32_t& codes) const {
  if (!plan_->picks_viewport) {
    for (int i = 0; i < 3; ++i) {
      const Screen& group = screen_[vertex[i] / kGroup];
      const uint32_t lane = vertex[i] % kGroup;
      screen[i] = {group.x[lane], group.y[lane], group.z[lane], group.inv_w[lane]};
    }
    return;
  }
  ClipVertices<3> clip_vertices;
  ScreenVertices<3> out;
  for (int i = 0; i < 3; ++i) {
    const Vertices& group = clip_[vertex[i] / kGroup];
    const uint32_t lane = vertex[i] % kGroup;
    clip_vertices.x[i] = group.x[lane];
    clip_vertices.y[i] = group.y[lane];
    clip_vertices.z[i] = group.z[lane];
    clip_vertices.w[i] = group.w[lane];
    out.outcode[i] = 0;
  }
  to_screen(clip_vertices, *viewport_, out);
  for (int i = 0; i < 3; ++i) {
    codes |= out.outcode[i];
    screen[i] = {out.x[i], out.y[i], out.z[i], out.inv_w[i]};
  }
}

void FrontEnd::note(SetUp set_up) {
  if (counts_ == nullptr) return;
  ++(set_up == SetUp::kZeroArea ? counts_->zero_area
     : set_up == SetUp::kCulled ? counts_->culled
                                : counts_->no_pixel);
}

Triangle* FrontEnd::emit(const ScreenVertex screen[3], PartOf part_of) {
  const size_t number = triangles_.size();
  Triangle& triangle = triangles_.resize(number + 1)[number];
  const SetUp set_up = set_up_triangle(*plan_, viewport_->rect, screen, triangle, part_of);
  if (set_up != SetUp::kDone) {
    triangles_.resize(number);
    note(set_up);
    return nullptr;
  }
  triangle.flags |= viewport_flags_;
  bins_.add(triangle, slice_, static_cast<uint32_t>(number));
  return &triangle;
}

TriangleShading& FrontEnd::add_shading(const ScreenVertex screen[3], uint32_t primitive_id) {
  const size_t number = triangles_.size() - 1;
  const bool swapped = (triangles_[number].flags & kSwapped) != 0;
  TriangleShading& shading = batch_->shading.resize(number + 1)[number];
  shading.primitive_id = primitive_id;
  shading.inv_w[0] = screen[0].inv_w;
  shading.inv_w[1] = screen[swapped ? 2 : 1].inv_w;
  shading.inv_w[2] = screen[swapped ? 1 : 2].inv_w;
  return shading;
}

void FrontEnd::add_part_shading(const ScreenVertex screen[3], const Primitive& primitive,
                                const ClipWeights& weights) {
  TriangleShading& shading = add_shading(screen, primitive.id);
  shading.clip = static_cast<uint32_t>(batch_->clips.size());
  for (int k = 0; k < 3; ++k) shading.vertex[k] = primitive.vertex[k];
  batch_->clips.push_back(weights);
}

// ---------------------------------------------------------------------------------------------
// Clipping

bool FrontEnd::clip_primitive(const Primitive& primitive, int corners, Polygon& polygon) {
  for (int i = 0; i < 3; ++i) {
    const uint32_t vertex = primitive.vertex[i];
    const Vertices& group = clip_[vertex / kGroup];
    const uint32_t lane = vertex % kGroup;
    ClipVertex& v = polygon.vertex[i];
    v.x = static_cast<double>(group.x[lane]);
    v.y = static_cast<double>(group.y[lane]);
    v.z = static_cast<double>(group.z[lane]);
    v.w = static_cast<double>(group.w[lane]);
    for (int k = 0; k < 3; ++k) v.weight[k] = i == k ? 1 : 0;
    for (uint32_t k = 0; k < plan_->clip_count; ++k) {
      v.distance[k] = static_cast<double>(distances_[vertex * plan_->clip_count + k]);
    }
    polygon.original_w[i] = static_cast<float>(v.w);
  }
  polygon.count = clip({plan_->depth_clip, plan_->clip_count, primitive.codes / kOutClip & 0xFF},
                       *viewport_, corners, polygon.vertex);
  if (polygon.count == 0) {
    if (counts_ != nullptr) ++counts_->outside;
    return false;
  }
  for (int i = 0; i < polygon.count; ++i) {
    const double* weight = polygon.vertex[i].weight;
    // A corner that was not cut off stays where it is for primitives that are not cut.
    const int corner = weight[0] == 1 ? 0 : weight[1] == 1 ? 1 : weight[2] == 1 ? 2 : -1;
    polygon.screen[i] =
        corner >= 0 ? primitive.screen[corner] : project(polygon.vertex[i], *viewport_);
  }
  return true;
}

// The cut polygon as a fan.
void FrontEnd::add_clipped(const Primitive& primitive) {
  Polygon polygon;
  if (!clip_primitive(primitive, 3, polygon)) return;
  const int count = polygon.count;
  const int first = fan_center(polygon.screen, count);
  for (int i = 1; i + 1 < count; ++i) {
    const int part[3] = {first, (first + i) % count, (first + i + 1) % count};
    const ScreenVertex corners[3] = {polygon.screen[part[0]], polygon.screen[part[1]],
                                     polygon.screen[part[2]]};
    Triangle* added = emit(corners);
    if (added == nullptr) continue;
    added->flags |= kClipped;
    if (!plan_->has_shading) continue;
    const bool swapped = (added->flags & kSwapped) != 0;
    const int order[3] = {part[0], part[swapped ? 2 : 1], part[swapped ? 1 : 2]};
    ClipWeights weights;
    for (int v = 0; v < 3; ++v)
      polygon.weights_of(order[v], weights.perspective[v], weights.screen[v]);
    add_part_shading(corners, primitive, weights);
  }
}

}  // namespace kaamos::raster

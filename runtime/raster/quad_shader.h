// SPDX-License-Identifier: MIT
//
// Runs the pixel shader on quads of one triangle, two at a time: attributes, late tests,
// render targets.
#pragma once

#include <algorithm>
#include <bit>

#include "runtime/raster/observer.h"
#include "runtime/raster/output_merger.h"
#include "runtime/raster/pixel_depth.h"
#include "runtime/raster/pixel_stencil.h"
#include "runtime/raster/tile.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

// Centres of two quads' pixels in subpixels, from the first pixel's corner.
inline constexpr int32_t kQuadCenterX[8] = {128, 384, 128, 384, 128, 384, 128, 384};
inline constexpr int32_t kQuadCenterY[8] = {128, 128, 384, 384, 128, 128, 384, 384};

// Weights of the primitive's vertices 1 and 2, in the order of Triangle::vertex.
struct Weights8 {
  Floats8 first, second;
};

class QuadShader {
 public:
  QuadShader(const TileJob& job, TileScratch& scratch, ShaderThread& thread)
      : job_(job), scratch_(scratch), thread_(thread) {}

  void begin_batch(const Batch& batch, const DrawPlan& plan) {
    batch_ = &batch;
    plan_ = &plan;
    constexpr size_t kColumn = shader::kGraphicsLanes;
    scratch_.columns.resize((plan.pixel_inputs + plan.pixel_outputs) * kColumn);
    inputs_ = reinterpret_cast<shader::Column*>(scratch_.columns.data());
    outputs_ = inputs_ + plan.pixel_inputs;
    linear_words_ = plan.linear.size() + plan.screen_linear.size();
    scratch_.attributes.resize(3 * linear_words_);
  }
  void begin_triangle(const Triangle& triangle, const TriangleShading& shading) {
    triangle_ = &triangle;
    shading_ = &shading;
    is_set_up_ = false;
  }
  // Runs what waits in the queue.
  void flush() {
    QuadQueue& queue = scratch_.queue;
    if (queue.count == 0) return;
    if (!is_set_up_) set_up();
    for (uint32_t i = 0; i < queue.count; i += 2) shade(i, i + 1 < queue.count);
    queue.count = 0;
  }

 protected:
  void set_up();
  void set_up_attributes();
  // Whether vertices 1 and 2 are the primitive's 2 and 1.
  bool swaps_vertices() const { return (triangle_->flags & (kSwapped | kClipped)) == kSwapped; }
  bool tests_late() const { return plan_->late_test || plan_->late_write; }
  void shade(uint32_t first, bool pair);
  KAAMOS_INLINE void set_attributes(const QuadPlaces& places);
  // Exact values of the two edges and of what they leave of the area, at the pixels of two quads.
  struct Edges8 {
    Floats8 first, second, rest;
  };
  KAAMOS_INLINE Edges8 edges_at(const int32_t x[2], const int32_t y[2]) const;
  // Attributes [begin, end) of a list; `first`: the list's place among the differences.
  KAAMOS_INLINE void interpolate(const std::vector<RowAttribute>& attributes, size_t begin,
                                 size_t end, size_t first, const Weights8& weights);
  KAAMOS_INLINE void set_barycentrics(const Weights8& weights);
  void finish_observed(uint32_t first, bool pair, const QuadPlaces& places, uint32_t live);
  float alpha_of(uint32_t lane) const;
  uint32_t kept_by_output(uint32_t live) const;
  uint32_t test_late(uint32_t first, bool pair, uint32_t live);
  uint32_t test_late_depth(uint32_t first, bool pair, uint32_t live);
  void load_stencil(uint32_t first, bool pair, uint8_t stored[8]) const;
  template <DepthKind kKind>
  uint32_t test_late_as(uint32_t* quads[2], const Floats8& z, uint32_t live) const;

  const TileJob& job_;
  TileScratch& scratch_;
  ShaderThread& thread_;
  const Batch* batch_ = nullptr;
  const DrawPlan* plan_ = nullptr;
  const Triangle* triangle_ = nullptr;
  const TriangleShading* shading_ = nullptr;
  const ClipWeights* clip_ = nullptr;  // null: not clipped
  shader::Column* inputs_ = nullptr;
  shader::Column* outputs_ = nullptr;
  size_t linear_words_ = 0;
  bool is_set_up_ = false;

  // set_up() computes these for the triangle.
  int32_t edge_[2][2];  // of vertices 1 and 2: by x and y, from vertex 0, in subpixels
  int64_t area_;
  Ints8 in_quad_[2];  // of small triangles: what the edges add from a quad's corner
  float inv_area_;
  float inv_w_[3];  // scaled so that the largest is between 1 and 2
  float inv_w_scale_;
  bool affine_;  // all w are the same
};

inline void QuadShader::set_up() {
  is_set_up_ = true;
  const Triangle& t = *triangle_;
  const int32_t dx1 = t.x[1] - t.x[0], dy1 = t.y[1] - t.y[0];
  const int32_t dx2 = t.x[2] - t.x[0], dy2 = t.y[2] - t.y[0];
  edge_[0][0] = dy2;
  edge_[0][1] = -dx2;
  edge_[1][0] = -dy1;
  edge_[1][1] = dx1;
  area_ = static_cast<int64_t>(dx1) * dy2 - static_cast<int64_t>(dx2) * dy1;
  inv_area_ = static_cast<float>(1 / static_cast<double>(area_));
  if ((t.flags & kSmall) != 0) {
    for (int i = 0; i < 2; ++i) {
      in_quad_[i] = splat(edge_[i][0]) * load<int32_t>(kQuadCenterX) +
                    splat(edge_[i][1]) * load<int32_t>(kQuadCenterY);
    }
  }
  const float* inv_w = shading_->inv_w;
  const float largest = std::max({inv_w[0], inv_w[1], inv_w[2]});
  // A power of 2: nothing rounds.
  const uint32_t exponent = std::bit_cast<uint32_t>(largest) & 0x7F800000u;
  inv_w_scale_ = std::bit_cast<float>(0x7F000000u - exponent);
  for (int i = 0; i < 3; ++i) inv_w_[i] = inv_w[i] * inv_w_scale_;
  affine_ = inv_w[0] == inv_w[1] && inv_w[0] == inv_w[2];
  clip_ = (t.flags & kClipped) != 0 ? &batch_->clips[shading_->clip] : nullptr;
  set_up_attributes();
}

inline void QuadShader::set_up_attributes() {
  const Triangle& t = *triangle_;
  const size_t words = plan_->row_columns.size();
  const uint32_t* rows[3];
  for (int i = 0; i < 3; ++i) rows[i] = batch_->rows.data() + shading_->vertex[i] * words;
  float* base = scratch_.attributes.data();
  float* first = base + linear_words_;
  float* second = first + linear_words_;
  for (size_t i = 0; i < linear_words_; ++i) {
    const auto value = std::bit_cast<float>(rows[0][i]);
    base[i] = value;
    first[i] = std::bit_cast<float>(rows[1][i]) - value;
    second[i] = std::bit_cast<float>(rows[2][i]) - value;
  }
  const uint32_t of_second = swaps_vertices() ? 2 : 1;
  const uint32_t* of_primitive[3] = {rows[0], rows[of_second], rows[3 - of_second]};
  for (const RowAttribute& attribute : plan_->flat) {
    const uint32_t bits = of_primitive[attribute.vertex][attribute.word];
    store(inputs_[attribute.pixel_column], splat(static_cast<int32_t>(bits)));
  }
  const runtime::PixelSystemColumns& columns = plan_->linked->pixel_columns;
  if (columns.sample_index != runtime::kNoColumn) store(inputs_[columns.sample_index], Ints8{});
  if (columns.sample_count != runtime::kNoColumn) {
    store(inputs_[columns.sample_count], splat(static_cast<int32_t>(plan_->samples)));
  }
  if (columns.primitive_id != runtime::kNoColumn) {
    store(inputs_[columns.primitive_id], splat(static_cast<int32_t>(shading_->primitive_id)));
  }
  if (columns.is_front_face != runtime::kNoColumn) {
    store(inputs_[columns.is_front_face], splat((t.flags & kFrontFacing) != 0 ? -1 : 0));
  }
}

inline void QuadShader::shade(uint32_t first, bool pair) {
  const QuadQueue& queue = scratch_.queue;
  const uint32_t second = pair ? first + 1 : first;
  const QuadPlaces places = {{queue.quad[first], queue.quad[second]}};
  set_attributes(places);
  const auto& columns = plan_->linked->pixel_columns;
  if (columns.position != runtime::kNoColumn && columns.position_components > 2) {
    float* z = reinterpret_cast<float*>(inputs_[columns.position + 2]);
    __builtin_memcpy(z, queue.z + first * 4, 16);
    __builtin_memcpy(z + 4, queue.z + second * 4, 16);
  }
  const uint32_t covered =
      queue.covered[first] | (pair ? static_cast<uint32_t>(queue.covered[second]) << 4 : 0u);
  if (columns.coverage_in != runtime::kNoColumn) {
    for (uint32_t i = 0; i < 8; ++i) inputs_[columns.coverage_in][i] = covered >> i & 1;
  }
  shader::PixelLanes pixel_lanes{inputs_, outputs_, pair ? 0xFFu : 0xFu, covered};
  thread_.pixels(batch_->draw, pixel_lanes);
  uint32_t live = pixel_lanes.live & covered;
  if (plan_->masks_output) live = kept_by_output(live);
  if (scratch_.observer != nullptr) [[unlikely]] {
    return finish_observed(first, pair, places, live);
  }
  if (live != 0 && tests_late()) live = test_late(first, pair, live);
  if (live != 0) write_targets(*plan_, scratch_.colors, places, outputs_, live);
}

inline QuadShader::Edges8 QuadShader::edges_at(const int32_t x[2], const int32_t y[2]) const {
  const Triangle& t = *triangle_;
  int32_t dx[2], dy[2];
  for (int i = 0; i < 2; ++i) {
    dx[i] = x[i] * kSubpixels - t.x[0];
    dy[i] = y[i] * kSubpixels - t.y[0];
  }
  if ((t.flags & kSmall) != 0) {
    const auto edge = [&](int k) KAAMOS_INLINE_LAMBDA {
      const auto corner = [&](int i) { return edge_[k][0] * dx[i] + edge_[k][1] * dy[i]; };
      return splat(corner(0), corner(1)) + in_quad_[k];
    };
    const Ints8 first = edge(0);
    const Ints8 second = edge(1);
    const Ints8 rest = splat(static_cast<int32_t>(area_)) - first - second;
    return {to_floats(first), to_floats(second), to_floats(rest)};
  }
  const auto from_corner = [](const int32_t corner[2],
                              const int32_t* centers) KAAMOS_INLINE_LAMBDA {
    return doubles(static_cast<double>(corner[0]), static_cast<double>(corner[1])) +
           load_ints(centers);
  };
  const Doubles8 from_x = from_corner(dx, kQuadCenterX);
  const Doubles8 from_y = from_corner(dy, kQuadCenterY);
  const auto edge = [&](int k) KAAMOS_INLINE_LAMBDA {
    return doubles(static_cast<double>(edge_[k][0])) * from_x +
           doubles(static_cast<double>(edge_[k][1])) * from_y;
  };
  const Doubles8 first = edge(0);
  const Doubles8 second = edge(1);
  return {to_floats(first), to_floats(second),
          to_floats(doubles(static_cast<double>(area_)) - first - second)};
}

// Does what shade() does after the pixel shader, and tells the observer.
inline void QuadShader::finish_observed(uint32_t first, bool pair, const QuadPlaces& places,
                                        uint32_t live) {
  const QuadQueue& queue = scratch_.queue;
  const uint32_t covered =
      queue.covered[first] | (pair ? static_cast<uint32_t>(queue.covered[first + 1]) << 4 : 0u);
  const bool late = tests_late();
  const bool stencil = plan_->late_test && plan_->stencil != nullptr;
  uint8_t stored_stencil[8] = {};
  uint32_t failed_stencil = 0;
  if (stencil) {
    load_stencil(first, pair, stored_stencil);
    failed_stencil = live & ~StencilTest(*plan_->stencil, *triangle_).run(stored_stencil, live);
  }
  uint32_t stored[8] = {};
  if (late) {
    for (uint32_t i = 0; i < (pair ? 2u : 1u); ++i) {
      __builtin_memcpy(stored + 4 * i, scratch_.depth.words + queue.quad[first + i] * 4, 16);
    }
  }
  uint32_t written = live;
  if (live != 0 && late) written = test_late(first, pair, live);
  TileObserver& observer = *scratch_.observer;
  observer.before_write(queue.quad + first, pair);
  if (written != 0) write_targets(*plan_, scratch_.colors, places, outputs_, written);
  observer.shaded(*triangle_, {queue.quad + first, pair, covered, live, written, outputs_,
                               late && plan_->depth != DepthKind::kNone ? stored : nullptr,
                               stencil ? stored_stencil : nullptr, failed_stencil});
}

inline void QuadShader::set_attributes(const QuadPlaces& places) {
  const auto& columns = plan_->linked->pixel_columns;
  const bool position = columns.position != runtime::kNoColumn;
  if (!plan_->needs_perspective && !plan_->needs_screen && !position) return;
  int32_t x[2], y[2];
  for (int i = 0; i < 2; ++i) {
    x[i] = static_cast<int32_t>(job_.x + places.quad[i] % kQuadsPerRow * 2);
    y[i] = static_cast<int32_t>(job_.y + places.quad[i] / kQuadsPerRow * 2);
  }
  if (position) {
    const auto pixel = [](const int32_t quad[2], const int32_t* centers) KAAMOS_INLINE_LAMBDA {
      return to_floats(splat(quad[0] * kSubpixels, quad[1] * kSubpixels) + load<int32_t>(centers)) *
             splat(1.0f / kSubpixels);
    };
    store(inputs_[columns.position], pixel(x, kQuadCenterX));
    if (columns.position_components > 1) {
      store(inputs_[columns.position + 1], pixel(y, kQuadCenterY));
    }
  }
  if (!plan_->needs_perspective && !plan_->needs_screen) return;

  const Edges8 edges = edges_at(x, y);
  const Floats8 inv_area = splat(inv_area_);
  const Weights8 screen{edges.first * inv_area, edges.second * inv_area};
  Weights8 perspective = screen;
  if (plan_->needs_perspective) {
    const Floats8 screen0 = edges.rest * inv_area;
    const Floats8 first = screen.first * splat(inv_w_[1]);
    const Floats8 second = screen.second * splat(inv_w_[2]);
    const Floats8 inv_sum = splat(1.0f) / (screen0 * splat(inv_w_[0]) + first + second);
    if (!affine_) perspective = {first * inv_sum, second * inv_sum};
    if (position && columns.position_components > 3) {
      store(inputs_[columns.position + 3], inv_sum * splat(inv_w_scale_));
    }
  }
  const auto of_primitive = [](const Weights8& w, const float of[3][3]) {
    const auto weight = [&](int k) {
      return splat(of[0][k]) + w.first * splat(of[1][k] - of[0][k]) +
             w.second * splat(of[2][k] - of[0][k]);
    };
    return Weights8{weight(1), weight(2)};
  };
  if (plan_->needs_perspective) {
    if (clip_ != nullptr) perspective = of_primitive(perspective, clip_->perspective);
    interpolate(plan_->linear, 0, plan_->linear.size(), 0, perspective);
  }
  Weights8 on_screen = screen;
  if (plan_->needs_screen) {
    // A part's weights on the screen are linear there, too.
    if (clip_ != nullptr) on_screen = of_primitive(screen, clip_->screen);
    interpolate(plan_->screen_linear, 0, plan_->screen_linear.size(), plan_->linear.size(),
                on_screen);
  }
  if (columns.barycentrics != runtime::kNoColumn) {
    set_barycentrics(columns.barycentrics_no_perspective ? on_screen : perspective);
  }
}

inline void QuadShader::interpolate(const std::vector<RowAttribute>& attributes, size_t begin,
                                    size_t end, size_t first, const Weights8& weights) {
  const float* base = scratch_.attributes.data() + first;
  const float* d1 = base + linear_words_;
  const float* d2 = d1 + linear_words_;
  for (size_t i = begin; i < end; ++i) {
    store(inputs_[attributes[i].pixel_column],
          splat(base[i]) + weights.first * splat(d1[i]) + weights.second * splat(d2[i]));
  }
}

inline void QuadShader::set_barycentrics(const Weights8& weights) {
  const auto& columns = plan_->linked->pixel_columns;
  const bool swapped = swaps_vertices();
  const Floats8& first = swapped ? weights.second : weights.first;
  const Floats8& second = swapped ? weights.first : weights.second;
  shader::Column* out = inputs_ + columns.barycentrics;
  store(out[0], splat(1.0f) - weights.first - weights.second);
  if (columns.barycentric_components > 1) store(out[1], first);
  if (columns.barycentric_components > 2) store(out[2], second);
}

template <DepthKind kKind>
inline uint32_t QuadShader::test_late_as(uint32_t* quads[2], const Floats8& z,
                                         uint32_t live) const {
  const ViewportState& viewport = plan_->viewports[triangle_->flags >> kViewportShift];
  // Pixels that were tested early pass here.
  const uint32_t func = plan_->late_test ? plan_->depth_func : 7;
  const DepthTest<kKind> test(func, viewport.depth_low, viewport.depth_high);
  return bits_of(test.run(quads[0], quads[1], z, lanes_of(live), plan_->late_write));
}

// What alpha to coverage reads. Without target 0 every sample stays; alpha that the shader does not
// write is 0. [RAS-111]
inline float QuadShader::alpha_of(uint32_t lane) const {
  const auto& target = plan_->linked->pixel_columns.targets[0];
  if (target.first_column == runtime::kNoColumn) return 1;
  return target.components < 4 ? 0 : std::bit_cast<float>(outputs_[target.first_column + 3][lane]);
}

// Those of `live` whose one sample the shader's outputs keep.
inline uint32_t QuadShader::kept_by_output(uint32_t live) const {
  const runtime::LinkedGraphics& linked = *plan_->linked;
  const uint32_t coverage = linked.pixel_columns.coverage_out;
  for (uint32_t bits = live; bits != 0; bits &= bits - 1) {
    const auto i = static_cast<uint32_t>(std::countr_zero(bits));
    bool kept = coverage == runtime::kNoColumn || (outputs_[coverage][i] & 1) != 0;
    if (linked.alpha_to_coverage) kept = kept && alpha_of(i) > 0.5f;
    if (!kept) live &= ~(1u << i);
  }
  return live;
}

inline void QuadShader::load_stencil(uint32_t first, bool pair, uint8_t stored[8]) const {
  const QuadQueue& queue = scratch_.queue;
  for (uint32_t i = 0; i < (pair ? 2u : 1u); ++i) {
    __builtin_memcpy(stored + 4 * i, scratch_.stencil.bytes + queue.quad[first + i] * 4, 4);
  }
}

inline uint32_t QuadShader::test_late(uint32_t first, bool pair, uint32_t live) {
  // Stencil that was tested early is done.
  if (!plan_->late_test || plan_->stencil == nullptr) return test_late_depth(first, pair, live);
  const StencilTest stencil(*plan_->stencil, *triangle_);
  uint8_t stored[8] = {};
  load_stencil(first, pair, stored);
  const uint32_t passed = stencil.run(stored, live);
  const uint32_t passed_depth = passed == 0 ? 0 : test_late_depth(first, pair, passed);
  stencil.update(stored, live, passed, passed_depth);
  const QuadQueue& queue = scratch_.queue;
  for (uint32_t i = 0; i < (pair ? 2u : 1u); ++i) {
    __builtin_memcpy(scratch_.stencil.bytes + queue.quad[first + i] * 4, stored + 4 * i, 4);
  }
  return passed_depth;
}

inline uint32_t QuadShader::test_late_depth(uint32_t first, bool pair, uint32_t live) {
  const QuadQueue& queue = scratch_.queue;
  uint32_t alone[4] = {};  // where there is no second quad
  uint32_t* quads[2] = {scratch_.depth.words + queue.quad[first] * 4,
                        pair ? scratch_.depth.words + queue.quad[first + 1] * 4 : alone};
  Floats8 z;
  if (plan_->reads_depth_output) {
    z = load<float>(outputs_[plan_->linked->pixel_columns.depth]);
  } else {
    float values[8] = {};
    __builtin_memcpy(values, queue.z + first * 4, pair ? 32 : 16);
    z = load<float>(values);
  }
  switch (plan_->depth) {
    case DepthKind::kFloat32:
      return test_late_as<DepthKind::kFloat32>(quads, z, live);
    case DepthKind::kUnorm16:
      return test_late_as<DepthKind::kUnorm16>(quads, z, live);
    case DepthKind::kUnorm24:
      return test_late_as<DepthKind::kUnorm24>(quads, z, live);
    default:
      return live;
  }
}

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL

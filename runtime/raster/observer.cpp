// SPDX-License-Identifier: MIT
#include "runtime/raster/observer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace kaamos::raster {
namespace {

// Lanes 0 to 3 of a quad: (0, 0), (1, 0), (0, 1), (1, 1).
uint32_t quad_x(uint32_t quad) {
  return quad % kQuadsPerRow * 2;
}
uint32_t quad_y(uint32_t quad) {
  return quad / kQuadsPerRow * 2;
}

uint32_t count(uint32_t bits) {
  return static_cast<uint32_t>(std::popcount(bits));
}

// Weights of the triangle's corners at the centre of a pixel, in the order of the primitive unless
// it is clipped.
void set_weights(const Triangle& t, uint32_t x, uint32_t y, float out[3]) {
  const double px = static_cast<double>(x) * kSubpixels + kPixelCenter - t.x[0];
  const double py = static_cast<double>(y) * kSubpixels + kPixelCenter - t.y[0];
  const double dx1 = t.x[1] - t.x[0], dy1 = t.y[1] - t.y[0];
  const double dx2 = t.x[2] - t.x[0], dy2 = t.y[2] - t.y[0];
  const double area = dx1 * dy2 - dx2 * dy1;
  const double first = (px * dy2 - py * dx2) / area;
  const double second = (py * dx1 - px * dy1) / area;
  const bool swapped = (t.flags & kSwapped) != 0;
  out[0] = static_cast<float>(1 - first - second);
  out[1] = static_cast<float>(swapped ? second : first);
  out[2] = static_cast<float>(swapped ? first : second);
}

}  // namespace

void TileObserver::begin_tile(const TileJob& job, TileColors& colors) {
  job_ = &job;
  colors_ = &colors;
  observation_ = job.observation;
  batch_ = nullptr;
  plan_ = nullptr;
  draw_ = nullptr;
  counts_ = {};
  logged_ = nullptr;
}

void TileObserver::end_tile() {
  finish_draw();
}

void TileObserver::finish_draw() {
  if (draw_ == nullptr) return;
  const std::lock_guard lock(observation_->mutex);
  draw_->counts.add(counts_);
  counts_ = {};
  draw_ = nullptr;
}

void TileObserver::begin_batch(const Batch& batch, const DrawPlan& plan) {
  Observation::OfDraw& draw = observation_->draws[batch.draw];
  if (&draw != draw_) {
    finish_draw();
    draw_ = &draw;
  }
  batch_ = &batch;
  plan_ = &plan;
  logged_ = nullptr;
  map_ = nullptr;
  log_ = nullptr;
  if (!draw.noted) return;
  if (observation_->map != nullptr && observation_->map->slice == job_->slice) {
    map_ = observation_->map;
  }
  const runtime::PixelLog* log = observation_->log;
  if (log == nullptr || log->slice != job_->slice) return;
  const uint32_t x = log->x - job_->x;
  const uint32_t y = log->y - job_->y;
  if (x >= kTileSize || y >= kTileSize) return;
  log_ = observation_->log;
  log_quad_ = y / 2 * kQuadsPerRow + x / 2;
  log_lane_ = (x & 1) + (y & 1) * 2;
}

runtime::PixelCounts* TileObserver::pixel(uint32_t quad, uint32_t lane) const {
  const uint32_t x = job_->x + quad_x(quad) + (lane & 1);
  const uint32_t y = job_->y + quad_y(quad) + (lane >> 1);
  if (map_ == nullptr || x >= map_->width || y >= map_->height) return nullptr;
  return &map_->pixels[size_t{y} * map_->width + x];
}

float TileObserver::depth_of(uint32_t word) const {
  switch (plan_->depth) {
    case DepthKind::kUnorm16:
      return static_cast<float>(word & 0xFFFFu) / 65535.0f;
    case DepthKind::kUnorm24:
      return static_cast<float>(static_cast<double>(word & 0xFFFFFFu) / 16777215.0);
    default:
      return std::bit_cast<float>(word);
  }
}

// Returns the depth that the test compares. [pixel_depth.h]
float TileObserver::converted(float z, const Triangle& triangle) const {
  const ViewportState& viewport = plan_->viewports[triangle.flags >> kViewportShift];
  if (z < viewport.depth_low) z = viewport.depth_low;
  if (z > viewport.depth_high) z = viewport.depth_high;
  if (plan_->depth == DepthKind::kUnorm16) {
    return depth_of(static_cast<uint32_t>(z * 65535.0f + 0.5f));
  }
  if (plan_->depth == DepthKind::kUnorm24) {
    return depth_of(static_cast<uint32_t>(static_cast<double>(z) * 16777215.0 + 0.5));
  }
  return z;
}

runtime::PixelEvent TileObserver::begin_event(const Triangle& triangle) const {
  runtime::PixelEvent event;
  event.draw = draw_->number;
  event.instance = batch_->instance;
  event.primitive_id = shading_->primitive_id;
  event.front_facing = (triangle.flags & kFrontFacing) != 0;
  event.culled = (triangle.flags & kCulled) != 0;
  set_weights(triangle, log_->x, log_->y, event.weights);
  const double x = static_cast<double>(log_->x) * kSubpixels + kPixelCenter - triangle.x[0];
  const double y = static_cast<double>(log_->y) * kSubpixels + kPixelCenter - triangle.y[0];
  event.z = static_cast<float>(static_cast<double>(triangle.z[0]) + triangle.dz_dy * y +
                               triangle.dz_dx * x);
  return event;
}

void TileObserver::block(const Triangle& triangle, const ObservedBlock& block) {
  const bool culled = (triangle.flags & kCulled) != 0;
  const bool tested = block.stored_depth != nullptr && plan_->early_test;
  if (!culled) {
    counts_.covered += count(block.covered);
    counts_.failed_stencil += count(block.failed_stencil);
    counts_.failed_depth += count(block.covered & ~block.passed & ~block.failed_stencil);
    if (!plan_->has_pixel) counts_.written += count(block.passed);
    for (uint32_t bits = map_ == nullptr ? 0 : block.covered; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<uint32_t>(std::countr_zero(bits));
      runtime::PixelCounts* at = pixel(block.quad + lane / 4, lane % 4);
      if (at == nullptr) continue;
      ++at->covered;
      if (!plan_->has_pixel && (block.passed >> lane & 1) != 0) ++at->written;
    }
  }
  if (log_ == nullptr || log_quad_ / 2 != block.quad / 2) return;
  const uint32_t lane = (log_quad_ - block.quad) * 4 + log_lane_;
  if ((block.covered >> lane & 1) == 0) return;
  runtime::PixelEvent event = begin_event(triangle);
  if (block.z != nullptr) event.z = block.z[lane];
  const bool failed_stencil = (block.failed_stencil >> lane & 1) != 0;
  if (block.stored_stencil != nullptr) {
    event.stencil_tested = true;
    event.stored_stencil = block.stored_stencil[lane];
    event.stencil_passed = !failed_stencil;
  }
  if (tested && !failed_stencil) {
    event.tested = true;
    event.tested_depth = converted(event.z, triangle);
    event.stored_depth = depth_of(block.stored_depth[lane]);
    event.passed = (block.passed >> lane & 1) != 0;
    event.writes_depth = event.passed && plan_->early_write;
  }
  event.written = !culled && !plan_->has_pixel && event.stencil_passed && event.passed;
  log_->events.push_back(std::move(event));
  logged_ = &triangle;
}

void TileObserver::read_texels(std::array<uint8_t, 16> runtime::TexelChange::*into) {
  texel_count_ = 0;
  for (const PlannedTarget& target : plan_->targets) {
    runtime::TexelChange& change = texels_[texel_count_++];
    change.slot = target.slot;
    change.format = job_->targets->color[target.slot].format;
    const uint32_t words = target.codec->words;
    const uint32_t* from = colors_->words(target.slot) + log_quad_ * words * 4 + log_lane_;
    uint32_t texel[4] = {};
    for (uint32_t w = 0; w < std::min(words, 4u); ++w) texel[w] = from[size_t{w} * 4];
    std::memcpy((change.*into).data(), texel, sizeof texel);
  }
}

void TileObserver::before_write(const uint16_t* quad, bool pair) {
  if (log_ == nullptr) return;
  if (quad[0] == log_quad_ || (pair && quad[1] == log_quad_)) {
    read_texels(&runtime::TexelChange::before);
  }
}

void TileObserver::note_odd(const ObservedQuads& quads) {
  const auto note = [&](const shader::Column* columns, uint32_t components, bool infinities,
                        runtime::OddOutputs& odd) {
    for (uint32_t bits = quads.live; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<uint32_t>(std::countr_zero(bits));
      bool is_nan = false;
      bool is_infinite = false;
      for (uint32_t c = 0; c < components; ++c) {
        const auto value = std::bit_cast<float>(columns[c][lane]);
        is_nan = is_nan || std::isnan(value);
        is_infinite = is_infinite || (infinities && std::isinf(value));
      }
      if (!is_nan && !is_infinite) continue;
      if (odd.not_a_number + odd.infinite == 0) {
        const uint32_t quad = quads.quad[lane / 4];
        odd.first = {job_->x + quad_x(quad) + (lane & 1), job_->y + quad_y(quad) + (lane >> 1 & 1),
                     shading_->primitive_id};
      }
      ++(is_nan ? odd.not_a_number : odd.infinite);
    }
  };
  for (const PlannedTarget& target : plan_->targets) {
    if (target.codec->integer) continue;
    // Normalized formats clamp infinities.
    const bool normalized = target.codec->clamped || target.codec->clamped_signed;
    note(quads.outputs + target.first_column, target.components, !normalized,
         counts_.targets[target.slot]);
  }
  if (plan_->reads_depth_output) {
    note(quads.outputs + plan_->linked->pixel_columns.depth, 1, false, counts_.depth);
  }
}

void TileObserver::shaded(const Triangle& triangle, const ObservedQuads& quads) {
  counts_.shaded += count(quads.covered);
  counts_.discarded += count(quads.covered & ~quads.live);
  counts_.failed_stencil += count(quads.failed_stencil);
  counts_.failed_depth += count(quads.live & ~quads.written & ~quads.failed_stencil);
  counts_.written += count(quads.written);
  note_odd(quads);
  for (uint32_t bits = map_ == nullptr ? 0 : quads.covered; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<uint32_t>(std::countr_zero(bits));
    runtime::PixelCounts* at = pixel(quads.quad[lane / 4], lane % 4);
    if (at == nullptr) continue;
    ++at->shaded;
    if ((quads.written >> lane & 1) != 0) ++at->written;
  }
  if (log_ == nullptr || logged_ != &triangle) return;
  for (uint32_t i = 0; i < (quads.pair ? 2u : 1u); ++i) {
    const uint32_t lane = i * 4 + log_lane_;
    if (quads.quad[i] != log_quad_ || (quads.covered >> lane & 1) == 0) continue;
    runtime::PixelEvent& event = log_->events.back();
    event.shaded = true;
    event.discarded = (quads.live >> lane & 1) == 0;
    for (uint32_t c = 0; c < plan_->pixel_outputs; ++c) {
      event.outputs.push_back(quads.outputs[c][lane]);
    }
    event.written = (quads.written >> lane & 1) != 0;
    const bool failed_stencil = (quads.failed_stencil >> lane & 1) != 0;
    if (!event.discarded && quads.stored_stencil != nullptr) {
      event.stencil_tested = true;
      event.late = true;
      event.stored_stencil = quads.stored_stencil[lane];
      event.stencil_passed = !failed_stencil;
    }
    if (!event.discarded && !failed_stencil && quads.stored_depth != nullptr) {
      const float z =
          plan_->reads_depth_output
              ? std::bit_cast<float>(quads.outputs[plan_->linked->pixel_columns.depth][lane])
              : event.z;
      if (plan_->late_test) {
        event.tested = true;
        event.late = true;
        event.stored_depth = depth_of(quads.stored_depth[lane]);
        event.tested_depth = converted(z, triangle);
        event.passed = event.written;
      }
      event.writes_depth = event.written && plan_->late_write;
    }
    if (!event.written) continue;
    read_texels(&runtime::TexelChange::after);
    event.texels.assign(texels_, texels_ + texel_count_);
  }
}

}  // namespace kaamos::raster

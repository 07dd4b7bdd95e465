// SPDX-License-Identifier: MIT
//
// Runs the pixel shader on quads of one triangle in targets with several samples: once for a pixel
// or once for each sample; then late tests and colours sample by sample. [D3D11.3: 3.5.7, 16, 17]
#pragma once

#include <cmath>

#include "runtime/raster/multisample_scratch.h"
#include "runtime/raster/quad_shader.h"

namespace kaamos::raster::KAAMOS_RASTER_LEVEL {

class MultisampleShader : public QuadShader {
 public:
  MultisampleShader(const TileJob& job, TileScratch& scratch, ShaderThread& thread)
      : QuadShader(job, scratch, thread),
        all_(*scratch.multisampled),
        positions_(sample_positions(job.targets->samples)) {}

  // Shades what MultisampleScratch has of the triangle.
  void run() {
    set_up();
    if (!plan_->runs_per_sample) return each_pair(kEverySample);
    for (uint32_t s = 0; s < plan_->samples; ++s) each_pair(s);
  }
  // Runs of the shader, without helpers, and the samples that they left.
  uint64_t shaded() const { return shaded_; }
  uint64_t written() const { return written_; }

 private:
  static constexpr uint32_t kEverySample = ~0u;

  // Two quads, or the same one twice.
  struct Pair {
    QuadPlaces places;
    bool two = false;
    uint32_t covered[2] = {};  // as in MultisampleScratch
    uint32_t passed[2] = {};
    uint32_t sample = kEverySample;

    // Bits of the eight pixels whose sample s is in `bits`.
    uint32_t lanes_of_sample(const uint32_t bits[2], uint32_t s) const {
      return (bits[0] >> 4 * s & 0xF) | (bits[1] >> 4 * s & 0xF) << 4;
    }
    // The samples of a pixel in `bits`, a bit each.
    uint32_t samples_of_lane(const uint32_t bits[2], uint32_t lane) const {
      uint32_t out = 0;
      for (uint32_t s = 0; s < kMostSamples; ++s) {
        out |= (bits[lane / 4] >> (4 * s + lane % 4) & 1) << s;
      }
      return out;
    }
  };

  void each_pair(uint32_t sample) {
    const uint32_t wanted = sample == kEverySample ? ~0u : 0xFu << 4 * sample;
    Pair pair;
    pair.sample = sample;
    uint32_t waiting = 0;
    const auto shade_pair = [&] {
      pair.two = waiting == 2;
      if (!pair.two) {
        pair.places.quad[1] = pair.places.quad[0];
        pair.covered[1] = pair.passed[1] = 0;
      }
      waiting = 0;
      shade(pair);
    };
    for (uint32_t i = 0; i < all_.quad_count; ++i) {
      const uint32_t quad = all_.quads[i];
      if ((all_.passed[quad] & wanted) == 0) continue;
      pair.places.quad[waiting] = quad;
      pair.covered[waiting] = all_.covered[quad] & wanted;
      pair.passed[waiting] = all_.passed[quad] & wanted;
      if (++waiting == 2) shade_pair();
    }
    if (waiting != 0) shade_pair();
  }

  void shade(const Pair& pair);
  void set_system_values(const Pair& pair);
  void set_inputs(const Pair& pair);

  // A place in each of the eight pixels, in subpixels from its corner.
  struct Places8 {
    double x[8], y[8];
  };
  Places8 middle() const;
  Places8 at_sample(uint32_t s) const;
  Places8 at_centroid(const Pair& pair) const;

  struct WeightsAt {
    Weights8 perspective, screen;
    Floats8 inv_w;
  };
  WeightsAt weights_at(const Pair& pair, const Places8& places) const;
  Floats8 depth_at(const Pair& pair, const Places8& places) const;
  void set_position(const Pair& pair, const Places8& places);

  uint32_t kept_samples(uint32_t lane) const;
  uint32_t test_late_sample(const Pair& pair, uint32_t s, uint32_t live);

  MultisampleScratch& all_;
  std::span<const SamplePosition> positions_;
  uint64_t shaded_ = 0;
  uint64_t written_ = 0;
};

inline MultisampleShader::Places8 MultisampleShader::middle() const {
  Places8 out;
  std::fill_n(out.x, 8, double{kPixelCenter});
  std::fill_n(out.y, 8, double{kPixelCenter});
  return out;
}

inline MultisampleShader::Places8 MultisampleShader::at_sample(uint32_t s) const {
  Places8 out;
  std::fill_n(out.x, 8, static_cast<double>(positions_[s].x));
  std::fill_n(out.y, 8, static_cast<double>(positions_[s].y));
  return out;
}

// The middle if every sample is covered, or none; else the first covered sample.
inline MultisampleShader::Places8 MultisampleShader::at_centroid(const Pair& pair) const {
  Places8 out = middle();
  const uint32_t all = (1u << plan_->samples) - 1;
  for (uint32_t lane = 0; lane < 8; ++lane) {
    const uint32_t samples = pair.samples_of_lane(pair.covered, lane);
    if (samples == 0 || samples == all) continue;
    const SamplePosition& first = positions_[static_cast<size_t>(std::countr_zero(samples))];
    out.x[lane] = static_cast<double>(first.x);
    out.y[lane] = static_cast<double>(first.y);
  }
  return out;
}

inline MultisampleShader::WeightsAt MultisampleShader::weights_at(const Pair& pair,
                                                                  const Places8& places) const {
  const Triangle& t = *triangle_;
  double from_x[8], from_y[8];
  for (uint32_t lane = 0; lane < 8; ++lane) {
    const uint32_t quad = pair.places.quad[lane / 4];
    const uint32_t x = job_.x + quad % kQuadsPerRow * 2 + (lane & 1);
    const uint32_t y = job_.y + quad / kQuadsPerRow * 2 + (lane >> 1 & 1);
    from_x[lane] =
        static_cast<double>(static_cast<int64_t>(x) * kSubpixels - t.x[0]) + places.x[lane];
    from_y[lane] =
        static_cast<double>(static_cast<int64_t>(y) * kSubpixels - t.y[0]) + places.y[lane];
  }
  const auto edge = [&](int k) {
    return doubles(static_cast<double>(edge_[k][0])) * load_doubles(from_x) +
           doubles(static_cast<double>(edge_[k][1])) * load_doubles(from_y);
  };
  const Doubles8 first = edge(0);
  const Doubles8 second = edge(1);
  const Floats8 inv_area = splat(inv_area_);
  WeightsAt out;
  out.screen = {to_floats(first) * inv_area, to_floats(second) * inv_area};
  const Floats8 screen0 =
      to_floats(doubles(static_cast<double>(area_)) - first - second) * inv_area;
  const Floats8 w1 = out.screen.first * splat(inv_w_[1]);
  const Floats8 w2 = out.screen.second * splat(inv_w_[2]);
  const Floats8 inv_sum = splat(1.0f) / (screen0 * splat(inv_w_[0]) + w1 + w2);
  out.inv_w = inv_sum * splat(inv_w_scale_);
  out.perspective = affine_ ? out.screen : Weights8{w1 * inv_sum, w2 * inv_sum};
  if (clip_ == nullptr) return out;
  const auto of_primitive = [](const Weights8& w, const float of[3][3]) {
    const auto weight = [&](int k) {
      return splat(of[0][k]) + w.first * splat(of[1][k] - of[0][k]) +
             w.second * splat(of[2][k] - of[0][k]);
    };
    return Weights8{weight(1), weight(2)};
  };
  out.perspective = of_primitive(out.perspective, clip_->perspective);
  out.screen = of_primitive(out.screen, clip_->screen);
  return out;
}

// The same depth as that of the early tests.
inline Floats8 MultisampleShader::depth_at(const Pair& pair, const Places8& places) const {
  alignas(32) float out[8];
  for (uint32_t lane = 0; lane < 8; ++lane) {
    Triangle moved = *triangle_;
    for (int32_t& x : moved.x) x -= static_cast<int32_t>(places.x[lane]) - kPixelCenter;
    for (int32_t& y : moved.y) y -= static_cast<int32_t>(places.y[lane]) - kPixelCenter;
    DepthPlane plane;
    plane.begin(moved, static_cast<int32_t>(job_.x), static_cast<int32_t>(job_.y));
    const auto quad = static_cast<int32_t>(pair.places.quad[lane / 4]);
    constexpr auto kRow = static_cast<int32_t>(kQuadsPerRow);
    const int32_t block_y = quad / kRow;
    float values[8];
    store(values, plane.at_block(plane.at_row(block_y), quad % kRow / 2, block_y));
    out[lane] = values[(quad & 1) * 4 + static_cast<int32_t>(lane % 4)];
  }
  return load<float>(out);
}

inline void MultisampleShader::set_position(const Pair& pair, const Places8& places) {
  const auto& columns = plan_->linked->pixel_columns;
  shader::Column* const out = inputs_ + columns.position;
  for (uint32_t lane = 0; lane < 8; ++lane) {
    const uint32_t quad = pair.places.quad[lane / 4];
    const uint32_t x = job_.x + quad % kQuadsPerRow * 2 + (lane & 1);
    const uint32_t y = job_.y + quad / kQuadsPerRow * 2 + (lane >> 1 & 1);
    out[0][lane] = std::bit_cast<uint32_t>(static_cast<float>(x) +
                                           static_cast<float>(places.x[lane]) / kSubpixels);
    if (columns.position_components > 1) {
      out[1][lane] = std::bit_cast<uint32_t>(static_cast<float>(y) +
                                             static_cast<float>(places.y[lane]) / kSubpixels);
    }
  }
  if (columns.position_components > 2) store(out[2], depth_at(pair, places));
  if (columns.position_components > 3) store(out[3], weights_at(pair, places).inv_w);
}

inline void MultisampleShader::set_inputs(const Pair& pair) {
  const auto& columns = plan_->linked->pixel_columns;
  const Places8 center = middle();
  const Places8 centroid = at_centroid(pair);
  const Places8 sample = pair.sample == kEverySample ? center : at_sample(pair.sample);
  const auto place_of = [&](shader::Interpolation interpolation) -> const Places8& {
    return shader::is_at_sample(interpolation)     ? sample
           : shader::is_at_centroid(interpolation) ? centroid
                                                   : center;
  };
  const auto& linear = plan_->linear_places;
  const auto& screen = plan_->screen_places;
  const size_t linear_count = plan_->linear.size();
  const size_t screen_count = plan_->screen_linear.size();
  const auto interpolate_at = [&](const Places8& places, size_t linear_begin, size_t linear_end,
                                  size_t screen_begin, size_t screen_end) {
    if (linear_begin == linear_end && screen_begin == screen_end) return;
    const WeightsAt weights = weights_at(pair, places);
    interpolate(plan_->linear, linear_begin, linear_end, 0, weights.perspective);
    interpolate(plan_->screen_linear, screen_begin, screen_end, linear_count, weights.screen);
  };
  interpolate_at(center, 0, linear.centroid, 0, screen.centroid);
  interpolate_at(centroid, linear.centroid, linear.sample, screen.centroid, screen.sample);
  interpolate_at(sample, linear.sample, linear_count, screen.sample, screen_count);
  if (columns.position != runtime::kNoColumn) set_position(pair, place_of(columns.position_place));
  if (columns.barycentrics != runtime::kNoColumn) {
    const WeightsAt weights = weights_at(pair, place_of(columns.barycentrics_place));
    set_barycentrics(columns.barycentrics_no_perspective ? weights.screen : weights.perspective);
  }
  if (columns.coverage_in != runtime::kNoColumn) {
    for (uint32_t lane = 0; lane < 8; ++lane) {
      inputs_[columns.coverage_in][lane] = pair.samples_of_lane(pair.covered, lane);
    }
  }
  if (columns.sample_index != runtime::kNoColumn) {
    const uint32_t index = pair.sample == kEverySample ? 0 : pair.sample;
    store(inputs_[columns.sample_index], splat(static_cast<int32_t>(index)));
  }
}

// The samples of a pixel that the shader's outputs leave.
inline uint32_t MultisampleShader::kept_samples(uint32_t lane) const {
  const runtime::LinkedGraphics& linked = *plan_->linked;
  uint32_t kept = ~0u;
  const uint32_t coverage = linked.pixel_columns.coverage_out;
  if (coverage != runtime::kNoColumn) kept = outputs_[coverage][lane];
  if (linked.alpha_to_coverage) {
    // Sample s needs an alpha above s / samples.
    const float samples = alpha_of(lane) * static_cast<float>(plan_->samples);
    const auto count = samples > 0 ? static_cast<uint32_t>(std::min(std::ceil(samples), 8.0f)) : 0u;
    kept &= (1u << count) - 1;
  }
  return kept;
}

inline uint32_t MultisampleShader::test_late_sample(const Pair& pair, uint32_t s, uint32_t live) {
  MultisampleScratch::Sample& sample = all_.samples[s];
  const auto depth = [&](uint32_t active) -> uint32_t {
    uint32_t alone[4] = {};  // where there is no second quad
    uint32_t* quads[2] = {sample.depth.words + pair.places.quad[0] * 4,
                          pair.two ? sample.depth.words + pair.places.quad[1] * 4 : alone};
    const Floats8 z = plan_->reads_depth_output
                          ? load<float>(outputs_[plan_->linked->pixel_columns.depth])
                          : depth_at(pair, at_sample(s));
    switch (plan_->depth) {
      case DepthKind::kFloat32:
        return test_late_as<DepthKind::kFloat32>(quads, z, active);
      case DepthKind::kUnorm16:
        return test_late_as<DepthKind::kUnorm16>(quads, z, active);
      case DepthKind::kUnorm24:
        return test_late_as<DepthKind::kUnorm24>(quads, z, active);
      default:
        return active;
    }
  };
  if (!plan_->late_test || plan_->stencil == nullptr) return depth(live);
  const StencilTest stencil(*plan_->stencil, *triangle_);
  uint8_t stored[8] = {};
  const uint32_t count = pair.two ? 2 : 1;
  for (uint32_t i = 0; i < count; ++i) {
    __builtin_memcpy(stored + 4 * i, sample.stencil.bytes + pair.places.quad[i] * 4, 4);
  }
  const uint32_t passed = stencil.run(stored, live);
  const uint32_t passed_depth = passed == 0 ? 0 : depth(passed);
  stencil.update(stored, live, passed, passed_depth);
  for (uint32_t i = 0; i < count; ++i) {
    __builtin_memcpy(sample.stencil.bytes + pair.places.quad[i] * 4, stored + 4 * i, 4);
  }
  return passed_depth;
}

inline void MultisampleShader::shade(const Pair& pair) {
  set_inputs(pair);
  uint32_t covered = 0;
  for (uint32_t s = 0; s < plan_->samples; ++s) covered |= pair.lanes_of_sample(pair.passed, s);
  shaded_ += static_cast<uint64_t>(std::popcount(covered));
  shader::PixelLanes pixel_lanes{inputs_, outputs_, pair.two ? 0xFFu : 0xFu, covered};
  thread_.pixels(batch_->draw, pixel_lanes);
  const uint32_t live = pixel_lanes.live & covered;
  if (live == 0) return;
  uint32_t kept[8];
  std::fill_n(kept, 8, ~0u);
  if (plan_->masks_output) {
    for (uint32_t lane = 0; lane < 8; ++lane) kept[lane] = kept_samples(lane);
  }
  for (uint32_t s = 0; s < plan_->samples; ++s) {
    uint32_t written = live & pair.lanes_of_sample(pair.passed, s);
    for (uint32_t lane = 0; lane < 8; ++lane) {
      if ((kept[lane] >> s & 1) == 0) written &= ~(1u << lane);
    }
    if (written != 0 && tests_late()) written = test_late_sample(pair, s, written);
    if (written == 0) continue;
    written_ += static_cast<uint64_t>(std::popcount(written));
    write_targets(*plan_, all_.samples[s].colors, pair.places, outputs_, written);
  }
}

}  // namespace kaamos::raster::KAAMOS_RASTER_LEVEL

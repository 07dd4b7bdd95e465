// SPDX-License-Identifier: MIT
#include "scalar_svgf.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tiles.h"

// Compiled for AVX2 too, like the shaders, with everything that it calls.
#if defined(__x86_64__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define KAAMOS_AS_SHADERS [[gnu::target_clones("avx2", "default"), gnu::flatten]]
#else
#define KAAMOS_AS_SHADERS
#endif

namespace kaamos::bench {
namespace {

constexpr float kNoWeight = 1e-12f;
constexpr float kNoWeightLogarithm = 27.6f;

float luminance(const Float4& color) {
  return color.x * 0.2126f + color.y * 0.7152f + color.z * 0.0722f;
}

// Squares of larger values, summed over a filter, would overflow.
constexpr float kMostLight = 1e17f;

float finite_or_zero(float light) {
  return std::isfinite(light) ? std::min(std::max(light, -kMostLight), kMostLight) : 0.0f;
}
Float4 finite_or_zero(const Float4& color) {
  return {finite_or_zero(color.x), finite_or_zero(color.y), finite_or_zero(color.z), 0.0f};
}

void add(Float4& sum, float weight, const Float4& value) {
  sum.x += weight * value.x;
  sum.y += weight * value.y;
  sum.z += weight * value.z;
  sum.w += weight * value.w;
}

float smaller(float a, float b) {
  if (!(a * b > 0.0f)) return 0.0f;
  return std::fabs(a) < std::fabs(b) ? a : b;
}

float lerp(float a, float b, float t) {
  return a + t * (b - a);
}

}  // namespace

// The data of a pixel's surface that its edge-stopping weights need.
struct ScalarSvgf::Center {
  Float4 guide;  // normal, view depth
  float gradient[2];
  float least_slope;
  const effects::DenoiseConstants* constants;

  float normal_weight(const Float4& other) const {
    if (other.w == 0.0f) return 0;
    const float cosine = other.x * guide.x + other.y * guide.y + other.z * guide.z;
    float weight = std::min(std::max(cosine, 0.0f), 1.0f);
    if (constants->normal_squarings < 0) {
      return std::pow(std::max(weight, 1e-30f), constants->sigma_n);
    }
    for (int i = 0; i < constants->normal_squarings; ++i) weight *= weight;
    return weight;
  }
  float depth_distance(const Float4& other, int dx, int dy) const {
    const float slope =
        std::fabs(gradient[0] * static_cast<float>(dx) + gradient[1] * static_cast<float>(dy));
    return std::fabs(other.w - guide.w) / (slope + least_slope);
  }
};

ScalarSvgf::ScalarSvgf(uint32_t width, uint32_t height, const effects::DenoiseDesc& desc)
    : width_(static_cast<int>(width)),
      height_(static_cast<int>(height)),
      constants_(desc.constants),
      iterations_(desc.iterations),
      iterations_with_history_(desc.iterations_with_history) {
  for (auto* picture : {&guides_[0], &guides_[1], &moments_[0], &moments_[1], &history_,
                        &accumulated_, &scratch_, &result_}) {
    picture->resize(size_t{width} * height);
  }
}

KAAMOS_AS_SHADERS void ScalarSvgf::prepare_guides(const SvgfInput& input, int x, int y) {
  const size_t i = at(x, y);
  const float z = input.view_z[i];
  const float u = input.shading_normal[2 * i];
  const float v = input.shading_normal[2 * i + 1];
  Float4 n = {u, v, 1.0f - std::fabs(u) - std::fabs(v), z};
  if (n.z < 0.0f) {
    n.x = (1.0f - std::fabs(v)) * (u >= 0.0f ? 1.0f : -1.0f);
    n.y = (1.0f - std::fabs(u)) * (v >= 0.0f ? 1.0f : -1.0f);
  }
  const float length = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
  n = {n.x / length, n.y / length, n.z / length, z};
  const bool usable = z > 0.0f && std::isfinite(n.x) && std::isfinite(n.y) && std::isfinite(n.z) &&
                      std::isfinite(z);
  guides_[frames_ % 2][i] = usable ? n : Float4{};
}

ScalarSvgf::Center ScalarSvgf::center(int x, int y) const {
  const std::vector<Float4>& guides = guides_[frames_ % 2];
  Center out;
  out.guide = guides[at(x, y)];
  const float z = out.guide.w;
  const float left = guides[at(std::max(x - 1, 0), y)].w;
  const float right = guides[at(std::min(x + 1, width_ - 1), y)].w;
  const float up = guides[at(x, std::max(y - 1, 0))].w;
  const float down = guides[at(x, std::min(y + 1, height_ - 1))].w;
  const float dx = x == 0 ? right - z : x == width_ - 1 ? z - left : smaller(right - z, z - left);
  const float dy = y == 0 ? down - z : y == height_ - 1 ? z - up : smaller(down - z, z - up);
  out.gradient[0] = constants_.sigma_z * dx;
  out.gradient[1] = constants_.sigma_z * dy;
  out.least_slope = 1e-4f * z;
  out.constants = &constants_;
  return out;
}

ScalarSvgf::Reprojected ScalarSvgf::reproject(const SvgfInput& input, int x, int y) const {
  Reprojected out;
  if (frames_ == 0) return out;
  const Float4& motion = input.motion[at(x, y)];
  if (!std::isfinite(motion.x) || !std::isfinite(motion.y)) return out;
  const float before_x = static_cast<float>(x) + motion.x * static_cast<float>(width_);
  const float before_y = static_cast<float>(y) + motion.y * static_cast<float>(height_);
  if (before_x < -1 || before_y < -1 || before_x > static_cast<float>(width_) ||
      before_y > static_cast<float>(height_)) {
    return out;
  }
  Center here = center(x, y);
  const float sigma = constants_.sigma_z;
  const float slope =
      sigma != 0 ? std::fabs(here.gradient[0] / sigma) + std::fabs(here.gradient[1] / sigma) : 0;
  const float expected = here.guide.w + motion.z;
  const float tolerance = 2.0f * slope + 0.01f * expected;
  const auto instance = static_cast<float>(input.instance[at(x, y)]);
  const float left = std::floor(before_x);
  const float top = std::floor(before_y);
  const float part_x = before_x - left;
  const float part_y = before_y - top;
  for (int i = 0; i < 4; ++i) {
    const int tap_x = static_cast<int>(left) + (i & 1);
    const int tap_y = static_cast<int>(top) + (i >> 1);
    if (!is_inside(tap_x, tap_y)) continue;
    const size_t tap = at(tap_x, tap_y);
    const Float4& guide = guides_[(frames_ + 1) % 2][tap];
    const Float4& moments = moments_[(frames_ + 1) % 2][tap];
    if (guide.w == 0.0f || moments.w != instance || std::fabs(guide.w - expected) > tolerance ||
        guide.x * here.guide.x + guide.y * here.guide.y + guide.z * here.guide.z < 0.9f) {
      continue;
    }
    const float weight =
        ((i & 1) != 0 ? part_x : 1.0f - part_x) * ((i >> 1) != 0 ? part_y : 1.0f - part_y);
    add(out.color, weight, history_[tap]);
    add(out.moments, weight, moments);
    out.weight += weight;
  }
  if (out.weight < 0.01f) return {};
  for (Float4* sum : {&out.color, &out.moments}) {
    *sum = {sum->x / out.weight, sum->y / out.weight, sum->z / out.weight, sum->w / out.weight};
  }
  for (const Float4& mean : {out.color, out.moments}) {
    if (!std::isfinite(mean.x) || !std::isfinite(mean.y) || !std::isfinite(mean.z) ||
        !std::isfinite(mean.w)) {
      return {};
    }
  }
  return out;
}

Float4 ScalarSvgf::clip_to_neighbours(const SvgfInput& input, const Reprojected& before, int x,
                                      int y) const {
  Float4 color = before.color;
  const bool keeps_energy = constants_.keep_energy != 0;
  if (keeps_energy && before.moments.z < 4.0f) return color;
  const Float4& past = before.moments;
  const float over_time = std::sqrt(std::max(past.y - past.x * past.x, 0.0f));
  Float4 sum;
  Float4 squares;
  float count = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (!is_inside(x + dx, y + dy)) continue;
      const size_t other = at(x + dx, y + dy);
      if (guides_[frames_ % 2][other].w == 0.0f) continue;
      const Float4 c = finite_or_zero(input.signal[other]);
      add(sum, 1, c);
      add(squares, 1, {c.x * c.x, c.y * c.y, c.z * c.z, 0});
      count += 1;
    }
  }
  float* const out[3] = {&color.x, &color.y, &color.z};
  const float sums[3] = {sum.x, sum.y, sum.z};
  const float sums_of_squares[3] = {squares.x, squares.y, squares.z};
  for (int i = 0; i < 3; ++i) {
    const float mean = sums[i] / count;
    const float deviation = std::sqrt(std::max(sums_of_squares[i] / count - mean * mean, 0.0f));
    float allowed = constants_.clip_gamma * deviation;
    if (keeps_energy) allowed = std::max(allowed, 3.0f * over_time);
    *out[i] = std::min(std::max(*out[i], mean - allowed), mean + allowed);
  }
  return color;
}

KAAMOS_AS_SHADERS void ScalarSvgf::accumulate(const SvgfInput& input, int x, int y) {
  const size_t i = at(x, y);
  std::vector<Float4>& moments = moments_[frames_ % 2];
  const Float4 color = finite_or_zero(input.signal[i]);
  accumulated_[i] = color;
  moments[i] = {};
  if (guides_[frames_ % 2][i].w == 0.0f) return;
  const float now = luminance(color);
  const auto instance = static_cast<float>(input.instance[i]);
  moments[i] = {now, now * now, 1, instance};
  Reprojected before = reproject(input, x, y);
  if (before.weight == 0) return;
  if (constants_.clip_gamma > 0) {
    before.color = clip_to_neighbours(input, before, x, y);
  }
  const float frames =
      std::min(before.moments.z + 1.0f, static_cast<float>(constants_.max_history));
  const float alpha = std::max(constants_.alpha, 1.0f / frames);
  const float moments_alpha = std::max(constants_.moments_alpha, 1.0f / frames);
  const float first = lerp(before.moments.x, now, moments_alpha);
  const float second = lerp(before.moments.y, now * now, moments_alpha);
  accumulated_[i] = {lerp(before.color.x, color.x, alpha), lerp(before.color.y, color.y, alpha),
                     lerp(before.color.z, color.z, alpha), std::max(second - first * first, 0.0f)};
  moments[i] = {first, second, frames, instance};
}

KAAMOS_AS_SHADERS void ScalarSvgf::estimate_variance(int x, int y) {
  const size_t i = at(x, y);
  const std::vector<Float4>& moments = moments_[frames_ % 2];
  const std::vector<Float4>& guides = guides_[frames_ % 2];
  const Float4 color = accumulated_[i];
  const float frames = moments[i].z;
  if (guides[i].w == 0.0f || frames >= 4.0f) {
    scratch_[i] = color;
    return;
  }
  const Center here = center(x, y);
  float first = moments[i].x;
  float second = moments[i].y;
  Float4 sum = color;
  float weights = 1;
  for (int dy = -3; dy <= 3; ++dy) {
    if (y + dy < 0 || y + dy >= height_) continue;
    for (int dx = -3; dx <= 3; ++dx) {
      if ((dx == 0 && dy == 0) || x + dx < 0 || x + dx >= width_) continue;
      const size_t other = at(x + dx, y + dy);
      const float by_normal = here.normal_weight(guides[other]);
      if (by_normal < kNoWeight) continue;
      const float distance = here.depth_distance(guides[other], dx, dy);
      if (!(distance <= kNoWeightLogarithm)) continue;
      const float weight = by_normal * std::exp(-distance);
      first += weight * moments[other].x;
      second += weight * moments[other].y;
      add(sum, weight, accumulated_[other]);
      weights += weight;
    }
  }
  first /= weights;
  second /= weights;
  const float variance = std::max(second - first * first, 0.0f) * (4.0f / std::max(frames, 1.0f));
  scratch_[i] = {sum.x / weights, sum.y / weights, sum.z / weights, variance};
}

float ScalarSvgf::smooth_variance(const std::vector<Float4>& picture, int x, int y) const {
  float sum = 0;
  float weights = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      if (!is_inside(x + dx, y + dy)) continue;
      const float weight = (dx == 0 ? 0.5f : 0.25f) * (dy == 0 ? 0.5f : 0.25f);
      sum += weight * picture[at(x + dx, y + dy)].w;
      weights += weight;
    }
  }
  return sum / weights;
}

KAAMOS_AS_SHADERS void ScalarSvgf::filter(const std::vector<Float4>& from, std::vector<Float4>& to,
                                          int step, int x, int y) {
  const size_t i = at(x, y);
  const std::vector<Float4>& guides = guides_[frames_ % 2];
  const Float4 own = from[i];
  if (guides[i].w == 0.0f) {
    to[i] = own;
    return;
  }
  constexpr float kKernel[3] = {0.375f, 0.25f, 0.0625f};
  const float deviation = std::sqrt(std::max(smooth_variance(from, x, y), 0.0f));
  if (deviation == 0.0f) {
    to[i] = own;
    return;
  }
  const Center here = center(x, y);
  const float own_luminance = luminance(own);
  const float per_luminance =
      1.0f / (constants_.sigma_l * std::max(deviation, 1e-3f * own_luminance) + 1e-30f);
  float weights = kKernel[0] * kKernel[0];
  Float4 color;
  add(color, weights, own);
  float variance = own.w * weights * weights;
  for (int ky = -2; ky <= 2; ++ky) {
    const int other_y = y + ky * step;
    if (other_y < 0 || other_y >= height_) continue;
    for (int kx = -2; kx <= 2; ++kx) {
      const int other_x = x + kx * step;
      if ((kx == 0 && ky == 0) || other_x < 0 || other_x >= width_) continue;
      const size_t other = at(other_x, other_y);
      const float by_normal = here.normal_weight(guides[other]);
      if (by_normal < kNoWeight) continue;
      const Float4& tap = from[other];
      const float distance = here.depth_distance(guides[other], kx * step, ky * step) +
                             std::fabs(luminance(tap) - own_luminance) * per_luminance;
      if (!(distance <= kNoWeightLogarithm)) continue;
      const float weight =
          kKernel[std::abs(kx)] * kKernel[std::abs(ky)] * by_normal * std::exp(-distance);
      color.x += weight * tap.x;
      color.y += weight * tap.y;
      color.z += weight * tap.z;
      variance += weight * weight * tap.w;
      weights += weight;
    }
  }
  to[i] = {color.x / weights, color.y / weights, color.z / weights, variance / (weights * weights)};
}

void ScalarSvgf::run(tbb::task_arena& arena, const SvgfInput& input) {
  const auto pass = [&](auto body) {
    const auto width = static_cast<uint32_t>(width_);
    for_each_cell(arena, width, static_cast<uint32_t>(height_), [&] {
      return [&](uint32_t index) {
        body(static_cast<int>(index % width), static_cast<int>(index / width));
      };
    });
  };
  pass([&](int x, int y) { prepare_guides(input, x, y); });
  pass([&](int x, int y) { accumulate(input, x, y); });
  pass([&](int x, int y) { estimate_variance(x, y); });
  // The result of the first pass is where the next frame starts.
  pass([&](int x, int y) { filter(scratch_, history_, 1, x, y); });
  const std::vector<Float4>* from = &history_;
  const uint32_t iterations =
      frames_ >= effects::kFramesOfHistory ? iterations_with_history_ : iterations_;
  for (uint32_t i = 1; i < iterations; ++i) {
    std::vector<Float4>& to = i + 1 == iterations     ? result_
                              : from == &accumulated_ ? scratch_
                                                      : accumulated_;
    pass([&](int x, int y) { filter(*from, to, 1 << i, x, y); });
    from = &to;
  }
  if (iterations < 2) result_ = history_;
  ++frames_;
}

}  // namespace kaamos::bench

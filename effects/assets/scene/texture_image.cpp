// SPDX-License-Identifier: MIT
#include "effects/assets/scene/texture_image.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "effects/assets/image/srgb.h"

namespace kaamos::effects {
namespace {

std::uint32_t level_size(std::uint32_t size, std::size_t level) {
  return std::max<std::uint32_t>(1, size >> level);
}

const std::array<float, 256>& srgb_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (int i = 0; i < 256; ++i) values[i] = linear_from_srgb(static_cast<float>(i) / 255.0f);
    return values;
  }();
  return table;
}

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

/// First and one-past-last source texel that a destination texel covers when a side is halved. If
/// the side is odd, the last texel takes three, so that no source texel is dropped.
struct Footprint {
  std::uint32_t begin, end;
};
Footprint footprint(std::uint32_t i, std::uint32_t destination, std::uint32_t source) {
  if (source == 1) return {0, 1};
  return {2 * i, i + 1 == destination ? source : 2 * i + 2};
}

std::vector<std::uint8_t> downsample(const TextureImage& image, std::uint32_t level) {
  const std::uint32_t sw = level_size(image.width, level), sh = level_size(image.height, level);
  const std::uint32_t dw = level_size(image.width, level + 1);
  const std::uint32_t dh = level_size(image.height, level + 1);
  std::vector<std::uint8_t> out(std::size_t{dw} * dh * 4);
  for (std::uint32_t y = 0; y < dh; ++y) {
    const Footprint fy = footprint(y, dh, sh);
    for (std::uint32_t x = 0; x < dw; ++x) {
      const Footprint fx = footprint(x, dw, sw);
      glm::vec3 plain(0.0f), weighted(0.0f);
      float alpha = 0.0f, count = 0.0f;
      for (std::uint32_t j = fy.begin; j < fy.end; ++j) {
        for (std::uint32_t i = fx.begin; i < fx.end; ++i) {
          const glm::vec4 c = texel(image, level, i, j);
          plain += glm::vec3(c);
          weighted += glm::vec3(c) * c.a;
          alpha += c.a;
          count += 1.0f;
        }
      }
      const glm::vec3 color = alpha > 0.0f ? weighted / alpha : plain / count;
      std::uint8_t* p = &out[(std::size_t{y} * dw + x) * 4];
      for (int k = 0; k < 3; ++k)
        p[k] = to_byte(image.srgb ? srgb_from_linear(color[k]) : color[k]);
      p[3] = to_byte(alpha / count);
    }
  }
  return out;
}

/// Finds the scale of alpha that brings the coverage of `level` to `wanted`, by bisection: coverage
/// never falls as the scale grows.
float coverage_scale(const TextureImage& image, std::uint32_t level, float cutoff, float wanted) {
  float low = 0.0f, high = 8.0f;
  for (int step = 0; step < 16; ++step) {
    const float middle = 0.5f * (low + high);
    (alpha_coverage(image, level, cutoff, middle) < wanted ? low : high) = middle;
  }
  return high;
}

}  // namespace

glm::vec4 texel(const TextureImage& image, std::uint32_t level, std::uint32_t x, std::uint32_t y) {
  const std::uint32_t w = level_size(image.width, level);
  assert(level < image.mips.size() && x < w && y < level_size(image.height, level));
  const std::uint8_t* p = &image.mips[level][(std::size_t{y} * w + x) * 4];
  if (image.srgb) {
    const auto& decode = srgb_table();
    return {decode[p[0]], decode[p[1]], decode[p[2]], static_cast<float>(p[3]) / 255.0f};
  }
  return glm::vec4(p[0], p[1], p[2], p[3]) / 255.0f;
}

bool has_alpha(const TextureImage& image) {
  if (image.mips.empty()) return false;
  const auto& bytes = image.mips[0];
  for (std::size_t i = 3; i < bytes.size(); i += 4)
    if (bytes[i] != 255) return true;
  return false;
}

bool is_cut_out(const TextureImage& image) {
  if (image.mips.empty()) return false;
  const auto& bytes = image.mips[0];
  std::size_t between = 0;
  for (std::size_t i = 3; i < bytes.size(); i += 4) between += bytes[i] > 8 && bytes[i] < 247;
  return 20 * between <= bytes.size() / 4;
}

float alpha_coverage(const TextureImage& image, std::uint32_t level, float cutoff, float scale) {
  assert(level < image.mips.size());
  const auto& bytes = image.mips[level];
  std::size_t passing = 0;
  for (std::size_t i = 3; i < bytes.size(); i += 4)
    if (std::min(1.0f, static_cast<float>(bytes[i]) / 255.0f * scale) >= cutoff) ++passing;
  return static_cast<float>(passing) / static_cast<float>(bytes.size() / 4);
}

void generate_mips(TextureImage& image, std::optional<float> alpha_cutoff) {
  assert(image.mips.size() >= 1);
  image.mips.resize(1);
  const std::uint32_t longest = std::max(image.width, image.height);
  for (std::uint32_t level = 0; (longest >> level) > 1; ++level)
    image.mips.push_back(downsample(image, level));
  if (!alpha_cutoff || !has_alpha(image)) return;
  // Scale alpha only after all levels are averaged, so that the scaling does not feed into the next
  // level.
  const float wanted = alpha_coverage(image, 0, *alpha_cutoff);
  for (std::uint32_t level = 1; level < image.mips.size(); ++level) {
    const float scale = coverage_scale(image, level, *alpha_cutoff, wanted);
    auto& bytes = image.mips[level];
    for (std::size_t i = 3; i < bytes.size(); i += 4)
      bytes[i] = to_byte(static_cast<float>(bytes[i]) / 255.0f * scale);
  }
}

}  // namespace kaamos::effects

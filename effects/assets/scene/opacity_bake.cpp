// SPDX-License-Identifier: MIT
#include "effects/assets/scene/opacity_bake.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace kaamos::effects {
namespace {

// D3D12_RAYTRACING_OPACITY_MICROMAP_STATE.
enum State : std::uint8_t { kTransparent, kOpaque, kUnknownTransparent, kUnknownOpaque };

// Filters round, so an alpha that is this near to the cutoff may be on either side of it.
constexpr float kAlphaMargin = 1e-4f;

// Farther out coordinates say nothing; they must fit an integer.
constexpr double kFar = 1e15;

// The texels of an axis that filters read, first and last included.
struct Range {
  std::int64_t first;
  std::int64_t last;
};

// How many texels of any rectangle pass the test for certain, and how many fail it. [Crow 1984:
// Summed-area tables]
class Coverage {
 public:
  explicit Coverage(const AlphaTest& test)
      : width_(test.image->width), height_(test.image->height), sampler_(test.sampler) {
    sums_.resize(std::size_t{width_ + 1} * (height_ + 1));
    for (std::uint32_t y = 0; y < height_; ++y) {
      for (std::uint32_t x = 0; x < width_; ++x) {
        const std::uint8_t texel = test.image->mips[0][(std::size_t{y} * width_ + x) * 4 + 3];
        const float alpha = test.factor * static_cast<float>(texel) / 255.0f;
        Sum& to = sums_[index(x + 1, y + 1)];
        const Sum &left = sums_[index(x, y + 1)], &above = sums_[index(x + 1, y)],
                  &both = sums_[index(x, y)];
        to.passing = left.passing + above.passing - both.passing;
        to.failing = left.failing + above.failing - both.failing;
        if (alpha >= test.cutoff + kAlphaMargin) ++to.passing;
        if (alpha < test.cutoff - kAlphaMargin) ++to.failing;
      }
    }
  }

  // What filters can find between two corners, in texels; the middles of texels are at halves.
  State of(glm::dvec2 low, glm::dvec2 high, double margin) const {
    const Range x = texels(low.x, high.x, margin);
    const Range y = texels(low.y, high.y, margin);
    std::uint64_t passing = 0, failing = 0, all = 0;
    for_parts(y, height_, sampler_.wrap_v, [&](std::uint32_t y0, std::uint32_t y1) {
      for_parts(x, width_, sampler_.wrap_u, [&](std::uint32_t x0, std::uint32_t x1) {
        const auto count = [&](std::uint32_t Sum::*of_sum) {
          return std::uint64_t{sums_[index(x1, y1)].*of_sum} - sums_[index(x0, y1)].*of_sum -
                 sums_[index(x1, y0)].*of_sum + sums_[index(x0, y0)].*of_sum;
        };
        passing += count(&Sum::passing);
        failing += count(&Sum::failing);
        all += std::uint64_t{x1 - x0} * (y1 - y0);
      });
    });
    if (passing == all) return kOpaque;
    if (failing == all) return kTransparent;
    return passing * 2 >= all ? kUnknownOpaque : kUnknownTransparent;
  }

 private:
  struct Sum {
    std::uint32_t passing = 0;
    std::uint32_t failing = 0;
  };

  std::size_t index(std::uint32_t x, std::uint32_t y) const {
    return std::size_t{y} * (width_ + 1) + x;
  }
  // Linear filters reach half a texel farther than the texel that a point lies in.
  Range texels(double low, double high, double margin) const {
    const auto at = [](double texel) {
      return static_cast<std::int64_t>(std::floor(std::clamp(texel, -kFar, kFar)));
    };
    const bool nearest =
        sampler_.min_filter == Filter::kNearest && sampler_.mag_filter == Filter::kNearest;
    const double reach = margin + (nearest ? 0.0 : 0.5);
    return {at(low - reach), at(high + reach)};
  }

  // Calls part(first, end) for the texels of the image that a range shows.
  template <class Part>
  static void for_parts(Range range, std::uint32_t size, Wrap wrap, Part part) {
    const auto last = static_cast<std::int64_t>(size) - 1;
    if (wrap == Wrap::kClamp) {
      const auto first = static_cast<std::uint32_t>(std::clamp<std::int64_t>(range.first, 0, last));
      const auto end = static_cast<std::uint32_t>(std::clamp<std::int64_t>(range.last, 0, last));
      return part(first, end + 1);
    }
    if (range.last - range.first >= last) return part(0, size);
    const auto period = static_cast<std::int64_t>(size);
    for (std::int64_t at = range.first; at <= range.last;) {
      const std::int64_t copy = at >= 0 ? at / period : -((-at + period - 1) / period);
      const std::int64_t end = std::min(range.last, copy * period + last);
      auto first = static_cast<std::uint32_t>(at - copy * period);
      auto past = static_cast<std::uint32_t>(end - copy * period) + 1;
      if (wrap == Wrap::kMirror && copy % 2 != 0) {
        const std::uint32_t mirrored = size - past;
        past = size - first;
        first = mirrored;
      }
      part(first, past);
      at = end + 1;
    }
  }

  std::uint32_t width_;
  std::uint32_t height_;
  Sampler sampler_;
  std::vector<Sum> sums_;  // of what is above and to the left
};

using Corners = std::array<glm::dvec2, 3>;  // in texels

// Fills `states` with a triangle's micro-triangles, a whole part at once where it can.
class Divider {
 public:
  Divider(const Coverage& coverage, double margin, std::vector<State>& states)
      : coverage_(coverage), margin_(margin), states_(states) {}

  // The order is DXR's: a triangle is entered at a and left at c.
  void divide(const Corners& corners, std::uint32_t level, std::size_t first) {
    const auto& [a, b, c] = corners;
    const State state =
        coverage_.of(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)), margin_);
    const bool known = state == kOpaque || state == kTransparent;
    if (known || level == 0) {
      std::fill_n(states_.begin() + static_cast<std::ptrdiff_t>(first), std::size_t{1} << 2 * level,
                  state);
      return;
    }
    const glm::dvec2 ab = (a + b) / 2.0, bc = (b + c) / 2.0, ca = (c + a) / 2.0;
    const Corners quarters[] = {{a, ab, ca}, {ca, bc, ab}, {ab, b, bc}, {bc, ca, c}};
    const std::size_t step = std::size_t{1} << 2 * (level - 1);
    for (std::size_t i = 0; i < 4; ++i) divide(quarters[i], level - 1, first + i * step);
  }

 private:
  const Coverage& coverage_;
  double margin_;
  std::vector<State>& states_;
};

std::uint32_t level_of(const Corners& corners, const BakeOptions& options) {
  double longest = 0;
  for (int i = 0; i < 3; ++i)
    longest = std::max(longest, glm::length(corners[i] - corners[(i + 1) % 3]));
  const double wanted = std::max<double>(options.texels_per_edge, 1e-3);
  std::uint32_t level = 0;
  while (level < options.max_level && longest / std::exp2(level) > wanted) ++level;
  return level;
}

// What float arithmetic loses of texture coordinates, and filters of the weights of texels, in
// texels.
double margin_of(const Corners& corners, const glm::dvec2& size) {
  double farthest = 1;
  for (const glm::dvec2& corner : corners) {
    farthest = std::max({farthest, std::abs(corner.x / size.x), std::abs(corner.y / size.y)});
  }
  return 1.0 / 64 + farthest * std::max(size.x, size.y) * 0x1p-20;
}

std::vector<State> states_of(const Corners& corners, const Coverage& coverage,
                             const glm::dvec2& size, std::uint32_t level) {
  std::vector<State> states(std::size_t{1} << 2 * level);
  const bool finite = std::all_of(corners.begin(), corners.end(), [](const glm::dvec2& corner) {
    return std::isfinite(corner.x) && std::isfinite(corner.y);
  });
  if (!finite) return std::vector<State>(states.size(), kUnknownOpaque);
  Divider(coverage, margin_of(corners, size), states).divide(corners, level, 0);
  return states;
}

void append(const std::vector<State>& states, std::uint32_t level, bool two_states,
            BakedMicromaps& out) {
  const std::uint32_t width = two_states ? 1 : 2;
  out.micromaps.push_back({static_cast<std::uint32_t>(out.bits.size()),
                           static_cast<std::uint16_t>(level), static_cast<std::uint16_t>(width)});
  const std::size_t begin = out.bits.size();
  out.bits.resize(begin + (states.size() * width + 7) / 8);
  for (std::size_t k = 0; k < states.size(); ++k) {
    out.bits[begin + k * width / 8] |= static_cast<std::uint8_t>(states[k] << k * width % 8);
  }
}

}  // namespace

BakedMicromaps bake_micromaps(std::span<const std::array<glm::vec2, 3>> triangles,
                              const AlphaTest& test, const BakeOptions& options) {
  BakedMicromaps out;
  out.indices.reserve(triangles.size());
  if (test.image == nullptr) {
    const bool open = test.factor < test.cutoff;
    out.indices.assign(triangles.size(), open ? -1 : -2);
    out.shares[open ? kTransparent : kOpaque] = triangles.empty() ? 0 : 1;
    return out;
  }
  struct Known {
    std::int32_t index;
    std::array<double, 4> shares;
  };
  std::map<std::array<float, 6>, Known> known;
  const Coverage coverage(test);
  const glm::dvec2 size(test.image->width, test.image->height);
  for (const auto& uvs : triangles) {
    std::array<float, 6> key;
    std::memcpy(key.data(), uvs.data(), sizeof key);
    auto [at, is_new] = known.try_emplace(key);
    Known& one = at->second;
    if (is_new) {
      Corners corners;
      for (int i = 0; i < 3; ++i) {
        const glm::dvec2 uv(uvs[i]);
        const glm::dvec4 m(test.uv_matrix);
        const glm::dvec2 moved(m.x * uv.x + m.y * uv.y, m.z * uv.x + m.w * uv.y);
        corners[i] = (moved + glm::dvec2(test.uv_offset)) * size;
      }
      const std::uint32_t level = level_of(corners, options);
      std::vector<State> states = states_of(corners, coverage, size, level);
      if (options.two_states) {
        for (State& state : states) state = static_cast<State>(state & 1);
      }
      for (const State state : states)
        one.shares[state] += 1.0 / static_cast<double>(states.size());
      const bool same = std::count(states.begin(), states.end(), states[0]) ==
                        static_cast<std::ptrdiff_t>(states.size());
      one.index = same ? -1 - states[0] : static_cast<std::int32_t>(out.micromaps.size());
      if (!same) append(states, level, options.two_states, out);
    }
    out.indices.push_back(one.index);
    for (std::size_t i = 0; i < 4; ++i) {
      out.shares[i] += one.shares[i] / static_cast<double>(triangles.size());
    }
  }
  return out;
}

}  // namespace kaamos::effects

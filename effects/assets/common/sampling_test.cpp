// SPDX-License-Identifier: MIT
#include "effects/assets/common/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <numbers>
#include <set>
#include <vector>

#include "effects/assets/common/blue_noise.h"
#include "effects/assets/common/sobol.h"
#include "effects/assets/common/void_and_cluster.h"

namespace kaamos::effects {
namespace {

TEST(Sobol, SecondDimensionIsThatOfTheDirectionNumbers) {
  // For the polynomial x + 1, each direction number is the previous one xored with itself shifted
  // by one.
  for (std::uint32_t i = 0; i < 5000; ++i) {
    std::uint32_t direction = 0x80000000u, expected = 0;
    for (std::uint32_t bits = i * 2654435761u; bits; bits >>= 1, direction ^= direction >> 1)
      if (bits & 1u) expected ^= direction;
    ASSERT_EQ(sobol_1(i * 2654435761u), expected) << i;
  }
}

/// Every elementary interval of area 2^-k holds exactly one of 2^k points. [Niederreiter 1992]
void expect_net(const std::vector<glm::vec2>& points, std::uint32_t k) {
  for (std::uint32_t a = 0; a <= k; ++a) {
    std::set<std::uint32_t> cells;
    for (const glm::vec2& p : points)
      cells.insert((static_cast<std::uint32_t>(p.x * static_cast<float>(1u << a)) << (k - a)) |
                   static_cast<std::uint32_t>(p.y * static_cast<float>(1u << (k - a))));
    EXPECT_EQ(cells.size(), points.size()) << "2^" << a << " x 2^" << k - a << " cells";
  }
}

TEST(Sobol, ScrambledPointsAreANet) {
  for (const std::uint32_t seed : {0u, 1u, 0xFFFFFFFFu, 12345u})
    for (const std::uint32_t k : {2u, 4u, 8u}) {
      std::vector<glm::vec2> points;
      for (std::uint32_t i = 0; i < (1u << k); ++i) points.push_back(sobol_owen(i, seed));
      expect_net(points, k);
    }
}

TEST(Sobol, ScramblingIsABijectionThatKeepsPrefixes) {
  std::set<std::uint32_t> images;
  for (std::uint32_t i = 0; i < 4096; ++i) {
    images.insert(owen_scramble(i << 20, 77u) >> 20);
    // Nested: equal upper bits give equal upper bits.
    EXPECT_EQ(owen_scramble(i << 20, 77u) >> 20, owen_scramble((i << 20) | 0xFFFFFu, 77u) >> 20);
  }
  EXPECT_EQ(images.size(), 4096u);
}

/// Root mean square error, over scrambles, of the fraction of points with x + y < 0.8.
double edge_error(std::uint32_t n, bool random) {
  double squares = 0.0;
  constexpr std::uint32_t kTrials = 200;
  for (std::uint32_t seed = 0; seed < kTrials; ++seed) {
    std::uint32_t inside = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t h = hash_combine(seed, i);
      const glm::vec2 p = random ? glm::vec2(unit_float(h), unit_float(pcg_hash(h ^ 0x12345u)))
                                 : sobol_owen(i, pcg_hash(seed));
      inside += p.x + p.y < 0.8f;
    }
    const double error = inside / static_cast<double>(n) - 0.32;
    squares += error * error;
  }
  return std::sqrt(squares / kTrials);
}

TEST(Sobol, ErrorFallsFasterThanWithRandomNumbers) {
  // Over an edge the slope is about -3/4 [Mitchell 1996, Consequences of Stratified Sampling in
  // Graphics]; independent random numbers have -1/2.
  const double slope = std::log(edge_error(1024, false) / edge_error(16, false)) / std::log(64.0);
  EXPECT_LT(slope, -0.65);
  const double random = std::log(edge_error(1024, true) / edge_error(16, true)) / std::log(64.0);
  EXPECT_NEAR(random, -0.5, 0.12);
}

TEST(Sobol, EachPointIsUniformOverScrambles) {
  for (const std::uint32_t index : {0u, 1u, 5u}) {
    glm::dvec2 sum(0.0);
    constexpr std::uint32_t kTrials = 4000;
    for (std::uint32_t seed = 0; seed < kTrials; ++seed)
      sum += glm::dvec2(sobol_owen(index, pcg_hash(seed)));
    // 4 standard deviations of the mean of 4000 uniform numbers.
    EXPECT_NEAR(sum.x / kTrials, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / kTrials)) << index;
    EXPECT_NEAR(sum.y / kTrials, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / kTrials)) << index;
  }
}

TEST(BlueNoise, HoldsEveryRankOnce) {
  std::vector<std::uint32_t> ranks = void_and_cluster(32, 5);
  std::sort(ranks.begin(), ranks.end());
  for (std::uint32_t i = 0; i < ranks.size(); ++i) ASSERT_EQ(ranks[i], i);
}

/// Mean power per frequency below `limit` cycles per tile, and over all frequencies.
std::pair<double, double> power(const std::vector<double>& values, int size, double limit) {
  // Rows, then columns. For one tile a plain Fourier sum is fast enough.
  using Complex = std::complex<double>;
  std::vector<Complex> turn(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i)
    turn[static_cast<std::size_t>(i)] = std::polar(1.0, -2.0 * std::numbers::pi * i / size);
  const auto at = [size](int y, int x) { return static_cast<std::size_t>(y * size + x); };
  std::vector<Complex> rows(values.size()), all(values.size());
  for (int y = 0; y < size; ++y)
    for (int k = 0; k < size; ++k)
      for (int x = 0; x < size; ++x)
        rows[at(y, k)] += values[at(y, x)] * turn[static_cast<std::size_t>(k * x % size)];
  for (int k = 0; k < size; ++k)
    for (int l = 0; l < size; ++l)
      for (int y = 0; y < size; ++y)
        all[at(l, k)] += rows[at(y, k)] * turn[static_cast<std::size_t>(l * y % size)];
  double low = 0.0, total = 0.0;
  int low_count = 0, count = 0;
  for (int l = 0; l < size; ++l)
    for (int k = 0; k < size; ++k) {
      if (l == 0 && k == 0) continue;
      const double f = std::hypot(std::min(l, size - l), std::min(k, size - k));
      const double p = std::norm(all[at(l, k)]);
      total += p;
      ++count;
      if (f < limit) {
        low += p;
        ++low_count;
      }
    }
  return {low / low_count, total / count};
}

TEST(BlueNoise, HasLittleEnergyAtLowFrequencies) {
  // At least 10 dB below white noise under a quarter of the Nyquist frequency.
  const std::vector<std::uint32_t> ranks = void_and_cluster(64, 1);
  std::vector<double> blue, white;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    blue.push_back(ranks[i] / 4096.0);
    white.push_back(unit_float(pcg_hash(static_cast<std::uint32_t>(i))));
  }
  const auto [blue_low, blue_all] = power(blue, 64, 8.0);
  const auto [white_low, white_all] = power(white, 64, 8.0);
  EXPECT_LT(10.0 * std::log10(blue_low / blue_all), -10.0);
  EXPECT_NEAR(10.0 * std::log10(white_low / white_all), 0.0, 2.0);
}

TEST(BlueNoise, TileIsDeterministicAndInRange) {
  const std::vector<glm::vec2>& tile = blue_noise_tile();
  ASSERT_EQ(tile.size(), std::size_t{kBlueNoiseSize} * kBlueNoiseSize);
  std::uint32_t hash = 0;
  for (const glm::vec2& v : tile) {
    ASSERT_GT(v.x, 0.0f);
    ASSERT_LT(v.x, 1.0f);
    hash = hash_combine(hash, static_cast<std::uint32_t>(v.x * 16384.0f));
    hash = hash_combine(hash, static_cast<std::uint32_t>(v.y * 16384.0f));
  }
  // Must be the same on every machine and compiler, or pictures with the same seed would differ.
  EXPECT_EQ(hash, 2867323639u);
}

TEST(Sampling, CosineHemisphereHasTheRightMean) {
  glm::dvec3 sum(0.0);
  constexpr std::uint32_t kCount = 1u << 14;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const glm::vec3 d = sample_cosine_hemisphere(sobol_owen(i, 3));
    ASSERT_NEAR(glm::length(d), 1.0f, 1e-5f);
    ASSERT_GE(d.z, 0.0f);
    sum += glm::dvec3(d);
  }
  EXPECT_NEAR(sum.z / kCount, 2.0 / 3.0, 1e-3) << "mean cosine of a cosine density";
  EXPECT_NEAR(sum.x / kCount, 0.0, 1e-3);
  EXPECT_NEAR(sum.y / kCount, 0.0, 1e-3);
}

TEST(Sampling, BasisIsOrthonormalForEveryNormal) {
  for (std::uint32_t i = 0; i < 2000; ++i) {
    glm::vec3 n = sample_cosine_hemisphere(sobol_owen(i, 9));
    if (i & 1) n = -n;
    if (i == 0) n = glm::vec3(0, 0, -1);
    if (i == 2) n = glm::vec3(0, 0, 1);
    const glm::vec3 t = to_world({1, 0, 0}, n), b = to_world({0, 1, 0}, n);
    EXPECT_NEAR(glm::dot(t, n), 0.0f, 2e-6f);
    EXPECT_NEAR(glm::dot(b, n), 0.0f, 2e-6f);
    EXPECT_NEAR(glm::dot(t, b), 0.0f, 2e-6f);
    EXPECT_NEAR(glm::length(t), 1.0f, 2e-6f);
    EXPECT_NEAR(glm::dot(glm::cross(t, b), n), 1.0f, 4e-6f) << "right-handed";
  }
}

TEST(Sampling, SunStaysWithinItsDisk) {
  const glm::vec3 axis = glm::normalize(glm::vec3(0.3f, 0.8f, -0.5f));
  const float radius = 0.05f;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const glm::vec3 d = sample_sun(sobol_owen(i, 4), axis, std::tan(radius));
    EXPECT_GE(glm::dot(d, axis), std::cos(radius) - 1e-6f);
  }
}

TEST(Sampling, PixelSamplesAverageToUniform) {
  for (std::uint32_t pair = 0; pair < 3; ++pair) {
    glm::dvec2 sum(0.0);
    for (std::uint32_t i = 0; i < 256; ++i) {
      const glm::vec2 u = pixel_sample(1000, 77, i, pair, 42);
      ASSERT_GE(u.x, 0.0f);
      ASSERT_LT(u.x, 1.0f);
      ASSERT_LT(u.y, 1.0f);
      sum += glm::dvec2(u);
    }
    EXPECT_NEAR(sum.x / 256, 0.5, 0.004);
    EXPECT_NEAR(sum.y / 256, 0.5, 0.004);
  }
}

}  // namespace
}  // namespace kaamos::effects

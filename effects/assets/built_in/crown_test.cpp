// SPDX-License-Identifier: MIT
// Tests what the crown is made for: crevices that are dark, and samples by the cosine that beat
// uniform ones about twofold.
#include "effects/assets/built_in/crown.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "effects/assets/common/sampling.h"
#include "effects/assets/common/sobol.h"
#include "effects/assets/scene/host_rays_test_support.h"

namespace kaamos::effects {
namespace {

constexpr float kReach = 4.0f;

bool is_open(const HostRays& rays, const glm::dvec3& at, const glm::vec3& normal,
             const glm::vec3& local) {
  const glm::dvec3 way(kReach * to_world(local, normal));
  const auto hit = rays.nearest(at + 1e-6 * glm::dvec3(normal), way);
  return !hit || hit->t > 1.0;
}

double openness(const HostRays& rays, const glm::dvec3& at, const glm::vec3& normal) {
  constexpr std::uint32_t kRays = 128;
  int open = 0;
  for (std::uint32_t i = 0; i < kRays; ++i) {
    open += is_open(rays, at, normal, sample_cosine_hemisphere(sobol_owen(i, 7)));
  }
  return open / static_cast<double>(kRays);
}

TEST(Crown, HasDarkCrevices) {
  const Scene scene = make_crown();
  EXPECT_EQ(std::count_if(scene.instances.begin(), scene.instances.end(),
                          [](const Instance& i) { return i.name.rfind("spike", 0) == 0; }),
            kCrownSpikes);
  EXPECT_LT(instanced_triangle_count(scene), 10000u);
  const HostRays rays(scene);
  EXPECT_GT(openness(rays, {3.0, 0, 0}, {0, 1, 0}), 0.97);
  // In the groove of the band, outwards; in the corner between plane and band.
  EXPECT_LT(openness(rays, {0, kCrownGroove, kCrownRadius - 0.0195}, {0, 0, 1}), 0.3);
  EXPECT_LT(openness(rays, {0, 0, kCrownRadius + 0.02}, {0, 1, 0}), 0.45);
}

// "8 uniform rays are about as good as 4 by the cosine", where two thirds are open: a single ray's
// variance, and what it is where directions are blocked whatever their cosine.
// [survey 7.4]
TEST(Crown, UniformRaysHaveTwiceTheVariance) {
  const HostRays rays(make_crown());
  for (const double away : {0.53, 0.6}) {
    const glm::dvec3 at(away, 0, 0.02);
    constexpr std::uint32_t kRays = 256;
    double cosine = 0, uniform = 0, uniform_square = 0;
    for (std::uint32_t k = 0; k < kRays; ++k) {
      const glm::vec2 u = sobol_owen(k, 11);
      cosine += is_open(rays, at, {0, 1, 0}, sample_cosine_hemisphere(u));
      const float height = 1.0f - u.x, radius = std::sqrt(1.0f - height * height);
      const glm::vec3 way(radius * std::cos(6.2831853f * u.y), radius * std::sin(6.2831853f * u.y),
                          height);
      const double value = is_open(rays, at, {0, 1, 0}, way) ? 2.0 * height : 0.0;
      uniform += value;
      uniform_square += value * value;
    }
    const double p = cosine / kRays, mean = uniform / kRays;
    EXPECT_NEAR(p, mean, 0.03);
    const double ratio = (uniform_square / kRays - mean * mean) / (p - p * p);
    EXPECT_NEAR(ratio, (4.0 * p / 3.0 - p * p) / (p - p * p), 0.3) << p;
    EXPECT_GT(ratio, 1.4) << p;
    EXPECT_LT(ratio, 3.0) << p;
  }
}

}  // namespace
}  // namespace kaamos::effects

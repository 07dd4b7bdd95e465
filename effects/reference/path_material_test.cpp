// SPDX-License-Identifier: MIT
// The material model: white furnaces and a closed cavity against quadrature.
#include <gtest/gtest.h>

#include <vector>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/reference/host_bsdf_fixture.h"
#include "effects/reference/path_fixture.h"

namespace kaamos::effects {
namespace {

TEST(PathAlbedo, AgreesWithTheListOfKnownValues) {
  // f0 = 1: x + y.
  struct {
    double alpha, degrees, expected;
  } const rows[] = {{0.1, 80, 0.8955},
                    {0.5, 0, 0.6878},
                    {0.5, 30, 0.6831},
                    {1.0, 85, 0.7801},
                    {1.0, 0, 1 - std::log(2.0)}};
  for (const auto& row : rows) {
    const glm::dvec2 parts =
        specular_parts(std::sqrt(row.alpha), std::cos(row.degrees * std::numbers::pi / 180), 256);
    EXPECT_NEAR(parts.x + parts.y, row.expected, 2e-4) << row.alpha << " " << row.degrees;
  }
}

// Sums over directions of light instead of facets: another quadrature of the same integral.
TEST(PathAlbedo, AgreesWithAnIntegralOverDirections) {
  for (const double roughness : {0.3, 0.55, 0.8, 1.0}) {
    for (const double degrees : {0.0, 45.0, 75.0}) {
      const HostBsdf bsdf(degrees, 0.6, 1, roughness);
      const double integral = over_hemisphere(
          [&](const glm::dvec3& light) { return bsdf.specular_times_cosine(light); }, 1200);
      EXPECT_NEAR(bsdf.albedo, integral, 1e-3) << roughness << " " << degrees;
    }
  }
}

TEST(PathAlbedo, TableIsFineEnough) {
  const std::vector<glm::vec2> table = specular_albedo_table();
  double worst = 0;
  for (double roughness = 0.05; roughness < 1; roughness += 0.0573) {
    for (double degrees = 0; degrees < 90; degrees += 4.3) {
      const double cosine = std::cos(degrees * std::numbers::pi / 180);
      const double column = std::sqrt(cosine) * (kAlbedoCosines - 1);
      const double row =
          std::sqrt((roughness - kPathMirrorRoughness) / (1 - kPathMirrorRoughness)) *
          (kAlbedoRoughnesses - 1);
      const auto x = std::min(static_cast<std::uint32_t>(column), kAlbedoCosines - 2);
      const auto y = std::min(static_cast<std::uint32_t>(row), kAlbedoRoughnesses - 2);
      const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return glm::dvec2(table[(y + j) * kAlbedoCosines + x + i]);
      };
      const glm::dvec2 read = glm::mix(glm::mix(at(0, 0), at(1, 0), column - x),
                                       glm::mix(at(0, 1), at(1, 1), column - x), row - y);
      const glm::dvec2 exact = specular_parts(roughness, cosine, 128);
      worst = std::max({worst, std::abs(read.x - exact.x), std::abs(read.y - exact.y)});
    }
  }
  EXPECT_LT(worst, 2e-3);
}

class PathMaterial : public OnBackends {};

TEST_P(PathMaterial, WhiteFurnace) {
  struct {
    float base, metallic, roughness;
    double degrees;
  } const rows[] = {{1.0f, 1, 0.316228f, 80}, {1.0f, 1, 0.707107f, 0}, {1.0f, 1, 0.707107f, 30},
                    {1.0f, 1, 1.0f, 85},      {1.0f, 1, 1.0f, 0},      {1.0f, 0, 0.5f, 60},
                    {0.3f, 0, 0.2f, 75},      {0.5f, 0.5f, 0.4f, 20},  {0.8f, 1, 0.0f, 70},
                    {0.6f, 0, 0.0f, 80}};
  for (const auto& row : rows) {
    PathReferenceDesc desc;
    desc.width = desc.height = 8;
    const Scene scene = plane_scene(glm::vec3(row.base), row.metallic, row.roughness, row.degrees);
    const auto reference = trace_reference(scene, desc, 2048, GetParam());
    const double found = mean_of(*reference, "radiance");
    HostBsdf bsdf(row.degrees, row.base, row.metallic, std::max(row.roughness, 0.04f));
    if (row.roughness == 0) {
      bsdf.albedo = bsdf.f0() + (1 - bsdf.f0()) * std::pow(1 - bsdf.view.z, 5);
    }
    EXPECT_NEAR(found, bsdf.total_albedo(), 0.002)
        << row.base << " " << row.metallic << " " << row.roughness << " " << row.degrees;
    EXPECT_LE(found, 1.0 + 4 * error_of(*reference, "radiance"));
  }
}

// In a sphere whose inside glows evenly, a chord meets the wall at the same angle at both ends, so
// the radiance depends on that angle alone and solves an integral equation of one variable.
double cavity_radiance(double base, double roughness, double glow, double degrees) {
  constexpr int kAngles = 48;
  std::vector<double> light(kAngles, glow), next(kAngles);
  const auto angle_of = [](int i) { return 90.0 * (i + 0.5) / kAngles; };
  const auto at = [&](const std::vector<double>& values, double cosine) {
    const double place = std::clamp(
        std::acos(std::clamp(cosine, 0.0, 1.0)) * 180 / std::numbers::pi / 90 * kAngles - 0.5, 0.0,
        kAngles - 1.001);
    const auto i = static_cast<int>(place);
    return values[i] + (values[i + 1] - values[i]) * (place - i);
  };
  std::vector<HostBsdf> bsdfs;
  for (int i = 0; i < kAngles; ++i) bsdfs.emplace_back(angle_of(i), base, 0, roughness);
  // One row of the kernel for each angle.
  constexpr int kRings = 96;
  std::vector<double> kernel(kAngles * kRings);
  for (int i = 0; i < kAngles; ++i) {
    for (int ring = 0; ring < kRings; ++ring) {
      const double z = (ring + 0.5) / kRings, r = std::sqrt(1 - z * z);
      double sum = 0;
      constexpr int kTurn = 128;
      for (int k = 0; k < kTurn; ++k) {
        const double phi = 2 * std::numbers::pi * (k + 0.5) / kTurn;
        sum += bsdfs[i].times_cosine({r * std::cos(phi), r * std::sin(phi), z});
      }
      kernel[i * kRings + ring] = sum * 2 * std::numbers::pi / kTurn / kRings;
    }
  }
  for (int iteration = 0; iteration < 200; ++iteration) {
    for (int i = 0; i < kAngles; ++i) {
      next[i] = glow;
      for (int ring = 0; ring < kRings; ++ring) {
        next[i] += kernel[i * kRings + ring] * at(light, (ring + 0.5) / kRings);
      }
    }
    light = next;
  }
  return at(light, std::cos(degrees * std::numbers::pi / 180));
}

TEST_P(PathMaterial, ClosedCavityHoldsAllOfItsLight) {
  const float base = 0.7f, roughness = 0.6f;
  for (const double degrees : {0.0, 55.0}) {
    // The camera stands inside and looks at the wall at that angle.
    const double s = std::sin(degrees * std::numbers::pi / 180);
    Scene scene = empty_scene(glm::vec3(0), {0, s, 0}, {1, s, 0}, 0.02);
    const std::uint32_t wall = add_material(scene, glm::vec3(base), 0, roughness, glm::vec3(0.25f));
    std::vector<glm::dvec2> profile;
    constexpr int kRings = 96;
    for (int i = 0; i <= kRings; ++i) {
      const double angle = std::numbers::pi * (static_cast<double>(i) / kRings - 0.5);
      profile.emplace_back(i == 0 || i == kRings ? 0.0 : std::cos(angle), std::sin(angle));
    }
    add_thing(scene, "cavity", revolve(profile, 192), wall);
    PathReferenceDesc desc;
    desc.width = desc.height = 8;
    const auto reference = trace_reference(scene, desc, 1024, GetParam());
    const double expected = cavity_radiance(base, roughness, 0.25, degrees);
    const double tolerance = 4 * error_of(*reference, "radiance") + 0.003 * expected;
    EXPECT_NEAR(mean_of(*reference, "radiance"), expected, tolerance) << degrees;
  }
}

// A mirror shows exactly what the camera would see from behind it.
TEST_P(PathMaterial, MirrorShowsTheReflectedPicture) {
  Scene scene = plane_scene(glm::vec3(1), 1, 0, 45, glm::vec3(0));
  scene.cameras.front().vertical_fov = 0.5;
  const std::uint32_t glow = add_material(scene, glm::vec3(0), 0, 1, glm::vec3(2, 1, 0.5f));
  add_thing(scene, "panel", patch({-3, 0.5, -0.4}, {0, 1.2, 0}, {0, 0, 0.9}, 1, 1), glow);
  PathReferenceDesc desc;
  desc.width = desc.height = 32;
  const FloatImage seen = [&] {
    const auto reference = trace_reference(scene, desc, 2, GetParam());
    return reference->sums().mean(*reference->sums().find("reflection"));
  }();
  Scene mirrored = scene;
  mirrored.instances.erase(mirrored.instances.begin());
  const glm::dmat4 flip = glm::dmat4(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
  mirrored.instances.front().transform = flip;
  const auto direct = trace_reference(mirrored, desc, 2, GetParam());
  const FloatImage expected = direct->sums().mean(*direct->sums().find("radiance"));
  double lit = 0;
  int different = 0;
  for (std::size_t i = 0; i < seen.values.size(); ++i) {
    lit += expected.values[i];
    if (std::abs(seen.values[i] - expected.values[i]) > 1e-3f) ++different;
  }
  EXPECT_GT(lit, 10);
  // Pixels whose ray passes within rounding of the panel's edge.
  EXPECT_LE(different, 6);
}

INSTANTIATE_TEST_SUITE_P(Backends, PathMaterial, testing::Values("embree", "vulkan"), backend_of);

}  // namespace
}  // namespace kaamos::effects

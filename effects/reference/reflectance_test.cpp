// SPDX-License-Identifier: MIT
// Index of refraction, specular factor and colour: a smooth black plane under an even sky mirrors
// what Fresnel's law says, in frames as in the reference. [KHR_materials_ior,
// KHR_materials_specular]
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "effects/northlight/frame_renderer.h"
#include "effects/reference/path_fixture.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

struct Row {
  float dielectric_f0, specular;
  glm::vec3 color;
};
constexpr Row kRows[] = {{0.04f, 1, glm::vec3(1)},
                         {0.0204f, 1, glm::vec3(1)},  // water
                         {0.1724f, 1, glm::vec3(1)},  // diamond
                         {0.04f, 0.5f, glm::vec3(1)},
                         {0.04f, 0, glm::vec3(1)},
                         {0.1724f, 0.75f, glm::vec3(1, 0.5f, 0.25f)}};

Scene black_mirror(const Row& row, double degrees) {
  Scene scene = plane_scene(glm::vec3(0), 0, 0, degrees);
  MaterialConstants& material = scene.materials[0].constants;
  material.dielectric_f0 = row.dielectric_f0;
  material.specular = row.specular;
  material.specular_color = row.color;
  return scene;
}

// [Schlick 1994], from f0 to the specular factor.
double fresnel(const Row& row, int channel, double degrees) {
  const double f0 = row.specular * row.dielectric_f0 * row.color[channel];
  return f0 + (row.specular - f0) * std::pow(1 - std::cos(degrees * 3.14159265358979 / 180), 5);
}

class Reflectance : public OnBackends {};
INSTANTIATE_TEST_SUITE_P(Backends, Reflectance, testing::Values("embree", "vulkan"), backend_of);

TEST_P(Reflectance, TheReferenceMirrorsByFresnelsLaw) {
  for (const Row& row : kRows) {
    for (const double degrees : {0.0, 60.0, 80.0}) {
      PathReferenceDesc desc;
      desc.width = desc.height = 4;
      const auto reference = trace_reference(black_mirror(row, degrees), desc, 64, GetParam());
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(mean_of(*reference, "radiance", static_cast<std::uint32_t>(c)),
                    fresnel(row, c, degrees), 2e-4)
            << row.dielectric_f0 << " " << row.specular << " " << degrees << " " << c;
    }
  }
}

// The G-buffer keeps roots of 8 bits, and colours of 4.
TEST_P(Reflectance, FramesMirrorByFresnelsLaw) {
  for (const Row& row : kRows) {
    for (const double degrees : {0.0, 60.0, 80.0}) {
      // Pipelines take long to make there.
      if (GetParam() == "vulkan" && (row.color.g == 1 || degrees != 60.0)) continue;
      const Scene scene = black_mirror(row, degrees);
      FrameSettings settings;
      settings.width = settings.height = 16;
      settings.effects = choose_effects({"reflections"});
      settings.effects.at("reflections").samples = 16;
      settings.volume.given = std::make_shared<IndirectVolume>();
      rtapi::DeviceDesc desc;
      desc.Backend = GetParam();
      const auto renderer = FrameRenderer::create(test::device_for(desc), scene, settings).value();
      renderer->render().value();
      const FloatImage radiance = renderer->read("radiance").value();
      for (int c = 0; c < 3; ++c) {
        const double wanted = fresnel(row, c, degrees);
        EXPECT_NEAR(radiance.at(8, 8, static_cast<std::uint32_t>(c)), wanted, 0.004 + 0.03 * wanted)
            << row.dielectric_f0 << " " << row.specular << " " << degrees << " " << c;
      }
    }
  }
}

}  // namespace
}  // namespace kaamos::effects

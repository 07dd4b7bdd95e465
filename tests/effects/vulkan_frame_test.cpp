// SPDX-License-Identifier: MIT
//
// The whole frame with every effect on both backends. Compiling the software driver's pipelines
// takes most of the time, so a few frames test a lot.
#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

#include "comparing.h"
#include "effects/assets/built_in/lounge.h"
#include "room.h"
#include "tests/vulkan/support.h"

namespace kaamos::test {
namespace {

using namespace effects;

void expect_parity(const Pictures& vulkan, const Pictures& embree) {
  for (const auto& [name, image] : embree) {
    const double db = decibels(vulkan.at(name), image);
    const std::uint32_t off = pixels_off(vulkan.at(name), image, 1e-3);
    std::printf("%-22s %4.0f dB, %u pixels off by more than 1e-3\n", name.c_str(), db, off);
    EXPECT_GE(db, 75) << name;
    // A hit where rounding decides a comparison of distances, and what a filter makes of it. In
    // full sun, a base colour of 8 bits that rounds the other way shows too: the same pixels differ
    // without any denoiser.
    EXPECT_LE(off, name == "radiance" ? 12u : 4u) << name;
  }
  // Not a single ray of effects that count rays may go another way. (Contact shadows fade with the
  // distance of the hit.)
  EXPECT_LE(pixels_off(vulkan.at("ids"), embree.at("ids"), 0), 2u);  // the triangle beside an edge
  for (const char* name : {"ao", "sun", "glass_layers"}) {
    EXPECT_EQ(vulkan.at(name).values, embree.at(name).values) << name;
  }
}

// Two frames, so that the second filters with a history.
TEST(VulkanWholeFrame, DrawsWhatEmbreeDraws) {
  KAAMOS_NEED_VULKAN();
  const std::vector<Scene> scenes(2, make_room());
  RigOptions options;
  const std::vector<Pictures> embree = render_frames(scenes, options);
  options.backend = "vulkan";
  const std::vector<Pictures> vulkan = render_frames(scenes, options);
  expect_parity(vulkan[0], embree[0]);
  std::printf("second frame\n");
  expect_parity(vulkan[1], embree[1]);
}

// The scene of the README's pictures, with its textures, leaves and lamps.
TEST(VulkanWholeFrame, DrawsTheLounge) {
  KAAMOS_NEED_VULKAN();
  const Scene scene = make_lounge();
  RigOptions options;
  options.bake_samples = 1;
  const Pictures embree = render(scene, options);
  options.backend = "vulkan";
  expect_parity(render(scene, options), embree);
}

// Drivers may define min and max of a NaN as they like; the shaders must not depend on it.
TEST(VulkanWholeFrame, ContainsWhatIsBroken) {
  KAAMOS_NEED_VULKAN();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  Scene broken = make_room();
  broken.materials[kRoomMetal].constants.emissive = glm::vec3(kNan);
  broken.materials[kRoomMetal].constants.roughness = kNan;
  broken.materials[kRoomCard].constants.base_color = glm::vec4(kNan, kNan, kNan, 1);
  broken.materials[kRoomGlass].constants.emissive = glm::vec3(kNan);
  broken.lights[0].color = glm::vec3(kNan);
  for (Mesh& mesh : broken.meshes) {
    if (mesh.name == "floor") mesh.vertices[4].normal = glm::vec3(kNan);
  }
  const std::vector<Scene> scenes = {broken, make_room()};
  RigOptions options;
  options.width = 32;
  options.height = 18;
  const std::vector<Pictures> embree = render_frames(scenes, options);
  options.backend = "vulkan";
  const std::vector<Pictures> vulkan = render_frames(scenes, options);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    EXPECT_EQ(not_finite(embree[i]), "");
    EXPECT_EQ(not_finite(vulkan[i]), "");
    expect_parity(vulkan[i], embree[i]);
  }
}

}  // namespace
}  // namespace kaamos::test

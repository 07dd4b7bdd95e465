// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/lamp_shapes.h"

#include <gtest/gtest.h>

#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/scene/shapes.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kGlowing = 1;

// Two lamps on a large floor: each a post and a bulb, as one mesh. A light stands in one of them.
Scene lamps() {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  scene.instances.resize(1);
  scene.lights.clear();
  Material bulb = scene.materials[0];
  bulb.constants.emissive = glm::vec3(5);
  scene.materials.push_back(bulb);
  Shape glow;
  append(glow, box({0.05, 0.05, 0.05}), translate({0, 1.5, 0}));
  Mesh lamp;
  add_shape(lamp, box({0.02, 1.4, 0.02}), 0);
  add_shape(lamp, glow, kGlowing);
  scene.meshes.push_back(lamp);
  for (const double x : {-1.0, 1.0}) {
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    instance.transform = translate({x, 0, 0});
    scene.instances.push_back(instance);
  }
  Light light;
  light.position = {1, 1.5, 0};
  scene.lights.push_back(light);
  return scene;
}

TEST(LampShapes, BecomeInstancesOfTheirOwn) {
  Scene scene = lamps();
  const std::uint64_t triangles = instanced_triangle_count(scene);
  EXPECT_EQ(separate_lamp_shapes(scene), 1u);
  EXPECT_TRUE(validate(scene).ok());
  EXPECT_EQ(instanced_triangle_count(scene), triangles);
  ASSERT_EQ(scene.instances.size(), 4u);
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const bool is_lit = instance.transform[3].x > 0;
    if (instance.mask == kMaskEmissiveProxy) {
      EXPECT_TRUE(is_lit);
      ASSERT_EQ(mesh.geometries.size(), 1u);
      EXPECT_EQ(mesh.geometries[0].material, kGlowing);
      EXPECT_NEAR(mesh.bounds().center().y, 1.5, 1e-6);
    } else if (is_lit) {
      EXPECT_EQ(mesh.geometries.size(), 1u) << "the post alone";
    }
  }
}

TEST(LampShapes, AreNotWhatIsLargeOrTexturedOrDark) {
  Scene scene = lamps();
  scene.materials[kGlowing].constants.emissive = glm::vec3(0);
  EXPECT_EQ(separate_lamp_shapes(scene), 0u);
  scene = lamps();
  scene.materials[kGlowing].constants.image[kEmissiveTexture] = 0;
  EXPECT_EQ(separate_lamp_shapes(scene), 0u);
  scene = lamps();
  scene.lights[0].position.y += 0.1;
  EXPECT_EQ(separate_lamp_shapes(scene), 0u);
  scene = lamps();
  const float wide = static_cast<float>(glm::length(scene_bounds(scene).size()));
  for (Vertex& vertex : scene.meshes.back().vertices) {
    if (vertex.position.y > 1.41f) vertex.position.x *= wide;
  }
  EXPECT_EQ(separate_lamp_shapes(scene), 0u);
}

}  // namespace
}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/glass_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/assets/built_in/mirror_hall.h"
#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/scene/material_override.h"
#include "effects/assets/scene/shapes.h"

namespace kaamos::effects {
namespace {

std::ptrdiff_t glass_instances(const Scene& scene) {
  return std::count_if(scene.instances.begin(), scene.instances.end(),
                       [](const Instance& i) { return i.mask == kMaskTransparent; });
}

TEST(GlassScenes, AreValidAndHaveTheirPanes) {
  for (const bool crossed : {false, true}) {
    for (const bool thick : {false, true}) {
      const Scene scene = make_glass_stack({.panes = 8, .crossed = crossed, .thick = thick});
      const Status status = validate(scene);
      EXPECT_TRUE(status.ok()) << status.error().message;
      EXPECT_EQ(glass_instances(scene), 8 + 3);
      EXPECT_LT(instanced_triangle_count(scene), 20000u);
    }
  }
  EXPECT_EQ(glass_instances(make_glass_stack({.panes = 99, .cabinet = false})), 8);
  const Pane pane;
  EXPECT_TRUE(validate(make_pane_oracle({&pane, 1}, glm::vec3(1))).ok());
}

TEST(MirrorHall, IsValidAndHasItsStrip) {
  const Scene scene = make_mirror_hall();
  const Status status = validate(scene);
  ASSERT_TRUE(status.ok()) << status.error().message;
  EXPECT_EQ(scene.instances[0].name, "mirror left");
  EXPECT_EQ(scene.instances[1].name, "mirror right");
  int strips = 0;
  for (const Material& material : scene.materials) {
    if (material.name.rfind("strip ", 0) != 0) continue;
    EXPECT_FLOAT_EQ(material.constants.roughness, 0.1f * strips);
    ++strips;
  }
  EXPECT_EQ(strips, kMirrorHallSteps);
  // The props behind the camera and above the picture must be out of its view.
  const Camera& camera = scene.cameras.front();
  const glm::dmat4 to_camera = glm::inverse(camera.camera_to_world);
  int hidden = 0;
  for (const Instance& instance : scene.instances) {
    const glm::dvec3 p(to_camera * instance.transform[3]);
    const bool above = instance.name.rfind("above", 0) == 0;
    if (!above && instance.name.rfind("behind", 0) != 0) continue;
    const bool seen = p.z < 0 && (p.y - 0.35) < -p.z * std::tan(0.5 * camera.vertical_fov);
    EXPECT_FALSE(seen) << instance.name;
    ++hidden;
  }
  EXPECT_EQ(hidden, 6);
}

TEST(MaterialOverride, Parses) {
  const auto parsed = parse_material_override("a:b:alpha=0.3,roughness=0");
  ASSERT_TRUE(parsed.ok()) << parsed.error().message;
  EXPECT_EQ(parsed.value().name, "a:b");
  ASSERT_EQ(parsed.value().values.size(), 2u);
  EXPECT_EQ(parsed.value().values[0].first, "alpha");
  EXPECT_EQ(parsed.value().values[0].second, 0.3f);
  EXPECT_EQ(parsed.value().values[1].second, 0.0f);
}

TEST(MaterialOverride, SaysWhatIsWrong) {
  const struct {
    const char *text, *part;
  } rows[] = {{"", "keys are alpha, roughness"},
              {"glass", "NAME:KEY=VALUE"},
              {":alpha=1", "NAME:KEY=VALUE"},
              {"glass:", "is not KEY=VALUE"},
              {"glass:alpha", "is not KEY=VALUE"},
              {"glass:shine=1", "key \"shine\" is unknown; keys are alpha, roughness, metallic"},
              {"glass:alpha=much", "alpha is \"much\", which is not a number"},
              {"glass:alpha=", "which is not a number"},
              {"glass:alpha=0.5x", "which is not a number"},
              {"glass:alpha=nan", "0 to 1 is allowed"},
              {"glass:alpha=1.5", "alpha is 1.5, 0 to 1 is allowed"},
              {"glass:emission=-1", "0 or more is allowed"},
              {"glass:alpha=0.5,", "is not KEY=VALUE"}};
  for (const auto& row : rows) {
    const auto parsed = parse_material_override(row.text);
    ASSERT_FALSE(parsed.ok()) << row.text;
    EXPECT_NE(parsed.error().message.find(row.part), std::string::npos) << parsed.error().message;
  }
  Scene scene = make_glass_stack({.panes = 1, .cabinet = false});
  const Status missing = override_material(scene, {"nothing", {}});
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().message.find("no material \"nothing\""), std::string::npos);
  EXPECT_NE(missing.error().message.find("\"pane 0\""), std::string::npos)
      << missing.error().message;
}

// A mesh that becomes glass in part is split; instances that are opaque again lose the glass mask.
TEST(MaterialOverride, MakesGlass) {
  Scene scene = make_sphere_oracle(1.0, 1.5);
  Material lens = scene.materials[0];
  lens.name = "lens";
  scene.materials.push_back(lens);
  add_shape(scene.meshes[1], box(glm::dvec3(0.1)), 1);
  const std::uint64_t triangles = instanced_triangle_count(scene);
  const std::size_t instances = scene.instances.size();
  ASSERT_TRUE(override_material(scene, {"lens", {{"roughness", 0.25f}}}).ok());
  EXPECT_EQ(scene.instances.size(), instances);
  EXPECT_EQ(scene.materials[1].constants.roughness, 0.25f);
  ASSERT_TRUE(override_material(scene, {"lens", {{"alpha", 0.3f}}}).ok());
  ASSERT_EQ(scene.instances.size(), instances + 1);
  EXPECT_EQ(glass_instances(scene), 1);
  EXPECT_EQ(scene.instances.back().mask, kMaskTransparent);
  EXPECT_EQ(scene.instances.back().transform, scene.instances[1].transform);
  EXPECT_EQ(instanced_triangle_count(scene), triangles);
  EXPECT_EQ(scene.materials[1].constants.base_color.a, 0.3f);
  const Status status = validate(scene);
  EXPECT_TRUE(status.ok()) << status.error().message;
  ASSERT_TRUE(override_material(scene, {"lens", {{"alpha", 1.0f}}}).ok());
  EXPECT_EQ(glass_instances(scene), 0);
}

}  // namespace
}  // namespace kaamos::effects

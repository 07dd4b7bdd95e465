// SPDX-License-Identifier: MIT
// Scenes made by code are valid, have names, and are closed where they claim to be.
#include "effects/assets/built_in/built_in.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "effects/assets/built_in/leak_scenes.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

TEST(BuiltInScenes, AreValidAndFoundByName) {
  std::set<std::string> names;
  for (const BuiltInScene& entry : built_in_scenes()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    ASSERT_EQ(find_built_in_scene(entry.name), &entry);
    const Scene scene = entry.make();
    EXPECT_EQ(scene.name, entry.name);
    EXPECT_FALSE(scene.cameras.empty()) << entry.name;
    const Status status = validate(scene);
    EXPECT_TRUE(status.ok()) << entry.name << ": " << (status.ok() ? "" : status.error().message);
    EXPECT_NE(built_in_scene_names().find(entry.name), std::string::npos);
  }
  for (const BuiltInScene& entry : scene_variants()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    ASSERT_EQ(find_built_in_scene(entry.name), &entry);
    EXPECT_EQ(entry.make().name, entry.name);
  }
  EXPECT_EQ(find_built_in_scene("attic"), nullptr);
}

using Point = std::tuple<float, float, float>;

// Number of edges that are not shared by exactly two triangles, one in each direction.
int open_edges(const Mesh& mesh) {
  std::map<std::pair<Point, Point>, int> edges;
  for (const Geometry& geometry : mesh.geometries) {
    for (std::uint32_t i = 0; i < geometry.index_count / 3; ++i) {
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        const glm::vec3 a = mesh.corner(geometry, i, corner).position + 0.0f;
        const glm::vec3 b = mesh.corner(geometry, i, (corner + 1) % 3).position + 0.0f;
        const Point from(a.x, a.y, a.z), to(b.x, b.y, b.z);
        if (from == to) continue;  // at a pole
        ++edges[{from, to}];
        --edges[{to, from}];
      }
    }
  }
  int open = 0;
  for (const auto& [edge, count] : edges) open += count != 0;
  return open;
}

// The only open edges of the shell are its two feet, which are below the floor.
TEST(ThinDome, ShellIsClosedButForItsFeet) {
  for (const bool sealed : {false, true}) {
    for (const double thickness : {0.0005, 0.005, 0.05}) {
      const Scene scene = make_thin_dome({.thickness = thickness, .sealed = sealed});
      EXPECT_TRUE(validate(scene).ok());
      EXPECT_EQ(open_edges(scene.meshes[1]), 2 * 2 * 64) << sealed << " " << thickness;
    }
  }
  EXPECT_EQ(make_sealed_cells({.thickness = 0.3}).instances.size(), 10u);
}

}  // namespace
}  // namespace kaamos::effects

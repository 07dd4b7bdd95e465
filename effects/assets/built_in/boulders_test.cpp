// SPDX-License-Identifier: MIT
// Levels of detail: what the camera sees and what rays see is one level, and what would come of
// two.
#include "effects/assets/built_in/boulders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "effects/assets/built_in/scene_parts.h"
#include "effects/assets/scene/host_rays_test_support.h"
#include "effects/assets/scene/levels.h"
#include "effects/northlight/level_mismatch.h"

namespace kaamos::effects {
namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 54;

// Two boulders: near enough for many pixels.
constexpr BouldersDesc kTwo = {.count = 2};

struct Picture {
  explicit Picture(const Scene& scene) {
    FrameSettings settings;
    settings.width = kWidth;
    settings.height = kHeight;
    settings.effects = choose_effects({"sun"});
    settings.effects["sun"].samples = 1;
    settings.whole_frame = false;
    auto renderer = FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
    renderer->render().value();
    sun = renderer->read("sun").value();
    ids = renderer->read("ids").value();
    position = renderer->read("position").value();
    normal = renderer->read("normal").value();
  }
  bool shows_boulder(std::size_t i) const { return ids.values[2 * i] > 1; }

  FloatImage sun, ids, position, normal;
};

// Where effects/shaders/encoding.hlsli's OctahedralDecode finds a normal.
glm::dvec3 decoded(float x, float y) {
  glm::dvec3 n(x, y, 1 - std::abs(x) - std::abs(y));
  const double t = std::max(-n.z, 0.0);
  n.x += n.x >= 0 ? -t : t;
  n.y += n.y >= 0 ? -t : t;
  return glm::normalize(n);
}

TEST(Boulders, AreCoarserTheFartherTheyStand) {
  const Scene scene = make_boulders({});
  const std::vector<std::uint32_t> meshes = select_levels(scene, scene.cameras.front());
  std::vector<std::uint32_t> levels;
  for (std::size_t i = 1; i < meshes.size(); ++i) {
    const auto& all = scene.instances[i].levels;
    levels.push_back(static_cast<std::uint32_t>(
        std::find_if(all.begin(), all.end(),
                     [&](const Level& level) { return level.mesh == meshes[i]; }) -
        all.begin()));
  }
  EXPECT_TRUE(std::is_sorted(levels.begin(), levels.end()));
  EXPECT_EQ(levels.front(), 0u);
  EXPECT_EQ(levels.back(), kBoulderLevels - 1);
}

// The picture that a frame shows after it was told to, as northlight does, is that of its levels.
TEST(Boulders, AFrameShowsOneLevelToTheCameraAndToRays) {
  Scene shown = make_boulders({});
  show_levels(shown, shown.cameras.front());
  Scene alone = shown;
  for (Instance& instance : alone.instances) instance.levels.clear();
  EXPECT_EQ(Picture(shown).sun.values, Picture(alone).sun.values);
}

// A frame of the sun whose surfaces are drawn, and whose rays see coarser levels.
std::unique_ptr<FrameRenderer> mismatched(const Scene& scene, std::uint32_t width,
                                          std::uint32_t height, std::uint32_t coarser_rays) {
  FrameSettings settings;
  settings.width = width;
  settings.height = height;
  settings.effects = choose_effects({"sun"});
  settings.whole_frame = false;
  settings.primary = Primary::kRaster;
  settings.structures.coarser_rays = coarser_rays;
  auto renderer = FrameRenderer::create(rtapi::CreateDevice().value(), scene, settings).value();
  renderer->render().value();
  return renderer;
}

// The fine level is a square from -1 to 1 on the ground, which fills the picture. The coarse one is
// a strip above it, from x = -1 to 0, that lets no light of the sun through. The sun shines from
// where x is less, so that the strip's shadow lies `shift` farther along x: from shift - 1 to
// shift.
Scene square_and_strip(double height, double shift) {
  Scene scene = start_scene("square and strip");
  const std::uint32_t paint = add_paint(scene, "paint", {0.5f, 0.5f, 0.5f});
  const glm::dvec3 along_x(1, 0, 0), along_z(0, 0, 1);
  const std::uint32_t fine =
      add_mesh(scene, "lod0", patch(-along_x - along_z, 2.0 * along_z, 2.0 * along_x, 4, 4), paint);
  const glm::dvec3 corner = glm::dvec3(0, height, 0) - along_x - 2.0 * along_z;
  const std::uint32_t coarse =
      add_mesh(scene, "lod1", patch(corner, 4.0 * along_z, along_x, 1, 1), paint);
  add_instance(scene, "square", fine).levels = {{fine, 0.0f}, {coarse, 0.0f}};
  scene.sun =
      Sun{.direction_to_sun = glm::normalize(glm::vec3(-shift, height, 0)), .angular_radius = 0};
  Camera camera;
  camera.camera_to_world = look_at({0, 5, 0}, {0, 0, 0}, {0, 0, -1});
  camera.half_height = 1;
  scene.cameras.push_back(camera);
  return scene;
}

TEST(Boulders, TheCountOfFalseShadowsIsTheAreaOfTheShadow) {
  constexpr std::uint32_t kSide = 64;
  // Heights and shifts, and the shadow's share of the square.
  struct Row {
    double height, shift, share;
  };
  for (const Row& row :
       {Row{0.1, 0.25, 0.5}, Row{0.1, 1.5, 0.25}, Row{0.4, 1.0, 0.5}, Row{0.4, 1.75, 0.125}}) {
    const Scene scene = square_and_strip(row.height, row.shift);
    const auto renderer = mismatched(scene, kSide, kSide, 1);
    const LevelMismatch found = count_level_mismatch(*renderer).value();
    EXPECT_EQ(found.pixels, kSide * kSide);
    EXPECT_EQ(found.lit, kSide * kSide) << "nothing lies above the square itself";
    EXPECT_EQ(found.false_shadows, row.share * kSide * kSide) << row.height << " " << row.shift;
    EXPECT_EQ(found.false_light, 0u);
    // Straight from above, rays see the strip over one half and nothing over the other.
    const PrimaryDifference seen = [&] {
      renderer->render().value();
      return renderer->surfaces().compare().value().difference;
    }();
    EXPECT_EQ(seen.other_levels, kSide * kSide / 2);
    EXPECT_EQ(seen.hit_or_not, kSide * kSide / 2);
  }
}

TEST(Boulders, ThereAreNoMoreLevelsThanThereAre) {
  const Scene scene = square_and_strip(0.1, 0.25);
  EXPECT_EQ(count_level_mismatch(*mismatched(scene, 64, 64, 7)).value().false_shadows, 2048u);
}

TEST(Boulders, OneLevelCannotDiffer) {
  const Scene scene = square_and_strip(0.1, 0.25);
  const auto renderer = mismatched(scene, 8, 8, 0);
  const auto found = count_level_mismatch(*renderer);
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("coarser_rays"), std::string::npos);
}

// The camera sees the finest level; rays that start on it see another. Lit pixels of boulders that
// their own coarse level hides from the sun are false shadows; dark ones that it no longer hides
// are false light.
TEST(Boulders, CoarserLevelsInRaysAreFalseShadows) {
  const Scene fine = boulders_at(kTwo, 0);
  const Picture seen(fine);
  const glm::dvec3 eye = fine.cameras.front().position();
  const glm::dvec3 to_sun(fine.sun->direction_to_sun);
  double shares[kBoulderLevels] = {};
  for (std::uint32_t level = 0; level < kBoulderLevels; ++level) {
    const HostRays rays(boulders_at(kTwo, level));
    int lit = 0, dark = 0, false_shadows = 0, false_light = 0;
    for (std::size_t i = 0; i < std::size_t{kWidth} * kHeight; ++i) {
      if (!seen.shows_boulder(i)) continue;
      const float* p = seen.position.values.data() + 4 * i;
      const glm::dvec3 normal = decoded(seen.normal.values[2 * i], seen.normal.values[2 * i + 1]);
      if (glm::dot(normal, to_sun) <= 0) continue;
      const glm::dvec3 origin = eye + glm::dvec3(p[0], p[1], p[2]) + normal * double{p[3]};
      const bool sees = !rays.nearest(origin, to_sun).has_value();
      const bool is_lit = seen.sun.values[i] > 0.5f;
      (is_lit ? lit : dark) += 1;
      false_shadows += is_lit && !sees;
      false_light += !is_lit && sees;
    }
    ASSERT_GT(lit, 300);
    shares[level] = static_cast<double>(false_shadows) / lit;
    std::printf("level %u in rays: %.1f %% of %d lit pixels dark, %.1f %% of %d dark ones lit\n",
                level, 100 * shares[level], lit, 100.0 * false_light / std::max(dark, 1), dark);
    if (level == 0) {
      EXPECT_LE(false_shadows + false_light, 2) << "the same level";
      continue;
    }
    // The frame counts the same, in single precision and over drawn surfaces.
    Scene all = make_boulders(kTwo);
    for (Instance& instance : all.instances) {
      for (Level& each : instance.levels) each.coverage = 0;  // the finest is always drawn
    }
    const LevelMismatch found =
        count_level_mismatch(*mismatched(all, kWidth, kHeight, level)).value();
    EXPECT_NEAR(static_cast<double>(found.false_shadows), false_shadows, 0.02 * lit) << level;
    EXPECT_NEAR(static_cast<double>(found.lit), lit, 0.02 * lit);
  }
  EXPECT_GT(shares[1], 0.05);
  EXPECT_GT(shares[2], 0.05);
  // So coarse that it lies within the finest nearly everywhere.
  EXPECT_GT(shares[3], 0.005);
  EXPECT_LT(shares[3], shares[1]);
}

}  // namespace
}  // namespace kaamos::effects

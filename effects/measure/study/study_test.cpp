// SPDX-License-Identifier: MIT
// Studies of small scenes whose answers are known in closed form: a report's numbers against
// numbers that were worked out without it.
#include "effects/measure/study/study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <stdexcept>

#include "effects/assets/built_in/built_in.h"
#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/built_in/scene_parts.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/measure/run/picture_key.h"
#include "effects/measure/study/study_fixture.h"
#include "effects/reflections/traced/reflections.h"

namespace kaamos::measure {
namespace {

using namespace effects;
using namespace fixture;

void expect_explained(const std::vector<StudyResult>& results) {
  for (const StudyResult& result : results) {
    for (const StudyRow& row : result.rows) {
      EXPECT_EQ(row.note.find(kUnexplained), std::string::npos)
          << row.technique << ", " << row.label << ": " << row.note;
      EXPECT_FALSE(row.command.empty()) << row.technique;
    }
  }
}

// The root of the mean square of a function over all pixels. It takes the camera's place and the
// direction of the pixel's ray.
double root_mean_square(const Camera& camera,
                        const std::function<double(const glm::dvec3&, const glm::dvec3&)>& of) {
  double sum = 0;
  const auto ways = ways_of(camera);
  for (const glm::dvec3& way : ways) sum += std::pow(of(camera.position(), way), 2);
  return std::sqrt(sum / static_cast<double>(ways.size()));
}

TEST(Study, ShadowsHaveTheErrorsOfTheClosedForm) {
  const Penumbra penumbra;
  const Scene scene = penumbra.make_scene();
  Options options = quick_study("penumbra", "shadows");
  // Filtered maps of this size would take minutes.
  options.rows = {"sun/1 ray",
                  "sun/4 rays",
                  "sun/64 rays",
                  "adaptive-sun/5 rays at most",
                  "adaptive-sun/16 rays at most",
                  "sun-map/2048 x 2048",
                  "sun-map/8192 x 8192",
                  "sun-pcss/2048 x 2048, 16 + 32 taps",
                  "sun-per-object/2 of 2048 x 2048"};
  const auto results = study(scene, options);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].rows.size(), options.rows.size());
  expect_explained(results);
  const auto row = [&](const std::string& setting) { return row_of(results, "shadows", setting); };
  const Camera& camera = scene.cameras.front();
  // One ray is 1 or 0: its variance is v (1 - v).
  const double one_ray = root_mean_square(camera, [&](const auto& from, const auto& way) {
    const double v = penumbra.visible(penumbra.place(from, way));
    return std::sqrt(v * (1 - v));
  });
  EXPECT_NEAR(row("sun/1 ray").error, one_ray, 0.06 * one_ray);
  // Points of a sequence that covers the disk evenly do better than random ones.
  EXPECT_LT(row("sun/4 rays").error, one_ray / 2);
  EXPECT_LT(row("sun/64 rays").error, one_ray / 8);
  EXPECT_GT(row("sun/64 rays").error, one_ray / 64);
  for (const char* setting : {"sun/1 ray", "sun/4 rays", "sun/64 rays"}) {
    EXPECT_NEAR(row(setting).energy, 1, 0.02) << setting;
    EXPECT_LE(row(setting).traced, row(setting).effect == "sun" ? 64.0 : 0.0);
  }
  EXPECT_LT(row("adaptive-sun/16 rays at most").error, row("adaptive-sun/5 rays at most").error);
  EXPECT_GT(row("adaptive-sun/16 rays at most").traced, row("adaptive-sun/5 rays at most").traced);
  // A map without a filter shows a step where the penumbra is half as bright; one filtered as wide
  // as the penumbra is nearer to it.
  const double hard = root_mean_square(camera, [&](const auto& from, const auto& way) {
    const double at = penumbra.place(from, way);
    return (at > 0 ? 1.0 : 0.0) - penumbra.visible(at);
  });
  EXPECT_NEAR(row("sun-map/8192 x 8192").error, hard, 0.05 * hard);
  EXPECT_LT(row("sun-pcss/2048 x 2048, 16 + 32 taps").error, 0.3 * hard);
  // The scene has no hero, and the report says that this row shows nothing new.
  EXPECT_NE(row("sun-per-object/2 of 2048 x 2048").note.find("without a hero"), std::string::npos);
}

TEST(Study, WithoutASunItsRowsSayWhyTheyAreMissing) {
  Scene scene = Penumbra().make_scene();
  scene.sun.reset();
  const auto results = study(scene, quick_study("dark", "shadows"));
  ASSERT_EQ(results.size(), 1u);
  ASSERT_FALSE(results[0].rows.empty());
  for (const StudyRow& each : results[0].rows) EXPECT_EQ(each.missing, "the scene has no sun");
}

TEST(Study, AmbientOcclusionHasTheErrorsOfTheClosedForm) {
  Scene scene = make_wall_oracle(10);
  scene.sun.reset();
  add_view(scene, "view", {3, 2, 0}, {0.8, 0, 0}, 0.6);
  scene.cameras = {scene.cameras.back()};
  const auto results = study(scene, quick_study("wall", "ao"));
  expect_explained(results);
  for (const auto& [family, radius, ending] :
       {std::tuple("ao", 4.0, ""), std::tuple("ao-0.5m", 0.5, ", 0.5 m")}) {
    const auto row = [&, family = family, ending = ending](const std::string& setting) {
      return row_of(results, family, setting + ending);
    };
    // The floor hides from the wall what the wall hides from the floor.
    const auto open = [radius = radius](const glm::dvec3& from, const glm::dvec3& way) {
      const double to_floor = way.y < 0 ? -from.y / way.y : 1e9;
      const double to_wall = way.x < 0 ? -from.x / way.x : 1e9;
      const glm::dvec3 at = from + std::min(to_floor, to_wall) * way;
      return 1 - wall_occlusion_bounded(radius, to_floor < to_wall ? at.x : at.y);
    };
    // One cosine-weighted ray is 1 or 0.
    const double one_ray =
        root_mean_square(scene.cameras.front(), [&](const auto& from, const auto& way) {
          return std::sqrt(open(from, way) * (1 - open(from, way)));
        });
    EXPECT_NEAR(row("ao/1 ray").error, one_ray, 0.06 * one_ray) << family;
    EXPECT_LT(row("ao/64 rays").error, one_ray / 8) << family;
    // A uniform one weighs 2 cos: where all is open its mean square is 4/3.
    const double uniform =
        root_mean_square(scene.cameras.front(), [&](const auto& from, const auto& way) {
          const double v = open(from, way);
          return std::sqrt(4.0 / 3.0 * v - v * v);
        });
    EXPECT_NEAR(row("ao-uniform/1 ray").error, uniform, 0.06 * uniform) << family;
    EXPECT_NEAR(row("ao/64 rays").energy, 1, 0.01) << family;
  }
  const auto own = [&](const std::string& setting) {
    return row_of(results, "ao-0.5m", setting + ", 0.5 m");
  };
  // Half of the points about a flat floor lie below it: Crytek's walls are grey.
  EXPECT_NEAR(own("crytek-ao/64 points").energy, 0.5, 0.06);
  EXPECT_LT(own("gtao-accurate/16 slices, 32 steps").error, own("hemisphere-ao/64 points").error);
  EXPECT_LT(own("hemisphere-ao/64 points").error, own("crytek-ao/64 points").error);
}

// What was measured is taken from the folder only where nothing has changed that it depends on.
TEST(Study, GoesOnOnlyWithWhatWasAskedFor) {
  Scene scene = make_wall_oracle(10);
  Options options = quick_study("wall", "ao");
  options.rows = {"ao/1 ray"};
  options.measure_truth = 16;
  const auto error = [&] { return study(scene, options).at(0).rows.at(0).error; };
  const auto ms = [&] { return study(scene, options).at(0).rows.at(0).ms; };
  const double first = error();
  EXPECT_EQ(ms(), ms());  // times would differ if it were measured again
  options.effects.at("ao").radius = 0.5f;
  EXPECT_NE(error(), first);
  options.effects.at("ao").radius = 4;
  EXPECT_EQ(error(), first);
  scene.instances.back().transform = glm::translate(glm::dmat4(1), {0.5, 0, 0});
  EXPECT_NE(error(), first);
}

TEST(Study, KeysDependOnEverySetting) {
  const Scene scene = make_wall_oracle(10);
  const Options options = quick_study("wall", "ao");
  std::set<std::string> pictures = {picture_key(options, scene)};
  std::set<std::string> volumes = {volume_key(options, scene)};
  const auto expect_new = [&](const char* what, bool of_volume, const auto& change) {
    Options changed = options;
    change(changed);
    EXPECT_TRUE(pictures.insert(picture_key(changed, scene)).second) << what;
    EXPECT_EQ(volumes.insert(volume_key(changed, scene)).second, of_volume) << what;
  };
  expect_new("AO radius", false, [](Options& o) { o.effects.at("ao").radius = 0.5f; });
  expect_new("sun angle", true, [](Options& o) { o.frame.sun_angular_radius = 0.02f; });
  expect_new("light maps", true, [](Options& o) { o.frame.light_maps = LightMaps::kDrawn; });
  expect_new("bake", true, [](Options& o) { o.frame.volume.bounces = 2; });
  expect_new("denoiser", false, [](Options& o) { o.frame.denoise.constants.sigma_l = 1; });
  expect_new("sun at hits", false, [](Options& o) {
    o.effects.at("gi").set_constants(IndirectConstants{.sun_at_hits = SunAtHits::kNone});
  });
  expect_new("lengths", false, [](Options& o) {
    o.effects.at("reflections").set_constants(ReflectionConstants{.longest = 5});
  });
  expect_new("precision", true, [](Options& o) { o.precision = "exact"; });
  expect_new("backend", false, [](Options& o) { o.backend = "vulkan"; });
  // How often and where to is no part of a picture.
  Options same = options;
  same.repeats = 99;
  same.out = "elsewhere";
  EXPECT_EQ(picture_key(same, scene), picture_key(options, scene));
}

TEST(Study, ReflectionsAreMeasuredInTheLitFrame) {
  const Scene scene = mirror_scene();
  const auto results = study(scene, quick_study("mirror", "reflections"));
  expect_explained(results);
  const auto row = [&](const std::string& setting) {
    return row_of(results, "reflections", setting);
  };
  // The volume of indirect light adds 4 % at the wall: light that the floor throws upwards.
  EXPECT_NEAR(row("reflections/64 rays").energy, 1.035, 0.03);
  EXPECT_NEAR(row("reflections/1 ray").energy, 1.035, 0.03);
  // The wall is in the picture: marches find its light, which only the sun gives it.
  for (const char* setting : {"ssr/every pixel, 1 ray", "ssr-metres/64 samples, 1 ray",
                              "hybrid-reflections/every pixel, 1 ray",
                              "ssr-masked/every pixel, 1 ray", "planar/hits with the sun"}) {
    EXPECT_NEAR(row(setting).energy, 1, 0.06) << setting;
  }
  EXPECT_LT(row("planar/hits without the sun").energy, 0.05);
  EXPECT_LT(row("reflections/64 rays").error, row("ssr/every pixel, 16 rays").error);
  EXPECT_LT(row("ssr/every pixel, 16 rays").error, row("ssr-line/32 samples, 16 rays").error);
}

TEST(Study, IndirectLightIsThatOfTheFurnace) {
  const auto results = study(furnace_scene(), quick_study("furnace", "indirect"));
  expect_explained(results);
  const auto row = [&](const std::string& technique, const std::string& label) {
    for (const StudyRow& each : results.at(0).rows) {
      if (each.technique == technique && each.label == label) return each;
    }
    throw std::runtime_error("no row " + technique + ", " + label);
  };
  const StudyRow one = row("near-field, rays per pixel", "1 ray");
  const StudyRow many = row("near-field, rays per pixel", "64 rays");
  const StudyRow whole = row("rays to the hit, 16", "16 rays");
  const StudyRow volume = row("volume at the surface", "1 rays");
  for (const StudyRow& each : {one, many, whole, volume}) {
    EXPECT_NEAR(each.energy, 1, 0.015) << each.technique;
  }
  EXPECT_LT(many.error, 0.3 * one.error);
  EXPECT_LT(whole.error, 0.03 * 2);
  // Hits that are black leave what is farther away than the rays reach, and AO takes that again.
  EXPECT_LT(row("hit = black, 16 rays", "16 rays").energy, 0.5);
  EXPECT_LT(row("the same x AO of 16 rays", "16 rays").energy, 0.3);
}

TEST(Study, FiltersTakeErrorsDownAndKeepTheEnergy) {
  Options options = quick_study("furnace", "denoise");
  options.seeds = 2;
  const auto results = study(furnace_scene(), options);
  bool has_indirect = false;
  for (const StudyResult& result : results) {
    if (result.signal != "indirect") continue;
    has_indirect = true;
    const StudyRow& raw = result.rows.at(0);
    for (const StudyRow& row : result.rows) {
      EXPECT_NEAR(row.energy, 1, 0.02) << row.technique << ", " << row.label;
      if (&row == &raw || row.label == "0 passes") continue;
      EXPECT_LT(row.error, 0.7 * raw.error) << row.technique << ", " << row.label;
    }
  }
  EXPECT_TRUE(has_indirect);
}

TEST(Study, GlassIsNearerToTheTruthWithMoreLayersThatReflect) {
  Options options = quick_study("glass-stack", "glass");
  options.measure_truth = 64;
  const Scene scene = find_built_in_scene("glass-stack")->make();
  const auto results = study(scene, options);
  const StudyRow& none = row_of(results, "glass", "transparent/0 layers");
  const StudyRow& all = row_of(results, "glass", "transparent/8 layers");
  const StudyRow& drawn = row_of(results, "glass", "drawn-glass/as it is by default");
  EXPECT_GT(none.error, 1.2 * all.error);
  EXPECT_GT(none.error, drawn.error);
  EXPECT_GT(drawn.ms, 0);
  expect_explained(results);
}

TEST(Study, ShadowsOfGlassAreHeldAgainstATruthThatHasThem) {
  Options options = quick_study("glass-stack", "glass-shadows");
  options.measure_truth = 64;
  const auto results = study(find_built_in_scene("glass-stack")->make(), options);
  const StudyRow& few = row_of(results, "glass-shadows", "glass-shadow/1 ray");
  const StudyRow& many = row_of(results, "glass-shadows", "glass-shadow/64 rays");
  const StudyRow& map = row_of(results, "glass-shadows", "glass-shadow-map/2048 x 2048, 16 taps");
  EXPECT_LT(many.error, 0.7 * few.error);
  EXPECT_LT(many.error, map.error);
  EXPECT_NEAR(many.energy, 1, 0.005);
  expect_explained(results);
}

TEST(Study, WithoutGlassItsRowsSayWhy) {
  const Options options = quick_study("sealed-cells", "glass");
  const auto results = study(find_built_in_scene("sealed-cells")->make(), options);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_FALSE(results[0].is_measured());
  EXPECT_EQ(results[0].rows.front().missing, "the scene has no glass");
}

}  // namespace
}  // namespace kaamos::measure

// SPDX-License-Identifier: MIT
// Sweeps over scenes for which it is known beforehand what the swept setting does.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/assets/built_in/leak_scenes.h"
#include "effects/assets/built_in/mirror_hall.h"
#include "effects/measure/study/study_fixture.h"

namespace kaamos::measure {
namespace {

using namespace effects;
using namespace fixture;

double also(const StudyRow& row, const std::string& name) {
  for (const auto& [each, number] : row.also) {
    if (each == name) return number;
  }
  ADD_FAILURE() << row.label << " has no " << name;
  return 0;
}

// The row of a setting of a group.
const StudyRow& row_in(const std::vector<StudyResult>& results, const std::string& group,
                       const std::string& label) {
  for (const StudyResult& result : results) {
    for (const StudyRow& row : result.rows) {
      if (row.technique == group && row.label == label) return row;
    }
  }
  throw std::runtime_error("no row " + group + ", " + label);
}

Options sweep_options(const std::string& sweep) {
  Options options = quick_study(sweep, sweep);
  options.quick = false;
  options.repeats = 2;
  options.measure_reference = 256;
  options.measure_truth = 256;
  return options;
}

// A sheet above a floor, the sun at 45 degrees, so that depth changes by a texel from texel to
// texel. A texel holds the depth of its middle: half of what it covers lies behind that.
TEST(Sweep, WithoutBiasHalfOfALitSlopeIsInShadow) {
  Scene scene = Penumbra{.height = 0.1, .turn = 0}.make_scene();
  scene.sun->direction_to_sun = glm::normalize(glm::vec3(0, 1, 1));
  const auto results = study(scene, sweep_options("sweep-bias"));
  const auto acne = [&](const std::string& group, const std::string& label) {
    return also(row_in(results, group, label), "acne %");
  };
  const auto gap = [&](const std::string& group, const std::string& label) {
    return also(row_in(results, group, label), "gap %");
  };
  for (const char* group : {"constant bias", "slope bias", "offset along the normal"}) {
    EXPECT_NEAR(acne(group, "0 texels"), 50, 8) << group;
    EXPECT_LT(acne(group, "8 texels"), 0.5) << group;
  }
  // Depths differ by up to half a texel from that of the middle, evenly.
  EXPECT_NEAR(acne("constant bias", "0.25 texels"), 25, 8);
  EXPECT_LT(acne("constant bias", "0.5 texels"), 8);
  // A shadow is there as long as the bias is less than the way from the sheet to the floor, 14 cm;
  // 64 texels are 30 cm.
  EXPECT_LT(gap("constant bias", "8 texels"), 5);
  EXPECT_GT(gap("constant bias", "64 texels"), 90);
}

TEST(Sweep, PcssGetsBetterWithTapsAndWithItsMap) {
  Options options = sweep_options("sweep-pcss");
  const auto results = study(Penumbra().make_scene(), options);
  const auto error = [&](const std::string& group, const std::string& label) {
    return row_in(results, group, label).error;
  };
  // Taps are 0 or 1, as rays are: their noise goes down with their number.
  EXPECT_LT(error("taps of the filter", "64 taps"), 0.6 * error("taps of the filter", "4 taps"));
  EXPECT_LT(error("taps of the filter", "4 taps"), error("taps of the filter", "1 tap"));
  EXPECT_LT(error("taps of the search", "64 taps"), error("taps of the search", "1 tap"));
  EXPECT_LT(error("size of the map", "2048 x 2048"), error("size of the map", "256 x 256"));
}

Scene corner_scene() {
  Scene scene = make_wall_oracle(10);
  scene.sun.reset();
  add_view(scene, "view", {3, 2, 0}, {0.8, 0, 0}, 0.6);
  scene.cameras = {scene.cameras.back()};
  return scene;
}

TEST(Sweep, LongerRaysFindMoreOcclusion) {
  const Scene scene = corner_scene();
  const auto results = study(scene, sweep_options("sweep-ao-radius"));
  const Camera& camera = scene.cameras.front();
  double before = 1;
  for (const double radius : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0}) {
    const StudyRow& row = row_in(results, "ambient occlusion", fmt::format("{:g} m", radius));
    double open = 0;
    const auto ways = ways_of(camera);
    for (const glm::dvec3& way : ways) {
      const double to_floor = way.y < 0 ? -camera.position().y / way.y : 1e9;
      const double to_wall = way.x < 0 ? -camera.position().x / way.x : 1e9;
      const glm::dvec3 at = camera.position() + std::min(to_floor, to_wall) * way;
      open += 1 - wall_occlusion_bounded(radius, to_floor < to_wall ? at.x : at.y);
    }
    open /= static_cast<double>(ways.size());
    EXPECT_NEAR(also(row, "mean"), open, 0.01) << radius;
    EXPECT_LT(also(row, "mean"), before) << radius;
    before = also(row, "mean");
    // Screen-space techniques are off by more than the noise of 16 rays.
    EXPECT_GT(row_in(results, "horizon-based ambient occlusion", row.label).error, row.error);
  }
}

// Horizons that do not rise by the bias do not count: the more, the brighter.
TEST(Sweep, AnglesOfHbaoTakeOcclusionAway) {
  const auto results = study(corner_scene(), sweep_options("sweep-hbao-bias"));
  const auto mean = [&](const std::string& label) {
    return also(row_in(results, "horizon-based ambient occlusion", label), "mean");
  };
  EXPECT_LT(mean("0 degrees"), mean("20 degrees"));
  EXPECT_LT(mean("20 degrees"), mean("45 degrees"));
  EXPECT_LT(mean("45 degrees"), mean("60 degrees"));
  // Without it a corner is darker than it is to rays, for want of the cosine.
  const StudyRow& none = row_in(results, "horizon-based ambient occlusion", "0 degrees");
  EXPECT_LT(also(none, "mean"), also(none, "mean of rays"));
}

// The exponent of the error as a function of rays.
double slope_of(const std::vector<StudyResult>& results, const std::string& group) {
  return std::log(row_in(results, group, "64 rays").error / row_in(results, group, "1 ray").error) /
         std::log(64.0);
}

TEST(Sweep, WhiteNoiseGoesDownWithTheRootAndSobolFaster) {
  Options options = sweep_options("sweep-ao-sampler");
  options.measure_reference = 4096;
  const auto results = study(corner_scene(), options);
  for (const std::string directions : {"cosine", "uniform"}) {
    EXPECT_NEAR(slope_of(results, directions + ", white noise"), -0.5, 0.06);
    EXPECT_LT(slope_of(results, directions + ", Sobol over blue noise"), -0.65);
  }
  // A cosine weighs 2 cos where directions are uniform, which makes the error larger.
  for (const std::string samples : {"Sobol over blue noise", "white noise"}) {
    EXPECT_LT(row_in(results, "cosine, " + samples, "4 rays").error,
              row_in(results, "uniform, " + samples, "4 rays").error);
  }
}

TEST(Sweep, FewerPixelsWithMoreRaysWinWhereAllIsSmooth) {
  const auto results = study(corner_scene(), sweep_options("sweep-resolution"));
  const StudyRow& all = row_in(results, "every pixel", "1 ray");
  const StudyRow& fourth = row_in(results, "one of four pixels, upscaled", "4 rays");
  EXPECT_NEAR(fourth.traced, all.traced, 0.05);
  EXPECT_LT(fourth.error, all.error);
  EXPECT_NEAR(fourth.energy, 1, 0.03);
  // What is worked out from neighbours is off where all pixels with many rays are not.
  EXPECT_GT(row_in(results, "one of four pixels, upscaled", "64 rays").error,
            row_in(results, "every pixel", "16 rays").error * 0.2);
}

TEST(Sweep, CoarserMarchesMissMoreAndThickerSurfacesAreHitFalsely) {
  Options options = sweep_options("sweep-ssr");
  for (const char* stride : {"1 pixels", "16 pixels"}) {
    for (const char* thickness : {"0.02 m thick", "0.25 m thick", "no back"}) {
      options.rows.push_back(std::string("ssr/stride of ") + stride + "/" + thickness);
    }
  }
  options.measure_truth = 16;
  options.frame.volume.samples = 8;
  const auto results = study(make_mirror_hall(), options);
  const auto share = [&](const char* stride, const char* thickness, const char* what) {
    return also(row_in(results, std::string("stride of ") + stride, thickness), what);
  };
  for (const char* stride : {"1 pixels", "16 pixels"}) {
    EXPECT_LE(share(stride, "0.02 m thick", "coverage %"), share(stride, "no back", "coverage %"));
    EXPECT_LT(share(stride, "0.02 m thick", "false hits %"),
              share(stride, "no back", "false hits %"));
  }
  EXPECT_GT(share("16 pixels", "0.02 m thick", "missed %") +
                share("16 pixels", "0.02 m thick", "false hits %"),
            share("1 pixels", "0.02 m thick", "missed %") +
                share("1 pixels", "0.02 m thick", "false hits %"));
  for (const StudyRow& row : results.at(0).rows) {
    EXPECT_NEAR(also(row, "right hits %") + also(row, "false hits %") + also(row, "missed %") +
                    also(row, "rightly none %"),
                100, 0.01);
  }
}

TEST(Sweep, CapsOnLengthMatterOnRoughSurfacesOnly) {
  Options options = sweep_options("sweep-roughness");
  options.quick = true;
  options.frame.volume.samples = 8;
  const auto results = study(mirror_scene(), options);
  const auto error = [&](const char* group, const char* label) {
    return row_in(results, group, label).error;
  };
  const double mirror = error("rays shorter on rough surfaces", "roughness 0");
  EXPECT_NEAR(mirror, error("rays of 200 m", "roughness 0"), 0.02 * mirror + 1e-3);
  // Rays that end after 3 m have the volume's light from there on, which is biased.
  const StudyRow& capped = row_in(results, "rays shorter on rough surfaces", "roughness 1");
  const StudyRow& whole = row_in(results, "rays of 200 m", "roughness 1");
  EXPECT_NE(capped.error, whole.error);
  EXPECT_NEAR(also(whole, "mean"), also(whole, "mean of rays"), 0.05 * also(whole, "mean of rays"));
  EXPECT_GT(std::abs(also(capped, "mean") - also(capped, "mean of rays")),
            std::abs(also(whole, "mean") - also(whole, "mean of rays")));
}

// Walls of 5 mm between a lit room and the dark one that the camera stands in.
TEST(Sweep, SmallerCellsLeakLess) {
  Options options = sweep_options("sweep-voxel");
  options.rows = {"gi/volume at the surface/cells of 2 m",
                  "gi/volume at the surface/cells of 0.5 m", "gi/near-field, 16 rays/cells of 2 m",
                  "gi/near-field, 16 rays/cells of 0.5 m"};
  options.frame.volume.samples = 16;
  options.measure_truth = 4;
  const auto results = study(make_sealed_cells({.thickness = 0.005}), options);
  const auto mean = [&](const char* group, const char* label) {
    return also(row_in(results, group, label), "mean");
  };
  const double coarse = mean("volume at the surface", "cells of 2 m");
  EXPECT_GT(coarse, 0);
  EXPECT_LT(mean("volume at the surface", "cells of 0.5 m"), coarse);
  EXPECT_LT(mean("near-field, 16 rays", "cells of 0.5 m"),
            mean("near-field, 16 rays", "cells of 2 m"));
  EXPECT_EQ(also(row_in(results, "volume at the surface", "cells of 2 m"), "mean of rays"), 0);
}

TEST(Sweep, LongerRaysLoseMoreLightToBlackHits) {
  const auto results = study(furnace_scene(), sweep_options("sweep-gi-length"));
  double before = 1.02;
  for (const char* length : {"0.5 m", "1 m", "2 m", "4 m"}) {
    EXPECT_NEAR(row_in(results, "near-field, 16 rays", length).energy, 1, 0.02) << length;
    const double black = row_in(results, "hit = black, 16 rays", length).energy;
    EXPECT_LT(black, before) << length;
    before = black;
  }
  // No way through the box is longer than its diagonal of 6.4 m.
  EXPECT_LT(row_in(results, "hit = black, 16 rays", "8 m").energy, 1e-6);
}

// A closed box whose only light goes out: a lamp that the volume does not have.
Scene lit_box() {
  Scene scene = furnace_scene();
  for (Material& material : scene.materials) material.constants.emissive = glm::vec3(0);
  Light lamp;
  lamp.baked = false;
  lamp.position = {0.5, 1, 0};
  lamp.intensity = 10;
  scene.lights.push_back(lamp);
  return scene;
}

TEST(Sweep, HistoryLagsAsItsWeightSays) {
  Options options = sweep_options("sweep-lag-switch");
  options.frame.volume.samples = 8;
  const auto results = study(lit_box(), options);
  for (const double weight : {1.0, 0.5, 0.2, 0.1, 0.05}) {
    const std::string label = fmt::format("new frames weigh {:g}", weight);
    const StudyRow& row = row_in(results, "accumulation", label);
    // A frame that weighs a leaves 1 - a of what was.
    const double frames = weight == 1 ? 1 : std::ceil(std::log(0.1) / std::log(1 - weight));
    EXPECT_NEAR(also(row, "frames to 10 %"), frames, 1 + 0.1 * frames) << weight;
    EXPECT_NEAR(also(row, "left, 8 frames %"), 100 * std::pow(1 - weight, 8), 3) << weight;
    EXPECT_NEAR(also(row, "energy before"), 1, 0.05) << weight;
  }
  // SVGF's new frames weigh 0.2.
  EXPECT_NEAR(also(row_in(results, "filters", "svgf"), "frames to 10 %"), 11, 2);
  // Half floats are rounded towards zero in each frame, the more often the less new frames weigh:
  // half a step of 1/1024 or 1/2048, 50 times over.
  const StudyRow& half = row_in(results, "accumulation in half floats", "new frames weigh 0.02");
  EXPECT_LT(also(half, "energy before"), 0.995);
  EXPECT_GT(also(half, "energy before"), 0.95);
}

TEST(Sweep, HistoryLagsBehindWhatGoesAway) {
  Options options = sweep_options("sweep-lag-move");
  options.frame.volume.samples = 8;
  const auto results = study(furnace_scene(), options);
  const auto frames = [&](const char* label) {
    return also(row_in(results, "accumulation", label), "frames to 10 %");
  };
  EXPECT_LT(frames("new frames weigh 0.5"), frames("new frames weigh 0.1"));
  EXPECT_LT(frames("new frames weigh 0.1"), 49);
  EXPECT_EQ(frames("new frames weigh 0.02"), 49);  // more than were looked at
}

// The mean of frames that weigh a, (1 - a) a, ... has a / (2 - a) of the variance of one.
TEST(Sweep, SmallerWeightsHaveLessNoise) {
  Options options = sweep_options("sweep-blend");
  options.seeds = 2;
  const auto results = study(furnace_scene(), options);
  const auto error = [&](const char* label) {
    for (const StudyResult& result : results) {
      if (result.family.ends_with("-motion")) continue;
      for (const StudyRow& row : result.rows) {
        if (row.technique == "accumulation" && row.label == label) return row.error;
      }
    }
    throw std::runtime_error(label);
  };
  const double one = error("new frames weigh 1");
  // Frames go on with a pixel's sequence, which does better than independent samples.
  EXPECT_LT(error("new frames weigh 0.5"), 1.05 * one * std::sqrt(0.5 / 1.5));
  EXPECT_LT(error("new frames weigh 0.2"), 1.05 * error("new frames weigh 0.5"));
  EXPECT_LT(error("new frames weigh 0.1"), 1.05 * error("new frames weigh 0.2"));
}

}  // namespace
}  // namespace kaamos::measure

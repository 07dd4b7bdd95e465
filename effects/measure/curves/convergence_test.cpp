// SPDX-License-Identifier: MIT
// Every ray traced effect against the path-traced truth: how its error falls with its rays, and
// what is left of it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "effects/assets/built_in/built_in.h"
#include "effects/measure/curves/measure.h"

namespace kaamos::measure {
namespace {

using namespace effects;

// The slope of a line through their logarithms.
double slope(const std::vector<std::pair<double, double>>& points) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const auto& [x, y] : points) {
    const double lx = std::log(x), ly = std::log(y);
    n += 1, sx += lx, sy += ly, sxx += lx * lx, sxy += lx * ly;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

// How an effect's error against the path-traced truth falls with its rays in the lounge.
struct Fall {
  double slope = 0;   // of log RMSE over log rays, without the truth's own error
  double end = 0;     // RMSE of 1,024 rays
  double truth = 0;   // RMSE of the truth itself
  double energy = 0;  // at the end
};

Fall fall_of(const std::string& effect) {
  Options options = default_options();
  options.frame.width = 48;
  options.frame.height = 27;
  options.measure_truth = 1024;
  options.out = testing::TempDir() + "convergence";  // one truth and one volume for all
  std::filesystem::create_directories(options.out + "/measure-cache");
  options.repeats = 1;
  options.frame.volume.cell = 0.5f;
  const Scene scene = find_built_in_scene("lounge")->make();
  Setting setting = setting_of(effect);
  setting.settings = options.effects.at(effect);
  MeasurePlan plan{.title = effect, .signal = effect, .effects = {effect}};
  const std::string& stands_for = find_effect(northlight_effects(), effect)->alternative_to;
  if (!stands_for.empty()) plan.effects.push_back(stands_for);
  plan.references = {{effect, effect, stands_for.empty() ? setting : setting_of(stands_for)}};
  plan.against_truth = true;
  for (const std::uint32_t rays : {4u, 16u, 64u, 256u, 1024u}) {
    setting.settings.samples = rays;
    plan.settings.push_back({effect, std::to_string(rays), setting, effect});
  }
  MeasuredTable table;
  const auto done = run_plan(
      plan, options, scene, [](const auto&, double) { return true; }, table);
  if (!done) throw std::runtime_error(done.error().message);
  std::vector<std::pair<double, double>> points;
  Fall out;
  for (const MeasuredRow& row : table.rows) {
    out.truth = row.truth_rmse;
    out.end = row.truth->rmse;
    out.energy = row.truth->energy_ratio;
    points.emplace_back(row.rays,
                        std::sqrt(std::max(out.end * out.end - out.truth * out.truth, 1e-12)));
  }
  out.slope = slope(points);
  std::printf("%-12s slope %.2f, end %.2g, truth %.2g, energy %.3f\n", effect.c_str(), out.slope,
              out.end, out.truth, out.energy);
  return out;
}

// What has no bias comes to the truth, at least as fast as independent samples would: those of a
// sequence that fills its domain evenly do better than -0.5 where visibility has few edges.
TEST(Convergence, VisibilityComesToTheTruth) {
  for (const char* effect : {"sun", "ao", "ao-uniform"}) {
    const Fall fall = fall_of(effect);
    EXPECT_LT(fall.slope, -0.45) << effect;
    EXPECT_LT(fall.end, 2 * fall.truth) << effect;
    EXPECT_NEAR(fall.energy, 1, 0.005) << effect;
  }
}

// Indirect light and reflections read the volume at what they hit: its cells of half a metre leave
// an error that more rays do not take away. Near-field rays, most of which end in the air, have the
// truth's energy; reflections, all of whose rays hit something, 5 % too much: cells that large are
// too bright at surfaces.
TEST(Convergence, WhatReadsTheVolumeKeepsItsBias) {
  const Fall indirect = fall_of("gi");
  EXPECT_NEAR(indirect.energy, 1.0, 0.02);
  EXPECT_GT(indirect.end, indirect.truth);
  EXPECT_LT(indirect.end, 0.035);
  const Fall reflections = fall_of("reflections");
  EXPECT_NEAR(reflections.energy, 1.055, 0.02);
  EXPECT_LT(reflections.end, 0.035);
}

}  // namespace
}  // namespace kaamos::measure

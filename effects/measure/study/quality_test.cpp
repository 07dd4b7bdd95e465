// SPDX-License-Identifier: MIT
#include "effects/measure/study/quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace kaamos::measure {
namespace {

using namespace effects;
using testing::ElementsAre;
using testing::HasSubstr;

StudyFamily family_of(const std::string& name) {
  for (const StudyFamily& family : study_families()) {
    if (family.name == name) return family;
  }
  throw std::runtime_error(name);
}

// A row of a setting that the plan has, with numbers of the test's own.
StudyRow row(const std::string& family, const std::string& name, double ms, double error,
             double traced) {
  const MeasurePlan plan = study_plan(family_of(family), default_options(), false).plan;
  for (const MeasuredSetting& each : plan.settings) {
    if (row_name(each) != name) continue;
    StudyRow out;
    out.effect = each.setting.effect;
    out.technique = each.group;
    out.label = each.label;
    out.ms = ms;
    out.error = error;
    out.traced = traced;
    return out;
  }
  throw std::runtime_error(name);
}

StudyResult result(const std::string& family, std::vector<StudyRow> rows) {
  StudyResult out;
  out.family = family;
  out.width = 16;
  out.height = 9;
  out.rows = std::move(rows);
  return out;
}

std::vector<StudyResult> results() {
  return {result("shadows",
                 {row("shadows", "sun/1 ray", 2, 0.1, 1), row("shadows", "sun/4 rays", 6, 0.05, 4),
                  row("shadows", "sun/64 rays", 80, 0.01, 64),
                  row("shadows", "sun-map/1024 x 1024", 0.5, 0.35, 0),
                  row("shadows", "sun-map/2048 x 2048", 1, 0.2, 0),
                  row("shadows", "sun-map/8192 x 8192", 3, 0.15, 0)}),
          result("indirect", {row("indirect", "gi-ray-ao/1 ray", 3, 0.4, 1),
                              row("indirect", "gi-ray-ao/16 rays", 30, 0.2, 16)})};
}

Options options_of(std::uint32_t width = 16, std::uint32_t height = 9) {
  Options options = default_options();
  choose(options, {"all"});
  options.frame.width = width;
  options.frame.height = height;
  return options;
}

std::vector<QualityChoice> choose_for(const QualityGoal& goal, const Options& options) {
  return choose_quality(goal, options, {family_of("shadows"), family_of("indirect")}, results());
}

std::vector<double> errors(const QualityGoal& goal) {
  std::vector<double> out;
  for (const QualityChoice& each : choose_for(goal, options_of())) out.push_back(each.error);
  return out;
}

TEST(Quality, LowIsTheFastestWithoutRaysThatIsHalfAsGoodAsTheBest) {
  const auto choices = choose_for({Quality::kLow, {}}, options_of());
  ASSERT_EQ(choices.size(), 2u);
  EXPECT_EQ(choices[0].effect, "sun-map");
  EXPECT_EQ(choices[0].error, 0.2);
  EXPECT_THAT(choices[0].why, HasSubstr("the fastest of 3 without rays"));
  EXPECT_EQ(choices[1].effect, "gi-ray-ao");
  EXPECT_THAT(choices[1].why, HasSubstr("all trace rays"));
}

TEST(Quality, LowTakesRaysThatAreFasterAndNearerToTheTruth) {
  const std::vector<StudyResult> measured = {result(
      "shadows",
      {row("shadows", "sun/1 ray", 2, 0.1, 1), row("shadows", "sun-map/2048 x 2048", 3, 0.2, 0),
       row("shadows", "screen-sun/8 steps", 1, 0.5, 0)})};
  const auto choices =
      choose_quality({Quality::kLow, {}}, options_of(), {family_of("shadows")}, measured);
  ASSERT_EQ(choices.size(), 1u);
  EXPECT_EQ(choices[0].effect, "sun");
  EXPECT_THAT(choices[0].why,
              HasSubstr("faster and nearer to the truth than sun shadow by a depth"));
}

TEST(Quality, RisesFromLowToUltra) {
  EXPECT_THAT(errors({Quality::kLow, {}}), ElementsAre(0.2, 0.4));
  EXPECT_THAT(errors({Quality::kMedium, {}}), ElementsAre(0.1, 0.2));
  EXPECT_THAT(errors({Quality::kHigh, {}}), ElementsAre(0.01, 0.2));
  EXPECT_THAT(errors({Quality::kUltra, {}}), ElementsAre(0.01, 0.2));
}

TEST(Quality, ABudgetIsTheLeastErrorThatFits) {
  EXPECT_THAT(errors({Quality::kHigh, 10}), ElementsAre(0.05, 0.4));
  EXPECT_THAT(errors({Quality::kHigh, 33}), ElementsAre(0.1, 0.2));
  EXPECT_THAT(errors({Quality::kHigh, 1000}), ElementsAre(0.01, 0.2));
  EXPECT_THAT(errors({Quality::kHigh, 1}), ElementsAre(0.35, 0.4)) << "nothing fits: the fastest";
}

TEST(Quality, TimesAreThoseOfTheFramesPixels) {
  const auto choices = choose_for({Quality::kUltra, {}}, options_of(32, 18));
  EXPECT_EQ(choices[0].ms, 320);
}

TEST(Quality, ChoicesTakeThePlaceOfWhatTheFrameHad) {
  Options options = options_of();
  apply_quality(choose_for({Quality::kLow, {}}, options), options);
  const auto& effects = options.frame.effects;
  ASSERT_EQ(effects.count("sun-map"), 1u);
  const Effect& sun = *find_effect(northlight_effects(), "sun");
  const Effect* instead = what_replaces(options.frame, northlight_effects(), sun);
  ASSERT_NE(instead, nullptr);
  EXPECT_EQ(instead->name, "sun-map");
  EXPECT_FALSE(effects.at("sun").named);
  EXPECT_TRUE(options.frame.whole_frame);
}

TEST(Quality, TheTextSaysWhatAndWhy) {
  const QualityGoal goal = {Quality::kLow, {}};
  const std::string text = quality_text(goal, choose_for(goal, options_of()));
  EXPECT_THAT(text, HasSubstr("quality low:\n  shadows: sun shadow by a depth map, 2048 x 2048 "
                              "(--effects sun-map): 1 ms, error 0.2: the fastest of 3"));
  EXPECT_THAT(text, HasSubstr("together 4 ms"));
}

}  // namespace
}  // namespace kaamos::measure

// SPDX-License-Identifier: MIT
#include "effects/measure/study/quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "effects/shadows/contact_shadow/contact_shadow.h"

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

// 2 ms of 10 do not grow with the pixels: four times as many take 2 + 4 * 8.
TEST(Quality, FixedTimesAreThoseOfEveryPicture) {
  std::vector<StudyResult> measured = {
      result("shadows", {row("shadows", "sun/64 rays", 10, 0.01, 64)})};
  measured[0].rows[0].fixed_ms = 2;
  const auto choices =
      choose_quality({Quality::kUltra, {}}, options_of(32, 18), {family_of("shadows")}, measured);
  ASSERT_EQ(choices.size(), 1u);
  EXPECT_DOUBLE_EQ(choices[0].ms, 34);
}

StudyRow named_row(const std::string& technique, const std::string& label, double ms,
                   double error) {
  StudyRow out;
  out.technique = technique;
  out.label = label;
  out.ms = ms;
  out.error = error;
  return out;
}

std::vector<StudyResult> denoised() {
  const std::string plain = "as it is by default";
  return {result("denoise-ao",
                 {named_row("raw", plain, 10, 0.3), named_row("gaussian", plain, 12, 0.2),
                  named_row("temporal", plain, 13, 0.02), named_row("svgf", plain, 15, 0.03)}),
          result("denoise-indirect",
                 {named_row("raw", plain, 10, 0.4), named_row("gaussian", plain, 12, 0.1),
                  named_row("temporal", plain, 13, 0.02), named_row("svgf", plain, 15, 0.04)})};
}

TEST(Quality, ADenoiserIsChosenByAllSignals) {
  Options options = options_of();
  const std::vector<StudyFamily> families = {family_of("denoise")};
  auto choices = choose_quality({Quality::kUltra, {}}, options, families, denoised());
  ASSERT_EQ(choices.size(), 1u);
  EXPECT_EQ(choices[0].option, "--denoise svgf") << "a still has no frames before it";
  EXPECT_DOUBLE_EQ(choices[0].ms, 5) << "of the filters";
  EXPECT_NEAR(choices[0].error, std::sqrt((0.0009 + 0.0016) / 2), 1e-12);
  apply_quality(choices, options);
  EXPECT_EQ(options.frame.denoise.method, DenoiseMethod::kSvgf);
  options.frame.moving = true;
  choices = choose_quality({Quality::kUltra, {}}, options, families, denoised());
  ASSERT_EQ(choices.size(), 1u);
  EXPECT_EQ(choices[0].option, "--denoise temporal");
  choices = choose_quality({Quality::kHigh, 1}, options, families, denoised());
  EXPECT_EQ(choices[0].option, "--denoise none");
}

TEST(Quality, WaysToMakeTheFrameAreChosenWhereItCanTakeThem) {
  const std::vector<StudyResult> measured = {
      result("upscaling", {named_row("every pixel", "one ray each", 100, 0.03),
                           named_row("a pixel of four", "upscaled", 40, 0.05),
                           named_row("a pixel of four", "in turns", 40, 0.04)}),
      result("antialiasing",
             {named_row("one point of a pixel", "as it is by default", 100, 0.08),
              named_row("temporal antialiasing", "as it is by default", 97, 0.04)})};
  const std::vector<StudyFamily> families = {family_of("upscaling"), family_of("antialiasing")};
  Options still = options_of();
  auto choices = choose_quality({Quality::kLow, {}}, still, families, measured);
  ASSERT_EQ(choices.size(), 1u) << "a still has one way of antialiasing";
  EXPECT_EQ(choices[0].option, "--half-resolution all");
  EXPECT_DOUBLE_EQ(choices[0].ms, -60) << "less than every pixel";
  EXPECT_THAT(choices[0].why, HasSubstr("at most 2 times the least (0.03)"));
  apply_quality(choices, still);
  EXPECT_EQ(still.frame.effects.at("gi").pixel_step, 2u);
  EXPECT_FALSE(still.frame.effects.at("gi").rotates);
  Options moving = options_of();
  moving.frame.moving = true;
  choices = choose_quality({Quality::kUltra, {}}, moving, families, measured);
  ASSERT_EQ(choices.size(), 2u);
  EXPECT_EQ(choices[0].option, "") << "every pixel, as by default";
  EXPECT_EQ(choices[1].ms, 0) << "no less than the plain frame";
  apply_quality(choices, moving);
  EXPECT_TRUE(moving.frame.taa);
  EXPECT_EQ(moving.frame.effects.at("gi").pixel_step, 1u);
}

// Whole shadows of lamps compete with maps and contact shadows: both tell what light a lamp leaves.
TEST(Quality, LampsHaveWholeShadowsOrMapsAndContact) {
  const std::vector<StudyResult> measured = {
      result("lamps", {row("lamps", "contact/no rays: the maps alone", 0.1, 0.01, 0),
                       row("lamps", "contact/1 ray", 1, 0.005, 1),
                       row("lamps", "lamp-pcss/16 + 32 taps", 2, 0.006, 0),
                       row("lamps", "lamp-rays/16 rays", 20, 0.001, 16)})};
  const std::vector<StudyFamily> families = {family_of("lamps")};
  Options options = options_of();
  auto choices = choose_quality({Quality::kLow, {}}, options, families, measured);
  ASSERT_EQ(choices.size(), 1u);
  EXPECT_EQ(choices[0].effect, "contact");
  EXPECT_EQ(choices[0].settings.get_constants<ContactShadowConstants>().length, 0);
  choices = choose_quality({Quality::kUltra, {}}, options, families, measured);
  EXPECT_EQ(choices[0].option, "--effects lamp-rays");
  apply_quality(choices, options);
  const Effect& contact = *find_effect(northlight_effects(), "contact");
  const Effect* instead = what_replaces(options.frame, northlight_effects(), contact);
  ASSERT_NE(instead, nullptr);
  EXPECT_EQ(instead->name, "lamp-rays");
}

}  // namespace
}  // namespace kaamos::measure

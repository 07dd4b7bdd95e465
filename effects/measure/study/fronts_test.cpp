// SPDX-License-Identifier: MIT
#include "effects/measure/study/fronts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "effects/assets/built_in/built_in.h"
#include "effects/measure/study/files.h"
#include "effects/measure/study/quality.h"

namespace kaamos::measure {
namespace {

using namespace effects;
using testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path kFolder = fs::path(KAAMOS_SOURCE_DIR) / "effects/measure/study/fronts";

std::vector<std::string> committed_scenes() {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".json") out.push_back(entry.path().stem().string());
  }
  return out;
}

std::vector<StudyResult> fronts_of(const std::string& scene) {
  auto parsed = parse_fronts(read_text((kFolder / (scene + ".json")).string()));
  if (!parsed) throw std::runtime_error(scene + " does not parse");
  return *parsed;
}

const StudyFamily& family_of(const std::string& result) {
  for (const StudyFamily& family : study_families()) {
    if (result == family.name || result.starts_with(family.name + "-")) return family;
  }
  throw std::runtime_error(result);
}

// Whether a frame of today can be made as the row says.
bool is_there(const StudyFamily& family, const StudyRow& row) {
  if (family.name == "denoise") return find_denoiser(row) != nullptr;
  if (family.effect.empty()) return find_way(family.name, row) != nullptr;
  const MeasurePlan plan = study_plan(family, default_options(), false).plan;
  for (const MeasuredSetting& each : plan.settings) {
    if (each.setting.effect == row.effect && each.group == row.technique &&
        each.label == row.label) {
      return true;
    }
  }
  return false;
}

TEST(Fronts, KeepWhatChoicesNeed) {
  StudyResult result;
  result.family = "shadows";
  result.backend = "embree";
  result.width = 16;
  result.height = 9;
  StudyRow row;
  row.effect = "sun";
  row.technique = "sun shadow";
  row.label = "4 rays";
  row.ms = 12.3456;
  row.fixed_ms = 1.5;
  row.error = 0.0123456;
  row.traced = 3;
  result.rows = {row, row};
  result.rows.back().missing = "the scene has no sun";
  StudyResult moving = result;
  moving.family = "shadows-motion";
  Options options = default_options();
  options.scene = "lounge";
  options.command = "northlight --study lounge";
  options.commit = "abc";
  const std::string text = to_fronts(options, {result, moving});
  EXPECT_THAT(text, HasSubstr("\"command\": \"northlight --study lounge\""));
  EXPECT_THAT(text, HasSubstr("\"commit\": \"abc\""));
  EXPECT_THAT(text, HasSubstr(" threads, "));
  const auto parsed = parse_fronts(text);
  ASSERT_TRUE(parsed);
  ASSERT_EQ(parsed->size(), 1u) << "what moves is left out";
  const StudyResult& kept = parsed->front();
  EXPECT_EQ(kept.scene, "lounge");
  EXPECT_EQ(kept.family, "shadows");
  EXPECT_EQ(kept.width, 16u);
  ASSERT_EQ(kept.rows.size(), 1u) << "and what was not measured";
  EXPECT_EQ(kept.rows[0].label, "4 rays");
  EXPECT_EQ(kept.rows[0].ms, 12.35) << "four digits";
  EXPECT_EQ(kept.rows[0].fixed_ms, 1.5);
  EXPECT_EQ(kept.rows[0].error, 0.01235);
  EXPECT_FALSE(parse_fronts("[]"));
  EXPECT_FALSE(parse_fronts("no json"));
}

TEST(Fronts, CommittedOnesAreOfTodaysTechniques) {
  const std::vector<std::string> scenes = committed_scenes();
  ASSERT_FALSE(scenes.empty());
  for (const std::string& scene : scenes) {
    EXPECT_NE(find_built_in_scene(scene), nullptr) << scene;
    for (const StudyResult& result : fronts_of(scene)) {
      EXPECT_EQ(result.scene, scene);
      const StudyFamily& family = family_of(result.family);
      EXPECT_FALSE(result.rows.empty()) << scene << ", " << result.family;
      for (const StudyRow& row : result.rows) {
        EXPECT_TRUE(is_there(family, row))
            << scene << ", " << result.family << ": " << row.technique << ", " << row.label
            << " is no setting any more: measure it again by the file's command";
        EXPECT_TRUE(std::isfinite(row.error) && row.ms > 0 && row.fixed_ms <= row.ms)
            << row.technique << ", " << row.label;
      }
    }
  }
}

// Every family of the frame is in the file, so that nothing is measured for --quality.
TEST(Fronts, CommittedOnesHaveEveryFamilyOfTheFrame) {
  for (const std::string& name : committed_scenes()) {
    const Scene scene = find_built_in_scene(name)->make();
    Options options = default_options();
    options.scene = name;
    choose(options, {"all"});
    const std::vector<StudyFamily> families = quality_families(options, scene);
    EXPECT_FALSE(families.empty());
    const auto results = fronts_of(name);
    for (const StudyFamily& family : families) {
      EXPECT_NE(find_result(family, results), nullptr) << name << ": " << family.name;
    }
    for (const Quality quality : {Quality::kLow, Quality::kUltra}) {
      EXPECT_GE(choose_quality({quality, {}}, options, families, results).size(),
                families.size() - 1)
          << name << ": a still has one way of antialiasing, and a choice of all else";
    }
  }
}

TEST(Fronts, OfTheTreeAreTakenWithoutMeasuring) {
  Options options = default_options();
  options.scene = "mirror-hall";
  options.out = testing::TempDir() + "/nothing";
  options.fronts_folder = kFolder.string();
  choose(options, {"all"});
  const Scene scene = find_built_in_scene("mirror-hall")->make();
  const auto progress = [](const std::string& what, double) {
    ADD_FAILURE() << what;
    return false;
  };
  std::vector<StudyResult> results;
  std::string said;
  const auto done =
      find_fronts(options, "", scene, quality_families(options, scene), progress, results, said);
  ASSERT_TRUE(done && is_done(done));
  EXPECT_THAT(said, HasSubstr("fronts/mirror-hall.json"));
  EXPECT_FALSE(results.empty());
}

}  // namespace
}  // namespace kaamos::measure

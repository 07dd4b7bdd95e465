// SPDX-License-Identifier: MIT
#include "effects/northlight/described_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "effects/composition/settings.h"
#include "effects/denoise/settings.h"
#include "effects/northlight/settings_file.h"

namespace kaamos::effects {
namespace {

using testing::HasSubstr;

// A value that differs from the present one.
SettingValue other_value(const SettingText& text, const SettingValue& now) {
  switch (text.type) {
    case SettingType::kSwitch:
      return !std::get<bool>(now);
    case SettingType::kWord:
      return text.words[value_text(now) == text.words[0] ? 1 : 0];
    case SettingType::kCount: {
      const auto least = static_cast<std::int64_t>(text.range.least);
      return now == SettingValue(least) ? least + 1 : least;
    }
    case SettingType::kNumber:
      break;
  }
  const double least = text.range.least;
  const double most = std::isinf(text.range.most) ? least + 1 : text.range.most;
  const double middle = as_decimal(static_cast<float>((least + most) / 2));
  return now == SettingValue(middle) ? as_decimal(static_cast<float>(most)) : middle;
}

rtapi::Status read(const std::string& text, FrameSettings& frame, SettingsOfEffects& effects) {
  return read_settings(text, "my.json", frame, effects);
}

std::string error_of(const std::string& text) {
  FrameSettings frame;
  SettingsOfEffects effects;
  const auto s = read(text, frame, effects);
  return s ? "none" : s.error().message;
}

TEST(DescribedSettings, EveryConstantOfEveryEffectIsDescribed) {
  for (const Effect& effect : northlight_effects()) {
    const std::size_t bytes = effect.defaults.constants_bytes;
    EXPECT_EQ(first_undescribed(effect.constants, sizeof(effect.defaults.constants)), bytes)
        << effect.name << ": the word at this offset has no description";
    for (const EffectStep& step : effect.steps) {
      EXPECT_EQ(step.settings.constants_bytes, bytes) << effect.name << ": " << step.label;
    }
  }
}

TEST(DescribedSettings, EveryNumberOfTheFiltersIsDescribed) {
  EXPECT_EQ(first_undescribed(denoise_settings(), sizeof(DenoiseDesc)), sizeof(DenoiseDesc));
  EXPECT_EQ(first_undescribed(visibility_settings(), sizeof(VisibilityConstants)),
            sizeof(VisibilityConstants));
  EXPECT_EQ(first_undescribed(taa_settings(), sizeof(TaaConstants)), sizeof(TaaConstants));
  EXPECT_EQ(first_undescribed(enlarge_settings(), sizeof(EnlargeConstants)),
            sizeof(EnlargeConstants));
}

TEST(DescribedSettings, EachHasANameOfItsOwnAndADefaultInItsRange) {
  std::set<std::string> names;
  for (const DescribedSetting& setting : describe_settings()) {
    EXPECT_TRUE(names.insert(setting.full_name()).second)
        << setting.full_name() << " is there twice";
    EXPECT_EQ(setting.full_name().find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"),
              std::string::npos)
        << setting.full_name();
    EXPECT_FALSE(setting.text.about.empty()) << setting.full_name();
    const auto checked = check_value(setting.text, setting.default_value());
    ASSERT_TRUE(checked.ok()) << checked.error().message;
    EXPECT_EQ(*checked, setting.default_value()) << setting.full_name();
  }
}

TEST(DescribedSettings, EachCanBeChangedAlone) {
  const std::vector<DescribedSetting> all = describe_settings();
  for (const DescribedSetting& setting : all) {
    FrameSettings frame;
    SettingsOfEffects effects;
    const SettingValue wanted = other_value(setting.text, setting.default_value());
    setting.set(frame, effects, wanted);
    for (const DescribedSetting& each : all) {
      const bool is_own = &each == &setting;
      // A method brings other numbers along.
      if (!is_own && setting.path() == "denoise.method") continue;
      EXPECT_EQ(each.get(frame, effects), is_own ? wanted : each.default_value())
          << each.full_name() << " after " << setting.full_name();
    }
  }
}

TEST(DescribedSettings, AWrittenFileReadsAsItWas) {
  FrameSettings frame;
  SettingsOfEffects effects;
  for (const DescribedSetting& setting : describe_settings()) {
    setting.set(frame, effects, other_value(setting.text, setting.get(frame, effects)));
  }
  const std::string written = write_settings(frame, effects);
  FrameSettings read_frame;
  SettingsOfEffects read_effects;
  ASSERT_TRUE(read(written, read_frame, read_effects).ok());
  EXPECT_EQ(write_settings(read_frame, read_effects), written);
  EXPECT_NE(written, write_settings({}, {}));
}

TEST(DescribedSettings, AFileMayHaveAPartOfThem) {
  FrameSettings frame;
  SettingsOfEffects effects;
  ASSERT_TRUE(read(R"({"denoise": {"alpha": 0.5, "method": "control"}, "ao": {"radius": "inf"}})",
                   frame, effects)
                  .ok());
  EXPECT_EQ(frame.denoise.method, DenoiseMethod::kControl);
  EXPECT_EQ(frame.denoise.constants.alpha, 0.5f) << "the method comes first";
  EXPECT_EQ(frame.denoise.constants.radius, 8) << "the method's own";
  EXPECT_TRUE(std::isinf(effects.at("ao").radius));
}

TEST(DescribedSettings, AFilesErrorsNameThePath) {
  EXPECT_THAT(
      error_of(R"({"gtao": {"slcies": 3}})"),
      HasSubstr(R"(my.json: there is no setting "gtao.slcies"; the nearest is "gtao.slices")"));
  EXPECT_THAT(error_of(R"({"gtoa": {"slices": 3}})"),
              HasSubstr(R"(my.json: there is no topic "gtoa"; the nearest is "gtao")"));
  EXPECT_THAT(error_of(R"({"gtao": {"slices": 0}})"),
              HasSubstr("my.json: gtao.slices is 0; choose 1 to 1024"));
  EXPECT_THAT(error_of(R"({"gtao": {"slices": 2.5}})"),
              HasSubstr("gtao.slices is 2.5; choose 1 to 1024"));
  EXPECT_THAT(error_of(R"({"gtao": {"slices": "3"}})"),
              HasSubstr("gtao.slices is \"3\"; choose 1 to 1024"));
  EXPECT_THAT(error_of(R"({"gtao": {"noise": 1}})"),
              HasSubstr("gtao.noise is 1; choose on or off"));
  EXPECT_THAT(error_of(R"({"gtao": {"slices": [3]}})"), HasSubstr("gtao.slices is [3]; it has to"));
  EXPECT_THAT(error_of(R"({"gtao": 3})"), HasSubstr("gtao is 3; it has to be an object"));
  EXPECT_THAT(error_of("[]"), HasSubstr("it has to be an object"));
  EXPECT_THAT(error_of("{"), HasSubstr("my.json: no JSON"));
}

TEST(DescribedSettings, AFileWithAnErrorChangesNothing) {
  FrameSettings frame;
  SettingsOfEffects effects;
  EXPECT_FALSE(read(R"({"taa": {"alpha": 0.5}, "gtao": {"slices": 0}})", frame, effects).ok());
  EXPECT_EQ(frame.taa_constants.alpha, TaaConstants().alpha);
}

TEST(DescribedSettings, ThePageIsCurrent) {
  const std::string path = KAAMOS_SOURCE_DIR "/examples/northlight/SETTINGS.md";
  std::ifstream in(path);
  std::stringstream committed;
  committed << in.rdbuf();
  EXPECT_TRUE(committed.str() == settings_page())
      << "The page is not what the descriptions say. Write it with\n  northlight --help=page > "
      << path;
}

}  // namespace
}  // namespace kaamos::effects

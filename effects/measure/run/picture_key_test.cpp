// SPDX-License-Identifier: MIT
#include "effects/measure/run/picture_key.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "effects/northlight/described_settings.h"

namespace kaamos::measure {
namespace {

using namespace kaamos::effects;

// Some value that is allowed and not the present one.
std::string another_value(const SettingText& text, const SettingValue& now) {
  const std::string present = value_text(now);
  if (text.type == SettingType::kSwitch) return present == "on" ? "off" : "on";
  if (text.type == SettingType::kWord) return text.words[present == text.words[0] ? 1 : 0];
  const std::string least = value_text(as_decimal(static_cast<float>(text.range.least)));
  if (least != present) return least;
  const double more = std::min(text.range.least + 1, text.range.most);
  return value_text(as_decimal(static_cast<float>(more)));
}

TEST(PictureKey, DependsOnEveryDescribedSetting) {
  const Scene scene;
  std::set<std::string> keys = {picture_key(default_options(), scene)};
  for (const DescribedSetting& setting : describe_settings()) {
    Options options = default_options();
    const auto value =
        parse_value(setting.text, another_value(setting.text, setting.default_value()));
    ASSERT_TRUE(value.ok()) << value.error().message;
    setting.set(options.frame, options.effects, *value);
    EXPECT_TRUE(keys.insert(picture_key(options, scene)).second) << setting.full_name();
  }
}

TEST(PictureKey, AVolumesKeyDependsOnHowItIsBaked) {
  const Scene scene;
  std::set<std::string> keys = {volume_key(default_options(), scene)};
  for (const DescribedSetting& setting : describe_settings()) {
    if (setting.topic != "volume") continue;
    Options options = default_options();
    const auto value =
        parse_value(setting.text, another_value(setting.text, setting.default_value()));
    ASSERT_TRUE(value.ok()) << value.error().message;
    setting.set(options.frame, options.effects, *value);
    EXPECT_TRUE(keys.insert(volume_key(options, scene)).second) << setting.full_name();
  }
}

}  // namespace
}  // namespace kaamos::measure

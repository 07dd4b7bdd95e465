// SPDX-License-Identifier: MIT
#include "effects/engine/setting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace kaamos::effects {
namespace {

using testing::HasSubstr;

enum class Colour : std::uint32_t { kRed, kGreen };

struct Inner {
  float bias = 0.1f;
  std::uint32_t flags = 0;
};
struct Outer {
  Inner inner;
  std::uint32_t taps = 16;
  Colour colour = Colour::kGreen;
  std::uint32_t draw = 0;
};

SettingTable<Inner> inner_settings() {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  return {number_setting("bias", &Inner::bias, {0, kInfinite}, "m", "a bias"),
          bits_setting("plane", &Inner::flags, 2, "a plane")};
}

SettingTable<Outer> outer_settings() {
  return join_settings(settings_within(&Outer::inner, inner_settings()),
                       {count_setting("taps", &Outer::taps, {1, 64}, "taps", "many"),
                        word_setting("colour", &Outer::colour, {"red", "green"}, "a colour"),
                        closed_setting(&Outer::draw)});
}

const SettingOf<Outer>& find(const SettingTable<Outer>& table, const std::string& name) {
  for (const auto& setting : table) {
    if (setting.text.name == name) return setting;
  }
  throw std::runtime_error(name);
}

std::string error_of(const std::string& name, const std::string& value) {
  const auto parsed = parse_value(find(outer_settings(), name).text, value);
  return parsed.ok() ? "none" : parsed.error().message;
}

TEST(Setting, ReadsAndWritesMembersOfMembers) {
  const SettingTable<Outer> table = outer_settings();
  Outer outer;
  EXPECT_EQ(value_text(find(table, "bias").get(outer)), "0.1");
  find(table, "bias").set(outer, 0.25);
  find(table, "plane").set(outer, true);
  find(table, "taps").set(outer, std::int64_t{9});
  find(table, "colour").set(outer, std::string("red"));
  EXPECT_EQ(outer.inner.bias, 0.25f);
  EXPECT_EQ(outer.inner.flags, 2u);
  EXPECT_EQ(outer.taps, 9u);
  EXPECT_EQ(outer.colour, Colour::kRed);
  EXPECT_EQ(value_text(find(table, "plane").get(outer)), "on");
  EXPECT_EQ(value_text(find(table, "colour").get(outer)), "red");
}

TEST(Setting, AMemberWithoutADescriptionIsFound) {
  EXPECT_EQ(first_undescribed(outer_settings(), sizeof(Outer)), sizeof(Outer));
  SettingTable<Outer> table = outer_settings();
  table.pop_back();
  EXPECT_EQ(first_undescribed(table, sizeof(Outer)), offset_of(&Outer::draw));
}

TEST(Setting, AMessageSaysWhatIsAllowed) {
  EXPECT_THAT(error_of("taps", "0"), HasSubstr("taps is 0; choose 1 to 64 taps"));
  EXPECT_THAT(error_of("taps", "1.5"), HasSubstr("taps is 1.5; choose 1 to 64 taps"));
  EXPECT_THAT(error_of("taps", "many"), HasSubstr("taps is \"many\"; choose 1 to 64 taps"));
  EXPECT_THAT(error_of("bias", "-1"), HasSubstr("bias is -1; choose 0 to inf m"));
  EXPECT_THAT(error_of("bias", "nan"), HasSubstr("bias is nan"));
  EXPECT_THAT(error_of("colour", "blue"), HasSubstr("colour is \"blue\"; choose red or green"));
  EXPECT_THAT(error_of("plane", "1"), HasSubstr("plane is \"1\"; choose on or off"));
  EXPECT_EQ(error_of("bias", "inf"), "none");
}

TEST(Setting, CountsTakeNoOtherType) {
  const SettingText text = find(outer_settings(), "taps").text;
  EXPECT_FALSE(check_value(text, true).ok());
  EXPECT_FALSE(check_value(text, 2.5).ok());
  EXPECT_TRUE(check_value(text, 2.0).ok());
}

TEST(Setting, TheNearestNameIsOneOfAFewLettersElse) {
  const std::vector<std::string> names = {"gtao.slices", "gtao.steps", "hbao.steps"};
  EXPECT_EQ(nearest_name(names, "gtao.slcies"), "gtao.slices");
  EXPECT_EQ(nearest_name(names, "x"), "");
}

}  // namespace
}  // namespace kaamos::effects

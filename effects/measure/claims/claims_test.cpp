// SPDX-License-Identifier: MIT
#include "effects/measure/claims/claims.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "effects/assets/built_in/glass_scenes.h"
#include "effects/measure/claims/claims_page.h"

namespace kaamos::measure {
namespace {

using namespace effects;
using testing::HasSubstr;

Options small_options() {
  Options out = default_options();
  out.frame.width = 32;
  out.frame.height = 16;
  out.frame.volume.given = std::make_shared<IndirectVolume>();
  out.repeats = 1;
  out.command = "northlight --claims";
  out.out = testing::TempDir() + "/claims";
  std::filesystem::create_directories(out.out);
  return out;
}

const ClaimTable& measured() {
  static const ClaimTable table = [] {
    ClaimTable out;
    const Scene scene = make_glass_stack({});
    const auto progress = [](const std::string&, double) { return true; };
    measure_claims(small_options(), scene, progress, out).value();
    return out;
  }();
  return table;
}

// 0.9 ms over 1920 x 1080 pixels with two rays each are 4.6 billion rays a second.
TEST(Claims, RatesAreThoseOfTheSources) {
  const Rate sun = rate_of(0.9, kDeckPixels, 2 * kDeckPixels);
  EXPECT_NEAR(sun.ms_per_megapixel, 0.434, 5e-4);
  EXPECT_NEAR(1 / sun.ns_per_ray, 4.6, 0.01);
}

// The scene has a sun, lamps and glass: nothing is left out on any backend.
TEST(Claims, EveryNumberOfTheSourcesHasOneBesideIt) {
  const ClaimTable& table = measured();
  ASSERT_FALSE(table.backends.empty());
  ASSERT_EQ(table.pixels.size(), table.backends.size());
  EXPECT_EQ(table.pixels[0], 32 * 16);
  ASSERT_EQ(table.deck.size(), 4u);
  for (std::size_t i = 0; i < table.backends.size(); ++i) {
    for (const ControlPass& pass : table.control) {
      ASSERT_EQ(pass.here.size(), table.backends.size()) << pass.name;
      EXPECT_TRUE(pass.here[i]) << pass.name;
    }
    for (const DeckNumber& each : table.deck) {
      ASSERT_EQ(each.here.size(), table.backends.size()) << each.name;
      ASSERT_TRUE(each.here[i]) << each.name;
      EXPECT_GT(each.here[i]->ms, 0) << each.name;
      EXPECT_EQ(each.here[i]->rays, each.rays * table.pixels[i]) << each.name;
    }
    // One pass with its filter is the sum of the table's parts, which are medians of one round.
    const auto control = [&](std::size_t pass) { return *table.control[pass].here[i]; };
    EXPECT_NEAR(table.deck[2].here[i]->ms, control(1) + control(2) + control(3), 1e-9);
    EXPECT_NEAR(table.deck[3].here[i]->ms, control(5) + control(6) + control(7), 1e-9);
    EXPECT_NEAR(table.deck[1].here[i]->ms, control(8) + control(9), 1e-9);
  }
}

// [survey: Table 1] The sums of all passes but the structures.
TEST(Claims, ThePageHasControlsSums) {
  ClaimTable table = measured();
  double sums[2] = {};
  for (const ControlPass& pass : table.control) {
    if (pass.is_build) continue;
    for (int frame = 0; frame < 2; ++frame) sums[frame] += pass.frames[frame];
  }
  EXPECT_NEAR(sums[0], 8.9, 1e-9);
  EXPECT_NEAR(sums[1], 7.1, 1e-9);
  table.deck[0].here[0] = TimedPass{2, 1e6};
  table.pixels[0] = 5e5;
  const std::string page = claims_page(small_options(), table);
  EXPECT_THAT(page, HasSubstr("    northlight --claims\n"));
  EXPECT_THAT(page, HasSubstr("| structures: build and update | 0.6, 1 | 7, 14 |"));
  EXPECT_THAT(page, HasSubstr("| sum without structures | 8.9, 7.1 | 100, 100 |"));
  // 2 ms over half a megapixel and a million rays; 0.217 ns a ray in the deck.
  EXPECT_THAT(page, HasSubstr("| sun shadow, 2 | 0.9 | 0.434, 0.217 | 2 | 4, 2 | 9.22 |"));
}

}  // namespace
}  // namespace kaamos::measure

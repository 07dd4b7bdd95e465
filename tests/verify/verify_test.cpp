// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "tests/verify/expected.h"
#include "tests/verify/facts.h"

namespace kaamos::verify {
namespace {

std::vector<Texel> right_picture() {
  std::vector<Texel> out(kTexels);
  for (uint32_t i = 0; i < kTexels; ++i) {
    out[i] = expected_texel(i % kWidth, i / kWidth).value_or(Texel{.t = -7});
  }
  return out;
}

// The ray of pixel (40, 44) is (0.425, -1.025, 2) t from (0.3, 0.2, -5), and meets y = -1.1 at
// t = 1.3 / 1.025. There x = 0.839, z = -2.463: the triangle with the corners (-3, -3), (3, 5),
// (3, -3), in which b1 = (z + 3) / 8 and b1 + b2 = (x + 3) / 6.
TEST(Expected, FloorIsWhereTheRayMeetsItsHeight) {
  const auto texel = expected_texel(40, 44);
  ASSERT_TRUE(texel);
  EXPECT_NEAR(texel->t, 1.268293, 1e-6);
  EXPECT_NEAR(texel->attributes[0], 0.067073, 1e-6);
  EXPECT_NEAR(texel->attributes[1], 0.639837 - 0.067073, 1e-6);
  EXPECT_EQ(texel->code, kFloorId + 16 + 64);
}

TEST(Expected, ThePictureShowsEverythingThatItChecks) {
  std::set<float> codes;
  for (const Texel& texel : right_picture()) codes.insert(texel.code + (texel.t == -1 ? 1000 : 0));
  for (const int code : {1000, 1, 17, 65, 81, 2, 3}) {
    EXPECT_EQ(codes.count(static_cast<float>(code)), 1u) << code;
  }
}

TEST(Expected, AlmostAllTexelsAreCompared) {
  const Comparison comparison = compare(right_picture());
  EXPECT_EQ(comparison.failure, "");
  EXPECT_GT(comparison.compared, kTexels * 95 / 100);
  EXPECT_LT(comparison.largest_error, 1e-6);
}

TEST(Expected, OneWrongTexelIsNamed) {
  const uint32_t i = 44 * kWidth + 40;
  for (const auto& spoil :
       {+[](Texel& texel) { texel.t *= 1.001f; }, +[](Texel& texel) { texel.code -= 64; },
        +[](Texel& texel) { texel.attributes[1] += 0.01f; },
        +[](Texel& texel) { texel.t = std::numeric_limits<float>::quiet_NaN(); }}) {
    std::vector<Texel> picture = right_picture();
    spoil(picture[i]);
    EXPECT_EQ(compare(picture).failure.substr(0, 15), "pixel (40, 44) ");
  }
  EXPECT_NE(compare({}).failure, "");
}

TEST(Facts, EachHasAValue) {
  std::set<std::string> names;
  for (const auto& [name, value] : machine_facts()) {
    EXPECT_FALSE(value.empty()) << name;
    names.insert(name);
  }
  for (const char* name : {"Kaamos", "system", "processor", "extensions", "oneTBB"}) {
    EXPECT_EQ(names.count(name), 1u) << name;
  }
}

}  // namespace
}  // namespace kaamos::verify

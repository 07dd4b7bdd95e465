// SPDX-License-Identifier: MIT
#include "runtime/explain/values.h"

#include <gtest/gtest.h>

#include <cstring>

namespace kaamos::explain {
namespace {

TEST(DecodeValues, FieldsAreReadByTypeNameAndOffset) {
  struct {
    float color[3] = {0.5f, 0.1f, 1e10f};
    uint32_t id = 7;
    double distance = -2.25;
    int16_t step = -3;
    bool done = true;
    uint16_t half = 0x3C00;
    float matrix[4] = {1, 2, 3, 4};
  } bytes;
  const auto values = decode_values(
      "float3 color 0;uint id 12;double light.distance 16;int16_t step 24;bool done 26;"
      "float16_t weight[0] 28;float2x2 matrix 32;",
      &bytes, sizeof bytes);
  const char* expected[][3] = {{"color", "float3", "0.5 0.1 1e+10"},
                               {"id", "uint", "7"},
                               {"light.distance", "double", "-2.25"},
                               {"step", "int16_t", "-3"},
                               {"done", "bool", "true"},
                               {"weight[0]", "float16_t", "1"},
                               {"matrix", "float2x2", "1 2 3 4"}};
  ASSERT_EQ(values.size(), std::size(expected));
  for (size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(values[i].Name, expected[i][0]);
    EXPECT_EQ(values[i].Type, expected[i][1]);
    EXPECT_EQ(values[i].Text, expected[i][2]);
  }
}

TEST(DecodeValues, NothingIsReadPastTheBytesThatAreThere) {
  const uint32_t words[2] = {0xDEADBEEF, 1};
  EXPECT_EQ(
      decode_values("uint a 0;uint2 b 4;uint c 4294967295;nonsense d 0;uint", words, 8).size(), 1u);
  const auto plain = decode_values(nullptr, words, 7);
  ASSERT_EQ(plain.size(), 1u);
  EXPECT_EQ(plain[0].Text, "0xdeadbeef");
  EXPECT_TRUE(decode_values("uint a 0;", nullptr, 8).empty());
}

TEST(RayFlagsText, NamesEachFlagAndShowsUndefinedBits) {
  EXPECT_EQ(ray_flags_text(0), "NONE");
  EXPECT_EQ(ray_flags_text(0x201), "FORCE_OPAQUE | SKIP_PROCEDURAL_PRIMITIVES");
  EXPECT_EQ(ray_flags_text(0x400), "FORCE_OMM_2_STATE");
  EXPECT_EQ(ray_flags_text(0x800), "0x800");
}

}  // namespace
}  // namespace kaamos::explain

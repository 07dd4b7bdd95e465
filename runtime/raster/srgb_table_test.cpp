// SPDX-License-Identifier: MIT
//
// RAS-117.
#include "runtime/raster/srgb_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/shader/texture/format_codec.h"

namespace kaamos::raster {
namespace {

int32_t looked_up(float x) {
  const SrgbTable::Bucket& bucket =
      srgb_table().buckets[static_cast<int>(x * static_cast<float>(SrgbTable::kBuckets))];
  return bucket.value + (x >= bucket.border ? 1 : 0);
}

TEST(RasterSrgb, TableHasEveryBorder) {
  for (int i = 0; i < SrgbTable::kBuckets; ++i) {
    const float border = srgb_table().buckets[i].border;
    if (border > 1) continue;
    for (const float x : {std::nextafter(border, 0.0f), border, std::nextafter(border, 1.0f)}) {
      ASSERT_EQ(looked_up(x), shader::linear_to_srgb(x)) << x;
    }
  }
  for (uint32_t i = 0; i <= 1000000; ++i) {
    const float x = static_cast<float>(i) * 1e-6f;
    ASSERT_EQ(looked_up(x), shader::linear_to_srgb(x)) << x;
  }
  EXPECT_EQ(looked_up(1), 255);
  EXPECT_EQ(looked_up(0), 0);
}

}  // namespace
}  // namespace kaamos::raster

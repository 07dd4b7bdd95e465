// SPDX-License-Identifier: MIT
//
// Tests where a ray starts: the table behind the choice made in effects/assets/common/ray_origin.h.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "origin_methods.h"
#include "size.h"

namespace kaamos::test {
namespace {

using Rates = std::array<OriginRates, kOriginMethodCount>;

Rates row(RayProbe& probe, const OriginPlace& place) {
  const Rates rates = measure_origins(probe, place, by_size(8, 128, 2048), by_size(64, 256, 1024));
  std::printf("%7.0e m %7.0e", place.distance, place.scale);
  for (std::size_t m = 0; m < rates.size(); ++m) {
    std::printf(" | %4.1f / %4.1f", 100 * rates[m].self_hits, 100 * rates[m].leaks);
    if (m >= kIntegerOffset) std::printf(" %8.1e", rates[m].offset);
  }
  std::printf("\n");
  return rates;
}

TEST(RayOrigins, OnlyTheErrorBoundNeitherHitsItsTriangleNorStepsOverTheNext) {
  RayProbe probe;
  std::printf(
      "%% of rays that meet their own triangle / that step over a sheet at 0.02 x scale; offset\n"
      "%9s %7s | %11s | %11s | %11s | %20s | %20s\n",
      "distance", "scale", "no offset", "TMin 1e-3", "1e-3 m", "256 float steps", "error bound");
  const Rates tiny = row(probe, {0, 1e-3});
  const Rates usual = row(probe, {0, 1});
  const Rates huge = row(probe, {0, 1e3});
  const Rates near = row(probe, {1e2, 1});
  const Rates far = row(probe, {1e4, 1});
  const Rates lost = row(probe, {1e6, 1});
  const Rates huge_and_far = row(probe, {1e6, 1e3});
  for (const Rates* rates : {&tiny, &usual, &huge, &near, &far, &lost, &huge_and_far}) {
    EXPECT_GT((*rates)[kNoOffset].self_hits, 0.3);
    EXPECT_EQ((*rates)[kErrorBound].self_hits, 0);
    EXPECT_LT((*rates)[kErrorBound].offset, (*rates)[kIntegerOffset].offset / 8);
    // Float steps there are 6 cm, so no offset can avoid both faults. Positions relative to the
    // camera keep every scene in the rows of distance 0.
    EXPECT_EQ((*rates)[kErrorBound].leaks > 0, rates == &lost);
  }
  EXPECT_GT(lost[kErrorBound].leaks, 0.9);
  // Objects that an instance makes 10,000 times as high.
  for (const double distance : {0.0, 1e2, 1e4}) {
    const Rates uneven = row(probe, {distance, 1, 1e4});
    EXPECT_GT(uneven[kNoOffset].self_hits, 0.3);
    EXPECT_EQ(uneven[kErrorBound].self_hits, 0);
  }
  // A fixed length in metres is too much for small objects and too little far away.
  for (const OriginMethod fixed : {kFixedTMin, kFixedOffset}) {
    EXPECT_GT(tiny[fixed].leaks, 0.9);
    EXPECT_GT(huge_and_far[fixed].self_hits, 0.3);
  }
  EXPECT_GT(far[kFixedTMin].self_hits, 0.1);
  EXPECT_GT(huge[kFixedTMin].self_hits, 0.005);
  // Steps of the position do not account for the triangle's own error.
  EXPECT_EQ(far[kIntegerOffset].self_hits, 0);
  EXPECT_GT(far[kIntegerOffset].leaks, 0.9);
}

}  // namespace
}  // namespace kaamos::test

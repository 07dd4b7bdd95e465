// SPDX-License-Identifier: MIT
//
// Linear numbers to sRGB bytes without powers: the same bytes as linear_to_srgb().
#pragma once

#include <cstdint>

namespace kaamos::raster {

// Maps numbers from 0 to 1 by buckets of equal width. The curve is steepest at 0, where a bucket is
// 0.8 of a byte's step wide, so each bucket holds at most one border between bytes.
struct SrgbTable {
  static constexpr int kBuckets = 4096;
  struct Bucket {
    float border;  // the least number in the bucket that gives value + 1, or more than all of them
    int32_t value;
  };
  Bucket buckets[kBuckets + 1];
};

// Made once.
const SrgbTable& srgb_table();

}  // namespace kaamos::raster

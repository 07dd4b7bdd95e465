// SPDX-License-Identifier: MIT
// Compressed bytes that are cut or changed, for tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "effects/assets/common/sampling.h"
#include "effects/assets/gltf/gltf_test_support.h"

namespace kaamos::effects {

/// Every fourth is cut, the others have one to three bits that are not what they were.
inline std::vector<std::uint8_t> damaged(std::vector<std::uint8_t> bytes, std::uint32_t seed) {
  if (seed % 4 == 0) {
    bytes.resize(pcg_hash(seed) % bytes.size());
    return bytes;
  }
  for (std::uint32_t k = 0; k < seed % 4; ++k) {
    const std::uint32_t h = hash_combine(seed, k);
    bytes[h % bytes.size()] ^= static_cast<std::uint8_t>(1u << (h >> 29));
  }
  return bytes;
}

/// Loads the file that `file_of` makes of each of many kinds of damage: all that are cut are
/// refused, and whatever is refused has the id of glTF files. Returns how many are.
template <class FileOf>
int count_refused(const std::vector<std::uint8_t>& good, std::uint32_t tries, FileOf file_of) {
  EXPECT_TRUE(load(file_of(good)).ok());
  int refused = 0;
  for (std::uint32_t seed = 0; seed < tries; ++seed) {
    const auto loaded = load(file_of(damaged(good, seed)));
    refused += !loaded.ok();
    if (loaded.ok()) {
      EXPECT_NE(seed % 4, 0u) << seed << ": is cut";
      EXPECT_TRUE(validate(loaded.value().scene).ok()) << seed;
    } else {
      EXPECT_EQ(loaded.error().id.text(), "KA3020") << seed;
    }
  }
  return refused;
}

}  // namespace kaamos::effects

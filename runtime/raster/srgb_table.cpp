// SPDX-License-Identifier: MIT
#include "runtime/raster/srgb_table.h"

#include <bit>

#include "runtime/shader/texture/format_codec.h"

namespace kaamos::raster {
namespace {

// The least float between two that gives at least `value`; floats of one sign are in the order of
// their bits.
float border_of(float low, float high, uint32_t value) {
  auto below = std::bit_cast<uint32_t>(low);
  auto above = std::bit_cast<uint32_t>(high);
  while (above - below > 1) {
    const uint32_t middle = below + (above - below) / 2;
    if (shader::linear_to_srgb(std::bit_cast<float>(middle)) >= value) {
      above = middle;
    } else {
      below = middle;
    }
  }
  return std::bit_cast<float>(above);
}

SrgbTable make_table() {
  SrgbTable table;
  const auto start = [](int bucket) {
    return static_cast<float>(bucket) / static_cast<float>(SrgbTable::kBuckets);
  };
  for (int i = 0; i <= SrgbTable::kBuckets; ++i) {
    const uint32_t value = shader::linear_to_srgb(start(i));
    const bool steps = shader::linear_to_srgb(start(i + 1)) > value;
    table.buckets[i] = {steps ? border_of(start(i), start(i + 1), value + 1) : 2.0f,
                        static_cast<int32_t>(value)};
  }
  return table;
}

}  // namespace

const SrgbTable& srgb_table() {
  static const SrgbTable table = make_table();
  return table;
}

}  // namespace kaamos::raster

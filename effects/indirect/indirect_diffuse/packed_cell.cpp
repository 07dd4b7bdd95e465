// SPDX-License-Identifier: MIT
#include "effects/indirect/indirect_diffuse/packed_cell.h"

#include <algorithm>
#include <bit>

namespace kaamos::effects {

namespace {

constexpr std::uint32_t kSign = 0x80000000u;
constexpr std::uint32_t kInfinity = 0x7F800000u;
constexpr std::uint32_t kLower = 0x7FFu;  // the lower bits of a word, which hold a part of blue

// Rounds to the nearest float whose bits under `dropped` are zero.
std::uint32_t rounded(float value, std::uint32_t dropped) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const std::uint32_t size = bits & ~kSign;
  if (size > kInfinity) return kInfinity | 0x400000u;  // NaN stays NaN
  const std::uint32_t largest = kInfinity - dropped - 1;
  return (bits & kSign) | std::min((size + (dropped + 1) / 2) & ~dropped, largest);
}

VolumeCell from_words(const std::array<std::array<float, 4>, 3>& colors, bool valid) {
  VolumeCell cell;
  cell.validity = valid ? 1.0f : 0.0f;
  glm::vec3* const parts[4] = {&cell.mean, &cell.slope_x, &cell.slope_y, &cell.slope_z};
  for (int color = 0; color < 3; ++color) {
    for (std::size_t part = 0; part < 4; ++part) (*parts[part])[color] = colors[color][part];
  }
  return cell;
}

}  // namespace

PackedCell pack_cell(const VolumeCell& cell) {
  const glm::vec3 mean = glm::max(cell.mean, glm::vec3(0.0f));
  const glm::vec3* const parts[4] = {&mean, &cell.slope_x, &cell.slope_y, &cell.slope_z};
  PackedCell packed;
  for (std::size_t part = 0; part < 4; ++part) {
    const std::uint32_t blue = rounded(parts[part]->b, 0x3FFu);
    packed.red[part] = rounded(parts[part]->r, kLower) | blue >> 21;
    packed.green[part] = rounded(parts[part]->g, kLower) | (blue >> 10 & kLower);
  }
  if (!(cell.validity > 0.0f)) packed.red[0] |= kSign;
  return packed;
}

VolumeCell unpack_cell(const PackedCell& cell) {
  std::array<std::array<float, 4>, 3> colors;
  for (std::size_t part = 0; part < 4; ++part) {
    const std::uint32_t red = part == 0 ? cell.red[0] & ~kSign : cell.red[part];
    const std::uint32_t green = cell.green[part];
    colors[0][part] = std::bit_cast<float>(red & ~kLower);
    colors[1][part] = std::bit_cast<float>(green & ~kLower);
    colors[2][part] = std::bit_cast<float>(cell.red[part] << 21 | (green & kLower) << 10);
  }
  return from_words(colors, (cell.red[0] & kSign) == 0);
}

}  // namespace kaamos::effects

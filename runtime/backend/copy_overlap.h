// SPDX-License-Identifier: MIT
//
// Copies within one texture.
#pragma once

#include <algorithm>
#include <cstdint>

#include "runtime/backend/commands.h"

namespace kaamos::runtime {

inline bool same_subresource(const TextureCopyPlace& a, const TextureCopyPlace& b) {
  return a.texture != nullptr && a.texture == b.texture && a.mip == b.mip &&
         a.array_element == b.array_element && a.plane == b.plane;
}

// Whether a copy of so many elements reads some that it writes.
// [D3D12: enhanced barriers, self resource copy]
inline bool overlap(const TextureCopyPlace& to, const TextureCopyPlace& from,
                    const uint32_t (&extent)[3]) {
  if (!same_subresource(to, from)) return false;
  for (int i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax(to.origin[i], from.origin[i]);
    if (high - low >= extent[i]) return false;
  }
  return true;
}

}  // namespace kaamos::runtime

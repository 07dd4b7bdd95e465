// SPDX-License-Identifier: MIT
//
// The second template argument of RayQuery, as compiler and backends pass it on: bits among
// RayQueryArguments::ray_flags, of which rays themselves have none. [DXR: RAYQUERY_FLAG]
#pragma once

#include <cstdint>

namespace kaamos::shader {

inline constexpr uint32_t kRayQueryAllowsMicromaps = 0x80000000;  // ALLOW_OPACITY_MICROMAPS
inline constexpr uint32_t kRayQueryAllowsClusters = 0x40000000;   // ALLOW_CLUSTERED_GEOMETRY
inline constexpr uint32_t kRayQueryPermissions = kRayQueryAllowsMicromaps | kRayQueryAllowsClusters;

// The permissions of RAYQUERY_FLAGs, and the flags of permissions.
constexpr uint32_t query_permissions_of(uint32_t query_flags) {
  return ((query_flags & 1) != 0 ? kRayQueryAllowsMicromaps : 0) |
         ((query_flags & 2) != 0 ? kRayQueryAllowsClusters : 0);
}
constexpr uint32_t query_flags_of(uint32_t permissions) {
  return ((permissions & kRayQueryAllowsMicromaps) != 0 ? 1u : 0u) |
         ((permissions & kRayQueryAllowsClusters) != 0 ? 2u : 0u);
}

}  // namespace kaamos::shader

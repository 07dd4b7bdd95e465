// SPDX-License-Identifier: MIT
//
// What compiler and backends agree on for opacity micromaps.
#pragma once

#include <cstdint>

namespace kaamos::shader {

// Among RayQueryArguments::ray_flags: the second template argument of the RayQuery is
// RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS.
inline constexpr uint32_t kRayQueryAllowsMicromaps = 0x80000000;

}  // namespace kaamos::shader

// SPDX-License-Identifier: MIT
/// @file
/// Tables that take longer to compute than a frame takes to start. The build computes them
/// (write_tables.cpp) and compiles them into the library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "effects/assets/common/blue_noise.h"
#include "effects/assets/common/specular_albedo.h"

namespace kaamos::effects {

/// void_and_cluster for the seeds 1 and 2.
extern const std::uint16_t kNoiseRanks[2][std::size_t{kBlueNoiseSize} * kBlueNoiseSize];

/// integrate_specular_albedo in the order of split_albedo_table.
extern const std::array<float, 2>
    kAlbedoSplits[std::size_t{kSpecularAlbedoCosines} * kSpecularAlbedoRoughnesses];

}  // namespace kaamos::effects

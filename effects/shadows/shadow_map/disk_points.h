// SPDX-License-Identifier: MIT
/// @file
/// Points for the taps of filters.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace kaamos::effects {

/// Points of the unit disk of which the first n of any n keep away from each other, as those of a
/// Poisson disk do: each is the one of many random ones that is farthest from those before it.
/// [Mitchell 1991, Spectrally Optimal Sampling: best candidates]
std::vector<glm::vec2> disk_points(std::uint32_t count);

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
/// @file
/// Dither arrays by void and cluster. [Ulichney 1993] The build makes the blue noise of
/// blue_noise.h with it (write_tables.cpp).
#pragma once

#include <cstdint>
#include <vector>

namespace kaamos::effects {

/// A dither array of size * size: every rank 0..size*size-1 once, such that for every n the cells
/// of rank < n are spread evenly over the torus. The same on every machine: all energies are
/// integers. `size` is a power of two of 8..256.
std::vector<std::uint32_t> void_and_cluster(std::uint32_t size, std::uint32_t seed);

}  // namespace kaamos::effects

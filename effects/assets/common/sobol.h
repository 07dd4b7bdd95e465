// SPDX-License-Identifier: MIT
/// @file
/// Owen-scrambled Sobol points, two dimensions at a time. An effect that needs more dimensions
/// takes further pairs with other seeds ("padding"): each pair is well distributed, and pairs are
/// independent.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace kaamos::effects {

/// The bits of `x` in reverse order.
std::uint32_t reverse_bits(std::uint32_t x);

/// First and second dimension of the Sobol sequence as 32-bit fractions. `index` is any number.
///@{
std::uint32_t sobol_0(std::uint32_t index);
std::uint32_t sobol_1(std::uint32_t index);
///@}

/// Nested uniform (Owen) scrambling of a 32-bit fraction by a hash. [Laine & Karras 2011, with the
/// constants of Vegdahl 2021]
std::uint32_t owen_scramble(std::uint32_t fraction, std::uint32_t seed);

/// Point `index` of a scrambled and shuffled sequence, each coordinate in [0, 1). Any run of 2^k
/// points that starts at a multiple of 2^k is stratified. [Burley 2020]
glm::vec2 sobol_owen(std::uint32_t index, std::uint32_t seed);

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
#include "effects/assets/common/sobol.h"

#include "effects/assets/common/sampling.h"

namespace kaamos::effects {

std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0x00FF00FFu) << 8) | ((x & 0xFF00FF00u) >> 8);
  x = ((x & 0x0F0F0F0Fu) << 4) | ((x & 0xF0F0F0F0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xCCCCCCCCu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xAAAAAAAAu) >> 1);
}

std::uint32_t sobol_0(std::uint32_t index) {
  return reverse_bits(index);
}

std::uint32_t sobol_1(std::uint32_t index) {
  // The generator matrix of this dimension (polynomial x + 1) is Pascal's triangle modulo 2, the
  // Kronecker power of [1 1; 0 1]. That allows multiplying by it in 5 steps instead of 32.
  std::uint32_t x = index;
  x ^= (x & 0xAAAAAAAAu) >> 1;
  x ^= (x & 0xCCCCCCCCu) >> 2;
  x ^= (x & 0xF0F0F0F0u) >> 4;
  x ^= (x & 0xFF00FF00u) >> 8;
  x ^= (x & 0xFFFF0000u) >> 16;
  return reverse_bits(x);
}

std::uint32_t owen_scramble(std::uint32_t fraction, std::uint32_t seed) {
  // With the bits reversed, a carry only reaches bits of less weight, which is what nesting means.
  std::uint32_t x = reverse_bits(fraction);
  x ^= x * 0x3D20ADEAu;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526C56u;
  x ^= x * 0x53A22864u;
  return reverse_bits(x);
}

glm::vec2 sobol_owen(std::uint32_t index, std::uint32_t seed) {
  const std::uint32_t shuffled = owen_scramble(index, seed);
  return {unit_float(owen_scramble(sobol_0(shuffled), pcg_hash(seed ^ 0x9E3779B9u))),
          unit_float(owen_scramble(sobol_1(shuffled), pcg_hash(seed ^ 0x85EBCA6Bu)))};
}

}  // namespace kaamos::effects

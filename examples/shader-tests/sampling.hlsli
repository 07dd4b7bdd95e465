// SPDX-License-Identifier: MIT
// Points for Monte Carlo integration, and what becomes of them.
#pragma once

// The bits of a number in reverse, as a fraction in [0, 1). [van der Corput]
float radical_inverse(uint bits) {
  return float(reversebits(bits) >> 8) / 16777216.0;
}

float2 hammersley(uint i, uint count) {
  return float2(float(i) / float(count), radical_inverse(i));
}

// The unit square to directions around +z, with probability cos / pi.
float3 cosine_hemisphere(float2 u) {
  const float r = sqrt(u.x);
  const float phi = 6.2831853 * u.y;
  return float3(r * cos(phi), r * sin(phi), sqrt(max(0, 1 - u.x)));
}

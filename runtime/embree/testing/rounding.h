// SPDX-License-Identifier: MIT
//
// What tests must know of this machine's arithmetic.
#pragma once

namespace kaamos::embree::testing {

// Whether Embree rounds distances: without AVX-512 it multiplies by an approximate reciprocal.
inline bool rounds_distances() {
#if defined(__x86_64__)
  return !__builtin_cpu_supports("avx512vl");
#else
  return true;
#endif
}

}  // namespace kaamos::embree::testing

// SPDX-License-Identifier: MIT
//
// The floating-point mode in which shaders run on a CPU.
#pragma once

#include <xmmintrin.h>

#include <cstdint>

namespace kaamos::shader {

// Flushes denormals to zero for this thread until the end of the scope: for shaders because of
// D3D's fp32 rules, and for Embree because denormals would slow it down.
class FloatMode {
 public:
  FloatMode() : saved_(_mm_getcsr()) {
    constexpr uint32_t kFlushToZero = 0x8000;
    constexpr uint32_t kDenormalsAreZero = 0x0040;
    constexpr uint32_t kAllMasked = 0x1F80;
    _mm_setcsr(kAllMasked | kFlushToZero | kDenormalsAreZero);
  }
  ~FloatMode() { _mm_setcsr(saved_); }
  FloatMode(const FloatMode&) = delete;
  FloatMode& operator=(const FloatMode&) = delete;

 private:
  uint32_t saved_;
};

}  // namespace kaamos::shader

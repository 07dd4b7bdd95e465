// SPDX-License-Identifier: MIT
//
// The floating-point mode in which shaders run on a CPU.
#pragma once

#if defined(__x86_64__)
#include <xmmintrin.h>
#elif !defined(__aarch64__)
#error "The floating-point mode of shaders is written for x86-64 and ARM64 only."
#endif

#include <cstdint>

namespace kaamos::shader {

// Flushes denormals to zero for this thread until the end of the scope: for shaders because of
// D3D's fp32 rules, and for Embree because denormals would slow it down. Rounds to nearest even,
// keeps NaNs and traps nothing, whatever the caller has set. The caller's exception flags come
// back, too. x86-64 flushes a result that is too small after rounding and ARM64 one that is too
// small before, so a product just below FLT_MIN is FLT_MIN on the one and 0 on the other.
class FloatMode {
 public:
#if defined(__x86_64__)
  FloatMode() : saved_(_mm_getcsr()) {
    constexpr uint32_t kFlushToZero = 0x8000;
    constexpr uint32_t kDenormalsAreZero = 0x0040;
    constexpr uint32_t kAllMasked = 0x1F80;
    _mm_setcsr(kAllMasked | kFlushToZero | kDenormalsAreZero);
  }
  ~FloatMode() {
    _mm_setcsr(saved_);
  }
#else
  FloatMode() {
    constexpr uint64_t kFlushToZero = 1u << 24;  // operands as well as results
    __asm__ volatile("mrs %0, fpcr\n\tmrs %1, fpsr" : "=r"(saved_), "=r"(saved_flags_)::"memory");
    __asm__ volatile("msr fpcr, %0" ::"r"(kFlushToZero) : "memory");
  }
  ~FloatMode() {
    __asm__ volatile("msr fpcr, %0\n\tmsr fpsr, %1" ::"r"(saved_), "r"(saved_flags_) : "memory");
  }
#endif
  FloatMode(const FloatMode&) = delete;
  FloatMode& operator=(const FloatMode&) = delete;

 private:
#if defined(__x86_64__)
  uint32_t saved_;
#else
  uint64_t saved_;
  uint64_t saved_flags_;
#endif
};

}  // namespace kaamos::shader

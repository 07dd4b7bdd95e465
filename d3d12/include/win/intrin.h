// SPDX-License-Identifier: MIT
// Processor intrinsics; those of MSVC that clang does not have by itself.
#pragma once

#if defined(__x86_64__)
#include <x86intrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#if !defined(__clang__) || !defined(_MSC_EXTENSIONS)
inline void __debugbreak() {
  __builtin_trap();
}
#endif

// SPDX-License-Identifier: MIT
// Processor intrinsics; those of MSVC that clang does not have by itself.
#pragma once

#include <x86intrin.h>

#if !defined(__clang__) || !defined(_MSC_EXTENSIONS)
inline void __debugbreak() {
  __builtin_trap();
}
#endif

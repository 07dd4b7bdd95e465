// SPDX-License-Identifier: MIT
//
// Tells which version of a shader library this machine runs. All versions give the same bits.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace kaamos::shader {

enum class CpuLevel {
  kBaseline,  // any x86-64, or a processor of a different kind
  kAvx2,
};

/// The best level that the processor supports; $KAAMOS_CPU_LEVEL (sse2 or avx2) can lower it. Any
/// other value, or a higher level, is reported once on stderr and ignored.
inline CpuLevel cpu_level() {
  static const CpuLevel level = [] {
    CpuLevel best = CpuLevel::kBaseline;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) best = CpuLevel::kAvx2;
#endif
    const char* wanted = std::getenv("KAAMOS_CPU_LEVEL");
    if (wanted == nullptr || *wanted == '\0') return best;
    if (std::strcmp(wanted, "sse2") == 0) return CpuLevel::kBaseline;
    if (std::strcmp(wanted, "avx2") != 0) {
      std::fprintf(
          stderr,
          "kaamos: KAAMOS_CPU_LEVEL is \"%s\", which is no level; it is ignored. Set it to "
          "sse2 or avx2, or unset it.\n",
          wanted);
    } else if (best != CpuLevel::kAvx2) {
      std::fprintf(stderr,
                   "kaamos: KAAMOS_CPU_LEVEL is \"avx2\", which this processor cannot run; it is "
                   "ignored.\n");
    }
    return best;
  }();
  return level;
}

}  // namespace kaamos::shader

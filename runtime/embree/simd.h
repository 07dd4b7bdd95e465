// SPDX-License-Identifier: MIT
//
// The SSE2 intrinsics that this folder is written with: the processor's own, or elsewhere those of
// SIMDe, which have the same results on NEON. Two rules keep that so: no estimates (_mm_rcp_ps,
// _mm_rsqrt_ps), whose bits differ between processors, and no scalar comparisons (_mm_comile_ss),
// which SIMDe answers differently for NaN.
#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#else
#define SIMDE_ENABLE_NATIVE_ALIASES
#include <simde/x86/sse2.h>
#endif

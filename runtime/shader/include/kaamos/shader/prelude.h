// SPDX-License-Identifier: MIT
//
// The one header that emitted C++ includes. It needs no library but libm. Emitted code is compiled
// with
//   -std=c++20 -ffp-contract=off -fno-math-errno -fno-trapping-math -fwrapv -fno-strict-aliasing
// and never with -ffast-math: NaN and infinities follow HLSL's rules.
#pragma once

#include <bit>

#include "kaamos/shader/abi.h"
#include "kaamos/shader/atomics.h"
#include "kaamos/shader/bindings.h"
#include "kaamos/shader/bound.h"
#include "kaamos/shader/convert.h"
#include "kaamos/shader/half.h"
#include "kaamos/shader/hit_object.h"
#include "kaamos/shader/intrinsics_bits.h"
#include "kaamos/shader/intrinsics_geometry.h"
#include "kaamos/shader/intrinsics_scalar.h"
#include "kaamos/shader/memory.h"
#include "kaamos/shader/operators.h"
#include "kaamos/shader/ray_query.h"
#include "kaamos/shader/stage.h"
#include "kaamos/shader/system_values.h"
#include "kaamos/shader/texture_access.h"
#include "kaamos/shader/vector.h"

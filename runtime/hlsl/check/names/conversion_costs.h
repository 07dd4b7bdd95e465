// SPDX-License-Identifier: MIT
//
// The costs of implicit conversions when overloads are chosen. The table is in OVERLOADS.md.
#pragma once

#include <cstdint>

#include "runtime/hlsl/check/names/types.h"

namespace kaamos::hlsl {

// The scalar that operands of the two have in common. [DXC: CombineBasicTypes]
Scalar combined_scalar(Scalar a, Scalar b);

// 0 is the best. The costs of a call's arguments are added up, and no number of cheaper steps
// outweighs a dearer one. [DXC: ScoreCast]
using ConversionCost = uint64_t;

ConversionCost scalar_cost(Scalar from, Scalar to);
// Costs of another number of components.
ConversionCost size_cost(uint64_t from, uint64_t to);
// An unscoped enum to a number.
ConversionCost enum_cost(Scalar to);

}  // namespace kaamos::hlsl

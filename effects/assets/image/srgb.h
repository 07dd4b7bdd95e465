// SPDX-License-Identifier: MIT
/// @file
/// The sRGB transfer function and its inverse, for values in 0..1. [IEC 61966-2-1]
#pragma once

namespace kaamos::effects {

/// Encodes a linear value.
float srgb_from_linear(float linear);

/// Decodes an encoded value.
///@{
float linear_from_srgb(float encoded);
double linear_from_srgb(double encoded);
///@}

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
/// @file
/// Converts linear values to the bytes that a screen shows.
#pragma once

#include "effects/assets/image/image.h"

namespace kaamos::effects {

/// Filmic curve: 0 stays 0, mid tones keep their slope, highlights roll off towards 1.
/// [Narkowicz 2016, ACES filmic tone mapping curve] NaN and negative values give 0, +inf gives 1.
float filmic(float linear);

/// Radiance times exposure through the filmic curve and the sRGB transfer function. Takes 1, 3 or 4
/// channels (the fourth is dropped); the result has 1 or 3.
ByteImage tonemap(const FloatImage& radiance, float exposure);

/// Values of 0..1 times `scale` plus `bias` as bytes without any curve: for effect pictures and
/// G-buffer layers, where a value must be readable off the picture. NaN gives 0. With `srgb` the
/// transfer function is applied (base colour).
ByteImage to_bytes(const FloatImage& image, float scale = 1.0f, float bias = 0.0f,
                   bool srgb = false);

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
//
// Reduces the samples of pixels to one texel each. [D3D12: ResolveSubresourceRegion]
#pragma once

#include "runtime/raster/draw.h"

namespace kaamos::raster {

// `dest` has one sample; both have the same width, height and format, and one slice.
void resolve(const Surface& dest, const Surface& source, rtapi::ResolveMode mode);

}  // namespace kaamos::raster

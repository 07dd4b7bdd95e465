// SPDX-License-Identifier: MIT
//
// Filtered texture reads with the signatures of Services. Weights and levels of detail are computed
// in float, although D3D only requires 8 fractional bits, which is what hardware uses. [D3D11.3
// 7.18]
//
// The sampler's mip bias is added to the given or computed level of detail. Anisotropic filters
// take one sample at the level of the longer axis. Integer formats are never blended. A null
// texture or sampler gives zeros.
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::shader {

Texel sample_level(const SampleArguments& arguments);
Texel sample_gradient(const SampleArguments& arguments);
float level_of_detail(const SampleArguments& arguments);
// The filtered fraction of texels that pass `comparison func texel`.
float sample_compare_level(const SampleArguments& arguments);
// One component of the four texels that linear filtering would blend on the view's first mip: x
// lower left, y lower right, z upper right, w upper left.
Texel gather(const SampleArguments& arguments);
Texel gather_compare(const SampleArguments& arguments);

// Sets the members of `services` for textures and typed buffers.
void set_texture_services(Services& services);

}  // namespace kaamos::shader

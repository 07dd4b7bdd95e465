// SPDX-License-Identifier: MIT
//
// The most common samples: a plain 2-D texture with four bytes per texel, filtered linearly over
// texels and mips. Gives the same bits as texture_sampling.cpp, without per-texel decisions.
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::shader {

// Returns false, leaving `texel` unchanged, if it is not such a sample.
bool sample_bytes(const SampleArguments& arguments, Texel& texel);

}  // namespace kaamos::shader

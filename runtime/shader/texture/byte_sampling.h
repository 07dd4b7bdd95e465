// SPDX-License-Identifier: MIT
//
// What most samples are: a plain 2-D texture of four bytes a texel, filtered linearly over texels
// and mips. The same bits as texture_sampling.cpp has, with nothing left to ask for each texel.
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::shader {

// False, and `texel` as it was: it is no such sample.
bool sample_bytes(const SampleArguments& arguments, Texel& texel);

}  // namespace kaamos::shader

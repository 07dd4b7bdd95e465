// SPDX-License-Identifier: MIT
//
// Blocks of BC6H. [D3D11.3 19.5.13]
#pragma once

#include <cstdint>

namespace kaamos::shader {

// 16 texels of four half floats, row by row; alpha is 1. Blocks of reserved modes are black.
void decode_bc6h_unsigned(const uint8_t* block, uint8_t* texels);
void decode_bc6h_signed(const uint8_t* block, uint8_t* texels);

}  // namespace kaamos::shader

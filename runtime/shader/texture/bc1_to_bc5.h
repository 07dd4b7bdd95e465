// SPDX-License-Identifier: MIT
//
// Blocks of BC1 to BC5. Each gives 16 texels, row by row. [D3D11.3 19.5.6 to 19.5.12]
#pragma once

#include <cstdint>

namespace kaamos::shader {

// R8G8B8A8.
void decode_bc1(const uint8_t* block, uint8_t* texels);
void decode_bc2(const uint8_t* block, uint8_t* texels);
void decode_bc3(const uint8_t* block, uint8_t* texels);
// R16 and R16G16 as UNORM, which have the accuracy that D3D asks for.
void decode_bc4_unorm(const uint8_t* block, uint8_t* texels);
void decode_bc5_unorm(const uint8_t* block, uint8_t* texels);
// R32 and R32G32 as floats: the steps of SNORM with 16 bits are no multiple of those with 8, but
// stored values must be exact.
void decode_bc4_snorm(const uint8_t* block, uint8_t* texels);
void decode_bc5_snorm(const uint8_t* block, uint8_t* texels);

}  // namespace kaamos::shader

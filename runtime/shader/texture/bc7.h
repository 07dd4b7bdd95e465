// SPDX-License-Identifier: MIT
//
// Blocks of BC7. [D3D11.3 19.5.14]
#pragma once

#include <cstdint>

namespace kaamos::shader {

// 16 texels of R8G8B8A8, row by row. A block of the reserved mode gives zeros.
void decode_bc7(const uint8_t* block, uint8_t* texels);

}  // namespace kaamos::shader

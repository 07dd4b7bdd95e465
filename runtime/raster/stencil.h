// SPDX-License-Identifier: MIT
//
// The stencil test of a draw as tables: what a test gives and what becomes of a stored value depend
// on that value only. [D3D11.3: 17.12]
#pragma once

#include <cstdint>

#include "runtime/backend/draw_commands.h"

namespace kaamos::raster {

// Of triangles that face one way, by the stored value.
struct StencilFace {
  uint8_t passes[256];  // 1 or 0
  uint8_t failed[256];  // the value after the stencil test failed
  uint8_t depth_failed[256];
  uint8_t passed[256];
};

struct StencilTables {
  StencilFace front, back;
  bool writes = false;  // whether any value can change
};

// `read_only`: nothing is written.
StencilTables stencil_tables(const rtapi::DepthStencilDesc& desc, const runtime::DrawState& state,
                             bool read_only);

}  // namespace kaamos::raster

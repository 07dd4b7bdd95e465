// SPDX-License-Identifier: MIT
#include "runtime/raster/stencil.h"

namespace kaamos::raster {
namespace {

using rtapi::StencilOp;

bool holds(rtapi::ComparisonFunc func, uint32_t reference, uint32_t stored) {
  // Bit 0: if less, bit 1: if equal, bit 2: if greater.
  const uint32_t passes = static_cast<uint32_t>(func) - 1;
  const uint32_t order = reference < stored ? 1 : reference == stored ? 2 : 4;
  return (passes & order) != 0;
}

uint32_t result_of(StencilOp op, uint32_t stored, uint32_t reference) {
  switch (op) {
    case StencilOp::kZero:
      return 0;
    case StencilOp::kReplace:
      return reference;
    case StencilOp::kIncrSat:
      return stored == 255 ? 255 : stored + 1;
    case StencilOp::kDecrSat:
      return stored == 0 ? 0 : stored - 1;
    case StencilOp::kInvert:
      return ~stored;
    case StencilOp::kIncr:
      return stored + 1;
    case StencilOp::kDecr:
      return stored - 1;
    default:
      return stored;
  }
}

// Returns whether any value can change.
bool fill(StencilFace& face, const rtapi::DepthStencilOpDesc& desc, uint32_t reference,
          uint32_t write_mask) {
  bool writes = false;
  for (uint32_t stored = 0; stored < 256; ++stored) {
    const auto after = [&](StencilOp op) {
      const uint32_t result = result_of(op, stored, reference);
      const uint32_t value = (result & write_mask) | (stored & ~write_mask);
      writes = writes || value != stored;
      return static_cast<uint8_t>(value);
    };
    face.passes[stored] =
        holds(desc.StencilFunc, reference & desc.StencilReadMask, stored & desc.StencilReadMask);
    face.failed[stored] = after(desc.StencilFailOp);
    face.depth_failed[stored] = after(desc.StencilDepthFailOp);
    face.passed[stored] = after(desc.StencilPassOp);
  }
  return writes;
}

}  // namespace

StencilTables stencil_tables(const rtapi::DepthStencilDesc& desc, const runtime::DrawState& state,
                             bool read_only) {
  StencilTables tables;
  const auto mask = [&](const rtapi::DepthStencilOpDesc& face) {
    return read_only ? 0u : uint32_t{face.StencilWriteMask};
  };
  const bool front = fill(tables.front, desc.FrontFace, state.front_stencil, mask(desc.FrontFace));
  const bool back = fill(tables.back, desc.BackFace, state.back_stencil, mask(desc.BackFace));
  tables.writes = front || back;
  return tables;
}

}  // namespace kaamos::raster

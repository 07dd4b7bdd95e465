// SPDX-License-Identifier: MIT
// Computes where members are in memory, for the checker's types; the rules are in ir/layout.h.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/hlsl/check/names/types.h"

namespace kaamos::hlsl {

struct LayoutSize {
  uint32_t size = 0;       // bytes up to the end of the last member; no tail padding in constant
                           // buffers, padded to the alignment in structured ones
  uint32_t alignment = 4;  // natural alignment
};

// Sizes saturate at kMaxLayoutBytes, which no resource can hold.
inline constexpr uint32_t kMaxLayoutBytes = 0x7FFFFFF0u;

// Constant buffers: the bytes of a row, and the most that one may have.
inline constexpr uint32_t kRowBytes = 16;
inline constexpr uint32_t kMaxBufferBytes = 65536;

LayoutSize layout_of(const Type* type, ir::Layout layout);
// Bytes from the start of one array element to the next.
uint32_t array_stride(const Type* element, ir::Layout layout);
// Bytes from one row (row_major) or column of a matrix to the next.
uint32_t matrix_stride(const Type* matrix, ir::Layout layout);
// The offset of a member whose predecessors end at `offset`.
uint32_t place_member(const Type* type, uint32_t offset, ir::Layout layout);
// The offset of field `index` in the order of ir::Struct::fields: the base, if any, is field 0.
uint32_t field_offset(const StructInfo& structure, uint32_t index, ir::Layout layout);
// Each scalar counts as 4 bytes, a 64-bit one as 8. [DXR: D3D12_RAYTRACING_SHADER_CONFIG]
uint32_t payload_bytes(const Type* type);

}  // namespace kaamos::hlsl

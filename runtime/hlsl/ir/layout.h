// SPDX-License-Identifier: MIT
//
// Computes where the parts of a value are in memory, byte for byte as DXC places them.
//
// Constant buffers: rows of 16 bytes that no scalar or vector straddles; arrays, structs and
// matrices of more than one line start a new row; the rest of the last row of an array or struct is
// available to the next member. Structured buffers: natural alignment. [HLSL: Packing rules for
// constant variables]
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl::ir {

struct Extent {
  uint64_t size = 0;       // bytes; constant buffers: without padding at the end
  uint32_t alignment = 4;  // structured: natural; constant buffers: 16 for what starts a row
};

// row_major applies to matrices and arrays of them, not to structs, whose fields specify it
// themselves.
Extent extent_of(const Type* type, Layout layout, bool row_major);
// Bytes from the start of one array element to the next.
uint64_t array_stride(const Type* element, Layout layout, bool row_major);
// Bytes from one line of a matrix (row, or column) to the next.
uint32_t matrix_stride(const Type* matrix, Layout layout, bool row_major);
// The offset of a member whose predecessors end at `offset`.
uint64_t place_member(const Type* type, uint64_t offset, Layout layout, bool row_major);
// One for each field.
std::vector<uint32_t> field_offsets(const Struct& structure, Layout layout);

}  // namespace kaamos::hlsl::ir

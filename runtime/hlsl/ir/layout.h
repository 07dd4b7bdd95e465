// SPDX-License-Identifier: MIT
//
// Where the parts of a value lie in memory, byte for byte as DXC places them.
//
// Constant buffers: rows of 16 bytes that no scalar or vector straddles; arrays, structs and
// matrices of more than one line start a row; what is left of the last row of an array or struct is
// free for what follows. Structured buffers: natural alignment. [hlsl-subset 3.3, 3.4]
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl::ir {

struct Extent {
  uint64_t size = 0;       // bytes; constant buffers: without padding at the end
  uint32_t alignment = 4;  // structured: natural; constant buffers: 16 for what starts a row
};

// row_major counts for matrices and arrays of them, not for structs, whose fields say so
// themselves.
Extent extent_of(const Type* type, Layout layout, bool row_major);
// Bytes from one element of an array to the next.
uint64_t array_stride(const Type* element, Layout layout, bool row_major);
// Bytes from one line of a matrix (row, or column) to the next.
uint32_t matrix_stride(const Type* matrix, Layout layout, bool row_major);
// Where a member goes whose predecessors end at `offset`.
uint64_t place_member(const Type* type, uint64_t offset, Layout layout, bool row_major);
// One for each field.
std::vector<uint32_t> field_offsets(const Struct& structure, Layout layout);

}  // namespace kaamos::hlsl::ir

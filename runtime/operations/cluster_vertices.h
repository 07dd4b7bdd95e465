// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Vertices of clusters in all formats. [DXR 2.0: D3D12_VERTEX_FORMAT]
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <rtapi/rtas_operations.h>

#include "runtime/backend/address_map.h"

namespace kaamos::runtime {

struct VertexLayout {
  uint32_t bytes = 0;      // of a vertex
  uint32_t alignment = 1;  // of a component
};
// Returns the layout of a format; not of kNone and kCompressed1, which have none.
VertexLayout vertex_layout(rtapi::RtasVertexFormat format);

// What a block of kCompressed1 begins with.
struct CompressedHeader {
  uint32_t exponent = 0;
  int32_t anchor[3] = {0, 0, 0};
  uint32_t bits[3] = {1, 1, 1};  // 1 to 16

  uint64_t bytes(uint32_t vertices) const {
    return 12 + (uint64_t{vertices} * (bits[0] + bits[1] + bits[2]) + 7) / 8;
  }
};
CompressedHeader read_compressed_header(const uint8_t* block);

struct VertexSource {
  rtapi::RtasVertexFormat format = rtapi::RtasVertexFormat::kFloat32x3;
  uint64_t address = 0;
  uint64_t stride = 0;          // 0: without gaps
  uint32_t count = 0;           // of vertices
  uint32_t truncated_bits = 0;  // of each component, once it is a float; at most 32
};

// How many of the vertices are inside their buffer; not of kCompressed1.
uint32_t vertices_inside(const AddressMap& addresses, const VertexSource& source);

// Zeroes the low bits of every component; at most 32.
void truncate_vertices(std::vector<float>& xyz, uint32_t bits);

// Positions of `source.count` vertices, 3 floats each; NaN where the buffer ends before one. `why`
// gets what is wrong with the whole, and the result is empty then.
std::vector<float> decode_vertices(const AddressMap& addresses, const VertexSource& source,
                                   std::string& why);

}  // namespace kaamos::runtime

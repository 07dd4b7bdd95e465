// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Positions as another vertex format keeps them.
// [DXR 2.0: Vertex format conversions of instantiated templates]
#pragma once

#include <cstdint>
#include <vector>

#include <rtapi/rtas_operations.h>

#include "runtime/operations/cluster_vertices.h"

namespace kaamos::runtime {

// What positions are once they were stored in a format and read again. kCompressed1: by a
// template's header. False: some did not fit and were clamped.
bool convert_vertices(rtapi::RtasVertexFormat format, uint32_t header, std::vector<float>& xyz);

// Whether a block has no more bits than a template's header, which then keeps it as it is.
bool fits_template(const CompressedHeader& block, uint32_t header);

}  // namespace kaamos::runtime

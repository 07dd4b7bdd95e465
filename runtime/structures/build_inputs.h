// SPDX-License-Identifier: MIT
//
// What a build reads from GPU memory: vertices of all DXR formats, indices, transforms, boxes. All
// of it is held against the allocations first, so that a wrong count or address is an error and no
// stray read, and copied: DXR lets the application free its inputs once the build has run.
#pragma once

#include <cstdint>
#include <string>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/backend/address_map.h"

namespace kaamos::runtime {

// Triangles or boxes of a geometry. A rest of one or two vertices is ignored.
uint64_t primitive_count(const rtapi::RaytracingGeometryDesc& desc);

// Error KA0790: a range lies outside the living allocations; KA0791: a vertex or index format that
// DXR does not list. `index` is the geometry's position, for the message.
rtapi::Status check_inputs(const rtapi::RaytracingGeometryDesc& desc, uint32_t index,
                           const AddressMap& addresses);

// The same geometry with its addresses as the host sees them: what the functions below take.
rtapi::RaytracingGeometryDesc as_host_sees(const rtapi::RaytracingGeometryDesc& desc,
                                           const AddressMap& addresses);

// x, y, z of each of VertexCount vertices, transformed by Transform3x4; two-component formats have
// z = 0, which is the transform's input. [DXR: D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC]
void decode_vertices(const rtapi::RaytracingGeometryTrianglesDesc& desc, float* xyz);

// Three indices per triangle; without an index buffer 0, 1, 2, ... A triangle with an index of
// VertexCount or more becomes degenerate (0, 0, 0), which is never hit. Returns how many did.
uint32_t decode_indices(const rtapi::RaytracingGeometryTrianglesDesc& desc, uint32_t* indices);

// Bounds of one box as a traversal gets them: a NaN in MinX (or elsewhere) is inactive; an inverted
// box is a point at its centre; the others are widened by a few ulp, because box tests may miss
// what only touches a face, and brought into +-1e18, because builders want finite ones. [DXR:
// Inactive primitives and instances; Degenerate primitives and instances]
struct PaddedBounds {
  float lower[3];
  float upper[3];
  bool active;
};
PaddedBounds padded_bounds(const rtapi::RaytracingAabb& box);

const rtapi::RaytracingAabb& aabb_at(const rtapi::RaytracingGeometryAabbsDesc& desc,
                                     uint64_t primitive);

}  // namespace kaamos::runtime

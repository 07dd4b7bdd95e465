// SPDX-License-Identifier: MIT
//
// Reads the inputs of a build from GPU memory: vertices in all DXR formats, indices, transforms,
// boxes. All of it is first checked against the allocations, so that a wrong count or address
// becomes an error instead of a stray read, and then copied, because DXR lets the application free
// its inputs once the build has run.
#pragma once

#include <cstdint>
#include <string>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/backend/address_map.h"

namespace kaamos::runtime {

// The number of triangles or boxes of a geometry. One or two leftover vertices are ignored.
uint64_t primitive_count(const rtapi::RaytracingGeometryDesc& desc);

// Error KA0790: a range lies outside the live allocations; KA0791: a vertex or index format that
// DXR does not list. `index` is the geometry's position, for the message.
rtapi::Status check_inputs(const rtapi::RaytracingGeometryDesc& desc, uint32_t index,
                           const AddressMap& addresses);

// The same geometry with host addresses, as the functions below take it.
rtapi::RaytracingGeometryDesc as_host_sees(const rtapi::RaytracingGeometryDesc& desc,
                                           const AddressMap& addresses);

// Writes x, y, z of each of VertexCount vertices, transformed by Transform3x4. Two-component
// formats get z = 0 before the transform. [DXR: D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC]
void decode_vertices(const rtapi::RaytracingGeometryTrianglesDesc& desc, float* xyz);

// Writes three indices per triangle; 0, 1, 2, ... without an index buffer. A triangle with an index
// of VertexCount or more becomes degenerate (0, 0, 0), which is never hit. Returns how many did.
uint32_t decode_indices(const rtapi::RaytracingGeometryTrianglesDesc& desc, uint32_t* indices);

// Bounds of one box as a traversal gets them. A NaN in MinX (or elsewhere) makes it inactive, and
// an inverted box becomes a point at its centre. The others are widened by a few ulp, because box
// tests may miss rays that only touch a face, and clamped to +-1e18, because builders want finite
// bounds. [DXR: Inactive primitives and instances; Degenerate primitives and instances]
struct PaddedBounds {
  float lower[3];
  float upper[3];
  bool active;
};
PaddedBounds padded_bounds(const rtapi::RaytracingAabb& box);

const rtapi::RaytracingAabb& aabb_at(const rtapi::RaytracingGeometryAabbsDesc& desc,
                                     uint64_t primitive);

}  // namespace kaamos::runtime

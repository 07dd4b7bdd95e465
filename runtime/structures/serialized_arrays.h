// SPDX-License-Identifier: MIT
//
// The arrays of a bottom level's geometries, as serialized and decoded data hold them.
#pragma once

#include <cstdint>

#include <rtapi/raytracing.h>

#include "runtime/structures/serialized_frame.h"
#include "runtime/structures/structure_map.h"

namespace kaamos::runtime {

// Counts that follow from the shape alone, so that damaged counts cannot contradict each other.
struct ArrayCounts {
  uint64_t floats = 0;
  uint64_t indices = 0;
  uint64_t boxes = 0;
  uint64_t links = 0;
  uint64_t bytes() const {
    return padded(floats * 4) + padded(indices * 4) + boxes * sizeof(rtapi::RaytracingAabb) +
           padded(links * 4);
  }
};
ArrayCounts counts_of(const GeometryShape& shape);

// A desc of the arrays that follow each other from `address` on.
rtapi::RaytracingGeometryDesc desc_of(const GeometryShape& shape, uint64_t address);

// `linkage` may be null where nothing is linked.
void put_contents(const GeometryContents& contents, const ArrayCounts& counts,
                  const MicromapLinkage* linkage, SerializedWriter& writer);

// What it is for DXR. Not of what an operation made.
rtapi::RaytracingAccelerationStructureType classic_type_of(const AccelerationStructure& structure);

const MicromapLinkage* linkage_of(const AccelerationStructure& structure, uint32_t geometry);

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
#include "runtime/structures/serialized_arrays.h"

namespace kaamos::runtime {

using rtapi::RaytracingGeometryType;

namespace {

rtapi::RaytracingGeometryFlags flags_of(const GeometryShape& shape) {
  auto flags = rtapi::RaytracingGeometryFlags::kNone;
  if (shape.opaque) flags = flags | rtapi::RaytracingGeometryFlags::kOpaque;
  if (shape.no_duplicate_any_hit) {
    flags = flags | rtapi::RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;
  }
  return flags;
}

}  // namespace

ArrayCounts counts_of(const GeometryShape& shape) {
  ArrayCounts counts;
  if (shape.type == RaytracingGeometryType::kProceduralPrimitiveAabbs) {
    counts.boxes = shape.primitives;
  } else if (shape.vertices != 0 && shape.primitives != 0) {
    counts.floats = 3 * uint64_t{shape.vertices};
    if (shape.index_format != rtapi::Format::kUnknown) {
      counts.indices = 3 * uint64_t{shape.primitives};
    }
  }
  if (shape.linked) counts.links = shape.primitives;
  return counts;
}

rtapi::RaytracingGeometryDesc desc_of(const GeometryShape& shape, uint64_t address) {
  const ArrayCounts counts = counts_of(shape);
  rtapi::RaytracingGeometryDesc desc;
  desc.Type = shape.type;
  desc.Flags = flags_of(shape);
  if (shape.type == RaytracingGeometryType::kProceduralPrimitiveAabbs) {
    desc.AABBs = {counts.boxes, {counts.boxes == 0 ? 0 : address, sizeof(rtapi::RaytracingAabb)}};
    return desc;
  }
  auto& triangles = desc.Triangles;
  triangles.VertexFormat = rtapi::Format::kR32G32B32Float;
  triangles.VertexCount = counts.floats == 0 ? 0 : shape.vertices;
  triangles.VertexBuffer = {counts.floats == 0 ? 0 : address, 12};
  if (counts.indices != 0) {
    triangles.IndexFormat = rtapi::Format::kR32Uint;
    triangles.IndexCount = static_cast<uint32_t>(counts.indices);
    triangles.IndexBuffer = address + padded(counts.floats * 4);
  }
  return desc;
}

void put_contents(const GeometryContents& contents, const ArrayCounts& counts,
                  const MicromapLinkage* linkage, SerializedWriter& writer) {
  writer.put_array(contents.xyz.first(counts.floats));
  writer.put_array(contents.indices.first(counts.indices));
  writer.put_array(contents.boxes.first(counts.boxes));
  if (linkage != nullptr) writer.put_array(linkage->indices);
}

rtapi::RaytracingAccelerationStructureType classic_type_of(const AccelerationStructure& structure) {
  using Type = rtapi::RaytracingAccelerationStructureType;
  if (structure.micromaps != nullptr) return Type::kOpacityMicromapArray;
  return structure.bottom_level != nullptr ? Type::kBottomLevel : Type::kTopLevel;
}

const MicromapLinkage* linkage_of(const AccelerationStructure& structure, uint32_t geometry) {
  return structure.linkages.empty() ? nullptr : structure.linkages[geometry].get();
}

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
//
// Acceleration structures as bytes: to be kept and read back, by any backend, and for tools.
//
// The serialized form holds what a build read, decoded, and not the tree: reading it is a build.
// After D3D12's header and the addresses of bottom levels comes a checksum over everything but the
// header's identifier and those addresses, which the application may replace; then records of
// geometries with their arrays, or of instances. Little-endian, in units of 4 bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/structures/structure_map.h"

namespace kaamos::runtime {

struct SerializedSize {
  uint64_t bytes = 0;     // with header and addresses
  uint64_t pointers = 0;  // different bottom levels of a top level; 0 of a bottom level
};
SerializedSize serialized_size(const AccelerationStructure& structure);
// `out` has serialized_size() bytes.
void serialize(const AccelerationStructure& structure, std::span<uint8_t> out);

// What deserialization builds from.
struct SerializedStructure {
  rtapi::RaytracingAccelerationStructureType type =
      rtapi::RaytracingAccelerationStructureType::kTopLevel;
  BuildFlags flags = BuildFlags::kNone;
  uint64_t size_bytes = 0;  // DeserializedSizeInBytes
  // Top level, with the addresses after the header.
  std::vector<rtapi::RaytracingInstanceDesc> instances;
  // Bottom level: three floats a vertex, 32-bit indices or none, at the host's addresses inside the
  // bytes given; and what the geometries were first, for updates.
  std::vector<rtapi::RaytracingGeometryDesc> geometries;
  std::vector<GeometryShape> shapes;
};

// `bytes` begin with the header, may go on past the end, lie at a multiple of 8, and outlive the
// result. Error KA0789: of another driver or version, cut off, or damaged; the message says where.
rtapi::Result<SerializedStructure> parse_serialized(std::span<const uint8_t> bytes);

// The checksum of what parse_serialized would read, written into it: tests damage what lies behind.
void seal_serialized(std::span<uint8_t> bytes);

// kVisualizationDecodeForTools at `address`: addresses in the descs follow it. `out` has
// decoded_size() bytes.
uint64_t decoded_size(const AccelerationStructure& structure);
void decode_for_tools(const AccelerationStructure& structure, uint64_t address,
                      std::span<uint8_t> out);

}  // namespace kaamos::runtime

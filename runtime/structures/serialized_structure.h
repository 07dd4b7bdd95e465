// SPDX-License-Identifier: MIT
//
// Acceleration structures as bytes: to be stored and read back by any backend, and to be decoded
// for tools.
//
// The serialized form contains what a build read, decoded, and not the tree: reading it is a build.
// D3D12's header and an address for each instance come first. Then comes a checksum over
// everything but the header's identifier and those addresses, which the application may replace;
// then records of geometries with their arrays, or of instances. Little-endian, in units of 4
// bytes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/structures/structure_map.h"

namespace kaamos::runtime {

struct SerializedSize {
  uint64_t bytes = 0;  // including header and addresses
  // One for each instance of a top level, null or not; 1 block for a bottom level with micromaps,
  // whose list has an address for each geometry that has some, and for a bottom level of clusters
  // and a partitioned top level; otherwise 0.
  uint64_t pointers = 0;
};
SerializedSize serialized_size(const AccelerationStructure& structure);
// `out` has serialized_size() bytes.
void serialize(const AccelerationStructure& structure, std::span<uint8_t> out);

// The data that deserialization builds from.
struct SerializedStructure {
  rtapi::RaytracingAccelerationStructureType type =
      rtapi::RaytracingAccelerationStructureType::kTopLevel;
  BuildFlags flags = BuildFlags::kNone;
  uint64_t size_bytes = 0;  // DeserializedSizeInBytes
  // Top level. Bottom levels are at the addresses from the list after the header.
  std::vector<rtapi::RaytracingInstanceDesc> instances;
  // Bottom level: three floats per vertex, 32-bit indices or none, at host addresses inside the
  // given bytes; and the shapes that the geometries were first built with, for updates.
  std::vector<rtapi::RaytracingGeometryDesc> geometries;
  std::vector<GeometryShape> shapes;
  // With the addresses of the list after the header; empty if no geometry is linked.
  std::vector<std::shared_ptr<MicromapLinkage>> linkages;
  std::shared_ptr<const MicromapArray> micromaps;  // micromap array
  // EXPERIMENTAL: what operations made; clusters and templates have their linkage above, too. A
  // bottom level of clusters is their addresses, and a partitioned top level is not yet activated.
  std::shared_ptr<const Cluster> cluster;
  std::shared_ptr<const ClusterTemplate> cluster_template;
  std::vector<uint64_t> clusters;
  std::shared_ptr<PartitionedTopLevel> partitioned;
};

// `bytes` begin with the header, may be longer than the structure, are aligned to 8, and must
// outlive the result. Error KA0789: from another driver or version, truncated, or damaged; the
// message says where.
rtapi::Result<SerializedStructure> parse_serialized(std::span<const uint8_t> bytes);

// Writes the checksum that parse_serialized expects, so that tests can damage what it covers.
void seal_serialized(std::span<uint8_t> bytes);

// Writes what kVisualizationDecodeForTools gives. Addresses in the descs assume that `out` goes to
// `address`. `out` has decoded_size() bytes.
uint64_t decoded_size(const AccelerationStructure& structure);
void decode_for_tools(const AccelerationStructure& structure, uint64_t address,
                      std::span<uint8_t> out);

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
#include "runtime/operations/cluster_templates.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/operations/cluster_vertices.h"
#include "runtime/operations/vertex_conversion.h"

namespace kaamos::runtime {

using rtapi::HasAny;
using rtapi::RtasVertexFormat;

bool TemplateReader::read_box(uint64_t address, uint32_t index, ClusterTemplate& result) {
  if (address == 0) return true;
  const AddressMap& addresses = *environment_.context.addresses;
  if (address % rtapi::kRtasClusterTemplateByteAlignment != 0 ||
      !addresses.contains(address, 6 * sizeof(float))) {
    notes_.add_about(index, "InstantiationBoundingBoxLimit is " + at_address(addresses, address) +
                                "; it must be a multiple of 32 with 24 bytes; it is left out");
    return false;
  }
  const uint8_t* box = addresses.host(address);
  std::memcpy(result.lower, box, sizeof(result.lower));
  std::memcpy(result.upper, box + sizeof(result.lower), sizeof(result.upper));
  result.bounded = true;
  return true;
}

std::shared_ptr<ClusterTemplate> TemplateReader::read(const Args& args, uint32_t index) {
  auto result = std::make_shared<ClusterTemplate>();
  result->vertices = args.TrianglesArgs.VertexCount;
  result->format = inputs_.VertexInstantiationFormat;
  if (!triangles_.read_topology(args.TrianglesArgs, index, result->cluster)) return nullptr;
  if (result->format == RtasVertexFormat::kCompressed1) {
    result->compressed_header = args.Compressed1TemplateHeader;
    return result;
  }
  const uint32_t bits = args.TrianglesArgs.PositionTruncateBitCount;
  if (bits > 32) {
    notes_.add_about(index,
                     "PositionTruncateBitCount is " + std::to_string(bits) + "; it is taken as 32");
  }
  result->truncated_bits = std::min(bits, 32u);
  return read_box(args.InstantiationBoundingBoxLimit, index, *result) ? result : nullptr;
}

void TemplateInstantiator::note(uint32_t index, const std::string& what) {
  notes_.add_about(index, what);
}

std::shared_ptr<const ClusterTemplate> TemplateInstantiator::find(const Args& args,
                                                                  uint32_t index) {
  const auto structure = environment_.structures.find(args.ClusterTemplate);
  notes_.reads(args.ClusterTemplate, structure == nullptr ? 1 : structure->size_bytes, "template");
  if (structure == nullptr || structure->cluster_template == nullptr) {
    note(index, "there is no cluster template " +
                    at_address(*environment_.context.addresses, args.ClusterTemplate) +
                    "; it is left out");
    return nullptr;
  }
  const auto& found = structure->cluster_template;
  rtapi::RtasBuildClasFromTrianglesArgs counts;
  counts.TriangleCount = static_cast<uint16_t>(found->cluster.triangles());
  counts.VertexCount = static_cast<uint16_t>(found->vertices);
  triangles_.check_counts(counts, index);
  if (found->cluster.linkage != nullptr &&
      !HasAny(inputs_.Flags, rtapi::RtasOperationFlags::kAllowOmm)) {
    note(index, "its template has opacity micromaps, but the operation lacks kAllowOmm");
  }
  return found;
}

void TemplateInstantiator::offset_geometry(const Args& args, uint32_t index, Cluster& cluster) {
  if (args.GeometryIndexOffset == 0) return;
  const uint32_t most = inputs_.Limits.MaxGeometryIndexValue;
  bool beyond = false;
  for (uint32_t& pair : cluster.geometry) {
    const uint32_t stored = pair & rtapi::kRtasMaximumGeometryIndex;
    const int64_t moved = int64_t{stored} + args.GeometryIndexOffset;
    if ((moved < 0 || moved > most) && !beyond) {
      note(index, "a geometry index is " + std::to_string(moved) + "; it must be 0 to " +
                      std::to_string(most));
      beyond = true;
    }
    pair = (pair & ~rtapi::kRtasMaximumGeometryIndex) |
           (static_cast<uint32_t>(moved) & rtapi::kRtasMaximumGeometryIndex);
  }
}

bool TemplateInstantiator::read_positions(const ClusterTemplate& from, const Args& args,
                                          uint32_t index, Cluster& cluster) {
  const AddressMap& addresses = *environment_.context.addresses;
  const bool compressed = inputs_.VertexSourceFormat == RtasVertexFormat::kCompressed1;
  const uint32_t last = *std::max_element(cluster.indices.begin(), cluster.indices.end());
  VertexSource source = {inputs_.VertexSourceFormat, args.VertexBuffer.StartAddress,
                         args.VertexBuffer.StrideInBytes, from.vertices, 0};
  if (!compressed) {
    source.count = std::max(source.count, std::min(last + 1, rtapi::kRtasMaxClusterElements));
  }
  std::string why;
  cluster.xyz = decode_vertices(addresses, source, why);
  if (!why.empty()) {
    note(index, why + "; it is left out");
    return false;
  }
  notes_.reads(source.address, 1, "vertices");
  const uint32_t inside = compressed ? source.count : vertices_inside(addresses, source);
  cluster.xyz.resize(3 * size_t{inside});
  if (inside < from.vertices) {
    note(index, std::to_string(from.vertices) + " vertices " +
                    at_address(addresses, source.address) +
                    " end after their buffer; triangles with those beyond are never hit");
  }
  const bool kept =
      compressed && from.format == RtasVertexFormat::kCompressed1 &&
      fits_template(read_compressed_header(addresses.host(source.address)), from.compressed_header);
  if (!kept && !convert_vertices(from.format, from.compressed_header, cluster.xyz)) {
    note(index, "positions do not fit the template's header; they are clamped");
  }
  if (from.format != RtasVertexFormat::kCompressed1) {
    truncate_vertices(cluster.xyz, from.truncated_bits);
  }
  cluster.xyz.resize(3 * size_t{std::max(source.count, last + 1)},
                     std::numeric_limits<float>::quiet_NaN());
  return true;
}

void TemplateInstantiator::check_box(const ClusterTemplate& from, uint32_t index,
                                     const Cluster& cluster) {
  if (!from.bounded) return;
  for (size_t i = 0; i < 3 * size_t{from.vertices}; ++i) {
    if (cluster.xyz[i] < from.lower[i % 3] || cluster.xyz[i] > from.upper[i % 3]) {
      return note(index, "vertex " + std::to_string(i / 3) +
                             " is outside of the template's InstantiationBoundingBoxLimit");
    }
  }
}

std::shared_ptr<Cluster> TemplateInstantiator::make(const ClusterTemplate& from, const Args& args,
                                                    uint32_t index) {
  auto cluster = std::make_shared<Cluster>(from.cluster);
  cluster->id += args.ClusterIdOffset;
  // Its own, since a micromap array may come to its address at another time.
  if (cluster->linkage != nullptr) {
    cluster->linkage = std::make_shared<MicromapLinkage>(*cluster->linkage);
  }
  offset_geometry(args, index, *cluster);
  if (cluster->triangles() == 0) return cluster;
  if (!read_positions(from, args, index, *cluster)) return nullptr;
  check_box(from, index, *cluster);
  return cluster;
}

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
#include "runtime/operations/cluster_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/operations/batch.h"
#include "runtime/operations/cluster_vertices.h"
#include "runtime/structures/micromap_inputs.h"

namespace kaamos::runtime {

using rtapi::HasAny;
using rtapi::RtasIndexFormat;
using rtapi::RtasVertexFormat;

namespace {

constexpr uint32_t kMost = rtapi::kRtasMaxClusterElements;
constexpr uint32_t kGeometryMask = rtapi::kRtasMaximumGeometryIndex;
constexpr uint32_t kFlagsMask =
    rtapi::kRtasClusteredGeometryOpaque | rtapi::kRtasClusteredGeometryNoDuplicateAnyHitInvocation;

uint32_t bytes_of(RtasIndexFormat format) {
  return static_cast<uint32_t>(format);
}

uint32_t load_index(const ArrayInMemory& array, uint64_t i, uint32_t bytes) {
  uint32_t value = 0;
  std::memcpy(&value, array.at(i), bytes);
  return value;
}

std::string text(uint64_t value) {
  return std::to_string(value);
}

}  // namespace

void TriangleReader::note(uint32_t index, const std::string& what) {
  notes_.add_about(index, what);
}

bool TriangleReader::leave_out(uint32_t index, const std::string& why) {
  note(index, why + "; it is left out");
  return false;
}

bool TriangleReader::check_counts(const Args& args, uint32_t index) {
  if (args.TriangleCount > kMost || args.VertexCount > kMost) {
    return leave_out(index, "TriangleCount is " + text(args.TriangleCount) + " and VertexCount " +
                                text(args.VertexCount) + ", but a cluster has at most 256");
  }
  const auto check = [&](const char* what, uint64_t count, const char* limit, uint64_t most) {
    if (count > most) {
      note(index,
           std::string(what) + " is " + text(count) + ", but " + limit + " is " + text(most));
    }
  };
  check("TriangleCount", args.TriangleCount, "MaxTriangleCountPerCluster",
        inputs_.limits.MaxTriangleCountPerCluster);
  check("VertexCount", args.VertexCount, "MaxVertexCountPerCluster",
        inputs_.limits.MaxVertexCountPerCluster);
  total_triangles_ += args.TriangleCount;
  total_vertices_ += args.VertexCount;
  const bool beyond = total_triangles_ > inputs_.limits.MaxTotalTriangleCount ||
                      total_vertices_ > inputs_.limits.MaxTotalVertexCount;
  if (beyond && !beyond_totals_) {
    note(index, "there are now " + text(total_triangles_) + " triangles and " +
                    text(total_vertices_) + " vertices, but MaxTotalTriangleCount is " +
                    text(inputs_.limits.MaxTotalTriangleCount) + " and MaxTotalVertexCount " +
                    text(inputs_.limits.MaxTotalVertexCount));
  }
  beyond_totals_ |= beyond;
  return true;
}

bool TriangleReader::read_indices(const Args& args, uint32_t index, Cluster& cluster) {
  const uint32_t bytes = bytes_of(inputs_.index_format);
  const uint64_t stride = args.IndexBufferStride == 0 ? bytes : args.IndexBufferStride;
  if (stride > 4) return leave_out(index, "IndexBufferStride is " + text(stride) + ", more than 4");
  std::string why;
  const uint64_t count = 3 * uint64_t{args.TriangleCount};
  const ArrayInMemory in = find_array(*environment_.context.addresses, args.IndexBuffer, stride,
                                      count, bytes, bytes, why);
  if (in.first == nullptr) return leave_out(index, "the indices " + why);
  notes_.reads(args.IndexBuffer, in.bytes(count, bytes), "indices");
  bool beyond = false;
  for (uint64_t i = 0; i < count; ++i) {
    const uint32_t vertex = load_index(in, i, bytes);
    if (vertex >= args.VertexCount && !beyond) {
      note(index, "triangle " + text(i / 3) + " has index " + text(vertex) +
                      ", but VertexCount is " + text(args.VertexCount));
      beyond = true;
    }
    // One past the last vertex that a cluster may have: a position that is NaN.
    cluster.indices.push_back(static_cast<uint16_t>(std::min(vertex, kMost)));
  }
  return true;
}

bool TriangleReader::read_geometry(const Args& args, uint32_t index, Cluster& cluster) {
  const uint32_t base = args.BaseGeometryIndexAndFlags;
  cluster.geometry.assign(args.TriangleCount, base & (kGeometryMask | kFlagsMask));
  if (args.GeometryIndexAndFlagsArray == 0) return true;
  const AddressMap& addresses = *environment_.context.addresses;
  const uint32_t bytes = bytes_of(inputs_.geometry_index_format);
  const bool indexed = bytes != 0 && args.GeometryIndexAndFlagsIndexBuffer != 0;
  std::string why;
  ArrayInMemory indices;
  if (indexed) {
    indices = find_array(addresses, args.GeometryIndexAndFlagsIndexBuffer, 0, args.TriangleCount,
                         bytes, bytes, why);
    if (indices.first == nullptr) return leave_out(index, "the indices of geometries " + why);
  }
  uint64_t count = args.TriangleCount;
  if (indexed) {
    count = 0;
    for (uint32_t i = 0; i < args.TriangleCount; ++i) {
      count = std::max<uint64_t>(count, uint64_t{load_index(indices, i, bytes)} + 1);
    }
  }
  const ArrayInMemory in = find_array(addresses, args.GeometryIndexAndFlagsArray,
                                      args.GeometryIndexAndFlagsArrayStride, count, 4, 4, why);
  if (in.first == nullptr) return leave_out(index, "GeometryIndexAndFlagsArray " + why);
  notes_.reads(args.GeometryIndexAndFlagsArray, in.bytes(count, 4), "geometry indices");
  for (uint32_t i = 0; i < args.TriangleCount; ++i) {
    const auto entry = load_element<uint32_t>(in, indexed ? load_index(indices, i, bytes) : i);
    const uint32_t sum = (base & kGeometryMask) + (entry & kGeometryMask);
    if (sum > kGeometryMask) {
      note(index, "triangle " + text(i) + " has geometry index " + text(sum) +
                      "; only the low 24 bits count");
    }
    cluster.geometry[i] = (sum & kGeometryMask) | ((base | entry) & kFlagsMask);
  }
  return true;
}

void TriangleReader::check_geometry(uint32_t index, const Cluster& cluster) {
  const std::set<uint32_t> pairs(cluster.geometry.begin(), cluster.geometry.end());
  const uint32_t most = std::max(1u, inputs_.limits.MaxUniqueGeometryIndexAndFlagsCountPerCluster);
  if (pairs.size() > most) {
    note(index, "there are " + text(pairs.size()) +
                    " pairs of geometry index and flags, but "
                    "MaxUniqueGeometryIndexAndFlagsCountPerCluster is " +
                    text(most));
  }
  uint32_t largest = 0;
  for (const uint32_t pair : pairs) largest = std::max(largest, pair & kGeometryMask);
  if (largest > inputs_.limits.MaxGeometryIndexValue) {
    note(index, "a geometry index is " + text(largest) + ", but MaxGeometryIndexValue is " +
                    text(inputs_.limits.MaxGeometryIndexValue));
  }
}

bool TriangleReader::read_micromaps(const Args& args, uint32_t index, Cluster& cluster) {
  const uint32_t bytes = bytes_of(inputs_.micromap_index_format);
  const bool indexed = bytes != 0 && args.OpacityMicromapIndexBuffer != 0;
  if (args.OpacityMicromapArray == 0 && !indexed) return true;
  if (!HasAny(inputs_.flags, rtapi::RtasOperationFlags::kAllowOmm)) {
    note(index, "it has opacity micromaps, but the operation lacks kAllowOmm");
  }
  if (!environment_.has_micromaps) {
    note(index, std::string("its opacity micromaps are ignored, which ") +
                    environment_.backend_name + " does not have here");
    return true;
  }
  if (args.TriangleCount > inputs_.limits.MaxOpacityMicromapIndicesPerCluster) {
    note(index, "it has " + text(args.TriangleCount) +
                    " micromap indices, but MaxOpacityMicromapIndicesPerCluster is " +
                    text(inputs_.limits.MaxOpacityMicromapIndicesPerCluster));
  }
  ArrayInMemory in;
  if (indexed) {
    std::string why;
    in = find_array(*environment_.context.addresses, args.OpacityMicromapIndexBuffer,
                    args.OpacityMicromapIndexBufferStride, args.TriangleCount, bytes, bytes, why);
    if (in.first == nullptr) return leave_out(index, "the micromap indices " + why);
    notes_.reads(args.OpacityMicromapIndexBuffer, in.bytes(args.TriangleCount, bytes),
                 "micromap indices");
  }
  auto linkage = std::make_shared<MicromapLinkage>();
  linkage->address = args.OpacityMicromapArray;
  for (uint32_t i = 0; i < args.TriangleCount; ++i) {
    const int64_t value = indexed ? load_micromap_index(in.at(i), bytes) : int64_t{i};
    const int64_t based = value < 0 ? value : value + args.OpacityMicromapBaseLocation;
    linkage->indices.push_back(
        static_cast<int32_t>(std::min<int64_t>(based, std::numeric_limits<int32_t>::max())));
  }
  cluster.linkage = std::move(linkage);
  return true;
}

bool TriangleReader::read_topology(const Args& args, uint32_t index, Cluster& cluster) {
  using Flags = rtapi::RtasClusterFlags;
  cluster.id = args.ClusterID;
  cluster.data_access = HasAny(inputs_.flags, rtapi::RtasOperationFlags::kAllowDataAccess) &&
                        !HasAny(args.ClusterFlags, Flags::kDisallowDataAccess);
  cluster.allows_disable_omms = HasAny(args.ClusterFlags, Flags::kAllowDisableOmms);
  if (static_cast<uint32_t>(args.ClusterFlags) > 3) {
    note(index, "ClusterFlags are " + text(static_cast<uint32_t>(args.ClusterFlags)) +
                    "; only the bits of 0x3 are defined");
  }
  if (args.TriangleCount == 0 || args.VertexCount == 0) return true;
  if (!read_indices(args, index, cluster) || !read_geometry(args, index, cluster) ||
      !read_micromaps(args, index, cluster)) {
    return false;
  }
  check_geometry(index, cluster);
  return true;
}

bool TriangleReader::read_positions(const Args& args, uint32_t index,
                                    const rtapi::RtasClusterTrianglesInputsDesc& inputs,
                                    Cluster& cluster) {
  if (cluster.triangles() == 0) return true;
  const bool compressed = inputs.VertexFormat == RtasVertexFormat::kCompressed1;
  if (!compressed && args.PositionTruncateBitCount > 32) {
    note(index, "PositionTruncateBitCount is " + text(args.PositionTruncateBitCount) +
                    "; it is taken as 32");
  }
  if (!compressed && args.PositionTruncateBitCount < inputs.MinPositionTruncateBitCount) {
    note(index, "PositionTruncateBitCount is " + text(args.PositionTruncateBitCount) +
                    ", but MinPositionTruncateBitCount is " +
                    text(inputs.MinPositionTruncateBitCount));
  }
  const uint32_t last = *std::max_element(cluster.indices.begin(), cluster.indices.end());
  VertexSource source = {inputs.VertexFormat, args.VertexBuffer, args.VertexBufferStride,
                         args.VertexCount, std::min<uint32_t>(args.PositionTruncateBitCount, 32)};
  // A block has no vertices but those that were counted.
  if (!compressed) source.count = std::max(source.count, std::min(last + 1, kMost));
  std::string why;
  cluster.xyz = decode_vertices(*environment_.context.addresses, source, why);
  if (!why.empty()) return leave_out(index, why);
  notes_.reads(args.VertexBuffer, 1, "vertices");
  cluster.xyz.resize(3 * size_t{std::max(source.count, last + 1)},
                     std::numeric_limits<float>::quiet_NaN());
  if (!compressed && vertices_inside(*environment_.context.addresses, source) < args.VertexCount) {
    note(index, text(args.VertexCount) + " vertices " +
                    at_address(*environment_.context.addresses, source.address) +
                    " end after their buffer; triangles with those beyond are never hit");
  }
  if (compressed) {
    const CompressedHeader header =
        read_compressed_header(environment_.context.addresses->host(source.address));
    const uint64_t block = header.bytes(args.VertexCount);
    if (block > inputs.MaxCompressedClusterPositionsSize) {
      note(index, "the block of positions takes " + text(block) +
                      " bytes, but MaxCompressedClusterPositionsSize is " +
                      text(inputs.MaxCompressedClusterPositionsSize));
    }
    if (header.exponent == 0 || header.exponent > 232) {
      note(index, "the exponent of the block of positions is " + text(header.exponent) +
                      "; it must be 1 to 232");
    }
  }
  return true;
}

}  // namespace kaamos::runtime

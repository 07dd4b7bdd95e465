// SPDX-License-Identifier: MIT
#include "runtime/operations/cluster_level.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_set>
#include <utility>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/operations/batch.h"

namespace kaamos::runtime {

using rtapi::HasAny;
using rtapi::RaytracingGeometryFlags;

namespace {

// GeometryIndex and flags; whether there are micromaps, and where.
using GeometryKey = std::tuple<uint32_t, bool, uint64_t, const MicromapArray*>;

RaytracingGeometryFlags flags_of(uint32_t pair) {
  auto flags = RaytracingGeometryFlags::kNone;
  if ((pair & rtapi::kRtasClusteredGeometryOpaque) != 0) flags |= RaytracingGeometryFlags::kOpaque;
  if ((pair & rtapi::kRtasClusteredGeometryNoDuplicateAnyHitInvocation) != 0) {
    flags |= RaytracingGeometryFlags::kNoDuplicateAnyHitInvocation;
  }
  return flags;
}

ClusteredGeometry& geometry_of(std::map<GeometryKey, ClusteredGeometry>& geometries,
                               const Cluster& cluster, uint32_t pair) {
  const MicromapLinkage* linkage = cluster.linkage.get();
  const bool linked = linkage != nullptr;
  const auto [it, is_new] = geometries.try_emplace(GeometryKey{
      pair, linked, linked ? linkage->address : 0, linked ? linkage->array.get() : nullptr});
  ClusteredGeometry& geometry = it->second;
  if (!is_new) return geometry;
  geometry.geometry_index = pair & rtapi::kRtasMaximumGeometryIndex;
  geometry.flags = flags_of(pair);
  if (!linked) return geometry;
  geometry.linkage = std::make_shared<MicromapLinkage>();
  geometry.linkage->address = linkage->address;
  geometry.linkage->array = linkage->array;
  return geometry;
}

}  // namespace

std::vector<ClusteredGeometry> geometries_of(const Clusters& clusters) {
  std::map<GeometryKey, ClusteredGeometry> geometries;
  for (const auto& cluster : clusters) {
    std::map<const ClusteredGeometry*, uint32_t> first_vertex;
    for (uint32_t i = 0; i < cluster->triangles(); ++i) {
      ClusteredGeometry& geometry = geometry_of(geometries, *cluster, cluster->geometry[i]);
      const auto [first, is_new] =
          first_vertex.try_emplace(&geometry, static_cast<uint32_t>(geometry.xyz.size() / 3));
      if (is_new) {
        geometry.xyz.insert(geometry.xyz.end(), cluster->xyz.begin(), cluster->xyz.end());
      }
      for (int corner = 0; corner < 3; ++corner) {
        geometry.indices.push_back(first->second + cluster->indices[3 * i + corner]);
      }
      geometry.primitive_index.push_back(i);
      geometry.cluster_id.push_back(cluster->id);
      if (geometry.linkage != nullptr) {
        geometry.linkage->indices.push_back(cluster->linkage->indices[i]);
      }
    }
  }
  std::vector<ClusteredGeometry> result;
  for (auto& [key, geometry] : geometries) result.push_back(std::move(geometry));
  return result;
}

void ClusterLevelBuilder::note(uint32_t index, const std::string& what) {
  notes_.add_about(index, what);
}

bool ClusterLevelBuilder::leave_out(uint32_t index, const std::string& why) {
  note(index, why + "; it is left out");
  return false;
}

bool ClusterLevelBuilder::check_counts(const Args& args, uint32_t index) {
  if (args.ClasAddressCount > inputs_.MaxClasCountPerArg) {
    note(index, "ClasAddressCount is " + std::to_string(args.ClasAddressCount) +
                    ", but MaxClasCountPerArg is " + std::to_string(inputs_.MaxClasCountPerArg));
  }
  total_ += args.ClasAddressCount;
  if (total_ > inputs_.MaxTotalClasCount && !std::exchange(beyond_total_, true)) {
    note(index, "there are now " + std::to_string(total_) + " clusters, but MaxTotalClasCount is " +
                    std::to_string(inputs_.MaxTotalClasCount));
  }
  return true;
}

bool ClusterLevelBuilder::read(const Args& args, uint32_t index, Clusters& clusters,
                               std::vector<uint64_t>& at) {
  const AddressMap& addresses = *environment_.context.addresses;
  std::string why;
  const ArrayInMemory in = find_array(addresses, args.ClasAddressArray, args.ClasAddressStride,
                                      args.ClasAddressCount, 8, 8, why);
  if (in.first == nullptr && args.ClasAddressCount != 0) {
    return leave_out(index, "the addresses of clusters " + why);
  }
  notes_.reads(args.ClasAddressArray, in.bytes(args.ClasAddressCount, 8), "cluster addresses");
  std::unordered_set<uint64_t> seen;
  for (uint32_t i = 0; i < args.ClasAddressCount; ++i) {
    const auto address = load_element<uint64_t>(in, i);
    if (address == 0) continue;
    const auto structure = environment_.structures.find(address);
    if (structure == nullptr || structure->cluster == nullptr) {
      note(index, "there is no cluster " + at_address(addresses, address) +
                      ", so the bottom level goes without it");
    } else if (!seen.insert(address).second) {
      note(index,
           "the cluster " + at_address(addresses, address) + " is named twice; it counts once");
    } else {
      notes_.reads(address, structure->size_bytes, "cluster");
      clusters.push_back(structure->cluster);
      at.push_back(address);
    }
  }
  check_clusters(clusters, index);
  return true;
}

void ClusterLevelBuilder::check_clusters(const Clusters& clusters, uint32_t index) {
  const auto any = [&](auto property) {
    return std::any_of(clusters.begin(), clusters.end(),
                       [&](const auto& cluster) { return property(*cluster); });
  };
  if (any([](const Cluster& c) { return c.data_access; }) &&
      any([](const Cluster& c) { return !c.data_access; })) {
    note(index,
         "some of its clusters allow data access and others do not; shaders may not read "
         "positions");
  }
  if (any([](const Cluster& c) { return c.linkage != nullptr; }) &&
      !HasAny(inputs_.Flags, rtapi::RtasOperationFlags::kAllowOmm)) {
    note(index, "its clusters have opacity micromaps, but the operation lacks kAllowOmm");
  }
}

rtapi::Result<bool> ClusterLevelBuilder::build(const Clusters& clusters, uint32_t index,
                                               const RebuildLevel& build,
                                               AccelerationStructure& result) {
  using Flags = rtapi::RtasOperationFlags;
  const auto all = [&](auto property) {
    return std::all_of(clusters.begin(), clusters.end(),
                       [&](const auto& cluster) { return property(*cluster); });
  };
  result.flags = BuildFlags::kNone;
  if (HasAny(inputs_.Flags, Flags::kFastTrace)) result.flags |= BuildFlags::kPreferFastTrace;
  if (HasAny(inputs_.Flags, Flags::kFastOperation)) result.flags |= BuildFlags::kPreferFastBuild;
  if (all([](const Cluster& c) { return c.data_access; })) {
    result.flags |= BuildFlags::kAllowDataAccess;
  }
  if (all([](const Cluster& c) { return c.linkage == nullptr || c.allows_disable_omms; })) {
    result.flags |= BuildFlags::kAllowDisableOmms;
  }
  auto geometries = geometries_of(clusters);
  bool linked = false;
  for (const auto& geometry : geometries) linked |= geometry.linkage != nullptr;
  if (linked) {
    for (const auto& geometry : geometries) result.linkages.push_back(geometry.linkage);
  }
  result.of_clusters = true;
  const auto status = build.clustered_level(std::move(geometries), result);
  if (status.ok()) return true;
  if (status.error().id != errors::public_id(Id::kTooManyElements)) return status.error();
  return leave_out(index, status.error().message);
}

}  // namespace kaamos::runtime

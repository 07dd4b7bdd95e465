// SPDX-License-Identifier: MIT
#include "runtime/structures/clustered_level.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

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

Clusters find_clusters(const StructureMap& structures, std::span<const uint64_t> addresses,
                       uint32_t& missing) {
  Clusters found;
  missing = 0;
  for (const uint64_t address : addresses) {
    if (address == 0) continue;
    const auto structure = structures.find(address);
    if (structure != nullptr && structure->cluster != nullptr) {
      found.push_back(structure->cluster);
    } else {
      ++missing;
    }
  }
  return found;
}

rtapi::Status build_clustered_level(const Clusters& clusters, const RebuildLevel& rebuild,
                                    AccelerationStructure& result) {
  const auto all = [&](auto property) {
    return std::all_of(clusters.begin(), clusters.end(),
                       [&](const auto& cluster) { return property(*cluster); });
  };
  result.flags = result.flags & (BuildFlags::kPreferFastTrace | BuildFlags::kPreferFastBuild);
  if (all([](const Cluster& c) { return c.data_access; })) {
    result.flags |= BuildFlags::kAllowDataAccess;
  }
  if (all([](const Cluster& c) { return c.linkage == nullptr || c.allows_disable_omms; })) {
    result.flags |= BuildFlags::kAllowDisableOmms;
  }
  auto geometries = geometries_of(clusters);
  const bool linked = std::any_of(geometries.begin(), geometries.end(),
                                  [](const auto& each) { return each.linkage != nullptr; });
  result.linkages.clear();
  if (linked) {
    for (const auto& geometry : geometries) result.linkages.push_back(geometry.linkage);
  }
  result.of_clusters = true;
  return rebuild.clustered_level(std::move(geometries), result);
}

}  // namespace kaamos::runtime

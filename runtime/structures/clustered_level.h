// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Bottom levels of clusters: from the clusters to what a backend builds.
// [DXR 2.0: Cluster BLAS]
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <rtapi/result.h>

#include "runtime/structures/cluster.h"
#include "runtime/structures/clustered_geometry.h"
#include "runtime/structures/structure_copies.h"
#include "runtime/structures/structure_map.h"

namespace kaamos::runtime {

using Clusters = std::vector<std::shared_ptr<const Cluster>>;

// By geometry index and flags, in an order that only depends on the clusters.
std::vector<ClusteredGeometry> geometries_of(const Clusters& clusters);

// The clusters that are at the addresses; `missing`: how many are not.
Clusters find_clusters(const StructureMap& structures, std::span<const uint64_t> addresses,
                       uint32_t& missing);

// Sets all of `result` but its place and `clusters`. Of result.flags, the hints must be set; what
// all clusters allow is added. Errors: the backend's.
rtapi::Status build_clustered_level(const Clusters& clusters, const RebuildLevel& rebuild,
                                    AccelerationStructure& result);

}  // namespace kaamos::runtime

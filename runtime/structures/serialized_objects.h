// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. The serialized and decoded forms of what indirect operations make: clusters,
// templates, bottom levels of clusters, which are no more than their clusters' addresses, and
// partitioned top levels. [DXR 2.0: Clustered geometry, Partitioned TLAS]
#pragma once

#include <cstdint>
#include <vector>

#include <rtapi/result.h>

#include "runtime/structures/serialized_frame.h"
#include "runtime/structures/serialized_structure.h"
#include "runtime/structures/structure_map.h"

namespace kaamos::runtime {

inline bool is_object(const AccelerationStructure& structure) {
  return structure.is_cluster_object() || structure.partitioned != nullptr;
}
inline bool is_object(rtapi::RaytracingAccelerationStructureType type) {
  using Type = rtapi::RaytracingAccelerationStructureType;
  return type >= Type::kClusterLevel && type <= Type::kPartitionedTopLevel;
}

SerializedFrame frame_of_object(const AccelerationStructure& structure);
void put_object(const AccelerationStructure& structure, SerializedWriter& writer);
// Errors: KA0789.
rtapi::Status get_object(const SerializedFrame& frame, SerializedReader& reader,
                         SerializedStructure& result);

// What kVisualizationDecodeForTools gives for `address`: the arguments that make the same.
std::vector<uint8_t> decoded_object(const AccelerationStructure& structure, uint64_t address);

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
#include "runtime/structures/triangle_positions.h"

namespace kaamos::runtime {

std::vector<shader::GeometryPositions> positions_of(const BottomLevelBase& level,
                                                    BuildFlags flags) {
  const auto count = static_cast<uint32_t>(level.geometry_shapes().size());
  std::vector<shader::GeometryPositions> result(count);
  for (uint32_t i = 0; i < count; ++i) {
    const GeometryContents contents = level.geometry_contents(i);
    result[i].clustered = level.cluster_triangles(i);
    if (contents.xyz.empty()) continue;
    result[i].xyz = contents.xyz.data();
    result[i].indices = contents.indices.empty() ? nullptr : contents.indices.data();
    result[i].is_readable = rtapi::HasAny(flags, BuildFlags::kAllowDataAccess);
  }
  return result;
}

}  // namespace kaamos::runtime

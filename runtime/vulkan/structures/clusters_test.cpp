// SPDX-License-Identifier: MIT
//
// Bottom levels of clusters as the driver gets them. What rays meet is in the conformance tests.
#include <gtest/gtest.h>

#include <cstring>

#include <kaamos/shader/spirv_interface.h>

#include "runtime/vulkan/structures/bottom_level.h"
#include "runtime/vulkan/testing/scene_harness.h"

namespace kaamos::vulkan {
namespace {

using rtapi::RaytracingGeometryFlags;
using runtime::ClusteredGeometry;

// Triangles at these z, which are numbers 10, 11, ... of their cluster.
ClusteredGeometry geometry_at(uint32_t index, RaytracingGeometryFlags flags,
                              const std::vector<float>& zs, uint32_t cluster) {
  ClusteredGeometry result;
  result.geometry_index = index;
  result.flags = flags;
  for (const float z : zs) {
    const auto input = testing::triangle_at(z);
    const auto first = static_cast<uint32_t>(result.xyz.size() / 3);
    result.xyz.insert(result.xyz.end(), input.xyz.begin(), input.xyz.end());
    for (uint32_t corner = 0; corner < 3; ++corner) result.indices.push_back(first + corner);
    result.primitive_index.push_back(static_cast<uint32_t>(9 + result.indices.size() / 3));
    result.cluster_id.push_back(cluster);
  }
  return result;
}

const uint32_t* words_at(uint64_t address) {  // lavapipe's addresses are the host's
  return reinterpret_cast<const uint32_t*>(address);
}

TEST(VulkanClusters, FlagsMakePartsWithTheApplicationsGeometryIndices) {
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->is_lavapipe()) GTEST_SKIP() << "reads device memory";
  const std::vector<ClusteredGeometry> geometries = {
      geometry_at(3, RaytracingGeometryFlags::kOpaque, {1, 2}, 70),
      geometry_at(3, RaytracingGeometryFlags::kNone, {3}, 71),
      geometry_at(0, RaytracingGeometryFlags::kOpaque, {4}, 72)};
  const auto built =
      BottomLevel::build_clustered(gpu, geometries, runtime::BuildFlags::kAllowDataAccess);
  ASSERT_TRUE(built.ok());
  const BottomLevel& level = **built;
  ASSERT_EQ(level.parts().size(), 2u);
  EXPECT_EQ(level.object_bounds().lower[2], 1);
  EXPECT_EQ(level.object_bounds().upper[2], 4);
  EXPECT_EQ(level.geometry_shapes()[1].index, 3u);
  EXPECT_FALSE(level.geometry_shapes()[1].opaque);
  EXPECT_EQ(level.cluster_triangles(0)[1].primitive_index, 11u);
  EXPECT_EQ(level.geometry_contents(1).xyz.size(), 9u);
  for (const auto& part : level.parts()) {
    ASSERT_EQ(part->shapes().size(), 4u);  // a hit record for each, though 1 and 2 are empty
    const uint64_t table = part->position_table();
    EXPECT_EQ(table & 7, shader::spirv::kClusterTable);
    const uint32_t* words = words_at(table & ~uint64_t{7});
    const uint32_t* numbers = words_at(part->primitive_remap());
    const bool opaque = part->shapes()[3].opaque;
    ASSERT_EQ(numbers[3] + (opaque ? 2u : 1u), opaque ? 7u : 5u);
    for (uint32_t id = 0; id < (opaque ? 2u : 1u); ++id) {
      const uint32_t* triangle = words + words[3] + 10 * id;
      EXPECT_EQ(reinterpret_cast<uintptr_t>(triangle) % 8, 0u);
      EXPECT_EQ(triangle[0], opaque ? 70u : 71u);
      float z;
      std::memcpy(&z, triangle + 3, sizeof(z));
      const uint32_t number = words_at(part->primitive_remap())[numbers[3] + id];
      EXPECT_EQ(z, opaque ? static_cast<float>(number - 9) : 3.0f);
    }
    if (opaque) {
      EXPECT_EQ(words[words[0]], 72u);
    }
  }
}

TEST(VulkanClusters, WithoutDataAccessOnlyIdsAreKept) {
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->is_lavapipe()) GTEST_SKIP() << "reads device memory";
  const auto built = BottomLevel::build_clustered(
      gpu, {geometry_at(0, RaytracingGeometryFlags::kOpaque, {1, 2}, 5)},
      runtime::BuildFlags::kNone);
  ASSERT_TRUE(built.ok());
  const uint64_t table = (*built)->parts()[0]->position_table();
  EXPECT_EQ(table & 7, shader::spirv::kClusterTable | shader::spirv::kPositionsNotKept);
  const uint32_t* words = words_at(table & ~uint64_t{7});
  EXPECT_EQ(words[words[0]], 5u);
  EXPECT_EQ(words[words[0] + 2], 5u);
  EXPECT_EQ(words[0] % 2, 0u);
}

TEST(VulkanClusters, NothingAndTooMuch) {
  KAAMOS_NEED_GPU(gpu);
  const auto empty = BottomLevel::build_clustered(gpu, {}, runtime::BuildFlags::kNone);
  ASSERT_TRUE(empty.ok());
  EXPECT_TRUE((*empty)->empty());
  const auto far = BottomLevel::build_clustered(
      gpu, {geometry_at(0x10000, RaytracingGeometryFlags::kOpaque, {1}, 5)},
      runtime::BuildFlags::kNone);
  ASSERT_FALSE(far.ok());
  EXPECT_NE(far.error().message.find("geometry index 65536"), std::string::npos);
}

}  // namespace
}  // namespace kaamos::vulkan

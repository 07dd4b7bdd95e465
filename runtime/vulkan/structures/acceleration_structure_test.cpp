// SPDX-License-Identifier: MIT
#include "runtime/vulkan/structures/acceleration_structure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "runtime/structures/serialized_structure.h"
#include "runtime/vulkan/testing/ray_caster.h"

namespace kaamos::vulkan {
namespace {

using testing::append;
using testing::box_at;
using testing::GeometryInput;
using testing::instance_of;
using testing::RayCaster;
using testing::SceneHarness;
using testing::triangle_at;
using Flags = runtime::BuildFlags;
using InfoType = rtapi::RaytracingAccelerationStructurePostbuildInfoType;
using CopyMode = rtapi::RaytracingAccelerationStructureCopyMode;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// While it exists, new devices have these workarounds switched off.
class Without {
 public:
  explicit Without(const char* names) { setenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS", names, 1); }
  ~Without() { unsetenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS"); }
};

TEST(VulkanScene, EachPrimitiveIsFoundUnderItsNumber) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  RayCaster caster(h);
  // Three geometries, the middle one empty, with triangles in a row along x, in shuffled order.
  std::vector<uint32_t> order(100);
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  GeometryInput first;
  GeometryInput third;
  for (const uint32_t place : order) {
    append(first, triangle_at(5, 4 * static_cast<float>(place)));
    append(third, triangle_at(9, 4 * static_cast<float>(place) + 2));
  }
  GeometryInput empty;
  auto instance = instance_of(h.bottom_level({first, empty, third}));
  instance.InstanceID = 0xABCDEF;
  const uint64_t scene = h.top_level({instance_of(0), instance});
  for (uint32_t i = 0; i < order.size(); ++i) {
    const float x = 4 * static_cast<float>(order[i]);
    const auto hit = caster.cast_along_z(scene, x);
    EXPECT_NEAR(hit.t, 5, 1e-4);
    EXPECT_EQ(hit.instance, 1u);
    EXPECT_EQ(hit.instance_id, 0xABCDEFu);
    EXPECT_EQ(hit.geometry, 0u);
    EXPECT_EQ(hit.primitive, i);
    EXPECT_EQ(hit.kind, 0xFEu);
    const auto behind = caster.cast_along_z(scene, x + 2);
    EXPECT_NEAR(behind.t, 9, 1e-4);
    EXPECT_EQ(behind.geometry, 2u);
    EXPECT_EQ(behind.primitive, i);
  }
  EXPECT_EQ(caster.cast_along_z(scene, 1000).t, -1);
  EXPECT_EQ(caster.cast_along_z(0xDEAD00).t, -1);
  EXPECT_EQ(h.structures().tables()->max_hit_record, 15u + 2 * 15);
}

TEST(VulkanScene, IndicesAndTransforms) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  RayCaster caster(h);
  GeometryInput input = triangle_at(3);
  append(input, triangle_at(5, 10));
  input.indices = {0, 1, 99, 3, 4, 5, 0, 1, 2, 1, 1, 2};
  input.transform = {1, 0, 0, 100, 0, 1, 0, 0, 0, 0, 1, 1};
  const uint64_t scene = h.top_level({instance_of(h.bottom_level({input}))});
  EXPECT_EQ(caster.cast_along_z(scene, 100).primitive, 2u);
  EXPECT_NEAR(caster.cast_along_z(scene, 100).t, 4, 1e-4);
  EXPECT_EQ(caster.cast_along_z(scene, 110).primitive, 1u);
  ASSERT_EQ(h.messages.size(), 1u);
  EXPECT_EQ(h.messages[0].Id.text(), "KA0798");
}

// Triangles at 4 * i, one of which has a NaN or another odd number in a corner.
GeometryInput row_with(uint32_t count, uint32_t odd, float value, int component) {
  GeometryInput input;
  for (uint32_t i = 0; i < count; ++i) append(input, triangle_at(5, 4 * static_cast<float>(i)));
  input.xyz[9 * size_t{odd} + component] = value;
  return input;
}

uint32_t hits_of_row(RayCaster& caster, uint64_t scene, uint32_t count) {
  uint32_t hits = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const auto hit = caster.cast_along_z(scene, 4 * static_cast<float>(i));
    if (hit.t > 0 && hit.primitive == i) ++hits;
  }
  return hits;
}

TEST(VulkanScene, InactiveTrianglesHideNoOthers) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  RayCaster caster(h);
  for (const float value : {kNaN, kInfinity, -3e30f}) {
    for (const uint32_t odd : {0u, 3u, 7u}) {
      for (const int component : {0, 4, 8}) {
        const uint64_t level = h.bottom_level({row_with(8, odd, value, component)});
        EXPECT_EQ(hits_of_row(caster, h.top_level({instance_of(level)}), 8), 7u);
      }
    }
  }
}

TEST(VulkanScene, InactiveBoxesHideNoOthers) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  RayCaster caster(h);
  for (const uint32_t odd : {0u, 3u, 7u}) {
    GeometryInput input;
    for (int i = 0; i < 8; ++i) append(input, box_at(5, 4 * static_cast<float>(i)));
    input.boxes[odd].MinX = kNaN;
    auto instance = instance_of(h.bottom_level({input}));
    instance.InstanceContributionToHitGroupIndex = 1;
    const uint64_t scene = h.top_level({instance});
    for (uint32_t i = 0; i < 8; ++i) {
      const auto hit = caster.cast_along_z(scene, 4 * static_cast<float>(i));
      EXPECT_EQ(hit.t, i == odd ? -1.0f : 1.0f + static_cast<float>(i));
    }
  }
}

TEST(VulkanScene, UnusableInstancesAreInactiveWithAMessage) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  RayCaster caster(h);
  const uint64_t level = h.bottom_level({triangle_at(3)});
  std::vector<rtapi::RaytracingInstanceDesc> instances(6, instance_of(level));
  instances[0].Transform[2][2] = 0;
  instances[1].AccelerationStructure = h.buffer(64)->address();
  instances[2].Transform[0][3] = kNaN;
  instances[3].Transform[1][1] = kInfinity;
  instances[5].AccelerationStructure = h.bottom_level({GeometryInput{}});
  const auto hit = caster.cast_along_z(h.top_level(instances));
  EXPECT_EQ(hit.instance, 4u);
  EXPECT_NEAR(hit.t, 3, 1e-4);
  ASSERT_EQ(h.messages.size(), 4u);
  for (const auto& message : h.messages) EXPECT_EQ(message.Id.text(), "KA0797");
  EXPECT_NE(h.messages[0].Text.find("singular"), std::string::npos);
}

TEST(VulkanScene, ManyTopLevelsAreFoundAndFreed) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  RayCaster caster(h);
  std::vector<uint64_t> scenes;
  for (int i = 0; i < 40; ++i) {
    auto instance = instance_of(h.bottom_level({triangle_at(1 + static_cast<float>(i))}));
    instance.InstanceID = 500 + i;
    // More entries than the instance table starts with.
    scenes.push_back(h.top_level(std::vector(100, instance)));
  }
  for (int i = 0; i < 40; i += 2) std::memset(h.host(scenes[i]), 0, 16);
  for (int i = 0; i < 40; ++i) {
    const auto hit = caster.cast_along_z(scenes[i]);
    EXPECT_NEAR(hit.t, i % 2 == 0 ? -1 : 1 + i, 1e-4);
    EXPECT_EQ(hit.instance_id, i % 2 == 0 ? 0u : 500u + i);
  }
  // Freed entries are reused.
  auto instance = instance_of(h.bottom_level({triangle_at(50)}));
  instance.InstanceID = 7;
  const uint64_t more = h.top_level(std::vector(1500, instance));
  EXPECT_EQ(caster.cast_along_z(more).instance_id, 7u);
  EXPECT_EQ(caster.cast_along_z(scenes[39]).instance_id, 539u);
}

TEST(VulkanScene, ATopLevelOutlivesWhatItRefersTo) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  RayCaster caster(h);
  auto command = h.bottom_level_command({triangle_at(3)});
  auto block = h.buffer(1 << 16);
  command.dest = block->address();
  ASSERT_TRUE(h.build(command));
  const uint64_t scene = h.top_level({instance_of(command.dest)});
  h.free(block);
  EXPECT_NEAR(caster.cast_along_z(scene).t, 3, 1e-4);
  EXPECT_EQ(caster.cast_along_z(h.top_level({instance_of(command.dest)})).t, -1);
}

TEST(VulkanScene, UpdatesInPlaceAndElsewhere) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  RayCaster caster(h);
  auto indexed = triangle_at(3);
  indexed.indices = {0, 1, 2};
  auto command = h.bottom_level_command({indexed}, Flags::kAllowUpdate);
  ASSERT_TRUE(h.build(command));
  const uint64_t scene = h.top_level({instance_of(command.dest)});
  command.source = command.dest;
  command.dest = h.buffer(1 << 16)->address();
  command.flags = Flags::kAllowUpdate | Flags::kPerformUpdate;
  indexed = triangle_at(6);
  indexed.indices = {2, 2, 2};  // an update does not read the indices again
  command.geometries = {h.geometry(indexed)};
  ASSERT_TRUE(h.build(command));
  EXPECT_NEAR(caster.cast_along_z(h.top_level({instance_of(command.source)})).t, 3, 1e-4);
  EXPECT_NEAR(caster.cast_along_z(h.top_level({instance_of(command.dest)})).t, 6, 1e-4);
  command.dest = command.source;
  ASSERT_TRUE(h.build(command));
  EXPECT_NEAR(caster.cast_along_z(h.top_level({instance_of(command.dest)})).t, 6, 1e-4);
  // The old top level must not crash; what it hits is undefined.
  caster.cast_along_z(scene);
  command.geometries[0].Triangles.VertexCount = 2;
  const auto status = h.build(command);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().id.text(), "KA0793");
}

TEST(VulkanScene, ClonesAndCompaction) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  RayCaster caster(h);
  GeometryInput many;
  for (int i = 0; i < 2000; ++i) append(many, triangle_at(3 + 0.001f * static_cast<float>(i)));
  auto command = h.bottom_level_command({many}, Flags::kAllowCompaction);
  const auto out = h.buffer(16);
  command.postbuild_infos = {{out->address(), InfoType::kCompactedSize},
                             {out->address() + 8, InfoType::kCurrentSize}};
  ASSERT_TRUE(h.build(command));
  uint64_t sizes[2];
  std::memcpy(sizes, out->host(), sizeof(sizes));
  EXPECT_LE(sizes[0], sizes[1]);
  EXPECT_GT(sizes[0], 2000u * 36);
  runtime::CopyAccelerationStructureCommand copy;
  copy.source = command.dest;
  copy.dest = h.buffer(sizes[0])->address();
  copy.mode = CopyMode::kCompact;
  ASSERT_TRUE(h.copy(copy));
  std::memset(h.host(command.dest), 0, 16);
  EXPECT_NEAR(caster.cast_along_z(h.top_level({instance_of(copy.dest)})).t, 3, 1e-4);
  runtime::EmitPostbuildInfoCommand emit;
  emit.desc = {out->address(), InfoType::kSerialization};
  emit.sources = {copy.dest};
  ASSERT_TRUE(h.structures().emit(h.stream(), emit));
  std::memcpy(sizes, out->host(), sizeof(sizes));
  EXPECT_GT(sizes[0], 2000u * 36);
  EXPECT_EQ(sizes[1], 0u);
}

// Whatever passes the format checks gets built, whatever its numbers are; the rest is an error.
TEST(VulkanScene, SealedDamageIsAnErrorOrBuilds) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  RayCaster caster(h);
  std::mt19937 random(9);
  GeometryInput input = triangle_at(3);
  append(input, triangle_at(5, 10));
  input.indices = {0, 1, 2, 3, 4, 5};
  const uint64_t level = h.bottom_level({input, triangle_at(4)});
  const uint64_t boxes = h.bottom_level({box_at(4)});
  const uint64_t top = h.top_level({instance_of(level), instance_of(0), instance_of(boxes)});
  const auto dest = h.buffer(65536);
  uint32_t built = 0;
  for (const uint64_t source : {level, boxes, top}) {
    runtime::CopyAccelerationStructureCommand copy;
    const auto saved = h.buffer(8192);
    copy.source = source;
    copy.dest = saved->address();
    copy.mode = CopyMode::kSerialize;
    ASSERT_TRUE(h.copy(copy));
    rtapi::SerializedRaytracingAccelerationStructureHeader header;
    std::memcpy(&header, saved->host(), sizeof(header));
    const auto size = static_cast<size_t>(header.SerializedSizeInBytesIncludingHeader);
    const std::vector<uint8_t> bytes(saved->host(), saved->host() + size);
    copy.source = saved->address();
    copy.dest = dest->address();
    copy.mode = CopyMode::kDeserialize;
    for (int round = 0; round < 200; ++round) {
      std::memcpy(saved->host(), bytes.data(), size);
      for (uint32_t n = round == 0 ? 0 : 1 + random() % 3; n > 0; --n) {
        saved->host()[56 + random() % (size - 56)] ^= static_cast<uint8_t>(1u << random() % 8);
      }
      runtime::seal_serialized(std::span(saved->host(), size));
      const auto status = h.copy(copy);
      if (!status) {
        EXPECT_EQ(status.error().id.text().substr(0, 4), "KA07") << status.error().message;
        continue;
      }
      ++built;
      const uint64_t scene = source == top ? copy.dest : h.top_level({instance_of(copy.dest)});
      const float t = caster.cast_along_z(scene).t;
      if (round == 0 && source == level) {
        EXPECT_NEAR(t, 3, 1e-4);
      }
    }
  }
  EXPECT_GT(built, 100u);
}

TEST(VulkanScene, SizesGrowWithEveryCount) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  const auto size = [&](uint32_t vertices, size_t geometries, uint32_t instances) {
    rtapi::RaytracingGeometryDesc desc;
    desc.Triangles.VertexCount = vertices;
    runtime::BuildCommand inputs;
    if (instances == 0) inputs.type = rtapi::RaytracingAccelerationStructureType::kBottomLevel;
    inputs.geometries.assign(geometries, desc);
    inputs.instance_count = instances;
    return h.structures().prebuild_info(inputs).ResultDataMaxSizeInBytes;
  };
  EXPECT_LT(size(300, 1, 0), size(600, 1, 0));
  EXPECT_LT(size(300, 1, 0), size(300, 2, 0));
  EXPECT_LT(size(0, 0, 10), size(0, 0, 20));
  EXPECT_EQ(size(300, 1, 0) % 256, 0u);
}

TEST(VulkanScene, WhatIsTooLargeIsAnError) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  auto command = h.bottom_level_command({triangle_at(3)});
  command.dest = h.buffer(16)->address();
  auto status = h.build(command);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().id.text(), "KA0795");
  const auto instances = std::vector<rtapi::RaytracingInstanceDesc>(2);
  auto top = h.top_level_command(instances);
  top.instance_count = 1 << 20;
  status = h.build(top);
  ASSERT_FALSE(status);
  // All boxes share one address: 2^29 + 1 of them.
  command = h.bottom_level_command({box_at(3)});
  command.geometries[0].AABBs.AABBs.StrideInBytes = 0;
  command.geometries[0].AABBs.AABBCount = (uint64_t{1} << 29) + 1;
  command.dest = h.buffer(1 << 16)->address();
  status = h.build(command);
  ASSERT_FALSE(status);
}

// Arbitrary bits in vertices, boxes, matrices and rays.
TEST(VulkanScene, NothingCrashesOnAnyInput) {
  KAAMOS_NEED_GPU(gpu);
  SceneHarness h(gpu);
  RayCaster caster(h);
  std::mt19937 random(11);
  const auto number = [&] {
    const uint32_t bits = random() % 3 == 0 ? random() : 0x3F000000u + random() % 0x02000000u;
    float value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  };
  for (int round = 0; round < 20; ++round) {
    GeometryInput triangles[2];
    GeometryInput boxes;
    for (auto& geometry : triangles) {
      for (uint32_t i = 0; i < 9 * (random() % 60); ++i) geometry.xyz.push_back(number());
    }
    for (uint32_t i = 0; i < 1 + random() % 30; ++i) {
      boxes.boxes.push_back({number(), number(), number(), number(), number(), number()});
    }
    const uint64_t levels[2] = {h.bottom_level({triangles[0], triangles[1]}),
                                h.bottom_level({boxes})};
    std::vector<rtapi::RaytracingInstanceDesc> instances;
    for (uint32_t i = 0; i < 8; ++i) {
      auto& instance = instances.emplace_back(instance_of(levels[i % 2]));
      instance.InstanceContributionToHitGroupIndex = i % 2;
      instance.Flags = random() % 256;
      for (auto& row : instance.Transform) {
        for (float& value : row) value = i < 4 ? value : number();
      }
    }
    std::vector<testing::CastRay> rays(200);
    for (auto& ray : rays) {
      for (float& value : ray.origin) value = number();
      for (float& value : ray.direction) value = number();
      ray.t_min = number();
      ray.t_max = number();
    }
    const auto hits = caster.cast(h.top_level(instances), rays);
    for (const auto& hit : hits) EXPECT_GE(hit.t, -1.0f);
  }
}

// -------------------------------------------------------------------------------------------------
// These tests show what goes wrong on lavapipe without the workarounds.

TEST(Workarounds, B5FirstVertexIsAppliedTwice) {
  const auto second_is_hit = [](const std::shared_ptr<Gpu>& gpu) {
    SceneHarness h(gpu);
    RayCaster caster(h);
    const uint64_t level = h.bottom_level({triangle_at(5), triangle_at(5, 4)});
    return caster.cast_along_z(h.top_level({instance_of(level)}), 4).t > 0;
  };
  const Without without("B5");
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->is_lavapipe()) GTEST_SKIP() << "only lavapipe has this fault";
  EXPECT_FALSE(second_is_hit(gpu));
  unsetenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS");
  EXPECT_TRUE(second_is_hit(*Gpu::create()));
}

TEST(Workarounds, B6ANaNHidesItsNeighbours) {
  const auto hits = [](const std::shared_ptr<Gpu>& gpu) {
    SceneHarness h(gpu);
    RayCaster caster(h);
    const uint64_t level = h.bottom_level({row_with(8, 7, kNaN, 6)});
    return hits_of_row(caster, h.top_level({instance_of(level)}), 8);
  };
  const Without without("B6,SORT");
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->is_lavapipe()) GTEST_SKIP() << "only lavapipe has this fault";
  EXPECT_LT(hits(gpu), 7u);
  unsetenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS");
  EXPECT_EQ(hits(*Gpu::create()), 7u);
}

TEST(Workarounds, SortingMakesAShuffledMeshFast) {
  const auto milliseconds = [](const std::shared_ptr<Gpu>& gpu) {
    SceneHarness h(gpu);
    RayCaster caster(h);
    GeometryInput mesh;
    std::vector<uint32_t> cells(64 * 64);
    for (uint32_t i = 0; i < cells.size(); ++i) cells[i] = i;
    std::shuffle(cells.begin(), cells.end(), std::mt19937(1));
    for (const uint32_t cell : cells) {
      const auto x = static_cast<float>(cell % 64);
      const auto y = static_cast<float>(cell / 64);
      const float z = 5 + std::sin(x) + std::sin(y);
      for (const float v : {x, y, z, x + 1, y, z, x, y + 1, z}) mesh.xyz.push_back(v);
    }
    const uint64_t scene = h.top_level({instance_of(h.bottom_level({mesh}))});
    std::vector<testing::CastRay> rays(4096);
    for (size_t i = 0; i < rays.size(); ++i) {
      rays[i].origin[0] = static_cast<float>(i % 64) + 0.25f;
      rays[i].origin[1] = static_cast<float>(i / 64) + 0.25f;
    }
    caster.cast(scene, rays);  // compiles the pipeline
    const auto hits = caster.cast(scene, rays);
    EXPECT_TRUE(std::all_of(hits.begin(), hits.end(), [](const auto& hit) { return hit.t > 0; }));
    return caster.last_ms();
  };
  const Without without("SORT");
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->is_lavapipe()) GTEST_SKIP() << "only lavapipe keeps the order of the input";
  const double shuffled = milliseconds(gpu);
  unsetenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS");
  const double sorted = milliseconds(*Gpu::create());
  EXPECT_GT(shuffled / sorted, 5) << shuffled << " ms against " << sorted << " ms";
}

TEST(Workarounds, SortingMakesShuffledInstancesFast) {
  const auto milliseconds = [](const std::shared_ptr<Gpu>& gpu) {
    SceneHarness h(gpu);
    RayCaster caster(h);
    const uint64_t level = h.bottom_level({triangle_at(5)});
    std::vector<uint32_t> cells(64 * 64);
    for (uint32_t i = 0; i < cells.size(); ++i) cells[i] = i;
    std::shuffle(cells.begin(), cells.end(), std::mt19937(1));
    std::vector<rtapi::RaytracingInstanceDesc> instances;
    std::vector<testing::CastRay> rays(cells.size());
    for (const uint32_t cell : cells) {
      auto& instance = instances.emplace_back(instance_of(level));
      const auto x = 3 * static_cast<float>(cell % 64);
      const auto y = 3 * static_cast<float>(cell / 64);
      instance.Transform[0][3] = x;
      instance.Transform[1][3] = y;
      rays[cell].origin[0] = x;
      rays[cell].origin[1] = y;
    }
    const uint64_t scene = h.top_level(instances);
    caster.cast(scene, rays);  // compiles the pipeline
    const auto hits = caster.cast(scene, rays);
    for (uint32_t i = 0; i < cells.size(); ++i) EXPECT_EQ(hits[cells[i]].instance, i);
    return caster.last_ms();
  };
  const Without without("SORT");
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->is_lavapipe()) GTEST_SKIP() << "only lavapipe keeps the order of the input";
  const double shuffled = milliseconds(gpu);
  unsetenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS");
  const double sorted = milliseconds(*Gpu::create());
  RecordProperty("gain", std::to_string(shuffled / sorted));
  EXPECT_GT(shuffled / sorted, 5) << shuffled << " ms against " << sorted << " ms";
}

}  // namespace
}  // namespace kaamos::vulkan

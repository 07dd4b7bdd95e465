// SPDX-License-Identifier: MIT
//
// Top levels of partitions that operations change again and again, against top levels that are
// built from the same instances. (PTL-03, 22, 27)
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "runtime/embree/device.h"
#include "runtime/embree/parallel.h"
#include "runtime/embree/testing/harness.h"
#include "runtime/embree/top_level.h"
#include "runtime/structures/instances.h"

namespace kaamos::embree::testing {
namespace {

class PartitionedScene {
 public:
  PartitionedScene(Harness& h, uint32_t count, uint32_t partitions)
      : h_(h), device_(static_cast<Device&>(h.device())), partition_count_(partitions + 1) {
    instances_.resize(count);
    partitions_.resize(count);
    bottom_levels_ = {h.bottom_level({triangle_at(0)}), h.bottom_level({box_at(0)}),
                      h.bottom_level({triangle_at(0, kNonOpaque)})};
    const auto memory = h.buffer(4096);
    address_ = memory->address();
    host_ = memory->host();
  }
  // Gives an instance another place, bottom level and partition; `kinds` of bottom levels.
  void change(uint32_t i, std::mt19937& random, uint32_t kinds) {
    std::uniform_real_distribution<float> place(-20, 20);
    rtapi::RaytracingInstanceDesc desc;
    desc.Transform[0][3] = place(random);
    desc.Transform[1][3] = place(random);
    desc.Transform[2][3] = 40 + place(random);
    desc.InstanceID = static_cast<uint32_t>(random() & 0xFFFFFF);
    // One in eight cannot be hit.
    if (random() % 8 != 0) desc.AccelerationStructure = bottom_levels_[random() % kinds];
    instances_[i] = {};
    instances_[i].desc = desc;
    instances_[i].id = desc.InstanceID;
    runtime::activate_instance(device_.memory(), instances_[i]);
    partitions_[i] = static_cast<uint32_t>(random() % partition_count_);
  }
  // Returns whether the level could be changed; otherwise it was built.
  bool apply(const std::vector<uint32_t>& changed) {
    const runtime::PartitionedInstances partitioned = {
        instances_, changed, partition_count_, prefers_trace,
        [this](uint32_t i) { return partitions_[i]; }};
    bool updated = false;
    run_in_arena(device_.arena(), [&] {
      if (level_ != nullptr) {
        const auto result = level_->update(partitioned);
        ASSERT_TRUE(result.ok());
        updated = *result;
      }
      if (updated) return;
      const auto built = TopLevel::build_partitioned(device_.build_context(), partitioned);
      ASSERT_TRUE(built.ok());
      level_ = *built;
    });
    runtime::AccelerationStructure structure;
    structure.address = address_;
    structure.host = host_;
    structure.size_bytes = 4096;
    structure.top_level = level_;
    device_.memory().place(std::move(structure));
    return updated;
  }
  uint64_t address() const { return address_; }
  bool prefers_trace = false;
  uint64_t classic() {
    std::vector<rtapi::RaytracingInstanceDesc> descs;
    for (const auto& instance : instances_) descs.push_back(instance.desc);
    return h_.top_level(descs);
  }

 private:
  Harness& h_;
  Device& device_;
  uint32_t partition_count_;
  std::vector<runtime::Instance> instances_;
  std::vector<uint32_t> partitions_;
  std::vector<uint64_t> bottom_levels_;
  std::shared_ptr<TopLevel> level_;
  uint64_t address_ = 0;
  uint8_t* host_ = nullptr;
};

void expect_equal_hits(Harness& h, PartitionedScene& scene, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-22, 22);
  std::vector<Ray> rays;
  for (int i = 0; i < 300; ++i)
    rays.push_back(ray_along_z(scene.address(), place(random), place(random)));
  const auto found = h.trace(rays);
  const uint64_t classic = scene.classic();
  for (Ray& ray : rays) ray.acceleration_structure = classic;
  const auto expected = h.trace(rays);
  uint32_t hits = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    ASSERT_EQ(found[i].end, expected[i].end) << i;
    if (found[i].end != End::kClosestHit) continue;
    ++hits;
    ASSERT_EQ(found[i].values.instance_index, expected[i].values.instance_index) << i;
    ASSERT_EQ(found[i].values.instance_id, expected[i].values.instance_id) << i;
    ASSERT_EQ(found[i].values.t_current, expected[i].values.t_current) << i;
    for (int k = 0; k < 12; ++k)
      ASSERT_EQ(found[i].object_to_world[k], expected[i].object_to_world[k]);
  }
  EXPECT_GT(hits, 50u);
}

// `kinds`: 1 opaque triangles, 2 boxes as well, 3 any-hit shaders as well.
void run_changes(uint32_t count, uint32_t partitions, uint32_t kinds) {
  Harness h;
  std::mt19937 random(count + partitions);
  PartitionedScene scene(h, count, partitions);
  h.use_standard_pipeline(any_hit_accept);
  std::vector<uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  for (const uint32_t i : all) scene.change(i, random, kinds);
  EXPECT_FALSE(scene.apply(all));
  expect_equal_hits(h, scene, random);
  uint32_t updates = 0;
  for (int step = 0; step < 12; ++step) {
    std::vector<uint32_t> changed = all;
    std::shuffle(changed.begin(), changed.end(), random);
    changed.resize(step == 5 ? 0 : 1 + random() % (count / 4));
    for (const uint32_t i : changed) scene.change(i, random, kinds);
    updates += scene.apply(changed) ? 1 : 0;
    expect_equal_hits(h, scene, random);
    if (::testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(updates, 8u);
  scene.prefers_trace = true;
  EXPECT_FALSE(scene.apply({}));
  expect_equal_hits(h, scene, random);
}

TEST(Ptl27, ChangesLeaveWhatABuildWouldMake) {
  run_changes(200, 10, 1);
}
TEST(Ptl27, ChangesOfManyPartitionsInSeveralGroups) {
  run_changes(20000, 400, 1);
}
TEST(Ptl27, ChangesWithAnyHitShaders) {
  run_changes(200, 4, 3);
}

TEST(Ptl27, FewInstancesAreBuiltAnew) {
  Harness h;
  std::mt19937 random(3);
  PartitionedScene scene(h, 20, 2);
  for (uint32_t i = 0; i < 20; ++i) scene.change(i, random, 1);
  EXPECT_FALSE(scene.apply({0}));
  EXPECT_FALSE(scene.apply({0}));
}

}  // namespace
}  // namespace kaamos::embree::testing

// SPDX-License-Identifier: MIT
//
// Shader table indexing: rules SBT-nn of the conformance list.
#include <gtest/gtest.h>

#include "runtime/embree/shader_record.h"
#include "runtime/embree/testing/harness.h"

namespace kaamos::embree::testing {
namespace {

GeometryInput shifted_triangle(float x, rtapi::RaytracingGeometryFlags flags = kOpaque) {
  GeometryInput input = triangle_at(5, flags);
  for (Vertex& v : input.vertices) v.x += x;
  return input;
}

// Four geometries side by side at x = 0, 10, 20, 30, in an instance with this contribution.
uint64_t row_of_geometries(Harness& h, uint32_t contribution, uint32_t flags = 0) {
  auto instance = instance_of(h.bottom_level(
      {shifted_triangle(0), shifted_triangle(10), shifted_triangle(20), shifted_triangle(30)}));
  instance.InstanceContributionToHitGroupIndex = contribution;
  instance.Flags = flags;
  return h.top_level({instance});
}

TEST(Sbt02, HitRecordIsTheSumOfAllTerms) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = row_of_geometries(h, 7);
  for (const uint32_t contribution : {0u, 3u, 15u}) {
    for (const uint32_t multiplier : {0u, 1u, 2u, 9u}) {
      for (uint32_t geometry = 0; geometry < 4; ++geometry) {
        auto ray = ray_along_z(scene, 10.0f * geometry);
        ray.ray_contribution_to_hit_group_index = contribution;
        ray.multiplier_for_geometry_contribution = multiplier;
        const Payload payload = h.trace(ray);
        EXPECT_EQ(payload.end, End::kClosestHit);
        EXPECT_EQ(payload.record, contribution + multiplier * geometry + 7);
        EXPECT_EQ(payload.values.geometry_index, geometry);
      }
    }
  }
}

TEST(Sbt03And04And05, OnlyTheLowBitsCount) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = row_of_geometries(h, 0);
  auto ray = ray_along_z(scene, 10);
  ray.ray_contribution_to_hit_group_index = 0xFFFFFFF3u;
  ray.multiplier_for_geometry_contribution = 0x11;
  EXPECT_EQ(h.trace(ray).record, 3u + 1u);
  ray = ray_along_z(scene, 5);
  ray.miss_shader_index = 0x10002;
  EXPECT_EQ(h.trace(ray).record, 1002u);
}

TEST(Sbt06, InstanceFlagsDoNotLeakIntoTheIndex) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = row_of_geometries(h, 5, 0xF7 & ~0xC);
  EXPECT_EQ(h.trace(ray_along_z(scene)).record, 5u);
}

TEST(Sbt07, LargestIndexNeedsSixtyFourBits) {
  const uint64_t index = hit_record_index(15, 15, (1u << 24) - 1, 0xFFFFFF);
  EXPECT_EQ(index, (uint64_t{1} << 28) - 1);
  EXPECT_EQ(index * 4096, 0xFFFFFFF000ull);
  EXPECT_EQ(hit_record_index(0xFFFFFFF1, 0xFFFFFFF2, 10, 0xFF000003), 1u + 20u + 3u);
}

TEST(Sbt09And10, MultipliersInterleaveRayTypesOrDropGeometry) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = row_of_geometries(h, 0);
  std::vector<bool> seen(8, false);
  for (uint32_t type = 0; type < 2; ++type) {
    for (uint32_t geometry = 0; geometry < 4; ++geometry) {
      auto ray = ray_along_z(scene, 10.0f * static_cast<float>(geometry));
      ray.ray_contribution_to_hit_group_index = type;
      ray.multiplier_for_geometry_contribution = 2;
      seen.at(h.trace(ray).record) = true;
      ray.multiplier_for_geometry_contribution = 0;
      const Payload payload = h.trace(ray);
      EXPECT_EQ(payload.record, type);
      EXPECT_EQ(payload.values.geometry_index, geometry);
    }
  }
  EXPECT_EQ(seen, std::vector<bool>(8, true));
}

TEST(Sbt12, CallableIndexIsNotMasked) {
  Harness h;
  PipelineBuilder builder;
  const auto rg = builder.ray_generation([](shader::Invocation& invocation) {
    uint32_t* value;
    std::memcpy(&value, invocation.dispatch->root_arguments, sizeof(value));
    invocation.dispatch->services->call_shader(invocation, 70000, value, 4);
  });
  const auto callable = builder.callable([](shader::Invocation& invocation, void* data) {
    std::memcpy(data, invocation.local_arguments, 4);
  });
  h.set_pipeline(builder, rg);
  std::vector<Record> records(70001);
  records[70000] = {callable, 4242};
  h.set_callable_table(records);
  uint32_t value = kSentinel;
  const uint32_t* root = &value;
  ASSERT_TRUE(h.dispatch(1, 1, 1, &root, sizeof(root)).ok());
  EXPECT_EQ(value, 4242u);
}

TEST(Sbt13, RayGenerationIsTheRecordThatTheDispatchNames) {
  Harness h;
  PipelineBuilder builder;
  const auto rg = builder.ray_generation([](shader::Invocation& invocation) {
    uint32_t* value;
    std::memcpy(&value, invocation.dispatch->root_arguments, sizeof(value));
    std::memcpy(value, invocation.local_arguments, 4);
  });
  h.set_pipeline(builder, rg);
  std::vector<uint8_t> table(192);
  for (uint32_t i = 0; i < 3; ++i) {
    std::memcpy(&table[64 * i], rg.data(), 32);
    std::memcpy(&table[64 * i + 32], &i, 4);
  }
  const uint64_t start = h.upload(table);
  for (uint32_t i = 0; i < 3; ++i) {
    h.desc().RayGenerationShaderRecord = {start + 64 * i, 64};
    uint32_t value = kSentinel;
    const uint32_t* root = &value;
    ASSERT_TRUE(h.dispatch(1, 1, 1, &root, sizeof(root)).ok());
    EXPECT_EQ(value, i);
  }
}

TEST(Sbt11, MissRecordTakesNoOtherTerm) {
  Harness h;
  h.use_standard_pipeline();
  auto ray = ray_along_z(row_of_geometries(h, 9), 5);
  ray.miss_shader_index = 3;
  ray.ray_contribution_to_hit_group_index = 7;
  ray.multiplier_for_geometry_contribution = 4;
  const Payload payload = h.trace(ray);
  EXPECT_EQ(payload.end, End::kMiss);
  EXPECT_EQ(payload.record, 1003u);
}

TEST(Sbt15, StrideZeroIsTheFirstRecordForEveryIndex) {
  Harness h;
  PipelineBuilder builder;
  const auto ray_generation = builder.ray_generation(trace_job);
  h.set_pipeline(builder, ray_generation);
  PipelineBuilder shaders;
  const auto rg = shaders.ray_generation(trace_job);
  const auto hit = shaders.hit_group(closest_hit, nullptr);
  const auto missed = shaders.miss(miss);
  h.set_pipeline(shaders, rg);
  h.set_hit_table({{hit, 77}}, 0);
  h.set_miss_table({{missed, 88}}, 0);
  auto ray = ray_along_z(row_of_geometries(h, 1000), 20);
  ray.multiplier_for_geometry_contribution = 15;
  EXPECT_EQ(h.trace(ray).record, 77u);
  ray = ray_along_z(ray.acceleration_structure, 5);
  ray.miss_shader_index = 60000;
  EXPECT_EQ(h.trace(ray).record, 88u);
}

TEST(Sbt18, NullMissRecordRunsNothing) {
  Harness h;
  h.use_standard_pipeline();
  h.set_miss_table({{kNullIdentifier, 1}});
  const Payload payload = h.trace(ray_along_z(row_of_geometries(h, 0), 5));
  EXPECT_EQ(payload.end, End::kNothing);
  EXPECT_EQ(payload.calls, 0u);
}

TEST(Sbt19, NullHitGroupIsOpaqueAndHidesWhatIsBehind) {
  Harness h;
  h.use_standard_pipeline(any_hit_ignore);
  const uint64_t front = h.bottom_level({triangle_at(2, kNonOpaque)});
  const uint64_t back = h.bottom_level({triangle_at(4, kOpaque)});
  auto near_instance = instance_of(front);
  auto far_instance = instance_of(back);
  far_instance.InstanceContributionToHitGroupIndex = 1;
  const uint64_t scene = h.top_level({near_instance, far_instance});
  PipelineBuilder builder;
  const auto rg = builder.ray_generation(trace_job);
  const auto hit = builder.hit_group(closest_hit, any_hit_ignore);
  const auto missed = builder.miss(miss);
  h.set_pipeline(builder, rg);
  h.set_hit_table({{kNullIdentifier, 0}, {hit, 1}});
  h.set_miss_table({{missed, 0}});
  const Payload payload = h.trace(ray_along_z(scene));
  EXPECT_EQ(payload.end, End::kNothing);
  EXPECT_EQ(payload.any_hits, 0u);
}

TEST(Sbt20, NullHitGroupAtABoxLetsTheRayPass) {
  Harness h;
  h.use_standard_pipeline(nullptr, report_all);
  h.set_hit_table({{kNullIdentifier, 0}});
  EXPECT_EQ(h.trace(ray_along_z(h.scene({box_at(3)}))).end, End::kMiss);
}

TEST(Sbt22, NullCallableAndNullRayGenerationRunNothing) {
  Harness h;
  PipelineBuilder builder;
  const auto rg = builder.ray_generation([](shader::Invocation& invocation) {
    uint32_t* values;
    std::memcpy(&values, invocation.dispatch->root_arguments, sizeof(values));
    values[0] = 1;
    invocation.dispatch->services->call_shader(invocation, 0, &values[1], 4);
    values[2] = 2;
  });
  uint32_t values[3] = {kSentinel, kSentinel, kSentinel};
  const uint32_t* root = values;
  h.set_pipeline(builder, rg);
  h.set_callable_table({{kNullIdentifier, 0}});
  ASSERT_TRUE(h.dispatch(1, 1, 1, &root, sizeof(root)).ok());
  EXPECT_EQ(values[0], 1u);
  EXPECT_EQ(values[1], kSentinel);
  EXPECT_EQ(values[2], 2u);
  values[0] = kSentinel;
  h.set_pipeline(builder, kNullIdentifier);
  ASSERT_TRUE(h.dispatch(4, 4, 1, &root, sizeof(root)).ok());
  EXPECT_EQ(values[0], kSentinel);
}

TEST(Sbt23, AnIndexPastTheTableRunsNothing) {
  Harness h;
  h.use_standard_pipeline();
  auto ray = ray_along_z(row_of_geometries(h, 0xFFFFFF));
  EXPECT_EQ(h.trace(ray).end, End::kNothing);
  ray = ray_along_z(ray.acceleration_structure, 5);
  ray.miss_shader_index = 8;
  EXPECT_EQ(h.trace(ray).end, End::kNothing);
  ASSERT_EQ(h.messages.size(), 2u);
  EXPECT_EQ(h.messages[0].Id.text(), "KA0895");
  EXPECT_NE(h.messages[0].Text.find("record 16777215"), std::string::npos) << h.messages[0].Text;
  EXPECT_NE(h.messages[1].Text.find("miss table: record 8 was reached, but the table has 8"),
            std::string::npos)
      << h.messages[1].Text;
  ray.miss_shader_index = 7;
  EXPECT_EQ(h.trace(ray).record, 1007u);
}

TEST(Sbt24, GarbageInUnreachedRecordsIsHarmless) {
  Harness h;
  h.use_standard_pipeline();
  rtapi::ShaderIdentifier garbage;
  garbage.fill(0xEE);
  PipelineBuilder builder;
  const auto rg = builder.ray_generation(trace_job);
  const auto hit = builder.hit_group(closest_hit, nullptr);
  h.set_pipeline(builder, rg);
  h.set_hit_table({{garbage, 0}, {hit, 1}, {garbage, 2}});
  EXPECT_EQ(h.trace(ray_along_z(row_of_geometries(h, 1))).record, 1u);
  EXPECT_TRUE(h.messages.empty());
  // An unknown identifier that is reached runs nothing.
  EXPECT_EQ(h.trace(ray_along_z(row_of_geometries(h, 0))).end, End::kNothing);
  ASSERT_EQ(h.messages.size(), 1u);
  EXPECT_EQ(h.messages[0].Id.text(), "KA0896");
}

TEST(Sbt26, AllShadersOfAGroupSeeTheSameRecord) {
  Harness h;
  h.use_standard_pipeline(any_hit_accept, report_all);
  report_log() = {{{3.0f, 5, {}}}, {}, {}, 0, {}};
  auto instance = instance_of(h.bottom_level({box_at(2, kNonOpaque)}));
  instance.InstanceContributionToHitGroupIndex = 12;
  const Payload payload = h.trace(ray_along_z(h.top_level({instance})));
  EXPECT_EQ(payload.record, 12u);
  EXPECT_EQ(payload.any_hit_record, 12u);
}

TEST(Sbt27, ClosestHitUsesTheRecordOfTheCommittedHit) {
  Harness h;
  h.use_standard_pipeline(any_hit_ignore);
  auto near_instance = instance_of(h.bottom_level({triangle_at(6, kOpaque)}));
  near_instance.InstanceContributionToHitGroupIndex = 4;
  std::vector<rtapi::RaytracingInstanceDesc> instances = {near_instance};
  const uint64_t ignored = h.bottom_level({triangle_at(2, kNonOpaque)});
  for (uint32_t i = 0; i < 8; ++i) {
    auto instance = instance_of(ignored);
    instance.Transform[2][3] = 0.25f * static_cast<float>(i);
    instance.InstanceContributionToHitGroupIndex = 20 + i;
    instances.push_back(instance);
  }
  const Payload payload = h.trace(ray_along_z(h.top_level(instances)));
  EXPECT_EQ(payload.any_hits, 8u);
  EXPECT_EQ(payload.record, 4u);
  EXPECT_TRUE(is_distance(payload.values.t_current, 6.0f));
}

TEST(Sbt30, TablesAreReadWhenTheDispatchExecutes) {
  Harness h;
  h.use_standard_pipeline();
  const uint64_t scene = row_of_geometries(h, 0);
  EXPECT_EQ(h.trace(ray_along_z(scene)).record, 0u);
  const uint32_t changed = 4711;
  std::memcpy(reinterpret_cast<void*>(h.desc().HitGroupTable.StartAddress + 32), &changed, 4);
  EXPECT_EQ(h.trace(ray_along_z(scene)).record, 4711u);
}

TEST(Sbt32, TablesThatNothingReachesMayBeNull) {
  Harness h;
  h.use_standard_pipeline();
  h.set_hit_table({});
  h.set_callable_table({});
  EXPECT_EQ(h.trace(ray_along_z(0)).end, End::kMiss);
}

}  // namespace
}  // namespace kaamos::embree::testing

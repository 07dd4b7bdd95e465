// SPDX-License-Identifier: MIT
#include "runtime/vulkan/rays/dispatch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "runtime/vulkan/testing/harness.h"

namespace kaamos::vulkan {
namespace {

using runtime::RecordKind;
using testing::Bench;
using ::testing::HasSubstr;
using testing::PipelineBuilder;
using testing::words_of;

// arguments[0] gets a uint per cell: 1 + x + 100 * y + 10000 * z of DispatchRaysIndex.
constexpr char kWriteIndex[] = R"(
void main() {
  uvec3 i = gl_LaunchIDEXT + uvec3(block.base[0], block.base[1], block.base[2]);
  uint at = i.x + block.dimensions[0] * (i.y + block.dimensions[1] * i.z);
  Words(block.arguments[0]).w[at] += 1 + i.x + 100 * i.y + 10000 * i.z;
}
)";

rtapi::DispatchRaysDesc desc_of(const std::shared_ptr<runtime::BackendBuffer>& ray_generation,
                                uint32_t width, uint32_t height = 1, uint32_t depth = 1) {
  rtapi::DispatchRaysDesc desc;
  desc.RayGenerationShaderRecord = {ray_generation->address(), 64};
  desc.Width = width;
  desc.Height = height;
  desc.Depth = depth;
  return desc;
}

TEST(DispatchRays, RunsEveryCellOnce) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  const auto table = bench.table({builder.ray_generation(kWriteIndex)});
  const auto pipeline = bench.create(builder.pipeline());
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  const GridLimits limits[] = {{}, {{4, 3, 1}, 100}, {{100, 100, 100}, 8}, {{100, 100, 100}, 1}};
  for (const GridLimits& limit : limits) {
    bench.limits = limit;
    const auto out = bench.buffer(4 * 9 * 7 * 3);
    const auto result = bench.rays(*pipeline, desc_of(table, 9, 7, 3), {out->address()});
    ASSERT_TRUE(result.status) << result.status.error().message;
    EXPECT_TRUE(result.warnings.empty());
    for (uint32_t i = 0; i < 9 * 7 * 3; ++i) {
      ASSERT_EQ(words_of(out)[i], 1 + i % 9 + 100 * (i / 9 % 7) + 10000 * (i / 63)) << i;
    }
  }
}

TEST(DispatchRays, EmptyGridsAndNullRayGenerationRunNothing) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  const auto table = bench.table({builder.ray_generation(kWriteIndex)});
  const auto null_table = bench.table({rtapi::ShaderIdentifier{}});
  const auto pipeline = bench.create(builder.pipeline());
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  const auto out = bench.buffer(64);
  EXPECT_TRUE(bench.rays(*pipeline, desc_of(table, 0), {out->address()}).status);
  EXPECT_TRUE(bench.rays(*pipeline, desc_of(table, 1, 1, 0), {out->address()}).status);
  const auto result = bench.rays(*pipeline, desc_of(null_table, 4), {out->address()});
  EXPECT_TRUE(result.status);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(words_of(out)[0], 0u);
}

// Calls callable arguments[1] + x, and stores its answer.
constexpr char kCall[] = R"(
struct Data { uint depths; uint value; };
layout(location = 0) callableDataEXT Data data;
void main() {
  uint index = uint(block.arguments[1]) + gl_LaunchIDEXT.x;
  data.value = 7;
  executeCallableEXT(min(index, block.callable_count), 0);
  Words(block.arguments[0]).w[gl_LaunchIDEXT.x] = data.value;
}
)";

// Answers 100 * NUMBER + the first argument of its record.
std::string answer(uint32_t number) {
  return "struct Data { uint depths; uint value; };\n"
         "layout(location = 0) callableDataInEXT Data data;\n"
         "void main() { data.value = 100 * " +
         std::to_string(number) + " + Words(record.local_arguments).w[0]; }\n";
}

TEST(DispatchRays, CallablesByRecordWithTheirArguments) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  const auto ray_generation = bench.table({builder.ray_generation(kCall)});
  const auto one = builder.callable(answer(1));
  const auto two = builder.callable(answer(2));
  const auto pipeline = bench.create(builder.pipeline());
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  const auto callables = bench.table({two, one, one, {}, two});
  const auto out = bench.buffer(64);
  rtapi::DispatchRaysDesc desc = desc_of(ray_generation, 8);
  desc.CallableShaderTable = Bench::range(callables);
  auto result = bench.rays(*pipeline, desc, {out->address(), 0});
  ASSERT_TRUE(result.status) << result.status.error().message;
  EXPECT_TRUE(result.warnings.empty());
  // Record 3 is null, 5 to 7 are past the table: nothing runs for them.
  const uint32_t expected[8] = {200, 101, 102, 7, 204, 7, 7, 7};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(words_of(out)[i], expected[i]) << i;

  // With a stride of 0 every index means the first record. [DXR: Shader record stride]
  desc.CallableShaderTable = Bench::range(callables, 0);
  result = bench.rays(*pipeline, desc, {out->address(), 5});
  ASSERT_TRUE(result.status) << result.status.error().message;
  for (int i = 0; i < 8; ++i) EXPECT_EQ(words_of(out)[i], 200u) << i;

  // No table at all.
  desc.CallableShaderTable = {};
  result = bench.rays(*pipeline, desc, {out->address(), 0});
  ASSERT_TRUE(result.status) << result.status.error().message;
  for (int i = 0; i < 8; ++i) EXPECT_EQ(words_of(out)[i], 7u) << i;
}

TEST(DispatchRays, UnknownIdentifiersRunNothingAndAreReported) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  PipelineBuilder other;
  const auto id = builder.ray_generation(kCall);
  const auto one = builder.callable(answer(1));
  const auto ray_generation = bench.table({id});
  const auto pipeline = bench.create(builder.pipeline());
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  const auto out = bench.buffer(64);
  rtapi::DispatchRaysDesc desc = desc_of(ray_generation, 4);
  // One from another pipeline, one of the wrong kind, two good ones.
  const auto callables = bench.table({other.callable(answer(9)), id, one, one});
  desc.CallableShaderTable = Bench::range(callables);
  const auto result = bench.rays(*pipeline, desc, {out->address(), 0});
  ASSERT_TRUE(result.status) << result.status.error().message;
  ASSERT_EQ(result.warnings.size(), 1u);
  EXPECT_EQ(result.warnings[0].id, runtime::Id::kRecordUnknown);
  EXPECT_THAT(result.warnings[0].text, HasSubstr("callable table: record 0"));
  EXPECT_THAT(result.warnings[0].text, HasSubstr("DispatchRays 0"));
  const uint32_t expected[4] = {7, 7, 102, 103};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(words_of(out)[i], expected[i]) << i;
}

TEST(DispatchRays, TablesOutsideBuffersRemoveTheDevice) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  const auto table = bench.table({builder.ray_generation(kWriteIndex)});
  const auto pipeline = bench.create(builder.pipeline());
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  auto freed = bench.table({builder.callable(answer(1))});
  rtapi::DispatchRaysDesc desc = desc_of(table, 1);
  desc.CallableShaderTable = Bench::range(freed);
  const auto out = bench.buffer(64);
  bench.scene.free(freed);
  const auto result = bench.rays(*pipeline, desc, {out->address()});
  ASSERT_FALSE(result.status);
  EXPECT_EQ(result.status.error().id.text(), "KA0892");
  EXPECT_EQ(result.status.error().code, rtapi::ErrorCode::kDeviceRemoved);
  EXPECT_THAT(result.status.error().message, HasSubstr("callable table"));
}

TEST(DispatchRays, WhatShadersReportRemovesTheDevice) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  const char* const ids[] = {"KA0890", "KA0891", "KA0892", "KA0893"};
  for (uint32_t reason = 0; reason < 4; ++reason) {
    PipelineBuilder builder(3);
    // The declared depth reaches the shader.
    const auto table = bench.table(
        {builder.ray_generation("void main() { if (MAX_TRACE_DEPTH == 3) remove_device(" +
                                std::to_string(reason) + "); }")});
    const auto pipeline = bench.create(builder.pipeline());
    ASSERT_TRUE(pipeline) << pipeline.error().message;
    const auto result = bench.rays(*pipeline, desc_of(table, 8, 8), {});
    ASSERT_FALSE(result.status);
    EXPECT_EQ(result.status.error().id.text(), ids[reason]);
    EXPECT_EQ(result.status.error().code, rtapi::ErrorCode::kDeviceRemoved);
    EXPECT_THAT(result.status.error().message, HasSubstr("DispatchRays 0"));
    if (reason == 0) {
      EXPECT_THAT(result.status.error().message, HasSubstr("MaxTraceRecursionDepth 3"));
    }
    if (reason == 1) {
      EXPECT_THAT(result.status.error().message, HasSubstr("the shader stack is used up"));
    }
  }
}

TEST(DispatchRays, WildAddressesRemoveTheDevice) {
  KAAMOS_NEED_GPU(gpu);
  // Only where shaders run on the processor is the device certain to survive this.
  if (!gpu->is_lavapipe()) GTEST_SKIP() << "a real device may hang";
  Bench bench(gpu);
  PipelineBuilder builder;
  const auto table = bench.table({builder.ray_generation(R"(
void main() {
  uint64_t at = block.arguments[0] + 4096 * uint64_t(gl_LaunchIDEXT.x);
  Words(at).w[0] = Words(at + 8).w[0] + 1;
})")});
  const auto pipeline = bench.create(builder.pipeline());
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  const uint64_t wild = 0x00005EAD00000000;
  for (int i = 0; i < 2; ++i) {
    const auto result = bench.rays(*pipeline, desc_of(table, 64, 4), {wild});
    ASSERT_FALSE(result.status);
    EXPECT_EQ(result.status.error().id.text(), "KA0892");
    EXPECT_EQ(result.status.error().code, rtapi::ErrorCode::kDeviceRemoved);
    EXPECT_THAT(result.status.error().message, HasSubstr("address 0x5ead"));
  }
  const auto out = bench.buffer(64 * 4096);
  EXPECT_TRUE(bench.rays(*pipeline, desc_of(table, 64), {out->address()}).status);
}

// Calls itself until it hits the limit.
constexpr char kCallYourself[] = R"(
struct Data { uint depths; uint value; };
layout(location = 0) callableDataInEXT Data given;
layout(location = 1) callableDataEXT Data passed;
void main() {
  uint depth = given.depths >> 16;
  given.value += 1;
  if (depth >= MAX_CALLABLE_DEPTH) { remove_device(1); return; }
  if (depth >= uint(block.arguments[2])) return;
  passed.depths = (depth + 1) << 16;
  passed.value = given.value;
  executeCallableEXT(0, 1);
  given.value = passed.value;
}
)";

TEST(DispatchRays, CallablesNestToTheirLimit) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  const auto ray_generation = bench.table({builder.ray_generation(R"(
struct Data { uint depths; uint value; };
layout(location = 0) callableDataEXT Data data;
void main() {
  data.depths = 1 << 16;
  data.value = 0;
  executeCallableEXT(0, 0);
  Words(block.arguments[0]).w[gl_LaunchIDEXT.x] = data.value;
}
)")});
  const auto callables = bench.table({builder.callable(kCallYourself)});
  const auto pipeline = bench.create(builder.pipeline());
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  rtapi::DispatchRaysDesc desc = desc_of(ray_generation, 16);
  desc.CallableShaderTable = Bench::range(callables);
  const auto out = bench.buffer(64);
  auto result = bench.rays(*pipeline, desc, {out->address(), 0, kMaxCallableDepth - 1});
  ASSERT_TRUE(result.status) << result.status.error().message;
  EXPECT_EQ(words_of(out)[15], kMaxCallableDepth - 1);
  result = bench.rays(*pipeline, desc, {out->address(), 0, 1000});
  ASSERT_FALSE(result.status);
  EXPECT_EQ(result.status.error().id.text(), "KA0891");
}

TEST(StateObject, ShadersWithoutSpirvAreNamed) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  builder.record(RecordKind::kRayGeneration, builder.native_shader(shader::Stage::kRayGeneration));
  const auto pipeline = bench.create(builder.pipeline());
  ASSERT_FALSE(pipeline);
  EXPECT_EQ(pipeline.error().id.text(), "KA0954");
  EXPECT_THAT(pipeline.error().message, HasSubstr("\"native\""));
  EXPECT_THAT(pipeline.error().message, HasSubstr("test.hlsl"));
}

TEST(StateObject, HitObjectsNeedTwinsOfWhatTheyRun) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  builder.ray_generation("// uses hit objects\nvoid main() {}\n");
  builder.miss("void main() {}\n");
  const auto pipeline = bench.create(builder.pipeline());
  ASSERT_FALSE(pipeline);
  EXPECT_EQ(pipeline.error().id.text(), "KA0968");
  EXPECT_THAT(pipeline.error().message, HasSubstr("\"shader1\" of test.hlsl"));
  EXPECT_THAT(pipeline.error().message, HasSubstr("lib_6_9"));
}

TEST(StateObject, BindingsComeAsConstants) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  shader::BindingSlot slot;
  slot.source = shader::SlotSource::kRootDescriptor;
  slot.local = true;
  slot.kind = shader::DescriptorKind::kStructuredBuffer;
  slot.access = shader::DescriptorAccess::kUnorderedAccess;
  slot.argument_offset = 24;
  const auto* shader = builder.shader(shader::Stage::kRayGeneration, R"(
void main() {
  Words(block.arguments[0]).w[0] = binding_source_0;
  Words(block.arguments[0]).w[1] = binding_offset_0;
})",
                                      {slot, {}});
  const auto table = bench.table({builder.record(RecordKind::kRayGeneration, shader)});
  const auto pipeline = bench.create(builder.pipeline());
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  const auto out = bench.buffer(64);
  ASSERT_TRUE(bench.rays(*pipeline, desc_of(table, 1), {out->address()}).status);
  EXPECT_EQ(words_of(out)[0], 2u | 1u << 8 | 3u << 16 | 1u << 24);
  EXPECT_EQ(words_of(out)[1], 24u);
}

}  // namespace
}  // namespace kaamos::vulkan

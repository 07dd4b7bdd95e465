// SPDX-License-Identifier: MIT
#include "runtime/hlsl/analysis/trace_calls.h"

#include <gtest/gtest.h>

#include "runtime/hlsl/check/check_test_support.h"

namespace kaamos::hlsl {
namespace {

constexpr char kLibrary[] = R"(
RaytracingAccelerationStructure scene : register(t0);
RaytracingAccelerationStructure others[2] : register(t1);
struct Payload { float value; };
static const uint kRayTypes = 2;
void trace(uint flags, uint type, uint mask) {
  RayDesc ray = (RayDesc)0;
  Payload payload = { 0.0 };
  TraceRay(scene, flags, mask, type, kRayTypes, type, ray, payload);
}
[shader("raygeneration")]
void Constant() {
  trace(RAY_FLAG_FORCE_OPAQUE | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER, 1, 0x1FF);
  trace(RAY_FLAG_NONE, 0, 3);
}
[shader("raygeneration")]
void Variable() {
  const uint miss = 0x10002;
  uint type = 0;
  if (DispatchRaysIndex().x > 3) type = 1;
  RayDesc ray = (RayDesc)0;
  Payload payload = { 0.0 };
  TraceRay(others[1], 0, DispatchRaysIndex().x, type, 17, miss, ray, payload);
  CallShader(5, payload);
  CallShader(DispatchRaysIndex().x, payload);
}
[shader("miss")]
void Miss(inout Payload payload) { payload.value = 1.0; }
)";

TEST(TraceCallsTest, ConstantsAreFollowedThroughParameters) {
  Compilation c(kLibrary);
  ASSERT_NE(c.module, nullptr) << c.messages();
  const ReachedCalls calls = collect_calls(*c.module, c.module->entry_points[0]);
  ASSERT_EQ(calls.traces.size(), 2u);
  const shader::TraceCall& first = calls.traces[0];
  EXPECT_EQ(first.known, 31u);
  EXPECT_EQ(first.binding, 0u);
  EXPECT_EQ(first.ray_flags, 9u);
  EXPECT_EQ(first.mask, 0xFFu);  // only the low 8 bits count
  EXPECT_EQ(first.ray_contribution, 1u);
  EXPECT_EQ(first.multiplier, 2u);
  EXPECT_EQ(first.miss_index, 1u);
  EXPECT_EQ(first.line, 9u);
  EXPECT_STREQ(first.file, "test.hlsl");
  EXPECT_EQ(calls.traces[1].ray_contribution, 0u);
  EXPECT_TRUE(calls.callables.empty());
}

TEST(TraceCallsTest, WhatIsNotConstantIsUnknown) {
  Compilation c(kLibrary);
  ASSERT_NE(c.module, nullptr) << c.messages();
  const ReachedCalls calls = collect_calls(*c.module, c.module->entry_points[1]);
  ASSERT_EQ(calls.traces.size(), 1u);
  const shader::TraceCall& call = calls.traces[0];
  EXPECT_EQ(call.known,
            shader::kKnowsRayFlags | shader::kKnowsMultiplier | shader::kKnowsMissIndex);
  EXPECT_EQ(call.binding, shader::kUnknownIndex);
  EXPECT_EQ(call.multiplier, 1u);
  EXPECT_EQ(call.miss_index, 2u);
  EXPECT_EQ(calls.callables, (std::vector<uint32_t>{5, shader::kUnknownIndex}));
  EXPECT_TRUE(collect_calls(*c.module, c.module->entry_points[2]).traces.empty());
}

}  // namespace
}  // namespace kaamos::hlsl

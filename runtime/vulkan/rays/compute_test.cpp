// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "runtime/vulkan/testing/harness.h"

namespace kaamos::vulkan {
namespace {

using testing::Bench;
using testing::PipelineBuilder;
using testing::words_of;

constexpr char kGroups[] = R"(
layout(local_size_x = 4, local_size_y = 2) in;
shared uint total;
void main() {
  uvec3 group = gl_WorkGroupID + uvec3(block.base[0], block.base[1], block.base[2]);
  uint at = group.x + block.dimensions[0] * (group.y + block.dimensions[1] * group.z);
  if (gl_LocalInvocationIndex == 0) total = 0;
  barrier();
  atomicAdd(total, gl_LocalInvocationIndex + at);
  barrier();
  if (gl_LocalInvocationIndex == 0) Words(block.arguments[0]).w[at] += total;
}
)";

TEST(Compute, RunsEveryGroupOnce) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  const auto pipeline = ComputePipeline::create(bench.layout, builder.compute(kGroups));
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  const GridLimits limits[] = {{}, {{2, 3, 1}, UINT64_MAX}, {{5, 1, 1}, UINT64_MAX}};
  for (const GridLimits& limit : limits) {
    bench.limits = limit;
    const auto out = bench.buffer(4 * 5 * 6 * 2);
    const auto result = bench.groups(*pipeline, 5, 6, 2, {out->address()});
    ASSERT_TRUE(result.status) << result.status.error().message;
    for (uint32_t i = 0; i < 60; ++i) ASSERT_EQ(words_of(out)[i], 28 + 8 * i);
  }
  EXPECT_TRUE(bench.groups(*pipeline, 0, 6, 2, {0}).status);
}

TEST(Compute, SeesWhatDispatchesBeforeWrote) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  const auto pipeline = ComputePipeline::create(bench.layout, builder.compute(R"(
layout(local_size_x = 64) in;
void main() {
  uint i = gl_GlobalInvocationID.x;
  Words(block.arguments[1]).w[i] = 3 * Words(block.arguments[0]).w[i] + 1;
})"));
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  const auto a = bench.buffer(4 * 256);
  const auto b = bench.buffer(4 * 256);
  uint32_t expected = 0;
  for (int i = 0; i < 4; ++i) {
    const auto& from = i % 2 == 0 ? a : b;
    const auto& to = i % 2 == 0 ? b : a;
    ASSERT_TRUE(bench.groups(*pipeline, 4, 1, 1, {from->address(), to->address()}).status);
    expected = 3 * expected + 1;
    EXPECT_EQ(words_of(to)[255], expected);
  }
}

// Equal code is compiled once; the pipelines that were made last are kept, whoever uses them.
TEST(Compute, PipelinesThatAreMadeAgainAreNotCompiledAgain) {
  KAAMOS_NEED_GPU(gpu);
  Bench bench(gpu);
  PipelineBuilder builder;
  const auto handle_of = [&](size_t number) {
    const auto pipeline = ComputePipeline::create(
        bench.layout, builder.compute("layout(local_size_x = 1) in;\nvoid main() { if "
                                      "(gl_GlobalInvocationID.x == " +
                                      std::to_string(number) + "u) barrier(); }\n"));
    return static_cast<const ComputePipeline&>(**pipeline).handle();
  };
  const VkPipeline first = handle_of(0), second = handle_of(1);
  EXPECT_NE(first, second);
  EXPECT_EQ(handle_of(0), first);
  // Now the second is the one that was asked for least recently.
  std::set<VkPipeline> others;
  for (size_t i = 2; i <= PipelineCache::kKept; ++i) others.insert(handle_of(i));
  EXPECT_EQ(others.size(), PipelineCache::kKept - 1);
  EXPECT_EQ(others.count(first), 0u);
  EXPECT_EQ(handle_of(0), first);
  EXPECT_EQ(handle_of(PipelineCache::kKept), handle_of(PipelineCache::kKept));
}

}  // namespace
}  // namespace kaamos::vulkan

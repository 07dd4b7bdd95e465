// SPDX-License-Identifier: MIT
#include "runtime/embree/compute.h"

#include <gtest/gtest.h>

#include <numeric>

#include "runtime/embree/testing/harness.h"

namespace kaamos::embree {
namespace {

using testing::Harness;

struct Kernel {
  shader::ComputeDesc compute = {};
  shader::ExportDesc code = {};
  std::shared_ptr<runtime::LinkedCompute> linked = std::make_shared<runtime::LinkedCompute>();

  rtapi::Status run(Harness& h, uint32_t x, uint32_t y, uint32_t z, const void* root,
                    size_t root_bytes) {
    code.name = "kernel";
    code.stage = shader::Stage::kCompute;
    code.compute = &compute;
    linked->shader.name = "kernel";
    linked->shader.code = &code;
    auto pipeline = h.device().create_compute_pipeline(linked);
    EXPECT_TRUE(pipeline.ok());
    runtime::DispatchCommand command;
    command.pipeline = *pipeline;
    auto arguments = std::make_shared<runtime::RootArguments>();
    std::memcpy(arguments->bytes.data(), root, root_bytes);
    command.state.root_arguments = arguments;
    command.groups[0] = x;
    command.groups[1] = y;
    command.groups[2] = z;
    return h.execute(command);
  }
};

template <typename T>
T root_of(const shader::Invocation& invocation) {
  T value;
  std::memcpy(&value, invocation.dispatch->root_arguments, sizeof(value));
  return value;
}

TEST(Compute, EachGroupRunsOnce) {
  Harness h(2);
  Kernel kernel;
  kernel.compute.thread_group[0] = 4;
  kernel.compute.thread_group[1] = kernel.compute.thread_group[2] = 1;
  kernel.compute.group = [](shader::Invocation& invocation, shader::ComputeGroup& group) {
    auto* counts = root_of<uint32_t*>(invocation);
    const uint32_t* size = invocation.dispatch->dimensions;
    ++counts[(group.group_id[2] * size[1] + group.group_id[1]) * size[0] + group.group_id[0]];
  };
  std::vector<uint32_t> counts(5 * 7 * 3, 0);
  const uint32_t* root = counts.data();
  ASSERT_TRUE(kernel.run(h, 5, 7, 3, &root, sizeof(root)).ok());
  for (const uint32_t count : counts) EXPECT_EQ(count, 1u);
  EXPECT_TRUE(kernel.run(h, 5, 0, 3, &root, sizeof(root)).ok());
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0u), 105u);
}

// Sums 64 values by halving, with a barrier after each step.
void sum_by_halves(shader::Invocation& invocation, shader::ComputeGroup& group,
                   const uint32_t thread_id[3]) {
  auto* shared = static_cast<uint32_t*>(group.shared);
  EXPECT_EQ(shared[100 + thread_id[0]], 0u);  // groupshared memory starts at zero
  shared[100 + thread_id[0]] = 1;
  shared[thread_id[0]] = thread_id[0] + 1000 * group.group_id[0];
  for (uint32_t half = 32; half != 0; half /= 2) {
    invocation.dispatch->services->group_barrier(group);
    if (thread_id[0] < half) shared[thread_id[0]] += shared[thread_id[0] + half];
  }
  invocation.dispatch->services->group_barrier(group);
  if (thread_id[0] == 0) root_of<uint32_t*>(invocation)[group.group_id[0]] = shared[0];
}

TEST(Compute, BarriersHoldOnFibers) {
  for (const uint32_t threads : {1u, 2u}) {
    Harness h(threads);
    Kernel kernel;
    kernel.compute.thread_group[0] = 64;
    kernel.compute.thread_group[1] = kernel.compute.thread_group[2] = 1;
    kernel.compute.shared_bytes = 4 * 200;
    kernel.compute.thread = sum_by_halves;
    std::vector<uint32_t> sums(20, 0);
    const uint32_t* root = sums.data();
    ASSERT_TRUE(kernel.run(h, 20, 1, 1, &root, sizeof(root)).ok());
    for (uint32_t i = 0; i < 20; ++i) EXPECT_EQ(sums[i], 63 * 64 / 2 + 64000 * i);
  }
}

TEST(Compute, ThreadIdsCoverTheGroup) {
  Harness h;
  Kernel kernel;
  kernel.compute.thread_group[0] = 3;
  kernel.compute.thread_group[1] = 4;
  kernel.compute.thread_group[2] = 5;
  kernel.compute.thread = [](shader::Invocation& invocation, shader::ComputeGroup&,
                             const uint32_t id[3]) {
    ++root_of<uint32_t*>(invocation)[(id[2] * 4 + id[1]) * 3 + id[0]];
  };
  std::vector<uint32_t> counts(60, 0);
  const uint32_t* root = counts.data();
  ASSERT_TRUE(kernel.run(h, 1, 1, 1, &root, sizeof(root)).ok());
  for (const uint32_t count : counts) EXPECT_EQ(count, 1u);
}

TEST(Compute, AThreadThatEndsBeforeABarrierHoldsNobodyUp) {
  Harness h;
  Kernel kernel;
  kernel.compute.thread_group[0] = 8;
  kernel.compute.thread_group[1] = kernel.compute.thread_group[2] = 1;
  kernel.compute.thread = [](shader::Invocation& invocation, shader::ComputeGroup& group,
                             const uint32_t id[3]) {
    if (id[0] % 2 == 0) return;
    invocation.dispatch->services->group_barrier(group);
    ++root_of<uint32_t*>(invocation)[id[0]];
  };
  std::vector<uint32_t> counts(8, 0);
  const uint32_t* root = counts.data();
  ASSERT_TRUE(kernel.run(h, 1, 1, 1, &root, sizeof(root)).ok());
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0u), 4u);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Keeps a frame per call: no tail call, no inlining.
__attribute__((noinline)) uint32_t deeper(uint32_t depth) {
  volatile uint8_t frame[512];
  frame[depth % 512] = static_cast<uint8_t>(depth);
  return depth == 0xFFFFFFFF ? 0 : deeper(depth + 1) + frame[depth % 512];
}

TEST(Compute, AFibersStackMayOverflow) {
  Harness h;
  Kernel kernel;
  kernel.compute.thread_group[0] = 4;
  kernel.compute.thread_group[1] = kernel.compute.thread_group[2] = 1;
  kernel.compute.thread = [](shader::Invocation&, shader::ComputeGroup&, const uint32_t[3]) {
    deeper(0);
  };
  const uint64_t root = 0;
  const auto status = kernel.run(h, 1, 1, 1, &root, sizeof(root));
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0891") << status.error().message;
}

TEST(Compute, AFaultOnAFiberEndsTheGroup) {
  Harness h(2);
  Kernel kernel;
  kernel.compute.thread_group[0] = 16;
  kernel.compute.thread_group[1] = kernel.compute.thread_group[2] = 1;
  kernel.compute.thread = [](shader::Invocation& invocation, shader::ComputeGroup& group,
                             const uint32_t id[3]) {
    invocation.dispatch->services->group_barrier(group);
    auto* volatile nowhere = reinterpret_cast<uint32_t*>(uint64_t{0x30000});
    if (id[0] == 5) *nowhere = 1;
    invocation.dispatch->services->group_barrier(group);
    ++root_of<uint32_t*>(invocation)[id[0]];
  };
  std::vector<uint32_t> counts(16, 0);
  const uint32_t* root = counts.data();
  for (int i = 0; i < 20; ++i) {
    const auto status = kernel.run(h, 3, 1, 1, &root, sizeof(root));
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().id.text(), "KA0892");
    EXPECT_NE(status.error().message.find("\"kernel\""), std::string::npos);
  }
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0u), 0u);
}
#endif

}  // namespace
}  // namespace kaamos::embree

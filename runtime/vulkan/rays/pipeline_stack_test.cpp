// SPDX-License-Identifier: MIT
#include "runtime/vulkan/rays/pipeline_stack.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>

namespace kaamos::vulkan {
namespace {

// With a stack of 8 MiB, 64 KiB payloads at depth 31 end the process, 16 KiB ones do not
// (tests/vulkan/driver_stress).
TEST(PipelineStack, LargePayloadsNestLessDeep) {
  constexpr uint64_t kStack = 8u << 20;
  EXPECT_EQ(nested_payload_limit(64 << 10, kStack), 5u);
  EXPECT_EQ(nested_payload_limit(16 << 10, kStack), 23u);
  EXPECT_GE(nested_payload_limit(4 << 10, kStack), 31u);
  EXPECT_GE(nested_payload_limit(0, kStack), 31u);
  EXPECT_EQ(nested_payload_limit(4 << 10, 1 << 20), 11u);
  EXPECT_GE(default_thread_stack_bytes(), 16u << 10);
  runtime::LinkedPipeline pipeline;
  EXPECT_EQ(largest_payload(pipeline), 0u);
  shader::ExportDesc code = {};
  code.payload_storage_bytes = 128;
  auto shader = std::make_unique<runtime::LinkedShader>();
  shader->code = &code;
  pipeline.shaders.push_back(std::move(shader));
  EXPECT_EQ(largest_payload(pipeline), 128u);
}

}  // namespace
}  // namespace kaamos::vulkan

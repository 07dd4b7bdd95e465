// SPDX-License-Identifier: MIT
#include "runtime/vulkan/device.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "runtime/vulkan/testing/harness.h"

namespace kaamos::vulkan {
namespace {

using ::testing::HasSubstr;
using testing::PipelineBuilder;
using testing::words_of;

struct Made {
  explicit Made(const rtapi::DeviceDesc& desc = {.Backend = "vulkan"}) {
    context.addresses = &addresses;
    context.message = [this](const rtapi::Message& message) { messages.push_back(message); };
    auto made = backend_factory().create(desc, context);
    if (made) {
      device = *std::move(made);
    } else {
      error = made.error();
    }
  }
  std::shared_ptr<runtime::BackendBuffer> buffer(uint64_t size_bytes) {
    rtapi::BufferDesc desc;
    desc.SizeInBytes = size_bytes;
    return device->create_buffer(desc).value();
  }
  runtime::AddressMap addresses;
  runtime::Context context;
  std::vector<rtapi::Message> messages;
  rtapi::Error error;
  std::unique_ptr<runtime::BackendDevice> device;
};

runtime::CopyBufferCommand copy(const std::shared_ptr<runtime::BackendBuffer>& dest,
                                uint64_t dest_offset,
                                const std::shared_ptr<runtime::BackendBuffer>& source,
                                uint64_t source_offset, uint64_t size_bytes) {
  runtime::CopyBufferCommand command;
  command.dest = dest;
  command.dest_offset = dest_offset;
  command.source = source;
  command.source_offset = source_offset;
  command.size_bytes = size_bytes;
  return command;
}

runtime::DispatchCommand dispatch(const std::shared_ptr<runtime::BackendPipeline>& pipeline,
                                  const std::vector<uint64_t>& arguments) {
  auto root = std::make_shared<runtime::RootArguments>();
  std::copy(arguments.begin(), arguments.end(), reinterpret_cast<uint64_t*>(root->bytes.data()));
  runtime::DispatchCommand command;
  command.pipeline = pipeline;
  command.state.root_arguments = root;
  command.groups[0] = command.groups[1] = command.groups[2] = 1;
  return command;
}

TEST(VulkanDevice, SaysWhatItIsAndWhatItLacks) {
  KAAMOS_NEED_GPU(gpu);
  setenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS", "B12", 1);
  Made made({.Backend = "vulkan"});
  unsetenv("KAAMOS_VULKAN_DISABLE_WORKAROUNDS");
  ASSERT_TRUE(made.device) << made.error.message;
  EXPECT_EQ(made.device->info().Backend, "vulkan");
  EXPECT_EQ(made.device->info().Name, gpu->info().Name);
  ASSERT_EQ(made.messages.size(), 1u);
  EXPECT_EQ(made.messages[0].Id.text(), "KA0957");
  EXPECT_THAT(made.messages[0].Text, HasSubstr("\"B12\""));
  Made exact({.Backend = "vulkan", .Precision = rtapi::TraversalPrecision::kExact});
  EXPECT_EQ(exact.error.id.text(), "KA0991");
}

TEST(VulkanDevice, CopiesAndDispatchesHappenInOrder) {
  KAAMOS_NEED_GPU(gpu);
  Made made;
  ASSERT_TRUE(made.device) << made.error.message;
  PipelineBuilder builder;
  auto pipeline = made.device->create_compute_pipeline(builder.compute(R"(
layout(local_size_x = 64) in;
void main() {
  uint i = gl_LocalInvocationIndex;
  Words(block.arguments[1]).w[i] = 2 * Words(block.arguments[0]).w[i];
})"));
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  const auto a = made.buffer(256);
  const auto b = made.buffer(256);
  const auto c = made.buffer(256);
  for (uint32_t i = 0; i < 64; ++i) words_of(a)[i] = i;
  const std::vector<runtime::Command> commands = {
      copy(b, 0, a, 0, 256),     copy(a, 0, c, 0, 128),  // not before it has been read
      runtime::BarrierCommand{}, dispatch(*pipeline, {b->address(), c->address()}),
      copy(b, 4, b, 0, 252),  // overlaps
      copy(a, 0, c, 128, 128),   copy(c, 0, c, 0, 0),
  };
  const auto status = made.device->execute(commands);
  ASSERT_TRUE(status) << status.error().message;
  for (uint32_t i = 0; i < 64; ++i) {
    EXPECT_EQ(words_of(a)[i], i < 32 ? 2 * (i + 32) : i);
    EXPECT_EQ(words_of(b)[i], i == 0 ? 0 : i - 1);
    EXPECT_EQ(words_of(c)[i], 2 * i);
  }
}

TEST(VulkanDevice, AnErrorNamesTheCommandAndItsEvent) {
  KAAMOS_NEED_GPU(gpu);
  Made made;
  ASSERT_TRUE(made.device) << made.error.message;
  PipelineBuilder builder;
  auto pipeline = made.device->create_compute_pipeline(builder.compute(R"(
layout(local_size_x = 1) in;
void main() { Words(block.status).w[0] = 4; }
)"));
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  const auto a = made.buffer(256);
  const auto b = made.buffer(256);
  words_of(a)[0] = 5;
  const std::vector<runtime::Command> commands = {
      runtime::EventCommand{true, "frame"}, copy(b, 0, a, 0, 256), runtime::EventCommand{true, "x"},
      runtime::EventCommand{false, ""}, dispatch(*pipeline, {})};
  const auto status = made.device->execute(commands);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().id.text(), "KA0893");
  EXPECT_EQ(status.error().code, rtapi::ErrorCode::kDeviceRemoved);
  EXPECT_THAT(status.error().message, HasSubstr("(Dispatch, command 4 in \"frame\")"));
  EXPECT_EQ(words_of(b)[0], 5u);
}

TEST(VulkanDevice, BuffersAndPipelinesMayOutliveIt) {
  KAAMOS_NEED_GPU(gpu);
  gpu.reset();
  Made made;
  ASSERT_TRUE(made.device) << made.error.message;
  PipelineBuilder builder;
  const auto buffer = made.buffer(256);
  auto pipeline = made.device->create_compute_pipeline(
      builder.compute("layout(local_size_x = 1) in; void main() {}"));
  ASSERT_TRUE(pipeline) << pipeline.error().message;
  made.device.reset();
  words_of(buffer)[63] = 1;
}

}  // namespace
}  // namespace kaamos::vulkan

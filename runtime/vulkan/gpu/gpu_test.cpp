// SPDX-License-Identifier: MIT
#include "runtime/vulkan/gpu/gpu.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "runtime/vulkan/testing/vulkan_device.h"

namespace kaamos::vulkan {
namespace {

TEST(Gpu, ListsDevicesThatCanBeMade) {
  KAAMOS_NEED_GPU(gpu);
  const auto infos = Gpu::enumerate();
  ASSERT_FALSE(infos.empty());
  EXPECT_EQ(infos[0].Backend, "vulkan");
  EXPECT_EQ(infos[0].Name, gpu->info().Name);
  EXPECT_NE(gpu->properties().ray_tracing.shaderGroupHandleSize, 0u);
}

TEST(Gpu, NoDeviceOfThatNameListsThoseThereAre) {
  KAAMOS_NEED_GPU(gpu);
  const auto none = Gpu::create("no such device");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().id.text(), "KA0953");
  EXPECT_NE(none.error().message.find(gpu->info().Name), std::string::npos);
}

TEST(Gpu, BuffersAreZeroAlignedAndMapped) {
  KAAMOS_NEED_GPU(gpu);
  for (uint64_t size : {uint64_t{1}, uint64_t{1000}, uint64_t{70000}, uint64_t{1} << 22}) {
    auto buffer = gpu->create_buffer(size, "test");
    ASSERT_TRUE(buffer) << buffer.error().message;
    EXPECT_EQ((*buffer)->address() % 65536, 0u);
    EXPECT_EQ((*buffer)->size_bytes(), size);
    for (uint64_t i = 0; i < size; i += 997) ASSERT_EQ((*buffer)->host()[i], 0);
    if (gpu->is_lavapipe()) {
      EXPECT_EQ((*buffer)->address(), reinterpret_cast<uint64_t>((*buffer)->host()));
    }
  }
}

TEST(Gpu, LargeBuffersCostNothingUntilTheyAreUsed) {
  KAAMOS_NEED_GPU(gpu);
  if (!gpu->is_lavapipe()) GTEST_SKIP() << "memory of the device";
  std::vector<std::unique_ptr<GpuBuffer>> buffers;
  for (int i = 0; i < 40; ++i) {  // 40 GiB
    auto buffer = gpu->create_buffer(uint64_t{1} << 30, "large");
    ASSERT_TRUE(buffer) << buffer.error().message;
    EXPECT_EQ((*buffer)->address() % 65536, 0u);
    EXPECT_EQ((*buffer)->host()[123456789], 0);
    buffers.push_back(*std::move(buffer));
  }
}

TEST(Gpu, TooMuchMemoryIsAnErrorThatNamesIt) {
  KAAMOS_NEED_GPU(gpu);
  const auto buffer = gpu->create_buffer(uint64_t{1} << 60, "the huge buffer");
  ASSERT_FALSE(buffer);
  EXPECT_EQ(buffer.error().id.text(), "KA0956");
  EXPECT_EQ(buffer.error().code, rtapi::ErrorCode::kOutOfMemory);
  EXPECT_NE(buffer.error().message.find("the huge buffer"), std::string::npos);
  EXPECT_NE(buffer.error().message.find("1152921504606846976"), std::string::npos);
}

TEST(Gpu, RunCopiesOnTheQueue) {
  KAAMOS_NEED_GPU(gpu);
  auto from = gpu->create_buffer(4096, "source");
  auto to = gpu->create_buffer(4096, "destination");
  ASSERT_TRUE(from && to);
  std::memset((*from)->host(), 0x5A, 4096);
  for (int i = 0; i < 3; ++i) {
    std::memset((*to)->host(), i, 4096);
    const auto status = gpu->run(
        [&](VkCommandBuffer commands) {
          const VkBufferCopy region = {(*from)->offset(), (*to)->offset() + 16, 1024};
          gpu->vk().vkCmdCopyBuffer(commands, (*from)->handle(), (*to)->handle(), 1, &region);
        },
        "a copy");
    ASSERT_TRUE(status) << status.error().message;
    EXPECT_EQ((*to)->host()[15], i);
    EXPECT_EQ((*to)->host()[16], 0x5A);
    EXPECT_EQ((*to)->host()[1039], 0x5A);
    EXPECT_EQ((*to)->host()[1040], i);
  }
}

TEST(Gpu, ALostDeviceSaysWhatRan) {
  KAAMOS_NEED_GPU(gpu);
  const auto lost = gpu->error(VK_ERROR_DEVICE_LOST, "DispatchRays, command 3");
  EXPECT_EQ(lost.id.text(), "KA0955");
  EXPECT_EQ(lost.code, rtapi::ErrorCode::kDeviceRemoved);
  EXPECT_NE(lost.message.find("DispatchRays, command 3"), std::string::npos);
  EXPECT_NE(lost.message.find(gpu->info().Name), std::string::npos);
}

// In a process of its own, whose loader finds no driver.
TEST(Gpu, WithoutADriverThePackageIsNamed) {
  char path[4096] = {};
  ASSERT_GT(readlink("/proc/self/exe", path, sizeof(path) - 1), 0);
  const std::string command = std::string(
                                  "KAAMOS_REQUIRE_VULKAN=0 VK_DRIVER_FILES=/none "
                                  "VK_ICD_FILENAMES=/none '") +
                              path + "' --gtest_filter='Gpu.ListsDevicesThatCanBeMade' 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string text;
  char line[512];
  while (fgets(line, sizeof(line), pipe) != nullptr) text += line;
  EXPECT_EQ(pclose(pipe), 0);  // the child skips its test
  EXPECT_NE(text.find("KA0950"), std::string::npos) << text;
  EXPECT_NE(text.find("mesa-vulkan-drivers"), std::string::npos) << text;
}

TEST(Gpu, DevicesComeAndGo) {
  for (int i = 0; i < 3; ++i) {
    KAAMOS_NEED_GPU(gpu);
    auto buffer = gpu->create_buffer(64, "left over");
    ASSERT_TRUE(buffer);
    gpu.reset();  // the buffer keeps the device alive
    (*buffer)->host()[0] = 1;
  }
}

}  // namespace
}  // namespace kaamos::vulkan

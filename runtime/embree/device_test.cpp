// SPDX-License-Identifier: MIT
#include "runtime/embree/device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "runtime/embree/testing/harness.h"

namespace kaamos::embree {
namespace {

rtapi::Result<std::unique_ptr<runtime::BackendDevice>> create(rtapi::TraversalPrecision precision) {
  static const runtime::AddressMap addresses;
  const runtime::Context context = {&addresses, [](const rtapi::Message&) {}};
  rtapi::DeviceDesc desc;
  desc.Precision = precision;
  return backend_factory().create(desc, context);
}

TEST(Device, SaysWhatItIs) {
  const auto devices = backend_factory().enumerate();
  ASSERT_EQ(devices.size(), 1u);
  EXPECT_EQ(devices[0].Backend, "embree");
  EXPECT_NE(devices[0].Name.find("Embree " + std::to_string(RTC_VERSION_MAJOR)), std::string::npos);
  EXPECT_GT(devices[0].HardwareThreads, 0u);
}

TEST(Device, ComesInEachPrecision) {
  EXPECT_TRUE(create(rtapi::TraversalPrecision::kFast).ok());
  EXPECT_TRUE(create(rtapi::TraversalPrecision::kRobust).ok());
  EXPECT_TRUE(create(rtapi::TraversalPrecision::kExact).ok());
}

TEST(Device, FormatsAreThoseOfTheTextureLibrary) {
  const auto device = create(rtapi::TraversalPrecision::kRobust);
  ASSERT_TRUE(device.ok());
  EXPECT_TRUE((*device)->supports_format(rtapi::Format::kR32G32B32A32Float, true));
  EXPECT_TRUE((*device)->supports_format(rtapi::Format::kR8G8B8A8UnormSrgb, false));
  EXPECT_FALSE((*device)->supports_format(rtapi::Format::kR8G8B8A8UnormSrgb, true));
  EXPECT_TRUE((*device)->supports_format(rtapi::Format::kBC7Unorm, false));
  EXPECT_FALSE((*device)->supports_format(rtapi::Format::kBC7Unorm, true));
  EXPECT_FALSE((*device)->supports_format(rtapi::Format::kD32Float, false));
}

TEST(Device, ABufferIsZeroAndAligned) {
  const auto device = create(rtapi::TraversalPrecision::kRobust);
  ASSERT_TRUE(device.ok());
  for (const uint64_t bytes : {uint64_t{1}, uint64_t{70000}, uint64_t{5} << 20}) {
    rtapi::BufferDesc desc;
    desc.SizeInBytes = bytes;
    const auto buffer = (*device)->create_buffer(desc);
    ASSERT_TRUE(buffer.ok());
    EXPECT_EQ((*buffer)->address() % 65536, 0u);
    EXPECT_EQ((*buffer)->size_bytes(), bytes);
    const uint8_t* host = (*buffer)->host();
    EXPECT_TRUE(std::all_of(host, host + bytes, [](uint8_t value) { return value == 0; }));
    std::memset((*buffer)->host(), 0xFF, bytes);
  }
  rtapi::BufferDesc desc;
  desc.SizeInBytes = uint64_t{1} << 62;
  const auto buffer = (*device)->create_buffer(desc);
  ASSERT_FALSE(buffer.ok());
  EXPECT_EQ(buffer.error().code, rtapi::ErrorCode::kOutOfMemory);
}

// An application may hold buffers and textures for longer than their device.
TEST(Device, ResourcesMayOutliveIt) {
  auto device = create(rtapi::TraversalPrecision::kRobust);
  ASSERT_TRUE(device.ok());
  rtapi::BufferDesc buffer_desc;
  buffer_desc.SizeInBytes = 100;
  auto buffer = *(*device)->create_buffer(buffer_desc);
  rtapi::TextureDesc texture_desc;
  texture_desc.Format = rtapi::Format::kR32Float;
  auto texture = *(*device)->create_texture(texture_desc);
  (*device)->create_texture_view(*texture, {.format = rtapi::Format::kR32Float}).value();
  (*device).reset();
  buffer->host()[99] = 1;
  buffer.reset();
  texture.reset();
}

}  // namespace
}  // namespace kaamos::embree

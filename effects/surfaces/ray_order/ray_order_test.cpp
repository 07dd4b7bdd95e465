// SPDX-License-Identifier: MIT
// Sorting rays does not change the picture, and the rays really are sorted.
#include "effects/surfaces/ray_order/ray_order.h"

#include <gtest/gtest.h>
#include <rtapi/upload.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <set>
#include <vector>

#include "effects/assets/built_in/lounge.h"
#include "effects/engine/frame_fixture.h"
#include "effects/engine/picture.h"
#include "effects/engine/sums_fixture.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/indirect/indirect_diffuse/volume.h"
#include "effects/light/lights/lighting.h"
#include "effects/occlusion/ambient_occlusion/ambient_occlusion.h"
#include "effects/reflections/traced/reflections.h"
#include "effects/shadows/sun_shadow/sun_shadow.h"
#include "effects/surfaces/gbuffer/gbuffer.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {
namespace {

// No multiple of a tile or block: 2 x 2 tiles, the last ones cut off.
constexpr std::uint32_t kWidth = 91;
constexpr std::uint32_t kHeight = 139;

// A frame with its G-buffer, and a pass that adds to one picture.
struct Bench : FrameStage {
  explicit Bench(const rtapi::DeviceDesc& desc) : FrameStage(make_lounge(), kWidth, kHeight, desc) {
    lighting = Lighting::create(device, frame, gpu, lighting_library().value(), 0).value();
    volume = GpuVolume::create(device, {}, scene.cameras.front().position()).value();
    const RayPass gbuffer = make_pass(gbuffer_pass(gbuffer_library().value()));
    FrameStage::run([&](rtapi::CommandList& list) {
      gbuffer.dispatch(list, frame, {}, kHeight);
      lighting->update(list, frame);
    });
  }

  // Two samples of the pass, in two bands of rows. It writes u0 of space3, and visibility,
  // which has no constants, may write u1.
  template <class Constants>
  FloatImage run(const RayPassDesc& desc, const Constants* constants, RayOrder order,
                 const RaySorter& sorter) {
    const RayPass keys = RayPass::create(device, frame, gpu, key_pass(desc)).value();
    const RayPass pass = RayPass::create(device, frame, gpu, desc).value();
    const SunSums visibility(device, frame);
    rtapi::Texture picture = visibility.visible;
    PassViews views;
    PassArguments arguments = visibility.arguments();
    if (constants != nullptr) {
      picture = frame.create_picture(device, "sum", rtapi::Format::kR32G32B32A32Float).value();
      views = frame.create_pass_views(device).value();
      views.set_unordered_access(0, picture).value();
      lighting->bind(views).value();
      volume.bind(views).value();
      arguments = {views, *constants};
    }
    rtapi::CommandList list = device.CreateCommandList().value();
    PassConstants pass_constants;
    pass_constants.accumulate = 0;
    pass_constants.sample_count = 2;
    pass_constants.radius = 4;
    if (order != RayOrder::kPixels) {
      keys.dispatch(list, frame, pass_constants, kHeight, arguments);
      sorter.sort(list, frame, order);
      pass_constants.sorted = 1;
    }
    constexpr std::uint32_t kBand = 50;
    pass.dispatch(list, frame, pass_constants, kBand, arguments);
    pass_constants.first_row = kBand;
    pass.dispatch(list, frame, pass_constants, kHeight - kBand, arguments);
    queue.ExecuteAndWait(list).value();
    return read_picture(device, queue, picture).value();
  }

  template <class Constants>
  void expect_same(const RayPassDesc& desc, const Constants* constants) {
    const RaySorter sorter = RaySorter::create(device, frame, ray_order_library().value()).value();
    const FloatImage plain = run(desc, constants, RayOrder::kPixels, sorter);
    const auto written = std::count_if(plain.values.begin(), plain.values.end(),
                                       [](float value) { return value != 0; });
    EXPECT_GT(written, kWidth * kHeight / 4) << desc.name << " gives next to nothing";
    for (const RayOrder order : {RayOrder::kDirection, RayOrder::kOrigin, RayOrder::kTermination}) {
      const FloatImage sorted = run(desc, constants, order, sorter);
      EXPECT_EQ(0, std::memcmp(plain.values.data(), sorted.values.data(),
                               plain.values.size() * sizeof(float)))
          << desc.name;
    }
  }

  std::optional<Lighting> lighting;
  GpuVolume volume;
};

constexpr const ReflectionConstants* kNone = nullptr;

void expect_same_visibility(Bench& bench) {
  bench.expect_same(ambient_occlusion_pass(ambient_occlusion_library().value()), kNone);
  bench.expect_same(sun_shadow_pass(sun_shadow_library().value()), kNone);
}

TEST(RayOrder, PicturesAreTheSameBitForBit) {
  Bench bench({});
  expect_same_visibility(bench);
  const ReflectionConstants reflection;
  bench.expect_same(reflections_pass(reflections_library().value()), &reflection);
  const IndirectConstants indirect;
  bench.expect_same(indirect_diffuse_pass(indirect_diffuse_library().value()), &indirect);
}

TEST(RayOrder, PicturesAreTheSameBitForBitOnVulkan) {
  KAAMOS_NEED_VULKAN();
  rtapi::DeviceDesc desc;
  desc.Backend = "vulkan";
  Bench bench(desc);
  expect_same_visibility(bench);
}

TEST(RayOrder, CheckedModeFindsNothing) {
  std::vector<std::string> told;
  rtapi::DeviceDesc desc;
  desc.Checked = true;
  desc.OnMessage = [&](const rtapi::Message& message) { told.push_back(message.Text); };
  Bench bench(desc);
  const RaySorter sorter =
      RaySorter::create(bench.device, bench.frame, ray_order_library().value()).value();
  for (const RayOrder order : {RayOrder::kDirection, RayOrder::kOrigin, RayOrder::kTermination}) {
    bench.run(ambient_occlusion_pass(ambient_occlusion_library().value()), kNone, order, sorter);
  }
  for (const std::string& text : told) ADD_FAILURE() << text;
}

// The order that sorting by `words`, one per pixel, results in.
std::vector<std::uint32_t> sorted_pixels(Bench& bench, const std::vector<std::uint32_t>& words,
                                         RayOrder order) {
  const RaySorter sorter =
      RaySorter::create(bench.device, bench.frame, ray_order_library().value()).value();
  const rtapi::Buffer keys = rtapi::CreateUploadBuffer(bench.device, words, "keys").value();
  rtapi::BufferDesc desc;
  desc.SizeInBytes = keys.size();
  desc.Heap = rtapi::HeapType::kReadback;
  const rtapi::Buffer read = bench.device.CreateBuffer(desc).value();
  rtapi::CommandList list = bench.device.CreateCommandList().value();
  list.CopyBufferRegion(sorter.keys(), 0, keys, 0, keys.size());
  list.ResourceBarrier(rtapi::ResourceBarrier::Uav());
  sorter.sort(list, bench.frame, order);
  list.CopyBufferRegion(read, 0, sorter.order(), 0, read.size());
  bench.queue.ExecuteAndWait(list).value();
  std::vector<std::uint32_t> pixels(words.size());
  std::memcpy(pixels.data(), read.Map().value().data(), read.size());
  return pixels;
}

// The pixels of one tile, in the order in which its blocks of 16 x 16 places run.
std::vector<std::uint32_t> in_tile(const std::vector<std::uint32_t>& pixels, std::uint32_t left,
                                   std::uint32_t top) {
  const std::uint32_t right = std::min(left + 64, kWidth);
  const std::uint32_t bottom = std::min(top + 128, kHeight);
  std::vector<std::uint32_t> out;
  for (std::uint32_t y = top; y < bottom; y += 16) {
    for (std::uint32_t x = left; x < right; x += 16) {
      for (std::uint32_t v = y; v < std::min(y + 16, bottom); ++v) {
        for (std::uint32_t u = x; u < std::min(x + 16, right); ++u) {
          out.push_back(pixels[v * kWidth + u]);
        }
      }
    }
  }
  return out;
}

TEST(RayOrder, TilesAreSortedAndWhole) {
  Bench bench({});
  std::vector<std::uint32_t> keys(kWidth * kHeight);
  std::uint32_t state = 1;
  for (std::uint32_t& key : keys) key = (state = state * 1664525u + 1013904223u) >> 8;
  for (const RayOrder order : {RayOrder::kDirection, RayOrder::kOrigin, RayOrder::kTermination}) {
    // Direction; origin and direction; origin and end.
    const auto rank = [&](std::uint32_t key) {
      if (order == RayOrder::kDirection) return key & 0xFF;
      if (order == RayOrder::kOrigin) return key & 0xFFFF;
      return (key & 0xFF00) | (key >> 16);
    };
    const std::vector<std::uint32_t> pixels = sorted_pixels(bench, keys, order);
    std::set<std::uint32_t> seen(pixels.begin(), pixels.end());
    EXPECT_EQ(seen.size(), keys.size()) << "each pixel once";
    for (const std::uint32_t top : {0u, 128u}) {
      for (const std::uint32_t left : {0u, 64u}) {
        std::uint32_t before = 0;
        for (const std::uint32_t pixel : in_tile(pixels, left, top)) {
          const std::uint32_t x = pixel & 0xFFFF;
          const std::uint32_t y = pixel >> 16;
          ASSERT_TRUE(x / 64 * 64 == left && y / 128 * 128 == top) << x << ", " << y;
          const std::uint32_t key = rank(keys[y * kWidth + x]);
          ASSERT_GE(key, before) << "tile at " << left << ", " << top;
          before = key;
        }
      }
    }
  }
}

}  // namespace
}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
//
// Draws that meet the driver faults which the Vulkan backend works around, on both backends; and
// that each fault is there without its workaround. [runtime/vulkan/draws/README.md]
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>

#include "canvas.h"
#include "tests/vulkan/support.h"

namespace kaamos::draws {
namespace {

using namespace rtapi;

constexpr char kDisable[] = "KAAMOS_VULKAN_DISABLE_WORKAROUNDS";

// Devices made meanwhile do not have these workarounds.
class Without {
 public:
  explicit Without(const char* names) { setenv(kDisable, names, 1); }
  ~Without() { unsetenv(kDisable); }
  Without(const Without&) = delete;
  Without& operator=(const Without&) = delete;
};

std::array<uint32_t, 2> counts(Canvas& canvas) {
  const auto bytes = ReadbackBuffer(canvas.device, canvas.queue, canvas.counter).value();
  std::array<uint32_t, 2> out;
  std::memcpy(out.data(), bytes.data(), sizeof out);
  return out;
}

constexpr uint32_t kLarge = 128;  // more than a tile

// Ten draws that count their pixels, then one that covers them all.
uint32_t counted_below(Canvas& canvas) {
  const Texture large = canvas.device
                            .CreateTexture({.Width = kLarge,
                                            .Height = kLarge,
                                            .Format = Format::kR32G32B32A32Float,
                                            .Flags = ResourceFlags::kAllowRenderTarget,
                                            .InitialState = ResourceStates::kRenderTarget})
                            .value();
  const DescriptorHeap rtvs =
      canvas.device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1})
          .value();
  const CpuDescriptorHandle target = rtvs.GetCPUDescriptorHandle(0);
  canvas.device.CreateRenderTargetView(large, target).value();
  const auto make = [&](const char* pixel) {
    GraphicsPipelineStateDesc desc = canvas.desc("WholeTarget", pixel);
    desc.DepthStencilState.DepthEnable = false;
    desc.DSVFormat = Format::kUnknown;
    return canvas.make(desc);
  };
  const PipelineState counting = make("Counted");
  const PipelineState covering = make("Constant");
  canvas.run([&](CommandList& list) {
    list.OMSetRenderTargets(1, &target);
    list.RSSetScissorRects(Rect{0, 0, kLarge, kLarge});
    // The target is in one half of the viewport's two triangles.
    list.RSSetViewports(Viewport{0, -128, 512, 512, 0, 1});
    for (int i = 0; i < 10; ++i) {
      Canvas::use(list, counting);
      list.DrawInstanced(3, 1, 0, 0);
    }
    Canvas::use(list, covering, {7, 7, 7, 0.5f});
    list.DrawInstanced(3, 1, 0, 0);
  });
  return counts(canvas)[0];
}

// The depth that a draw at 0.5 with DepthBias 64 leaves in D16_UNORM.
uint32_t biased_depth(Canvas& canvas) {
  const Texture depth = canvas.device
                            .CreateTexture({.Width = kSize,
                                            .Height = kSize,
                                            .Format = Format::kD16Unorm,
                                            .Flags = ResourceFlags::kAllowDepthStencil,
                                            .InitialState = ResourceStates::kDepthWrite})
                            .value();
  const DescriptorHeap dsvs =
      canvas.device.CreateDescriptorHeap({.Type = DescriptorHeapType::kDsv, .NumDescriptors = 1})
          .value();
  const CpuDescriptorHandle dsv = dsvs.GetCPUDescriptorHandle(0);
  canvas.device.CreateDepthStencilView(depth, dsv).value();
  GraphicsPipelineStateDesc desc = canvas.desc("WholeTarget", "");
  desc.RTVFormats = {};
  desc.DSVFormat = Format::kD16Unorm;
  desc.RasterizerState.DepthBias = 64;
  const PipelineState pipeline = canvas.make(desc);
  canvas.run([&](CommandList& list) {
    list.ClearDepthStencilView(dsv, ClearFlags::kDepth, 1, 0);
    list.OMSetRenderTargets(0, nullptr, false, &dsv);
    Canvas::use(list, pipeline, {1, 1, 1, 0.5f});
    list.DrawInstanced(3, 1, 0, 0);
  });
  const auto texels = ReadbackTexture(canvas.device, canvas.queue, depth, 0).value();
  uint16_t value;
  std::memcpy(&value, texels.data() + 2 * (20 * kSize + 30), sizeof value);
  return value;
}

// Red of a target of 10 bits that a draw leaves there.
uint32_t ten_bits_of(Canvas& canvas, float red) {
  const PipelineState pipeline = canvas.make(canvas.desc("WholeTarget", "Constant"));
  canvas.run([&](CommandList& list) {
    Canvas::use(list, pipeline, {red, 0, 0, 0});
    list.DrawInstanced(3, 1, 0, 0);
  });
  return canvas.texel<uint32_t>(12, 13) & 1023;
}

// Returns what SV_Depth leaves in the depth buffer, in a viewport of 0.25 to 0.75.
float written_depth(Canvas& canvas, float depth) {
  GraphicsPipelineStateDesc desc = canvas.desc("WholeTarget", "DepthOfTint");
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kAlways;
  const PipelineState pipeline = canvas.make(desc);
  canvas.run([&](CommandList& list) {
    list.RSSetViewports(Viewport{0, 0, kSize, kSize, 0.25f, 0.75f});
    Canvas::use(list, pipeline, {depth, 0, 0, 0.5f});
    list.DrawInstanced(3, 1, 0, 0);
  });
  return canvas.depth(40, 41);
}

class DriverFaults : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (GetParam() != "vulkan") return;
    if (const std::string why = test::why_no_vulkan(); !why.empty()) {
      if (test::vulkan_is_required()) FAIL() << why;
      GTEST_SKIP() << why;
    }
    validation_.emplace();
  }
  // Returns what a function gives without a workaround of lavapipe; no value on other devices.
  template <class Measure>
  auto without(const char* name, Format format, const Measure& measure) {
    std::optional<decltype(measure(std::declval<Canvas&>()))> result;
    if (GetParam() != "vulkan") return result;
    const Without off(name);
    Canvas canvas(GetParam(), format);
    if (canvas.device.GetInfo().Name.find("llvmpipe") != std::string::npos)
      result = measure(canvas);
    return result;
  }

  std::optional<test::ValidationGuard> validation_;
};
INSTANTIATE_TEST_SUITE_P(Backends, DriverFaults, ::testing::Values("embree", "vulkan"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(DriverFaults, RAS_104_WhatPixelsBelowWroteToMemoryStays) {
  Canvas canvas(GetParam());
  EXPECT_EQ(counted_below(canvas), 10 * kLarge * kLarge);
  const auto fault = without("RASUAV", Format::kR32G32B32A32Float, counted_below);
  if (fault) {
    EXPECT_LT(*fault, 10 * kLarge * kLarge) << "the driver no longer needs RASUAV";
  }
}

TEST_P(DriverFaults, RAS_65_ABiasOfD16IsInItsSteps) {
  Canvas canvas(GetParam());
  EXPECT_EQ(biased_depth(canvas), 32768u + 64);
  const auto fault = without("BIAS2", Format::kR32G32B32A32Float, biased_depth);
  if (fault) {
    EXPECT_EQ(*fault, 32768u + 128) << "the driver no longer needs BIAS2";
  }
}

TEST_P(DriverFaults, RAS_113_TenBitsAreRounded) {
  Canvas canvas(GetParam(), Format::kR10G10B10A2Unorm);
  EXPECT_EQ(ten_bits_of(canvas, 0.5f), 512u);
  EXPECT_EQ(ten_bits_of(canvas, 0.4893f), 501u);    // 500.55
  EXPECT_EQ(ten_bits_of(canvas, 0.97771f), 1000u);  // 1000.2
  EXPECT_EQ(ten_bits_of(canvas, 1.0f), 1023u);
  EXPECT_EQ(ten_bits_of(canvas, 1.5f), 1023u);
  EXPECT_EQ(ten_bits_of(canvas, -1.0f), 0u);
  EXPECT_EQ(ten_bits_of(canvas, std::numeric_limits<float>::quiet_NaN()), 0u);
  const auto measure = [](Canvas& c) { return ten_bits_of(c, 0.97771f); };
  const auto fault = without("RT10", Format::kR10G10B10A2Unorm, measure);
  if (fault) {
    EXPECT_EQ(*fault, 1001u) << "the driver no longer needs RT10";
  }
}

TEST_P(DriverFaults, RAS_69_ADepthThatIsNoNumberIsTheLowerEnd) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Canvas canvas(GetParam());
  EXPECT_EQ(written_depth(canvas, nan), 0.25f);
  EXPECT_EQ(written_depth(canvas, 0.5f), 0.5f);
  EXPECT_EQ(written_depth(canvas, 2), 0.75f);
  EXPECT_EQ(written_depth(canvas, -2), 0.25f);
  const auto measure = [&](Canvas& c) { return written_depth(c, nan); };
  const auto fault = without("NANZ", Format::kR32G32B32A32Float, measure);
  if (fault) {
    EXPECT_NE(*fault, 0.25f) << "the driver no longer needs NANZ";
  }
}

TEST_P(DriverFaults, RAS_125_SnormTargetsBlendOrAreRefused) {
  Canvas canvas(GetParam(), Format::kR8G8B8A8Snorm);
  GraphicsPipelineStateDesc desc = canvas.desc("WholeTarget", "Constant");
  desc.DepthStencilState.DepthEnable = false;
  RenderTargetBlendDesc& blend = desc.BlendState.RenderTarget[0];
  blend.BlendEnable = true;
  blend.DestBlend = Blend::kOne;
  const auto pipeline = canvas.device.CreateGraphicsPipelineState(desc);
  if (GetParam() == "vulkan") {
    ASSERT_FALSE(pipeline.ok());
    EXPECT_EQ(pipeline.error().id.text(), "KA0726");
    return;
  }
  canvas.run([&](CommandList& list) {
    for (const float value : {0.5f, -1.0f}) {
      Canvas::use(list, pipeline.value(), {value, 0, 0, 0.5f});
      list.DrawInstanced(3, 1, 0, 0);
    }
  });
  EXPECT_EQ(canvas.texel<int8_t>(1, 1), -63);  // 64 - 127
}

// The weights of the triangle (-1, 1), (3, 1), (-1, -3) that covers the target.
TEST_P(DriverFaults, RAS_72_BarycentricsFollowTheOrderOfVertices) {
  Canvas canvas(GetParam());
  const PipelineState pipeline = canvas.make(canvas.desc("WholeTarget", "Barycentrics"));
  canvas.run([&](CommandList& list) {
    Canvas::use(list, pipeline, {1, 1, 1, 0.5f});
    list.DrawInstanced(3, 1, 0, 0);
  });
  for (uint32_t y = 0; y < kSize; y += 7) {
    for (uint32_t x = 0; x < kSize; x += 5) {
      const float right = (static_cast<float>(x) + 0.5f) / 128;
      const float down = (static_cast<float>(y) + 0.5f) / 128;
      EXPECT_NEAR(canvas.texel<float>(x, y, 0), 1 - right - down, 1e-6f);
      EXPECT_NEAR(canvas.texel<float>(x, y, 1), right, 1e-6f);
      EXPECT_NEAR(canvas.texel<float>(x, y, 2), down, 1e-6f);
      EXPECT_EQ(canvas.texel<float>(x, y, 3), 0.0f);  // primitive 0, leading vertex 0
    }
  }
  if (GetParam() != "vulkan") return;
  const Without off("BARY");
  const Canvas other("vulkan");
  if (other.device.GetInfo().Name.find("llvmpipe") == std::string::npos) return;
  const auto refused =
      other.device.CreateGraphicsPipelineState(other.desc("WholeTarget", "Barycentrics"));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().id.text(), "KA0967");
}

// Barycentrics and a slice of the target at once; slices that are not there are slice 0.
TEST_P(DriverFaults, RAS_46_72_BarycentricsInSlices) {
  Canvas canvas(GetParam());
  const Texture slices = canvas.device
                             .CreateTexture({.Width = kSize,
                                             .Height = kSize,
                                             .DepthOrArraySize = 3,
                                             .Format = Format::kR32G32B32A32Float,
                                             .Flags = ResourceFlags::kAllowRenderTarget,
                                             .InitialState = ResourceStates::kRenderTarget})
                             .value();
  const DescriptorHeap rtvs =
      canvas.device.CreateDescriptorHeap({.Type = DescriptorHeapType::kRtv, .NumDescriptors = 1})
          .value();
  const CpuDescriptorHandle rtv = rtvs.GetCPUDescriptorHandle(0);
  canvas.device.CreateRenderTargetView(slices, rtv).value();
  GraphicsPipelineStateDesc desc = canvas.desc("WholeSlice", "SliceAndWeights");
  desc.DepthStencilState.DepthEnable = false;
  desc.DSVFormat = Format::kUnknown;
  const PipelineState pipeline = canvas.make(desc);
  canvas.run([&](CommandList& list) {
    list.OMSetRenderTargets(1, &rtv);
    Canvas::use(list, pipeline, {1, 1, 1, 0.5f});
    list.DrawInstanced(3, 4, 0, 0);
  });
  for (uint32_t slice = 0; slice < 3; ++slice) {
    const auto texels = ReadbackTexture(canvas.device, canvas.queue, slices, slice).value();
    float texel[4];
    std::memcpy(texel, texels.data() + 16 * (32 * kSize + 10), sizeof texel);
    EXPECT_EQ(texel[0], slice == 0 ? 3.0f : static_cast<float>(slice)) << slice;
    EXPECT_NEAR(texel[2], 10.5f / 128, 1e-6f);
    EXPECT_NEAR(texel[3], 32.5f / 128, 1e-6f);
  }
}

}  // namespace
}  // namespace kaamos::draws

// SPDX-License-Identifier: MIT
//
// Rules of depth bias.
#include <bit>
#include <cmath>

#include "tests/conformance/ras_depth.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

struct Bias {
  int32_t constant = 0;
  float slope = 0;
  float clamp = 0;
};

PipelineState biased(const Screen& screen, const Bias& bias, ComparisonFunc func,
                     const char* vertex = "Whole") {
  GraphicsPipelineStateDesc desc = screen.desc(vertex, "Place");
  desc.RasterizerState.DepthBias = bias.constant;
  desc.RasterizerState.SlopeScaledDepthBias = bias.slope;
  desc.RasterizerState.DepthBiasClamp = bias.clamp;
  desc.DepthStencilState.DepthFunc = func;
  return screen.make(desc);
}

// Bits of the depth that is stored.
uint32_t stored(Screen& screen, const Bias& bias, float z) {
  const PipelineState pipeline = biased(screen, bias, ComparisonFunc::kAlways);
  screen.run([&](CommandList& list) { screen.cover(list, pipeline, {.depth = z}); });
  return screen.depth_bits(5, 3);
}

void bias_of_floats(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kD32Float);
  t.equal("z 1/64, bias 1", stored(screen, {1}, 1.0f / 64), 0x3C800001u);
  t.equal("z 0.5, bias 2", stored(screen, {2}, 0.5f), 0x3F000002u);
  t.equal("z 0.5, bias -3", stored(screen, {-3}, 0.5f), std::bit_cast<uint32_t>(0.5f - 0x3p-24f));
  // A slope of 1/256 per pixel.
  const PipelineState pipeline = biased(screen, {0, 2, 0}, ComparisonFunc::kAlways, "Pass");
  screen.draw(pipeline, slope_over(screen, 0, 0.5f));
  const float tolerance = t.target().backend == "vulkan" ? 0x1p-20f : 0;
  t.equal("slope 2: px that differ", screen.count([&](uint32_t x, uint32_t y) {
    const float expected = (static_cast<float>(x) + 0.5f) / 512 + 1.0f / 256;
    return !(std::abs(screen.depth(x, y) - expected) <= tolerance);
  }),
          0u);
}

void bias_of_unorm(Context& t) {
  const float z = std::bit_cast<float>(0x3C800000u);
  const auto passes = [&](Format format, uint32_t cleared, int32_t bias) {
    Screen screen(t, {Format::kR32G32B32A32Float}, format, 8);
    screen.clear_depth = std::bit_cast<float>(cleared);
    const PipelineState pipeline = biased(screen, {bias}, ComparisonFunc::kGreaterEqual);
    screen.run([&](CommandList& list) { screen.cover(list, pipeline, {.depth = z}); });
    return screen.texel<float>(3, 3, 3) != 0;
  };
  t.equal("D16, bias 0", passes(Format::kD16Unorm, 0x3C802000, 0), false);
  t.equal("D16, bias 1", passes(Format::kD16Unorm, 0x3C802000, 1), true);
  t.equal("D16, bias 1 is not 15", passes(Format::kD16Unorm, 0x3C820000, 1), false);
  t.equal("D24, bias 0", passes(Format::kD24UnormS8Uint, 0x3C800020, 0), false);
  t.equal("D24, bias 1", passes(Format::kD24UnormS8Uint, 0x3C800020, 1), true);
  t.equal("D24, bias 1 is no more", passes(Format::kD24UnormS8Uint, 0x3C800200, 1), false);
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kD16Unorm, 8);
  constexpr float kMiddle = 32768.0f / 65535;
  t.equal("D16, bias 100", stored(screen, {100}, kMiddle), 32868u);
  t.equal("D16, bias -7", stored(screen, {-7}, kMiddle), 32761u);
}

// SV_Position.z.
uint32_t seen(Screen& screen, const Bias& bias, float z) {
  const PipelineState pipeline = biased(screen, bias, ComparisonFunc::kAlways);
  screen.run([&](CommandList& list) { screen.cover(list, pipeline, {.depth = z}); });
  return screen.texel<uint32_t>(5, 3, 2);
}

void bias_without_a_buffer(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 8);
  t.equal("z 0.5, bias 1", seen(screen, {1}, 0.5f), 0x3F000001u);
}

void bias_is_limited(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kD32Float, 8);
  constexpr int32_t kHundredth = 167772;  // of 2^-24
  const auto bits = [](float value) { return std::bit_cast<uint32_t>(value); };
  t.equal("0.01 to 0.001", seen(screen, {kHundredth, 0, 0.001f}, 0.5f), bits(0.5f + 0.001f));
  t.equal("-0.01 to -0.001", seen(screen, {-kHundredth, 0, -0.001f}, 0.5f), bits(0.5f - 0.001f));
  t.equal("-0.01 to 0.001", seen(screen, {-kHundredth, 0, 0.001f}, 0.5f),
          bits(0.5f - kHundredth * 0x1p-24f));
  t.equal("0.01 to -0.001", seen(screen, {kHundredth, 0, -0.001f}, 0.5f),
          bits(0.5f + kHundredth * 0x1p-24f));
  t.equal("no limit", seen(screen, {kHundredth, 0, 0}, 0.5f), bits(0.5f + kHundredth * 0x1p-24f));
}

void bias_is_seen_and_never_clips(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kD32Float, 8);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Place");
  desc.RasterizerState.DepthBias = 5;
  desc.DepthStencilState.DepthEnable = false;
  const PipelineState disabled = screen.make(desc);
  screen.run([&](CommandList& list) { screen.cover(list, disabled); });
  t.equal("no depth test: SV_Position.z", screen.texel<uint32_t>(1, 1, 2), 0x3F000005u);
  t.equal("no depth test: stored", screen.depth(1, 1), 1.0f);
  for (const int32_t bias : {1 << 24, -(1 << 24)}) {
    t.equal("beyond the range", stored(screen, {bias}, 0.5f),
            std::bit_cast<uint32_t>(bias > 0 ? 1.0f : 0.0f));
    t.equal("all is drawn",
            screen.count([&](uint32_t x, uint32_t y) { return screen.texel<float>(x, y, 3) != 0; }),
            64u);
  }
}

}  // namespace

std::vector<RuleTest> ras_depth_bias_tests() {
  return {{"RAS-64", bias_of_floats},
          {"RAS-65", bias_of_unorm, "*"},
          {"RAS-66", bias_without_a_buffer, "*"},
          {"RAS-67", bias_is_limited},
          {"RAS-68", bias_is_seen_and_never_clips}};
}

}  // namespace kaamos::conformance

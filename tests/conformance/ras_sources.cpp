// SPDX-License-Identifier: MIT
//
// Rules of what joins outputs and targets besides blending of one source, and of places in a pixel.
#include <shaders/ras_lines.h>

#include <cmath>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

void second_source(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_lines();
  const std::array<float, 4> first = {2, 4, 8, 0.5f}, second = {0.25f, 0.5f, 0.75f, 0.125f};
  screen.clear_color = {1, 0.5f, 0.25f, 4};
  struct Case {
    Blend blend;
    bool color, inverse;
  };
  for (const Case& c : {Case{Blend::kSrc1Color, true, false},
                        {Blend::kInvSrc1Color, true, true},
                        {Blend::kSrc1Alpha, false, false},
                        {Blend::kInvSrc1Alpha, false, true}}) {
    GraphicsPipelineStateDesc desc = screen.desc("Whole", "Sources");
    RenderTargetBlendDesc& blend = desc.BlendState.RenderTarget[0];
    blend.BlendEnable = true;
    blend.SrcBlend = c.blend;
    blend.DestBlend = Blend::kOne;
    blend.SrcBlendAlpha = c.inverse ? Blend::kInvSrc1Alpha : Blend::kSrc1Alpha;
    blend.DestBlendAlpha = Blend::kZero;
    const PipelineState pipeline = screen.make(desc);
    screen.run(
        [&](CommandList& list) { screen.cover(list, pipeline, {.tint = first, .number = 1}); });
    for (uint32_t i = 0; i < 4; ++i) {
      const float of_second = c.color && i < 3 ? second[i] : second[3];
      const float factor = c.inverse ? 1 - of_second : of_second;
      t.equal("factor " + std::to_string(static_cast<uint32_t>(c.blend)) + ", component " +
                  std::to_string(i),
              screen.texel<float>(2, 1, i),
              first[i] * factor + (i < 3 ? screen.clear_color[i] : 0));
    }
  }
}

// Both sources are limited to what the format can hold before they are joined.
void second_source_is_limited(Context& t) {
  Screen screen(t, {Format::kR8G8B8A8Unorm}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_lines();
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Sources");
  RenderTargetBlendDesc& blend = desc.BlendState.RenderTarget[0];
  blend.BlendEnable = true;
  blend.SrcBlend = Blend::kSrc1Color;
  blend.DestBlend = Blend::kZero;
  const PipelineState pipeline = screen.make(desc);
  screen.run([&](CommandList& list) {
    screen.cover(list, pipeline, {.tint = {0.4f, 0.4f, 7, 1}, .number = 4});
  });
  // The second source is (1, 2, 3, 0.5).
  t.equal("red", int{screen.texel<uint8_t>(1, 1, 0)}, 102);
  t.equal("green", int{screen.texel<uint8_t>(1, 1, 1)}, 102);
  t.equal("blue", int{screen.texel<uint8_t>(1, 1, 2)}, 255);
}

void two_sources_have_one_target(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float, Format::kR32G32B32A32Float}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_lines();
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Sources");
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  desc.BlendState.RenderTarget[0].SrcBlend = Blend::kSrc1Color;
  t.refused("a second target", t.device().CreateGraphicsPipelineState(desc), "KA0720");
  desc.RTVFormats = {Format::kR32G32B32A32Float, Format::kUnknown, Format::kR32G32B32A32Float};
  t.accepted("a target that is not written", t.device().CreateGraphicsPipelineState(desc));
  desc.BlendState.IndependentBlendEnable = true;
  t.accepted("independent", t.device().CreateGraphicsPipelineState(desc));
  desc.BlendState.RenderTarget[2].BlendEnable = true;
  t.refused("another one blends", t.device().CreateGraphicsPipelineState(desc), "KA0720");
  desc.BlendState.IndependentBlendEnable = false;
  desc.RTVFormats.resize(1);
  t.accepted("one target", t.device().CreateGraphicsPipelineState(desc));
  desc.BlendState.RenderTarget[0].SrcBlend = Blend::kOne;
  desc.BlendState.RenderTarget[0].DestBlendAlpha = Blend::kSrc1Color;
  t.refused("a colour for alpha", t.device().CreateGraphicsPipelineState(desc), "KA0720");
}

uint32_t joined(LogicOp op, uint32_t s, uint32_t d) {
  uint32_t out = 0;
  // The results for (s, d) = (1, 1), (1, 0), (0, 1) and (0, 0).
  constexpr const char* kTable[] = {"0000", "1111", "1100", "0011", "1010", "0101", "1000", "0111",
                                    "1110", "0001", "0110", "1001", "0100", "0010", "1101", "1011"};
  for (uint32_t bit = 0; bit < 32; ++bit) {
    const uint32_t column = 3 - ((s >> bit & 1) * 2 + (d >> bit & 1));
    out |= (kTable[static_cast<uint32_t>(op)][column] == '1' ? 1u : 0u) << bit;
  }
  return out;
}

void logic_operations(Context& t) {
  constexpr uint32_t kSource = 0x0F3355C6u, kDest = 0x5A0FC396u;
  for (const Format format : {Format::kR32Uint, Format::kR8G8B8A8Uint, Format::kR16G16Uint}) {
    Screen screen(t, {format}, Format::kUnknown, 4);
    for (uint32_t i = 0; i < 16; ++i) {
      const auto op = static_cast<LogicOp>(i);
      GraphicsPipelineStateDesc desc = screen.desc("Whole", "Number");
      const PipelineState plain = screen.make(desc);
      desc.BlendState.RenderTarget[0].LogicOpEnable = true;
      desc.BlendState.RenderTarget[0].LogicOp = op;
      desc.BlendState.RenderTarget[0].RenderTargetWriteMask = ColorWriteEnable::kRed;
      const PipelineState logic = screen.make(desc);
      const uint32_t bits = GetFormatInfo(format).channel_bits;
      const uint32_t mask = bits == 32 ? ~0u : (1u << bits) - 1;
      screen.run([&](CommandList& list) {
        screen.cover(list, plain, {.number = kDest & mask});
        screen.cover(list, logic, {.number = kSource & mask});
      });
      const uint32_t word = screen.texel<uint32_t>(2, 3);
      t.equal("operation " + std::to_string(i), word & mask, joined(op, kSource, kDest) & mask);
      if (bits == 32) continue;
      t.equal("a component that is not written", word >> bits & mask, kDest & mask);
    }
  }
}

void logic_operations_are_of_integers(Context& t) {
  Screen screen(t, {Format::kR32Uint}, Format::kUnknown, 4);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Number");
  RenderTargetBlendDesc& target = desc.BlendState.RenderTarget[0];
  target.LogicOpEnable = true;
  desc.BlendState.IndependentBlendEnable = true;
  t.refused("independent", t.device().CreateGraphicsPipelineState(desc), "KA0720");
  desc.BlendState.IndependentBlendEnable = false;
  target.BlendEnable = true;
  t.refused("with blending", t.device().CreateGraphicsPipelineState(desc), "KA0720");
  target.BlendEnable = false;
  target.LogicOp = static_cast<LogicOp>(16);
  t.refused("operation 16", t.device().CreateGraphicsPipelineState(desc), "KA0720");
  Screen floats(t, {Format::kR32Float}, Format::kUnknown, 4);
  desc = floats.desc("Whole", "Tint");
  desc.BlendState.RenderTarget[0].LogicOpEnable = true;
  t.refused("floats", t.device().CreateGraphicsPipelineState(desc), "KA0726");
}

// A triangle whose inputs bend: 1 / w is linear on the screen.
void inputs_at_other_places(Context& t) {
  constexpr uint32_t kSide = 64;
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, kSide);
  screen.library = kaamos_shaders_ras_lines();
  GraphicsPipelineStateDesc desc = screen.desc("Moving", "Snapped");
  desc.InputLayout = {element("POSITION", Format::kR32G32B32A32Float),
                      element("VALUE", Format::kR32G32B32A32Float)};
  // w is 1 at the left and 4 at the right; `curved` is x in object space, `straight` on the screen.
  const std::array<float, 4> left = {0, 0, 0, 0}, right = {0, 10, 10, 0};
  screen.draw(screen.make(desc), {screen.at(0, 0, 0.5f, 1, left), screen.at(64, 0, 0.5f, 4, right),
                                  screen.at(0, 64, 0.5f, 1, left)});
  const auto curved = [](float x) {
    const float s = x / 64;
    return 10 * (s / 4) / (1 - s + s / 4);
  };
  for (uint32_t x = 4; x < 40; x += 3) {
    const float middle = static_cast<float>(x) + 0.5f;
    const std::string at = " at " + std::to_string(x);
    t.close("in the middle" + at, screen.texel<float>(x, 8, 1), curved(middle), 1e-4f);
    t.close("to the right" + at, screen.texel<float>(x, 8, 0), curved(middle + 3.0f / 16), 1e-3f);
    t.close("without perspective" + at, screen.texel<float>(x, 8, 2),
            (middle + 3.0f / 16) / 64 * 10, 1e-3f);
    t.close("the only sample" + at, screen.texel<float>(x, 8, 3), curved(middle), 1e-4f);
  }
  desc = screen.desc("Whole", "SamplePlaces");
  const PipelineState places = screen.make(desc);
  screen.run([&](CommandList& list) { screen.cover(list, places, {.number = 0}); });
  t.equal("samples", screen.texel<float>(3, 3, 2), 1.0f);
  t.equal("x of sample 0", screen.texel<float>(3, 3, 0), 0.0f);
}

}  // namespace

std::vector<RuleTest> ras_source_tests() {
  return {{"RAS-160", second_source},
          {"RAS-160", second_source_is_limited},
          {"RAS-160", two_sources_have_one_target},
          {"RAS-161", logic_operations},
          {"RAS-161", logic_operations_are_of_integers},
          {"RAS-162", inputs_at_other_places}};
}

}  // namespace kaamos::conformance

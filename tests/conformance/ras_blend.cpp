// SPDX-License-Identifier: MIT
//
// Rules of blending and of the sample mask.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/conformance/checked.h"
#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

using Color = std::array<float, 4>;

// The factor of component c (3: alpha), written as the table has it.
float factor_of(Blend blend, int c, const Color& s, const Color& d, const Color& constant) {
  const auto i = static_cast<size_t>(c);
  switch (blend) {
    case Blend::kZero:
      return 0;
    case Blend::kOne:
      return 1;
    case Blend::kSrcColor:
      return s[i];
    case Blend::kInvSrcColor:
      return 1 - s[i];
    case Blend::kSrcAlpha:
      return s[3];
    case Blend::kInvSrcAlpha:
      return 1 - s[3];
    case Blend::kDestAlpha:
      return d[3];
    case Blend::kInvDestAlpha:
      return 1 - d[3];
    case Blend::kDestColor:
      return d[i];
    case Blend::kInvDestColor:
      return 1 - d[i];
    case Blend::kSrcAlphaSat:
      return c == 3 ? 1 : std::min(s[3], 1 - d[3]);
    case Blend::kBlendFactor:
      return constant[i];
    default:
      return 1 - constant[i];
  }
}

float joined(BlendOp op, float source, float dest, float source_factor, float dest_factor) {
  switch (op) {
    case BlendOp::kAdd:
      return source * source_factor + dest * dest_factor;
    case BlendOp::kSubtract:
      return source * source_factor - dest * dest_factor;
    case BlendOp::kRevSubtract:
      return dest * dest_factor - source * source_factor;
    case BlendOp::kMin:
      return std::min(source, dest);
    default:
      return std::max(source, dest);
  }
}

Color blended(const RenderTargetBlendDesc& b, const Color& s, const Color& d,
              const Color& constant) {
  Color out;
  for (int c = 0; c < 4; ++c) {
    const bool alpha = c == 3;
    const auto i = static_cast<size_t>(c);
    out[i] = joined(alpha ? b.BlendOpAlpha : b.BlendOp, s[i], d[i],
                    factor_of(alpha ? b.SrcBlendAlpha : b.SrcBlend, c, s, d, constant),
                    factor_of(alpha ? b.DestBlendAlpha : b.DestBlend, c, s, d, constant));
  }
  return out;
}

PipelineState blending(const Screen& screen, const RenderTargetBlendDesc& blend) {
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
  desc.BlendState.RenderTarget[0] = blend;
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  return screen.make(desc);
}

// The target after one draw over `dest`.
void blend_once(Screen& screen, const PipelineState& pipeline, const Color& source,
                const Color& dest, const float* constant = nullptr) {
  screen.clear_color = dest;
  screen.run([&](CommandList& list) {
    if (constant != nullptr) list.OMSetBlendFactor(constant);
    screen.cover(list, pipeline, {.tint = source});
  });
}

RenderTargetBlendDesc with_factors(Blend source, Blend dest, BlendOp op = BlendOp::kAdd) {
  RenderTargetBlendDesc out;
  out.SrcBlend = out.SrcBlendAlpha = source;
  out.DestBlend = out.DestBlendAlpha = dest;
  out.BlendOp = out.BlendOpAlpha = op;
  return out;
}

void factors_and_operations(Context& t) {
  // Every product and sum is a float.
  const Color source = {0.25f, 0.5f, 2, 0.375f}, dest = {0.5f, -0.25f, 1, 0.75f};
  const Color constant = {0.125f, 0.5f, 0.75f, 0.25f};
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 4);
  const auto check = [&](const RenderTargetBlendDesc& blend) {
    blend_once(screen, blending(screen, blend), source, dest, constant.data());
    const Color expected = blended(blend, source, dest, constant);
    for (uint32_t c = 0; c < 4; ++c) {
      t.equal("factors " + std::to_string(static_cast<uint32_t>(blend.SrcBlend)) + " and " +
                  std::to_string(static_cast<uint32_t>(blend.DestBlend)) + ", operation " +
                  std::to_string(static_cast<uint32_t>(blend.BlendOp)) + ", component " +
                  std::to_string(c),
              screen.texel<float>(2, 2, c), expected[c]);
    }
  };
  const Blend factors[] = {Blend::kZero,          Blend::kOne,          Blend::kSrcColor,
                           Blend::kInvSrcColor,   Blend::kSrcAlpha,     Blend::kInvSrcAlpha,
                           Blend::kDestAlpha,     Blend::kInvDestAlpha, Blend::kDestColor,
                           Blend::kInvDestColor,  Blend::kSrcAlphaSat,  Blend::kBlendFactor,
                           Blend::kInvBlendFactor};
  const auto of_color = [](Blend blend) {
    return blend == Blend::kSrcColor || blend == Blend::kInvSrcColor ||
           blend == Blend::kDestColor || blend == Blend::kInvDestColor;
  };
  for (size_t i = 0; i < std::size(factors); ++i) {
    RenderTargetBlendDesc blend = with_factors(factors[i], factors[(i + 5) % std::size(factors)]);
    // Alpha has no factors of colours.
    if (of_color(blend.SrcBlendAlpha)) blend.SrcBlendAlpha = Blend::kDestAlpha;
    if (of_color(blend.DestBlendAlpha)) blend.DestBlendAlpha = Blend::kInvSrcAlpha;
    check(blend);
  }
  for (const BlendOp op :
       {BlendOp::kSubtract, BlendOp::kRevSubtract, BlendOp::kMin, BlendOp::kMax}) {
    check(with_factors(Blend::kSrcAlpha, Blend::kBlendFactor, op));
    RenderTargetBlendDesc alpha_alone = with_factors(Blend::kOne, Blend::kOne);
    alpha_alone.BlendOpAlpha = op;
    check(alpha_alone);
  }
}

void inputs_and_results_are_limited(Context& t) {
  Screen screen(t, {Format::kR8G8B8A8Unorm}, Format::kUnknown, 4);
  const PipelineState adds = blending(screen, with_factors(Blend::kOne, Blend::kOne));
  blend_once(screen, adds, {2, -1, 0.6f, 0.25f}, {0, 0, 0.6f, 0.5f});
  t.equal("2", int{screen.texel<uint8_t>(1, 1, 0)}, 255);
  t.equal("-1", int{screen.texel<uint8_t>(1, 1, 1)}, 0);
  t.equal("0.6 + 0.6", int{screen.texel<uint8_t>(1, 1, 2)}, 255);
  // Sources are limited first: 1 - 0.4, not 2 - 0.4.
  const PipelineState subtracts =
      blending(screen, with_factors(Blend::kOne, Blend::kOne, BlendOp::kSubtract));
  blend_once(screen, subtracts, {2, -1, 0.2f, 1}, {0.4f, 0.4f, 0.4f, 0});
  t.equal("2 - 0.4", int{screen.texel<uint8_t>(1, 1, 0)}, 153);
  t.equal("-1 - 0.4", int{screen.texel<uint8_t>(1, 1, 1)}, 0);
  t.equal("0.2 - 0.4", int{screen.texel<uint8_t>(1, 1, 2)}, 0);
  // Random colours by alpha.
  const PipelineState over = blending(screen, with_factors(Blend::kSrcAlpha, Blend::kInvSrcAlpha));
  std::mt19937 random(120);
  const int tolerance = t.target().backend == "vulkan" ? 2 : 0;
  for (int i = 0; i < 40; ++i) {
    Color source, dest, stored;
    for (size_t c = 0; c < 4; ++c) {
      source[c] = static_cast<float>(random() % 1024) / 1023;
      dest[c] = static_cast<float>(random() % 256) / 255;
      stored[c] = std::round(dest[c] * 255) / 255;
    }
    blend_once(screen, over, source, dest);
    const Color expected =
        blended(with_factors(Blend::kSrcAlpha, Blend::kInvSrcAlpha), source, stored, {});
    for (uint32_t c = 0; c < 4; ++c) {
      const int found = screen.texel<uint8_t>(1, 1, c);
      const auto wanted = static_cast<int>(std::clamp(expected[c], 0.0f, 1.0f) * 255 + 0.5f);
      t.holds("random: " + std::to_string(found) + ", expected " + std::to_string(wanted),
              std::abs(found - wanted) <= tolerance);
    }
  }
}

void absent_alpha(Context& t) {
  for (const Format format : {Format::kR11G11B10Float, Format::kR32Float}) {
    const uint32_t one = format == Format::kR32Float ? 0x3F800000u : 0x3C0u;
    Screen screen(t, {format}, Format::kUnknown, 4);
    const PipelineState inverse =
        blending(screen, with_factors(Blend::kInvDestAlpha, Blend::kZero));
    blend_once(screen, inverse, {1, 0, 0, 0.5f}, {0, 0, 0, 0.25f});
    t.equal("INV_DEST_ALPHA", screen.texel<uint32_t>(1, 1), 0u);
    const PipelineState direct = blending(screen, with_factors(Blend::kDestAlpha, Blend::kZero));
    blend_once(screen, direct, {1, 0, 0, 0.5f}, {0, 0, 0, 0.25f});
    t.equal("DEST_ALPHA", screen.texel<uint32_t>(1, 1), one);
  }
}

void one_state_for_all(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float, Format::kR32G32B32A32Float}, Format::kUnknown, 4);
  for (const bool independent : {false, true}) {
    GraphicsPipelineStateDesc desc = screen.desc("Whole", "Both");
    desc.BlendState.IndependentBlendEnable = independent;
    desc.BlendState.RenderTarget[1].RenderTargetWriteMask = ColorWriteEnable::kGreen;
    desc.BlendState.RenderTarget[1].BlendEnable = true;
    desc.BlendState.RenderTarget[1].DestBlend = Blend::kOne;
    const PipelineState pipeline = screen.make(desc);
    screen.clear_color = {8, 8, 8, 8};
    screen.run([&](CommandList& list) { screen.cover(list, pipeline, {.tint = {1, 2, 3, 4}}); });
    t.equal("target 0", screen.texel<float>(1, 2, 1, 0), 2.0f);
    t.equal("target 1: red", screen.texel<float>(1, 2, 0, 1), independent ? 8.0f : 1.0f);
    t.equal("target 1: green", screen.texel<float>(1, 2, 1, 1), independent ? 10.0f : 2.0f);
  }
}

void integers_do_not_blend(Context& t) {
  for (const Format format : {Format::kR32Uint, Format::kR8G8B8A8Uint}) {
    Screen screen(t, {format}, Format::kUnknown, 4);
    GraphicsPipelineStateDesc desc = screen.desc("Whole", "Number");
    t.accepted("without blending", t.device().CreateGraphicsPipelineState(desc));
    desc.BlendState.RenderTarget[0].BlendEnable = true;
    t.refused("with blending", t.device().CreateGraphicsPipelineState(desc), "KA0726");
    desc.PS = {};
    t.accepted("without a shader that writes it", t.device().CreateGraphicsPipelineState(desc));
  }
}

void floats_blend_in_float32(Context& t) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 4);
  const PipelineState replace = blending(screen, with_factors(Blend::kOne, Blend::kZero));
  blend_once(screen, replace, {1, 2, 3, 4}, {kNaN, 1, kNaN, 1});
  t.holds("NaN * 0", std::isnan(screen.texel<float>(1, 1, 0)));
  t.equal("1 * 0", screen.texel<float>(1, 1, 1), 2.0f);
  const RenderTargetBlendDesc over = with_factors(Blend::kSrcAlpha, Blend::kInvSrcAlpha);
  const PipelineState pipeline = blending(screen, over);
  std::mt19937 random(124);
  std::uniform_real_distribution<float> number(0, 2);
  for (int i = 0; i < 40; ++i) {
    const Color source = {number(random), number(random), number(random), number(random) / 2};
    const Color dest = {number(random), number(random), number(random), number(random)};
    blend_once(screen, pipeline, source, dest);
    const Color expected = blended(over, source, dest, {});
    for (uint32_t c = 0; c < 4; ++c) {
      t.close("random", screen.texel<float>(1, 1, c), expected[c],
              t.target().backend == "vulkan" ? 1.7f * 0x1p-24f * 4 : 0);
    }
  }
}

void snorm_blends(Context& t) {
  Screen screen(t, {Format::kR8Snorm}, Format::kUnknown, 4);
  const PipelineState adds = blending(screen, with_factors(Blend::kOne, Blend::kOne));
  blend_once(screen, adds, {0.5f, 0, 0, 0}, {-1, 0, 0, 0});
  t.equal("0.5 + -1", int{screen.texel<int8_t>(1, 1)}, -64);
  blend_once(screen, adds, {-1, 0, 0, 0}, {-1, 0, 0, 0});
  t.equal("-1 + -1", int{screen.texel<int8_t>(1, 1)}, -127);
}

void blend_factor_of_the_list(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 4);
  const PipelineState pipeline = blending(screen, with_factors(Blend::kBlendFactor, Blend::kZero));
  const float quarter[4] = {0.25f, 0.25f, 0.25f, 0.25f};
  blend_once(screen, pipeline, {3, 3, 3, 3}, {});
  t.equal("never set", screen.texel<float>(1, 1, 2), 3.0f);
  blend_once(screen, pipeline, {3, 3, 3, 3}, {}, quarter);
  t.equal("set", screen.texel<float>(1, 1, 2), 0.75f);
  screen.run([&](CommandList& list) {
    list.OMSetBlendFactor(quarter);
    list.OMSetBlendFactor(nullptr);
    screen.cover(list, pipeline, {.tint = {3, 3, 3, 3}});
  });
  t.equal("null", screen.texel<float>(1, 1, 2), 3.0f);
}

void sample_mask(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kD32Float, 4);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
  desc.SampleMask = 0xFFFFFFFE;
  const PipelineState none = screen.make(desc);
  screen.run([&](CommandList& list) { screen.cover(list, none); });
  t.equal("px", screen.covered(), 0u);
  t.equal("depth", screen.depth(1, 1), 1.0f);
  desc.SampleMask = 1;
  const PipelineState all = screen.make(desc);
  screen.run([&](CommandList& list) { screen.cover(list, all); });
  t.equal("mask 1: px", screen.covered(), 16u);
  Checked checked(t);
  Screen zeroed(checked, {Format::kR32Float}, Format::kUnknown, 4);
  desc = zeroed.desc("Whole", "Tint");
  desc.SampleMask = 0;
  checked.accepted("mask 0", checked.device().CreateGraphicsPipelineState(desc));
  checked.told("mask 0", "KA0728");
}

void srgb_blends_linear(Context& t) {
  Screen screen(t, {Format::kR8G8B8A8UnormSrgb}, Format::kUnknown, 4);
  const PipelineState over = blending(screen, with_factors(Blend::kSrcAlpha, Blend::kInvSrcAlpha));
  blend_once(screen, over, {1, 0, 0, 0.5f}, {0, 1, 0, 1});
  const int tolerance = t.target().backend == "vulkan" ? 1 : 0;
  for (const uint32_t c : {0u, 1u}) {
    const int found = screen.texel<uint8_t>(1, 1, c);
    t.holds("half of 1: " + std::to_string(found), std::abs(found - 188) <= tolerance);
  }
  const int alpha = screen.texel<uint8_t>(1, 1, 3);
  t.holds("alpha: " + std::to_string(alpha), std::abs(alpha - 191) <= tolerance);  // 0.75
}

}  // namespace

std::vector<RuleTest> ras_blend_tests() {
  return {{"RAS-120", factors_and_operations, "*"},
          {"RAS-120", inputs_and_results_are_limited, "*"},
          {"RAS-121", absent_alpha},
          {"RAS-122", one_state_for_all},
          {"RAS-123", integers_do_not_blend},
          {"RAS-124", floats_blend_in_float32, "*"},
          {"RAS-125", snorm_blends},
          {"RAS-126", blend_factor_of_the_list},
          {"RAS-127", sample_mask, "*"},
          {"RAS-128", srgb_blends_linear}};
}

}  // namespace kaamos::conformance

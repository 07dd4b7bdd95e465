// SPDX-License-Identifier: MIT
//
// Rules of clears.
#include "tests/conformance/ras_clears.h"

#include <limits>

namespace kaamos::conformance {

using namespace rtapi;

namespace {

using Color = std::array<float, 4>;

// The texels of a target of 32 x 32 pixels after a clear.
template <class T>
T cleared(Context& t, Format format, const Color& color, uint32_t component = 0) {
  Screen screen(t, {format}, Format::kUnknown, 32);
  screen.clear_color = color;
  screen.run([](CommandList&) {});
  const T first = screen.texel<T>(0, 0, component);
  t.equal("texels that differ",
          screen.differing<T>([&](uint32_t, uint32_t) { return first; }, component), 0u);
  return first;
}

void whole_views(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 32, 3);
  const Color color = {1, 2, 3, 4};
  screen.run([&](CommandList& list) {
    list.RSSetScissorRects(Rect{0, 0, 1, 1});
    list.RSSetViewports(Viewport{0, 0, 1, 1, 0, 1});
    list.ClearRenderTargetView(screen.rtv(), color.data());
  });
  for (uint32_t slice = 0; slice < 3; ++slice) {
    for (uint32_t c = 0; c < 4; ++c) {
      t.equal("texels that differ",
              screen.differing<float>([&](uint32_t, uint32_t) { return color[c]; }, c, 0, slice),
              0u);
    }
  }
  const int tolerance = t.target().backend == "vulkan" ? 1 : 0;
  t.equal("UNORM", cleared<uint32_t>(t, Format::kR8G8B8A8Unorm, {0.5f, 2, -1, 1}), 0xFF00FF80u);
  const int srgb = cleared<uint8_t>(t, Format::kR8G8B8A8UnormSrgb, {0.5f, 0, 0, 0});
  t.holds("sRGB: " + std::to_string(srgb), std::abs(srgb - 188) <= tolerance);
  t.equal("SNORM", cleared<uint32_t>(t, Format::kR16G16Snorm, {-1, 0.5f, 0, 0}), 0x40008001u);
  t.equal("half", cleared<uint32_t>(t, Format::kR16G16Float, {0.3f, 65520, 0, 0}), 0x7BFF34CCu);
  t.equal("R11G11B10", cleared<uint32_t>(t, Format::kR11G11B10Float, {1, -1, 1, 0}),
          0x3C0u | 0x1E0u << 22);
  t.equal("BGRA", cleared<uint32_t>(t, Format::kB8G8R8A8Unorm, {1, 0, 0, 1}), 0xFFFF0000u);
  t.equal("RGB10A2", cleared<uint32_t>(t, Format::kR10G10B10A2Unorm, {0.5f, 1, 0, 1}),
          512u | 1023u << 10 | 3u << 30);
}

void rectangles(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kD32Float, 32, 2);
  const Color one = {1, 1, 1, 1};
  const auto clear = [&](const std::vector<Rect>& rects) {
    screen.run([&](CommandList& list) {
      list.ClearRenderTargetView(screen.rtv(), one.data(), rects);
      list.ClearDepthStencilView(screen.dsv(), ClearFlags::kDepth, 0.5f, 0, rects);
    });
    const uint32_t colors = screen.covered();
    t.equal("slice 1", screen.covered(0, 1), colors);
    t.equal("depth",
            screen.count([&](uint32_t x, uint32_t y) { return screen.depth(x, y) == 0.5f; }),
            colors);
    return colors;
  };
  t.equal("one", clear({{10, 10, 20, 20}}), 100u);
  t.holds("its corner", screen.texel<float>(10, 10) == 1 && screen.texel<float>(19, 19) == 1);
  t.equal("cut at the upper left", clear({{-5, -5, 5, 5}}), 25u);
  t.equal("cut at the lower right", clear({{30, 20, 100, 100}}), 24u);
  t.equal("two", clear({{0, 0, 4, 4}, {8, 8, 12, 12}}), 32u);
  t.equal("two that overlap", clear({{0, 0, 4, 4}, {2, 2, 6, 6}}), 28u);
  t.equal("outside", clear({{40, 40, 50, 50}}), 0u);
  t.equal("empty", clear({{4, 4, 4, 10}}), 0u);
  t.equal("none: all", clear({}), 1024u);
}

void integer_views(Context& t) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const auto all = [](float value) { return Color{value, value, value, value}; };
  const auto uint32 = [&](float value) {
    return cleared<uint32_t>(t, Format::kR32Uint, all(value));
  };
  t.equal("R32_UINT of 2^24", uint32(16777217.0f), 16777216u);
  t.equal("R32_UINT of 2.6", uint32(2.6f), 2u);
  t.equal("R32_UINT of 2.4", uint32(2.4f), 2u);
  t.equal("R32_UINT of -3", uint32(-3), 0u);
  t.equal("R32_UINT of 1e20", uint32(1e20f), 0xFFFFFFFFu);
  t.equal("R32_UINT of NaN", uint32(kNaN), 0u);
  t.equal("R8_UINT of 300", int{cleared<uint8_t>(t, Format::kR8Uint, all(300))}, 255);
  t.equal("R16_UINT of 70000", int{cleared<uint16_t>(t, Format::kR16Uint, all(70000))}, 65535);
  t.equal("R32_SINT of -2.6", cleared<int32_t>(t, Format::kR32Sint, all(-2.6f)), -2);
  t.equal("R32_SINT of 1e20", cleared<int32_t>(t, Format::kR32Sint, all(1e20f)), 0x7FFFFFFF);
  t.equal("R8_SINT of -300", int{cleared<int8_t>(t, Format::kR8Sint, all(-300))}, -128);
  t.equal("each component", cleared<uint32_t>(t, Format::kR8G8B8A8Uint, {1, 2, 3, 4}), 0x04030201u);
}

void depth_and_stencil(Context& t) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  Screen screen(t, {}, Format::kD16Unorm, 8);
  screen.clear_depth = 0.5f;
  screen.run([](CommandList&) {});
  t.equal("D16 of 0.5", screen.depth_bits(3, 3), 32768u);
  screen.clear_depth = 0.25f;
  screen.run([](CommandList&) {});
  t.equal("D16 of 0.25", screen.depth_bits(3, 3), 16384u);
  Screen both(t, {Format::kR32Float}, Format::kD32FloatS8X24Uint, 8);
  GraphicsPipelineStateDesc desc = both.desc("Whole", "Tint");
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kEqual;
  desc.DepthStencilState.DepthWriteMask = DepthWriteMask::kZero;
  const PipelineState equal = both.make(desc);
  both.clear_depth = 0.75f;
  both.run([&](CommandList& list) {
    list.ClearDepthStencilView(both.dsv(), ClearFlags::kStencil, 0.5f, 7);
    both.cover(list, equal, {.depth = 0.75f});
  });
  t.equal("stencil alone: depth stays", both.covered(), 64u);
  for (const float depth : {kNaN, -0.5f, 1.5f}) {
    CommandList list = t.device().CreateCommandList().value();
    list.ClearDepthStencilView(screen.dsv(), ClearFlags::kDepth, depth, 0);
    t.refused("depth " + std::to_string(depth), list.Close(), "KA0743");
  }
}

void other_clear_values(Context& t) {
  TextureDesc desc = {.Width = 4, .Height = 4, .Format = Format::kR32Float};
  desc.Flags = ResourceFlags::kAllowRenderTarget;
  desc.InitialState = ResourceStates::kRenderTarget;
  desc.OptimizedClearValue = {.Format = Format::kR32Float, .Color = {3, 3, 3, 3}};
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 4);
  screen.colors[0] = t.device().CreateTexture(desc).value();
  t.device().CreateRenderTargetView(screen.colors[0], screen.rtv()).value();
  screen.clear_color = {5, 5, 5, 5};
  screen.run([](CommandList&) {});
  t.equal("another value than that of the hint", screen.texel<float>(2, 2), 5.0f);
}

void clears_between_draws(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kD32Float, 32);
  const PipelineState pipeline = screen.make("Whole", "Tint");
  const Color two = {2, 2, 2, 2};
  const Rect middle = {8, 8, 24, 24}, right = {16, 0, 32, 32};
  screen.run([&](CommandList& list) {
    screen.cover(list, pipeline, {.tint = {1, 0, 0, 0}, .depth = 0.25f});
    list.ClearRenderTargetView(screen.rtv(), two.data(), {&middle, 1});
    list.ClearDepthStencilView(screen.dsv(), ClearFlags::kDepth, 1, 0, {&right, 1});
    screen.cover(list, pipeline, {.tint = {3, 0, 0, 0}, .depth = 0.5f});
  });
  t.equal("px that differ", screen.differing<float>([](uint32_t x, uint32_t y) {
    if (x >= 16) return 3.0f;
    return x >= 8 && y >= 8 && y < 24 ? 2.0f : 1.0f;
  }),
          0u);
}

void new_targets(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float, Format::kR8G8B8A8Unorm}, Format::kD32Float, 32);
  screen.clears = false;
  screen.run([](CommandList&) {});
  t.equal("floats", screen.covered(0), 0u);
  t.equal("bytes", screen.count([&](uint32_t x, uint32_t y) {
    return screen.texel<uint32_t>(x, y, 0, 1) != 0 || screen.depth_bits(x, y) != 0;
  }),
          0u);
}

}  // namespace

std::vector<RuleTest> ras_clear_tests() {
  std::vector<RuleTest> tests = ras_view_tests();
  for (const RuleTest& test : {RuleTest{"RAS-133", whole_views},
                               {"RAS-134", rectangles},
                               {"RAS-135", integer_views},
                               {"RAS-136", depth_and_stencil},
                               {"RAS-137", other_clear_values},
                               {"RAS-138", clears_between_draws},
                               {"RAS-139", new_targets, "*"}}) {
    tests.push_back(test);
  }
  return tests;
}

}  // namespace kaamos::conformance

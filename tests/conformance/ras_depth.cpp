// SPDX-License-Identifier: MIT
//
// Rules of depth: planes, formats, functions, SV_Depth.
#include <shaders/ras_depth.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tests/conformance/ras_depth.h"

namespace kaamos::conformance {

using namespace rtapi;

// The target from side to side; z goes from `left` to `right`.
std::vector<Corner> slope_over(const Screen& screen, float left, float right) {
  const auto side = static_cast<float>(screen.size());
  std::vector<Corner> out = screen.rectangle(0, 0, side, side);
  for (Corner& c : out) c.position[2] = c.position[0] < 0 ? left : right;
  return out;
}

namespace {

void planes_of_depth(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kD32Float);
  screen.draw(screen.make("Pass", "Place"), slope_over(screen, 0, 1));
  const float tolerance = t.target().backend == "vulkan" ? 0x1p-20f : 0;
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    return !(std::abs(screen.depth(x, y) - (static_cast<float>(x) + 0.5f) / 256) <= tolerance);
  }),
          0u);
}

void shaders_read_the_tested_depth(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kD32Float);
  for (const int bias : {0, 1000}) {
    GraphicsPipelineStateDesc desc = screen.desc("Pass", "Place");
    desc.RasterizerState.DepthBias = bias;
    desc.RasterizerState.SlopeScaledDepthBias = bias == 0 ? 0.0f : 1.5f;
    const PipelineState pipeline = screen.make(desc);
    std::vector<Corner> corners = slope_over(screen, 0.1f, 0.7f);
    corners[2].position[2] = corners[3].position[2] = 0.05f;
    corners.push_back(screen.at(17.3f, 5.1f, 0.03f, 2));
    corners.push_back(screen.at(240.7f, 99.9f, 0.01f, 3));
    corners.push_back(screen.at(60.1f, 250.2f, 0.02f, 1));
    screen.draw(pipeline, corners);
    t.equal("bias " + std::to_string(bias) + ": px that differ",
            screen.count([&](uint32_t x, uint32_t y) {
              return screen.texel<uint32_t>(x, y, 2) != screen.depth_bits(x, y);
            }),
            0u);
  }
}

// Returns what shaders read of a depth buffer of this format that `record` drew to, at (3, 5).
float read_through_view(Screen& screen, Format view_format,
                        const std::function<void(CommandList&)>& record) {
  screen.library = kaamos_shaders_ras_depth();
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "ReadDepth");
  desc.DepthStencilState.DepthEnable = false;
  desc.DSVFormat = Format::kUnknown;
  const PipelineState read = screen.make(desc);
  ShaderResourceViewDesc view;
  view.Format = view_format;
  view.ViewDimension = SrvDimension::kTexture2D;
  screen.context()
      .device()
      .CreateShaderResourceView(screen.depth_texture, view, screen.views.GetCPUDescriptorHandle(0))
      .value();
  screen.run([&](CommandList& list) {
    record(list);
    list.ResourceBarrier(ResourceBarrier::Transition(
        screen.depth_texture, ResourceStates::kDepthWrite, ResourceStates::kPixelShaderResource));
    const CpuDescriptorHandle target = screen.rtv();
    list.OMSetRenderTargets(1, &target);
    screen.cover(list, read);
    list.ResourceBarrier(ResourceBarrier::Transition(
        screen.depth_texture, ResourceStates::kPixelShaderResource, ResourceStates::kDepthWrite));
  });
  return screen.texel<float>(3, 5);
}

void depth_is_rounded(Context& t) {
  const auto stored = [&](Format format, Format view, float z, bool again) {
    Screen screen(t, {Format::kR32Float}, format, 8);
    const PipelineState pipeline = screen.make("Whole", "Tint");
    const float value = read_through_view(
        screen, view, [&](CommandList& list) { screen.cover(list, pipeline, {.depth = z}); });
    if (again) {
      screen.run([&](CommandList& list) {
        screen.cover(list, pipeline, {.tint = {1, 0, 0, 0}, .depth = z});
        screen.cover(list, pipeline, {.tint = {2, 0, 0, 0}, .depth = z});
      });
      t.equal("LESS against itself", screen.texel<float>(2, 2), 1.0f);
    }
    return value;
  };
  const auto d16 = [&](float z) {
    return stored(Format::kD16Unorm, Format::kR16Unorm, z, true) * 65535;
  };
  const auto d24 = [&](float z) {
    return stored(Format::kD24UnormS8Uint, Format::kR24UnormX8Typeless, z, true) * 16777215.0;
  };
  t.equal("D16 of 0.5", std::round(d16(0.5f)), 32768.0f);
  t.equal("D16 of 0.49 steps", std::round(d16(0.49f / 65535)), 0.0f);
  t.equal("D16 of 0.51 steps", std::round(d16(0.51f / 65535)), 1.0f);
  t.equal("D16 of 65534.4 steps", std::round(d16(65534.4f / 65535)), 65534.0f);
  t.equal("D24 of 0.5", std::round(d24(0.5f)), 8388608.0);
  t.equal("D24 of 0.25", std::round(d24(0.25f)), 4194304.0);
  t.equal("D32 of 0.3", stored(Format::kD32Float, Format::kR32Float, 0.3f, true), 0.3f);
}

void the_eight_functions(Context& t) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  Screen screen(t, {Format::kR32Float}, Format::kD32Float, 8);
  const float stored[] = {0.25f, 0.5f, 0.75f, kNaN};
  // A bit for each stored value that a new depth of 0.5 passes against, by function.
  const uint32_t passes[9] = {0, 0, 4, 2, 2 | 4, 1, 1 | 4 | 8, 1 | 2, 1 | 2 | 4 | 8};
  std::vector<float> texels(64);
  for (size_t i = 0; i < 64; ++i) texels[i] = stored[i % 8 / 2];
  screen.clears = false;
  const auto upload = [&] {
    UploadTexture(t.device(), t.queue(), screen.depth_texture, 0,
                  std::as_bytes(std::span<const float>(texels)))
        .value();
  };
  for (uint32_t func = 1; func <= 8; ++func) {
    GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
    desc.DepthStencilState.DepthFunc = static_cast<ComparisonFunc>(func);
    const PipelineState pipeline = screen.make(desc);
    upload();
    screen.run([&](CommandList& list) {
      list.ClearRenderTargetView(screen.rtv(), screen.clear_color.data());
      screen.cover(list, pipeline);
    });
    for (uint32_t i = 0; i < 4; ++i) {
      const bool pass = (passes[func] >> i & 1) != 0;
      const std::string what =
          "function " + std::to_string(func) + ", stored " + std::to_string(stored[i]);
      t.equal(what, screen.texel<float>(2 * i, 3), pass ? 1.0f : 0.0f);
      t.equal(what + ", bits", screen.depth_bits(2 * i, 3),
              std::bit_cast<uint32_t>(pass ? 0.5f : stored[i]));
    }
  }
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kEqual;
  const PipelineState equal = screen.make(desc);
  std::fill(texels.begin(), texels.end(), -0.0f);
  upload();
  screen.run([&](CommandList& list) {
    list.ClearRenderTargetView(screen.rtv(), screen.clear_color.data());
    screen.cover(list, equal, {.depth = 0});
  });
  t.equal("0 equals -0", screen.covered(), 64u);
}

void tests_need_a_buffer(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kD32Float, 8);
  screen.clear_depth = 0.125f;
  const auto check = [&](const std::string& what, const PipelineState& pipeline, bool bound) {
    screen.run([&](CommandList& list) {
      const CpuDescriptorHandle target = screen.rtv();
      if (!bound) list.OMSetRenderTargets(1, &target);
      screen.cover(list, pipeline);
    });
    t.equal(what + ": px", screen.covered(), 64u);
    t.equal(what + ": depth", screen.depth(1, 7), 0.125f);
  };
  check("no depth buffer", screen.make("Whole", "Tint"), false);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
  desc.DepthStencilState.DepthEnable = false;
  check("DepthEnable false", screen.make(desc), true);
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kNever;
  check("DepthEnable false with NEVER", screen.make(desc), true);
  // A null view.
  const PipelineState pipeline = screen.make("Whole", "Tint");
  DepthStencilViewDesc view;
  view.Format = Format::kD32Float;
  view.ViewDimension = DsvDimension::kTexture2D;
  t.device().CreateDepthStencilView(Texture(), view, screen.dsv()).value();
  screen.clears = false;
  screen.run([&](CommandList& list) {
    list.ClearRenderTargetView(screen.rtv(), screen.clear_color.data());
    screen.cover(list, pipeline);
  });
  t.equal("a null view: px", screen.covered(), 64u);
  t.equal("a null view: depth", screen.depth(1, 7), 0.125f);
}

void equal_positions_equal_depth(Context& t) {
  constexpr uint32_t kSide = 390;  // 304,200 triangles
  Screen screen(t, {Format::kR32Float}, Format::kD32Float, 512);
  screen.library = kaamos_shaders_ras_depth();
  const PipelineState before = [&] {
    GraphicsPipelineStateDesc desc = screen.desc("HillsOnly", "");
    desc.RTVFormats = {};
    return screen.make(desc);
  }();
  GraphicsPipelineStateDesc desc = screen.desc("Hills", "Value");
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kEqual;
  desc.DepthStencilState.DepthWriteMask = DepthWriteMask::kZero;
  desc.PS = screen.shader("Tint");
  const PipelineState tint = screen.make(desc);
  desc.PS = screen.shader("Facts");
  desc.RTVFormats = {Format::kR32G32B32A32Uint};
  screen.run([&](CommandList& list) {
    const DrawConstants constants = {.number = kSide};
    const CpuDescriptorHandle depth = screen.dsv();
    list.OMSetRenderTargets(0, nullptr, false, &depth);
    Screen::use(list, before, constants);
    list.DrawInstanced(kSide * kSide * 6, 1, 0, 0);
    const CpuDescriptorHandle target = screen.rtv();
    list.OMSetRenderTargets(1, &target, false, &depth);
    Screen::use(list, tint, constants);
    for (const Rect& rect : {Rect{0, 0, 201, 512}, Rect{201, 0, 512, 512}}) {
      list.RSSetScissorRects(rect);
      list.DrawInstanced(kSide * kSide * 6, 1, 0, 0);
    }
  });
  uint32_t drawn = 0;
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    const bool in_depth = screen.depth(x, y) != 1;
    drawn += in_depth ? 1 : 0;
    return in_depth != (screen.texel<float>(x, y) != 0);
  }),
          0u);
  t.holds("px drawn: " + std::to_string(drawn), drawn > 60000);
}

void shaders_write_depth(Context& t) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kD32Float, 8);
  screen.clear_depth = 0.125f;
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "OwnDepth");
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kAlways;
  const PipelineState pipeline = screen.make(desc);
  const auto stored = [&](float value, float low, float high) {
    screen.run([&](CommandList& list) {
      list.RSSetViewports(Viewport{0, 0, 8, 8, low, high});
      screen.cover(list, pipeline, {.tint = {value, 0, 0, 0}});
    });
    return screen.depth(6, 1);
  };
  t.equal("0.75", stored(0.75f, 0, 1), 0.75f);
  t.equal("NaN", stored(kNaN, 0, 1), 0.0f);
  t.equal("NaN in 0.25 to 0.5", stored(kNaN, 0.25f, 0.5f), 0.25f);
  t.equal("infinity", stored(kInf, 0.25f, 0.5f), 0.5f);
  t.equal("-infinity", stored(-kInf, 0.25f, 0.5f), 0.25f);
  // The test is against what the shader writes.
  const PipelineState less = screen.make("Whole", "OwnDepth");
  screen.run([&](CommandList& list) {
    screen.cover(list, less, {.tint = {0.0625f, 0, 0, 0}, .depth = 0.9f});
    screen.cover(list, less, {.tint = {0.09375f, 0, 0, 0}, .depth = 0.01f});
  });
  t.equal("LESS", screen.texel<float>(1, 1), 0.0625f);
}

void formats_of_depth(Context& t) {
  struct Case {
    Format format, depth_view, stencil_view;
    float expected;
  };
  for (const Case& each :
       {Case{Format::kD16Unorm, Format::kR16Unorm, Format::kUnknown, 32768.0f / 65535},
        Case{Format::kD24UnormS8Uint, Format::kR24UnormX8Typeless, Format::kX24TypelessG8Uint,
             static_cast<float>(8388608.0 / 16777215)},
        Case{Format::kD32Float, Format::kR32Float, Format::kUnknown, 0.5f},
        Case{Format::kD32FloatS8X24Uint, Format::kR32FloatX8X24Typeless,
             Format::kX32TypelessG8X24Uint, 0.5f}}) {
    const std::string what = "format " + std::to_string(static_cast<uint32_t>(each.format));
    Screen screen(t, {Format::kR32G32B32A32Float}, each.format, 8);
    const PipelineState pipeline = screen.make("Whole", "");
    const auto fill = [&](CommandList& list) {
      if (each.stencil_view != Format::kUnknown) {
        list.ClearDepthStencilView(screen.dsv(), ClearFlags::kStencil, 0, 0xAB);
      }
      screen.cover(list, pipeline);
    };
    t.equal(what, read_through_view(screen, each.depth_view, fill), each.expected);
    if (each.stencil_view == Format::kUnknown) continue;
    ShaderResourceViewDesc view;
    view.Format = each.stencil_view;
    view.ViewDimension = SrvDimension::kTexture2D;
    view.Texture2D.PlaneSlice = 1;
    t.device()
        .CreateShaderResourceView(screen.depth_texture, view,
                                  screen.views.GetCPUDescriptorHandle(1))
        .value();
    GraphicsPipelineStateDesc desc = screen.desc("Whole", "ReadDepthAndStencil");
    desc.DepthStencilState.DepthEnable = false;
    desc.DSVFormat = Format::kUnknown;
    const PipelineState both = screen.make(desc);
    screen.run([&](CommandList& list) {
      fill(list);
      list.ResourceBarrier(ResourceBarrier::Transition(
          screen.depth_texture, ResourceStates::kDepthWrite, ResourceStates::kPixelShaderResource));
      const CpuDescriptorHandle target = screen.rtv();
      list.OMSetRenderTargets(1, &target);
      screen.cover(list, both);
      list.ResourceBarrier(ResourceBarrier::Transition(
          screen.depth_texture, ResourceStates::kPixelShaderResource, ResourceStates::kDepthWrite));
    });
    t.equal(what + ": depth beside stencil", screen.texel<float>(7, 2, 0), each.expected);
    t.equal(what + ": stencil in green", screen.texel<float>(7, 2, 1), 171.0f);
  }
}

}  // namespace

std::vector<RuleTest> ras_depth_tests() {
  std::vector<RuleTest> tests = {
      {"RAS-58", planes_of_depth},          {"RAS-59", shaders_read_the_tested_depth},
      {"RAS-60", depth_is_rounded, "*"},    {"RAS-61", the_eight_functions, "*"},
      {"RAS-62", tests_need_a_buffer, "*"}, {"RAS-63", equal_positions_equal_depth}};
  const std::vector<RuleTest> bias = ras_depth_bias_tests();
  tests.insert(tests.end(), bias.begin(), bias.end());
  tests.push_back({"RAS-69", shaders_write_depth, "*"});
  tests.push_back({"RAS-71", formats_of_depth});
  tests.push_back(ras_stencil_test());
  tests.push_back(ras_multisample_test());
  return tests;
}

}  // namespace kaamos::conformance

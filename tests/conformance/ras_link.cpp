// SPDX-License-Identifier: MIT
//
// Rules between vertex and pixel shader.
#include <shaders/ras_link.h>

#include "tests/conformance/checked.h"
#include "tests/conformance/compile.h"
#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

Result<PipelineState> link(Context& t, const std::string& vertex, const std::string& pixel) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_link();
  return t.device().CreateGraphicsPipelineState(screen.desc(vertex, pixel));
}

void semantics_link_stages(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_link();
  for (const char* pixel : {"InOrder", "OtherOrder"}) {
    const PipelineState pipeline = screen.make("Outputs", pixel);
    screen.run([&](CommandList& list) { screen.cover(list, pipeline); });
    for (uint32_t c = 0; c < 4; ++c) {
      t.close(pixel, screen.texel<float>(1, 2, c), static_cast<float>(1 << c), 0x1p-20f);
    }
  }
  t.refused("float4 from float2", link(t, "Outputs", "WantsMore"), "KA0724");
  t.refused("int from uint", link(t, "Outputs", "WantsInt"), "KA0724");
  t.refused("no such output", link(t, "Outputs", "WantsOther"), "KA0724");
  Checked checked(t);
  checked.accepted("in order", link(checked, "Outputs", "InOrder"));
  checked.silent("in order");
  checked.accepted("in another order", link(checked, "Outputs", "OtherOrder"));
  checked.told("in another order", "KA0728");
}

void integers_are_flat(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Uint}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_link();
  const PipelineState pipeline = screen.make("Outputs", "Integers");
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    // Vertex 1 leads.
    screen.indices(list, std::vector<uint16_t>{1, 2, 0});
    list.DrawIndexedInstanced(3, 1, 0, 0, 0);
  });
  t.equal("uint", screen.texel<uint32_t>(3, 0, 0), 33u);
  t.equal("int", screen.texel<int32_t>(3, 0, 1), -65);
  t.refused(
      "linear uint",
      compile("[shader(\"pixel\")]\n"
              "float4 ps(linear uint id : ID) : SV_Target { return float4(id, 0, 0, 0); }\n"));
}

void eight_distances(Context& t) {
  Screen screen(t);
  screen.library = kaamos_shaders_ras_link();
  const PipelineState pipeline = screen.make("Eight", "ReadsClip");
  screen.run([&](CommandList& list) { screen.cover(list, pipeline); });
  t.equal("4 + 4: px that differ",
          screen.differing<float>([](uint32_t x, uint32_t) { return x < 128 ? 0.0f : 1.0f; }), 0u);
  t.close("as interpolated", screen.texel<float>(160, 9, 3), 32.5f / 128, 0x1p-20f);
  const auto nine = compile(
      "struct V {\n"
      "  float4 position : SV_Position;\n"
      "  float4 a : SV_ClipDistance0;\n  float b : SV_ClipDistance1;\n"
      "  float4 c : SV_CullDistance0;\n};\n"
      "[shader(\"vertex\")]\n"
      "V vs() {\n  V v;\n  v.position = v.a = v.c = float4(0, 0, 0, 1);\n  v.b = 0;\n"
      "  return v;\n}\n");
  t.refused("5 + 4", nine);
}

void positions_are_needed(Context& t) {
  const auto result = link(t, "Nowhere", "Tint");
  t.refused("no SV_Position", result, "KA0724");
  if (!result) {
    t.holds("it is named: " + result.error().message,
            result.error().message.find("SV_Position") != std::string::npos);
  }
}

void depth_without_a_pixel_shader(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kD32Float, 32);
  const PipelineState tint = screen.make("Whole", "Tint");
  const PipelineState depth_only = screen.make("Whole", "");
  screen.run([&](CommandList& list) {
    screen.cover(list, tint, {.tint = {3, 0, 0, 0}, .depth = 0.75f});
    screen.cover(list, depth_only, {.depth = 0.25f});
  });
  t.equal("colours that differ", screen.differing<float>([](uint32_t, uint32_t) { return 3.0f; }),
          0u);
  t.equal("depths that differ",
          screen.count([&](uint32_t x, uint32_t y) { return screen.depth(x, y) != 0.25f; }), 0u);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "");
  desc.DepthStencilState.DepthEnable = false;
  const PipelineState nothing = screen.make(desc);
  screen.run([&](CommandList& list) { screen.cover(list, nothing, {.depth = 0.25f}); });
  t.equal("neither: colours", screen.covered(), 0u);
  t.equal("neither: depth", screen.depth(9, 9), 1.0f);
}

}  // namespace

std::vector<RuleTest> ras_link_tests() {
  return {{"RAS-21", semantics_link_stages},
          {"RAS-22", integers_are_flat},
          {"RAS-23", eight_distances},
          {"RAS-24", positions_are_needed},
          {"RAS-25", depth_without_a_pixel_shader, "*"}};
}

}  // namespace kaamos::conformance

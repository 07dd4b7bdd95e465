// SPDX-License-Identifier: MIT
//
// Rules of viewports, scissors and array indices.
#include <shaders/ras_viewport.h>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

// Fails unless exactly these pixels are covered.
void check_covered(Context& t, const Screen& screen, const std::string& what, const Rect& rect) {
  t.equal(what + ": px that differ", screen.count([&](uint32_t ux, uint32_t uy) {
    const auto x = static_cast<int32_t>(ux);
    const auto y = static_cast<int32_t>(uy);
    const bool inside = x >= rect.left && x < rect.right && y >= rect.top && y < rect.bottom;
    return (screen.texel<float>(ux, uy) != 0) != inside;
  }),
          0u);
}

void viewports_map_to_pixels(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kD32Float);
  const PipelineState pipeline = screen.make("Pass", "Value");
  const auto box = [&](float left, float top, float right, float bottom, float z) {
    std::vector<Corner> out = screen.rectangle(0, 0, 256, 256, z);
    for (Corner& c : out) {
      c.position[0] = c.position[0] < 0 ? left : right;
      c.position[1] = c.position[1] > 0 ? top : bottom;
    }
    return out;
  };
  screen.draw(pipeline, box(-1, 1, 1, 0, 0.5f));
  check_covered(t, screen, "y >= 0", {0, 0, 256, 128});
  screen.draw(pipeline, box(-1, 1, -1 + 1.0f / 128, 1 - 1.0f / 128, 0.5f));
  check_covered(t, screen, "the first pixel", {0, 0, 1, 1});
  for (const float z : {0.0f, 0.25f, 0.5f, 1.0f}) {
    screen.run([&](CommandList& list) {
      list.RSSetViewports(Viewport{32, 64, 64, 128, 0.25f, 0.75f});
      screen.draw(list, pipeline, box(-0.5f, 0.5f, 1, -0.25f, z));
    });
    check_covered(t, screen, "part of a viewport", {48, 96, 96, 144});
    t.equal("depth", screen.depth(50, 100), 0.25f + z / 2);
  }
}

void viewports_between_pixels(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = screen.make("Pass", "Value");
  const auto at_offset = [&](float x, float y) {
    screen.run([&](CommandList& list) {
      list.RSSetViewports(Viewport{x, y, 256, 256, 0, 1});
      screen.draw(list, pipeline, screen.rectangle(10, 10, 20, 20));
    });
  };
  at_offset(0.25f, 0);
  check_covered(t, screen, "0.25", {10, 10, 20, 20});
  at_offset(0.75f, 0.75f);
  check_covered(t, screen, "0.75", {11, 11, 21, 21});
  at_offset(0.5f, 0.5f + 1.0f / 256);
  check_covered(t, screen, "0.5", {10, 11, 20, 21});
}

void viewports_cut(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = screen.make("Pass", "Value");
  screen.run([&](CommandList& list) {
    list.RSSetViewports(Viewport{64, 64, 128, 128, 0, 1});
    screen.draw(list, pipeline, screen.rectangle(-128, -128, 384, 384));
  });
  check_covered(t, screen, "a rectangle of +-2", {64, 64, 192, 192});
}

void both_must_be_set(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 32);
  const PipelineState pipeline = screen.make("Whole", "Tint");
  for (const bool scissor : {false, true}) {
    CommandList list = t.device().CreateCommandList().value();
    const CpuDescriptorHandle target = screen.rtv();
    const float zeros[4] = {};
    list.ClearRenderTargetView(target, zeros);
    list.SetGraphicsRootSignature(screen.root_signature);
    list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleList);
    list.OMSetRenderTargets(1, &target);
    if (scissor) {
      list.RSSetScissorRects(Rect{0, 0, 32, 32});
    } else {
      list.RSSetViewports(Viewport{0, 0, 32, 32, 0, 1});
    }
    screen.cover(list, pipeline);
    list.Close().value();
    t.accepted("draw", t.queue().ExecuteAndWait(list));
    screen.clears = false;
    screen.run([](CommandList&) {});
    t.equal(scissor ? "no viewport: px" : "no scissor: px", screen.covered(), 0u);
  }
}

void scissors(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = screen.make("Whole", "Tint");
  const auto with = [&](const std::string& what, const Rect& rect, const Rect& covered) {
    screen.run([&](CommandList& list) {
      list.RSSetScissorRects(rect);
      screen.cover(list, pipeline);
    });
    check_covered(t, screen, what, covered);
  };
  with("inside", {10, 10, 20, 20}, {10, 10, 20, 20});
  with("empty", {10, 10, 10, 20}, {});
  with("inverted", {20, 20, 10, 10}, {});
  with("beyond upper left", {-5, -5, 5, 5}, {0, 0, 5, 5});
  with("beyond lower right", {250, 240, 300, 2000000000}, {250, 240, 256, 256});
  with("outside", {300, 300, 400, 400}, {});
  with("all there is", {-2147483647 - 1, -2147483647 - 1, 2147483647, 2147483647},
       {0, 0, 256, 256});
}

void depth_stays_in_the_viewport(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Float}, Format::kD32Float, 8);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "OwnDepth");
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kAlways;
  desc.RasterizerState.DepthClipEnable = false;
  const PipelineState own = screen.make(desc);
  desc.PS = screen.shader("Place");
  const PipelineState place = screen.make(desc);
  const auto with = [&](const PipelineState& pipeline, float red, float z) {
    screen.run([&](CommandList& list) {
      list.RSSetViewports(Viewport{0, 0, 8, 8, 0.25f, 0.5f});
      screen.cover(list, pipeline, {.tint = {red, 0, 0, 0}, .depth = z});
    });
    return screen.depth(4, 4);
  };
  t.equal("SV_Depth 0.9", with(own, 0.9f, 0.5f), 0.5f);
  t.equal("SV_Depth 0.1", with(own, 0.1f, 0.5f), 0.25f);
  t.equal("SV_Depth 0.375", with(own, 0.375f, 0.5f), 0.375f);
  desc.PS = screen.shader("NoLessDepth");
  const PipelineState rises = screen.make(desc);
  desc.PS = screen.shader("NoMoreDepth");
  const PipelineState falls = screen.make(desc);
  t.equal("SV_DepthGreaterEqual above", with(rises, 0.4375f, 0.5f), 0.4375f);
  t.equal("SV_DepthGreaterEqual below", with(rises, 0.3125f, 0.5f), 0.375f);
  t.equal("SV_DepthLessEqual above", with(falls, 0.4375f, 0.5f), 0.375f);
  t.equal("SV_DepthLessEqual below", with(falls, 0.3125f, 0.5f), 0.3125f);
  t.equal("z 1.5", with(place, 0, 1.5f), 0.5f);
  t.equal("z 1.5: SV_Position.z", screen.texel<float>(4, 4, 2), 0.625f);
  t.equal("z -1", with(place, 0, -1), 0.25f);
  t.equal("z -1: SV_Position.z", screen.texel<float>(4, 4, 2), 0.0f);
}

void viewports_may_be_inverted(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Uint}, Format::kD32Float, 32);
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Facts");
  desc.DepthStencilState.DepthFunc = ComparisonFunc::kAlways;
  const PipelineState pipeline = screen.make(desc);
  // The upper half, clockwise.
  const std::vector<Corner> corners = screen.rectangle(0, 0, 32, 16, 0.25f);
  screen.run([&](CommandList& list) {
    list.RSSetViewports(Viewport{0, 0, 32, 32, 1, 0});
    screen.draw(list, pipeline, corners);
  });
  t.equal("depth 1 to 0", screen.depth(3, 3), 0.75f);
  t.holds("front", screen.fact(3, 3).front);
  screen.run([&](CommandList& list) {
    list.RSSetViewports(Viewport{0, 32, 32, -32, 0, 1});
    screen.draw(list, pipeline, corners);
  });
  t.equal("upside down: px that differ", screen.count([&](uint32_t x, uint32_t y) {
    const Fact fact = screen.fact(x, y);
    return fact.covered != (y >= 16) || fact.front;
  }),
          0u);
}

void viewports_without_area(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = screen.make("Whole", "Tint");
  for (const Viewport& viewport : {Viewport{0, 0, 0, 256, 0, 1}, Viewport{256, 0, -256, 256, 0, 1},
                                   Viewport{0, 0, 256, 0, 0, 1}, Viewport{0, 0, 0, 0, 0, 1}}) {
    screen.run([&](CommandList& list) {
      list.RSSetViewports(viewport);
      screen.cover(list, pipeline);
    });
    t.equal("px of " + std::to_string(viewport.Width) + " x " + std::to_string(viewport.Height),
            screen.covered(), 0u);
  }
}

void shaders_pick_viewports(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Uint}, Format::kUnknown, 32);
  screen.library = kaamos_shaders_ras_viewport();
  const PipelineState pipeline = screen.make("ToViewport", "ReadPlace");
  // Viewports beside each other; the scissor of number 1 leaves the upper half.
  const auto draw = [&](uint32_t first, uint32_t instances) {
    screen.run([&](CommandList& list) {
      const Viewport viewports[] = {{0, 0, 16, 32, 0, 1}, {16, 0, 16, 32, 0, 1}};
      const Rect rects[] = {{0, 0, 32, 32}, {0, 0, 32, 16}};
      list.RSSetViewports(viewports);
      list.RSSetScissorRects(rects);
      Screen::use(list, pipeline, {.number = first});
      list.DrawInstanced(3, instances, 0, 0);
    });
  };
  const auto check = [&](const std::string& what, uint32_t left, bool right) {
    t.equal(what + ": px that differ", screen.count([&](uint32_t x, uint32_t y) {
      const bool inside = x < 16 ? left != ~0u : right && y < 16;
      if ((screen.texel<uint32_t>(x, y, 2) != 0) != inside) return true;
      return inside && screen.texel<uint32_t>(x, y, 0) != (x < 16 ? left : 1u);
    }),
            0u);
  };
  draw(0, 2);
  check("two instances", 0, true);
  draw(1, 1);
  check("number 1", ~0u, true);
  draw(5, 1);
  check("one that is not set", ~0u, false);
  draw(16, 1);
  check("16 counts as 0", 16, false);
  draw(0xFFFFFFF0u, 1);
  check("2^32 - 16 counts as 0", 0xFFFFFFF0u, false);
}

void shaders_pick_slices(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Uint}, Format::kD32Float, 8, 6);
  screen.library = kaamos_shaders_ras_viewport();
  const PipelineState pipeline = screen.make("ToSlice", "ReadPlace");
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    list.DrawInstanced(3, 6, 0, 0);
  });
  for (uint32_t slice = 0; slice < 6; ++slice) {
    t.equal("slice " + std::to_string(slice) + ": px that differ",
            screen.differing<uint32_t>([&](uint32_t, uint32_t) { return slice; }, 1, 0, slice), 0u);
    t.equal("covered", screen.texel<uint32_t>(3, 3, 2, 0, slice), 1u);
  }
  screen.run([&](CommandList& list) { screen.cover(list, pipeline, {.number = 7}); });
  for (uint32_t slice = 0; slice < 6; ++slice) {
    t.equal("7 is slice 0", screen.texel<uint32_t>(5, 2, 2, 0, slice), slice == 0 ? 1u : 0u);
  }
  t.equal("what the shader reads", screen.texel<uint32_t>(5, 2, 1), 7u);
}

}  // namespace

std::vector<RuleTest> ras_viewport_tests() {
  return {{"RAS-37", viewports_map_to_pixels},
          {"RAS-38", viewports_between_pixels},
          {"RAS-39", viewports_cut},
          {"RAS-40", both_must_be_set, "*"},
          {"RAS-41", scissors, "*"},
          {"RAS-42", depth_stays_in_the_viewport},
          {"RAS-43", viewports_may_be_inverted},
          {"RAS-44", viewports_without_area, "*"},
          {"RAS-45", shaders_pick_viewports, "*"},
          {"RAS-46", shaders_pick_slices}};
}

}  // namespace kaamos::conformance

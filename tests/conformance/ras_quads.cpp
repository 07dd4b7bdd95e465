// SPDX-License-Identifier: MIT
//
// Rules of quads: derivatives, helper lanes, discard.
#include <shaders/ras_quads.h>

#include <cmath>
#include <limits>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr Format kFloats = Format::kR32G32B32A32Float;

Screen quad_screen(Context& t, uint32_t size, std::vector<Format> formats = {kFloats},
                   Format depth = Format::kUnknown) {
  Screen screen(t, std::move(formats), depth, size);
  screen.library = kaamos_shaders_ras_quads();
  return screen;
}

void quads_of_the_target(Context& t) {
  Screen screen = quad_screen(t, 32);
  const PipelineState of_position = screen.make("Pass", "OfPosition");
  const PipelineState of_squares = screen.make("Pass", "OfSquares");
  // One pixel each, at every place in a quad.
  for (const uint32_t at : {10u, 11u}) {
    for (const uint32_t down : {20u, 21u}) {
      const auto x = static_cast<float>(at), y = static_cast<float>(down);
      screen.draw(of_position, {screen.at(x + 0.25f, y + 0.25f), screen.at(x + 0.9f, y + 0.25f),
                                screen.at(x + 0.25f, y + 0.9f)});
      const float expected[] = {1, 0, 0, 1};
      for (uint32_t c = 0; c < 4; ++c) {
        t.equal("derivative of SV_Position", screen.texel<float>(at, down, c), expected[c]);
      }
      t.equal("px", screen.covered(), 1u);
    }
  }
  // The origin of the viewport does not move quads.
  for (const float origin : {0.0f, 1.0f, 3.0f}) {
    screen.run([&](CommandList& list) {
      list.RSSetViewports(Viewport{origin, origin, 32, 32, 0, 1});
      screen.draw(list, of_squares, screen.rectangle(-32, -32, 64, 64));
    });
    t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
      if (screen.texel<float>(x, y, 3) == 0) return x >= 3 && y >= 3;
      // (b + 1.5)^2 - (b + 0.5)^2
      return screen.texel<float>(x, y, 0) != static_cast<float>(2 * (x & ~1u) + 2) ||
             screen.texel<float>(x, y, 1) != static_cast<float>(2 * (y & ~1u) + 2) ||
             screen.texel<float>(x, y, 2) != 0;
    }),
            0u);
  }
}

void fine_derivatives(Context& t) {
  Screen screen = quad_screen(t, 32);
  const PipelineState pipeline = screen.make("Whole", "FineOfProduct");
  screen.run([&](CommandList& list) { screen.cover(list, pipeline); });
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    return screen.texel<float>(x, y, 0) != static_cast<float>(y) + 0.5f ||
           screen.texel<float>(x, y, 1) != static_cast<float>(x) + 0.5f;
  }),
          0u);
}

void coarse_derivatives(Context& t) {
  Screen screen = quad_screen(t, 32, {kFloats, kFloats});
  const PipelineState pipeline = screen.make("Whole", "CoarseOfProduct");
  screen.run([&](CommandList& list) { screen.cover(list, pipeline); });
  const bool ours = t.target().backend != "vulkan";
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    const auto along = [&](uint32_t component, uint32_t across) {
      const auto found = screen.texel<float>(x, y, component);
      const float first = static_cast<float>(across & ~1u) + 0.5f;
      return found == first || (!ours && found == first + 1);
    };
    const bool right = along(0, y) && along(1, x) && along(2, y) && along(3, x);
    return !right || screen.texel<float>(x, y, 0, 1) !=
                         screen.texel<float>(x, y, 2) + screen.texel<float>(x, y, 3);
  }),
          0u);
}

void helpers_extrapolate(Context& t) {
  Screen screen = quad_screen(t, 64);
  // x / 32 + y / 128, and another slope, on thin slanted triangles.
  const auto corner = [&](float x, float y) {
    return screen.at(x, y, 0.5f, 1, {x / 32 + y / 128, x / 8 - y / 16, 0, 0});
  };
  screen.draw(screen.make("Pass", "OfValue"), {corner(3, 2), corner(60, 40), corner(50, 41),
                                               corner(5, 60), corner(7, 10), corner(20, 61)});
  uint32_t drawn = 0;
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    if (screen.texel<float>(x, y, 3) == 0) return false;
    ++drawn;
    return !(std::abs(screen.texel<float>(x, y, 0) - 1.0f / 32) <= 0x1p-17f &&
             std::abs(screen.texel<float>(x, y, 1) - 1.0f / 128) <= 0x1p-17f &&
             std::abs(screen.texel<float>(x, y, 2) - 1.0f / 8) <= 0x1p-15f);
  }),
          0u);
  t.holds("drawn: " + std::to_string(drawn), drawn > 400);
}

void helpers_write_nothing(Context& t) {
  Screen screen = quad_screen(t, 16);
  const PipelineState pipeline = screen.make("Pass", "Counted");
  screen.draw(pipeline, {screen.at(1, 1), screen.at(12, 3), screen.at(4, 14), screen.at(13, 9),
                         screen.at(14.2f, 9), screen.at(13, 10.2f)});
  const uint32_t covered =
      screen.count([&](uint32_t x, uint32_t y) { return screen.texel<float>(x, y, 3) != 0; });
  const std::vector<uint32_t> words = t.read(screen.words);
  t.holds("some", covered > 40 && covered < 100);
  t.equal("counted", words[0], covered);
  t.equal("px where stores differ", screen.count([&](uint32_t x, uint32_t y) {
    return (words[16 + x + y * 16] != 0) != (screen.texel<float>(x, y, 3) != 0);
  }),
          0u);
}

void discard_ends_effects(Context& t) {
  Screen screen = quad_screen(t, 16, {kFloats}, Format::kD32Float);
  const PipelineState pipeline = screen.make("Whole", "Checkers");
  screen.run([&](CommandList& list) { screen.cover(list, pipeline); });
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    const bool kept = (x + y) % 2 == 0;
    if (screen.depth(x, y) != (kept ? 0.5f : 1.0f)) return true;
    if (!kept) return screen.texel<float>(x, y, 3) != 0;
    return screen.texel<float>(x, y, 0) != 3 || screen.texel<float>(x, y, 1) != 5;
  }),
          0u);
  const std::vector<uint32_t> words = t.read(screen.words);
  t.equal("writes before", words[0], 256u);
  t.equal("writes after", words[1], 128u);
}

void clip_below_zero(Context& t) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  Screen screen = quad_screen(t, 4);
  const PipelineState pipeline = screen.make("Whole", "ClipsTint");
  const auto drawn = [&](std::array<float, 4> value) {
    screen.run([&](CommandList& list) { screen.cover(list, pipeline, {.tint = value}); });
    return screen.covered();
  };
  t.equal("clip(0)", drawn({0, 0, 0, 0}), 16u);
  t.equal("clip(-0)", drawn({-0.0f, -0.0f, -0.0f, -0.0f}), 16u);
  t.equal("clip(NaN)", drawn({kNaN, kNaN, kNaN, kNaN}), 16u);
  t.equal("clip(-1e-30)", drawn({-1e-30f, 1, 1, 1}), 0u);
  t.equal("clip of the last component", drawn({1, 1, 1, -1}), 0u);
  t.equal("clip of -1 beside NaN", drawn({kNaN, -1, kNaN, 1}), 0u);
}

void lanes_that_go_apart(Context& t) {
  Screen screen = quad_screen(t, 16);
  // The value is 3 x.
  std::vector<Corner> corners = screen.rectangle(0, 0, 16, 16);
  for (Corner& corner : corners) corner.value[0] = (corner.position[0] + 1) * 24;
  screen.draw(screen.make("Pass", "WhereLanesGoApart"), corners);
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    const bool on = x >= 5;
    // Pixels 4 and 5 are a quad of which one lane goes in. Inputs have derivatives all the same.
    return screen.texel<float>(x, y, 0) != (on ? 1.0f : 0.0f) ||
           !(std::abs(screen.texel<float>(x, y, 1) - (on ? 3.0f : 0.0f)) <= 0x1p-16f);
  }),
          0u);
}

void failed_tests_make_helpers(Context& t) {
  Screen screen = quad_screen(t, 16, {kFloats}, Format::kD32Float);
  const PipelineState depth_only = screen.make("Pass", "");
  const PipelineState pipeline = screen.make("Pass", "OfValue");
  std::vector<Corner> corners = screen.rectangle(0, 0, 16, 16);
  for (Corner& corner : corners) corner.value[0] = (corner.position[0] + 1) * 16;  // 2 x
  screen.run([&](CommandList& list) {
    // Every second column, and every third row, is in front.
    for (uint32_t i = 1; i < 16; i += 2) {
      const auto at = static_cast<float>(i);
      screen.draw(list, depth_only, screen.rectangle(at, 0, at + 1, 16, 0.25f));
    }
    for (uint32_t i = 0; i < 16; i += 3) {
      const auto at = static_cast<float>(i);
      screen.draw(list, depth_only, screen.rectangle(0, at, 16, at + 1, 0.25f));
    }
    screen.draw(list, pipeline, corners);
  });
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    const bool visible = x % 2 == 0 && y % 3 != 0;
    if ((screen.texel<float>(x, y, 3) != 0) != visible) return true;
    return visible && !(std::abs(screen.texel<float>(x, y, 0) - 2) <= 0x1p-16f &&
                        std::abs(screen.texel<float>(x, y, 1)) <= 0x1p-16f);
  }),
          0u);
}

void a_quad_of_two_triangles(Context& t) {
  Screen screen = quad_screen(t, 16);
  screen.draw(screen.make("Pass", "Counted"), screen.rectangle(0, 0, 16, 16));
  t.equal("counted", t.read(screen.words)[0], 256u);
}

}  // namespace

std::vector<RuleTest> ras_quad_tests() {
  return {{"RAS-81", quads_of_the_target},       {"RAS-82", fine_derivatives},
          {"RAS-83", coarse_derivatives},        {"RAS-84", helpers_extrapolate},
          {"RAS-85", helpers_write_nothing},     {"RAS-86", discard_ends_effects},
          {"RAS-87", clip_below_zero},           {"RAS-88", lanes_that_go_apart, "*"},
          {"RAS-89", failed_tests_make_helpers}, {"RAS-90", a_quad_of_two_triangles}};
}

}  // namespace kaamos::conformance

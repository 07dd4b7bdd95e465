// SPDX-License-Identifier: MIT
//
// Rules of clipping.
#include <shaders/ras_clip.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

Corner clip_corner(float x, float y, float z, float w, std::array<float, 4> value = {1, 1, 1, 1}) {
  return {{x, y, z, w}, value};
}

// The target from side to side; z goes from `left` to `right`.
std::vector<Corner> tilted(float left, float right) {
  const Corner corners[] = {clip_corner(-1, 1, left, 1), clip_corner(1, 1, right, 1),
                            clip_corner(-1, -1, left, 1), clip_corner(1, -1, right, 1)};
  return {corners[0], corners[1], corners[2], corners[2], corners[1], corners[3]};
}

void near_and_far_clip(Context& t) {
  Screen screen(t, {Format::kR32Float});
  screen.draw(screen.make("Pass", "Value"), tilted(-0.5f, 1.5f));
  t.equal("px between 0 and 1 that are missing", screen.count([&](uint32_t x, uint32_t y) {
    return x >= 65 && x < 191 && screen.texel<float>(x, y) == 0;
  }),
          0u);
  t.equal("px outside that are drawn", screen.count([&](uint32_t x, uint32_t y) {
    return (x < 63 || x >= 193) && screen.texel<float>(x, y) != 0;
  }),
          0u);
}

void depth_clip_off(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kD32Float, 8);
  screen.clear_depth = 0.125f;
  for (const bool clip : {true, false}) {
    GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
    desc.RasterizerState.DepthClipEnable = clip;
    desc.DepthStencilState.DepthFunc = ComparisonFunc::kAlways;
    const PipelineState pipeline = screen.make(desc);
    const std::string what = clip ? "clip, z " : "no clip, z ";
    const float stored[5][2] = {{0, 0}, {0.5f, 0.5f}, {0, 0.125f}, {1, 1}, {1, 0.125f}};
    int i = 0;
    for (const float z : {0.0f, 0.5f, -0.5f, 1.0f, 1.5f}) {
      screen.run([&](CommandList& list) { screen.cover(list, pipeline, {.depth = z}); });
      t.equal(what + std::to_string(z), screen.depth(3, 5), stored[i++][clip ? 1 : 0]);
    }
    desc.PS = screen.shader("OwnDepth");
    const PipelineState own = screen.make(desc);
    screen.run([&](CommandList& list) { screen.cover(list, own, {.tint = {2, 0, 0, 0}}); });
    t.equal(what + "SV_Depth 2", screen.depth(3, 5), 1.0f);
  }
  // The depth that the shader reads is not limited.
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Place");
  desc.RTVFormats = {Format::kR32G32B32A32Float};
  desc.RasterizerState.DepthClipEnable = false;
  Screen wide(t, desc.RTVFormats, Format::kUnknown, 8);
  desc.DSVFormat = Format::kUnknown;
  desc.DepthStencilState.DepthEnable = false;
  const PipelineState place = wide.make(desc);
  for (const float z : {-0.5f, 1.5f}) {
    wide.run([&](CommandList& list) { wide.cover(list, place, {.depth = z}); });
    t.equal("SV_Position.z", wide.texel<float>(2, 6, 2), z);
  }
}

// A floor one unit below the eye, which looks along z; from -10 to `far`. w is z, the value is z.
std::vector<Corner> floor_to(float far) {
  const auto point = [](float x, float z) { return clip_corner(x, -1, z / 2, z, {z, z, 0, 0}); };
  const Corner corners[] = {point(-2000, far), point(2000, far), point(-2000, -10),
                            point(2000, -10)};
  return {corners[0], corners[1], corners[2], corners[2], corners[1], corners[3]};
}

void behind_the_eye(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = screen.make("Pass", "Value");
  screen.draw(pipeline, floor_to(1000));
  t.equal("floor: px that differ", screen.count([&](uint32_t x, uint32_t y) {
    return (screen.texel<float>(x, y) != 0) != (y >= 128);
  }),
          0u);
  std::vector<Corner> corners = screen.rectangle(0, 0, 256, 256);
  for (Corner& corner : corners) corner.position[3] = -1;
  screen.draw(pipeline, corners);
  t.equal("all w = -1: px", screen.covered(), 0u);
}

void directions(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = screen.make("Pass", "Value");
  // From (-0.5, 0.5) and (-0.5, -0.5) to infinity in the direction of x.
  for (const float w : {0.0f, 1e-40f}) {
    screen.draw(pipeline, {clip_corner(-0.5f, 0.5f, 0.5f, 1), clip_corner(1, 0, w / 2, w),
                           clip_corner(-0.5f, -0.5f, 0.5f, 1)});
    uint32_t worst = 0;
    for (uint32_t y = 0; y < 256; ++y) {
      uint32_t row = 0;
      for (uint32_t x = 0; x < 256; ++x) {
        const bool inside = x >= 64 && y >= 64 && y < 192;
        row += (screen.texel<float>(x, y) != 0) != inside ? 1 : 0;
      }
      // Rows at the border may differ, since the corner at infinity moves.
      if (y != 64 && y != 191) worst = std::max(worst, row);
    }
    t.holds("w = " + std::to_string(w) + ": " + std::to_string(worst) + " px of a row differ",
            worst <= 1);
  }
}

// A strip of four triangles with something wrong at vertex 1, then one triangle more.
void strip_without_two(Context& t, Screen& screen, const PipelineState& pipeline,
                       const std::string& what, size_t component, float value,
                       bool may_be_drawn = false) {
  std::vector<Corner> corners = {screen.at(0, 0),   screen.at(16, 0), screen.at(0, 16),
                                 screen.at(16, 16), screen.at(0, 32), screen.at(16, 32)};
  for (Corner& corner : corners) corner.value[0] = 1;
  corners[1].position[component] = value;
  screen.run([&](CommandList& list) {
    list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleStrip);
    screen.draw(list, pipeline, corners);
  });
  // Triangles 0 and 1 are the square above.
  t.equal(what + ": px that differ", screen.count([&](uint32_t x, uint32_t y) {
    if (may_be_drawn && y < 16) return false;
    return (screen.texel<float>(x, y) != 0) != (x < 16 && y >= 16);
  }),
          0u);
}

void nan_drops_triangles(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 32);
  const PipelineState pipeline = screen.make("Pass", "Value");
  for (size_t c = 0; c < 4; ++c) {
    strip_without_two(t, screen, pipeline, "NaN in " + std::string(1, "xyzw"[c]), c, kNaN);
  }
}

void infinities_drop_triangles(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 32);
  const PipelineState pipeline = screen.make("Pass", "Value");
  for (const float value : {kInf, -kInf}) {
    for (size_t c = 0; c < 4; ++c) {
      strip_without_two(t, screen, pipeline, "infinite " + std::string(1, "xyzw"[c]), c, value,
                        t.target().backend == "vulkan");
    }
  }
}

void huge_positions(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = screen.make("Pass", "Value");
  for (const float size : {1e5f, 1e7f, 1e12f, 1e30f, 1e34f}) {
    screen.draw(pipeline, {clip_corner(-size, size, 0.5f, 1), clip_corner(3 * size, size, 0.5f, 1),
                           clip_corner(-size, -3 * size, 0.5f, 1)});
    t.equal("px of a triangle of " + std::to_string(size), screen.covered(), 65536u);
  }
}

void cut_triangles_interpolate(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Uint});
  screen.library = kaamos_shaders_ras_clip();
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "ReadThree");
  desc.VS = screen.shader("Three");
  const PipelineState pipeline = screen.make(desc);
  // The leading vertex of the first triangle is behind the eye.
  std::vector<Corner> corners = floor_to(1000);
  std::swap(corners[0], corners[2]);
  for (Corner& corner : corners) corner.value[0] = std::bit_cast<float>(0x12345678u);
  corners[0].value[0] = std::bit_cast<float>(0x7FC00001u);
  corners[3].value[0] = std::bit_cast<float>(0x7FC00001u);
  screen.draw(pipeline, corners);
  t.equal("leading vertex: px that differ", screen.count([&](uint32_t x, uint32_t y) {
    return screen.texel<uint32_t>(x, y, 0) != (y >= 128 ? 0x7FC00001u : 0u);
  }),
          0u);
  // The floor at a pixel is 1 / ndc y away. Rounding of new corners moves it by 1/256 px at most.
  t.equal("linear: px that differ", screen.count([&](uint32_t x, uint32_t y) {
    if (y < 140) return false;
    const float below = static_cast<float>(y) + 0.5f - 128;
    const float expected = 128 / below;
    return !(std::abs(screen.texel<float>(x, y, 1) - expected) <= expected / below / 256);
  }),
          0u);
  // Cut at z = 0, with different w: a value that is the place on the screen.
  const auto point = [](float x, float y, float z, float w) {
    return clip_corner(x * w, y * w, z * w, w, {0, 0, x, 0});
  };
  screen.draw(pipeline, {point(-1, 1, -0.5f, 1), point(1, 1, 1, 4), point(-1, -1, -0.5f, 2)});
  uint32_t drawn = 0;
  const uint32_t wrong = screen.count([&](uint32_t x, uint32_t y) {
    if (screen.texel<uint32_t>(x, y, 3) == 0) return false;
    ++drawn;
    const float expected = (static_cast<float>(x) + 0.5f) / 128 - 1;
    return !(std::abs(screen.texel<float>(x, y, 2) - expected) <= 1.0f / 256 / 128);
  });
  t.holds("drawn: " + std::to_string(drawn), drawn > 10000 && drawn < 30000);
  t.equal("noperspective: px that differ", wrong, 0u);
}

PipelineState with_distances(Screen& screen, const char* vertex) {
  screen.library = kaamos_shaders_ras_clip();
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Tint");
  desc.VS = screen.shader(vertex);
  return screen.make(desc);
}

void clip_distances(Context& t) {
  Screen screen(t, {Format::kR32Float});
  const PipelineState pipeline = with_distances(screen, "ClipsAtXY");
  std::vector<Corner> corners = screen.rectangle(0, 0, 256, 256);
  for (Corner& corner : corners) corner.value = {corner.position[0], 1, 0, 0};
  screen.draw(pipeline, corners);
  t.equal("x: px that differ",
          screen.differing<float>([](uint32_t x, uint32_t) { return x < 128 ? 0.0f : 1.0f; }), 0u);
  for (Corner& corner : corners) corner.value[1] = corner.position[1];
  screen.draw(pipeline, corners);
  t.equal("x and y: px that differ", screen.differing<float>([](uint32_t x, uint32_t y) {
    return x < 128 || y >= 128 ? 0.0f : 1.0f;
  }),
          0u);
  for (Corner& corner : corners) corner.value = {1, 1, 0, 0};
  corners[4].value[1] = kNaN;  // of the second triangle
  screen.draw(pipeline, corners);
  t.equal("NaN: px that differ", screen.count([&](uint32_t x, uint32_t y) {
    return (screen.texel<float>(x, y) != 0) != (x + y < 255);
  }),
          0u);
}

void cull_distances(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 16);
  const PipelineState pipeline = with_distances(screen, "CullsAtXY");
  const auto covered = [&](std::array<float, 3> first, std::array<float, 3> second) {
    std::vector<Corner> corners = {clip_corner(-1, 1, 0.5f, 1), clip_corner(3, 1, 0.5f, 1),
                                   clip_corner(-1, -3, 0.5f, 1)};
    for (size_t i = 0; i < 3; ++i) corners[i].value = {first[i], second[i], 0, 0};
    screen.draw(pipeline, corners);
    return screen.covered();
  };
  constexpr std::array<float, 3> kIn = {1, 1, 1};
  t.equal("(-1, -1, 0)", covered({-1, -1, 0.0f}, kIn), 256u);
  t.equal("(-1, -1, NaN)", covered({-1, -1, kNaN}, kIn), 0u);
  t.equal("(-1, -1, -1)", covered({-1, -1, -1}, kIn), 0u);
  t.equal("(-1, -1, -1) of the second", covered(kIn, {-1, -1, -1}), 0u);
  t.equal("each negative somewhere", covered({-1, 1, 1}, {1, -1, -1}), 256u);
}

void pieces_do_not_overlap(Context& t) {
  Screen screen(t, {Format::kR32Float});
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Tint");
  desc.BlendState.RenderTarget[0].BlendEnable = true;
  desc.BlendState.RenderTarget[0].DestBlend = Blend::kOne;
  const PipelineState pipeline = screen.make(desc);
  const auto check = [&](const char* what, const std::vector<Corner>& corners) {
    screen.draw(pipeline, corners);
    t.holds(what, screen.covered() > 1000);
    t.equal(std::string(what) + ": px that are not 0 or 1",
            screen.count([&](uint32_t x, uint32_t y) {
              return screen.texel<float>(x, y) != 0 && screen.texel<float>(x, y) != 1;
            }),
            0u);
  };
  check("cut by near and far", tilted(-0.7f, 1.9f));
  check("reaches behind the eye", floor_to(1000));
  std::vector<Corner> slanted = tilted(-0.4f, 1.3f);
  for (Corner& corner : slanted) corner.position[2] += corner.position[1] * 0.37f;
  check("slanted", slanted);
}

}  // namespace

std::vector<RuleTest> ras_clip_tests() {
  return {{"RAS-26", near_and_far_clip},        {"RAS-27", depth_clip_off},
          {"RAS-28", behind_the_eye, "*"},      {"RAS-29", directions, "KA0457"},
          {"RAS-30", nan_drops_triangles, "*"}, {"RAS-31", infinities_drop_triangles, "*"},
          {"RAS-32", huge_positions, "*"},      {"RAS-33", cut_triangles_interpolate},
          {"RAS-34", clip_distances, "*"},      {"RAS-35", cull_distances, "*"},
          {"RAS-36", pieces_do_not_overlap}};
}

}  // namespace kaamos::conformance

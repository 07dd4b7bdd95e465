// SPDX-License-Identifier: MIT
//
// Rules of interpolation and of the system values of pixel shaders.
#include <shaders/ras_attributes.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "tests/conformance/compile.h"
#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr Format kFour = Format::kR32G32B32A32Float;
constexpr float kUlp = 0x1p-23f;  // of numbers from 1 to 2

bool on_vulkan(const Context& t) {
  return t.target().backend == "vulkan";
}

PipelineState own_vertex(const Screen& screen, const char* vertex, const char* pixel) {
  GraphicsPipelineStateDesc desc = screen.desc("Pass", pixel);
  desc.VS = screen.shader(vertex);
  return screen.make(desc);
}

// Corners of a strip or list with various w and values.
std::vector<Corner> slanted_corners(const Screen& screen) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> number(1, 2);
  std::vector<Corner> out;
  const float places[6][2] = {{5, 9}, {120, 3}, {10, 110}, {118, 105}, {40, 125}, {122, 121}};
  for (const auto& [x, y] : places) {
    out.push_back(screen.at(x, y, 0.5f, number(random) * 2,
                            {number(random), number(random), number(random), number(random)}));
  }
  return out;
}

void barycentrics(Context& t) {
  Screen screen(t, {kFour, kFour, kFour}, Format::kUnknown, 128);
  screen.library = kaamos_shaders_ras_attributes();
  const std::vector<Corner> corners = slanted_corners(screen);
  std::vector<std::array<float, 4>> values;
  for (const Corner& corner : corners) values.push_back(corner.value);
  const Buffer buffer = t.upload(values);
  const auto check = [&](const std::string& what, const PipelineState& pipeline, bool strip) {
    screen.run([&](CommandList& list) {
      list.SetGraphicsRootShaderResourceView(kWords, buffer.GetGPUVirtualAddress());
      if (strip) list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleStrip);
      screen.draw(list, pipeline, corners, {.number = strip ? 1u : 0u});
    });
    uint32_t drawn = 0;
    float worst = 0, worst_sum = 0;
    for (uint32_t y = 0; y < 128; ++y) {
      for (uint32_t x = 0; x < 128; ++x) {
        if (screen.texel<float>(x, y, 3, 2) == 0) continue;
        ++drawn;
        float sum = 0;
        for (uint32_t c = 0; c < 3; ++c) sum += screen.texel<float>(x, y, c, 2);
        worst_sum = std::max(worst_sum, std::abs(sum - 1));
        for (uint32_t c = 0; c < 4; ++c) {
          worst = std::max(
              worst, std::abs(screen.texel<float>(x, y, c, 0) - screen.texel<float>(x, y, c, 1)));
        }
      }
    }
    t.close(what + ": sum of weights, off by", worst_sum, 0, on_vulkan(t) ? 0x1p-16f : 2 * kUlp);
    t.close(what + ": value, off by", worst, 0, on_vulkan(t) ? 0x1p-16f : 4 * kUlp);
    t.holds(what + ": px drawn: " + std::to_string(drawn), drawn > 4000);
  };
  const PipelineState linear = screen.make("Pass", "FromBarycentrics");
  check("list", linear, false);
  check("strip", linear, true);
  const PipelineState of_vertices = screen.make("Pass", "FromVertices");
  check("list, of the vertices", of_vertices, false);
  check("strip, of the vertices", of_vertices, true);
  const PipelineState on_screen = own_vertex(screen, "PassOnScreen", "FromScreenBarycentrics");
  check("list, noperspective", on_screen, false);
  check("strip, noperspective", on_screen, true);
}

void perspective(Context& t) {
  Screen screen(t, {kFour});
  screen.library = kaamos_shaders_ras_attributes();
  // From 0 to 1 over 255 pixels: the middle is a centre.
  const Corner corners[] = {screen.at(0, 0, 0.5f, 1), screen.at(255, 0, 0.5f, 3, {1, 1, 1, 1}),
                            screen.at(0, 255, 0.5f, 1), screen.at(255, 255, 0.5f, 3, {1, 1, 1, 1})};
  const std::vector<Corner> quad = {corners[0], corners[1], corners[2],
                                    corners[2], corners[1], corners[3]};
  const auto check = [&](const char* what, const PipelineState& pipeline, double far_w,
                         float middle) {
    screen.draw(pipeline, quad);
    t.close(std::string(what) + " in the middle", screen.texel<float>(127, 100), middle, 0x1p-20f);
    t.equal(std::string(what) + ": px that differ", screen.count([&](uint32_t x, uint32_t y) {
      if (x >= 255 || y >= 255) return false;
      const double b = (x + 0.5) / 255;
      const double expected = b / far_w / (1 - b + b / far_w);
      return !(std::abs(screen.texel<float>(x, y) - expected) <= 0x1p-20);
    }),
            0u);
  };
  check("linear", screen.make("Pass", "Value"), 3, 0.25f);
  check("noperspective", own_vertex(screen, "PassOnScreen", "ScreenValue"), 1, 0.5f);
}

void flat_values_are_bits(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Uint, Format::kR32G32B32A32Uint}, Format::kUnknown, 16);
  screen.library = kaamos_shaders_ras_attributes();
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "ReadFlat");
  desc.VS = screen.shader("PassFlat");
  desc.InputLayout[1].Format = Format::kR32G32B32A32Uint;
  const PipelineState pipeline = screen.make(desc);
  // A signalling NaN, a denormal, -0, all ones.
  const uint32_t bits[] = {0x7F800001, 1, 0x80000000, 0xFFFFFFFF};
  std::vector<Corner> corners = {screen.at(-16, -16, 0.5f, 1), screen.at(48, -16, 0.5f, 2),
                                 screen.at(-16, 48, 0.5f, 3)};
  for (size_t i = 0; i < 4; ++i) corners[0].value[i] = std::bit_cast<float>(bits[i]);
  screen.draw(pipeline, corners);
  for (uint32_t i = 0; i < 4; ++i) {
    t.equal("float", screen.texel<uint32_t>(9, 2, i, 0), bits[i]);
    t.equal("int", screen.texel<uint32_t>(9, 2, i, 1), bits[i]);
  }
}

// Random triangles with w from 0.5 to 20.
std::vector<Corner> scattered(const Screen& screen, uint32_t count, uint32_t seed,
                              const std::function<float(std::mt19937&)>& value) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-20, 276), extent(-60, 60), w(0.5f, 20);
  std::vector<Corner> out;
  for (uint32_t i = 0; i < count; ++i) {
    const float x = place(random), y = place(random);
    for (int corner = 0; corner < 3; ++corner) {
      const float px = x + extent(random), py = y + extent(random);
      const float v = value(random);
      out.push_back(screen.at(px, py, 0.5f, w(random), {v, v, v, v}));
    }
  }
  return out;
}

void constants_stay(Context& t) {
  Screen screen(t, {kFour});
  screen.library = kaamos_shaders_ras_attributes();
  const auto corners = scattered(screen, 1000, 11, [](std::mt19937&) { return 0.1f; });
  for (const bool linear : {true, false}) {
    screen.draw(
        linear ? screen.make("Pass", "Value") : own_vertex(screen, "PassOnScreen", "ScreenValue"),
        corners);
    t.holds("drawn", screen.covered() > 60000);
    float worst = 0;
    for (uint32_t y = 0; y < 256; ++y) {
      for (uint32_t x = 0; x < 256; ++x) {
        const auto found = screen.texel<float>(x, y);
        if (found != 0) worst = std::max(worst, std::abs(found - 0.1f));
      }
    }
    t.close("off by", worst, 0, on_vulkan(t) ? 2 * 0x1p-27f : 0);
  }
}

void values_stay_in_range(Context& t) {
  Screen screen(t, {kFour});
  screen.library = kaamos_shaders_ras_attributes();
  const PipelineState pipeline = own_vertex(screen, "PassModes", "ReadModes");
  const auto corners = scattered(screen, 1000, 12, [](std::mt19937& random) {
    return std::uniform_int_distribution<int>(0, 1)(random) == 0 ? 1.0f : 2.0f;
  });
  screen.draw(pipeline, corners);
  float low = 1, high = 2;
  for (uint32_t y = 0; y < 256; ++y) {
    for (uint32_t x = 0; x < 256; ++x) {
      const auto a = screen.texel<float>(x, y, 0);
      if (a == 0) continue;
      low = std::min(low, a);
      high = std::max(high, a);
    }
  }
  t.close("least", low, 1, on_vulkan(t) ? 0x1p-12f : kUlp / 2);
  t.close("most", high, 2, on_vulkan(t) ? 0x1p-12f : 2 * kUlp);
  t.equal("px where centroid or sample differ", screen.count([&](uint32_t x, uint32_t y) {
    const auto a = screen.texel<uint32_t>(x, y, 0);
    return screen.texel<uint32_t>(x, y, 1) != a || screen.texel<uint32_t>(x, y, 2) != a;
  }),
          0u);
}

void positions_of_pixels(Context& t) {
  Screen screen(t, {kFour});
  const PipelineState pipeline = screen.make("Pass", "Place");
  std::vector<Corner> corners = screen.rectangle(0, 0, 256, 256);
  for (Corner& corner : corners) {
    for (float& c : corner.position) c *= 5;
  }
  screen.draw(pipeline, corners);
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    return screen.texel<float>(x, y, 0) != static_cast<float>(x) + 0.5f ||
           screen.texel<float>(x, y, 1) != static_cast<float>(y) + 0.5f ||
           !(std::abs(screen.texel<float>(x, y, 3) - 5) <= 4 * kUlp);
  }),
          0u);
  // w from 1 to 4: its reciprocal is linear.
  for (Corner& corner : corners) {
    const float w = corner.position[0] < 0 ? 1.0f : 4.0f;
    for (float& c : corner.position) c *= w / 5;
  }
  screen.draw(pipeline, corners);
  t.equal("slanted: px that differ", screen.count([&](uint32_t x, uint32_t y) {
    const double b = (x + 0.5) / 256;
    const double expected = 1 / (1 - b + b / 4);
    return !(std::abs(screen.texel<float>(x, y, 3) / expected - 1) <= 0x1p-20);
  }),
          0u);
}

void ids_of_cut_triangles(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Uint});
  const PipelineState pipeline = screen.make("Pass", "Facts");
  std::vector<Corner> corners = screen.rectangle(0, 0, 256, 256);
  for (Corner& corner : corners) corner.position[2] = corner.position[0] < 0 ? -0.5f : 1.5f;
  screen.draw(pipeline, corners);
  uint32_t found[2] = {};
  t.equal("px with wrong ids", screen.count([&](uint32_t x, uint32_t y) {
    const Fact fact = screen.fact(x, y);
    if (!fact.covered) return x >= 65 && x < 191;
    if (fact.primitive > 1) return true;
    ++found[fact.primitive];
    // Pixels of the diagonal may be of either.
    return x + y != 255 && fact.primitive != (x + y < 255 ? 0u : 1u);
  }),
          0u);
  t.holds("both are drawn", found[0] > 15000 && found[1] > 15000);
}

void instance_ids_in_pixel_shaders(Context& t) {
  Screen screen(t, {Format::kR32G32B32A32Uint}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_attributes();
  const PipelineState pipeline = screen.make("PassInstance", "ReadInstance");
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    list.DrawInstanced(3, 3, 0, 7);
  });
  t.equal("what the vertex shader passes", screen.texel<uint32_t>(1, 1), 42u);
  const auto result = t.device().CreateGraphicsPipelineState(screen.desc("Whole", "ReadInstance"));
  t.refused("without an output", result, "KA0724");
  if (!result) {
    t.holds("it is named: " + result.error().message,
            result.error().message.find("SV_InstanceID") != std::string::npos);
  }
}

std::string with_vectors(uint32_t count) {
  return "struct V {\n  float4 position : SV_Position;\n  float4 more[" +
         std::to_string(count - 1) +
         "] : MORE;\n};\n"
         "[shader(\"vertex\")]\nV vs(uint id : SV_VertexID) {\n  V v = (V)0;\n"
         "  v.position.x = id;\n  return v;\n}\n";
}

void vectors_between_stages(Context& t) {
  Screen screen(t, {kFour}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_attributes();
  const PipelineState pipeline = screen.make("PassMany", "ReadMany");
  screen.run([&](CommandList& list) { screen.cover(list, pipeline); });
  t.close("x", screen.texel<float>(2, 1, 0), 4 * 21 + 3, 0x1p-14f);
  t.close("y", screen.texel<float>(2, 1, 1), 7 * 6 + 21, 0x1p-14f);
  t.close("z", screen.texel<float>(2, 1, 2), 21 * 6 + 24, 0x1p-14f);
  t.close("w", screen.texel<float>(2, 1, 3), 28 + 27, 0x1p-14f);
  t.accepted("32", compile(with_vectors(32)));
  const Status status = compile(with_vectors(33));
  t.refused("33", status);
  if (!status) {
    t.holds("the count is said: " + status.error().message,
            status.error().message.find("33") != std::string::npos);
  }
}

}  // namespace

std::vector<RuleTest> ras_attribute_tests() {
  return {{"RAS-72", barycentrics},          {"RAS-73", perspective},
          {"RAS-74", flat_values_are_bits},  {"RAS-75", constants_stay},
          {"RAS-76", values_stay_in_range},  {"RAS-77", positions_of_pixels},
          {"RAS-78", ids_of_cut_triangles},  {"RAS-79", instance_ids_in_pixel_shaders},
          {"RAS-80", vectors_between_stages}};
}

}  // namespace kaamos::conformance

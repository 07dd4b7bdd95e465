// SPDX-License-Identifier: MIT
//
// Rules of the input assembler: topologies, indices, ids.
#include <shaders/ras_assembler.h>

#include "tests/conformance/screen.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr Format kFactFormat = Format::kR32G32B32A32Uint;

// Corners (0, 0), (16, 0), (0, 16), (16, 16) of a target of 32 x 32 pixels.
std::vector<Corner> four_corners(const Screen& screen) {
  return {screen.at(0, 0), screen.at(16, 0), screen.at(0, 16), screen.at(16, 16)};
}

// Sets `element` of each to its place in the list.
std::vector<Corner> numbered(std::vector<Corner> corners) {
  for (size_t i = 0; i < corners.size(); ++i) corners[i].value[0] = static_cast<float>(i);
  return corners;
}

bool upper_left(uint32_t x, uint32_t y) {
  return x + y < 15;  // of the square's diagonal
}

void topologies_are_triangles_and_set(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 32);
  const PipelineState pipeline = screen.make("Whole", "Facts");
  CommandList list = t.device().CreateCommandList().value();
  screen.begin(list);
  list.IASetPrimitiveTopology(PrimitiveTopology::kLineList);
  screen.cover(list, pipeline);
  t.refused("lines", list.Close(), "KA0740");
  list.Reset().value();
  screen.begin(list);
  list.IASetPrimitiveTopology(static_cast<PrimitiveTopology>(10));
  t.refused("lines with adjacent vertices", list.Close(), "KA0721");
  list.Reset().value();
  screen.begin(list);
  list.IASetPrimitiveTopology(PrimitiveTopology::kUndefined);
  screen.cover(list, pipeline);
  t.refused("no topology", list.Close(), "KA0740");
}

void lists_drop_what_is_left(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 32);
  std::vector<Corner> corners;
  for (const float left : {0.0f, 8.0f, 16.0f}) {
    for (const Corner& c : {screen.at(left, 0), screen.at(left + 8, 0), screen.at(left, 8)}) {
      corners.push_back(c);
    }
  }
  corners.pop_back();
  screen.draw(screen.make("Pass", "Facts"), corners);
  uint32_t wrong = 0;
  for (uint32_t y = 0; y < 32; ++y) {
    for (uint32_t x = 0; x < 32; ++x) {
      const Fact fact = screen.fact(x, y);
      const bool inside = x < 16 && x % 8 + y < 7;
      wrong += fact.covered != inside || (inside && fact.primitive != x / 8) ? 1 : 0;
    }
  }
  t.equal("px that differ", wrong, 0u);
}

void strips_turn_every_second_triangle(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 32);
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Facts");
  desc.RasterizerState.CullMode = CullMode::kBack;
  const PipelineState pipeline = screen.make(desc);
  screen.run([&](CommandList& list) {
    list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleStrip);
    screen.draw(list, pipeline, four_corners(screen));
  });
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    const Fact fact = screen.fact(x, y);
    if (x >= 16 || y >= 16) return fact.covered;
    const uint32_t which = upper_left(x, y) ? 0 : 1;
    return !fact.covered || !fact.front || fact.vertex != which || fact.primitive != which;
  }),
          0u);
}

void cuts_begin_strips(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 32);
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Facts");
  desc.RasterizerState.CullMode = CullMode::kBack;
  desc.IBStripCutValue = IndexBufferStripCutValue::k0xFFFF;
  const PipelineState pipeline = screen.make(desc);
  screen.run([&](CommandList& list) {
    list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleStrip);
    // Instances are 16 pixels apart.
    Screen::use(list, pipeline, {.offset = {1, 0}});
    screen.vertices(list, four_corners(screen));
    screen.indices(list, std::vector<uint16_t>{0, 1, 2, 0xFFFF, 2, 1, 3});
    list.DrawIndexedInstanced(7, 2, 0, 0, 0);
  });
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    const Fact fact = screen.fact(x, y);
    if (y >= 16) return fact.covered;
    const uint32_t which = upper_left(x % 16, y) ? 0 : 1;
    return !fact.covered || !fact.front || fact.primitive != which || fact.vertex != which * 2 ||
           fact.instance != x / 16;
  }),
          0u);
}

// Covered pixels of a strip of these indices.
template <class T>
uint32_t strip_area(Screen& screen, IndexBufferStripCutValue cut, const std::vector<T>& indices,
                    const std::vector<Corner>& corners) {
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Facts");
  desc.IBStripCutValue = cut;
  const PipelineState pipeline = screen.make(desc);
  screen.run([&](CommandList& list) {
    list.IASetPrimitiveTopology(PrimitiveTopology::kTriangleStrip);
    Screen::use(list, pipeline);
    screen.vertices(list, corners);
    screen.indices(list, indices);
    list.DrawIndexedInstanced(static_cast<uint32_t>(indices.size()), 1, 0, 0, 0);
  });
  return screen.count([&](uint32_t x, uint32_t y) { return screen.fact(x, y).covered; });
}

void cut_values_are_compared_literally(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 32);
  std::vector<Corner> corners(65536);
  const std::vector<Corner> four = four_corners(screen);
  std::copy(four.begin(), four.end(), corners.begin());
  corners[65535] = four[3];
  using Cut = IndexBufferStripCutValue;
  const std::vector<uint16_t> words = {0, 1, 2, 0xFFFF};
  const std::vector<uint32_t> dwords = {0, 1, 2, 0xFFFF};
  constexpr uint32_t kWhole = 256, kTriangle = 120;
  t.equal("R16, disabled", strip_area(screen, Cut::kDisabled, words, corners), kWhole);
  t.equal("R16, 0xFFFF", strip_area(screen, Cut::k0xFFFF, words, corners), kTriangle);
  t.equal("R16, 0xFFFFFFFF", strip_area(screen, Cut::k0xFFFFFFFF, words, corners), kWhole);
  t.equal("R32, disabled", strip_area(screen, Cut::kDisabled, dwords, corners), kWhole);
  t.equal("R32, 0xFFFF", strip_area(screen, Cut::k0xFFFF, dwords, corners), kTriangle);
  t.equal("R32, 0xFFFFFFFF", strip_area(screen, Cut::k0xFFFFFFFF, dwords, corners), kWhole);
  const std::vector<uint32_t> ones = {0, 1, 2, 0xFFFFFFFF, 0, 1, 2};
  t.equal("cut at 0xFFFFFFFF", strip_area(screen, Cut::k0xFFFFFFFF, ones, corners), kTriangle);
}

void lists_are_not_cut(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 32);
  GraphicsPipelineStateDesc desc = screen.desc("Pass", "Facts");
  desc.IBStripCutValue = IndexBufferStripCutValue::k0xFFFFFFFF;
  const PipelineState pipeline = screen.make(desc);
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    screen.vertices(list, four_corners(screen));
    // Were it a cut, nothing would come after it but triangles without area.
    screen.indices(list, std::vector<uint32_t>{0, 1, 2, 0xFFFFFFFF, 3, 3, 1, 3, 2});
    list.DrawIndexedInstanced(9, 1, 0, 0, 0);
  });
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    const Fact fact = screen.fact(x, y);
    if (x >= 16 || y >= 16) return fact.covered;
    return !fact.covered || fact.primitive != (upper_left(x, y) ? 0u : 2u);
  }),
          0u);
}

template <class T>
void draw_past_indices(Context& t, Screen& screen, const PipelineState& pipeline) {
  const Buffer buffer = t.upload(std::vector<T>{0, 1, 2, 2, 1, 3});
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    screen.vertices(list, four_corners(screen));
    const IndexBufferView view = {buffer.GetGPUVirtualAddress(), 3 * sizeof(T),
                                  sizeof(T) == 2 ? Format::kR16Uint : Format::kR32Uint};
    list.IASetIndexBuffer(&view);
    list.DrawIndexedInstanced(6, 1, 0, 0, 0);
  });
  t.equal("px that differ", screen.count([&](uint32_t x, uint32_t y) {
    return screen.fact(x, y).covered != (x < 16 && y < 16 && upper_left(x, y));
  }),
          0u);
}

void indices_past_the_view_are_zero(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 32);
  const PipelineState pipeline = screen.make("Pass", "Facts");
  draw_past_indices<uint16_t>(t, screen, pipeline);
  draw_past_indices<uint32_t>(t, screen, pipeline);
}

// Right triangles of 8 pixels at x = 0, 8, 16, ...
std::vector<Corner> row_of_triangles(const Screen& screen, size_t skip, uint32_t count) {
  std::vector<Corner> corners(skip);
  for (uint32_t i = 0; i < count; ++i) {
    const auto left = static_cast<float>(8 * i);
    for (const Corner& c : {screen.at(left, 0), screen.at(left + 8, 0), screen.at(left, 8)}) {
      corners.push_back(c);
    }
  }
  return numbered(corners);
}

void check_fact(Context& t, const Screen& screen, uint32_t x, uint32_t y, uint32_t vertex,
                uint32_t element) {
  const Fact fact = screen.fact(x, y);
  t.holds("covered", fact.covered);
  t.equal("SV_VertexID", fact.vertex, vertex);
  t.equal("vertex that was read", fact.element, element);
}

void base_vertices_move_the_fetch(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 32);
  const PipelineState pipeline = screen.make("Pass", "Facts");
  // Vertices 10 to 12 are a triangle, 13 to 15 the next.
  const std::vector<Corner> corners = row_of_triangles(screen, 10, 2);
  const auto draw = [&](const std::vector<uint32_t>& values, int32_t base) {
    screen.run([&](CommandList& list) {
      Screen::use(list, pipeline);
      screen.vertices(list, corners);
      screen.indices(list, values);
      list.DrawIndexedInstanced(static_cast<uint32_t>(values.size()), 1, 0, base, 0);
    });
  };
  draw({6, 7, 8, 9, 10, 11}, 4);
  check_fact(t, screen, 1, 1, 6, 10);
  check_fact(t, screen, 9, 1, 9, 13);
  draw({30, 31, 32}, -20);
  check_fact(t, screen, 1, 1, 30, 10);
  draw({0xFFFFFFFE, 0xFFFFFFFF, 0}, 12);  // the sum wraps
  check_fact(t, screen, 1, 1, 0xFFFFFFFE, 10);
}

void ids_begin_at_zero(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 32);
  const PipelineState pipeline = screen.make("Pass", "Facts");
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    screen.vertices(list, row_of_triangles(screen, 12, 2));
    list.DrawInstanced(6, 1, 12, 0);
  });
  check_fact(t, screen, 1, 1, 0, 12);
  check_fact(t, screen, 9, 1, 3, 15);
}

// Draws a triangle for each instance, 8 pixels apart, with elements from a stream of their own, and
// returns which were read.
std::vector<uint32_t> elements_of_instances(Context& t, uint32_t instances, uint32_t start,
                                            uint32_t step) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 32);
  screen.library = kaamos_shaders_ras_assembler();
  GraphicsPipelineStateDesc desc = screen.desc("Streams", "Facts");
  desc.InputLayout = {element("POSITION", Format::kR32G32B32A32Float),
                      instance_element("ELEMENT", Format::kR32Uint, 1, step)};
  const PipelineState pipeline = screen.make(desc);
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline, {.offset = {0.5f, 0}});
    screen.vertices(list, row_of_triangles(screen, 0, 1));
    list.IASetVertexBuffers(1, screen.view(std::vector<uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
    list.DrawInstanced(3, instances, 0, start);
  });
  std::vector<uint32_t> out;
  for (uint32_t i = 0; i < instances; ++i) {
    const Fact fact = screen.fact(8 * i + 1, 1);
    t.holds("covered", fact.covered);
    t.equal("SV_InstanceID", fact.instance, i);
    out.push_back(fact.element);
  }
  return out;
}

void instances_begin_at_zero(Context& t) {
  t.equal("elements", elements_of_instances(t, 2, 5, 1), {5, 6});
}

void step_rates(Context& t) {
  t.equal("step 2", elements_of_instances(t, 4, 1, 2), {1, 1, 2, 2});
  t.equal("step 3", elements_of_instances(t, 4, 2, 3), {2, 2, 2, 3});
  t.equal("step 0", elements_of_instances(t, 4, 3, 0), {3, 3, 3, 3});
}

void primitive_ids_begin_anew(Context& t) {
  Screen screen(t, {kFactFormat}, Format::kUnknown, 32);
  const PipelineState pipeline = screen.make("Pass", "Facts");
  const CommandSignature signature =
      t.device()
          .CreateCommandSignature({.ByteStride = sizeof(DrawArguments),
                                   .ArgumentDescs = {{.Type = IndirectArgumentType::kDraw}}})
          .value();
  // In rows of 8 pixels: two instances; a draw; two indirect draws.
  const std::vector<Corner> two = row_of_triangles(screen, 0, 2);
  const Buffer arguments = t.upload(std::vector<DrawArguments>{{6, 1, 0, 0}, {3, 1, 0, 0}});
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline, {.offset = {1, 0}});
    screen.vertices(list, two);
    list.DrawInstanced(6, 2, 0, 0);
    list.RSSetViewports(Viewport{0, 8, 32, 32, 0, 1});
    list.DrawInstanced(6, 1, 0, 0);
    list.RSSetViewports(Viewport{16, 8, 32, 32, 0, 1});
    list.ExecuteIndirect(signature, 2, arguments, 0);
  });
  std::vector<uint32_t> ids;
  for (const uint32_t y : {1u, 9u}) {
    for (const uint32_t x : {1u, 9u, 17u, 25u}) {
      t.holds("covered", screen.fact(x, y).covered);
      ids.push_back(screen.fact(x, y).primitive);
    }
  }
  t.equal("ids", ids, {0, 1, 0, 1, 0, 1, 0, 1});
}

void ids_drive_the_shader(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 32);
  GraphicsPipelineStateDesc desc = screen.desc("Whole", "Tint");
  // Without the flag that allows an input layout.
  const std::string signature = kDrawSignature;
  screen.root_signature =
      t.device().CreateRootSignature(signature.substr(signature.find("RootConstants"))).value();
  desc.pRootSignature = screen.root_signature;
  const PipelineState pipeline = screen.make(desc);
  screen.run([&](CommandList& list) { screen.cover(list, pipeline); });
  t.equal("covered", screen.covered(), 32u * 32);
}

void vertices_run_at_least_once(Context& t) {
  Screen screen(t, {Format::kR32Float}, Format::kUnknown, 4);
  screen.library = kaamos_shaders_ras_assembler();
  const PipelineState pipeline = screen.make("Counted", "Tint");
  screen.run([&](CommandList& list) {
    Screen::use(list, pipeline);
    screen.indices(list, std::vector<uint16_t>{0, 1, 2, 2, 1, 3, 0, 1, 2});
    list.DrawIndexedInstanced(9, 2, 0, 0, 0);
  });
  const std::vector<uint32_t> words = t.read(screen.words);
  t.holds("at least once for each vertex and instance", words[0] >= 8);
  t.holds("at most once for each use", words[0] <= 18);
  const uint32_t uses[] = {4, 6, 6, 2};
  for (uint32_t i = 0; i < 4; ++i) {
    t.holds("vertex " + std::to_string(i), words[1 + i] >= 2 && words[1 + i] <= uses[i]);
  }
  t.equal("others", words[5], 0u);
}

}  // namespace

std::vector<RuleTest> ras_assembler_tests() {
  return {{"RAS-01", topologies_are_triangles_and_set},
          {"RAS-02", lists_drop_what_is_left},
          {"RAS-03", strips_turn_every_second_triangle},
          {"RAS-04", cuts_begin_strips},
          {"RAS-05", cut_values_are_compared_literally, "*"},
          {"RAS-06", lists_are_not_cut, "*"},
          {"RAS-07", indices_past_the_view_are_zero, "*"},
          {"RAS-08", base_vertices_move_the_fetch},
          {"RAS-09", ids_begin_at_zero},
          {"RAS-10", instances_begin_at_zero},
          {"RAS-11", step_rates},
          {"RAS-12", primitive_ids_begin_anew},
          {"RAS-19", ids_drive_the_shader},
          {"RAS-20", vertices_run_at_least_once}};
}

}  // namespace kaamos::conformance

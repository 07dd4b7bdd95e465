// SPDX-License-Identifier: MIT
//
// Vertex and pixel shaders compiled at build time (draw.hlsl), and how their SPIR-V is linked.
#include <gtest/gtest.h>
#include <kaamos/shader/spirv_locations.h>
#include <shaders/draw_ps.h>
#include <shaders/draw_vs.h>

#include <string>
#include <vector>

#include "graphics_runner.h"

namespace kaamos::test {
namespace {

using Floats = std::array<float, 8>;

// kaamos_add_shader_library with a target, and SUFFIX for the second entry point of a source.
TEST(GraphicsLibrary, HasTheTargetsEntryPoint) {
  const Floats threes = {3, 3, 3, 3, 3, 3, 3, 3}, fives = {5, 5, 5, 5, 5, 5, 5, 5};
  GraphicsRunner vertex(*kaamos_shaders_draw_vs(), "vs");
  vertex.in("SV_VertexID", 0) = {0, 1, 2, 3, 4, 5, 6, 7};
  vertex.set("POSITION", 0, 1, threes);
  vertex.run();
  EXPECT_EQ(vertex.out("ID", 0), vertex.in("SV_VertexID", 0));
  EXPECT_EQ(vertex.floats("UV", 0, 1), threes);
  GraphicsRunner pixel(*kaamos_shaders_draw_ps(), "ps");
  pixel.in("ID", 0) = {5, 5, 5, 5, 5, 5, 5, 5};
  pixel.run();
  EXPECT_EQ(pixel.floats("SV_Target", 0, 2), fives);
}

// The locations of a module's inputs by their order in the list of decorations.
std::vector<uint32_t> input_locations(std::vector<uint32_t> words) {
  std::vector<uint32_t> found;
  for (uint32_t location = 0; location < 8; ++location) {
    std::vector<uint32_t> changed = words;
    std::vector<uint32_t> map = {0, 1, 2, 3, 4, 5, 6, 7};
    map[location] = 99;
    shader::spirv::relocate_inputs(changed, map);
    if (changed != words) found.push_back(location);
  }
  return found;
}

// The pixel shader reads ID at 0 and UV at 1; the vertex shader writes UV at 1 and ID at 2.
TEST(GraphicsLibrary, InputsMoveToTheLocationsOfOutputs) {
  const shader::ExportDesc& vertex = kaamos_shaders_draw_vs()->exports[0];
  const shader::ExportDesc& pixel = kaamos_shaders_draw_ps()->exports[0];
  ASSERT_NE(vertex.spirv, nullptr);
  ASSERT_NE(pixel.spirv, nullptr);
  std::vector<uint32_t> locations;
  for (uint32_t i = 0; i < pixel.graphics->input_count; ++i) {
    for (uint32_t o = 0; o < vertex.graphics->output_count; ++o) {
      const auto& input = pixel.graphics->inputs[i];
      const auto& output = vertex.graphics->outputs[o];
      if (std::string(input.semantic) == output.semantic) locations.push_back(o);
    }
  }
  ASSERT_EQ(locations, (std::vector<uint32_t>{2, 1}));
  std::vector<uint32_t> words(pixel.spirv, pixel.spirv + pixel.spirv_words);
  EXPECT_EQ(input_locations(words), (std::vector<uint32_t>{0, 1}));
  shader::spirv::relocate_inputs(words, locations);
  EXPECT_EQ(input_locations(words), (std::vector<uint32_t>{1, 2}));
}

}  // namespace
}  // namespace kaamos::test

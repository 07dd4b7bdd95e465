// SPDX-License-Identifier: MIT
//
// The tests in an HLSL file, and the source that runs them: the file with an entry point for each.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kaamos::shader_tests {

// What runs a test.
enum class TestStage : uint8_t { kCompute, kRays, kPixels };

// One test with one row of arguments.
struct TestRun {
  std::string name;  // "brdf::Fresnel", "brdf::Fresnel/2" for its third case
  std::string entry;
  TestStage stage = TestStage::kCompute;
  // Thread groups, rays, or pixels: at first a quad of 2 x 2. [dispatch(x, y, z)]
  std::array<uint32_t, 3> size = {1, 1, 1};
  std::string skip;  // why it does not run; empty: it does
  std::string file;
  uint32_t line = 0;
};

// The vertex shader of all tests of pixels.
inline constexpr char kVertexShader[] = "kaamos_test_vertices";

struct TestFile {
  std::vector<TestRun> runs;
  std::string entry_points;  // HLSL that goes behind the file
  // Exports of ray tracing pipelines, in the order of the file: the records of their tables.
  std::vector<std::string> hit_groups;
  std::vector<std::string> miss_shaders;
  std::vector<std::string> callable_shaders;
  std::vector<std::string> local_root_signatures;  // their texts
  bool has_shader_config = false;
  bool has_pipeline_config = false;
  std::string error;  // what is wrong with the attributes of a test: "file:line: ..."
};

// `text` is the preprocessed source, with line directives.
TestFile find_tests(std::string_view text, const std::string& file);

}  // namespace kaamos::shader_tests

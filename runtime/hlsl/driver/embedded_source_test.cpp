// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/embedded_source.h"

#include <gtest/gtest.h>

#include <sstream>

#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/glsl/emit_glsl.h"

namespace kaamos::hlsl {
namespace {

MemoryFileLoader example_files() {
  MemoryFileLoader files;
  files.add("shaders/main.hlsl",
            "#include \"lib/common.hlsli\"\n"
            "RWByteAddressBuffer result : register(u0);\n"
            "[shader(\"raygeneration\")] void Main() { result.Store(4, value() + WIDTH); }\n");
  files.add("shaders/lib/common.hlsli", "uint value() { return 3; }\n");
  return files;
}

std::unique_ptr<ir::Module> compile(const FrontendOptions& options, FileLoader& files) {
  SourceManager sources(files);
  DiagnosticEngine diagnostics;
  return compile_to_ir(options, sources, diagnostics);
}

TEST(EmbeddedSource, CompilesToTheSameModule) {
  MemoryFileLoader files = example_files();
  FrontendOptions options;
  options.path = "shaders/main.hlsl";
  options.defines = {"WIDTH=5"};
  const auto module = compile(options, files);
  ASSERT_NE(module, nullptr);
  auto read = read_embedded_source(module->source);
  ASSERT_TRUE(read.has_value());
  const auto again = compile(read->options, read->files);
  ASSERT_NE(again, nullptr);
  EXPECT_EQ(again->source, module->source);
  EXPECT_EQ(emit_cpp(*again, {}), emit_cpp(*module, {}));
}

TEST(EmbeddedSource, ATextGivenInsteadOfAFile) {
  MemoryFileLoader files = example_files();
  FrontendOptions options;
  options.path = "shaders/given.hlsl";
  options.text =
      "#include \"lib/common.hlsli\"\nstruct P { uint x; }; [shader(\"miss\")] void M(inout P p) { "
      "p.x = value(); }";
  options.target = "lib_6_3";
  options.row_major = true;
  options.reserve_unused = true;
  const auto module = compile(options, files);
  ASSERT_NE(module, nullptr);
  auto read = read_embedded_source(module->source);
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->options.text, options.text);
  EXPECT_EQ(read->options.target, "lib_6_3");
  EXPECT_TRUE(read->options.row_major);
  EXPECT_TRUE(read->options.reserve_unused);
}

TEST(EmbeddedSource, DamagedTextsAreRefused) {
  MemoryFileLoader files = example_files();
  FrontendOptions options;
  options.path = "shaders/main.hlsl";
  options.defines = {"WIDTH=5"};
  const std::string source = compile(options, files)->source;
  EXPECT_FALSE(read_embedded_source("").has_value());
  EXPECT_FALSE(read_embedded_source("kaamos source 9\n1:a").has_value());
  for (size_t length = 0; length < source.size(); length += 7) {
    EXPECT_FALSE(read_embedded_source(std::string_view(source).substr(0, length)).has_value());
  }
}

TEST(CheckAccess, BothEmittersLookAtAccessesOnlyWhenAsked) {
  MemoryFileLoader files = example_files();
  FrontendOptions options;
  options.path = "shaders/main.hlsl";
  options.defines = {"WIDTH=5"};
  const auto plain = compile(options, files);
  options.check_access = true;
  const auto checked = compile(options, files);
  EXPECT_EQ(emit_cpp(*plain, {}).find("checked::"), std::string::npos);
  EXPECT_NE(emit_cpp(*checked, {}).find("ks::checked::access_view"), std::string::npos);
  EXPECT_EQ(emit_glsl(*plain, plain->entry_points[0]).text.find("k_tell"), std::string::npos);
  EXPECT_NE(emit_glsl(*checked, checked->entry_points[0]).text.find("k_tell"), std::string::npos);
}

// Without the lines that have to do with coverage.
std::string without_coverage(const std::string& code) {
  std::istringstream lines(code);
  std::string out;
  bool in_points = false;
  for (std::string line; std::getline(lines, line);) {
    in_points = in_points || line.find("points[] = {") != std::string::npos;
    const bool is_of_it = in_points || line.find("cover") != std::string::npos;
    if (!is_of_it) out += line + "\n";
    if (line.ends_with("};")) in_points = false;
  }
  return out;
}

TEST(Coverage, IsInTheCodeOnlyWhenAskedAndChangesNothingElse) {
  MemoryFileLoader files = example_files();
  FrontendOptions options;
  options.path = "shaders/main.hlsl";
  options.defines = {"WIDTH=5"};
  const auto plain = compile(options, files);
  options.coverage = true;
  const auto covered = compile(options, files);
  const EmitCppOptions cpp = {.line_directives = false, .wide = WideThreads::kNever};
  const std::string plain_cpp = emit_cpp(*plain, cpp);
  const std::string covered_cpp = emit_cpp(*covered, cpp);
  EXPECT_EQ(without_coverage(plain_cpp), plain_cpp);
  EXPECT_NE(covered_cpp.find("::covered[0]);"), std::string::npos);
  EXPECT_EQ(without_coverage(covered_cpp), plain_cpp);
  EXPECT_EQ(covered->source, plain->source);
  EXPECT_EQ(emit_glsl(*plain, plain->entry_points[0]).text.find("cover"), std::string::npos);
  EXPECT_NE(emit_glsl(*covered, covered->entry_points[0]).text.find("g_cover(0u);"),
            std::string::npos);
  // One thread after another, whatever is asked for.
  EXPECT_EQ(emit_cpp(*covered, {.wide = WideThreads::kAlways}).find("wide"), std::string::npos);
}

}  // namespace
}  // namespace kaamos::hlsl

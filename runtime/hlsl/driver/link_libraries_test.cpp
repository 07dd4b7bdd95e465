// SPDX-License-Identifier: MIT
//
// Libraries as one module. That the result runs is tested with state objects (tests/observed).
#include "runtime/hlsl/driver/link_libraries.h"

#include <gmock/gmock.h>

#include "runtime/hlsl/driver/embedded_source.h"
#include "runtime/hlsl/ir/dump.h"
#include "runtime/hlsl/ir/verify.h"

namespace kaamos::hlsl {
namespace {

using testing::HasSubstr;

std::string source_of(FrontendOptions options, const std::string& text,
                      const std::string& header = {}) {
  MemoryFileLoader files;
  files.add("main.hlsl", text);
  files.add("header.hlsli", header);
  SourceManager sources(files);
  DiagnosticEngine diagnostics;
  options.path = "main.hlsl";
  const auto module = compile_to_ir(options, sources, diagnostics);
  EXPECT_NE(module, nullptr) << render_all(diagnostics, sources);
  return module ? module->source : "";
}

constexpr char kCaller[] = R"(
#include "header.hlsli"
float pick(float2 x, inout S s);
RWByteAddressBuffer words : register(u0);
[shader("raygeneration")] void RayGen() { S s = {VALUE}; words.Store(0, pick(float2(1, 2), s)); }
[shader("raygeneration")] void Other() { words.Store(0, 2); }
)";

LinkRequest request(const std::string& first, const std::string& second) {
  LinkRequest out;
  out.libraries = {{first, {}}, {second, {{"results", 7, 3}}}};
  out.entries = {"RayGen"};
  out.definitions = {
      {0, "\01?pick@@YAMV?$vector@M$01@@US@@@Z", 1, "\01?pick@@YAMV?$vector@M$01@@US@@@Z"}};
  return out;
}

// A file of one name may differ between the libraries, and so may their options.
TEST(LinkLibraries, EachHasItsOwnFilesAndOptions) {
  const std::string first = source_of({}, kCaller, "#define VALUE 3\nstruct S { float a; };");
  const std::string second = source_of({.hlsl_version = 2018},
                                       R"(
#include "header.hlsli"
RWByteAddressBuffer results;
static float count = VALUE;
export float pick(float2 x, inout S s) {
  s.a += VALUE;
  results.Store(0, 1);
  return any(x && float2(1, 0)) ? count : 0;
}
)",
                                       "#define VALUE 5\nstruct S { float a; };");
  const auto linked = link_libraries(request(first, second));
  ASSERT_TRUE(linked) << linked.error();
  const auto& module = *linked;
  EXPECT_EQ(verify(*module), "");
  ASSERT_EQ(module->entry_points.size(), 1u);
  EXPECT_TRUE(module->unlinked_entry_points.empty());
  const std::string text = dump(*module);
  EXPECT_THAT(text, HasSubstr("make_S(3)"));
  EXPECT_THAT(text, HasSubstr("global float count$"));
  EXPECT_THAT(text, HasSubstr(" = 5\n"));
  EXPECT_THAT(text, HasSubstr("binding results RWByteAddressBuffer u7 space3 count 1 automatic"));
  EXPECT_EQ(text.find("struct S#2"), std::string::npos);
}

TEST(LinkLibraries, UnreadableSourcesAndMissingDefinitionsAreErrors) {
  const std::string first = source_of({}, kCaller, "#define VALUE 3\nstruct S { float a; };");
  EXPECT_THAT(link_libraries(request(first, "nonsense")).error(), HasSubstr("cannot be read"));
  LinkRequest none;
  none.libraries = {{first, {}}};
  none.entries = {"RayGen"};
  EXPECT_THAT(link_libraries(none).error(), HasSubstr("KA2504"));
}

}  // namespace
}  // namespace kaamos::hlsl

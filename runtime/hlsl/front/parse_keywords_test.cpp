// SPDX-License-Identifier: MIT
// Tests which words can be names, and where: as DXC's lexer and parser have it.
#include <gtest/gtest.h>

#include "runtime/hlsl/front/parse_test_support.h"

namespace kaamos::hlsl::test {
namespace {

std::string with(std::string text, std::string_view word) {
  for (size_t at = text.find('@'); at != std::string::npos; at = text.find('@', at)) {
    text.replace(at, 1, word);
  }
  return text;
}

// HLSL's own words.
constexpr const char* kModifierWords[] = {
    "centroid", "groupshared", "in",           "inout",         "line",     "lineadj",
    "linear",   "export",      "column_major", "noperspective", "out",      "point",
    "uniform",  "shared",      "snorm",        "row_major",     "triangle", "triangleadj",
    "unorm",    "static",      "extern",       "inline",        "__inline", "nointerpolation"};
constexpr const char* kOtherWords[] = {
    "cbuffer",   "tbuffer",   "packoffset",  "discard",     "interface", "sampler_state",
    "technique", "Technique", "technique10", "technique11", "register",  "namespace",
    "template",  "typename",  "using",       "this",        "true",      "false",
    "void",      "sizeof",    "typedef",     "switch",      "case",      "default",
    "break",     "continue",  "do",          "while",       "for",       "if",
    "else",      "return"};
// Words of C and C++ without a meaning.
constexpr const char* kReservedWords[] = {
#define KAAMOS_RESERVED(text) text,
#include "runtime/hlsl/front/reserved_words.inc"
};
// Modifiers that may be names too.
constexpr const char* kContextual[] = {"center",          "globallycoherent", "indices",
                                       "payload",         "precise",          "primitives",
                                       "reordercoherent", "sample",           "vertices"};

class NeverAName : public testing::TestWithParam<const char*> {};

TEST_P(NeverAName, AnywhereAtAll) {
  for (const auto& [text, place] :
       {std::pair{"float @;", "KA2217 1:7"}, std::pair{"void f() { float3 @; }", "KA2217 1:19"},
        std::pair{"void f() { S @; } ", "KA2217 1:14"},
        std::pair{"struct T { float @; };", "KA2217 1:18"},
        std::pair{"void f(float3 @, int b) { }", "KA2217 1:15"},
        std::pair{"float @(int a);", "KA2217 1:7"}, std::pair{"typedef float @;", "KA2217 1:15"},
        std::pair{"struct @ { };", "KA2217 1:8"}, std::pair{"enum @ { A };", "KA2217 1:6"},
        std::pair{"enum E { @ };", "KA2217 1:10"}, std::pair{"namespace @ { }", "KA2217 1:11"},
        std::pair{"cbuffer @ { float a; }", "KA2217 1:9"}}) {
    const Parsed parsed{"struct S { float x; };\n" + with(text, GetParam())};
    const std::string expected = std::string(place).replace(7, 1, "2");
    EXPECT_EQ(positions(parsed).substr(0, expected.size()), expected)
        << with(text, GetParam()) << "\n"
        << parsed.messages();
  }
}
INSTANTIATE_TEST_SUITE_P(Modifiers, NeverAName, testing::ValuesIn(kModifierWords));
INSTANTIATE_TEST_SUITE_P(Words, NeverAName, testing::ValuesIn(kOtherWords));
INSTANTIATE_TEST_SUITE_P(Reserved, NeverAName, testing::ValuesIn(kReservedWords));

class SometimesAName : public testing::TestWithParam<const char*> {};

TEST_P(SometimesAName, WhereADeclaratorOrAValueStands) {
  for (const char* text :
       {"float @; float f() { return @; }", "struct S { float3 @; float f() { return @.x; } };",
        "float f(float @, float b) { return (@) + b; }", "float @(float a) { return a; }",
        "void f() { float left, @, right; @ = 1; @.x = 2; @++; f(@); }",
        "struct S { float @(); }; float S::@() { return 0; } float f(S s) { return s.@(); }",
        "typedef float @;", "void f() { for (int @ = 0; @ < 3; ++@) { } }", "@ float a;"}) {
    // Only parameters may have a mesh shader's modifiers.
    const bool is_modifier = text[0] == '@';
    const std::string source =
        is_modifier ? with("void f(in @ float a) { }", GetParam()) : with(text, GetParam());
    EXPECT_EQ(Parsed{source}.messages(), "") << source;
  }
}

TEST_P(SometimesAName, NotOfATypeOrScope) {
  for (const auto& [text, place] :
       {std::pair{"struct @ { };", "KA2217 1:8"}, std::pair{"enum @ { A };", "KA2217 1:6"},
        std::pair{"enum E { @ };", "KA2217 1:10"}, std::pair{"namespace @ { }", "KA2217 1:11"},
        std::pair{"cbuffer @ { float a; }", "KA2217 1:9"},
        std::pair{"using @ = float;", "KA2217 1:7"},
        std::pair{"template<int @> void f() { }", "KA2217 1:14"},
        std::pair{"namespace n { float a; } float b = n::@;", "KA2217 1:39"}}) {
    const Parsed parsed{with(text, GetParam())};
    EXPECT_EQ(positions(parsed).substr(0, std::string_view(place).size()), place)
        << with(text, GetParam()) << "\n"
        << parsed.messages();
  }
}
INSTANTIATE_TEST_SUITE_P(All, SometimesAName, testing::ValuesIn(kContextual));

// Names in C++ 11 and in other languages, but not in HLSL: DXC takes them as names.
TEST(Keywords, WordsThatAreFree) {
  for (const char* word :
       {"pass",    "compile",       "alignas",      "constexpr",   "decltype", "noexcept",
        "nullptr", "static_assert", "thread_local", "restrict",    "and",      "or",
        "not",     "xor",           "typeof",       "local",       "global",   "constant",
        "kernel",  "lines",         "points",       "technique12", "half_t",   "pixel"}) {
    const std::string text =
        with("float @; float f(float @) { return @ + 1; } struct T { int @; };", word);
    EXPECT_EQ(Parsed{text}.messages(), "") << text;
  }
}

TEST(Keywords, OneMessageForADeclarationAndItsUses) {
  const Parsed parsed{
      "void f() { float3 point; point.x = 1; float y = point.x + 2; }\n"
      "void g() { line = 1; }"};
  EXPECT_EQ(positions(parsed), "KA2217 1:19\nKA2300 2:12") << parsed.messages();
}

}  // namespace
}  // namespace kaamos::hlsl::test

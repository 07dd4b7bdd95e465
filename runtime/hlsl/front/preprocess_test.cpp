// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/preprocess.h"

#include <gtest/gtest.h>

#include "runtime/hlsl/front/preprocess_test_support.h"

namespace kaamos::hlsl {
namespace {

std::string expand(std::string main, std::map<std::string, std::string> files = {},
                   PreprocessOptions options = {}) {
  Preprocessed input(std::move(main), std::move(files), std::move(options));
  EXPECT_EQ(input.rendered(), "");
  return input.text();
}

TEST(Macro, ObjectLike) {
  EXPECT_EQ(expand("#define A b\n#define B A + A\n#define E\nB E A"), "b + b b");
}

TEST(Macro, FunctionLikeOnlyBeforeAParen) {
  EXPECT_EQ(expand("#define F(x) [x]\nF(1) F F\n(2) F ;"), "[ 1 ] F [ 2 ] F ;");
  EXPECT_EQ(expand("#define F (x)\nF(1)"), "( x ) ( 1 )");
}

TEST(Macro, ArgumentsKeepParensTogether) {
  EXPECT_EQ(expand("#define F(a, b) b a\nF((1, 2), f(3, 4))"), "f ( 3 , 4 ) ( 1 , 2 )");
}

TEST(Macro, ArgumentsMayBeEmpty) {
  EXPECT_EQ(expand("#define F(a, b) <a|b>\n#define G() g\n#define H(a) [a]\nF(,) F(1,) G() H()"),
            "< | > < 1 | > g [ ]");
}

TEST(Macro, ANameIsNotExpandedInItself) {
  EXPECT_EQ(expand("#define A A + B\n#define B A\nA"), "A + A");
  EXPECT_EQ(expand("#define f(x) x + f(x)\nf(f(1))"), "1 + f ( 1 ) + f ( 1 + f ( 1 ) )");
  EXPECT_EQ(expand("#define foo foo\n#define CAT(a, b) a ## b\nCAT(fo, o) foo"), "foo foo");
}

// The example in [C++: cpp.rescan], which combines nearly all rules.
TEST(Macro, RescanningExampleOfTheStandard) {
  EXPECT_EQ(expand(R"(#define x 3
#define f(a) f(x * (a))
#undef x
#define x 2
#define g f
#define z z[0]
#define h g(~
#define m(a) a(w)
#define w 0,1
#define t(a) a
#define p() int
#define q(x) x
#define r(x,y) x ## y
#define str(x) # x
f(y+1) + f(f(z)) % t(t(g)(0) + t)(1);
g(x+(3,4)-w) | h 5) & m
  (f)^m(m);
p() i[q()] = { q(1), r(2,3), r(4,), r(,5), r(,) };)"),
            "f ( 2 * ( y + 1 ) ) + f ( 2 * ( f ( 2 * ( z [ 0 ] ) ) ) ) % f ( 2 * ( 0 ) ) + t ( 1 "
            ") ; f ( 2 * ( 2 + ( 3 , 4 ) - 0 , 1 ) ) | f ( 2 * ( ~ 5 ) ) & f ( 2 * ( 0 , 1 ) ) ^ "
            "m ( 0 , 1 ) ; int i [ ] = { 1 , 23 , 4 , 5 , } ;");
}

TEST(Macro, StringizeKeepsSpellingAndOneSpace) {
  Preprocessed input(
      "#define S(x) #x\n#define X(x) S(x)\n#define V 6\nS( a   +b \"q\\n\" ) ; X(V)");
  EXPECT_EQ(input.list.tokens[0].text, "a +b \"q\\n\"");
  EXPECT_EQ(input.list.tokens[2].text, "6");
}

TEST(Macro, PasteMakesOneToken) {
  EXPECT_EQ(expand("#define CAT(a, b) a##b\n#define X(a, b) CAT(a, b)\n#define N 4\n"
                   "X(float, N) CAT(float, N) CAT(<, <=) CAT(1., 5f) CAT(x, 1)"),
            "float4 floatN <<= 1.5f x1");
}

TEST(Macro, PastedNamesAreExpandedAgain) {
  EXPECT_EQ(expand("#define AB 7\n#define CAT(a, b) a##b\nCAT(A, B)"), "7");
}

TEST(Macro, PastesChainAndTakeOneTokenOfEachSide) {
  EXPECT_EQ(expand("#define C(a, b, c) a##b##c\nC(x, 1, y) C(,1,) C(p q, r, s t)"),
            "x1y 1 p qrs t");
}

TEST(Macro, Variadic) {
  EXPECT_EQ(expand("#define V(...) f(__VA_ARGS__)\n#define W(a, ...) a|__VA_ARGS__|\n"
                   "V() V(1) V(1, (2, 3)) W(1) W(1, 2, 3)"),
            "f ( ) f ( 1 ) f ( 1 , ( 2 , 3 ) ) 1 | | 1 | 2 , 3 |");
}

TEST(Macro, VariadicOfGcc) {
  EXPECT_EQ(expand("#define A(x, ...) f(x, ##__VA_ARGS__)\n#define B(x, r...) g(x, r)\n"
                   "A(1) A(1, 2) B(1, 2, 3)"),
            "f ( 1 ) f ( 1 , 2 ) g ( 1 , 2 , 3 )");
}

TEST(Macro, VaOpt) {
  EXPECT_EQ(expand("#define F(a, ...) f(a __VA_OPT__(, __VA_ARGS__))\n#define E\n"
                   "F(1) F(1, 2, 3) F(1, E)"),
            "f ( 1 ) f ( 1 , 2 , 3 ) f ( 1 )");
  EXPECT_EQ(expand("#define P(a, ...) a ## __VA_OPT__(b)\nP(x) P(x, y)"), "x xb");
}

TEST(Macro, UndefAndEqualRedefinition) {
  EXPECT_EQ(expand("#define A 1 + 2\n#define A 1 + 2\nA\n#undef A\n#undef A\nA"), "1 + 2 A");
}

TEST(Macro, CallGoesOnBehindTheExpansion) {
  EXPECT_EQ(expand("#define F(x) <x>\n#define G F\nG(1) G\n\n(2)"), "< 1 > < 2 >");
}

TEST(Macro, ConditionalsInsideArguments) {
  EXPECT_EQ(expand("#define F(x) <x>\nF(1\n#if 0\n2\n#else\n3\n#endif\n)"), "< 1 3 >");
}

TEST(Predefined, LineFileCounter) {
  EXPECT_EQ(expand("__LINE__\n__LINE__ __FILE__ __COUNTER__ __COUNTER__"), "1 2 \"main.hlsl\" 0 1");
  EXPECT_EQ(expand("#define L __LINE__\n#define M(x) L x\n\nM(\n1)"), "4 1");
}

TEST(Predefined, WhatDxcDefines) {
  PreprocessOptions options;
  options.shader_model_minor = 5;
  EXPECT_EQ(expand("__hlsl_dx_compiler __HLSL_VERSION __SHADER_TARGET_MAJOR __SHADER_TARGET_MINOR "
                   "__SHADER_TARGET_STAGE __SHADER_STAGE_LIBRARY __SHADER_STAGE_COMPUTE "
                   "__spirv__ __cplusplus __HLSL_ENABLE_16_BIT",
                   {}, options),
            "1 2021 6 5 6 6 5 __spirv__ __cplusplus __HLSL_ENABLE_16_BIT");
  options.stage = ShaderStage::kCompute;
  options.enable_16bit_types = true;
  EXPECT_EQ(expand("#if __SHADER_TARGET_STAGE == __SHADER_STAGE_COMPUTE\nyes\n#endif\n"
                   "__HLSL_ENABLE_16_BIT",
                   {}, options),
            "yes 1");
}

TEST(Predefined, OptionsDefine) {
  PreprocessOptions options;
  options.defines = {"A", "B=2 + 3", "C=", "D=x\\", "E=1 // end"};
  EXPECT_EQ(expand("A | B | C | E", {}, options), "1 | 2 + 3 | | 1");
}

TEST(Predefined, OptionsDefineMacrosWithParameters) {
  PreprocessOptions options;
  options.defines = {"F(x, y)=x + y", "G(x)="};
  EXPECT_EQ(expand("F(1, 2) G(3) 4", {}, options), "1 + 2 4");
}

std::string condition(const std::string& expression) {
  return expand("#define ONE 1\n#define F(x) ((x) * 2)\n#if " + expression +
                "\nyes\n#else\nno\n#endif");
}

TEST(Conditional, Expressions) {
  for (const char* yes : {"1",
                          "ONE",
                          "F(2) == 4",
                          "1 + 2 * 3 == 7",
                          "(1 + 2) * 3 == 9",
                          "1 << 40 != 0",
                          "-1 < 0",
                          "-1 > 0u",
                          "~0 == -1",
                          "!0",
                          "7 / 2 == 3",
                          "-7 % 3 == -1",
                          "1 ? 2 : 0",
                          "0 ? 1 : 0 ? 0 : 5",
                          "1 || 1 / 0",
                          "!(0 && 1 / 0)",
                          "defined ONE",
                          "defined(ONE)",
                          "!defined TWO",
                          "UNKNOWN == 0",
                          "true",
                          "!false",
                          "0x10 == 16 && 010 == 8 && 0b11 == 3",
                          "'a' == 97",
                          "(5 & 6) == 4 && (5 | 6) == 7 && (5 ^ 6) == 3",
                          "3 >= 3 && 3 <= 3",
                          "0xFFFFFFFFFFFFFFFF > 0",
                          "-9223372036854775807 - 1 < 0",
                          "1 << 2 + 1 == 8",
                          "-8 >> 1 == -4",
                          "(2 ? 0x8000000000000000 : -1) > 0"}) {
    EXPECT_EQ(condition(yes), "yes") << yes;
  }
  for (const char* no : {"0", "UNKNOWN", "1 == 2", "defined TWO", "1 - 1", "0 && 1",
                         "(-9223372036854775807 - 1) / -1 > 0", "1 << 64", "2147483647 + 1 < 0"}) {
    EXPECT_EQ(condition(no), "no") << no;
  }
}

TEST(Conditional, FirstTrueGroupIsRead) {
  const std::string chain =
      "#if A == 1\none\n#elif A == 2\ntwo\n#elif A == 2\ntwice\n#else\nno\n#endif\n";
  EXPECT_EQ(expand("#define A 1\n" + chain), "one");
  EXPECT_EQ(expand("#define A 2\n" + chain), "two");
  EXPECT_EQ(expand("#define A 3\n" + chain), "no");
}

TEST(Conditional, ConditionsBehindATakenGroupAreNotRead) {
  EXPECT_EQ(expand("#if 1\na\n#elif 1 / 0\nb\n#elif ?\nc\n#endif"), "a");
}

TEST(Conditional, GroupsNest) {
  EXPECT_EQ(expand("#ifdef A\n#if 1\nx\n#else\ny\n#endif\n#elif 1\n#ifndef A\nz\n#endif\n#endif"),
            "z");
}

TEST(Conditional, WhatIsLeftOutNeedNotBeValid) {
  EXPECT_EQ(expand("#if 0\ndon't @ \"open\n#bogus\n#include <missing>\n#if ? (\n#endif\n"
                   "/* #endif */\n#endif\nok"),
            "ok");
}

TEST(Include, QuotedIsRelativeToTheIncludingFile) {
  EXPECT_EQ(expand("#include \"a/x.hlsli\"", {{"a/x.hlsli", "x\n#include \"y.hlsli\"\n"},
                                              {"a/y.hlsli", "inner\n#include \"../z.hlsli\"\n"},
                                              {"y.hlsli", "outer"},
                                              {"z.hlsli", "z"}}),
            "x inner z");
}

TEST(Include, FoldersInOrder) {
  PreprocessOptions options;
  options.include_folders = {"first", "second/"};
  EXPECT_EQ(expand("#include <a.h>\n#include \"b.h\"\n#include <c.h>",
                   {{"first/a.h", "1"},
                    {"second/a.h", "2"},
                    {"first/b.h", "3"},
                    {"b.h", "4"},
                    {"second/c.h", "5"},
                    {"c.h", "6"}},
                   options),
            "1 4 5");
}

TEST(Include, BackslashAndOtherCase) {
  EXPECT_EQ(expand("#include \"Common\\Math.HLSLI\"\n#include \"common/math.hlsli\"",
                   {{"common/math.hlsli", "#pragma once\nm"}}),
            "m");
}

TEST(Include, OnceAndGuards) {
  EXPECT_EQ(
      expand("#include \"once.h\"\n#include \"./once.h\"\n#include \"g.h\"\n#include \"g.h\"\n"
             "#include \"twice.h\"\n#include \"twice.h\"",
             {{"once.h", "#pragma once\na"},
              {"g.h", "#ifndef G\n#define G\nb\n#endif"},
              {"twice.h", "c"}}),
      "a b c c");
}

TEST(Include, NameFromAMacro) {
  PreprocessOptions options;
  options.include_folders = {"i"};
  EXPECT_EQ(expand("#define Q \"q.h\"\n#define A <a.h>\n#define X(n) n\n#include Q\n#include A\n"
                   "#include X(\"q.h\")",
                   {{"q.h", "1"}, {"i/a.h", "2"}}, options),
            "1 2 1");
}

TEST(Include, HasInclude) {
  EXPECT_EQ(expand("#if defined(__has_include) && __has_include(\"q.h\") && "
                   "!__has_include(<q.h>)\nyes\n#endif",
                   {{"q.h", ""}}),
            "yes");
  EXPECT_EQ(expand("#define H(x) __has_include(x) || __has_include(\"q.h\")\n#if H(<z.h>)\nyes\n"
                   "#endif",
                   {{"q.h", ""}}),
            "yes");
}

TEST(Include, TokensDoNotRunTogether) {
  EXPECT_EQ(expand("#include \"a.h\"\nb", {{"a.h", "a"}}), "a b");
  EXPECT_EQ(expand("#include \"a.h\"\nb", {{"a.h", "a // x"}}), "a b");
}

TEST(Pragma, PackMatrixBecomesAToken) {
  Preprocessed input("a\n#pragma pack_matrix(row_major)\nb\n  #pragma pack_matrix( column_major )");
  EXPECT_EQ(input.rendered(), "");
  EXPECT_EQ(input.text(), "a pack:row_major b pack:column_major");
  ResolvedLocation at = input.sources.resolve(input.list.tokens[1].location);
  EXPECT_EQ(at.line, 2u);
  EXPECT_EQ(at.column, 9u);
}

TEST(Pragma, KnownOnesAreIgnored) {
  EXPECT_EQ(expand("#pragma warning(disable : 3571)\n#pragma message(\"x\")\n#pragma\n"
                   "#pragma region R\n#pragma endregion\nx"),
            "x");
}

TEST(Line, ChangesLinesAndName) {
  Preprocessed input("#line 100 \"other.hlsl\"\n__LINE__ __FILE__\n#line 7\n@\n# 1 \"m.h\" 2\n@");
  EXPECT_EQ(input.text(), "100 \"other.hlsl\"");
  EXPECT_EQ(input.places(), (std::vector<std::string>{"other.hlsl:7:1 KA2100", "m.h:1:1 KA2100"}));
}

TEST(Directive, NullDirectiveAndSpaces) {
  EXPECT_EQ(expand("#\n  # /* x */ define A 1 // y\n#define B \\\n 2\nA B"), "1 2");
}

TEST(Directive, HashInsideALineIsNoDirective) {
  EXPECT_EQ(expand("#define EMPTY\nEMPTY # define A"), "# define A");
}

}  // namespace
}  // namespace kaamos::hlsl

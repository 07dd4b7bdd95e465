// SPDX-License-Identifier: MIT
// Each mistake is reported at its exact place, and reading continues after it.
#include <gtest/gtest.h>

#include "runtime/hlsl/front/preprocess_test_support.h"

namespace kaamos::hlsl {
namespace {

struct Case {
  const char* name;
  const char* source;
  const char* place;           // Where the only diagnostic points.
  const char* text = nullptr;  // The tokens that come out.
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

const Case kCases[] = {
    {"IncludeNotFound", "x\n#include \"no.h\"\ny", "main.hlsl:2:2 KA2002", "x y"},
    {"AngledWithoutFolder", "#include <no.h>", "main.hlsl:1:2 KA2002"},
    {"IncludeWithoutName", "#include\n", "main.hlsl:1:2 KA2004"},
    {"IncludeOfAName", "#include foo.h\nx", "main.hlsl:1:10 KA2004", "x"},
    {"IncludeExtra", "#include \"self.h\" x\ny", "main.hlsl:1:19 KA2009", "s y"},
    {"IncludeInArguments", "#define F(x) x\nF(1\n#include \"self.h\"\n)", "main.hlsl:3:2 KA2007",
     "1"},
    {"UnknownDirective", "#defin A\nx", "main.hlsl:1:2 KA2008", "x"},
    {"EndifExtra", "#if 1\nx\n#endif FOO", "main.hlsl:3:8 KA2009", "x"},
    {"DefineWithoutName", "#define\n", "main.hlsl:1:8 KA2010"},
    {"DefineOfANumber", "#define 1 2", "main.hlsl:1:9 KA2010"},
    {"IfdefWithoutName", "#ifdef\nx\n#endif", "main.hlsl:1:7 KA2010", ""},
    {"DefineDefined", "#define defined 1", "main.hlsl:1:9 KA2011"},
    {"Redefined", "#define A 1\n#define A 2\nA", "main.hlsl:2:9 KA2012", "2"},
    {"PredefinedChanged", "#undef __HLSL_VERSION", "main.hlsl:1:8 KA2013"},
    {"BuiltinDefined", "#define __LINE__ 3\n__LINE__", "main.hlsl:1:9 KA2013", "3"},
    {"ParameterIsNumber", "#define F(a, 1) a", "main.hlsl:1:14 KA2014"},
    {"ParameterTwice", "#define F(a, b, a) a", "main.hlsl:1:17 KA2015"},
    {"ParametersUnclosed", "#define F(a b) a", "main.hlsl:1:13 KA2016"},
    {"ParametersEndOfLine", "#define F(a\n) x", "main.hlsl:1:12 KA2016", ") x"},
    {"VaArgsElsewhere", "#define F(a) __VA_ARGS__", "main.hlsl:1:14 KA2017"},
    {"VaOptElsewhere", "#define F(a) __VA_OPT__(a)", "main.hlsl:1:14 KA2017"},
    {"StringizeOther", "#define F(a) # b", "main.hlsl:1:14 KA2018"},
    {"StringizeEnd", "#define F(a) a #", "main.hlsl:1:16 KA2018"},
    {"PasteFirst", "#define F ## a", "main.hlsl:1:11 KA2019"},
    {"PasteLast", "#define F(a) a ##", "main.hlsl:1:16 KA2019"},
    {"PasteInvalid", "#define C(a, b) a##b\nx C(+, 1) y", "main.hlsl:2:3 KA2020", "x + 1 y"},
    {"PasteComment", "#define C(a, b) a##b\nC(/, /) y", "main.hlsl:2:1 KA2020", "/ / y"},
    {"TooFewArguments", "#define F(a, b) a\nx F(1) y", "main.hlsl:2:3 KA2021", "x y"},
    {"TooManyArguments", "#define F(a) a\nF(1, 2) y", "main.hlsl:2:1 KA2022", "y"},
    {"ArgumentsForNone", "#define F() a\nF(1) y", "main.hlsl:2:1 KA2022", "y"},
    {"Unterminated", "#define F(a) a\n  F(1, (2)", "main.hlsl:2:3 KA2023"},
    {"UnterminatedInDirective", "#define F(a) a\n#if F(1\n#endif\nx", "main.hlsl:2:5 KA2023", "x"},
    {"VaOptWithoutParen", "#define F(...) __VA_OPT__ x", "main.hlsl:1:16 KA2026"},
    {"VaOptUnclosed", "#define F(...) __VA_OPT__((x)", "main.hlsl:1:16 KA2026"},
    {"VaOptNested", "#define F(...) __VA_OPT__(__VA_OPT__(x))", "main.hlsl:1:27 KA2027"},
    {"UnterminatedIf", "x\n#if 1\ny", "main.hlsl:2:2 KA2030", "x y"},
    {"UnterminatedSkipped", "#ifdef A\nx", "main.hlsl:1:2 KA2030", ""},
    {"ElseAlone", "#else\nx", "main.hlsl:1:2 KA2031", "x"},
    {"EndifAlone", "x\n  #endif", "main.hlsl:2:4 KA2031", "x"},
    {"ElifAlone", "#elif 1", "main.hlsl:1:2 KA2031"},
    {"ElseTwice", "#if 1\nx\n#else\n#else\n#endif", "main.hlsl:4:2 KA2032", "x"},
    {"ElifBehindElse", "#if 0\n#else\nx\n#elif 1\ny\n#endif", "main.hlsl:4:2 KA2032", "x"},
    {"IfEmpty", "#if\nx\n#endif", "main.hlsl:1:2 KA2033", ""},
    {"OperandMissing", "#if 1 +\n#endif", "main.hlsl:1:8 KA2034"},
    {"OperandString", "#if \"a\"\n#endif", "main.hlsl:1:5 KA2034"},
    {"ParenMissing", "#if (1\n#endif", "main.hlsl:1:7 KA2035"},
    {"ColonMissing", "#if 1 ? 2\n#endif", "main.hlsl:1:10 KA2035"},
    {"DefinedWithoutName", "#if defined(1)\n#endif", "main.hlsl:1:13 KA2010"},
    {"Trailing", "#if 1 2\n#endif", "main.hlsl:1:7 KA2036"},
    {"DivisionByZero", "#if 4 / (2 - 2)\n#endif", "main.hlsl:1:7 KA2037"},
    {"RemainderByZero", "#if 0\n#elif 4 % 0\n#endif", "main.hlsl:2:9 KA2037"},
    {"FloatInIf", "#if 1.0\n#endif", "main.hlsl:1:5 KA2038"},
    {"ErrorDirective", "#error don't do  this\nx", "main.hlsl:1:2 KA2040", "x"},
    {"WarningDirective", "#warning old", "main.hlsl:1:2 KA2041"},
    {"LineNotANumber", "#line 1x", "main.hlsl:1:7 KA2042"},
    {"LineTooLarge", "#line 2147483648", "main.hlsl:1:7 KA2042"},
    {"LineName", "#line 3 foo", "main.hlsl:1:9 KA2043"},
    {"LineNameEmpty", "#line 3 \"\"\nx", "main.hlsl:1:9 KA2043", "x"},
    {"UnknownPragma", "#pragma unicorn(1)\nx", "main.hlsl:1:9 KA2044", "x"},
    {"PackMatrix", "#pragma pack_matrix(diagonal)\nx", "main.hlsl:1:21 KA2045", "x"},
    {"PackMatrixNoParen", "#pragma pack_matrix row_major", "main.hlsl:1:21 KA2045"},
    {"OnceInMain", "#pragma once", "main.hlsl:1:9 KA2046"},
    {"Character", "x @ y", "main.hlsl:1:3 KA2100", "x y"},
    {"CharacterUtf8", "x \xC3\xA4 y", "main.hlsl:1:3 KA2100", "x y"},
    {"CommentOpen", "x\n  /* y", "main.hlsl:2:3 KA2101", "x"},
    {"StringOpen", "x \"abc\ny", "main.hlsl:1:3 KA2102", "x y"},
    {"CharacterOpen", "don't", "main.hlsl:1:4 KA2103", "don"},
    {"EmptyCharacter", "#if ''\n#endif", "main.hlsl:1:5 KA2104"},
    {"Escape", "\"a\\q\"", "main.hlsl:1:3 KA2105"},
    {"EscapeLarge", "\"\\777\"", "main.hlsl:1:2 KA2106"},
    {"EscapeHexEmpty", "\"\\xg\"", "main.hlsl:1:2 KA2107"},
    {"CharacterEmpty", "x = '';", "main.hlsl:1:5 KA2104"},
    {"CharacterPair", "x = 'ab';", "main.hlsl:1:5 KA2281"},
    {"CharacterWide", "x = '\xC3\xA4';", "main.hlsl:1:5 KA2281"},
    {"CharacterEscape", "x = '\\q';", "main.hlsl:1:6 KA2105"},
    {"CharacterEscapeLarge", "x = '\\400';", "main.hlsl:1:6 KA2106"},
    {"IntegerLarge", "x 18446744073709551616", "main.hlsl:1:3 KA2110"},
    {"HexLarge", "0x10000000000000000", "main.hlsl:1:1 KA2110"},
    {"OctalDigit", "x 0178", "main.hlsl:1:6 KA2111"},
    {"BinaryDigit", "0b102", "main.hlsl:1:5 KA2111"},
    {"HexEmpty", "0x", "main.hlsl:1:1 KA2112"},
    {"IntegerSuffix", "12abc", "main.hlsl:1:3 KA2113"},
    {"IntegerSuffixF", "x 1f", "main.hlsl:1:4 KA2113"},
    {"IntegerSuffixMixed", "1lL", "main.hlsl:1:2 KA2113"},
    {"FloatSuffix", "1.5x", "main.hlsl:1:4 KA2114"},
    {"ExponentEmpty", "1.5e+", "main.hlsl:1:4 KA2115"},
    {"HexFloatSuffix", "0x1.8p3x", "main.hlsl:1:8 KA2114"},
    {"HexFloatExponentEmpty", "x 0x1.8p+", "main.hlsl:1:8 KA2115"},
    {"HexFloatWithoutExponent", "0x1.8;", "main.hlsl:1:6 KA2282"},
    {"HexFloatWithoutDigits", "0x.p1;", "main.hlsl:1:1 KA2112"},
    {"HexFloatLarge", "0x1p1024", "main.hlsl:1:1 KA2117"},
    {"HexFloatInfinite", "0x1p128f", "main.hlsl:1:1 KA2118"},
    {"HexHalfInfinite", "0x1p16h", "main.hlsl:1:1 KA2118"},
    {"HexFloatInIf", "#if 0x1p0\n#endif", "main.hlsl:1:5 KA2038"},
    {"FloatLarge", "1e400", "main.hlsl:1:1 KA2117"},
    {"FloatInfinite", "x 1e39f", "main.hlsl:1:3 KA2118"},
    {"HalfInfinite", "70000.0h", "main.hlsl:1:1 KA2118"},
};

class ErrorTest : public testing::TestWithParam<Case> {};

TEST_P(ErrorTest, HasItsPlace) {
  Preprocessed input(GetParam().source, {{"self.h", "s"}});
  EXPECT_EQ(input.places(), std::vector<std::string>{GetParam().place}) << input.rendered();
  if (GetParam().text) {
    EXPECT_EQ(input.text(), GetParam().text);
  }
}

INSTANTIATE_TEST_SUITE_P(Preprocess, ErrorTest, testing::ValuesIn(kCases),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Errors, SeveralInOneRun) {
  Preprocessed input("#include \"a.h\"\n1.0x\n#bogus\n#if 1 +\n#endif\n@");
  EXPECT_EQ(input.places(),
            (std::vector<std::string>{"main.hlsl:1:2 KA2002", "main.hlsl:2:4 KA2114",
                                      "main.hlsl:3:2 KA2008", "main.hlsl:4:8 KA2034",
                                      "main.hlsl:6:1 KA2100"}));
}

TEST(Errors, MissingMainFile) {
  MemoryFileLoader loader;
  SourceManager sources(loader);
  DiagnosticEngine diagnostics;
  TokenList list = preprocess_file("none.hlsl", {}, sources, diagnostics);
  EXPECT_EQ(list.tokens.size(), 1u);
  EXPECT_EQ(render_all(diagnostics, sources),
            "error: cannot open 'none.hlsl': there is no such file [KA2001]\n1 error\n");
}

TEST(Errors, DefineOption) {
  PreprocessOptions options;
  options.defines = {"1A=2", "OK=1", "B=1\n#error x", "F(x\n)=1", "(x)=1"};
  Preprocessed input("OK", {}, options);
  EXPECT_EQ(input.text(), "1");
  EXPECT_EQ(input.places(), (std::vector<std::string>(4, ":0:0 KA2047")));
}

TEST(Errors, DefineOptionWithBrokenParameters) {
  PreprocessOptions options;
  options.defines = {"F(x=2"};
  Preprocessed input("OK", {}, options);
  EXPECT_EQ(input.places().size(), 1u);
  EXPECT_EQ(input.places()[0].substr(0, 16), "<command line>:1");
}

TEST(Errors, UnterminatedIfInAnInclude) {
  Preprocessed input("#include \"a.h\"\n#endif", {{"a.h", "\n#if 1"}});
  EXPECT_EQ(input.places(), (std::vector<std::string>{"a.h:2:2 KA2030", "main.hlsl:2:2 KA2031"}));
}

TEST(Limits, IncludeDepth) {
  Preprocessed input("#include \"main.hlsl\"\nx");
  EXPECT_EQ(input.places(), std::vector<std::string>{"main.hlsl:1:2 KA2005"});
}

TEST(Limits, NumberOfInclusions) {
  PreprocessOptions options;
  options.max_include_depth = 30;
  options.max_inclusions = 300;
  Preprocessed input(
      "#include \"a.h\"",
      {{"a.h", "#if __COUNTER__ < 1000000\n#include \"b.h\"\n#endif\n"}, {"b.h", "x"}}, options);
  EXPECT_EQ(input.text(), "x");
  Preprocessed many("#include \"0.h\"",
                    {{"0.h", "#include \"1.h\"\n#include \"1.h\"\n#include \"1.h\""},
                     {"1.h", "#include \"2.h\"\n#include \"2.h\"\n#include \"2.h\""},
                     {"2.h", "#include \"3.h\"\n#include \"3.h\"\n#include \"3.h\""},
                     {"3.h", "#include \"4.h\"\n#include \"4.h\"\n#include \"4.h\""},
                     {"4.h", "#include \"5.h\"\n#include \"5.h\"\n#include \"5.h\""},
                     {"5.h", "x"}},
                    options);
  ASSERT_EQ(many.diagnostics.error_count(), 1u);
  EXPECT_EQ(many.diagnostics.diagnostics()[0].id, DiagnosticId::kTooMuchSource);
}

TEST(Includes, OfLinearAlgebraAreNamed) {
  Preprocessed input("#include <dx/linalg.h>\n");
  EXPECT_EQ(input.places(), std::vector<std::string>{"main.hlsl:1:2 KA2002"});
  EXPECT_NE(input.rendered().find("linear algebra, Shader Model 6.10"), std::string::npos);
}

TEST(Limits, ExpansionSize) {
  std::string laughs = "#define L0(x) x x x x x x x x x x\n";
  for (int i = 1; i < 20; ++i) {
    std::string last = "L" + std::to_string(i - 1) + "(x)";
    laughs += "#define L" + std::to_string(i) + "(x) " + last + last + last + "\n";
  }
  PreprocessOptions options;
  options.max_expansion_tokens = 100'000;
  Preprocessed input(laughs + "L19(ha)", {}, options);
  ASSERT_EQ(input.diagnostics.error_count(), 1u);
  EXPECT_EQ(input.diagnostics.diagnostics()[0].id, DiagnosticId::kExpansionTooLarge);
}

TEST(Limits, PastedNamesDouble) {
  std::string source = "#define D(x) E(x, x)\n#define E(x, y) x##y\n";
  std::string call = "a";
  for (int i = 0; i < 100; ++i) call = "D(" + call + ")";
  Preprocessed input(source + call);
  ASSERT_EQ(input.diagnostics.error_count(), 1u);
  EXPECT_EQ(input.diagnostics.diagnostics()[0].id, DiagnosticId::kExpansionTooLarge);
}

TEST(Limits, CallsInsideArguments) {
  std::string call = "1";
  for (int i = 0; i < 1000; ++i) call = "F(" + call + ")";
  Preprocessed input("#define F(x) x\n" + call);
  ASSERT_EQ(input.diagnostics.error_count(), 1u);
  EXPECT_EQ(input.diagnostics.diagnostics()[0].id, DiagnosticId::kExpansionTooDeep);
}

TEST(Limits, ParensInAnExpression) {
  Preprocessed input("#if " + std::string(100'000, '(') + "\n#endif\n#if " +
                     std::string(100'000, '-') + "1\n#endif\nx");
  EXPECT_EQ(input.text(), "x");
  ASSERT_EQ(input.diagnostics.error_count(), 2u);
  EXPECT_EQ(input.diagnostics.diagnostics()[0].id, DiagnosticId::kConditionTooDeep);
}

TEST(Limits, LongChainOfMacros) {
  std::string source = "#define M0 @\n";
  for (int i = 1; i < 5000; ++i) {
    source += "#define M" + std::to_string(i) + " M" + std::to_string(i - 1) + "\n";
  }
  Preprocessed input(source + "M4999");
  EXPECT_EQ(input.places(), std::vector<std::string>{"main.hlsl:5001:1 KA2100"});
  EXPECT_NE(input.rendered().find("note: 4992 more macro expansions are not shown"),
            std::string::npos);
}

}  // namespace
}  // namespace kaamos::hlsl

// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/diagnostic.h"

#include <gtest/gtest.h>

#include "runtime/hlsl/front/preprocess_test_support.h"

namespace kaamos::hlsl {
namespace {

TEST(DiagnosticTable, NumbersAscendWithinTheHlslRange) {
  uint16_t last = 1999;
  for (const DiagnosticInfo& info : diagnostic_table()) {
    auto number = static_cast<uint16_t>(info.id);
    EXPECT_GT(number, last) << info.name;
    EXPECT_LT(number, 3000) << info.name;
    EXPECT_FALSE(info.text.empty()) << info.name;
    EXPECT_FALSE(info.cure.empty()) << info.name;
    EXPECT_EQ(&diagnostic_info(info.id), &info);
    last = number;
  }
}

TEST(DiagnosticTable, TextsAreSentencesWithoutAFullStop) {
  for (const DiagnosticInfo& info : diagnostic_table()) {
    EXPECT_NE(info.text.back(), '.') << info.name;
    EXPECT_NE(info.text.back(), '\n') << info.name;
  }
}

TEST(Render, LineCaretAndCode) {
  EXPECT_EQ(Preprocessed("float a;\n\tfloat b = 1.0x;\n").rendered(),
            "main.hlsl:2:15: error: invalid suffix 'x' on floating-point number '1.0'; allowed are "
            "f, h, l [KA2114]\n"
            "    float b = 1.0x;\n"
            "                 ^\n"
            "1 error\n");
}

TEST(Render, IncludeAndMacroChains) {
  Preprocessed input("#include \"a.h\"\n",
                     {{"a.h", "// a\n#include \"b.h\"\n"},
                      {"b.h", "#define BAD(x) x + @\n#define OUTER BAD(1)\n  OUTER;\n"}});
  EXPECT_EQ(input.rendered(),
            "In file included from main.hlsl:1:\n"
            "In file included from a.h:2:\n"
            "b.h:3:3: error: unexpected character '@' [KA2100]\n"
            "  OUTER;\n"
            "  ^\n"
            "b.h:2:15: note: expanded from macro 'OUTER'\n"
            "#define OUTER BAD(1)\n"
            "              ^\n"
            "b.h:1:20: note: expanded from macro 'BAD'\n"
            "#define BAD(x) x + @\n"
            "                   ^\n"
            "1 error\n");
}

TEST(Render, ArgumentsPointIntoTheCall) {
  Preprocessed input("#define F(x) x\nF(1 + @)");
  EXPECT_EQ(input.places(), std::vector<std::string>{"main.hlsl:2:7 KA2100"});
}

TEST(Render, NotesFollow) {
  EXPECT_EQ(Preprocessed("#define A 1\n#define A 2\n").rendered(),
            "main.hlsl:2:9: warning: macro 'A' is redefined differently [KA2012]\n"
            "#define A 2\n"
            "        ^\n"
            "main.hlsl:1:9: note: the previous definition is here\n"
            "#define A 1\n"
            "        ^\n"
            "1 warning\n");
}

TEST(Render, RangeIsUnderlined) {
  Preprocessed input("float4 x = first + second * 2;");
  const auto& tokens = input.list.tokens;
  input.diagnostics.report(DiagnosticId::kUnknownDirective, tokens[4].location, {"x"})
      .range(tokens[3].location, tokens[5].location);
  EXPECT_EQ(input.rendered(),
            "main.hlsl:1:18: error: unknown preprocessor directive '#x' [KA2008]\n"
            "float4 x = first + second * 2;\n"
            "           ~~~~~~^~~~~~~~\n"
            "1 error\n");
}

TEST(Render, WideCharactersTakeOneColumn) {
  EXPECT_EQ(Preprocessed("/* \xC3\xA4\xE2\x82\xAC */ @").rendered(),
            "main.hlsl:1:13: error: unexpected character '@' [KA2100]\n"
            "/* \xC3\xA4\xE2\x82\xAC */ @\n"
            "         ^\n"
            "1 error\n");
}

TEST(Render, LongLinesAreCutAroundTheCaret) {
  std::string source(5000, ' ');
  source[2500] = '@';
  std::string text = Preprocessed(source).rendered();
  EXPECT_LT(text.size(), 600u);
  EXPECT_NE(text.find("main.hlsl:1:2501: error"), std::string::npos);
  size_t line = text.find('\n') + 1;
  size_t marks = text.find('\n', line) + 1;
  EXPECT_EQ(text.find('@', line) - line, text.find('^', marks) - marks);
}

TEST(Engine, LimitEndsTheRun) {
  std::string source;
  for (int i = 0; i < 100; ++i) source += "@\n";
  Preprocessed input(source);
  ASSERT_EQ(input.diagnostics.diagnostics().size(), 51u);
  EXPECT_EQ(input.diagnostics.diagnostics().back().id, DiagnosticId::kTooManyErrors);
  EXPECT_TRUE(input.diagnostics.should_stop());
  Preprocessed unlimited(source, {}, {}, {.error_limit = 0});
  EXPECT_EQ(unlimited.diagnostics.error_count(), 100u);
}

TEST(Engine, StrictTurnsMarkedWarningsIntoErrors) {
  const auto report_both = [](DiagnosticEngine& engine) {
    engine.report(DiagnosticId::kAccessSpecifier, {}, {"public"});
    engine.report(DiagnosticId::kUnknownAttribute, {}, {"unicorn"});
  };
  DiagnosticEngine lenient(DiagnosticOptions{});
  report_both(lenient);
  EXPECT_EQ(lenient.error_count(), 0u);
  EXPECT_EQ(lenient.warning_count(), 2u);
  DiagnosticEngine strict({.strict = true});
  report_both(strict);
  EXPECT_EQ(strict.error_count(), 1u);
  EXPECT_EQ(strict.warning_count(), 1u);
}

TEST(Engine, NotesBehindTheLimitGoNowhere) {
  DiagnosticEngine diagnostics({.error_limit = 1});
  for (int i = 0; i < 3; ++i) {
    diagnostics.report(DiagnosticId::kElseAfterElse, {}, {"else"}).note({}, "n").range({}, {});
  }
  ASSERT_EQ(diagnostics.diagnostics().size(), 2u);
  EXPECT_EQ(diagnostics.diagnostics()[0].notes.size(), 1u);
  EXPECT_EQ(diagnostics.diagnostics()[1].notes.size(), 0u);
}

}  // namespace
}  // namespace kaamos::hlsl

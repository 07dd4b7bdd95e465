// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/print_tokens.h"

#include <gtest/gtest.h>

#include <tuple>
#include <vector>

#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/front/preprocess.h"

namespace kaamos::hlsl {
namespace {

struct Printed {
  std::string text;
  // Kind, text, file and line of each token.
  std::vector<std::tuple<TokenKind, std::string, std::string, uint32_t>> tokens;
};

Printed print(const std::string& main, const std::map<std::string, std::string>& files = {}) {
  MemoryFileLoader loader(files);
  SourceManager sources(loader);
  DiagnosticEngine diagnostics;
  const TokenList list = preprocess_text("main.hlsl", main, {}, sources, diagnostics);
  EXPECT_EQ(render_all(diagnostics, sources), "");
  Printed out;
  out.text = print_tokens(list, sources);
  for (const Token& token : list.tokens) {
    if (token.is(TokenKind::kEndOfFile)) continue;
    const ResolvedLocation place = sources.resolve(token.location);
    out.tokens.emplace_back(token.kind, token.text, place.path, place.line);
  }
  return out;
}

// The text gives the same tokens on the same lines of the same files.
void expect_same_again(const std::string& main,
                       const std::map<std::string, std::string>& files = {}) {
  const Printed once = print(main, files);
  EXPECT_EQ(print(once.text).tokens, once.tokens) << once.text;
}

TEST(PrintTokens, LinesStayWhereTheyAre) {
  EXPECT_EQ(print("int a;\n\n  float b = 1.5f;\n").text,
            "#line 1 \"main.hlsl\"\nint a;\n\nfloat b = 1.5f;\n");
  expect_same_again("int a;\n\n\n\n\n\n\n\n\n\n\n\n\nint b; int c;\nint d");
}

TEST(PrintTokens, IncludesAreNamed) {
  expect_same_again(
      "int a;\n#include \"b.hlsli\"\nint c;\n#include \"b.hlsli\"\n",
      {{"b.hlsli", "int b;\n#include \"folder/d.hlsli\"\nint e;"}, {"folder/d.hlsli", "float d;"}});
}

TEST(PrintTokens, TokensOfMacrosDoNotJoin) {
  expect_same_again("#define N -1\n#define P +\nint a = -N; int b = 1 P+N; int c = N-N;");
  expect_same_again("#define NAME a\n#define F(x) x NAME x\nint F(b)NAME;");
  expect_same_again("#define LINES(x) {\\\n x;\\\n}\nLINES(int a;\n int b)\nint c;");
}

TEST(PrintTokens, StringsAndPragmas) {
  expect_same_again("a(\"quote \\\" slash \\\\ line \\n digit \\0011\" \"joined\");");
  expect_same_again(
      "int a;\n#pragma pack_matrix(row_major)\nint b;\n"
      "#pragma pack_matrix(column_major)\nint c; int d;");
}

TEST(PrintTokens, LineDirectivesAreObeyed) {
  expect_same_again("#line 100 \"other \\\\ file.hlsl\"\nint a;\n#line 7\nint b;\nint c;");
}

TEST(PrintTokens, NothingIsNothing) {
  EXPECT_EQ(print("#define A\n// text\nA").text, "");
}

}  // namespace
}  // namespace kaamos::hlsl

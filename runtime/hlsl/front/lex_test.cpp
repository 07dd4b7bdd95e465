// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/lex.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/hlsl/front/preprocess_test_support.h"

namespace kaamos::hlsl {
namespace {

std::vector<TokenKind> kinds(const Preprocessed& input) {
  std::vector<TokenKind> result;
  for (const Token& token : input.list.tokens) result.push_back(token.kind);
  return result;
}

NumberLiteral number(std::string text) {
  Preprocessed input(std::move(text));
  EXPECT_EQ(input.rendered(), "");
  EXPECT_EQ(input.list.tokens.size(), 2u);
  return input.list.number(input.list.tokens[0]);
}

TEST(Lex, EveryPunctuatorAndKeywordReadsAsItself) {
  struct Expected {
    TokenKind kind;
    std::string_view text;
  };
  constexpr Expected kAll[] = {
#define KAAMOS_TOKEN(name, text)
#define KAAMOS_PUNCTUATOR(name, text) {TokenKind::name, text},
#define KAAMOS_KEYWORD(name, text) {TokenKind::name, text},
#include "runtime/hlsl/front/token_kinds.inc"
  };
  std::string source;
  for (const Expected& expected : kAll) source += " ; " + std::string(expected.text);
  Preprocessed input(source);
  EXPECT_EQ(input.rendered(), "");
  ASSERT_EQ(input.list.tokens.size(), 2 * std::size(kAll) + 1);
  for (size_t i = 0; i < std::size(kAll); ++i) {
    EXPECT_EQ(input.list.tokens[2 * i + 1].kind, kAll[i].kind) << kAll[i].text;
    EXPECT_EQ(input.list.tokens[2 * i + 1].text, kAll[i].text);
  }
}

TEST(Lex, TheLongestOperatorWins) {
  Preprocessed input("a<<=b>>=c->d...e::f+++g<=h");
  EXPECT_EQ(input.text(), "a <<= b >>= c -> d ... e :: f ++ + g <= h");
}

TEST(Lex, NamesKeywordsAndReservedWords) {
  Preprocessed input("float4 cbuffer sample goto _x1 linear");
  EXPECT_EQ(kinds(input),
            (std::vector<TokenKind>{TokenKind::kIdentifier, TokenKind::kCbuffer, TokenKind::kSample,
                                    TokenKind::kReservedWord, TokenKind::kIdentifier,
                                    TokenKind::kLinear, TokenKind::kEndOfFile}));
  EXPECT_TRUE(can_be_name(TokenKind::kSample));
  EXPECT_TRUE(can_be_name(TokenKind::kIdentifier));
  EXPECT_FALSE(can_be_name(TokenKind::kCbuffer));
  EXPECT_FALSE(can_be_name(TokenKind::kReservedWord));
}

TEST(Lex, EqualNamesHaveEqualNumbers) {
  Preprocessed input("abc def abc");
  const auto& tokens = input.list.tokens;
  EXPECT_EQ(tokens[0].value, tokens[2].value);
  EXPECT_NE(tokens[0].value, tokens[1].value);
}

TEST(Lex, Integers) {
  EXPECT_EQ(number("0").integer, 0u);
  EXPECT_TRUE(number("0").is_decimal);
  EXPECT_EQ(number("4294967296").integer, 4294967296u);
  EXPECT_EQ(number("18446744073709551615u").integer, UINT64_MAX);
  EXPECT_EQ(number("0xFFfFffFFFFFFFFFF").integer, UINT64_MAX);
  EXPECT_EQ(number("0x1F").integer, 31u);
  EXPECT_FALSE(number("0x1F").is_decimal);
  EXPECT_EQ(number("0b1011").integer, 11u);
  EXPECT_EQ(number("017").integer, 15u);
  EXPECT_FALSE(number("017").is_decimal);
}

TEST(Lex, IntegerSuffixes) {
  EXPECT_EQ(number("1").suffix, LiteralSuffix::kNone);
  for (const char* text : {"1u", "1U"}) EXPECT_EQ(number(text).suffix, LiteralSuffix::kU);
  for (const char* text : {"1l", "1L", "1ll", "1LL"}) {
    EXPECT_EQ(number(text).suffix, LiteralSuffix::kL) << text;
  }
  for (const char* text : {"1ul", "1UL", "1lu", "1ull", "1ULL", "1llu"}) {
    EXPECT_EQ(number(text).suffix, LiteralSuffix::kUL) << text;
  }
}

TEST(Lex, FloatingPointNumbers) {
  EXPECT_EQ(number("1.").real, 1.0);
  EXPECT_EQ(number(".5").real, 0.5);
  EXPECT_EQ(number("1.25e2").real, 125.0);
  EXPECT_EQ(number("1e+3").real, 1000.0);
  EXPECT_EQ(number("125e-3").real, 0.125);
  EXPECT_EQ(number("010.5").real, 10.5);
  EXPECT_EQ(number("1e-400").real, 0.0);
  EXPECT_EQ(number("1.5").suffix, LiteralSuffix::kNone);
  EXPECT_EQ(number("1.5f").suffix, LiteralSuffix::kF);
  EXPECT_EQ(number("1.5F").suffix, LiteralSuffix::kF);
  EXPECT_EQ(number("1.5h").suffix, LiteralSuffix::kH);
  EXPECT_EQ(number("1.5L").suffix, LiteralSuffix::kL);
}

TEST(Lex, SuffixFRoundsOnceToFloat) {
  // Halfway between two floats, except for a bit that double drops.
  EXPECT_EQ(number("1.00000005960464477540f").real, double{1.00000005960464477540f});
  EXPECT_EQ(number("0.1f").real, double{0.1f});
  EXPECT_EQ(number("0.1").real, 0.1);
}

TEST(Lex, HexadecimalFloats) {
  EXPECT_TRUE(number("0x1p0").is_float);
  EXPECT_FALSE(number("0x1p0").is_decimal);
  EXPECT_EQ(number("0x1p0").real, 1.0);
  EXPECT_EQ(number("0XA.8P-1").real, 5.25);
  EXPECT_EQ(number("0x.8p+2").real, 2.0);
  EXPECT_EQ(number("0x1.p3").real, 8.0);
  EXPECT_EQ(number("0x1.fffffffffffffp1023").real, std::numeric_limits<double>::max());
  EXPECT_EQ(number("0x1p-1074").real, std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(number("0x1p-149f").real, double{std::numeric_limits<float>::denorm_min()});
  EXPECT_EQ(number("0x1p-150f").real, 0.0);  // halfway, to even
  EXPECT_EQ(number("0x1.8p-150f").real, double{std::numeric_limits<float>::denorm_min()});
  EXPECT_EQ(number("0x1p-9999").real, 0.0);
  EXPECT_EQ(number("0x0p9999").real, 0.0);
  EXPECT_EQ(number("0x1p-1").suffix, LiteralSuffix::kNone);
  EXPECT_EQ(number("0x1p-1F").suffix, LiteralSuffix::kF);
  EXPECT_EQ(number("0x1p-1h").suffix, LiteralSuffix::kH);
  EXPECT_EQ(number("0x1p-1l").suffix, LiteralSuffix::kL);
  EXPECT_EQ(number("0x1.001p0h").real, 1.000244140625);  // the type rounds it
  // Halfway between two floats, except for bits that double drops.
  EXPECT_EQ(number("0x1.00000100000000000000000001p0f").real, 0x1.000002p0);
  EXPECT_EQ(number("0x1.000001p0f").real, 1.0);
}

TEST(Lex, CharactersAreUints) {
  const auto character = [](const char* text) {
    Preprocessed input(text);
    EXPECT_EQ(input.rendered(), "") << text;
    EXPECT_TRUE(input.list.tokens[0].is(TokenKind::kIntLiteral)) << text;
    EXPECT_EQ(input.list.numbers[0].suffix, LiteralSuffix::kU) << text;
    return input.list.numbers[0].integer;
  };
  EXPECT_EQ(character("'a'"), 97u);
  EXPECT_EQ(character("'\\n'"), 10u);
  EXPECT_EQ(character("'\\''"), 39u);
  EXPECT_EQ(character("'\"'"), 34u);
  EXPECT_EQ(character("'\\0'"), 0u);
  EXPECT_EQ(character("'\\x7f'"), 127u);
  EXPECT_EQ(character("'\\200'"), 0xFFFFFF80u);
  EXPECT_EQ(character("'\xE4'"), 0xFFFFFFE4u);
}

TEST(Lex, InfinityAsFxcWritesIt) {
  EXPECT_EQ(number("1.#INF").real, std::numeric_limits<double>::infinity());
  EXPECT_EQ(number("1.#INFf").suffix, LiteralSuffix::kF);
}

TEST(Lex, SwizzleOfANumberIsNoFraction) {
  EXPECT_EQ(Preprocessed("1.xxx 1.0.xxx 0.5f.rgb 1.x 2..y").text(),
            "1 . xxx 1.0 . xxx 0.5f . rgb 1 . x 2. . y");
  EXPECT_EQ(Preprocessed("1.e1 1.f").text(), "1.e1 1.f");
}

TEST(Lex, StringsResolveEscapesAndJoin) {
  Preprocessed input(R"("a\n\"\\" "\x41\101" x "y")");
  ASSERT_EQ(input.list.tokens.size(), 4u);
  EXPECT_EQ(input.list.tokens[0].text, "a\n\"\\AA");
  EXPECT_EQ(input.list.tokens[2].text, "y");
}

TEST(Lex, CommentsAreSpace) {
  EXPECT_EQ(Preprocessed("a/*x\n*/b // c\n/**/d//e").text(), "a b d");
  EXPECT_EQ(Preprocessed("a // b \\\n c\nd").text(), "a d");
}

TEST(Lex, LinesContinueBehindABackslash) {
  EXPECT_EQ(Preprocessed("ab\\\ncd 1\\\r\n2 \"x\\\ny\" <\\\n<=").text(), "abcd 12 \"xy\" <<=");
}

TEST(Lex, DosAndOldMacLineEnds) {
  Preprocessed dos("#define A 1\r\nA\r\n@");
  EXPECT_EQ(dos.text(), "1");
  EXPECT_EQ(dos.places(), std::vector<std::string>{"main.hlsl:3:1 KA2100"});
  Preprocessed mac("#define A 1\rA\r@");
  EXPECT_EQ(mac.text(), "1");
  EXPECT_EQ(mac.places(), std::vector<std::string>{"main.hlsl:3:1 KA2100"});
}

TEST(Lex, ByteOrderMarkIsNoText) {
  Preprocessed input("\xEF\xBB\xBF#define A 1\nA");
  EXPECT_EQ(input.rendered(), "");
  EXPECT_EQ(input.text(), "1");
  Preprocessed column("\xEF\xBB\xBF@");
  EXPECT_EQ(column.places(), std::vector<std::string>{"main.hlsl:1:1 KA2100"});
}

TEST(Lex, LastLineNeedsNoEnd) {
  EXPECT_EQ(Preprocessed("#define A 1\nA\n#undef A").text(), "1");
  EXPECT_EQ(Preprocessed("").list.tokens.size(), 1u);
  EXPECT_EQ(Preprocessed("\\").places(), std::vector<std::string>{"main.hlsl:1:1 KA2100"});
}

}  // namespace
}  // namespace kaamos::hlsl

// SPDX-License-Identifier: MIT
// Damaged sources: whatever the input, the preprocessor ends, and what it reports can be rendered.
#include <gtest/gtest.h>

#include <random>

#include "runtime/hlsl/front/preprocess_test_support.h"

namespace kaamos::hlsl {
namespace {

const char* const kSamples[] = {
    R"(#define MAX(a, b) ((a) > (b) ? (a) : (b))
#define CAT(a, b) a##b
#define XCAT(a, b) CAT(a, b)
#define LOG(fmt, ...) f(#fmt __VA_OPT__(,) __VA_ARGS__, ##__VA_ARGS__)
#if defined(MAX) && (__SHADER_TARGET_MAJOR * 10 + __SHADER_TARGET_MINOR >= 63 ? 1 : 0)
#include "a.h"
#elif __has_include(<b.h>)
#include "b.h"
#else
#error "no"
#endif
#pragma pack_matrix(row_major)
XCAT(foo, __LINE__) LOG(x, 1, MAX(2, 3)) LOG() MAX(MAX(1, 2), XCAT(MA, X)(4, 5))
)",
    R"([shader("raygeneration")] void Main() { /* c */
  float4 v = 1.0f.xxxx * 0x1Fu + .5e-3h; // end
  if (v.x <<= 2 >= 1.#INF) TraceRay(gScene, RAY_FLAG_NONE, ~0, 0, 0, 0, ray, payload);
  "a\x41\n" "b" 'c' a->b::c... \
}
#line 7 "x.hlsl"
#undef MAX
#pragma once
)",
    R"(#define f(a) a*g
#define g(a) f(a)
#define h g(~
#define t(a) a
#define r(x,y) x ## y
#define s(x) # x
f(2)(9) h 5) t(t(g)(0) + t)(1) r(1,r(2,3)) s(r("\"", 'x')) r(,) r(__COUNTER__, __FILE__)
#ifdef f
#ifndef g
#endif
#else
x
#endif
)"};

constexpr const char* kFragments[] = {"#",         "##",
                                      "(",         ")",
                                      ",",         "\\\n",
                                      "\"",        "'",
                                      "/*",        "\n#endif\n",
                                      "f(",        "\n#if ",
                                      "r(x,",      "g",
                                      "\n#else\n", "__VA_ARGS__",
                                      "...",       "\n#define f(",
                                      "0x",        "1e",
                                      "MAX(",      "\n#include \"a.h\"\n"};

std::string mutate(std::string text, std::mt19937& random) {
  auto below = [&](size_t limit) { return limit ? random() % limit : 0; };
  size_t count = 1 + below(6);
  for (size_t i = 0; i < count; ++i) {
    size_t at = below(text.size() + 1);
    size_t length = std::min(below(20), text.size() - at);
    switch (below(6)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(random());
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, kFragments[below(std::size(kFragments))]);
        break;
      case 3:
        text.insert(at, text.substr(below(text.size() + 1), below(60)));
        break;
      case 4:
        text.resize(at);
        break;
      default:
        text.insert(at, std::string(1, static_cast<char>(below(128))));
        break;
    }
  }
  return text;
}

TEST(Mutation, NeverCrashesNorHangs) {
  PreprocessOptions options;
  options.max_include_depth = 10;
  options.max_inclusions = 50;
  options.max_expansion_tokens = 5000;
  options.max_macro_depth = 50;
  std::mt19937 random(20240229);
  size_t errors = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string main = mutate(kSamples[random() % std::size(kSamples)], random);
    std::string header = mutate(kSamples[random() % std::size(kSamples)], random);
    Preprocessed input(main, {{"a.h", header}, {"b.h", "b"}}, options);
    ASSERT_TRUE(input.list.tokens.back().is(TokenKind::kEndOfFile)) << main;
    for (const Token& token : input.list.tokens) {
      if (input.sources.resolve(token.location).path.empty()) {
        ASSERT_TRUE(token.is(TokenKind::kEndOfFile)) << main;
      }
    }
    ASSERT_EQ(input.rendered().empty(), input.diagnostics.diagnostics().empty()) << main;
    errors += input.diagnostics.error_count();
  }
  EXPECT_GT(errors, 1000u);  // The mutations must reach the error paths.
}

}  // namespace
}  // namespace kaamos::hlsl

// SPDX-License-Identifier: MIT
// Real libraries, damaged at random: whatever comes out, the parser ends and its tree can be
// walked. Also measures how fast it is on the undamaged ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "runtime/hlsl/front/parse_test_support.h"

namespace kaamos::hlsl::test {
namespace {

std::vector<std::string> sample_paths() {
  std::vector<std::string> result;
  const std::filesystem::path folder =
      std::filesystem::path(KAAMOS_SOURCE_DIR) / "tests" / "hlsl" / "parse";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".hlsl") result.push_back(entry.path().string());
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ParseSamples, WholeLibrariesWithoutAMessage) {
  const std::vector<std::string> paths = sample_paths();
  ASSERT_GE(paths.size(), 4u);
  for (const std::string& path : paths) {
    const Parsed parsed(read(path));
    EXPECT_EQ(parsed.messages(), "") << path;
    EXPECT_GE(parsed.unit->declarations.size(), 5u) << path;
  }
}

// Drops, duplicates, swaps or replaces a run of tokens.
void mutate(std::vector<Token>& tokens, const std::vector<Token>& other, std::mt19937& random) {
  const auto below = [&](size_t n) { return static_cast<size_t>(random() % n); };
  const size_t count = tokens.size() - 1;  // Without the end of the file.
  if (count < 2) return;
  const size_t at = below(count);
  const size_t length = std::min<size_t>(1 + below(below(8) == 0 ? 200 : 3), count - at);
  const auto first = tokens.begin() + static_cast<std::ptrdiff_t>(at);
  const auto last = first + static_cast<std::ptrdiff_t>(length);
  switch (below(4)) {
    case 0:
      tokens.erase(first, last);
      break;
    case 1: {
      const std::vector<Token> copy(first, last);
      tokens.insert(tokens.begin() + static_cast<std::ptrdiff_t>(below(count)), copy.begin(),
                    copy.end());
      break;
    }
    case 2:
      std::swap(tokens[at], tokens[below(count)]);
      break;
    default:
      tokens[at] = other[below(other.size() - 1)];
      break;
  }
}

TEST(ParseMutation, DamagedLibrariesNeitherCrashNorHang) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::mt19937 random(20);
  size_t runs = 0;
  size_t with_errors = 0;
  std::vector<std::unique_ptr<Parsed>> samples;
  for (const std::string& path : sample_paths()) {
    samples.push_back(std::make_unique<Parsed>(read(path)));
  }
  ASSERT_FALSE(samples.empty());
  // Names are numbered per file, so tokens are only exchanged within a file.
  while (seconds() < 1.5) {
    const Parsed& sample = *samples[runs % samples.size()];
    TokenList damaged = sample.tokens;
    const size_t count = 1 + random() % 6;
    for (size_t i = 0; i < count; ++i) mutate(damaged.tokens, sample.tokens.tokens, random);
    AstArena arena;
    DiagnosticEngine diagnostics;
    const TranslationUnit* unit = parse(damaged, arena, diagnostics);
    ASSERT_NE(unit, nullptr);
    ASSERT_LT(dump(*unit).size(), size_t{100} << 20);
    with_errors += diagnostics.has_errors() ? 1 : 0;
    ++runs;
  }
  std::printf("%zu damaged libraries, %zu with errors, %.2f s\n", runs, with_errors, seconds());
  EXPECT_GT(with_errors, runs / 2);
}

TEST(ParseSpeed, TenThousandLinesInWellUnder200Milliseconds) {
  std::string text;
  size_t lines = 0;
  const std::vector<std::string> paths = sample_paths();
  for (size_t part = 0; lines < 10000; ++part) {
    const std::string one = read(paths[part % paths.size()]);
    text += "namespace part" + std::to_string(part) + " {\n" + one + "}\n";
    lines += static_cast<size_t>(std::count(one.begin(), one.end(), '\n')) + 2;
  }
  const Parsed parsed(text);
  EXPECT_EQ(parsed.messages(), "");
  double best_ms = 1e9;
  for (int run = 0; run < 5; ++run) {
    AstArena arena;
    DiagnosticEngine diagnostics;
    const auto start = std::chrono::steady_clock::now();
    parse(parsed.tokens, arena, diagnostics);
    const std::chrono::duration<double, std::milli> ms = std::chrono::steady_clock::now() - start;
    best_ms = std::min(best_ms, ms.count());
  }
  std::printf("parse: %zu lines, %zu tokens in %.1f ms\n", lines, parsed.tokens.tokens.size(),
              best_ms);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(KAAMOS_EMULATED)
  constexpr double kLimitMs = 4000.0;
#else
  constexpr double kLimitMs = 200.0;
#endif
  EXPECT_LT(best_ms, kLimitMs);
}

}  // namespace
}  // namespace kaamos::hlsl::test

// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/source.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/front/preprocess_test_support.h"

namespace kaamos::hlsl {
namespace {

namespace fs = std::filesystem;

class DiskTest : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(KAAMOS_BINARY_DIR) / "hlsl_lex_test" / test->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  void write(const std::string& path, std::string_view text) {
    fs::create_directories((folder_ / path).parent_path());
    std::ofstream(folder_ / path, std::ios::binary) << text;
  }
  std::string at(const std::string& path) { return (folder_ / path).generic_string(); }

  fs::path folder_;
};

TEST_F(DiskTest, FindsTheExactNameFirst) {
  write("a.h", "lower");
  write("A.h", "upper");
  DiskFileLoader loader;
  std::string error;
  EXPECT_EQ(loader.load(at("A.h"), &error)->text, "upper");
  EXPECT_EQ(loader.load(at("a.h"), &error)->text, "lower");
}

TEST_F(DiskTest, OtherCaseIsFoundInEachPartOfThePath) {
  write("Shaders/Common/Math.hlsli", "m");
  DiskFileLoader loader;
  std::string error;
  auto file = loader.load(at("shaders/COMMON/math.HLSLI"), &error);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->text, "m");
  EXPECT_EQ(file->path, at("Shaders/Common/Math.hlsli"));
  EXPECT_EQ(error, "");
}

TEST_F(DiskTest, MissingFileAndFolderAreNoErrors) {
  DiskFileLoader loader;
  std::string error;
  EXPECT_FALSE(loader.load(at("no/such.h"), &error));
  EXPECT_FALSE(loader.load(at(""), &error));
  EXPECT_EQ(error, "");
}

TEST_F(DiskTest, TooLargeFileIsAnError) {
  write("big.h", "");
  fs::resize_file(folder_ / "big.h", DiskFileLoader::kMaxBytes + 1);
  DiskFileLoader loader;
  std::string error;
  EXPECT_FALSE(loader.load(at("big.h"), &error));
  EXPECT_EQ(error, "the file has 67108865 bytes; at most 67108864 are allowed");
}

TEST(Disk, DeviceIsAnError) {
  DiskFileLoader loader;
  std::string error;
  EXPECT_FALSE(loader.load("/dev/zero", &error));
  EXPECT_EQ(error, "it is a device or a pipe, not a file");
}

TEST_F(DiskTest, PreprocessesFromDisk) {
  write("main.hlsl", "#include \"Inc\\A.hlsli\"\n#include \"inc/a.hlsli\"\n#include <b.hlsli>\n");
  write("inc/a.hlsli", "#pragma once\na\n");
  write("lib/b.hlsli", "b\n");
  DiskFileLoader loader;
  SourceManager sources(loader);
  DiagnosticEngine diagnostics;
  PreprocessOptions options;
  options.include_folders = {at("lib")};
  TokenList list = preprocess_file(at("main.hlsl"), options, sources, diagnostics);
  EXPECT_EQ(render_all(diagnostics, sources), "");
  ASSERT_EQ(list.tokens.size(), 3u);
  EXPECT_EQ(list.tokens[0].text, "a");
  EXPECT_EQ(list.tokens[1].text, "b");
  EXPECT_EQ(sources.loaded_paths(),
            (std::vector<std::string>{at("main.hlsl"), at("inc/a.hlsli"), at("lib/b.hlsli")}));
}

TEST(Path, Normalised) {
  EXPECT_EQ(normalize_path("a\\b/../c"), "a/c");
  EXPECT_EQ(normalize_path("./a"), "a");
  EXPECT_EQ(normalize_path("../a"), "../a");
  EXPECT_EQ(normalize_path(""), "");
}

TEST(Source, MacroTokensKnowTheirChain) {
  Preprocessed input("#define IN a\n#define OUT IN b\nx OUT");
  const auto& tokens = input.list.tokens;
  EXPECT_FALSE(tokens[0].location.is_macro());
  ASSERT_TRUE(tokens[1].location.is_macro());
  auto inner = input.sources.expansion_of(tokens[1].location);
  ASSERT_TRUE(inner);
  EXPECT_EQ(inner->macro, "IN");
  EXPECT_EQ(input.sources.resolve(inner->spelling).line, 1u);
  auto outer = input.sources.expansion_of(inner->invocation);
  ASSERT_TRUE(outer);
  EXPECT_EQ(outer->macro, "OUT");
  EXPECT_EQ(input.sources.resolve(outer->spelling).line, 2u);
  EXPECT_FALSE(input.sources.expansion_of(outer->invocation));
  EXPECT_EQ(input.sources.resolve(tokens[1].location).line, 3u);
  EXPECT_EQ(input.sources.resolve(tokens[1].location).column, 3u);
}

TEST(Source, EachInclusionHasItsOwnChain) {
  Preprocessed input("#include \"a.h\"\n#include \"a.h\"\n", {{"a.h", "a"}});
  const auto& tokens = input.list.tokens;
  EXPECT_NE(tokens[0].location, tokens[1].location);
  auto from = [&](size_t i) {
    return input.sources.resolve(input.sources.include_location(tokens[i].location)).line;
  };
  EXPECT_EQ(from(0), 1u);
  EXPECT_EQ(from(1), 2u);
}

TEST(Source, NoLocationResolvesToNothing) {
  MemoryFileLoader loader;
  SourceManager sources(loader);
  EXPECT_EQ(sources.resolve({}).line, 0u);
  EXPECT_EQ(sources.line_text({}), "");
  EXPECT_FALSE(sources.include_location({}).is_valid());
  EXPECT_EQ(SourceLocation{}.advanced(3), SourceLocation{});
}

}  // namespace
}  // namespace kaamos::hlsl

// SPDX-License-Identifier: MIT
#include "runtime/coverage/tracefile.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace kaamos::coverage {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

class TracefileTest : public testing::Test {
 protected:
  TracefileTest() {
    std::string name = fs::temp_directory_path() / "kaamos-coverage-XXXXXX";
    folder_ = mkdtemp(name.data());
    path_ = folder_ / "shaders.info";
  }
  ~TracefileTest() override { fs::remove_all(folder_); }

  fs::path folder_;
  fs::path path_;
};

Tracefile sample() {
  Tracefile out;
  FileCoverage& file = out["/a.hlsl"];
  file.lines = {{3, 1}, {4, 0}, {7, 1}};
  file.arms = {{{3, 5, 0}, 1}, {{3, 5, 1}, 0}, {{7, 3, 0}, 0}, {{7, 3, 1}, 0}};
  return out;
}

constexpr char kSample[] =
    "TN:\nSF:/a.hlsl\n"
    "BRDA:3,5,0,1\nBRDA:3,5,1,0\nBRDA:7,3,0,-\nBRDA:7,3,1,-\nBRF:4\nBRH:1\n"
    "DA:3,1\nDA:4,0\nDA:7,1\nLF:3\nLH:2\nend_of_record\n";

TEST_F(TracefileTest, IsWrittenAsLcovDoes) {
  EXPECT_EQ(to_text(sample()), kSample);
}

TEST_F(TracefileTest, IsReadAgain) {
  size_t line = 0;
  const auto read = parse_tracefile(kSample, line);
  ASSERT_TRUE(read) << line;
  EXPECT_EQ(to_text(*read), kSample);
}

TEST_F(TracefileTest, RunsAddUp) {
  EXPECT_EQ(add_to_file(path_, sample()), "");
  Tracefile second;
  second["/a.hlsl"].lines = {{4, 1}, {7, 1}};
  second["/a.hlsl"].arms = {{{7, 3, 1}, 1}};
  second["/b.hlsl"].lines = {{1, 0}};
  EXPECT_EQ(add_to_file(path_, second), "");
  EXPECT_EQ(read(path_),
            "TN:\nSF:/a.hlsl\n"
            "BRDA:3,5,0,1\nBRDA:3,5,1,0\nBRDA:7,3,0,0\nBRDA:7,3,1,1\nBRF:4\nBRH:2\n"
            "DA:3,1\nDA:4,1\nDA:7,2\nLF:3\nLH:3\nend_of_record\n"
            "TN:\nSF:/b.hlsl\nBRF:0\nBRH:0\nDA:1,0\nLF:1\nLH:0\nend_of_record\n");
}

TEST_F(TracefileTest, RecordsOfOthersStay) {
  write(path_, "TN:cpp\nSF:/a.cpp\nFN:1,main\nFNDA:1,main\nDA:1,1\nLF:1\nLH:1\nend_of_record\n");
  EXPECT_EQ(add_to_file(path_, sample()), "");
  EXPECT_EQ(read(path_),
            "TN:\nSF:/a.cpp\nFN:1,main\nFNDA:1,main\nBRF:0\nBRH:0\nDA:1,1\nLF:1\nLH:1\n"
            "end_of_record\n" +
                std::string(kSample));
}

TEST_F(TracefileTest, WhatIsNoTracefileIsLeftAlone) {
  for (const char* text : {"int main() {}\n", "SF:/a\nDA:x\nend_of_record\n", "SF:/a\nDA:1,1\n",
                           "end_of_record\n", "SF:/a\nSF:/b\nend_of_record\n"}) {
    write(path_, text);
    EXPECT_NE(add_to_file(path_, sample()), "") << text;
    EXPECT_EQ(read(path_), text);
  }
  write(path_, "TN:\nSF:/a\nDA:oh,1\nend_of_record\n");
  EXPECT_EQ(add_to_file(path_, sample()), "line 3 of it is not of an LCOV tracefile");
}

TEST_F(TracefileTest, AFolderThatIsNotThereIsNamed) {
  EXPECT_EQ(add_to_file(folder_ / "no" / "a.info", sample()),
            "its folder cannot be opened: No such file or directory");
}

TEST_F(TracefileTest, ProcessesAtATimeLoseNothing) {
  constexpr int kProcesses = 8;
  constexpr int kTimes = 10;
  for (int i = 0; i < kProcesses; ++i) {
    if (fork() != 0) continue;
    Tracefile own;
    own["/a.hlsl"].lines = {{1, 1}, {static_cast<uint32_t>(10 + i), 1}};
    bool ok = true;
    for (int k = 0; k < kTimes; ++k) ok = add_to_file(path_, own).empty() && ok;
    _exit(ok ? 0 : 1);
  }
  for (int i = 0; i < kProcesses; ++i) {
    int status = 0;
    wait(&status);
    EXPECT_EQ(status, 0);
  }
  size_t line = 0;
  const auto all = parse_tracefile(read(path_), line);
  ASSERT_TRUE(all) << line;
  EXPECT_EQ(all->at("/a.hlsl").lines.at(1), uint64_t{kProcesses * kTimes});
  EXPECT_EQ(all->at("/a.hlsl").lines.size(), size_t{kProcesses + 1});
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);  // nothing is left behind
}

}  // namespace
}  // namespace kaamos::coverage

// SPDX-License-Identifier: MIT
#include "effects/assets/common/file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

namespace kaamos::effects {
namespace {

class FileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("kaamos-file-test-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_),
                                                  std::filesystem::directory_iterator()));
  }

  std::filesystem::path folder_;
};

std::vector<std::uint8_t> bytes(const std::string& text) {
  return {text.begin(), text.end()};
}

TEST_F(FileTest, WhatIsWrittenIsRead) {
  ASSERT_TRUE(write_file(path("a"), bytes("hello")).ok());
  const auto read = read_file(path("a"));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value(), bytes("hello"));
  EXPECT_EQ(files(), 1u) << "no temporary file is left";
}

TEST_F(FileTest, ReplacesAnEarlierFile) {
  ASSERT_TRUE(write_file(path("a"), bytes("first, longer")).ok());
  ASSERT_TRUE(write_file(path("a"), bytes("second")).ok());
  EXPECT_EQ(read_file(path("a")).value(), bytes("second"));
}

TEST_F(FileTest, AFailedWriteLeavesNothingBehind) {
  // Renaming over a folder fails after the bytes have been written.
  std::filesystem::create_directories(folder_ / "taken" / "inside");
  const Status status = write_file(path("taken"), bytes("x"));
  EXPECT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("taken"), std::string::npos) << status.error().message;
  EXPECT_EQ(files(), 1u);
}

TEST_F(FileTest, AWriteThatEndsHalfWayKeepsTheEarlierFile) {
  ASSERT_TRUE(write_file(path("a"), bytes("earlier")).ok());
  // A limit on the file size makes the write fail half-way, as a full disk does.
  rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 1000;
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const Status status = write_file(path("a"), std::vector<std::uint8_t>(5000, 7));
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find(path("a")), std::string::npos) << status.error().message;
  EXPECT_EQ(read_file(path("a")).value(), bytes("earlier"));
  EXPECT_EQ(files(), 1u) << "no temporary file is left";
}

TEST_F(FileTest, MissingFolderAndMissingFileAreNamed) {
  const Status write = write_file(path("no/such/folder"), bytes("x"));
  EXPECT_NE(write.error().message.find("no/such/folder"), std::string::npos)
      << write.error().message;
  const auto read = read_file(path("missing"));
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("missing"), std::string::npos) << read.error().message;
  EXPECT_NE(read.error().message.find("No such file"), std::string::npos) << read.error().message;
}

TEST_F(FileTest, FoldersAndTooLargeFilesAreRefused) {
  EXPECT_FALSE(read_file(folder_.string()).ok());
  EXPECT_FALSE(read_file("/dev/zero").ok());
  ASSERT_TRUE(write_file(path("a"), bytes("0123456789")).ok());
  EXPECT_FALSE(read_file(path("a"), 9).ok());
  EXPECT_TRUE(read_file(path("a"), 10).ok());
}

}  // namespace
}  // namespace kaamos::effects

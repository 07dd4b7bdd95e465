// SPDX-License-Identifier: MIT
#include "runtime/files/write_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>
#include <vector>

namespace kaamos::files {
namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

mode_t permissions(const fs::path& path) {
  struct stat info = {};
  return stat(path.c_str(), &info) == 0 ? info.st_mode & 07777 : 0;
}

class WriteFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "write_file-XXXXXX";
    ASSERT_NE(mkdtemp(folder_.data()), nullptr);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const char* name) const { return folder_ + "/" + name; }
  size_t files() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }
  std::string folder_;
};

TEST_F(WriteFile, WritesAndReplaces) {
  EXPECT_EQ(write_file(path("a"), "first, which is longer"), 0);
  EXPECT_EQ(write_file(path("a"), "second"), 0);
  EXPECT_EQ(contents(path("a")), "second");
  EXPECT_EQ(write_file(path("a"), ""), 0);
  EXPECT_EQ(contents(path("a")), "");
  EXPECT_EQ(files(), 1u);
}

TEST_F(WriteFile, NewFilesHaveThePermissionsOfTheMask) {
  const mode_t mask = umask(027);
  EXPECT_EQ(write_file(path("a"), "x"), 0);
  umask(mask);
  EXPECT_EQ(permissions(path("a")), 0640u);
}

TEST_F(WriteFile, PermissionsAreKept) {
  ASSERT_EQ(write_file(path("a"), "x"), 0);
  ASSERT_EQ(chmod(path("a").c_str(), 0751), 0);
  EXPECT_EQ(write_file(path("a"), "y"), 0);
  EXPECT_EQ(permissions(path("a")), 0751u);
  ASSERT_EQ(write_file(path("b"), "z"), 0);
  EXPECT_EQ(place_file(path("b"), path("a")), 0);
  EXPECT_EQ(contents(path("a")), "z");
  EXPECT_EQ(permissions(path("a")), 0751u);
  EXPECT_EQ(files(), 1u);
}

TEST_F(WriteFile, LinksStayAndTheirTargetsAreReplaced) {
  fs::create_directory(path("other"));
  ASSERT_EQ(write_file(path("other/target"), "old"), 0);
  fs::create_symlink("other/target", path("link"));
  fs::create_symlink(path("link"), path("link_to_link"));
  EXPECT_EQ(write_file(path("link_to_link"), "new"), 0);
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_TRUE(fs::is_symlink(path("link_to_link")));
  EXPECT_EQ(contents(path("other/target")), "new");
  // A target that does not exist yet is made where the link points.
  fs::create_symlink("other/absent", path("dangling"));
  EXPECT_EQ(write_file(path("dangling"), "made"), 0);
  EXPECT_EQ(contents(path("other/absent")), "made");
  EXPECT_TRUE(fs::is_symlink(path("dangling")));
  fs::create_symlink("circle", path("circle"));
  EXPECT_EQ(write_file(path("circle"), "x"), ELOOP);
}

TEST_F(WriteFile, DevicesAndPipesAreWrittenTo) {
  // A node of its own for the null device, where that may be made: a fault must not harm the
  // machine.
  if (mknod(path("null").c_str(), S_IFCHR | 0666, makedev(1, 3)) == 0) {
    const int status = write_file(path("null"), "x");
    EXPECT_TRUE(status == 0 || status == EACCES) << status;  // a disk that has no devices
    EXPECT_TRUE(fs::is_character_file(path("null")));
  }
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = contents(path("pipe")); });
  EXPECT_EQ(write_file(path("pipe"), "through the pipe"), 0);
  reader.join();
  EXPECT_EQ(received, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

TEST_F(WriteFile, AFileThatIsOpenIsWrittenToByItsDescriptor) {
  const int open_file = open(path("a").c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_GE(open_file, 0);
  EXPECT_EQ(write_file("/proc/self/fd/" + std::to_string(open_file), "seen"), 0);
  char text[8] = {};
  EXPECT_EQ(pread(open_file, text, 7, 0), 4);  // the same file, not one in its place
  close(open_file);
  EXPECT_EQ(std::string(text), "seen");
}

TEST_F(WriteFile, WhatCannotBeWrittenSaysWhyAndStays) {
  EXPECT_EQ(write_file(path("absent/a"), "x"), ENOENT);
  EXPECT_EQ(write_file(folder_, "x"), EISDIR);
  ASSERT_EQ(write_file(path("a"), "old"), 0);
  EXPECT_EQ(write_file(path("a/b"), "x"), ENOTDIR);
  EXPECT_EQ(place_file(path("absent"), path("a")), ENOENT);
  EXPECT_EQ(contents(path("a")), "old");
  EXPECT_EQ(write_file(std::string(300, 'n'), "x"), ENAMETOOLONG);
}

// Runs in a process of its own, which becomes nobody if it is root. Returns the exit status.
int as_nobody(int (*body)(const std::string& folder), const std::string& folder) {
  const pid_t child = fork();
  if (child == 0) {
    if (getuid() == 0 && setuid(65534) != 0) _exit(99);
    _exit(body(folder));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 100;
}

TEST_F(WriteFile, AFileThatMayNotBeWrittenIsNotReplaced) {
  ASSERT_EQ(write_file(path("a"), "old"), 0);
  ASSERT_EQ(chmod(path("a").c_str(), 0444), 0);
  ASSERT_EQ(chmod(folder_.c_str(), 0777), 0);
  EXPECT_EQ(as_nobody([](const std::string& f) { return write_file(f + "/a", "new"); }, folder_),
            EACCES);
  EXPECT_EQ(contents(path("a")), "old");
}

TEST_F(WriteFile, AFolderThatTakesNoNewFilesKeepsTheFile) {
  ASSERT_EQ(write_file(path("a"), "old and longer"), 0);
  ASSERT_EQ(chmod(path("a").c_str(), 0666), 0);
  ASSERT_EQ(chmod(folder_.c_str(), 0555), 0);
  EXPECT_EQ(as_nobody([](const std::string& f) { return write_file(f + "/a", "new"); }, folder_),
            0);
  EXPECT_EQ(contents(path("a")), "new");
  chmod(folder_.c_str(), 0755);
}

// The limit on a file's size stops a write as a full disk does.
TEST_F(WriteFile, AFullDiskLeavesTheOldFile) {
  ASSERT_EQ(write_file(path("a"), "old"), 0);
  const int status = as_nobody(
      [](const std::string& f) {
        signal(SIGXFSZ, SIG_IGN);
        const rlimit limit = {1000, 1000};
        if (setrlimit(RLIMIT_FSIZE, &limit) != 0) return 98;
        return write_file(f + "/a", std::string(5000, 'x'));
      },
      (chmod(folder_.c_str(), 0777), chmod(path("a").c_str(), 0666), folder_));
  EXPECT_EQ(status, EFBIG);
  EXPECT_EQ(contents(path("a")), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(WriteFile, ManyWritersLeaveOneWholeFile) {
  std::vector<std::thread> writers;
  for (char letter = 'a'; letter < 'i'; ++letter) {
    writers.emplace_back([this, letter] {
      for (int i = 0; i < 20; ++i)
        EXPECT_EQ(write_file(path("file"), std::string(100'000, letter)), 0);
    });
  }
  for (std::thread& writer : writers) writer.join();
  const std::string text = contents(path("file"));
  EXPECT_EQ(text, std::string(100'000, text.empty() ? '?' : text[0]));
  EXPECT_EQ(files(), 1u);
}

}  // namespace
}  // namespace kaamos::files

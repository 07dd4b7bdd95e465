// SPDX-License-Identifier: MIT
#include "runtime/coverage/collector.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "runtime/coverage/tracefile.h"

namespace kaamos::coverage {
namespace {

namespace fs = std::filesystem;

// A library of two files: one of three lines, and one that nobody has.
struct Library {
  const char* files[3];
  shader::CoveragePoint points[5] = {
      {0, 1, 0, 0}, {0, 3, 0, 0}, {0, 4, 0, 0}, {1, 9, 0, 0}, {2, 9, 0, 0}};
  uint8_t ran[5] = {};
  shader::LibraryDesc desc = {};
  shader::CoverageDesc table = {files, 3, points, 5, ran};
};

class CollectorTest : public testing::Test {
 protected:
  CollectorTest() {
    std::string name = fs::temp_directory_path() / "kaamos-coverage-XXXXXX";
    folder_ = mkdtemp(name.data());
    path_ = folder_ / "shaders.info";
    source_ = folder_ / "a.hlsl";
    std::ofstream(source_) << "1\n2\n3\n";
    library_.files[0] = source_.c_str();
    library_.files[1] = "no/such.hlsl";
    library_.files[2] = "./kaamos/own.hlsli";
  }
  ~CollectorTest() override { fs::remove_all(folder_); }

  // The collector is the process's, so each case is one.
  void in_process(const std::function<void()>& run) {
    if (const pid_t child = fork(); child != 0) {
      int status = 0;
      waitpid(child, &status, 0);
      EXPECT_EQ(status, 0);
      return;
    }
    setenv("KAAMOS_COVERAGE", path_.c_str(), 1);
    run();
    std::exit(HasFailure() ? 1 : 0);
  }

  std::string text() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string expected(const std::string& first, const std::string& second,
                       const std::string& other, int hit) const {
    return "TN:\nSF:" + source_.string() + "\nBRF:0\nBRH:0\nDA:1," + first + "\nDA:3," + second +
           "\nLF:2\nLH:" + std::to_string(hit) + "\nend_of_record\n" +
           "TN:\nSF:no/such.hlsl\nBRF:0\nBRH:0\nDA:9," + other +
           "\nLF:1\nLH:" + (other == "0" ? "0" : "1") + "\nend_of_record\n";
  }

  fs::path folder_;
  fs::path path_;
  fs::path source_;
  Library library_;
};

TEST_F(CollectorTest, AProcessCountsOnceHoweverOftenItWrites) {
  in_process([&] {
    const auto held = collect(library_.desc, library_.table, nullptr);
    EXPECT_EQ(table_of(library_.desc), &library_.table);
    EXPECT_EQ(write(), "");
    EXPECT_EQ(text(), expected("0", "0", "0", 0));
    shader::cover(library_.ran[1]);
    EXPECT_EQ(write(), "");
    EXPECT_EQ(write(), "");
    EXPECT_EQ(text(), expected("0", "1", "0", 1));
    shader::cover(library_.ran[3]);  // written at exit
  });
  EXPECT_EQ(text(), expected("0", "1", "1", 1));
  in_process([&] {
    shader::cover(library_.ran[0]);
    shader::cover(library_.ran[1]);
    // Taken over when the library ends.
    collect(library_.desc, library_.table, nullptr);
    EXPECT_EQ(table_of(library_.desc), nullptr);
  });
  EXPECT_EQ(text(), expected("1", "2", "1", 2));
}

TEST_F(CollectorTest, AFileThatCannotBeWrittenIsToldOnce) {
  path_ = folder_ / "no" / "a.info";
  in_process([&] {
    EXPECT_NE(begin().find(path_.string() + "\" of $KAAMOS_COVERAGE: its folder cannot be opened"),
              std::string::npos);
    EXPECT_EQ(begin(), "");
  });
}

TEST_F(CollectorTest, AReaderBringsWhatRanElsewhere) {
  struct Other : Reader {
    void read(const shader::CoverageDesc& table, bool) override { shader::cover(table.ran[0]); }
  };
  in_process([&] {
    const auto held = collect(library_.desc, library_.table, nullptr);
    Other other;
    add_reader(other);
    EXPECT_EQ(write(), "");
    remove_reader(other);
  });
  EXPECT_EQ(text(), expected("1", "0", "0", 1));
}

}  // namespace
}  // namespace kaamos::coverage

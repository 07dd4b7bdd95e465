// SPDX-License-Identifier: MIT
#include <kaamos_crt.h>
#include <shlwapi.h>
#include <windows.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace kaamos::d3d12 {
namespace {

namespace fs = std::filesystem;

// A folder that is gone when the test ends.
class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("kaamos_win32_" + std::to_string(GetCurrentProcessId()));
    ASSERT_TRUE(CreateDirectoryA(folder_.c_str(), nullptr));
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const char* name) const { return folder_.string() + "\\" + name; }

  fs::path folder_;
};

TEST_F(FileTest, WritesAndReadsThroughABackslashPath) {
  HANDLE file = CreateFileA(path("a.bin").c_str(), GENERIC_WRITE, 0, nullptr, CREATE_ALWAYS,
                            FILE_ATTRIBUTE_NORMAL, nullptr);
  ASSERT_NE(file, INVALID_HANDLE_VALUE);
  DWORD moved = 0;
  EXPECT_TRUE(WriteFile(file, "12345", 5, &moved, nullptr));
  EXPECT_EQ(moved, 5u);
  EXPECT_TRUE(CloseHandle(file));
  EXPECT_TRUE(fs::exists(folder_ / "a.bin"));

  const std::wstring wide = fs::path(path("a.bin")).wstring();
  CREATEFILE2_EXTENDED_PARAMETERS parameters = {};
  parameters.dwSize = sizeof(parameters);
  file = CreateFile2(wide.c_str(), GENERIC_READ, FILE_SHARE_READ, OPEN_EXISTING, &parameters);
  ASSERT_NE(file, INVALID_HANDLE_VALUE);
  FILE_STANDARD_INFO info = {};
  EXPECT_TRUE(GetFileInformationByHandleEx(file, FileStandardInfo, &info, sizeof(info)));
  EXPECT_EQ(info.EndOfFile.QuadPart, 5);
  LARGE_INTEGER distance = {};
  distance.QuadPart = 3;
  EXPECT_TRUE(SetFilePointerEx(file, distance, nullptr, FILE_BEGIN));
  char bytes[8] = {};
  EXPECT_TRUE(ReadFile(file, bytes, 8, &moved, nullptr));
  EXPECT_EQ(moved, 2u);
  EXPECT_STREQ(bytes, "45");
  CloseHandle(file);
}

TEST_F(FileTest, WhatIsNotThereIsAnErrorCode) {
  EXPECT_EQ(CreateFileA(path("none").c_str(), GENERIC_READ, 0, nullptr, OPEN_EXISTING, 0, nullptr),
            INVALID_HANDLE_VALUE);
  EXPECT_EQ(GetLastError(), ERROR_FILE_NOT_FOUND);
  EXPECT_EQ(GetFileAttributesA(path("none").c_str()), INVALID_FILE_ATTRIBUTES);
  EXPECT_NE(GetFileAttributesA(folder_.c_str()) & FILE_ATTRIBUTE_DIRECTORY, 0u);
  FILE* opened = nullptr;
  EXPECT_NE(fopen_s(&opened, path("none").c_str(), "rb"), 0);
  EXPECT_EQ(opened, nullptr);
}

TEST_F(FileTest, CodesSayWhatProgramsBranchOn) {
  const auto create = [&](const char* name, DWORD disposition) {
    const HANDLE file =
        CreateFileA(path(name).c_str(), GENERIC_WRITE, 0, nullptr, disposition, 0, nullptr);
    const DWORD code = GetLastError();
    if (file != INVALID_HANDLE_VALUE) CloseHandle(file);
    return std::pair(file != INVALID_HANDLE_VALUE, code);
  };
  EXPECT_EQ(create("new", CREATE_NEW).first, true);
  EXPECT_EQ(create("new", CREATE_NEW), std::pair(false, DWORD{ERROR_FILE_EXISTS}));
  EXPECT_EQ(create("new", CREATE_ALWAYS), std::pair(true, DWORD{ERROR_ALREADY_EXISTS}));
  EXPECT_EQ(create("other", OPEN_ALWAYS), std::pair(true, DWORD{ERROR_SUCCESS}));
  EXPECT_EQ(create("none\\new", CREATE_NEW), std::pair(false, DWORD{ERROR_PATH_NOT_FOUND}));
  EXPECT_EQ(create("", OPEN_EXISTING), std::pair(false, DWORD{ERROR_ACCESS_DENIED}));
  EXPECT_FALSE(CreateDirectoryA(path("x\\y").c_str(), nullptr));
  EXPECT_EQ(GetLastError(), ERROR_PATH_NOT_FOUND);
  EXPECT_TRUE(CreateDirectoryA(path("x").c_str(), nullptr));
  EXPECT_FALSE(CreateDirectoryA(path("x").c_str(), nullptr));
  EXPECT_EQ(GetLastError(), ERROR_ALREADY_EXISTS);
}

TEST_F(FileTest, FopenTakesBackslashes) {
  FILE* file = nullptr;
  ASSERT_EQ(fopen_s(&file, path("b.txt").c_str(), "wt"), 0);
  fclose(file);
  EXPECT_TRUE(fs::exists(folder_ / "b.txt"));
  EXPECT_EQ(fopen_s(&file, path("none").c_str(), "r"), ENOENT);
  EXPECT_EQ(file, nullptr);
}

TEST(File, PathsExistOrNot) {
  EXPECT_TRUE(PathFileExistsA("/"));
  EXPECT_TRUE(PathFileExistsW(L"\\"));
  EXPECT_FALSE(PathFileExistsA("/no/such/file"));
}

}  // namespace
}  // namespace kaamos::d3d12

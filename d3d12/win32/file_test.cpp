// SPDX-License-Identifier: MIT
#include <kaamos_crt.h>
#include <kaamos_stream_path.h>
#include <shlwapi.h>
#include <windows.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "d3d12/com/report_fixture.h"

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

TEST_F(FileTest, APatternFindsNamesInOrder) {
  for (const char* name : {"b.hlsl", "A.HLSL", "c.txt"}) std::ofstream(folder_ / name) << "1234";
  WIN32_FIND_DATAA data = {};
  const HANDLE search = FindFirstFileA(path("*.hlsl").c_str(), &data);
  ASSERT_NE(search, INVALID_HANDLE_VALUE);
  EXPECT_STREQ(data.cFileName, "A.HLSL");
  EXPECT_EQ(data.nFileSizeLow, 4u);
  EXPECT_EQ(data.dwFileAttributes, DWORD{FILE_ATTRIBUTE_NORMAL});
  EXPECT_TRUE(FindNextFileA(search, &data));
  EXPECT_STREQ(data.cFileName, "b.hlsl");
  EXPECT_FALSE(FindNextFileA(search, &data));
  EXPECT_EQ(GetLastError(), ERROR_NO_MORE_FILES);
  EXPECT_TRUE(FindClose(search));

  WIN32_FIND_DATAW wide = {};
  const HANDLE one = FindFirstFileExW(fs::path(path("c.txt")).wstring().c_str(), FindExInfoBasic,
                                      &wide, FindExSearchNameMatch, nullptr, 0);
  ASSERT_NE(one, INVALID_HANDLE_VALUE);
  EXPECT_STREQ(wide.cFileName, L"c.txt");
  EXPECT_TRUE(FindClose(one));
  EXPECT_EQ(FindFirstFileA(path("d*").c_str(), &data), INVALID_HANDLE_VALUE);
  EXPECT_EQ(GetLastError(), ERROR_FILE_NOT_FOUND);
  EXPECT_EQ(FindFirstFileA(path("none\\*").c_str(), &data), INVALID_HANDLE_VALUE);
  EXPECT_EQ(GetLastError(), ERROR_PATH_NOT_FOUND);
}

TEST_F(FileTest, AMappedFileGrowsAndKeepsWhatIsWritten) {
  const HANDLE file = CreateFileA(path("map").c_str(), GENERIC_READ | GENERIC_WRITE, 0, nullptr,
                                  CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
  ASSERT_NE(file, INVALID_HANDLE_VALUE);
  EXPECT_EQ(CreateFileMapping(file, nullptr, PAGE_READWRITE, 0, 0, nullptr), nullptr);
  EXPECT_EQ(GetLastError(), ERROR_FILE_INVALID);
  const HANDLE mapping = CreateFileMapping(file, nullptr, PAGE_READWRITE, 0, 100, nullptr);
  ASSERT_NE(mapping, nullptr);
  EXPECT_TRUE(CloseHandle(file));
  auto* bytes = static_cast<char*>(MapViewOfFile(mapping, FILE_MAP_ALL_ACCESS, 0, 0, 0));
  ASSERT_NE(bytes, nullptr);
  EXPECT_TRUE(CloseHandle(mapping));  // the view lives on
  bytes[99] = 'x';
  EXPECT_TRUE(FlushViewOfFile(bytes, 0));
  EXPECT_TRUE(UnmapViewOfFile(bytes));
  EXPECT_EQ(fs::file_size(folder_ / "map"), 100u);
  std::ifstream in(folder_ / "map");
  EXPECT_EQ(in.seekg(99).get(), 'x');
  const Quiet quiet;
  EXPECT_FALSE(UnmapViewOfFile(bytes));
  EXPECT_EQ(GetLastError(), ERROR_INVALID_ADDRESS);
}

TEST_F(FileTest, AViewIsNoLargerAndNoMoreThanItsMapping) {
  const HANDLE memory =
      CreateFileMapping(INVALID_HANDLE_VALUE, nullptr, PAGE_READWRITE, 0, 70000, nullptr);
  ASSERT_NE(memory, nullptr);
  EXPECT_EQ(MapViewOfFile(memory, FILE_MAP_READ, 0, 0, 70001), nullptr);
  EXPECT_EQ(MapViewOfFile(memory, FILE_MAP_READ, 0, 4096, 0), nullptr);
  auto* all = static_cast<char*>(MapViewOfFile(memory, FILE_MAP_WRITE, 0, 0, 0));
  auto* end = static_cast<char*>(MapViewOfFile(memory, FILE_MAP_READ, 0, 65536, 0));
  ASSERT_TRUE(all != nullptr && end != nullptr);
  all[65536 + 7] = 'y';
  EXPECT_EQ(end[7], 'y');
  EXPECT_TRUE(UnmapViewOfFile(all));
  EXPECT_TRUE(UnmapViewOfFile(end));
  CloseHandle(memory);

  std::ofstream(folder_ / "r") << "read";
  const HANDLE file = CreateFileA(path("r").c_str(), GENERIC_READ, 0, nullptr, OPEN_EXISTING,
                                  FILE_ATTRIBUTE_NORMAL, nullptr);
  const HANDLE reads = CreateFileMapping(file, nullptr, PAGE_READONLY, 0, 0, nullptr);
  EXPECT_EQ(MapViewOfFile(reads, FILE_MAP_ALL_ACCESS, 0, 0, 0), nullptr);
  EXPECT_EQ(GetLastError(), DWORD{ERROR_ACCESS_DENIED});
  CloseHandle(reads);
  CloseHandle(file);
}

TEST_F(FileTest, AMissingNameIsToldOnce) {
  std::vector<std::string> told;
  const uint64_t sink =
      process_reporter().add_sink([&](D3D12_MESSAGE_SEVERITY severity, const rtapi::Error& error) {
        EXPECT_EQ(severity, D3D12_MESSAGE_SEVERITY_WARNING);
        told.push_back(error.message);
      });
  for (int i = 0; i < 2; ++i) {
    CreateFileA(path("gone").c_str(), GENERIC_READ, 0, nullptr, OPEN_EXISTING, 0, nullptr);
    LoadLibraryA("gone.dll");
    EXPECT_STREQ(kaamos_input_path(std::wstring(L"no\\where").c_str()), "no/where");
  }
  process_reporter().remove_sink(sink);
  ASSERT_EQ(told.size(), 3u);
  EXPECT_NE(told[0].find("KA4043"), std::string::npos) << told[0];
  EXPECT_NE(told[0].find(folder_.string() + "/gone"), std::string::npos) << told[0];
  EXPECT_NE(told[1].find("gone.dll"), std::string::npos) << told[1];
  EXPECT_NE(told[2].find("no/where"), std::string::npos) << told[2];
}

TEST(File, StandardHandlesAreTheStreams) {
  const HANDLE out = GetStdHandle(STD_OUTPUT_HANDLE);
  EXPECT_EQ(out, GetStdHandle(STD_OUTPUT_HANDLE));
  EXPECT_NE(out, GetStdHandle(STD_ERROR_HANDLE));
  DWORD written = 1;
  EXPECT_TRUE(WriteFile(out, "", 0, &written, nullptr));
  EXPECT_EQ(written, 0u);
  const Quiet quiet;
  EXPECT_EQ(GetStdHandle(7), INVALID_HANDLE_VALUE);
}

TEST(File, PagesAreZerosAtMultiplesOf64KiB) {
  auto* bytes = static_cast<unsigned char*>(
      VirtualAlloc(nullptr, 5000, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE));
  ASSERT_NE(bytes, nullptr);
  EXPECT_EQ(reinterpret_cast<uintptr_t>(bytes) % 65536, 0u);
  EXPECT_EQ(std::count(bytes, bytes + 5000, 0), 5000);
  EXPECT_TRUE(VirtualFree(bytes, 0, MEM_RELEASE));
}

TEST(File, PartsOfPathsAreFoundInAnyCase) {
  const wchar_t* text = L"a/Kaamos.DLL";
  EXPECT_EQ(StrStrIW(text, L"kaamos"), text + 2);
  EXPECT_EQ(StrStrIW(text, L"dll"), text + 9);
  EXPECT_EQ(StrStrIW(text, L"dlls"), nullptr);
  EXPECT_STREQ(StrStrIA("a/B", "/b"), "/B");
  EXPECT_EQ(StrStrIA("a/B", "c"), nullptr);
}

TEST(File, PathsExistOrNot) {
  EXPECT_TRUE(PathFileExistsA("/"));
  EXPECT_TRUE(PathFileExistsW(L"\\"));
  EXPECT_FALSE(PathFileExistsA("/no/such/file"));
}

}  // namespace
}  // namespace kaamos::d3d12

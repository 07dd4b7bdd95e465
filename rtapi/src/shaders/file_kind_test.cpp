// SPDX-License-Identifier: MIT
//
// Tests what KA0910 says about files that are no shader libraries.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include <rtapi/shader_library.h>

#include "rtapi/testing/expect_error.h"

namespace rtapi {
namespace {

std::string elf(unsigned char elf_class, unsigned char type, unsigned char machine) {
  std::string head(
      "\x7F"
      "ELF",
      4);
  head.resize(64, '\0');
  head[4] = static_cast<char>(elf_class);
  head[16] = static_cast<char>(type);
  head[18] = static_cast<char>(machine);
  return head;
}

class FileKind : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(::testing::TempDir()) / (std::string("kind_") + info->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void expect(const std::string& content, const char* kind) {
    const std::string path = (folder_ / "library.so").string();
    std::ofstream(path, std::ios::binary) << content;
    EXPECT_ERROR(LoadShaderLibraryFromFile(path), "KA0910", std::string("is ") + kind);
  }

  std::filesystem::path folder_;
};

TEST_F(FileKind, NamesWhatItGot) {
  expect("DXBC and more", "a DXIL container, which dxc makes for Direct3D drivers");
  expect(std::string("\x03\x02\x23\x07\x00\x06\x01\x00", 8), "SPIR-V");
  expect("BC\xC0\xDE!", "LLVM bitcode");
  expect("!<arch>\nmember", "a static library");
  expect("MZ\x90", "a program or DLL for Windows");
  expect("[shader(\"miss\")]\nvoid Miss() {}\n", "text, such as HLSL source");
  expect("", "an empty file");
  expect(std::string("\x01\x02\x00\xFF", 4),
         "a file of an unknown kind that begins with the bytes"
         " 01 02 00 FF");
}

TEST_F(FileKind, TellsElfFilesApart) {
#if defined(__x86_64__)
  constexpr unsigned char kOwn = 62, kOther = 183;
#else
  constexpr unsigned char kOwn = 183, kOther = 62;
#endif
  expect(elf(2, 1, kOwn), "an object file that is not linked");
  expect(elf(2, 2, kOwn), "a program");
  expect(elf(2, 3, kOther), "an ELF file for another processor");
  expect(elf(1, 3, kOwn), "an ELF file for another processor");
  expect(elf(2, 3, kOwn).substr(0, 20), "the beginning of an ELF file");
}

TEST_F(FileKind, NoFileAndFolders) {
  EXPECT_ERROR(LoadShaderLibraryFromFile((folder_ / "missing.so").string()), "KA0910",
               "is no file");
  EXPECT_ERROR(LoadShaderLibraryFromFile(folder_.string()), "KA0910", "is a folder");
}

}  // namespace
}  // namespace rtapi

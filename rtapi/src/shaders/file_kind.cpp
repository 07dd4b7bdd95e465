// SPDX-License-Identifier: MIT
#include "rtapi/src/shaders/file_kind.h"

#include <elf.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace rtapi::detail {
namespace {

#if defined(__x86_64__)
constexpr uint16_t kMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr uint16_t kMachine = EM_AARCH64;
#else
constexpr uint16_t kMachine = EM_NONE;
#endif

constexpr size_t kHeadBytes = 256;

struct Magic {
  std::string_view bytes;
  const char* kind;
};
constexpr Magic kMagics[] = {
    {"DXBC", "a DXIL container, which dxc makes for Direct3D drivers"},
    {"BC\xC0\xDE", "LLVM bitcode"},
    {"\x03\x02\x23\x07", "SPIR-V"},
    {"!<arch>\n", "a static library"},
    {"MZ", "a program or DLL for Windows"},
    {"\xCF\xFA\xED\xFE", "a library or program for macOS"},
};

std::string describe_elf(std::string_view head) {
  if (head.size() < sizeof(Elf64_Ehdr)) return "the beginning of an ELF file";
  Elf64_Ehdr header;
  std::memcpy(&header, head.data(), sizeof(header));
  if (header.e_ident[EI_CLASS] != ELFCLASS64 || header.e_machine != kMachine) {
    return "an ELF file for another processor";
  }
  if (header.e_type == ET_REL) return "an object file that is not linked";
  if (header.e_type == ET_EXEC) return "a program";
  return "a shared object";
}

bool is_text(std::string_view head) {
  return std::all_of(head.begin(), head.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x80 || std::isprint(byte) || std::isspace(byte);
  });
}

}  // namespace

std::string describe_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return "no file";
  if (std::filesystem::is_directory(status)) return "a folder";
  std::ifstream file(path, std::ios::binary);
  if (!file) return "a file that cannot be read";
  std::string head(kHeadBytes, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(file.gcount()));
  if (head.empty()) return "an empty file";
  if (head.starts_with(ELFMAG)) return describe_elf(head);
  for (const Magic& magic : kMagics) {
    if (head.starts_with(magic.bytes)) return magic.kind;
  }
  if (is_text(head)) return "text, such as HLSL source";
  std::string bytes;
  for (size_t i = 0; i < std::min<size_t>(head.size(), 4); ++i) {
    char digits[4];
    std::snprintf(digits, sizeof(digits), " %02X", static_cast<unsigned char>(head[i]));
    bytes += digits;
  }
  return "a file of an unknown kind that begins with the bytes" + bytes;
}

}  // namespace rtapi::detail

// SPDX-License-Identifier: MIT
#include "d3d12/com/text.h"

#include <algorithm>

#include <cstdint>

namespace kaamos::d3d12 {

namespace {

constexpr uint32_t kReplacement = 0xFFFD;

bool is_code_point(uint32_t c) {
  return c <= 0x10FFFF && (c < 0xD800 || c > 0xDFFF);
}

void append(std::string& out, uint32_t c) {
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xC0 | (c >> 6));
    out += static_cast<char>(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    out += static_cast<char>(0xE0 | (c >> 12));
    out += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (c & 0x3F));
  } else {
    out += static_cast<char>(0xF0 | (c >> 18));
    out += static_cast<char>(0x80 | ((c >> 12) & 0x3F));
    out += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (c & 0x3F));
  }
}

}  // namespace

std::string to_utf8(std::wstring_view text) {
  std::string out;
  for (wchar_t c : text) {
    const auto code = static_cast<uint32_t>(c);
    append(out, is_code_point(code) ? code : kReplacement);
  }
  return out;
}

std::string to_utf8(const wchar_t* text) {
  return text != nullptr ? to_utf8(std::wstring_view(text)) : std::string();
}

std::wstring to_wide(std::string_view text) {
  std::wstring out;
  for (size_t i = 0; i < text.size();) {
    const auto lead = static_cast<uint8_t>(text[i++]);
    const int more = lead < 0x80 ? 0 : lead >= 0xF0 ? 3 : lead >= 0xE0 ? 2 : lead >= 0xC0 ? 1 : -1;
    static constexpr uint32_t kLeast[] = {0, 0x80, 0x800, 0x10000};
    uint32_t code = more <= 0 ? lead : lead & (0x3Fu >> more);
    bool whole = more >= 0 && lead < 0xF8;
    for (int k = 0; k < more && whole; ++k) {
      whole = i < text.size() && (static_cast<uint8_t>(text[i]) & 0xC0) == 0x80;
      if (whole) code = code << 6 | (static_cast<uint8_t>(text[i++]) & 0x3F);
    }
    whole = whole && is_code_point(code) && code >= kLeast[more];
    out += static_cast<wchar_t>(whole ? code : kReplacement);
  }
  return out;
}

std::string to_path(std::string path) {
  std::replace(path.begin(), path.end(), '\\', '/');
  return path;
}

std::string to_path(const wchar_t* path) {
  return to_path(to_utf8(path));
}

}  // namespace kaamos::d3d12

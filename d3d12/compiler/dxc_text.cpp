// SPDX-License-Identifier: MIT
#include "d3d12/compiler/dxc_text.h"

#include <cstring>

#include <dxcapi.h>

#include "d3d12/com/text.h"

namespace kaamos::d3d12 {

namespace {

struct ByteOrderMark {
  std::string_view bytes;
  uint32_t code_page;
};

using namespace std::string_view_literals;
// That of UTF-32 begins with that of UTF-16.
constexpr ByteOrderMark kMarks[] = {{"\xFF\xFE\0\0"sv, DXC_CP_UTF32},
                                    {"\xEF\xBB\xBF"sv, DXC_CP_UTF8},
                                    {"\xFF\xFE"sv, DXC_CP_UTF16}};

std::wstring units_of(std::string_view bytes, size_t unit_size) {
  std::wstring out;
  for (size_t i = 0; i + unit_size <= bytes.size(); i += unit_size) {
    uint32_t unit = 0;
    std::memcpy(&unit, bytes.data() + i, unit_size);  // little-endian
    const bool is_low = unit_size == 2 && (unit & 0xFC00) == 0xDC00;
    if (is_low && !out.empty() && (static_cast<uint32_t>(out.back()) & 0xFFFFFC00u) == 0xD800) {
      const uint32_t high = static_cast<uint32_t>(out.back()) & 0x3FF;
      out.back() = static_cast<wchar_t>(0x10000 + (high << 10 | (unit & 0x3FF)));
    } else {
      out += static_cast<wchar_t>(unit);
    }
  }
  return out;
}

}  // namespace

std::string decode_text(const void* bytes, size_t size, uint32_t code_page) {
  if (bytes == nullptr) return {};
  std::string_view text(static_cast<const char*>(bytes), size);
  for (const ByteOrderMark& mark : kMarks) {
    if (code_page != DXC_CP_ACP && code_page != mark.code_page) continue;
    if (!text.starts_with(mark.bytes)) continue;
    code_page = mark.code_page;
    text.remove_prefix(mark.bytes.size());
  }
  std::string out;
  if (code_page == DXC_CP_UTF16 || code_page == DXC_CP_UTF32) {
    out = to_utf8(units_of(text, code_page == DXC_CP_UTF16 ? 2 : 4));
  } else {
    out = text;
  }
  while (!out.empty() && out.back() == '\0') out.pop_back();
  return out;
}

}  // namespace kaamos::d3d12

// SPDX-License-Identifier: MIT
//
// The conversions in the format of a printf in HLSL: those of C's printf without '*', %v3f and the
// like for vectors, as DXC writes them for SPIR-V, and %v for a value of any type.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace kaamos::shader {

struct PrintConversion {
  size_t begin = 0;         // of the '%'
  size_t end = 0;           // behind the letter
  std::string_view spec;    // flags, width and precision: "-08.3"
  uint32_t components = 1;  // %v3f: 3
  char letter = 0;          // d i u o x X c, f F e E g G a A, s, v; % for "%%"; 0: it is none

  bool is_integer() const { return std::string_view("diuoxXc").find(letter) != kNone; }
  bool is_float() const { return std::string_view("fFeEgGaA").find(letter) != kNone; }

  static constexpr size_t kNone = std::string_view::npos;
};

// Finds the first conversion at or behind `from`; none: the rest is text.
inline std::optional<PrintConversion> next_conversion(std::string_view format, size_t from) {
  const size_t begin = format.find('%', from);
  if (begin == std::string_view::npos) return std::nullopt;
  size_t at = begin + 1;
  const auto skip = [&](std::string_view letters) {
    while (at < format.size() && letters.find(format[at]) != std::string_view::npos) ++at;
  };
  const auto is_digit = [&](size_t i) {
    return i < format.size() && format[i] >= '0' && format[i] <= '9';
  };
  PrintConversion out;
  out.begin = begin;
  skip("-+ #0");
  skip("0123456789");
  if (at < format.size() && format[at] == '.') {
    ++at;
    skip("0123456789");
  }
  out.spec = format.substr(begin + 1, at - begin - 1);
  // A width of more than three digits would only fill memory.
  size_t digits = 0;
  for (const char c : out.spec) digits += c >= '0' && c <= '9' ? 1 : 0;
  if (at < format.size() && format[at] == 'v' && is_digit(at + 1)) {
    out.components = static_cast<uint32_t>(format[at + 1] - '0');
    at += 2;
  }
  skip("hl");  // the type is known
  if (at < format.size() && digits <= 6 && out.components >= 1 && out.components <= 4 &&
      std::string_view("diuoxXcfFeEgGaAsv%").find(format[at]) != std::string_view::npos) {
    out.letter = format[at];
  }
  out.end = at < format.size() ? at + 1 : at;
  return out;
}

}  // namespace kaamos::shader

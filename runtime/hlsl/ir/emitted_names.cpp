// SPDX-License-Identifier: MIT
#include "runtime/hlsl/ir/emitted_names.h"

#include <array>

namespace kaamos::hlsl {
namespace {

// C++ keywords that HLSL does not have, names used by the emitted code, and macros of <cmath>.
constexpr std::string_view kTaken[] = {
    "alignas",
    "alignof",
    "and",
    "and_eq",
    "asm",
    "auto",
    "bitand",
    "bitor",
    "bool",
    "break",
    "case",
    "catch",
    "char",
    "char16_t",
    "char32_t",
    "char8_t",
    "class",
    "co_await",
    "co_return",
    "co_yield",
    "compl",
    "concept",
    "const",
    "const_cast",
    "consteval",
    "constexpr",
    "constinit",
    "continue",
    "ctx",
    "decltype",
    "default",
    "delete",
    "do",
    "double",
    "dynamic_cast",
    "else",
    "enum",
    "explicit",
    "export",
    "extern",
    "false",
    "float",
    "for",
    "friend",
    "goto",
    "if",
    "inline",
    "int",
    "int16_t",
    "int32_t",
    "int64_t",
    "kaamos",
    "ks",
    "long",
    "mutable",
    "namespace",
    "new",
    "noexcept",
    "not",
    "not_eq",
    "nullptr",
    "operator",
    "or",
    "or_eq",
    "private",
    "protected",
    "public",
    "register",
    "reinterpret_cast",
    "requires",
    "return",
    "short",
    "signed",
    "sizeof",
    "size_t",
    "static",
    "static_assert",
    "static_cast",
    "std",
    "struct",
    "switch",
    "template",
    "this",
    "thread_local",
    "throw",
    "true",
    "try",
    "typedef",
    "typeid",
    "typename",
    "u",
    "uint16_t",
    "uint32_t",
    "uint64_t",
    "union",
    "unsigned",
    "using",
    "virtual",
    "void",
    "volatile",
    "wchar_t",
    "while",
    "xor",
    "xor_eq",
    "INFINITY",
    "NAN",
    "NULL",
    "HUGE_VAL",
    "HUGE_VALF",
    "HUGE_VALL",
    "FP_NAN",
    "FP_INFINITE",
    "FP_ZERO",
    "FP_NORMAL",
    "FP_SUBNORMAL",
    "MATH_ERRNO",
    "MATH_ERREXCEPT",
    "math_errhandling",
    "offsetof",
    "main",
    "INT8_MAX",
    "INT16_MAX",
    "INT32_MAX",
    "INT64_MAX",
    "UINT8_MAX",
    "UINT16_MAX",
    "UINT32_MAX",
    "UINT64_MAX",
    "INT8_MIN",
    "INT16_MIN",
    "INT32_MIN",
    "INT64_MIN",
    "SIZE_MAX",
    "FP_ILOGB0",
    "FP_ILOGBNAN",
    "M_PI",
    "M_E",
    "M_PI_2",
    "M_PI_4",
    "M_1_PI",
    "M_2_PI",
    "M_SQRT2",
    "M_SQRT1_2",
    "M_LN2",
    "M_LN10",
    "M_LOG2E",
    "M_LOG10E",
    "M_2_SQRTPI",
    "MAXFLOAT",
    "FLT_EVAL_METHOD",
};

bool taken(std::string_view name) {
  static const std::unordered_set<std::string_view> set(std::begin(kTaken), std::end(kTaken));
  return set.count(name) != 0;
}

bool is_identifier_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

}  // namespace

std::string cpp_identifier(std::string_view name) {
  std::string out;
  for (const char c : name) {
    // C++ reserves names with two consecutive underscores or a leading one.
    if (is_identifier_character(c)) {
      out += c;
    } else if (out.empty()) {
      out += "v_";
    } else if (out.back() != '_') {
      out += '_';
    }
  }
  if (out.empty()) {
    out = "t";
  }
  if (out[0] >= '0' && out[0] <= '9') {
    out.insert(0, "v_");
  }
  if (taken(out)) {
    out += '_';
  }
  return out;
}

std::string NameSet::add(std::string_view hlsl_name) {
  const std::string base = cpp_identifier(hlsl_name);
  std::string name = base;
  for (int number = 2; !used_.insert(name).second; ++number) {
    name = base + "_" + std::to_string(number);
  }
  return name;
}

bool ScopedNames::visible(const std::string& name) const {
  for (const auto& scope : scopes_) {
    if (scope.count(name) != 0) {
      return true;
    }
  }
  return false;
}

std::string ScopedNames::declare(std::string_view hlsl_name) {
  const std::string base = cpp_identifier(hlsl_name);
  std::string name = base;
  for (int number = 2; visible(name); ++number) {
    name = base + "_" + std::to_string(number);
  }
  scopes_.back().insert(name);
  return name;
}

}  // namespace kaamos::hlsl

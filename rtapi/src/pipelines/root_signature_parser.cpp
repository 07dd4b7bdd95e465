// SPDX-License-Identifier: MIT
//
// Parses HLSL's root signature language by recursive descent; keywords in any case. [HLSL:
// Specifying root signatures in HLSL]
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <span>
#include <string>

#include <rtapi/root_signature.h>

#include "rtapi/src/errors/error_table.h"

namespace rtapi {

namespace {

using detail::Id;
using detail::in_quotes;
using detail::make_error;

struct Keyword {
  const char* name;
  uint32_t value;
};

template <class E>
constexpr uint32_t N(E e) {
  return static_cast<uint32_t>(e);
}

constexpr Keyword kFlags[] = {
    {"ALLOW_INPUT_ASSEMBLER_INPUT_LAYOUT", 0x1},
    {"DENY_VERTEX_SHADER_ROOT_ACCESS", 0x2},
    {"DENY_HULL_SHADER_ROOT_ACCESS", 0x4},
    {"DENY_DOMAIN_SHADER_ROOT_ACCESS", 0x8},
    {"DENY_GEOMETRY_SHADER_ROOT_ACCESS", 0x10},
    {"DENY_PIXEL_SHADER_ROOT_ACCESS", 0x20},
    {"ALLOW_STREAM_OUTPUT", 0x40},
    {"LOCAL_ROOT_SIGNATURE", 0x80},
    {"DENY_AMPLIFICATION_SHADER_ROOT_ACCESS", 0x100},
    {"DENY_MESH_SHADER_ROOT_ACCESS", 0x200},
    {"CBV_SRV_UAV_HEAP_DIRECTLY_INDEXED", 0x400},
    {"SAMPLER_HEAP_DIRECTLY_INDEXED", 0x800},
};
constexpr Keyword kVisibilities[] = {
    {"SHADER_VISIBILITY_ALL", 0},           {"SHADER_VISIBILITY_VERTEX", 1},
    {"SHADER_VISIBILITY_HULL", 2},          {"SHADER_VISIBILITY_DOMAIN", 3},
    {"SHADER_VISIBILITY_GEOMETRY", 4},      {"SHADER_VISIBILITY_PIXEL", 5},
    {"SHADER_VISIBILITY_AMPLIFICATION", 6}, {"SHADER_VISIBILITY_MESH", 7},
};
constexpr Keyword kRangeFlags[] = {
    {"DESCRIPTORS_VOLATILE", 0x1},
    {"DATA_VOLATILE", 0x2},
    {"DATA_STATIC_WHILE_SET_AT_EXECUTE", 0x4},
    {"DATA_STATIC", 0x8},
    {"DESCRIPTORS_STATIC_KEEPING_BUFFER_BOUNDS_CHECKS", 0x10000},
};
constexpr Keyword kFilters[] = {
    {"FILTER_MIN_MAG_MIP_POINT", N(Filter::kMinMagMipPoint)},
    {"FILTER_MIN_MAG_POINT_MIP_LINEAR", N(Filter::kMinMagPointMipLinear)},
    {"FILTER_MIN_POINT_MAG_LINEAR_MIP_POINT", N(Filter::kMinPointMagLinearMipPoint)},
    {"FILTER_MIN_POINT_MAG_MIP_LINEAR", N(Filter::kMinPointMagMipLinear)},
    {"FILTER_MIN_LINEAR_MAG_MIP_POINT", N(Filter::kMinLinearMagMipPoint)},
    {"FILTER_MIN_LINEAR_MAG_POINT_MIP_LINEAR", N(Filter::kMinLinearMagPointMipLinear)},
    {"FILTER_MIN_MAG_LINEAR_MIP_POINT", N(Filter::kMinMagLinearMipPoint)},
    {"FILTER_MIN_MAG_MIP_LINEAR", N(Filter::kMinMagMipLinear)},
    {"FILTER_ANISOTROPIC", N(Filter::kAnisotropic)},
    {"FILTER_COMPARISON_MIN_MAG_MIP_POINT", N(Filter::kComparisonMinMagMipPoint)},
    {"FILTER_COMPARISON_MIN_MAG_POINT_MIP_LINEAR", N(Filter::kComparisonMinMagPointMipLinear)},
    {"FILTER_COMPARISON_MIN_POINT_MAG_LINEAR_MIP_POINT",
     N(Filter::kComparisonMinPointMagLinearMipPoint)},
    {"FILTER_COMPARISON_MIN_POINT_MAG_MIP_LINEAR", N(Filter::kComparisonMinPointMagMipLinear)},
    {"FILTER_COMPARISON_MIN_LINEAR_MAG_MIP_POINT", N(Filter::kComparisonMinLinearMagMipPoint)},
    {"FILTER_COMPARISON_MIN_LINEAR_MAG_POINT_MIP_LINEAR",
     N(Filter::kComparisonMinLinearMagPointMipLinear)},
    {"FILTER_COMPARISON_MIN_MAG_LINEAR_MIP_POINT", N(Filter::kComparisonMinMagLinearMipPoint)},
    {"FILTER_COMPARISON_MIN_MAG_MIP_LINEAR", N(Filter::kComparisonMinMagMipLinear)},
    {"FILTER_COMPARISON_ANISOTROPIC", N(Filter::kComparisonAnisotropic)},
    {"FILTER_MINIMUM_MIN_MAG_MIP_POINT", N(Filter::kMinimumMinMagMipPoint)},
    {"FILTER_MINIMUM_MIN_MAG_MIP_LINEAR", N(Filter::kMinimumMinMagMipLinear)},
    {"FILTER_MAXIMUM_MIN_MAG_MIP_POINT", N(Filter::kMaximumMinMagMipPoint)},
    {"FILTER_MAXIMUM_MIN_MAG_MIP_LINEAR", N(Filter::kMaximumMinMagMipLinear)},
};
constexpr Keyword kAddressModes[] = {
    {"TEXTURE_ADDRESS_WRAP", 1},   {"TEXTURE_ADDRESS_MIRROR", 2},      {"TEXTURE_ADDRESS_CLAMP", 3},
    {"TEXTURE_ADDRESS_BORDER", 4}, {"TEXTURE_ADDRESS_MIRROR_ONCE", 5},
};
constexpr Keyword kComparisons[] = {
    {"COMPARISON_NEVER", 1},         {"COMPARISON_LESS", 2},    {"COMPARISON_EQUAL", 3},
    {"COMPARISON_LESS_EQUAL", 4},    {"COMPARISON_GREATER", 5}, {"COMPARISON_NOT_EQUAL", 6},
    {"COMPARISON_GREATER_EQUAL", 7}, {"COMPARISON_ALWAYS", 8},
};
constexpr Keyword kBorderColors[] = {
    {"STATIC_BORDER_COLOR_TRANSPARENT_BLACK", 0}, {"STATIC_BORDER_COLOR_OPAQUE_BLACK", 1},
    {"STATIC_BORDER_COLOR_OPAQUE_WHITE", 2},      {"STATIC_BORDER_COLOR_OPAQUE_BLACK_UINT", 3},
    {"STATIC_BORDER_COLOR_OPAQUE_WHITE_UINT", 4},
};
constexpr Keyword kSamplerFlags[] = {
    {"UINT_BORDER_COLOR", 1},
};

bool same_word(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(a[i])) !=
        std::tolower(static_cast<unsigned char>(b[i]))) {
      return false;
    }
  }
  return true;
}

// Every Parse* function returns false after fail(), which keeps the first error.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Result<RootSignatureDesc> parse() {
    skip_space();
    if (pos_ < text_.size()) {
      do {
        if (!parse_element()) return *error_;
        skip_space();
      } while (take(','));
    }
    if (pos_ < text_.size()) {
      fail("expected ',' or the end");
      return *error_;
    }
    return desc_;
  }

 private:
  bool fail(const std::string& what) { return fail_at(pos_, what); }
  bool fail_at(size_t position, const std::string& what) {
    if (!error_) {
      const size_t end = std::min(text_.size(), position + 24);
      const std::string found = position < text_.size()
                                    ? in_quotes(text_.substr(position, end - position))
                                    : std::string("the end");
      error_ = make_error(Id::kRootSignatureSyntax, "column ", position + 1, ": ", what, ", found ",
                          found);
    }
    return false;
  }

  void skip_space() {
    while (pos_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[pos_]))) ++pos_;
  }
  bool take(char c) {
    skip_space();
    if (pos_ >= text_.size() || text_[pos_] != c) return false;
    ++pos_;
    return true;
  }
  bool expect(char c) { return take(c) || fail(std::string("expected '") + c + "'"); }

  // Returns the letters, digits and '_' from here, without moving.
  std::string_view peek_word() {
    skip_space();
    size_t end = pos_;
    while (end < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[end])) || text_[end] == '_')) {
      ++end;
    }
    return text_.substr(pos_, end - pos_);
  }
  bool take_word(std::string_view word) {
    if (!same_word(peek_word(), word)) return false;
    pos_ += word.size();
    return true;
  }

  bool parse_uint(uint32_t& out) {
    const std::string_view word = peek_word();
    if (word.empty() || !std::isdigit(static_cast<unsigned char>(word[0]))) {
      return fail("expected a number");
    }
    const std::string digits(word);
    char* end = nullptr;
    errno = 0;
    const unsigned long long value = std::strtoull(digits.c_str(), &end, 0);
    const bool suffix = *end == 'u' || *end == 'U';
    if (errno || value > 0xFFFFFFFFull ||
        (end + (suffix ? 1 : 0)) != digits.c_str() + digits.size()) {
      return fail("expected a 32-bit number");
    }
    pos_ += word.size();
    out = static_cast<uint32_t>(value);
    return true;
  }

  bool parse_float(float& out) {
    skip_space();
    const std::string rest(text_.substr(pos_, 64));
    char* end = nullptr;
    out = std::strtof(rest.c_str(), &end);
    if (end == rest.c_str() || !std::isfinite(out)) return fail("expected a number");
    pos_ += static_cast<size_t>(end - rest.c_str());
    if (pos_ < text_.size() && (text_[pos_] == 'f' || text_[pos_] == 'F')) ++pos_;
    return true;
  }

  bool parse_keyword(std::span<const Keyword> keywords, const char* kind, uint32_t& out) {
    const std::string_view word = peek_word();
    for (const Keyword& k : keywords) {
      if (same_word(word, k.name)) {
        pos_ += word.size();
        out = k.value;
        return true;
      }
    }
    return fail(detail::concat("expected a ", kind, ", such as ", keywords[0].name));
  }

  // Reads 0, or names joined by '|'.
  bool parse_flags(std::span<const Keyword> keywords, const char* kind, uint32_t& out) {
    out = 0;
    do {
      uint32_t flag = 0;
      if (peek_word() == "0") {
        pos_ += 1;
      } else if (!parse_keyword(keywords, kind, flag)) {
        return false;
      }
      out |= flag;
    } while (take('|'));
    return true;
  }

  bool parse_register(char letter, uint32_t& out) {
    const std::string_view word = peek_word();
    if (word.size() < 2 || std::tolower(static_cast<unsigned char>(word[0])) != letter ||
        !std::isdigit(static_cast<unsigned char>(word[1]))) {
      return fail(std::string("expected a register ") + letter + "N");
    }
    ++pos_;
    return parse_uint(out);
  }

  // A number of an option, which may have a sign: space = +1.
  bool parse_number(uint32_t& out) {
    if (take('+') && pos_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[pos_]))) {
      return fail("expected a digit after '+'");
    }
    return parse_uint(out);
  }

  static bool is_register(std::string_view word) {
    constexpr std::string_view kLetters = "bBtTuUsS";
    return word.size() > 1 && kLetters.find(word[0]) != std::string_view::npos &&
           std::isdigit(static_cast<unsigned char>(word[1]));
  }

  // Reads "(", a register and "name = value" in any order, and ")". The handler parses the value of
  // an option and returns its number, or -1 if it does not know the name.
  template <class Handler>
  bool parse_arguments(char letter, uint32_t& out, Handler&& handler) {
    uint32_t seen = 0;
    bool has_register = false;
    if (!expect('(')) return false;
    do {
      skip_space();
      const size_t at = pos_;
      const std::string_view name = peek_word();
      if (is_register(name)) {
        if (has_register) return fail("the register is given twice");
        if (!parse_register(letter, out)) return false;
        has_register = true;
        continue;
      }
      pos_ += name.size();
      if (name.empty() || !take('=')) {
        return fail_at(at,
                       std::string("expected a register ") + letter + "N or an option with '='");
      }
      const int index = handler(name);
      if (index < 0) {
        return error_ ? false : fail_at(at, "unknown option");
      }
      if (seen & (1u << index)) return fail_at(at, "the option is given twice");
      seen |= 1u << index;
    } while (take(','));
    if (!has_register) return fail(std::string("expected a register ") + letter + "N");
    return expect(')');
  }

  bool parse_element() {
    skip_space();
    if (take_word("RootFlags")) return parse_root_flags();
    if (take_word("RootConstants")) return parse_root_constants();
    if (take_word("CBV")) return parse_root_descriptor(RootParameterType::kCbv, 'b');
    if (take_word("SRV")) return parse_root_descriptor(RootParameterType::kSrv, 't');
    if (take_word("UAV")) return parse_root_descriptor(RootParameterType::kUav, 'u');
    if (take_word("DescriptorTable")) return parse_table();
    if (take_word("StaticSampler")) return parse_static_sampler();
    return fail(
        "expected RootFlags, RootConstants, CBV, SRV, UAV, DescriptorTable or StaticSampler");
  }

  bool parse_root_flags() {
    if (flags_seen_) return fail("RootFlags is given twice");
    flags_seen_ = true;
    uint32_t flags = 0;
    if (!expect('(') || !parse_flags(kFlags, "root flag", flags) || !expect(')')) return false;
    desc_.Flags = static_cast<RootSignatureFlags>(flags);
    return true;
  }

  bool parse_root_constants() {
    RootParameter p;
    p.ParameterType = RootParameterType::k32BitConstants;
    uint32_t visibility = 0;
    bool has_count = false;
    const bool ok = parse_arguments('b', p.Constants.ShaderRegister, [&](std::string_view name) {
      if (same_word(name, "num32BitConstants")) {
        has_count = true;
        return parse_number(p.Constants.Num32BitValues) ? 0 : -1;
      }
      if (same_word(name, "space")) return parse_number(p.Constants.RegisterSpace) ? 1 : -1;
      if (same_word(name, "visibility")) {
        return parse_keyword(kVisibilities, "visibility", visibility) ? 2 : -1;
      }
      return -1;
    });
    if (!ok) return false;
    if (!has_count) return fail_at(pos_ - 1, "RootConstants needs num32BitConstants = N");
    p.ShaderVisibility = static_cast<ShaderVisibility>(visibility);
    desc_.Parameters.push_back(std::move(p));
    return true;
  }

  bool parse_root_descriptor(RootParameterType type, char letter) {
    RootParameter p;
    p.ParameterType = type;
    uint32_t visibility = 0, flags = 0;
    const bool ok =
        parse_arguments(letter, p.Descriptor.ShaderRegister, [&](std::string_view name) {
          if (same_word(name, "space")) return parse_number(p.Descriptor.RegisterSpace) ? 0 : -1;
          if (same_word(name, "visibility")) {
            return parse_keyword(kVisibilities, "visibility", visibility) ? 1 : -1;
          }
          if (same_word(name, "flags"))
            return parse_flags(kRangeFlags, "data flag", flags) ? 2 : -1;
          return -1;
        });
    if (!ok) return false;
    if (flags & ~0xEu) return fail("DESCRIPTORS_ flags belong to descriptor tables");
    p.Descriptor.Flags = static_cast<RootDescriptorFlags>(flags);
    p.ShaderVisibility = static_cast<ShaderVisibility>(visibility);
    desc_.Parameters.push_back(std::move(p));
    return true;
  }

  bool parse_table() {
    RootParameter p;
    uint32_t visibility = 0;
    if (!expect('(')) return false;
    do {
      if (take_word("visibility")) {
        if (!expect('=') || !parse_keyword(kVisibilities, "visibility", visibility)) return false;
      } else if (!parse_range(p.DescriptorTable)) {
        return false;
      }
    } while (take(','));
    p.ShaderVisibility = static_cast<ShaderVisibility>(visibility);
    desc_.Parameters.push_back(std::move(p));
    return expect(')');
  }

  bool parse_range(RootDescriptorTable& table) {
    DescriptorRange range;
    char letter = 0;
    auto is = [&](const char* word, DescriptorRangeType type, char reg) {
      if (!take_word(word)) return false;
      range.RangeType = type;
      letter = reg;
      return true;
    };
    if (!is("CBV", DescriptorRangeType::kCbv, 'b') && !is("SRV", DescriptorRangeType::kSrv, 't') &&
        !is("UAV", DescriptorRangeType::kUav, 'u') &&
        !is("Sampler", DescriptorRangeType::kSampler, 's')) {
      return fail("expected CBV, SRV, UAV, Sampler or visibility");
    }
    uint32_t flags = 0;
    const bool ok = parse_arguments(letter, range.BaseShaderRegister, [&](std::string_view name) {
      if (same_word(name, "numDescriptors")) {
        if (take_word("unbounded")) {
          range.NumDescriptors = kUnboundedDescriptors;
          return 0;
        }
        return parse_number(range.NumDescriptors) ? 0 : -1;
      }
      if (same_word(name, "space")) return parse_number(range.RegisterSpace) ? 1 : -1;
      if (same_word(name, "offset")) {
        if (take_word("DESCRIPTOR_RANGE_OFFSET_APPEND")) {
          range.OffsetInDescriptorsFromTableStart = kDescriptorRangeOffsetAppend;
          return 2;
        }
        return parse_number(range.OffsetInDescriptorsFromTableStart) ? 2 : -1;
      }
      if (same_word(name, "flags")) return parse_flags(kRangeFlags, "range flag", flags) ? 3 : -1;
      return -1;
    });
    range.Flags = static_cast<DescriptorRangeFlags>(flags);
    table.Ranges.push_back(range);
    return ok;
  }

  bool parse_static_sampler() {
    StaticSamplerDesc s;
    uint32_t flags = 0;
    auto keyword = [&](std::span<const Keyword> words, const char* kind, auto& out, int index) {
      uint32_t value = 0;
      if (!parse_keyword(words, kind, value)) return -1;
      out = static_cast<std::remove_reference_t<decltype(out)>>(value);
      return index;
    };
    const bool ok = parse_arguments('s', s.ShaderRegister, [&](std::string_view name) {
      if (same_word(name, "filter")) return keyword(kFilters, "filter", s.Filter, 0);
      if (same_word(name, "addressU")) return keyword(kAddressModes, "mode", s.AddressU, 1);
      if (same_word(name, "addressV")) return keyword(kAddressModes, "mode", s.AddressV, 2);
      if (same_word(name, "addressW")) return keyword(kAddressModes, "mode", s.AddressW, 3);
      if (same_word(name, "mipLODBias")) return parse_float(s.MipLODBias) ? 4 : -1;
      if (same_word(name, "maxAnisotropy")) return parse_number(s.MaxAnisotropy) ? 5 : -1;
      if (same_word(name, "comparisonFunc")) {
        return keyword(kComparisons, "comparison", s.ComparisonFunc, 6);
      }
      if (same_word(name, "borderColor")) {
        return keyword(kBorderColors, "border colour", s.BorderColor, 7);
      }
      if (same_word(name, "minLOD")) return parse_float(s.MinLOD) ? 8 : -1;
      if (same_word(name, "maxLOD")) return parse_float(s.MaxLOD) ? 9 : -1;
      if (same_word(name, "space")) return parse_number(s.RegisterSpace) ? 10 : -1;
      if (same_word(name, "visibility")) {
        return keyword(kVisibilities, "visibility", s.ShaderVisibility, 11);
      }
      if (same_word(name, "flags")) {
        return parse_flags(kSamplerFlags, "sampler flag", flags) ? 12 : -1;
      }
      return -1;
    });
    s.Flags = static_cast<SamplerFlags>(flags);
    desc_.StaticSamplers.push_back(s);
    return ok;
  }

  std::string_view text_;
  size_t pos_ = 0;
  RootSignatureDesc desc_;
  bool flags_seen_ = false;
  std::optional<Error> error_;
};

}  // namespace

Result<RootSignatureDesc> ParseRootSignature(std::string_view text) {
  return Parser(text).parse();
}

}  // namespace rtapi

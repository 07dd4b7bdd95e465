// SPDX-License-Identifier: MIT
#include "runtime/hlsl/front/literal.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "runtime/hlsl/front/diagnostic.h"

namespace kaamos::hlsl {
namespace {

constexpr double kMaxHalf = 65504;

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

int digit_value(char c) {
  if (is_digit(c)) return c - '0';
  c = lower(c);
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : 99;
}

class NumberReader {
 public:
  NumberReader(std::string_view text, SourceLocation location, DiagnosticEngine& diagnostics)
      : text_(text), location_(location), diagnostics_(diagnostics) {}

  NumberLiteral read() {
    is_hex_ = text_.size() > 1 && text_[0] == '0' && lower(text_[1]) == 'x';
    bool is_binary = text_.size() > 1 && text_[0] == '0' && lower(text_[1]) == 'b';
    if (is_hex_) {
      read_hex();
    } else if (is_binary) {
      result_.is_decimal = false;
      read_integer(2, 2, "binary");
    } else if (size_t end = decimal_digits(0); is_float_at(end)) {
      read_float(end);
    } else if (text_[0] == '0' && end > 1) {
      result_.is_decimal = false;
      read_integer(1, 8, "octal");
    } else {
      read_integer(0, 10, "decimal");
    }
    return result_;
  }

 private:
  void report(DiagnosticId id, size_t offset, std::initializer_list<std::string_view> arguments) {
    diagnostics_.report(id, location_.advanced(static_cast<uint32_t>(offset)), arguments);
  }

  size_t decimal_digits(size_t at) const {
    while (at < text_.size() && is_digit(text_[at])) ++at;
    return at;
  }

  bool is_float_at(size_t end) const {
    return end < text_.size() && (text_[end] == '.' || lower(text_[end]) == 'e');
  }

  void read_hex() {
    result_.is_decimal = false;
    const size_t end = hex_digits(2);
    const bool has_point = end < text_.size() && text_[end] == '.';
    if (!has_point && (end == text_.size() || lower(text_[end]) != 'p')) {
      return read_integer(2, 16, "hexadecimal");
    }
    result_.is_float = true;
    const size_t at = has_point ? hex_digits(end + 1) : end;
    if (at == (has_point ? size_t{3} : size_t{2})) {
      return report(DiagnosticId::kDigitsExpected, 0, {"hexadecimal", text_});
    }
    if (at == text_.size() || lower(text_[at]) != 'p') {
      return report(DiagnosticId::kHexExponentMissing, at, {text_});
    }
    read_exponent(at);
  }

  size_t hex_digits(size_t at) const {
    while (at < text_.size() && digit_value(text_[at]) < 16) ++at;
    return at;
  }

  // From the letter of the exponent to the end of the number.
  void read_exponent(size_t at) {
    size_t digits = at + 1;
    if (digits < text_.size() && (text_[digits] == '+' || text_[digits] == '-')) ++digits;
    const size_t end = decimal_digits(digits);
    if (end == digits) return report(DiagnosticId::kExponentEmpty, at, {text_});
    finish_float(end);
  }

  void finish_float(size_t end) {
    read_float_suffix(end);
    if (is_valid_) convert(text_.substr(0, end));
  }

  void read_integer(size_t begin, uint64_t base, std::string_view kind) {
    size_t at = begin;
    bool is_too_large = false;
    // An octal or binary number with an out-of-range digit is read to its end as digits, so that
    // the message names the digit and not a suffix.
    int limit = base == 16 ? 16 : 10;
    for (; at < text_.size() && digit_value(text_[at]) < limit; ++at) {
      uint64_t digit = static_cast<uint64_t>(digit_value(text_[at]));
      if (digit >= base) {
        report(DiagnosticId::kInvalidDigit, at, {text_.substr(at, 1), kind, text_});
        return;
      }
      if (result_.integer > (UINT64_MAX - digit) / base) is_too_large = true;
      result_.integer = result_.integer * base + digit;
    }
    if (at == begin && base != 8) return report(DiagnosticId::kDigitsExpected, 0, {kind, text_});
    if (is_too_large) {
      result_.integer = UINT64_MAX;
      report(DiagnosticId::kIntegerTooLarge, 0, {text_});
    }
    read_integer_suffix(at);
  }

  void read_integer_suffix(size_t at) {
    std::string suffix(text_.substr(at));
    bool is_mixed_ll =
        suffix.find("lL") != std::string::npos || suffix.find("Ll") != std::string::npos;
    std::transform(suffix.begin(), suffix.end(), suffix.begin(), lower);
    if (suffix.empty()) return;
    if (suffix == "u") {
      result_.suffix = LiteralSuffix::kU;
    } else if (!is_mixed_ll && (suffix == "l" || suffix == "ll")) {
      result_.suffix = LiteralSuffix::kL;
    } else if (!is_mixed_ll &&
               (suffix == "ul" || suffix == "lu" || suffix == "ull" || suffix == "llu")) {
      result_.suffix = LiteralSuffix::kUL;
    } else {
      report(DiagnosticId::kInvalidIntegerSuffix, at, {text_.substr(at), text_.substr(0, at)});
    }
  }

  void read_float(size_t at) {
    result_.is_float = true;
    if (text_[at] == '.') at = decimal_digits(at + 1);
    if (text_.substr(at).starts_with("#INF")) {
      result_.real = std::numeric_limits<double>::infinity();
      return read_float_suffix(at + 4);
    }
    if (at < text_.size() && lower(text_[at]) == 'e') return read_exponent(at);
    finish_float(at);
  }

  void read_float_suffix(size_t at) {
    std::string_view suffix = text_.substr(at);
    if (suffix.empty()) return;
    char letter = suffix.size() == 1 ? lower(suffix[0]) : '\0';
    if (letter == 'f') {
      result_.suffix = LiteralSuffix::kF;
    } else if (letter == 'h') {
      result_.suffix = LiteralSuffix::kH;
    } else if (letter == 'l') {
      result_.suffix = LiteralSuffix::kL;
    } else {
      is_valid_ = false;
      report(DiagnosticId::kInvalidFloatSuffix, at, {suffix, text_.substr(0, at)});
    }
  }

  // A number that is too small is read as 0.
  template <class Float>
  std::optional<Float> parse(std::string_view digits) const {
    Float value = 0;
    const auto format = is_hex_ ? std::chars_format::hex : std::chars_format::general;
    auto [end, failure] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, format);
    if (failure != std::errc::result_out_of_range) return value;
    return is_large(digits) ? std::nullopt : std::optional<Float>(Float{0});
  }

  // Returns whether an out-of-range number is too large rather than too small.
  bool is_large(std::string_view digits) const {
    size_t e = digits.find_first_of(is_hex_ ? "pP" : "eE");
    std::string_view mantissa = digits.substr(0, e);
    bool is_negative_exponent = e != std::string_view::npos && digits[e + 1] == '-';
    size_t first = mantissa.find_first_not_of("0.");
    size_t point = std::min(mantissa.find('.'), mantissa.size());
    if (e == std::string_view::npos) return first < point;
    return !is_negative_exponent;
  }

  void convert(std::string_view digits) {
    if (is_hex_) digits.remove_prefix(2);
    std::optional<double> value = parse<double>(digits);
    if (!value) {
      result_.real = std::numeric_limits<double>::infinity();
      return report(DiagnosticId::kFloatTooLarge, 0, {text_});
    }
    result_.real = *value;
    bool is_half = result_.suffix == LiteralSuffix::kH;
    if (result_.suffix != LiteralSuffix::kF && !is_half) return;
    // A hexadecimal half has few enough digits to be exact as a double; the type decides how far it
    // is rounded.
    if (is_hex_ && is_half && *value < kMaxHalf + 16) return;
    // Converted directly to float, because going through double could round twice.
    std::optional<float> narrow = parse<float>(digits);
    result_.real = narrow ? *narrow : std::numeric_limits<float>::infinity();
    if (is_half && *value >= kMaxHalf + 16) {
      report(DiagnosticId::kFloatBecomesInfinite, 0, {text_, "half", "65504"});
    } else if (std::isinf(result_.real)) {
      report(DiagnosticId::kFloatBecomesInfinite, 0, {text_, "float", "3.40282e+38"});
    }
  }

  std::string_view text_;
  SourceLocation location_;
  DiagnosticEngine& diagnostics_;
  NumberLiteral result_;
  bool is_hex_ = false;
  bool is_valid_ = true;
};

std::optional<char> simple_escape(char c) {
  constexpr std::string_view kNames = "ntrabfv0\\'\"?";
  constexpr std::string_view kValues("\n\t\r\a\b\f\v\0\\'\"?", 12);
  size_t index = kNames.find(c);
  if (index == std::string_view::npos) return std::nullopt;
  return kValues[index];
}

}  // namespace

NumberLiteral parse_number(std::string_view text, SourceLocation location,
                           DiagnosticEngine& diagnostics) {
  return NumberReader(text, location, diagnostics).read();
}

NumberLiteral parse_character(std::string_view text, SourceLocation location,
                              DiagnosticEngine& diagnostics) {
  const std::string bytes = parse_quoted(text, location, diagnostics);
  NumberLiteral result;
  result.is_decimal = false;
  result.suffix = LiteralSuffix::kU;
  if (bytes.empty()) {
    diagnostics.report(DiagnosticId::kEmptyCharacter, location);
  } else if (bytes.size() > 1) {
    diagnostics.report(DiagnosticId::kCharacterNotSingle, location,
                       {text, std::to_string(bytes.size())});
  } else {
    result.integer = static_cast<uint32_t>(static_cast<signed char>(bytes[0]));
  }
  return result;
}

std::string parse_quoted(std::string_view text, SourceLocation location,
                         DiagnosticEngine& diagnostics) {
  std::string result;
  std::string_view inner = text.substr(1, text.size() - 2);
  for (size_t i = 0; i < inner.size(); ++i) {
    if (inner[i] != '\\' || i + 1 == inner.size()) {
      result += inner[i];
      continue;
    }
    size_t begin = i++;
    auto at = location.advanced(static_cast<uint32_t>(begin + 1));
    bool is_hex = inner[i] == 'x';
    bool is_octal = inner[i] >= '0' && inner[i] <= '7';
    if (!is_hex && !is_octal) {
      std::optional<char> simple = simple_escape(inner[i]);
      if (!simple) diagnostics.report(DiagnosticId::kUnknownEscape, at, {inner.substr(begin, 2)});
      result += simple.value_or(inner[i]);
      continue;
    }
    uint32_t value = 0;
    size_t digit = is_hex ? i + 1 : i;
    size_t end = is_hex ? inner.size() : std::min(inner.size(), i + 3);
    int base = is_hex ? 16 : 8;
    size_t first = digit;
    for (; digit < end && digit_value(inner[digit]) < base; ++digit) {
      value = std::min(value * static_cast<uint32_t>(base), 0xFFFFu) +
              static_cast<uint32_t>(digit_value(inner[digit]));
    }
    std::string_view escape = inner.substr(begin, digit - begin);
    if (digit == first) {
      diagnostics.report(DiagnosticId::kHexEscapeEmpty, at);
    } else if (value > 255) {
      diagnostics.report(DiagnosticId::kEscapeOutOfRange, at, {escape, is_hex ? "\\xff" : "\\377"});
    }
    result += static_cast<char>(value);
    i = digit - 1;
  }
  return result;
}

}  // namespace kaamos::hlsl

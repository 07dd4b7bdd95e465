// SPDX-License-Identifier: MIT
#include "effects/engine/setting.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <utility>

#include "effects/assets/common/errors.h"

namespace kaamos::effects {

namespace {

constexpr const char* kOn = "on";
constexpr const char* kOff = "off";
constexpr const char* kInfinite = "inf";

rtapi::Error wrong(const SettingText& text, const std::string& value) {
  return make_error(ErrorId::kSetting,
                    fmt::format("{} is {}; choose {}", text.name, value, allowed_text(text)));
}

std::string number_text(double value) {
  return std::isinf(value) ? (value < 0 ? "-inf" : kInfinite) : fmt::format("{}", value);
}

rtapi::Result<SettingValue> in_range(const SettingText& text, double number) {
  const bool is_whole = number == std::floor(number);
  // Not written as two comparisons that fail: NaN is in no range.
  if (!(number >= text.range.least && number <= text.range.most) ||
      (text.type == SettingType::kCount && !is_whole)) {
    return wrong(text, number_text(number));
  }
  if (text.type == SettingType::kCount) return SettingValue(static_cast<std::int64_t>(number));
  return SettingValue(as_decimal(static_cast<float>(number)));
}

std::string quoted(const std::string& word) {
  return "\"" + word + "\"";
}

// Letters that are missing, too many or others, and pairs that are swapped.
std::size_t letters_apart(const std::string& a, const std::string& b) {
  std::vector<std::size_t> last, before, row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    last = std::exchange(before, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({before[j] + 1, row[j - 1] + 1, before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swapped) row[j] = std::min(row[j], last[j - 2] + 1);
    }
  }
  return row.back();
}

}  // namespace

double as_decimal(float value) {
  if (!std::isfinite(value)) return value;
  std::array<char, 64> digits{};
  const auto written = std::to_chars(digits.data(), digits.data() + digits.size() - 1, value);
  *written.ptr = '\0';
  return std::strtod(digits.data(), nullptr);
}

std::string value_text(const SettingValue& value) {
  if (const auto* is_on = std::get_if<bool>(&value)) return *is_on ? kOn : kOff;
  if (const auto* count = std::get_if<std::int64_t>(&value)) return std::to_string(*count);
  if (const auto* number = std::get_if<double>(&value)) return number_text(*number);
  return std::get<std::string>(value);
}

std::string allowed_text(const SettingText& text) {
  if (text.type == SettingType::kSwitch) return "on or off";
  if (text.type == SettingType::kWord) {
    std::string out;
    for (std::size_t i = 0; i < text.words.size(); ++i) {
      out += i == 0 ? "" : i + 1 == text.words.size() ? " or " : ", ";
      out += text.words[i];
    }
    return out;
  }
  std::string out =
      fmt::format("{} to {}", number_text(text.range.least), number_text(text.range.most));
  if (!text.unit.empty()) out += " " + text.unit;
  if (!text.absent.empty()) out += " or " + text.absent;
  return out;
}

rtapi::Result<SettingValue> check_value(const SettingText& text, const SettingValue& value) {
  if (text.type == SettingType::kSwitch) {
    if (std::holds_alternative<bool>(value)) return value;
  } else if (text.type == SettingType::kWord) {
    // A word may be a number: one of a few.
    const bool is_switch = std::holds_alternative<bool>(value);
    const auto& words = text.words;
    if (!is_switch && std::find(words.begin(), words.end(), value_text(value)) != words.end()) {
      return SettingValue(value_text(value));
    }
  } else {
    if (const auto* count = std::get_if<std::int64_t>(&value)) {
      return in_range(text, static_cast<double>(*count));
    }
    if (const auto* number = std::get_if<double>(&value)) return in_range(text, *number);
    if (const auto* word = std::get_if<std::string>(&value)) {
      if (!text.absent.empty() && *word == text.absent) return value;
      if (*word == kInfinite) return in_range(text, std::numeric_limits<double>::infinity());
    }
  }
  const bool is_word = std::holds_alternative<std::string>(value);
  return wrong(text, is_word ? quoted(std::get<std::string>(value)) : value_text(value));
}

rtapi::Result<SettingValue> parse_value(const SettingText& text, const std::string& value) {
  if (text.type == SettingType::kSwitch && (value == kOn || value == kOff)) {
    return SettingValue(value == kOn);
  }
  if (text.type == SettingType::kCount || text.type == SettingType::kNumber) {
    double number = 0;
    const char* end = value.data() + value.size();
    const auto read = std::from_chars(value.data(), end, number);
    if (read.ec == std::errc() && read.ptr == end) return in_range(text, number);
  }
  return check_value(text, SettingValue(value));
}

std::string nearest_name(const std::vector<std::string>& names, const std::string& mistyped) {
  std::string out;
  std::size_t least = std::max<std::size_t>(mistyped.size() / 2, 2) + 1;
  for (const std::string& name : names) {
    const std::size_t own = letters_apart(name, mistyped);
    if (own >= least) continue;
    least = own;
    out = name;
  }
  return out;
}

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
/// @file
/// Described settings: each member of a struct of settings with its name, unit, range and source.
/// Command lines, files of settings, their messages and their tables follow from the descriptions.
#pragma once

#include <rtapi/result.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace kaamos::effects {

/// The value of a setting: a switch, a count, a number (which may be infinite) or a word.
using SettingValue = std::variant<bool, std::int64_t, double, std::string>;

/// The kind of a setting's values.
enum class SettingType : std::uint8_t {
  kSwitch,  ///< on or off
  kCount,   ///< a whole number
  kNumber,  ///< any number, of single precision
  kWord,    ///< one of a few words
};

/// The least and the most that are allowed.
struct SettingRange {
  double least = 0;  ///< allowed itself
  double most = 0;   ///< allowed itself; infinity: "inf" is a value
};

/// Says what a setting is. Its default is that of the struct or of the registry's row.
struct SettingText {
  std::string name;                         ///< kebab case, without its technique: "slope-bias"
  SettingType type = SettingType::kSwitch;  ///< of its values
  SettingRange range = {};                  ///< of counts and numbers
  std::vector<std::string> words = {};      ///< of kWord, by value from 0
  std::string unit = {};                    ///< "m", "texels"; empty: none
  std::string about = {};                   ///< one line
  std::string source = {};  ///< where the default comes from, "Fernando 2005"; empty: this project
  std::string absent = {};  ///< a word in place of a count or number, "auto"; empty: none
};

/// A described setting of the struct T.
template <class T>
struct SettingOf {
  SettingText text;  ///< no name: set by its pass, and no setting of anybody's
  std::function<SettingValue(const T&)> get;              ///< reads it
  std::function<void(T&, const SettingValue&)> set = {};  ///< takes a value that check_value allows
  /// The part of T that it is kept in, bytes.
  ///@{
  std::size_t offset = 0;
  std::size_t size = 0;
  ///@}

  /// Returns whether it can be chosen.
  bool is_open() const { return !text.name.empty(); }
};

/// The settings of a struct, in the order in which they are listed.
template <class T>
using SettingTable = std::vector<SettingOf<T>>;

/// The value as command lines and tables have it: "on", "0.25", "inf", "pixels".
std::string value_text(const SettingValue& value);
/// The allowed values: "1 to 64 texels", "metres, pixels or line", "on or off".
std::string allowed_text(const SettingText& text);
/// Reads a value as command lines have it.
/// @errors KA3049 it is none of the setting's values; the message says what it has to be.
rtapi::Result<SettingValue> parse_value(const SettingText& text, const std::string& value);
/// Brings a value of another program into the setting's type: whole numbers are numbers too.
/// @errors KA3049 another type, or out of range.
rtapi::Result<SettingValue> check_value(const SettingText& text, const SettingValue& value);
/// The shortest decimal that is this number in single precision, in double precision.
double as_decimal(float value);
/// The one of these names that a mistyped one is closest to; empty: none is close.
std::string nearest_name(const std::vector<std::string>& names, const std::string& mistyped);

/// What a place of `table`'s struct of `size` bytes is not described by, as its offset; `size`:
/// everything is.
template <class T>
std::size_t first_undescribed(const SettingTable<T>& table, std::size_t size) {
  std::vector<bool> is_described(size);
  for (const SettingOf<T>& setting : table) {
    for (std::size_t i = 0; i < setting.size; ++i) is_described.at(setting.offset + i) = true;
  }
  const auto found = std::find(is_described.begin(), is_described.end(), false);
  return static_cast<std::size_t>(found - is_described.begin());
}

/// Where a member lies in its struct, bytes.
template <class T, class Member>
std::size_t offset_of(Member T::*member) {
  static const T whole{};
  return static_cast<std::size_t>(reinterpret_cast<const char*>(&(whole.*member)) -
                                  reinterpret_cast<const char*>(&whole));
}

/// Descriptions of members.
///@{
/// A whole number.
template <class T, class Member>
SettingOf<T> count_setting(std::string name, Member T::*member, SettingRange range,
                           std::string unit, std::string about, std::string source = {}) {
  static_assert(std::is_integral_v<Member>);
  return {{.name = std::move(name),
           .type = SettingType::kCount,
           .range = range,
           .unit = std::move(unit),
           .about = std::move(about),
           .source = std::move(source)},
          [member](const T& of) { return SettingValue(static_cast<std::int64_t>(of.*member)); },
          [member](T& of, const SettingValue& value) {
            of.*member = static_cast<Member>(std::get<std::int64_t>(value));
          },
          offset_of(member),
          sizeof(Member)};
}

/// A number.
template <class T>
SettingOf<T> number_setting(std::string name, float T::*member, SettingRange range,
                            std::string unit, std::string about, std::string source = {}) {
  return {{.name = std::move(name),
           .type = SettingType::kNumber,
           .range = range,
           .unit = std::move(unit),
           .about = std::move(about),
           .source = std::move(source)},
          [member](const T& of) { return SettingValue(as_decimal(of.*member)); },
          [member](T& of, const SettingValue& value) {
            of.*member = static_cast<float>(std::get<double>(value));
          },
          offset_of(member),
          sizeof(float)};
}

/// Bits of a member that are all set or not.
template <class T>
SettingOf<T> bits_setting(std::string name, std::uint32_t T::*member, std::uint32_t bits,
                          std::string about, std::string source = {}) {
  return {{.name = std::move(name), .about = std::move(about), .source = std::move(source)},
          [member, bits](const T& of) { return SettingValue((of.*member & bits) == bits); },
          [member, bits](T& of, const SettingValue& value) {
            of.*member = std::get<bool>(value) ? of.*member | bits : of.*member & ~bits;
          },
          offset_of(member),
          sizeof(std::uint32_t)};
}

/// A bool, or a word that is 0 or 1.
template <class T, class Member>
SettingOf<T> switch_setting(std::string name, Member T::*member, std::string about,
                            std::string source = {}) {
  static_assert(std::is_integral_v<Member>);
  return {{.name = std::move(name), .about = std::move(about), .source = std::move(source)},
          [member](const T& of) { return SettingValue(of.*member != Member(0)); },
          [member](T& of, const SettingValue& value) {
            of.*member = static_cast<Member>(std::get<bool>(value));
          },
          offset_of(member),
          sizeof(Member)};
}

/// An enumeration, or a number that is one, by a word for each value from 0 on.
template <class T, class Member>
SettingOf<T> word_setting(std::string name, Member T::*member, std::vector<std::string> words,
                          std::string about, std::string source = {}) {
  return {{.name = std::move(name),
           .type = SettingType::kWord,
           .words = words,
           .about = std::move(about),
           .source = std::move(source)},
          [member, words](const T& of) {
            return SettingValue(words.at(static_cast<std::size_t>(of.*member)));
          },
          [member, words](T& of, const SettingValue& value) {
            const auto found = std::find(words.begin(), words.end(), std::get<std::string>(value));
            of.*member = static_cast<Member>(found - words.begin());
          },
          offset_of(member),
          sizeof(Member)};
}

/// One of a few whole numbers.
template <class T>
SettingOf<T> choice_setting(std::string name, std::uint32_t T::*member,
                            std::vector<std::string> numbers, std::string about,
                            std::string source = {}) {
  SettingOf<T> out = word_setting(std::move(name), member, std::move(numbers), std::move(about),
                                  std::move(source));
  out.get = [member](const T& of) { return SettingValue(std::to_string(of.*member)); };
  out.set = [member](T& of, const SettingValue& value) {
    of.*member = static_cast<std::uint32_t>(std::stoul(std::get<std::string>(value)));
  };
  return out;
}

/// What the pass sets by itself, or what makes the technique what it is: nobody chooses it.
template <class T, class Member>
SettingOf<T> closed_setting(Member T::*member) {
  return {{}, {}, {}, offset_of(member), sizeof(Member)};
}
///@}

/// The settings of a member that is a struct itself.
template <class T, class Member>
SettingTable<T> settings_within(Member T::*member, const SettingTable<Member>& table) {
  SettingTable<T> out;
  for (const SettingOf<Member>& inner : table) {
    SettingOf<T>& setting = out.emplace_back();
    setting.text = inner.text;
    setting.offset = offset_of(member) + inner.offset;
    setting.size = inner.size;
    if (!inner.is_open()) continue;
    setting.get = [member, get = inner.get](const T& of) { return get(of.*member); };
    setting.set = [member, set = inner.set](T& of, const SettingValue& value) {
      set(of.*member, value);
    };
  }
  return out;
}

/// Adds settings behind others.
template <class T>
SettingTable<T> join_settings(SettingTable<T> table, SettingTable<T> others) {
  for (SettingOf<T>& setting : others) table.push_back(std::move(setting));
  return table;
}

/// The table with these settings closed: where they are without effect, or fixed.
template <class T>
SettingTable<T> close_settings(SettingTable<T> table, const std::vector<std::string_view>& names) {
  for (SettingOf<T>& setting : table) {
    if (std::find(names.begin(), names.end(), setting.text.name) != names.end()) setting.text = {};
  }
  return table;
}

}  // namespace kaamos::effects

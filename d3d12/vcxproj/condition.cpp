// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/condition.h"

#include <cctype>
#include <cstdlib>
#include <string>

#include "d3d12/vcxproj/paths.h"
#include "d3d12/vcxproj/text.h"

namespace kaamos::vcxproj {
namespace {

// Conditions are short; this many parentheses or negations inside one another are not.
constexpr int kDeepest = 100;

struct Unknown {};  // thrown within this file

class Parser {
 public:
  Parser(std::string_view text, const std::filesystem::path& folder)
      : text_(text), folder_(folder) {}

  bool whole() {
    const bool value = any_of();
    skip_space();
    if (at_ != text_.size()) throw Unknown();
    return value;
  }

 private:
  struct Operand {
    std::string text;
    bool quoted = false;
  };

  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }

  bool take(std::string_view token) {
    skip_space();
    if (!starts_with_any_case(text_.substr(at_), token)) return false;
    const size_t end = at_ + token.size();
    const bool word = std::isalpha(static_cast<unsigned char>(token.front())) != 0;
    if (word && end < text_.size() && std::isalnum(static_cast<unsigned char>(text_[end]))) {
      return false;
    }
    at_ = end;
    return true;
  }

  bool any_of() {
    bool value = all_of();
    while (take("or")) value = all_of() || value;
    return value;
  }

  bool all_of() {
    bool value = term();
    while (take("and")) value = term() && value;
    return value;
  }

  bool term() {
    if (++depth_ > kDeepest) throw Unknown();
    const bool value = term_inside();
    --depth_;
    return value;
  }

  bool term_inside() {
    skip_space();
    if (take("!")) return !term();
    if (take("(")) {
      const bool value = any_of();
      if (!take(")")) throw Unknown();
      return value;
    }
    const Operand left = operand();
    if (!left.quoted && take("(")) return call(left.text);
    if (take("==")) return equal(left.text, operand().text);
    if (take("!=")) return !equal(left.text, operand().text);
    if (take(">=")) return number(left.text) >= number(operand().text);
    if (take("<=")) return number(left.text) <= number(operand().text);
    if (take(">")) return number(left.text) > number(operand().text);
    if (take("<")) return number(left.text) < number(operand().text);
    return truth(left.text);
  }

  Operand operand() {
    skip_space();
    if (at_ < text_.size() && text_[at_] == '\'') {
      const size_t end = text_.find('\'', at_ + 1);
      if (end == std::string_view::npos) throw Unknown();
      Operand out{std::string(text_.substr(at_ + 1, end - at_ - 1)), true};
      at_ = end + 1;
      return out;
    }
    const size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) ||
                                  text_[at_] == '_' || text_[at_] == '.' || text_[at_] == '-')) {
      ++at_;
    }
    if (at_ == begin) throw Unknown();
    return {std::string(text_.substr(begin, at_ - begin)), false};
  }

  bool call(const std::string& name) {
    const std::string argument = operand().text;
    if (!take(")")) throw Unknown();
    if (same(name, "exists")) return !argument.empty() && find_path(folder_, argument).has_value();
    if (same(name, "hastrailingslash")) {
      return argument.ends_with('/') || argument.ends_with('\\');
    }
    throw Unknown();
  }

  static std::optional<double> as_number(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != 0) return std::nullopt;
    return value;
  }

  static double number(const std::string& text) {
    const std::optional<double> value = as_number(text);
    if (!value) throw Unknown();
    return *value;
  }

  // Numbers are compared by value: 17.0 is 17.
  static bool equal(const std::string& a, const std::string& b) {
    const std::optional<double> x = as_number(a), y = as_number(b);
    return x && y ? *x == *y : same(a, b);
  }

  static bool truth(const std::string& text) {
    for (const char* yes : {"true", "on", "yes"}) {
      if (same(text, yes)) return true;
    }
    for (const char* no : {"false", "off", "no"}) {
      if (same(text, no)) return false;
    }
    throw Unknown();
  }

  std::string_view text_;
  std::filesystem::path folder_;
  size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::optional<bool> evaluate_condition(std::string_view text, const std::filesystem::path& folder) {
  if (trim(text).empty()) return true;
  try {
    return Parser(text, folder).whole();
  } catch (const Unknown&) {
    return std::nullopt;
  }
}

}  // namespace kaamos::vcxproj

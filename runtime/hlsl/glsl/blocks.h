// SPDX-License-Identifier: MIT
//
// The text blocks that make up the GLSL prelude: how the files in runtime/hlsl/glsl/prelude are
// read, and how a block is expanded into the overloads that it stands for.
#pragma once

#include <cctype>
#include <deque>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kaamos::hlsl::glsl_blocks {

// Names of scalar kinds: b, i16, u16, i32, u32, i64, u64, f16, f32, f64.
using KindSet = std::set<std::string_view>;
// Kinds that need no capability of their own; overloads for other kinds are left out unless they
// are used.
extern const KindSet kOrdinary;
// Adds the kind that is named by a type, or by the end of a name in the prelude.
void add_kind_of_identifier(std::string_view word, KindSet& kinds);

enum class Expansion {
  kPlain,
  kEach,    // written for a scalar; vectors are done component by component
  kAny,     // $T is a scalar or a vector of any width
  kVector,  // widths 2 to 4
  kScalar,  // width 1
};

struct Block {
  std::string_view text;
  Expansion expansion = Expansion::kPlain;
  std::vector<std::string_view> kinds;
  std::vector<std::string_view> uses;  // names in the text
};

// The text of a block for the kinds that are wanted.
std::string expanded(const Block& block, const KindSet& kinds);

// All blocks, read once; constant afterwards.
class Library {
 public:
  static const Library& get();

  const std::vector<Block>* find(std::string_view name) const {
    const auto found = blocks_.find(name);
    return found != blocks_.end() ? &found->second : nullptr;
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  Library();
  void read(std::string_view source);
  void add(std::string_view header, std::string_view text);
  void add_alternatives(std::string_view names, std::string_view words, std::string_view text);
  void add_textures(std::span<const std::string_view> words, std::string_view text);
  void insert(std::string name, Block block);

  std::map<std::string, std::vector<Block>, std::less<>> blocks_;
  std::vector<std::string> names_;
  std::deque<std::string> generated_;  // the addresses of its elements stay valid
};

// Calls visit(word) for each identifier and keyword that is not in a line comment.
template <class Visit>
void each_identifier(std::string_view text, const Visit& visit) {
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
  };
  for (size_t i = 0; i < text.size();) {
    if (text[i] == '/' && i + 1 < text.size() && text[i + 1] == '/') {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (is_word(text[i])) {
      const size_t start = i;
      while (i < text.size() && is_word(text[i])) ++i;
      if (std::isdigit(static_cast<unsigned char>(text[start])) == 0) {
        visit(text.substr(start, i - start));
      }
    } else {
      ++i;
    }
  }
}

// The names k_* in a text, without duplicates.
std::vector<std::string_view> used_names(std::string_view text);

}  // namespace kaamos::hlsl::glsl_blocks

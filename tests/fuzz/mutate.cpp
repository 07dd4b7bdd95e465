// SPDX-License-Identifier: MIT
#include "mutate.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace kaamos::test {
namespace {

namespace fs = std::filesystem;
using Pieces = std::vector<std::string>;

constexpr size_t kMaxPieces = 20000;  // an input is a few times as large as the largest test

// Values and words that compilers have stumbled over, and tokens that open a nesting level.
const char* const kHurtful[] = {
    "0x7fffffff", "0x80000000", "0xffffffff", "4294967296", "18446744073709551615",
    "-1",         "1e38",       "1e-45",      "1e400",      "0.0",
    "inout",      "out",        "static",     "template<",  "typename",
    "[[",         "##",         "#",          "\\\n",       "\"",
    "'",          "/*",         "*/",         "\r\n",       "matrix",
    "vector<",    "this",       "operator",   "namespace",  "::",
    "sizeof(",    "(",          "{",          "[",          "?",
    ":",          "...",        "__VA_ARGS__"};

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

Pieces split(const std::string& text) {
  Pieces pieces;
  for (size_t at = 0; at < text.size();) {
    size_t end = at + 1;
    const bool word = is_word(text[at]);
    const bool space = text[at] == ' ';
    while (end < text.size() && ((word && is_word(text[end])) || (space && text[end] == ' '))) {
      ++end;
    }
    pieces.push_back(text.substr(at, end - at));
    at = end;
  }
  return pieces;
}

class Mutator {
 public:
  Mutator(const Corpus& corpus, uint64_t seed, uint64_t number)
      : corpus_(corpus), random_(seed * 0x9e3779b97f4a7c15u + number) {}

  Input run() {
    const CorpusFile& file = corpus_.files[below(corpus_.files.size())];
    pieces_ = file.pieces;
    const size_t changes = 1 + below(below(4) == 0 ? 40 : 4);
    for (size_t i = 0; i < changes; ++i) change();
    Input input;
    input.path = file.path;
    for (const std::string& piece : pieces_) input.text += piece;
    const size_t bytes = below(6) == 0 ? 1 + below(4) : 0;
    for (size_t i = 0; i < bytes; ++i) change_byte(input.text);
    if (below(40) == 0) input.text.resize(below(input.text.size() + 1));
    return input;
  }

 private:
  size_t below(size_t end) { return end == 0 ? 0 : static_cast<size_t>(random_() % end); }
  std::string any_token() {
    if (below(4) == 0) return kHurtful[below(std::size(kHurtful))];
    return corpus_.tokens[below(corpus_.tokens.size())];
  }
  Pieces::iterator place() {
    return pieces_.begin() + static_cast<ptrdiff_t>(below(pieces_.size()));
  }
  // A run of pieces from any file: often a few, sometimes a whole declaration.
  Pieces any_run() {
    const Pieces& from =
        below(2) == 0 ? pieces_ : corpus_.files[below(corpus_.files.size())].pieces;
    const size_t first = below(from.size());
    const size_t count = std::min(1 + below(below(3) == 0 ? 400 : 24), from.size() - first);
    const auto begin = from.begin() + static_cast<ptrdiff_t>(first);
    return {begin, begin + static_cast<ptrdiff_t>(count)};
  }

  void change() {
    if (pieces_.empty() || pieces_.size() > kMaxPieces) return;
    switch (below(9)) {
      case 0:
        pieces_.erase(place());
        break;
      case 1:
        *place() = any_token();
        break;
      case 2:
        pieces_.insert(place(), any_token());
        break;
      case 3:
        std::swap(*place(), *place());
        break;
      case 4: {
        const auto first = place();
        const auto left = static_cast<size_t>(pieces_.end() - first);
        pieces_.erase(first, first + static_cast<ptrdiff_t>(std::min(1 + below(30), left)));
        break;
      }
      case 5:
      case 6: {
        const Pieces run = any_run();
        pieces_.insert(place(), run.begin(), run.end());
        break;
      }
      case 7:
        rename_all();
        break;
      default:
        pieces_.insert(place(), below(20) == 0 ? 1 + below(3000) : 1 + below(6), any_token());
        break;
    }
  }

  // Replaces one name by another everywhere, which changes what types and functions mean.
  void rename_all() {
    const std::string from = *place();
    const std::string to = any_token();
    if (!is_word(from[0])) return;
    std::replace(pieces_.begin(), pieces_.end(), from, to);
  }

  void change_byte(std::string& text) {
    if (text.empty()) return;
    const size_t at = below(text.size());
    switch (below(3)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.insert(at, 1, static_cast<char>(below(256)));
        break;
      default:
        text.erase(at, 1);
        break;
    }
  }

  const Corpus& corpus_;
  std::mt19937_64 random_;
  Pieces pieces_;
};

}  // namespace

Corpus read_corpus(const std::vector<std::string>& folders) {
  std::vector<fs::path> paths;
  for (const std::string& folder : folders) {
    std::error_code missing;
    for (const auto& entry : fs::recursive_directory_iterator(folder, missing)) {
      const fs::path extension = entry.path().extension();
      if (extension == ".hlsl" || extension == ".hlsli") paths.push_back(entry.path());
    }
  }
  std::sort(paths.begin(), paths.end());
  Corpus corpus;
  for (const fs::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    corpus.texts[path.string()] = text.str();
    Pieces pieces = split(text.str());
    if (pieces.empty()) continue;
    for (const std::string& piece : pieces) {
      if (piece[0] != ' ' && piece[0] != '\n') corpus.tokens.push_back(piece);
    }
    if (path.extension() == ".hlsl") corpus.files.push_back({path.string(), std::move(pieces)});
  }
  return corpus;
}

Input mutated_input(const Corpus& corpus, uint64_t seed, uint64_t number) {
  return Mutator(corpus, seed, number).run();
}

}  // namespace kaamos::test

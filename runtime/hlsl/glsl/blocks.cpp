// SPDX-License-Identifier: MIT
#include "runtime/hlsl/glsl/blocks.h"

#include <algorithm>
#include <utility>

namespace kaamos::hlsl {

// The files of runtime/hlsl/glsl/prelude, names and texts (cmake/KaamosEmbed.cmake).
extern const std::pair<std::string_view, std::string_view> kGlslPreludeSources[];

namespace glsl_blocks {

const KindSet kOrdinary = {"b", "i32", "u32", "f32"};

namespace {

// ---------------------------------------------------------------------------------------------
// Types

struct Kind {
  std::string_view name;
  std::string_view scalar;
  std::string_view vector;  // before the width
};
constexpr Kind kKinds[] = {
    {"b", "bool", "bvec"},         {"i16", "int16_t", "i16vec"},   {"u16", "uint16_t", "u16vec"},
    {"i32", "int", "ivec"},        {"u32", "uint", "uvec"},        {"i64", "int64_t", "i64vec"},
    {"u64", "uint64_t", "u64vec"}, {"f16", "float16_t", "f16vec"}, {"f32", "float", "vec"},
    {"f64", "double", "dvec"},
};

const Kind* find_kind(std::string_view name) {
  for (const Kind& kind : kKinds) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

std::string type_name(const Kind& kind, int width) {
  if (width == 1) return std::string(kind.scalar);
  return std::string(kind.vector) + std::to_string(width);
}

// ---------------------------------------------------------------------------------------------
// Textures: a block for `textures` is written once for each dimension and number class.

struct Dimension {
  std::string_view name, glsl, location, texels, gradient, offset, number;
};
// location: the sampling coordinates; texels: coordinates of one texel, including the array
// element; gradient, offset: without the array element; number: D3D12_SRV_DIMENSION.
constexpr Dimension kDimensions[] = {
    {"1d", "1D", "float", "int", "float", "int", "2"},
    {"1d_array", "1DArray", "vec2", "ivec2", "float", "int", "3"},
    {"2d", "2D", "vec2", "ivec2", "vec2", "ivec2", "4"},
    {"2d_array", "2DArray", "vec3", "ivec3", "vec2", "ivec2", "5"},
    {"2d_ms", "2DMS", "vec2", "ivec2", "vec2", "ivec2", "6"},
    {"2d_ms_array", "2DMSArray", "vec3", "ivec3", "vec2", "ivec2", "7"},
    {"3d", "3D", "vec3", "ivec3", "vec3", "ivec3", "8"},
    {"cube", "Cube", "vec3", "ivec3", "vec3", "ivec3", "9"},
    {"cube_array", "CubeArray", "vec4", "ivec3", "vec3", "ivec3", "10"},
};
struct NumberClass {
  std::string_view name, prefix, texel;
};
constexpr NumberClass kClasses[] = {{"f", "", "vec4"}, {"i", "i", "ivec4"}, {"u", "u", "uvec4"}};

// ---------------------------------------------------------------------------------------------
// Expansion

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

// $T is the type, $S its scalar, $W the type its sums are kept in, $K the kind's name, $N the
// width. $i16 and the like are that kind with the same width; $B, $I, $U and $F are short for the
// common ones. $1 and $0 have all components 1 and 0.
std::string instantiate(std::string_view text, const Kind& kind, int width) {
  std::string out(text);
  replace_all(out, "$T", type_name(kind, width));
  replace_all(out, "$S", kind.scalar);
  replace_all(out, "$W", kind.name == "f16" ? "float" : kind.scalar);
  replace_all(out, "$K", kind.name);
  replace_all(out, "$N", std::to_string(width));
  for (const Kind& other : kKinds) {
    if (other.name.size() > 1) {
      replace_all(out, "$" + std::string(other.name), type_name(other, width));
    }
  }
  replace_all(out, "$B", type_name(*find_kind("b"), width));
  replace_all(out, "$I", type_name(*find_kind("i32"), width));
  replace_all(out, "$U", type_name(*find_kind("u32"), width));
  replace_all(out, "$F", type_name(*find_kind("f32"), width));
  replace_all(out, "$0", type_name(kind, width) + "(0)");
  replace_all(out, "$1", type_name(kind, width) + "(1)");
  return out;
}

// The vector form of the scalar function whose header is at the start of `text`.
std::string each_component(std::string_view text, int width) {
  const size_t open = text.find('('), close = text.find(')');
  if (open == std::string_view::npos || close == std::string_view::npos) return {};
  std::vector<std::string_view> words;
  each_identifier(text.substr(0, close), [&](std::string_view word) { words.push_back(word); });
  const auto widened = [&](std::string_view scalar) {
    for (const Kind& kind : kKinds) {
      if (kind.scalar == scalar) return type_name(kind, width);
    }
    return std::string(scalar);
  };
  const std::string result = widened(words[0]), name(words[1]);
  std::string head = result + " " + name + "(";
  std::string body;
  for (int c = 0; c < width; ++c) {
    std::string call = name + "(";
    for (size_t i = 2; i + 1 < words.size(); i += 2) {
      call += (i > 2 ? ", " : "") + std::string(words[i + 1]) + "." + "xyzw"[c];
    }
    body += (c > 0 ? ", " : "") + call + ")";
  }
  for (size_t i = 2; i + 1 < words.size(); i += 2) {
    head += (i > 2 ? ", " : "") + widened(words[i]) + " " + std::string(words[i + 1]);
  }
  return head + ") { return " + result + "(" + body + "); }\n";
}

void append(std::vector<std::string_view>& to, std::initializer_list<std::string_view> kinds) {
  to.insert(to.end(), kinds);
}

}  // namespace

void add_kind_of_identifier(std::string_view word, KindSet& kinds) {
  for (const Kind& kind : kKinds) {
    const bool vector = word.size() == kind.vector.size() + 1 && word.starts_with(kind.vector);
    const bool suffix = word.starts_with("k_") && word.ends_with(kind.name) &&
                        word[word.size() - kind.name.size() - 1] == '_';
    if (word == kind.scalar || vector || suffix) kinds.insert(kind.name);
  }
  // Their results may go on without a variable, so that no other word names the type.
  constexpr std::pair<std::string_view, std::string_view> kResults[] = {
      {"k_asdouble", "f64"}, {"k_asfloat16", "f16"}, {"k_asint16", "i16"}, {"k_asuint16", "u16"}};
  for (const auto& [function, kind] : kResults) {
    if (word == function) kinds.insert(kind);
  }
}

std::vector<std::string_view> used_names(std::string_view text) {
  std::vector<std::string_view> names;
  each_identifier(text, [&](std::string_view word) {
    if (word.starts_with("k_") && std::find(names.begin(), names.end(), word) == names.end()) {
      names.push_back(word);
    }
  });
  return names;
}

std::string expanded(const Block& block, const KindSet& kinds) {
  if (block.expansion == Expansion::kPlain) return std::string(block.text);
  std::string out;
  for (const std::string_view name : block.kinds) {
    if (!kinds.contains(name)) continue;
    const Kind& kind = *find_kind(name);
    switch (block.expansion) {
      case Expansion::kEach: {
        const std::string scalar = instantiate(block.text, kind, 1);
        out += scalar;
        for (int width = 2; width <= 4; ++width) out += each_component(scalar, width);
        break;
      }
      case Expansion::kScalar:
        out += instantiate(block.text, kind, 1);
        break;
      default:
        for (int width = block.expansion == Expansion::kAny ? 1 : 2; width <= 4; ++width) {
          out += instantiate(block.text, kind, width);
        }
    }
  }
  return out;
}

// ---------------------------------------------------------------------------------------------
// The library

const Library& Library::get() {
  static const Library library;
  return library;
}

Library::Library() {
  for (const auto* source = kGlslPreludeSources; !source->first.empty(); ++source) {
    read(source->second);
  }
}

// A block begins with a line `//@ name words`; everything before the first block is a comment.
void Library::read(std::string_view source) {
  constexpr std::string_view kMark = "//@ ";
  size_t at = source.find(kMark);
  while (at != std::string_view::npos) {
    const size_t line_end = std::min(source.find('\n', at), source.size() - 1);
    const size_t next = source.find(kMark, line_end);
    const size_t end = next == std::string_view::npos ? source.size() : next;
    add(source.substr(at + kMark.size(), line_end - at - kMark.size()),
        source.substr(line_end + 1, end - line_end - 1));
    at = next;
  }
}

void Library::add(std::string_view header, std::string_view text) {
  std::vector<std::string_view> words;
  for (size_t i = 0; i < header.size();) {
    const size_t end = std::min(header.find(' ', i), header.size());
    if (end > i) words.push_back(header.substr(i, end - i));
    i = end + 1;
  }
  if (words.empty()) return;
  if (words[0].find('$') != std::string_view::npos) {
    add_textures(words, text);
    return;
  }
  if (words[0].find(',') != std::string_view::npos) {
    add_alternatives(words[0], header.substr(words[0].size()), text);
    return;
  }
  Block block{text, Expansion::kPlain, {}, used_names(text)};
  for (const std::string_view word : std::span(words).subspan(1)) {
    if (find_kind(word) != nullptr) block.kinds.push_back(word);
    if (word == "ints") append(block.kinds, {"i32", "u32", "i16", "u16", "i64", "u64"});
    if (word == "floats") append(block.kinds, {"f32", "f16", "f64"});
    if (word == "each") block.expansion = Expansion::kEach;
    if (word == "any") block.expansion = Expansion::kAny;
    if (word == "vector") block.expansion = Expansion::kVector;
    if (word == "scalar") block.expansion = Expansion::kScalar;
  }
  insert(std::string(words[0]), std::move(block));
}

// `k_sin,k_cos words`: one block per name; $NAME is the name, $BASE the part after its k_.
void Library::add_alternatives(std::string_view names, std::string_view words,
                               std::string_view text) {
  for (size_t i = 0; i < names.size();) {
    const size_t end = std::min(names.find(',', i), names.size());
    const std::string_view name = names.substr(i, end - i);
    std::string& stored = generated_.emplace_back(text);
    replace_all(stored, "$NAME", name);
    replace_all(stored, "$BASE", name.substr(2));
    const std::string& header = generated_.emplace_back(std::string(name) + std::string(words));
    add(header, stored);
    i = end + 1;
  }
}

// `k_name_$D_$C 2d 3d f`: the words name the dimensions and classes; without them, all are meant.
void Library::add_textures(std::span<const std::string_view> words, std::string_view text) {
  const auto wanted = [&](std::string_view name, bool is_class) {
    bool any = false;
    for (const std::string_view word : words.subspan(1)) {
      if ((word.size() == 1) != is_class) continue;
      any = true;
      if (word == name) return true;
    }
    return !any;
  };
  for (const Dimension& dimension : kDimensions) {
    if (!wanted(dimension.name, false)) continue;
    for (const NumberClass& number : kClasses) {
      if (!wanted(number.name, true)) continue;
      const auto substituted = [&](std::string_view from) {
        std::string out(from);
        replace_all(out, "$DIM", dimension.glsl);
        replace_all(out, "$D", dimension.name);
        replace_all(out, "$C", number.name);
        replace_all(out, "$P", number.prefix);
        replace_all(out, "$V", number.texel);
        replace_all(out, "$L", dimension.location);
        replace_all(out, "$X", dimension.texels);
        replace_all(out, "$G", dimension.gradient);
        replace_all(out, "$O", dimension.offset);
        replace_all(out, "$R", dimension.number);
        return out;
      };
      const std::string name = substituted(words[0]);
      if (words[0].find("$C") == std::string_view::npos && number.name != "f") continue;
      const std::string& stored = generated_.emplace_back(substituted(text));
      insert(name, {stored, Expansion::kPlain, {}, used_names(stored)});
    }
  }
}

void Library::insert(std::string name, Block block) {
  auto& list = blocks_[name];
  if (list.empty()) names_.push_back(name);
  list.push_back(std::move(block));
}

}  // namespace glsl_blocks
}  // namespace kaamos::hlsl

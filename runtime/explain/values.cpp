// SPDX-License-Identifier: MIT
#include "runtime/explain/values.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <string_view>

#include "kaamos/shader/half.h"

namespace kaamos::explain {
namespace {

template <class T>
T read(const uint8_t* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

template <class T>
std::string shortest(T value) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

struct ScalarKind {
  std::string_view name;
  uint32_t bytes;
  std::string (*text)(const uint8_t*);
};

constexpr ScalarKind kScalars[] = {
    {"bool", 1, [](const uint8_t* p) { return std::string(*p != 0 ? "true" : "false"); }},
    {"int16_t", 2, [](const uint8_t* p) { return shortest(read<int16_t>(p)); }},
    {"uint16_t", 2, [](const uint8_t* p) { return shortest(read<uint16_t>(p)); }},
    {"int", 4, [](const uint8_t* p) { return shortest(read<int32_t>(p)); }},
    {"uint", 4, [](const uint8_t* p) { return shortest(read<uint32_t>(p)); }},
    {"int64_t", 8, [](const uint8_t* p) { return shortest(read<int64_t>(p)); }},
    {"uint64_t", 8, [](const uint8_t* p) { return shortest(read<uint64_t>(p)); }},
    {"float16_t", 2,
     [](const uint8_t* p) { return shortest(shader::to_float(read<shader::half>(p))); }},
    {"float", 4, [](const uint8_t* p) { return shortest(read<float>(p)); }},
    {"double", 8, [](const uint8_t* p) { return shortest(read<double>(p)); }},
};

// Parses "float3x4": the scalar's name, then the components of a vector or the rows and columns of
// a matrix. The longest name wins, because "int16_t" begins with "int".
const ScalarKind* parse_type(std::string_view type, uint32_t& components) {
  const ScalarKind* found = nullptr;
  for (const ScalarKind& kind : kScalars) {
    if (type.starts_with(kind.name) &&
        (found == nullptr || kind.name.size() > found->name.size())) {
      found = &kind;
    }
  }
  components = 1;
  if (found == nullptr) return nullptr;
  for (const char c : type.substr(found->name.size())) {
    if (c >= '1' && c <= '4') components *= static_cast<uint32_t>(c - '0');
  }
  return found;
}

std::vector<rtapi::ExplainedValue> decode_words(const uint8_t* bytes, uint32_t byte_count) {
  std::vector<rtapi::ExplainedValue> out;
  for (uint32_t at = 0; at + 4 <= byte_count; at += 4) {
    char text[16];
    std::snprintf(text, sizeof text, "0x%08x", read<uint32_t>(bytes + at));
    out.push_back({"+" + std::to_string(at), "uint", text});
  }
  return out;
}

std::string_view next_word(std::string_view& rest, char end) {
  const size_t at = std::min(rest.find(end), rest.size());
  const std::string_view word = rest.substr(0, at);
  rest.remove_prefix(std::min(at + 1, rest.size()));
  return word;
}

}  // namespace

std::string number_text(float value) {
  return shortest(value);
}

std::vector<rtapi::ExplainedValue> decode_values(const char* layout, const void* bytes,
                                                 uint32_t byte_count) {
  const auto* from = static_cast<const uint8_t*>(bytes);
  if (from == nullptr) return {};
  if (layout == nullptr || *layout == '\0') return decode_words(from, byte_count);
  std::vector<rtapi::ExplainedValue> out;
  std::string_view rest = layout;
  while (!rest.empty()) {
    std::string_view field = next_word(rest, ';');
    const std::string_view type = next_word(field, ' ');
    const std::string_view name = next_word(field, ' ');
    uint32_t offset = UINT32_MAX;
    std::from_chars(field.data(), field.data() + field.size(), offset);
    uint32_t components = 0;
    const ScalarKind* kind = parse_type(type, components);
    if (kind == nullptr || offset > byte_count || components * kind->bytes > byte_count - offset) {
      continue;
    }
    std::string text;
    for (uint32_t i = 0; i < components; ++i) {
      text += (i == 0 ? "" : " ") + kind->text(from + offset + i * kind->bytes);
    }
    out.push_back({std::string(name), std::string(type), std::move(text)});
  }
  return out;
}

std::string ray_flags_text(uint32_t flags) {
  constexpr const char* kNames[] = {"FORCE_OPAQUE",
                                    "FORCE_NON_OPAQUE",
                                    "ACCEPT_FIRST_HIT_AND_END_SEARCH",
                                    "SKIP_CLOSEST_HIT_SHADER",
                                    "CULL_BACK_FACING_TRIANGLES",
                                    "CULL_FRONT_FACING_TRIANGLES",
                                    "CULL_OPAQUE",
                                    "CULL_NON_OPAQUE",
                                    "SKIP_TRIANGLES",
                                    "SKIP_PROCEDURAL_PRIMITIVES",
                                    "FORCE_OMM_2_STATE"};
  if (flags == 0) return "NONE";
  std::string text;
  for (uint32_t bit = 0; bit < 32; ++bit) {
    if ((flags >> bit & 1u) == 0) continue;
    if (!text.empty()) text += " | ";
    char number[16];
    std::snprintf(number, sizeof number, "0x%x", 1u << bit);
    text += bit < std::size(kNames) ? kNames[bit] : number;
  }
  return text;
}

}  // namespace kaamos::explain

// SPDX-License-Identifier: MIT
#include "runtime/hlsl/glsl/prelude.h"

#include <algorithm>
#include <set>

#include "runtime/hlsl/glsl/blocks.h"

namespace kaamos::hlsl {

using namespace glsl_blocks;

namespace {

// Depth first, so that a definition comes before its uses.
class Selection {
 public:
  explicit Selection(const KindSet& kinds) : kinds_(kinds) {}

  // Returns false if nothing defines it.
  bool add(std::string_view name) {
    const std::vector<Block>* blocks = Library::get().find(name);
    if (blocks == nullptr) return false;
    if (!done_.insert(std::string(name)).second) return true;
    for (const Block& block : *blocks) {
      const bool used = block.expansion == Expansion::kPlain ||
                        std::any_of(block.kinds.begin(), block.kinds.end(),
                                    [&](std::string_view kind) { return kinds_.contains(kind); });
      if (!used) continue;
      for (const std::string_view use : block.uses) add(use);
    }
    for (const Block& block : *blocks) text_ += expanded(block, kinds_);
    return true;
  }

  std::string take_text() { return std::move(text_); }

 private:
  const KindSet& kinds_;
  std::set<std::string, std::less<>> done_;
  std::string text_;
};

constexpr std::string_view kExtensions =
    "#extension GL_EXT_buffer_reference : require\n"
    "#extension GL_EXT_nonuniform_qualifier : require\n"
    "#extension GL_EXT_samplerless_texture_functions : require\n"
    "#extension GL_EXT_scalar_block_layout : require\n"
    "#extension GL_EXT_shader_16bit_storage : require\n"
    "#extension GL_EXT_shader_atomic_int64 : require\n"
    "#extension GL_EXT_shader_explicit_arithmetic_types_float16 : require\n"
    "#extension GL_EXT_shader_explicit_arithmetic_types_int16 : require\n"
    "#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require\n"
    "#extension GL_EXT_shader_image_load_formatted : require\n"
    "#extension GL_EXT_spirv_intrinsics : require\n";

}  // namespace

GlslPrelude glsl_prelude(std::string_view body) {
  KindSet kinds = kOrdinary;
  std::vector<std::string_view> names;
  each_identifier(body, [&](std::string_view word) { add_kind_of_identifier(word, kinds); });
  GlslPrelude prelude;
  Selection selection(kinds);
  for (const std::string_view name : used_names(body)) {
    if (!selection.add(name)) prelude.missing.emplace_back(name);
  }
  prelude.text = std::string(kExtensions) + selection.take_text();
  return prelude;
}

std::vector<std::string> glsl_prelude_names() {
  return Library::get().names();
}

}  // namespace kaamos::hlsl

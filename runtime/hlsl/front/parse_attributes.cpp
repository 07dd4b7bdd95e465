// SPDX-License-Identifier: MIT
// [numthreads(8, 8, 1)], [[vk::binding(0)]].
#include <algorithm>
#include <cctype>

#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {
namespace {

// In lower case: HLSL ignores the case of attributes.
constexpr std::string_view kKnown[] = {
    "allow_uav_condition",
    "allowsparsenodes",
    "branch",
    "call",
    "cases",
    "clipplanes",
    "dispatch",
    "domain",
    "earlydepthstencil",
    "experimental",
    "fastopt",
    "flatten",
    "forcecase",
    "groupsharedlimit",
    "instance",
    "loop",
    "maxrecords",
    "maxrecordssharedwith",
    "maxtessfactor",
    "maxvertexcount",
    "nodearraysize",
    "nodedispatchgrid",
    "nodeid",
    "nodeisprogramentry",
    "nodelaunch",
    "nodelocalrootargumentstableindex",
    "nodemaxdispatchgrid",
    "nodemaxrecursiondepth",
    "nodeshareinputof",
    "nodetrackrwinputsharing",
    "noinline",
    "numthreads",
    "outputcontrolpoints",
    "outputtopology",
    "partitioning",
    "patchconstantfunc",
    "raypayload",
    "rootsignature",
    "shader",
    "skip",
    "test",
    "unboundedsparsenodes",
    "unroll",
    "waveopsincludehelperlanes",
    "wavesize",
};

// DXC's attributes for SPIR-V, and what their absence means.
struct VkAttribute {
  std::string_view name;
  std::string_view instead;
};
constexpr std::string_view kRegister = "the register decides where it is bound";
constexpr std::string_view kInstruction = "SPIR-V instructions cannot be written by hand";
constexpr std::string_view kPixel = "it is for pixel shaders";
constexpr VkAttribute kVkAttributes[] = {
    {"aliased_pointer", "there are no pointers"},
    {"binding", kRegister},
    {"builtin", "semantics decide what a variable holds"},
    {"combinedImageSampler", "texture and sampler have registers of their own"},
    {"constant_id", "the initialiser is the value"},
    {"counter_binding", "a counter belongs to the view of its buffer"},
    {"depth_unchanged", kPixel},
    {"early_and_late_tests", kPixel},
    {"ext_builtin_input", kInstruction},
    {"ext_builtin_output", kInstruction},
    {"ext_capability", kInstruction},
    {"ext_decorate", kInstruction},
    {"ext_decorate_id", kInstruction},
    {"ext_decorate_string", kInstruction},
    {"ext_extension", kInstruction},
    {"ext_instruction", kInstruction},
    {"ext_literal", kInstruction},
    {"ext_reference", kInstruction},
    {"ext_storage_class", kInstruction},
    {"ext_type_def", kInstruction},
    {"image_format", "the view decides the format"},
    {"index", kPixel},
    {"input_attachment_index", kPixel},
    {"location", "semantics connect the stages"},
    {"offset", "HLSL's packing rules and packoffset decide the layout"},
    {"post_depth_coverage", kPixel},
    {"push_constant", kRegister},
    {"shader_record_ext", "the local root signature decides what is in the shader record"},
    {"shader_record_nv", "the local root signature decides what is in the shader record"},
    {"spvexecutionmode", kInstruction},
    {"stencil_ref_greater_equal_back", kPixel},
    {"stencil_ref_greater_equal_front", kPixel},
    {"stencil_ref_less_equal_back", kPixel},
    {"stencil_ref_less_equal_front", kPixel},
    {"stencil_ref_unchanged_back", kPixel},
    {"stencil_ref_unchanged_front", kPixel},
};

const VkAttribute* find_vk(const Attribute& attribute) {
  if (attribute.scope != "vk") return nullptr;
  const auto* found = std::find_if(std::begin(kVkAttributes), std::end(kVkAttributes),
                                   [&](const VkAttribute& a) { return a.name == attribute.name; });
  return found == std::end(kVkAttributes) ? nullptr : found;
}

bool is_known(const Attribute& attribute) {
  if (!attribute.scope.empty()) return false;
  std::string lower(attribute.name);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::find(std::begin(kKnown), std::end(kKnown), lower) != std::end(kKnown);
}

}  // namespace

void Parser::attributes(std::vector<Attribute>& out) {
  while (!panic_ && at_attribute()) {
    const size_t open = pos_;
    advance();
    const size_t inner = pos_;
    const bool is_double = accept(Kind::kLeftBracket);
    // A lambda used as a statement.
    if (!is_double && (at(Kind::kRightBracket) || at(Kind::kAmp) || at(Kind::kEqual))) {
      fail(DiagnosticId::kNoLambda, token_at(open).location, {});
      return;
    }
    do {
      const Attribute found = attribute(is_double);
      if (panic_) return;
      if (const VkAttribute* vk = find_vk(found)) {
        // A library may have hundreds, all for the same reason.
        if (vk_attributes_.insert(vk->name).second) {
          report(DiagnosticId::kVkAttributeIgnored, found.location, {vk->name, vk->instead});
        }
      } else if (!is_known(found)) {
        const std::string scope(found.scope.empty() ? "" : std::string(found.scope) + "::");
        report(DiagnosticId::kUnknownAttribute, found.location, {scope + std::string(found.name)});
      }
      out.push_back(found);
    } while (accept(Kind::kComma));
    if (is_double) expect_closing(Kind::kRightBracket, inner, "the attribute");
    expect_closing(Kind::kRightBracket, open, "the attribute");
  }
}

Attribute Parser::attribute(bool is_double) {
  Attribute result{.location = here(), .scope = {}, .name = {}, .arguments = {}};
  result.is_double_bracket = is_double;
  // Any word: `[loop]`, but also keywords such as `[export]`.
  const auto word = [&]() -> const Token* {
    const bool is_word = at_name() || is_keyword(token().kind) || at(Kind::kReservedWord);
    if (!is_word) {
      fail_here(DiagnosticId::kExpectedName, {"an attribute", describe(token())});
      return nullptr;
    }
    const Token* name = &token();
    advance();
    return name;
  };
  const Token* name = word();
  if (name == nullptr) return result;
  if (accept(Kind::kColonColon)) {
    result.scope = name->text;
    name = word();
    if (name == nullptr) return result;
  }
  result.location = name->location;
  result.name = name->text;
  if (at(Kind::kLeftParen)) result.arguments = call_arguments();
  return result;
}

void Parser::reject_attributes(std::span<const Attribute> found, std::string_view before) {
  if (found.empty()) return;
  report(DiagnosticId::kAttributeOnNothing, found.back().location,
         {found.back().name, before, describe(token())});
}

}  // namespace kaamos::hlsl

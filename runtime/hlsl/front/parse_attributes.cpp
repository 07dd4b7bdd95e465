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
    "branch",
    "call",
    "clipplanes",
    "domain",
    "earlydepthstencil",
    "experimental",
    "fastopt",
    "flatten",
    "forcecase",
    "instance",
    "loop",
    "maxtessfactor",
    "maxvertexcount",
    "noinline",
    "numthreads",
    "outputcontrolpoints",
    "outputtopology",
    "partitioning",
    "patchconstantfunc",
    "raypayload",
    "rootsignature",
    "shader",
    "unroll",
    "waveopsincludehelperlanes",
    "wavesize",
};

bool is_known(const Attribute& attribute) {
  if (attribute.scope == "vk") return true;
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
      if (!is_known(found)) {
        report(DiagnosticId::kUnknownAttribute, found.location, {found.name});
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

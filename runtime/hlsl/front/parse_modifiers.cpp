// SPDX-License-Identifier: MIT
// The modifiers before a type, and where each may stand.
#include <bit>

#include "runtime/hlsl/front/parser.h"

namespace kaamos::hlsl {
namespace {

Modifiers modifier_of(TokenKind kind) {
  switch (kind) {
    case TokenKind::kConst:
      return kModConst;
    case TokenKind::kVolatile:
      return kModVolatile;
    case TokenKind::kRowMajor:
      return kModRowMajor;
    case TokenKind::kColumnMajor:
      return kModColumnMajor;
    case TokenKind::kSnorm:
      return kModSnorm;
    case TokenKind::kUnorm:
      return kModUnorm;
    case TokenKind::kStatic:
      return kModStatic;
    case TokenKind::kExtern:
      return kModExtern;
    case TokenKind::kUniform:
      return kModUniform;
    case TokenKind::kGroupshared:
      return kModGroupshared;
    case TokenKind::kPrecise:
      return kModPrecise;
    case TokenKind::kGloballyCoherent:
      return kModGloballyCoherent;
    case TokenKind::kInline:
      return kModInline;
    case TokenKind::kExport:
      return kModExport;
    case TokenKind::kIn:
      return kModIn;
    case TokenKind::kOut:
      return kModOut;
    case TokenKind::kInout:
      return kModIn | kModOut;
    case TokenKind::kNoInterpolation:
      return kModNoInterpolation;
    case TokenKind::kLinear:
      return kModLinear;
    case TokenKind::kCentroid:
      return kModCentroid;
    case TokenKind::kNoPerspective:
      return kModNoPerspective;
    case TokenKind::kSample:
      return kModSample;
    case TokenKind::kShared:
      return kModShared;
    case TokenKind::kCenter:
      return kModCenter;
    case TokenKind::kReorderCoherent:
      return kModReorderCoherent;
    case TokenKind::kPoint:
      return kModPoint;
    case TokenKind::kLine:
      return kModLine;
    case TokenKind::kLineAdj:
      return kModLineAdj;
    case TokenKind::kTriangle:
      return kModTriangle;
    case TokenKind::kTriangleAdj:
      return kModTriangleAdj;
    case TokenKind::kIndices:
    case TokenKind::kVertices:
    case TokenKind::kPrimitives:
    case TokenKind::kPayload:
      return kModMesh;
    default:
      return 0;
  }
}

struct Conflict {
  Modifiers first;
  std::string_view first_text;
  Modifiers second;
  std::string_view second_text;
};

constexpr Conflict kConflicts[] = {
    {kModRowMajor, "row_major", kModColumnMajor, "column_major"},
    {kModSnorm, "snorm", kModUnorm, "unorm"},
    {kModStatic, "static", kModExtern, "extern"},
    {kModStatic, "static", kModUniform, "uniform"},
    {kModNoInterpolation, "nointerpolation", kModLinear, "linear"},
};

// `sample = 3;` uses the word as a name; `point.x` means it as one, though it cannot be.
bool looks_like_name(TokenKind kind) {
  switch (kind) {
    case TokenKind::kCentroid:
    case TokenKind::kLine:
    case TokenKind::kLineAdj:
    case TokenKind::kLinear:
    case TokenKind::kPoint:
    case TokenKind::kShared:
    case TokenKind::kSnorm:
    case TokenKind::kTriangle:
    case TokenKind::kTriangleAdj:
    case TokenKind::kUnorm:
      return true;
    default:
      return is_contextual_keyword(kind);
  }
}

// The places where DXC allows a modifier. [DXC: DiagnoseHLSLDecl]
enum Place : uint8_t {
  kGlobal = 1,
  kLocal = 2,
  kField = 4,
  kParameter = 8,
  kFunction = 16,
  kMethod = 32,
};

struct Placement {
  Modifiers modifier;
  uint8_t places;
  std::string_view allowed;  // What the message says.
};

constexpr Placement kPlacements[] = {
    {kModIn | kModOut, kParameter, "parameters"},
    {kModPrimitive, kParameter, "parameters of geometry shaders"},
    {kModMesh, kParameter, "parameters of mesh shaders"},
    {kModNoInterpolation | kModLinear | kModCentroid | kModNoPerspective | kModSample | kModCenter,
     kParameter | kField | kFunction | kMethod, "fields, parameters and functions"},
    {kModShared, kGlobal, "global variables"},
    {kModGroupshared, kGlobal | kParameter, "global variables"},
    {kModUniform, kGlobal | kParameter, "global variables and parameters"},
    {kModExtern, kGlobal | kFunction, "global variables and functions"},
    {kModStatic, kGlobal | kLocal | kField | kFunction | kMethod,
     "variables, fields and functions"},
    {kModVolatile, kLocal, "local variables"},
    {kModExport, kFunction, "functions"},
    {kModInline, kFunction | kMethod, "functions"},
};

}  // namespace

Modifiers Parser::modifier_at(size_t index) const {
  const Kind kind = token_at(index).kind;
  const Modifiers modifier = modifier_of(kind);
  if (looks_like_name(kind) && !can_begin_type(token_at(index + 1).kind)) return 0;
  return modifier;
}

void Parser::add_modifier(Modifiers& modifiers, Modifiers added, const Token& word) {
  // `in out` means `inout`.
  const bool repeats = (modifiers & added) == added;
  if (repeats) report(DiagnosticId::kModifierTwice, word.location, {word.text});
  const Modifiers both = modifiers | added;
  for (const Conflict& conflict : kConflicts) {
    const bool was_in = (modifiers & conflict.first) && (modifiers & conflict.second);
    if ((both & conflict.first) && (both & conflict.second) && !was_in) {
      report(DiagnosticId::kModifierConflict, word.location,
             {conflict.first_text, conflict.second_text});
      return;
    }
  }
  for (size_t bit = 0; bit < kModifierCount; ++bit) {
    if (added >> bit & 1) modifier_words_[bit] = &word;
  }
  modifiers = both;
}

void Parser::check_modifiers(Modifiers modifiers, Declared declared) {
  if (panic_) return;
  const auto place = static_cast<uint8_t>(1u << static_cast<uint8_t>(declared));
  constexpr std::string_view kNames[] = {"a global variable", "a local variable", "a field",
                                         "a parameter",       "a function",       "a method"};
  const auto refuse = [&](Modifiers wrong, std::string_view allowed) {
    const Token& word = *modifier_words_[std::countr_zero(wrong)];
    report(DiagnosticId::kModifierPlace, word.location,
           {word.text, kNames[static_cast<size_t>(declared)], allowed});
  };
  for (const Placement& placement : kPlacements) {
    const Modifiers found = modifiers & placement.modifier;
    if (found != 0 && (placement.places & place) == 0) refuse(found, placement.allowed);
  }
  const bool is_constant_field = declared == Declared::kField && (modifiers & kModConst) != 0;
  if (is_constant_field && (modifiers & kModStatic) == 0) {
    refuse(kModConst, "static fields and everything outside of structs");
  }
}

void Parser::parse_modifiers(Modifiers& modifiers) {
  for (;;) {
    if (const Modifiers added = modifier_at(pos_); added != 0) {
      add_modifier(modifiers, added, token());
    } else if (at(Kind::kReservedWord) &&
               (token().text == "virtual" || token().text == "mutable" ||
                token().text == "friend" || token().text == "explicit")) {
      const bool is_virtual = token().text == "virtual";
      report(is_virtual ? DiagnosticId::kNoVirtual : DiagnosticId::kReservedWord, here(),
             {token().text});
    } else {
      return;
    }
    advance();
  }
}

}  // namespace kaamos::hlsl

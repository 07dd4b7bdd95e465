// SPDX-License-Identifier: MIT
// Every diagnostic of the HLSL compiler: number, severity, text. Each stage has its own
// diagnostic_ids_*.inc. A number never changes its meaning.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace kaamos::hlsl {

enum class Severity : uint8_t { kNote, kWarning, kError };

enum class DiagnosticId : uint16_t {
#define KAAMOS_DIAGNOSTIC(number, name, severity, text, cure) name = number,
#include "runtime/hlsl/front/diagnostic_ids_preprocess.inc"

#include "runtime/hlsl/front/diagnostic_ids_parse.inc"

#include "runtime/hlsl/front/diagnostic_ids_check.inc"

#include "runtime/hlsl/front/diagnostic_ids_emit.inc"
#undef KAAMOS_DIAGNOSTIC
};

enum class DiagnosticClass : uint8_t {
  kError,
  kWarning,
  kStrict,  // A warning, or an error with --strict.
};

struct DiagnosticInfo {
  DiagnosticId id;
  std::string_view name;  // The enumerator.
  DiagnosticClass severity;
  std::string_view text;  // {0}, {1}, ... are placeholders for the arguments.
  std::string_view cure;  // What to write instead; not part of the message.
};

// All, in the order of their numbers.
std::span<const DiagnosticInfo> diagnostic_table();
const DiagnosticInfo& diagnostic_info(DiagnosticId id);

}  // namespace kaamos::hlsl

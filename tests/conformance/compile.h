// SPDX-License-Identifier: MIT
//
// Rules that the HLSL compiler enforces: sources that it accepts or refuses.
#pragma once

#include <optional>
#include <string>

#include "tests/conformance/context.h"

namespace kaamos::conformance {

// Success, or the error from compiling this library.
rtapi::Status compile(const std::string& source, const std::string& target = "lib_6_6",
                      std::optional<bool> payload_qualifiers = {});

// A shader of this stage ("anyhit") with these statements. In scope: `scene`, `ray`, and the
// structures P (payload or parameter, `p`) and A (attributes, `a`).
std::string shader_of(const std::string& stage, const std::string& statements);

}  // namespace kaamos::conformance

// SPDX-License-Identifier: MIT
//
// Rules that the HLSL compiler keeps: sources that it takes or refuses.
#pragma once

#include <optional>
#include <string>

#include "tests/conformance/context.h"

namespace kaamos::conformance {

// The error of compiling this library, or success.
rtapi::Status compile(const std::string& source, const std::string& target = "lib_6_6",
                      std::optional<bool> payload_qualifiers = {});

// A shader of this stage ("anyhit") with these statements. In scope: `scene`, `ray`, and the
// structures P (payload or parameter, `p`) and A (attributes, `a`).
std::string shader_of(const std::string& stage, const std::string& statements);

}  // namespace kaamos::conformance

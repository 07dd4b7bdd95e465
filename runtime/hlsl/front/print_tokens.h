// SPDX-License-Identifier: MIT
// Tokens as text that gives the same tokens again: what -P writes.
#pragma once

#include <string>

#include "runtime/hlsl/front/source.h"
#include "runtime/hlsl/front/token.h"

namespace kaamos::hlsl {

// Each token on the line it came from, with #line directives where files change.
std::string print_tokens(const TokenList& tokens, const SourceManager& sources);

}  // namespace kaamos::hlsl

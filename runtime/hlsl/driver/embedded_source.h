// SPDX-License-Identifier: MIT
//
// What a library was compiled from, as one text that the library carries: every file that was read,
// and the options. From it the library's checked variant is made where and when one is wanted, and
// `#include` finds what it found.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/front/file_loader.h"

namespace kaamos::hlsl {

std::string embed_source(const FrontendOptions& options, const SourceManager& sources);

struct EmbeddedSource {
  FrontendOptions options;
  MemoryFileLoader files;
};
// Empty: `text` is none of embed_source.
std::optional<EmbeddedSource> read_embedded_source(std::string_view text);

}  // namespace kaamos::hlsl

// SPDX-License-Identifier: MIT
//
// The source that a library was compiled from, as one text that the library carries: the options
// and every file that was read. It lets the library's checked variant be compiled where and when
// one is wanted, and the library together with others that it calls, with every `#include` finding
// the same files.
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
// Empty if `text` was not made by embed_source.
std::optional<EmbeddedSource> read_embedded_source(std::string_view text);

}  // namespace kaamos::hlsl

// SPDX-License-Identifier: MIT
//
// The headers that emitted C++ includes, kaamos/shader/*.h. The library carries them, so that a
// program has those of its own version wherever it runs and whatever became of the source tree or
// the package. $KAAMOS_SHADER_INCLUDE names a folder with others.
#pragma once

#include <filesystem>
#include <string>

#include "runtime/hlsl/ir/result.h"

namespace kaamos::hlsl {

// The names and texts of the headers in the include folder `folder`; if that is empty, of the
// library's own.
std::string shader_headers_text(const std::filesystem::path& folder);

// Writes the library's own headers below the cache, where they are not there yet, and returns the
// include folder. Many processes and threads may call it at once.
Result<std::filesystem::path> write_shader_headers(const std::filesystem::path& cache);

}  // namespace kaamos::hlsl

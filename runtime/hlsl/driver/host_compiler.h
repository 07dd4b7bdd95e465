// SPDX-License-Identifier: MIT
//
// Builds emitted C++ into a shared object with the machine's own compiler, and caches the result.
// The cache key covers the source, flags, compiler and shader headers.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "runtime/hlsl/driver/compiler_options.h"
#include "runtime/hlsl/driver/shader_cache.h"
#include "runtime/hlsl/ir/build_failure.h"
#include "runtime/hlsl/ir/result.h"

namespace kaamos::hlsl {

struct HostCompiler {
  std::filesystem::path program;
  // Holds kaamos/shader/prelude.h; empty: the library's own headers (shader_headers.h).
  std::filesystem::path include_folder;
};

struct SharedObject {
  std::filesystem::path path;  // empty: error says why
  bool from_cache = false;
  BuildFailure error;  // what, which program, its first messages, what to do
};

// The compiler is `wanted`, else $KAAMOS_CXX, else the one that built Kaamos, else c++, g++ or
// clang++ in $PATH. $KAAMOS_SHADER_INCLUDE is the include folder, if it is set. Fails if the
// compiler or the headers of that folder are missing.
Result<HostCompiler> find_host_compiler(const std::string& wanted = {});

// The object that build_shared_object() would find in the cache; empty if it would build or fail.
std::filesystem::path find_shared_object(const HostCompiler& compiler, const std::string& content,
                                         Optimisation optimisation,
                                         const std::filesystem::path& cache);

// Builds `source` unless it is in the cache; a cached object that may not be loaded
// (shader_cache.h) is built anew. Many processes and threads may call it at once: the object
// appears under its name only when it is complete.
SharedObject build_shared_object(const HostCompiler& compiler, const std::string& source,
                                 Optimisation optimisation,
                                 const std::filesystem::path& cache = cache_folder());

// The same for a source that is expensive to make: `content` holds everything that the source
// depends on, and `make_source` runs only if the object is not in the cache. On failure,
// `make_source` sets `error`.
SharedObject build_shared_object(const HostCompiler& compiler, const std::string& content,
                                 const std::function<std::string(BuildFailure& error)>& make_source,
                                 Optimisation optimisation, const std::filesystem::path& cache);

}  // namespace kaamos::hlsl

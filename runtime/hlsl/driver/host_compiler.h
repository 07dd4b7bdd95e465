// SPDX-License-Identifier: MIT
//
// Builds emitted C++ into a shared object with the machine's own compiler, and keeps what it built
// in a cache whose keys are the content: source, flags, compiler and shader headers.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "runtime/hlsl/ir/build_failure.h"

namespace kaamos::hlsl {

struct HostCompiler {
  std::filesystem::path program;
  std::filesystem::path include_folder;  // holds kaamos/shader/prelude.h
};

enum class Optimisation { kNone, kDebug, kFull };  // -O0, -Og -g, -O2

struct SharedObject {
  std::filesystem::path path;  // empty: error says why
  bool from_cache = false;
  BuildFailure error;  // what, which program, its first messages, what to do
};

// `wanted`, else $KAAMOS_CXX, else the compiler that built Kaamos, else c++, g++, clang++ in $PATH.
// The headers:
// $KAAMOS_SHADER_INCLUDE, else the installed or the source folder. `error` is set where one of them
// is missing.
std::optional<HostCompiler> find_host_compiler(std::string& error, const std::string& wanted = {});

// $KAAMOS_CACHE_DIR, else $XDG_CACHE_HOME/kaamos, else ~/.cache/kaamos, else a folder in /tmp of
// this user.
std::filesystem::path cache_folder();

// Builds `source` unless the cache has it. Safe to call from many processes and threads at once:
// the object appears under its name only when it is complete.
SharedObject build_shared_object(const HostCompiler& compiler, const std::string& source,
                                 Optimisation optimisation,
                                 const std::filesystem::path& cache = cache_folder());

// The same where the source is costly to make: `content` has everything that it depends on, and
// `make_source` runs only if the cache has no object. It sets `error` where it cannot.
SharedObject build_shared_object(const HostCompiler& compiler, const std::string& content,
                                 const std::function<std::string(BuildFailure& error)>& make_source,
                                 Optimisation optimisation, const std::filesystem::path& cache);

}  // namespace kaamos::hlsl

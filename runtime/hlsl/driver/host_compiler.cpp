// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/host_compiler.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <system_error>
#include <vector>

#include "kaamos/shader/cpu_level.h"

#ifndef KAAMOS_HOST_CXX
#define KAAMOS_HOST_CXX "c++"
#endif
#ifndef KAAMOS_SHADER_INCLUDE_DIRS
#define KAAMOS_SHADER_INCLUDE_DIRS ""
#endif

extern char** environ;

namespace kaamos::hlsl {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    if (!part.empty()) {
      parts.push_back(part);
    }
  }
  return parts;
}

bool is_program(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

// The program's full path; a name without a slash is searched for in $PATH.
fs::path find_program(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    return is_program(name) ? fs::path(name) : fs::path();
  }
  for (const std::string& folder : split(environment("PATH"), ':')) {
    if (is_program(fs::path(folder) / name)) {
      return fs::path(folder) / name;
    }
  }
  return {};
}

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

const std::vector<std::string>& flags_of(Optimisation optimisation) {
  // -fwrapv: HLSL integers wrap. -ffp-contract=off: no fused operations that the source does not
  // ask for. -fno-math-errno, -fno-trapping-math: nothing looks at errno or the exception flags.
  // -fstack-clash-protection: variables that do not fit the stack hit its guard page.
  static const std::vector<std::string> common = {"-std=c++20",
                                                  "-fPIC",
                                                  "-shared",
                                                  "-w",
                                                  "-fwrapv",
                                                  "-ffp-contract=off",
                                                  "-fno-math-errno",
                                                  "-fno-trapping-math",
                                                  "-fvisibility=hidden",
                                                  "-fno-exceptions",
                                                  "-fno-rtti",
                                                  "-fno-strict-aliasing",
                                                  "-fstack-clash-protection"};
  const auto with = [](std::vector<std::string> more) {
    more.insert(more.begin(), common.begin(), common.end());
    return more;
  };
  static const std::vector<std::string> none = with({"-O0"});
  // For the headers' functions; shaders are not optimised at all (emit_unoptimised). A frame
  // pointer shows the stack everywhere.
  static const std::vector<std::string> debug =
      with({"-Og", "-g", "-fno-inline-functions-called-once", "-fno-inline-small-functions",
            "-fno-optimize-sibling-calls", "-fno-omit-frame-pointer"});
  // Uses this machine's registers, as libraries that are compiled along with a program do.
  const auto for_this_machine = [&](const char* level) {
    return shader::cpu_level() == shader::CpuLevel::kAvx2 ? with({level, "-mavx2"}) : with({level});
  };
  static const std::vector<std::string> quick = for_this_machine("-O1");
  static const std::vector<std::string> full = for_this_machine("-O2");
  switch (optimisation) {
    case Optimisation::kNone:
      return none;
    case Optimisation::kDebug:
      return debug;
    case Optimisation::kQuick:
      return quick;
    case Optimisation::kFull:
      return full;
  }
  return full;
}

std::string hex(const XXH128_hash_t& hash) {
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

// Everything that the built object depends on.
std::string cache_key(const HostCompiler& compiler, const std::string& source,
                      Optimisation optimisation) {
  std::string all = source;
  for (const std::string& flag : flags_of(optimisation)) {
    all += '\0' + flag;
  }
  // Path, size and time identify a compiler without the cost of starting it.
  std::error_code ignored;
  const fs::path program = fs::canonical(compiler.program, ignored);
  all += '\0' + program.string() + '\0' + std::to_string(fs::file_size(program, ignored)) + '\0' +
         std::to_string(fs::last_write_time(program, ignored).time_since_epoch().count());
  std::vector<fs::path> headers;
  for (const auto& entry :
       fs::directory_iterator(compiler.include_folder / "kaamos/shader", ignored)) {
    headers.push_back(entry.path());
  }
  std::sort(headers.begin(), headers.end());
  for (const fs::path& header : headers) {
    all += '\0' + header.filename().string() + '\0' + read_file(header);
  }
  return hex(XXH3_128bits(all.data(), all.size()));
}

// Runs a program until it exits, with its output going to `log`. Returns its exit code, or -1 with
// errno.
int run_program(const std::vector<std::string>& words, const fs::path& log) {
  std::vector<char*> arguments;
  for (const std::string& word : words) {
    arguments.push_back(const_cast<char*>(word.c_str()));
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int failed =
      posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) {
    errno = failed;
    return -1;
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      return -1;
    }
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string first_lines(const std::string& text, int count) {
  size_t end = 0;
  for (int i = 0; i < count && end < text.size(); ++i) {
    end = std::min(text.find('\n', end), text.size() - 1) + 1;
  }
  return text.substr(0, end);
}

}  // namespace

std::optional<HostCompiler> find_host_compiler(std::string& error, const std::string& asked_for) {
  HostCompiler out;
  const std::string wanted = asked_for.empty() ? environment("KAAMOS_CXX") : asked_for;
  std::vector<std::string> names = {KAAMOS_HOST_CXX, "c++", "g++", "clang++"};
  if (!wanted.empty()) {
    names = {wanted};
  }
  for (const std::string& name : names) {
    out.program = find_program(name);
    if (!out.program.empty()) {
      break;
    }
  }
  if (out.program.empty()) {
    error = wanted.empty()
                ? "no C++ compiler found (looked for " KAAMOS_HOST_CXX
                  ", c++, g++ and clang++ in $PATH): install one (Debian: apt install g++) or name "
                  "it in $KAAMOS_CXX"
                : "the compiler \"" + wanted +
                      "\" ($KAAMOS_CXX or CxxCompiler) is not a program: name a C++20 compiler, or "
                      "none";
    return std::nullopt;
  }
  const std::string folder = environment("KAAMOS_SHADER_INCLUDE");
  const std::string looked = folder.empty() ? KAAMOS_SHADER_INCLUDE_DIRS : folder;
  for (const std::string& candidate : split(looked, ':')) {
    std::error_code ignored;
    if (fs::exists(fs::path(candidate) / "kaamos/shader/prelude.h", ignored)) {
      out.include_folder = candidate;
      return out;
    }
  }
  error = "the shader headers are missing: no kaamos/shader/prelude.h in " +
          (looked.empty() ? "any known folder" : looked) +
          ": install Kaamos or name their folder in $KAAMOS_SHADER_INCLUDE";
  return std::nullopt;
}

fs::path find_shared_object(const HostCompiler& compiler, const std::string& content,
                            Optimisation optimisation, const fs::path& cache) {
  if (!open_cache(cache).empty()) return {};
  const fs::path object = cache / (cache_key(compiler, content, optimisation) + ".so");
  return may_load(object) ? object : fs::path();
}

SharedObject build_shared_object(const HostCompiler& compiler, const std::string& source,
                                 Optimisation optimisation, const fs::path& cache) {
  return build_shared_object(
      compiler, source, [&](BuildFailure&) { return source; }, optimisation, cache);
}

SharedObject build_shared_object(const HostCompiler& compiler, const std::string& content,
                                 const std::function<std::string(BuildFailure& error)>& make_source,
                                 Optimisation optimisation, const fs::path& cache) {
  SharedObject out;
  out.error.text = open_cache(cache);
  if (out.error) {
    return out;
  }
  const fs::path object = cache / (cache_key(compiler, content, optimisation) + ".so");
  if (may_load(object)) {
    out.path = object;
    out.from_cache = true;
    return out;
  }
  const std::string source = make_source(out.error);
  if (out.error) {
    return out;
  }
  // Each build has its own folder; the object is moved out of it in one step.
  std::string work = (cache / "build-XXXXXX").string();
  if (mkdtemp(work.data()) == nullptr) {
    out.error.text = "cannot write to the shader cache " + cache.string() + ": " +
                     std::strerror(errno) +
                     "; set $KAAMOS_CACHE_DIR to a folder that can be written";
    return out;
  }
  std::error_code failed;
  const fs::path folder = work;
  const fs::path source_path = folder / "shader.cpp";
  const fs::path built = folder / "shader.so";
  const fs::path log = folder / "log";
  {
    std::ofstream file(source_path, std::ios::binary);
    file << source;
    file.flush();
    if (!file) {
      out.error.text = "cannot write " + source_path.string() + ": " + std::strerror(errno);
    }
  }
  if (!out.error) {
    std::vector<std::string> words = {compiler.program.string()};
    const auto& flags = flags_of(optimisation);
    words.insert(words.end(), flags.begin(), flags.end());
    words.insert(words.end(), {"-I" + compiler.include_folder.string(), source_path.string(), "-o",
                               built.string(), "-lm"});
    const int code = run_program(words, log);
    if (code == 0) {
      // Whatever the umask is, may_load() takes it.
      fs::permissions(built, fs::perms::group_write | fs::perms::others_write,
                      fs::perm_options::remove, failed);
      if (!failed) fs::rename(built, object, failed);
      if (failed) {
        out.error.text = "cannot write " + object.string() + ": " + failed.message();
      } else {
        out.path = object;
      }
    } else if (code < 0) {
      out.error.text = "cannot run " + words[0] + ": " + std::strerror(errno);
    } else {
      out.error.text = words[0] + " failed with exit code " + std::to_string(code) +
                       " on the emitted C++, its first messages:\n" +
                       first_lines(read_file(log), 12);
    }
  }
  fs::remove_all(folder, failed);
  return out;
}

}  // namespace kaamos::hlsl

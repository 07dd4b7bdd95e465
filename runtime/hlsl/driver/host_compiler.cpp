// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/host_compiler.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <vector>

#include "runtime/files/write_file.h"
#include "runtime/hlsl/driver/files.h"
#include "runtime/hlsl/driver/process.h"
#include "runtime/hlsl/driver/shader_headers.h"

namespace kaamos::hlsl {
namespace {

namespace fs = std::filesystem;

// Everything that the built object depends on.
std::string cache_key(const HostCompiler& compiler, const std::string& source,
                      Optimisation optimisation) {
  std::string all = source;
  for (const std::string& flag : compiler_options(optimisation, OptionSet::kGnu)) {
    all += '\0' + flag;
  }
  // Path, size and time identify a compiler without the cost of starting it.
  std::error_code ignored;
  const fs::path program = fs::canonical(compiler.program, ignored);
  all += '\0' + program.string() + '\0' + std::to_string(fs::file_size(program, ignored)) + '\0' +
         std::to_string(fs::last_write_time(program, ignored).time_since_epoch().count());
  return content_hash(all + shader_headers_text(compiler.include_folder));
}

// The compiler's messages from its first error on, some lines of them.
std::string first_errors(const std::string& log) {
  const size_t error = log.find("error");
  const size_t start = error == std::string::npos ? 0 : log.rfind('\n', error) + 1;
  size_t end = start;
  for (int i = 0; i < 8 && end < log.size(); ++i) {
    end = std::min(log.find('\n', end), log.size() - 1) + 1;
  }
  return log.substr(start, end - start);
}

// Compiles `source` to `object`. Returns why it failed, or nothing.
std::string compile(const HostCompiler& compiler, Optimisation optimisation, const fs::path& source,
                    const fs::path& headers, const fs::path& object, const fs::path& log) {
  const std::string program = compiler.program.string();
  const auto run_with = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words = {program};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(),
                 {"-I" + headers.string(), source.string(), "-o", object.string(), "-lm"});
    return run_program(words, log);
  };
  const auto options = compiler_options(optimisation, OptionSet::kGnu);
  const auto fewer = compiler_options(optimisation, OptionSet::kAny);
  int code = run_with(options);
  // Clang and older versions of g++ stop at once at an option that they do not know.
  if (code > 0 && fewer != options) code = run_with(fewer);
  if (code == 0) return {};
  if (code < 0) return "cannot run " + program + ": " + std::strerror(errno);
  const std::string messages = first_errors(read_file(log));
  return program + " failed with exit code " + std::to_string(code) +
         " on the emitted C++. If every shader fails, install g++ or clang++ with C++20's library, "
         "or name a compiler in $KAAMOS_CXX." +
         (messages.empty() ? "" : " Its first messages:\n" + messages);
}

}  // namespace

Result<HostCompiler> find_host_compiler(const std::string& asked_for) {
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
    return Failure{
        wanted.empty()
            ? "no C++ compiler found (looked for " KAAMOS_HOST_CXX
              ", c++, g++ and clang++ in $PATH): install one (Debian: apt install g++) or name "
              "it in $KAAMOS_CXX"
            : "the compiler \"" + wanted +
                  "\" ($KAAMOS_CXX or CxxCompiler) is not a program: name a C++20 compiler, or "
                  "none"};
  }
  out.include_folder = environment("KAAMOS_SHADER_INCLUDE");
  std::error_code ignored;
  if (!out.include_folder.empty() &&
      !fs::exists(out.include_folder / "kaamos/shader/prelude.h", ignored)) {
    return Failure{
        "$KAAMOS_SHADER_INCLUDE names " + out.include_folder.string() +
        ", which has no kaamos/shader/prelude.h: unset it, or name the include folder of this "
        "version"};
  }
  return out;
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
    out.error.text = cannot_write(work);
    return out;
  }
  std::error_code failed;
  const fs::path folder = work;
  const fs::path source_path = folder / "shader.cpp";
  const fs::path built = folder / "shader.so";
  if (files::write_file(source_path, source) != 0) out.error.text = cannot_write(source_path);
  fs::path headers = compiler.include_folder;
  if (!out.error && headers.empty()) {
    const Result<fs::path> written = write_shader_headers(cache);
    out.error.text = written.error();
    if (written) headers = *written;
  }
  if (!out.error) {
    out.error.text = compile(compiler, optimisation, source_path, headers, built, folder / "log");
  }
  if (!out.error) {
    // Whatever the umask is, may_load() takes it.
    fs::permissions(built, fs::perms::group_write | fs::perms::others_write,
                    fs::perm_options::remove, failed);
    if (std::rename(built.c_str(), object.c_str()) == 0) {
      out.path = object;
    } else {
      out.error.text = cannot_write(object);
    }
  }
  fs::remove_all(folder, failed);
  return out;
}

}  // namespace kaamos::hlsl

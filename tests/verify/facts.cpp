// SPDX-License-Identifier: MIT
#include "tests/verify/facts.h"

#include <oneapi/tbb/version.h>
#include <rtapi/version.h>
#include <sys/utsname.h>
#include <unistd.h>
#include <verify/commit.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>

#include "runtime/hlsl/driver/host_compiler.h"
#include "runtime/hlsl/driver/process.h"

namespace kaamos::verify {

namespace {

// The value behind `key` at the beginning of a line of a file, without what stands between.
std::string value_in(const char* file, const std::string& key, const char* between) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(key, 0) != 0) continue;
    const size_t start = line.find_first_not_of(between, key.size());
    const size_t end = line.find_last_not_of(between);
    if (start != std::string::npos) return line.substr(start, end + 1 - start);
  }
  return "";
}

std::string or_unknown(const std::string& value) {
  return value.empty() ? "not known" : value;
}

std::string system_name() {
  utsname kernel = {};
  uname(&kernel);
  return or_unknown(value_in("/etc/os-release", "PRETTY_NAME", "=\"")) + ", " + kernel.sysname +
         " " + kernel.release + " " + kernel.machine;
}

std::string processor_name() {
  return or_unknown(value_in("/proc/cpuinfo", "model name", "\t :")) + ", " +
         std::to_string(std::thread::hardware_concurrency()) + " threads";
}

std::string memory_size() {
  const double bytes =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return std::to_string(static_cast<long>(bytes / (1 << 20))) + " MiB";
}

std::string commit() {
  return std::strlen(kCommit) == 0 ? "commit not known" : std::string("commit ") + kCommit;
}

// The program's first line of --version.
std::string version_of(const std::filesystem::path& program) {
  std::string log = (std::filesystem::temp_directory_path() / "kaamos-verify-XXXXXX").string();
  const int file = mkstemp(log.data());
  if (file < 0) return "";
  close(file);
  std::string line;
  if (hlsl::run_program({program.string(), "--version"}, log) == 0) {
    std::ifstream in(log);
    std::getline(in, line);
  }
  std::error_code ignored;
  std::filesystem::remove(log, ignored);
  return line;
}

std::string compiler_of_shaders() {
  const auto compiler = hlsl::find_host_compiler();
  if (!compiler) return "none";
  return compiler->program.string() + ", " + or_unknown(version_of(compiler->program));
}

// Variables that change what Kaamos or its drivers do, sorted.
std::vector<std::string> environment_variables() {
  std::vector<std::string> out;
  for (char** at = environ; *at != nullptr; ++at) {
    for (const char* begin : {"KAAMOS_", "VK_", "MESA_", "LP_", "GALLIVM_", "LIBGL_"}) {
      if (std::strncmp(*at, begin, std::strlen(begin)) == 0) out.emplace_back(*at);
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

std::string vector_extensions() {
  std::string out;
#if defined(__x86_64__)
  __builtin_cpu_init();
#define KAAMOS_NAME_IF_SUPPORTED(name) \
  if (__builtin_cpu_supports(name)) out += (out.empty() ? "" : " ") + std::string(name);
  KAAMOS_NAME_IF_SUPPORTED("sse4.2")
  KAAMOS_NAME_IF_SUPPORTED("avx")
  KAAMOS_NAME_IF_SUPPORTED("avx2")
  KAAMOS_NAME_IF_SUPPORTED("fma")
  KAAMOS_NAME_IF_SUPPORTED("avx512f")
  KAAMOS_NAME_IF_SUPPORTED("avx512dq")
  KAAMOS_NAME_IF_SUPPORTED("avx512bw")
  KAAMOS_NAME_IF_SUPPORTED("avx512vl")
#undef KAAMOS_NAME_IF_SUPPORTED
#elif defined(__aarch64__)
  out = "neon";  // all ARM64 processors have it
#endif
  return out.empty() ? "none" : out;
}

std::vector<std::pair<std::string, std::string>> machine_facts() {
  std::vector<std::pair<std::string, std::string>> out = {
      {"Kaamos", std::string(rtapi::GetVersion()) + ", " + commit()},
      {"built with", KAAMOS_COMPILER},
      {"system", system_name()},
      {"processor", processor_name()},
      {"extensions", vector_extensions()},
      {"memory", memory_size()},
      {"oneTBB", TBB_runtime_version()},
      {"shader compiler", compiler_of_shaders()}};
  const char* name = "environment";
  for (const std::string& variable : environment_variables()) {
    out.emplace_back(std::exchange(name, ""), variable);
  }
  return out;
}

}  // namespace kaamos::verify

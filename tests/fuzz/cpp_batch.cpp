// SPDX-License-Identifier: MIT
#include "cpp_batch.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

#include "runtime/hlsl/driver/compiler_options.h"
#include "runtime/hlsl/driver/process.h"
#include "runtime/hlsl/driver/shader_headers.h"

namespace kaamos::test {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostLibraries = 64;
constexpr size_t kMostBytes = 2u << 20;

[[noreturn]] void stop(const std::string& why) {
  std::fprintf(stderr, "hlsl_fuzz: %s\n", why.c_str());
  std::_Exit(2);
}

}  // namespace

CppBatch::CppBatch(fs::path folder) : folder_(std::move(folder)) {
  const auto compiler = hlsl::find_host_compiler();
  if (!compiler) stop(compiler.error());
  compiler_ = *compiler;
  headers_ = compiler_.include_folder;
  if (!headers_.empty()) return;
  fs::create_directories(folder_);
  const auto written = hlsl::write_shader_headers(folder_);
  if (!written) stop(written.error());
  headers_ = *written;
}

void CppBatch::add(uint64_t input, std::string text) {
  bytes_ += text.size();
  libraries_.push_back({input, std::move(text)});
}

bool CppBatch::is_full() const {
  return libraries_.size() >= kMostLibraries || bytes_ >= kMostBytes;
}

// Returns the compiler's messages; empty if it takes the libraries.
std::string CppBatch::compile(size_t first, size_t count) const {
  const fs::path source = folder_ / "batch.cpp";
  const fs::path log = folder_ / "log";
  {
    std::ofstream file(source, std::ios::binary);
    for (size_t i = first; i < first + count; ++i) file << libraries_[i].text << "\n";
  }
  std::vector<std::string> words = {compiler_.program.string()};
  for (const std::string& option :
       hlsl::compiler_options(hlsl::Optimisation::kNone, hlsl::OptionSet::kAny)) {
    if (option != "-shared") words.push_back(option);
  }
  words.insert(words.end(), {"-fsyntax-only", "-w", "-I" + headers_.string(), source.string()});
  if (hlsl::run_program(words, log) == 0) return {};
  std::stringstream text;
  text << std::ifstream(log, std::ios::binary).rdbuf();
  const size_t error = text.str().find("error");
  const size_t line = error == std::string::npos ? 0 : text.str().rfind('\n', error) + 1;
  return "the C++ does not compile:\n" + text.str().substr(line, 4000);
}

std::optional<CppBatch::Failure> CppBatch::check() {
  size_t first = 0;
  size_t count = libraries_.size();
  std::string messages = count == 0 ? std::string() : compile(first, count);
  while (!messages.empty() && count > 1) {
    const size_t half = count / 2;
    const std::string of_half = compile(first, half);
    if (of_half.empty()) {
      first += half;
      count -= half;
    } else {
      messages = of_half;
      count = half;
    }
  }
  std::optional<Failure> failure;
  if (!messages.empty()) failure = {libraries_[first].input, compile(first, 1)};
  libraries_.clear();
  bytes_ = 0;
  return failure;
}

}  // namespace kaamos::test

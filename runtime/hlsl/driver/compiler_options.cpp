// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/compiler_options.h"

#include <sstream>

namespace kaamos::hlsl {
namespace {

// A list of CMake's, with blanks between the options.
std::vector<std::string> options_of(const char* list) {
  std::vector<std::string> out;
  std::istringstream words(list);
  for (std::string word; words >> word;) out.push_back(word);
  return out;
}

}  // namespace

std::vector<std::string> compiler_options(Optimisation optimisation, OptionSet known,
                                          shader::CpuLevel level) {
  std::vector<std::string> out = {"-std=c++20", "-fPIC", "-shared", "-fvisibility=hidden"};
  const auto add = [&](const std::vector<std::string>& more) {
    out.insert(out.end(), more.begin(), more.end());
  };
  add(options_of(KAAMOS_SHADER_COMPILE_OPTIONS));
  switch (optimisation) {
    case Optimisation::kNone:
      add({"-O0"});
      return out;
    case Optimisation::kDebug:
      // For the headers' functions; shaders are not optimised at all (emit_unoptimised). A frame
      // pointer shows the stack everywhere.
      add({"-Og", "-g", "-fno-inline-functions-called-once", "-fno-inline-small-functions",
           "-fno-optimize-sibling-calls", "-fno-omit-frame-pointer"});
      return out;
    case Optimisation::kQuick:
      add({"-O1"});
      break;
    case Optimisation::kFull:
      add(options_of(KAAMOS_SHADER_OPTIMISATION));
      break;
  }
  if (level == shader::CpuLevel::kAvx2) {
    add(options_of(KAAMOS_SHADER_AVX2_OPTIONS));
    if (known == OptionSet::kGnu) add(options_of(KAAMOS_SHADER_GNU_AVX2_OPTIONS));
  }
  return out;
}

}  // namespace kaamos::hlsl

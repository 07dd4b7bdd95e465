// SPDX-License-Identifier: MIT
//
// Has the host's C++ compiler read emitted libraries, many in one unit, because the shader headers
// take longer than the libraries do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/hlsl/driver/host_compiler.h"

namespace kaamos::test {

class CppBatch {
 public:
  struct Failure {
    uint64_t input = 0;
    std::string messages;
  };

  // Writes its files to the folder.
  explicit CppBatch(std::filesystem::path folder);

  // A name for the next library's entry point that no other in the unit has.
  std::string next_name() { return "fuzz_" + std::to_string(names_++); }
  void add(uint64_t input, std::string text);
  size_t size() const { return libraries_.size(); }
  bool is_full() const;
  // Reads what was added, and forgets it. The first library that does not compile, if any.
  std::optional<Failure> check();

 private:
  struct Library {
    uint64_t input;
    std::string text;
  };
  std::string compile(size_t first, size_t count) const;

  hlsl::HostCompiler compiler_;
  std::filesystem::path folder_;
  std::filesystem::path headers_;
  std::vector<Library> libraries_;
  size_t bytes_ = 0;
  uint64_t names_ = 0;
};

}  // namespace kaamos::test

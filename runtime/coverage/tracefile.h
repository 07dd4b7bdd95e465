// SPDX-License-Identifier: MIT
//
// Coverage as text, in the format of LCOV's tracefiles. [man geninfo: FILES]
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace kaamos::coverage {

// An arm of a branch. Branches of a line are told apart by their columns.
struct Arm {
  uint32_t line = 0;
  uint32_t column = 0;
  uint32_t arm = 0;

  auto operator<=>(const Arm&) const = default;
};

struct FileCoverage {
  std::map<uint32_t, uint64_t> lines;  // how many runs came there
  std::map<Arm, uint64_t> arms;
  std::vector<std::string> others;  // records that only others write, as they are
};
using Tracefile = std::map<std::string, FileCoverage>;  // by path

// Empty if the text is no tracefile; `bad_line` is then the number of the line that says so.
std::optional<Tracefile> parse_tracefile(std::string_view text, size_t& bad_line);
std::string to_text(const Tracefile& tracefile);

// Adds `more` to the tracefile at `path`, which need not exist. Whoever reads it meanwhile sees it
// as it was before or as it is afterwards, and of several processes that add none is lost. Returns
// what went wrong; empty: nothing.
std::string add_to_file(const std::string& path, const Tracefile& more);

}  // namespace kaamos::coverage

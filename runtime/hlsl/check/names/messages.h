// SPDX-License-Identifier: MIT
//
// Messages about the program that is checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <set>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "runtime/hlsl/front/diagnostic.h"
#include "runtime/hlsl/front/source.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

using CheckId = DiagnosticId;

class Messages {
 public:
  Messages(const SourceManager& sources, DiagnosticEngine& diagnostics, ir::Module& module)
      : sources_(sources), diagnostics_(diagnostics), module_(module) {}

  void report(CheckId id, SourceLocation location,
              std::initializer_list<std::string> arguments = {});
  void report_with_notes(CheckId id, SourceLocation location,
                         const std::vector<std::string>& arguments,
                         const std::vector<std::pair<SourceLocation, std::string>>& notes);
  // Adds the file to the module's if it is new.
  ir::Location locate(SourceLocation location);
  const SourceManager& sources() const { return sources_; }

  // Sets whether what DXC refuses is an error instead of a warning.
  void set_strict(bool strict) { strict_ = strict; }
  // While something is tried that may fail, messages are only counted.
  void mute() { ++muted_; }
  void unmute() { --muted_; }

  // In functions that no entry point reaches, only mistakes count that need no whole program.
  void enter_unreached() { is_unreached_ = true; }
  void leave_unreached() { is_unreached_ = false; }

  bool has_errors() const { return has_errors_; }
  // The parser's too.
  bool has_any_errors() const { return has_errors_ || diagnostics_.has_errors(); }
  size_t error_count() const { return error_count_; }  // includes those in muted attempts

 private:
  const SourceManager& sources_;
  DiagnosticEngine& diagnostics_;
  ir::Module& module_;
  bool strict_ = false;
  int muted_ = 0;
  bool is_unreached_ = false;
  size_t error_count_ = 0;
  bool has_errors_ = false;
  std::set<std::tuple<uint32_t, uint32_t, std::vector<std::string>>> reported_;
  std::unordered_map<std::string, uint32_t> files_;
};

}  // namespace kaamos::hlsl

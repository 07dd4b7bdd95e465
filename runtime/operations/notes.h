// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Warnings about what an indirect operation met in GPU memory: the first few of each
// operation, then how many more there were.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/structures/structure_commands.h"

namespace kaamos::runtime {

class OperationNotes {
 public:
  OperationNotes(const StructureEnvironment& environment, std::string label)
      : environment_(environment), label_(std::move(label)) {}
  ~OperationNotes() {
    if (count_ <= kMost) return;
    environment_.warn(Id::kOperationArgument,
                      label_ + ": " + std::to_string(count_ - kMost) + " more of them.");
  }
  OperationNotes(const OperationNotes&) = delete;
  OperationNotes& operator=(const OperationNotes&) = delete;

  void add(const std::string& text, Id id = Id::kOperationArgument) {
    if (count_++ < kMost) environment_.warn(id, label_ + ": " + text + ".");
  }
  // About an argument of an operation with many.
  void add_about(uint32_t argument, const std::string& text) {
    add("argument " + std::to_string(argument) + ": " + text);
  }

 private:
  static constexpr uint64_t kMost = 8;
  const StructureEnvironment& environment_;
  std::string label_;
  uint64_t count_ = 0;
};

}  // namespace kaamos::runtime

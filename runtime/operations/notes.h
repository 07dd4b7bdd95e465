// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL. Warnings about what an indirect operation met in GPU memory: the first few of each
// operation, then how many more there were. And, in checked mode, what it read and wrote there.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/structures/structure_commands.h"

namespace kaamos::runtime {

class OperationNotes {
 public:
  // `operation`: its number in the call whose results these are.
  OperationNotes(const StructureEnvironment& environment, std::string label, RtasResults& results,
                 uint32_t operation)
      : environment_(environment),
        label_(std::move(label)),
        results_(results),
        operation_(operation) {}
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

  // `what` has static storage.
  void reads(uint64_t address, uint64_t bytes, const char* what) {
    access(address, bytes, false, what);
  }
  void writes(uint64_t address, uint64_t bytes, const char* what) {
    access(address, bytes, true, what);
  }

 private:
  void access(uint64_t address, uint64_t bytes, bool written, const char* what) {
    if (environment_.context.reporter == nullptr || bytes == 0 ||
        environment_.context.addresses->bytes_from(address) == 0) {
      return;
    }
    results_.accesses.push_back({address, bytes, operation_, written, what});
  }

  static constexpr uint64_t kMost = 8;
  const StructureEnvironment& environment_;
  std::string label_;
  RtasResults& results_;
  uint32_t operation_;
  uint64_t count_ = 0;
};

}  // namespace kaamos::runtime

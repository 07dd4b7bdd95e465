// SPDX-License-Identifier: MIT
//
// Timestamps of the CPU backend: nanoseconds of the steady clock.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/backend/backend.h"

namespace kaamos::embree {

class Timestamps final : public runtime::BackendQueryHeap {
 public:
  static constexpr uint64_t kFrequency = 1'000'000'000;

  explicit Timestamps(uint32_t count) : BackendQueryHeap(count), ticks_(count) {}

  void write(uint32_t index) {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    ticks_[index] =
        static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
  }
  std::span<const uint8_t> bytes(uint32_t first, uint32_t count) const {
    return {reinterpret_cast<const uint8_t*>(ticks_.data() + first), count * sizeof(uint64_t)};
  }

 private:
  std::vector<uint64_t> ticks_;
};

}  // namespace kaamos::embree

// SPDX-License-Identifier: MIT
//
// On a driver that runs shaders on the processor, a wild address in a shader is a fault of this
// process. While a guard exists, such a fault gets a page of zeros instead, and is remembered: the
// dispatch ends, and the device is removed, as a real device would be.
#pragma once

#include <cstdint>

namespace kaamos::vulkan {

class FaultGuard {
 public:
  // Only one guard per process is active at a time; others wait. Does nothing unless `wanted`.
  explicit FaultGuard(bool wanted);
  ~FaultGuard();
  FaultGuard(const FaultGuard&) = delete;
  FaultGuard& operator=(const FaultGuard&) = delete;

  // After the work is done: whether there was a fault, and the address of the first one.
  bool faulted() const;
  uint64_t address() const;

 private:
  bool wanted_;
};

}  // namespace kaamos::vulkan

// SPDX-License-Identifier: MIT
// For builds without the Vulkan backend.
#include "suite.h"

namespace kaamos::bench {

bool has_vulkan() {
  return false;
}

std::vector<Case> vulkan_cases() {
  return {};
}

}  // namespace kaamos::bench

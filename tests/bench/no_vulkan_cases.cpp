// SPDX-License-Identifier: MIT
// A build without the Vulkan backend.
#include "suite.h"

namespace kaamos::bench {

std::vector<Case> vulkan_cases() {
  return {};
}

}  // namespace kaamos::bench

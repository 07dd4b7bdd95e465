// SPDX-License-Identifier: MIT
// For builds without the D3D12 facade.
#include "suite.h"

namespace kaamos::bench {

std::vector<Case> facade_cases() {
  return {};
}

}  // namespace kaamos::bench

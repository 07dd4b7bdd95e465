// SPDX-License-Identifier: MIT
#include "runtime/structures/opacity_micromap.h"

namespace kaamos::runtime {

void MicromapArray::add(uint32_t level, MicromapFormat format, std::span<const uint8_t> bits) {
  micromaps_.push_back({bits_.size(), level, format});
  bits_.insert(bits_.end(), bits.begin(), bits.end());
}

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
#include "d3d12/com/blob.h"

#include <cstring>

namespace kaamos::d3d12 {

Blob::Blob(std::string_view text) : bytes_(text.size() + 1) {
  std::memcpy(bytes_.data(), text.data(), text.size());
}

}  // namespace kaamos::d3d12

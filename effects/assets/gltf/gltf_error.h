// SPDX-License-Identifier: MIT
// The error that a part of a glTF file is wrong; only gltf_*.cpp include it.
#pragma once

#include <string>

#include "effects/assets/common/errors.h"

namespace kaamos::effects {

/// KA3020. `where`: the part, such as "mesh 0, primitive 1"; `what`: a sentence without a full
/// stop.
inline Error gltf_error(const std::string& where, const std::string& what) {
  return make_error(ErrorId::kGltf, where + ": " + what);
}

}  // namespace kaamos::effects

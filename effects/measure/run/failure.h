// SPDX-License-Identifier: MIT
// Makes an error like the libraries' own of something that northlight itself cannot do.
#pragma once

#include <string>

#include "effects/assets/common/errors.h"

namespace kaamos::measure {

inline rtapi::Error failure(const std::string& text) {
  return effects::make_error(effects::ErrorId::kNorthlight, text);
}

}  // namespace kaamos::measure

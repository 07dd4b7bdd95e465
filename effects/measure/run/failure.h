// SPDX-License-Identifier: MIT
// What northlight itself cannot do, as an error like the libraries' own.
#pragma once

#include <string>

#include "effects/assets/common/errors.h"

namespace kaamos::measure {

inline rtapi::Error failure(const std::string& text) {
  return effects::make_error(effects::ErrorId::kNorthlight, text);
}

}  // namespace kaamos::measure

// SPDX-License-Identifier: MIT
// What northlight itself cannot do, as an error like the libraries' own.
#pragma once

#include <string>

#include "effects/assets/common/errors.h"

namespace northlight {

inline rtapi::Error failure(const std::string& text) {
  return kaamos::effects::make_error(kaamos::effects::ErrorId::kNorthlight, text);
}

}  // namespace northlight

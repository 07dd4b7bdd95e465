// SPDX-License-Identifier: MIT
// Errors of this library: ids KA4000 to KA4099, rows of errors.inc.
#pragma once

#include <rtapi/result.h>

#include <cstdint>
#include <string>

#include "runtime/errors/message_table.h"

namespace kaamos::d3d12 {

enum class ErrorId : uint16_t {
#define KAAMOS_MESSAGE(number, name, ...) name = number,
#include "d3d12/com/errors.inc"
#undef KAAMOS_MESSAGE
};

using errors::public_id;

/// "KA4011 title: detail". `detail` says what, where, actual and allowed, and what to do.
rtapi::Error make_error(ErrorId id, const std::string& detail);

}  // namespace kaamos::d3d12

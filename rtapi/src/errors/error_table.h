// SPDX-License-Identifier: MIT
//
// Every error that rtapi reports: one id, one row. The ids are stable; messages begin with them.
#pragma once

#include <cstdint>
#include <string>

#include <rtapi/result.h>

#include "runtime/errors/message_table.h"
#include "runtime/errors/text.h"

namespace rtapi::detail {

using kaamos::errors::concat;
using kaamos::errors::hex;
using kaamos::errors::in_quotes;
using kaamos::errors::public_id;

// The number in KAnnnn.
enum class Id : uint16_t {
#define KAAMOS_MESSAGE(number, name, ...) name = number,
#include "rtapi/src/errors/errors.inc"
#undef KAAMOS_MESSAGE
};

kaamos::errors::MessageTable error_table();

// "KA0504 <title>: <detail>"
Error make_error(Id id, const std::string& detail);

template <class... Parts>
Error make_error(Id id, const Parts&... parts) {
  return make_error(id, concat(parts...));
}

}  // namespace rtapi::detail

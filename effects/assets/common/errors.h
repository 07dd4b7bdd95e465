// SPDX-License-Identifier: MIT
/// @file
/// Results and errors of the effects library. They are rtapi's: no exception crosses a border of
/// the library, and it never prints; whoever called decides what to do with the message.
#pragma once

#include <rtapi/result.h>

#include <cstdint>
#include <string>

namespace kaamos::effects {

using rtapi::Error;
using rtapi::Result;
using rtapi::Status;

/// The number in KA3nnn. effects/assets/common/errors.inc is the table, rtapi/ERRORS.md lists it.
enum class ErrorId : std::uint16_t {
/// @cond
#define KAAMOS_MESSAGE(number, name, ...) name = number,
#include "effects/assets/common/errors.inc"
#undef KAAMOS_MESSAGE
  /// @endcond
};

/// "KA3020 title: detail". `detail` says what failed, where, the actual and the allowed value, and
/// what to do.
Error make_error(ErrorId id, const std::string& detail);

/// An error of this library with `where` before its detail: "KA3020 title: where: detail". The
/// message of another error is the detail of a new one with the id `otherwise`.
Error within(const std::string& where, const Error& error, ErrorId otherwise);

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
/// @file
/// Results and errors of the effects library. They are rtapi's: no exception crosses a border of
/// the library, and it never prints; whoever called decides what to do with the message.
#pragma once

#include <rtapi/result.h>

#include <cstdint>
#include <span>
#include <string>

namespace kaamos::effects {

using rtapi::Error;
using rtapi::Result;
using rtapi::Status;

/// The number in KA3nnn. effects/assets/common/errors.inc is the table, rtapi/ERRORS.md lists it.
enum class ErrorId : std::uint16_t {
/// @cond
#define KAAMOS_EFFECTS_ERROR(number, name, code, title, source, cure) name = number,
#include "effects/assets/common/errors.inc"
#undef KAAMOS_EFFECTS_ERROR
  /// @endcond
};

/// A row of the table.
struct ErrorEntry {
  ErrorId id;             ///< the number
  rtapi::ErrorCode code;  ///< of errors with this id
  const char* title;      ///< what a message says after the id
  const char* source;     ///< the format or paper that sets the rule; "" where there is none
  const char* cure;       ///< what to do about it
};

/// Every row, sorted by id.
std::span<const ErrorEntry> error_table();

/// "KA3020 title: detail". `detail` says what failed, where, the actual and the allowed value, and
/// what to do.
Error make_error(ErrorId id, const std::string& detail);

/// An error of this library with `where` before its detail: "KA3020 title: where: detail". The
/// message of another error is the detail of a new one with the id `otherwise`.
Error within(const std::string& where, const Error& error, ErrorId otherwise);

}  // namespace kaamos::effects

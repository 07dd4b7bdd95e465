// SPDX-License-Identifier: MIT
/// @file
/// The outcome of work that may be stopped. Being stopped is no error: nothing failed, somebody
/// asked for it.
#pragma once

#include <rtapi/result.h>

#include <cstdint>
#include <functional>

namespace kaamos::effects {

/// The outcome of work that a callback may stop.
enum class Outcome : std::uint8_t {
  kDone,     ///< complete
  kStopped,  ///< the caller's callback asked for it; results are incomplete
};

/// Neither an error nor stopped. To pass on anything else:
/// `if (const auto s = work(); !is_done(s)) return s;`
inline bool is_done(const rtapi::Result<Outcome>& result) {
  return result.ok() && *result == Outcome::kDone;
}

/// Takes the done part, from 0 to 1; returning false stops the work at the next step. Empty: nobody
/// watches.
using StepCallback = std::function<bool(double done)>;

}  // namespace kaamos::effects

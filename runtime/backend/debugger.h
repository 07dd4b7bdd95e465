// SPDX-License-Identifier: MIT
//
// Whether a debugger is attached to this process, for DebugBreak and dx::IsDebuggingEnabled.
#pragma once

namespace kaamos::runtime {

// Asks the system again when the last answer is older than 20 ms. Thread-safe.
bool is_debugger_attached();

}  // namespace kaamos::runtime

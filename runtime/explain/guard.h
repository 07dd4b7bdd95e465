// SPDX-License-Identifier: MIT
//
// A fault in replayed shader code ends the replay, not the process.
#pragma once

#include <csetjmp>
#include <cstdint>
#include <string>

namespace kaamos::explain {

// Runs body(argument) on this thread. A fault in it (SIGSEGV, SIGBUS, SIGFPE, SIGILL) or a call of
// leave() ends it without running destructors. Returns why it ended early, or an empty string.
std::string run_guarded(void (*body)(void*), void* argument);

// Ends the body that run_guarded is running. `why` is copied.
[[noreturn]] void leave(const char* why);

}  // namespace kaamos::explain

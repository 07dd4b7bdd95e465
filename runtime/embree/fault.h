// SPDX-License-Identifier: MIT
//
// Nothing that a shader does may end the process. A fault in its code (SIGSEGV, SIGBUS, SIGFPE,
// SIGILL), a stack overflow, or a recursion too deep ends the tile that it ran in, and the device
// is removed with a message that names the shader and the pixel.
#pragma once

#include <cstdint>

#include "runtime/embree/worker.h"

namespace kaamos::embree {

// Runs body(argument) on this thread. A fault in it returns false, with the reason in `worker`. The
// frames in between are left without running destructors; shader code and Embree's traversal have
// none that matter.
bool run_guarded(Worker& worker, void (*body)(void*), void* argument);

// Within run_guarded: the same on another stack, that of a compute fiber. Faults on it end there.
bool run_guarded_on_fiber(Worker& worker, void (*body)(void*), void* argument);

// Ends the innermost guarded run.
[[noreturn]] void remove_device(Worker& worker, shader::RemovalReason reason);

// Makes a message from what `worker` holds. The dispatch keeps only the first one.
void record_removal(Worker& worker);

// The lowest address to which this thread's stack may grow, leaving room for one traversal and one
// shader.
uintptr_t stack_limit_of_this_thread();

inline void check_stack(Worker& worker) {
  if (reinterpret_cast<uintptr_t>(__builtin_frame_address(0)) < worker.stack_limit) {
    remove_device(worker, shader::RemovalReason::kStackOverflow);
  }
}

}  // namespace kaamos::embree

// SPDX-License-Identifier: MIT
// Threads of the C library. [MSVC: process.h]
#pragma once

#include <processthreadsapi.h>
#include <unistd.h>

typedef unsigned(__stdcall* _beginthreadex_proc_type)(void*);
/// `flags` is 0 or CREATE_SUSPENDED.
EXTERN_C uintptr_t _beginthreadex(void* security, unsigned stack_size,
                                  _beginthreadex_proc_type start, void* argument, unsigned flags,
                                  unsigned* id);
inline int _getpid() {
  return getpid();
}

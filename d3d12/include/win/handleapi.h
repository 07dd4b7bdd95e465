// SPDX-License-Identifier: MIT
// Handles: what CreateEvent and its like return. The library implements these calls.
#pragma once

#include <winerror.h>

#define INVALID_HANDLE_VALUE ((HANDLE)(LONG_PTR)-1)
#define DUPLICATE_CLOSE_SOURCE 1
#define DUPLICATE_SAME_ACCESS 2

EXTERN_C BOOL WINAPI CloseHandle(HANDLE object);
/// Both handles name one object; `source_process` and `dest_process` are this process.
EXTERN_C BOOL WINAPI DuplicateHandle(HANDLE source_process, HANDLE source, HANDLE dest_process,
                                     HANDLE* dest, DWORD access, BOOL inherit, DWORD options);
inline HANDLE GetCurrentProcess() {
  return (HANDLE)(LONG_PTR)-1;
}
EXTERN_C DWORD WINAPI GetLastError();
EXTERN_C void WINAPI SetLastError(DWORD error);

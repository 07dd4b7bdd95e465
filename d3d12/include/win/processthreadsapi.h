// SPDX-License-Identifier: MIT
// Threads and this process. [Win32: processthreadsapi.h]
#pragma once

#include <handleapi.h>
#include <kaamos_text.h>
#include <stdlib.h>

typedef DWORD(WINAPI* LPTHREAD_START_ROUTINE)(LPVOID);
#define STACK_SIZE_PARAM_IS_A_RESERVATION 0x00010000
#define CREATE_SUSPENDED 0x4
#define THREAD_PRIORITY_NORMAL 0
#define THREAD_PRIORITY_ABOVE_NORMAL 1
#define THREAD_PRIORITY_HIGHEST 2

/// The handle is set when the thread has ended. `flags` is 0 or CREATE_SUSPENDED.
EXTERN_C HANDLE WINAPI CreateThread(LPSECURITY_ATTRIBUTES attributes, SIZE_T stack_size,
                                    LPTHREAD_START_ROUTINE start, LPVOID parameter, DWORD flags,
                                    LPDWORD id);
#ifdef __cplusplus
/// As Windows' DWORD is `unsigned long`, which is wider here.
inline HANDLE CreateThread(LPSECURITY_ATTRIBUTES attributes, SIZE_T stack_size,
                           unsigned long(WINAPI* start)(LPVOID), LPVOID parameter, DWORD flags,
                           LPDWORD id) {
  return CreateThread(attributes, stack_size, (LPTHREAD_START_ROUTINE)(void*)start, parameter,
                      flags, id);
}
#endif
/// Starts a thread that was made with CREATE_SUSPENDED. Returns 1, 0 if it runs already, or
/// (DWORD)-1 for a handle of no thread.
EXTERN_C DWORD WINAPI ResumeThread(HANDLE thread);
EXTERN_C DWORD WINAPI GetCurrentThreadId();
EXTERN_C DWORD WINAPI GetCurrentProcessId();
inline HANDLE GetCurrentThread() {
  return (HANDLE)(LONG_PTR)-2;
}
inline BOOL SetThreadPriority(HANDLE, int) {
  return TRUE;
}
inline HRESULT SetThreadDescription(HANDLE, PCWSTR) {
  return S_OK;
}
inline BOOL SwitchToThread() {
  return FALSE;
}
[[noreturn]] inline void ExitProcess(UINT code) {
  exit((int)code);
}

// SPDX-License-Identifier: MIT
// A debugger's output is the standard error stream here. [Win32: debugapi.h]
#pragma once

#include <minwindef.h>

EXTERN_C void WINAPI OutputDebugStringA(LPCSTR text);
EXTERN_C void WINAPI OutputDebugStringW(LPCWSTR text);
inline BOOL IsDebuggerPresent() {
  return FALSE;
}
inline void DebugBreak() {
  __builtin_trap();
}

#ifdef UNICODE
#define OutputDebugString OutputDebugStringW
#else
#define OutputDebugString OutputDebugStringA
#endif

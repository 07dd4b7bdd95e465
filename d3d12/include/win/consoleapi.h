// SPDX-License-Identifier: MIT
// A console is always there: the terminal. [Win32: consoleapi.h]
#pragma once

#include <handleapi.h>

inline BOOL AllocConsole() {
  return TRUE;
}
inline BOOL FreeConsole() {
  return TRUE;
}
inline BOOL AttachConsole(DWORD) {
  return TRUE;
}
inline BOOL SetConsoleOutputCP(UINT) {
  return TRUE;
}

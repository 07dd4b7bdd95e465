// SPDX-License-Identifier: MIT
// A console is always there: the terminal. [Win32: consoleapi.h]
#pragma once

#include <handleapi.h>
#include <kaamos_text.h>

inline BOOL AllocConsole() {
  return TRUE;
}
inline BOOL FreeConsole() {
  return TRUE;
}
inline BOOL AttachConsole(DWORD) {
  return TRUE;
}
inline BOOL SetConsoleTitleA(LPCSTR) {
  return TRUE;
}
inline BOOL SetConsoleTitleW(LPCWSTR) {
  return TRUE;
}
KAAMOS_TEXT_CALL(SetConsoleTitle);
#define FOREGROUND_BLUE 0x1
#define FOREGROUND_GREEN 0x2
#define FOREGROUND_RED 0x4
#define FOREGROUND_INTENSITY 0x8
/// Text keeps its colour.
inline BOOL SetConsoleTextAttribute(HANDLE, WORD) {
  return TRUE;
}
inline HWND GetConsoleWindow() {
  return NULL;
}
inline BOOL SetConsoleOutputCP(UINT) {
  return TRUE;
}

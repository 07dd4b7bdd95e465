// SPDX-License-Identifier: MIT
// Entry points, local memory, messages of error codes, conversions of text.
// [Win32: winbase.h, stringapiset.h]
#pragma once

#include <kaamos_text.h>
#include <stdlib.h>
#include <string.h>
#include <wchar.h>
#include <winerror.h>

/// The program's entry point, called by main of kaamos::d3d12_main. `instance` is
/// GetModuleHandle(NULL).
///@{
EXTERN_C int WINAPI WinMain(HINSTANCE instance, HINSTANCE previous, LPSTR command_line, int show);
EXTERN_C int WINAPI wWinMain(HINSTANCE instance, HINSTANCE previous, LPWSTR command_line, int show);
///@}

#define LMEM_ZEROINIT 0x40
#define LPTR 0x40
inline HLOCAL LocalAlloc(UINT flags, SIZE_T bytes) {
  return (flags & LMEM_ZEROINIT) != 0 ? calloc(1, bytes) : malloc(bytes);
}
inline HLOCAL LocalFree(HLOCAL memory) {
  free(memory);
  return NULL;
}

#define FORMAT_MESSAGE_ALLOCATE_BUFFER 0x100
#define FORMAT_MESSAGE_IGNORE_INSERTS 0x200
#define FORMAT_MESSAGE_FROM_SYSTEM 0x1000
#define LANG_NEUTRAL 0
#define SUBLANG_DEFAULT 1
#define MAKELANGID(primary, sub) ((WORD)(((sub) << 10) | (primary)))
/// The name of an error code or HRESULT, of the system only.
///@{
EXTERN_C DWORD FormatMessageA(DWORD flags, LPCVOID source, DWORD message, DWORD language,
                              LPSTR buffer, DWORD size, void* arguments);
EXTERN_C DWORD FormatMessageW(DWORD flags, LPCVOID source, DWORD message, DWORD language,
                              LPWSTR buffer, DWORD size, void* arguments);
///@}
KAAMOS_TEXT_CALL(FormatMessage);

#define CP_ACP 0
#define CP_UTF8 65001
#define MB_PRECOMPOSED 1
#define MB_ERR_INVALID_CHARS 8
/// Every code page is UTF-8.
///@{
EXTERN_C int WINAPI MultiByteToWideChar(UINT code_page, DWORD flags, LPCSTR text, int size,
                                        LPWSTR wide, int wide_size);
EXTERN_C int WINAPI WideCharToMultiByte(UINT code_page, DWORD flags, LPCWSTR wide, int wide_size,
                                        LPSTR text, int size, LPCSTR fallback, LPBOOL used);
///@}
inline int lstrlenA(LPCSTR text) {
  return text == NULL ? 0 : (int)strlen(text);
}
inline int lstrlenW(LPCWSTR text) {
  return text == NULL ? 0 : (int)wcslen(text);
}
KAAMOS_TEXT_CALL(lstrlen);
inline int MulDiv(int a, int b, int c) {
  return c == 0 ? -1 : (int)(((int64_t)a * b + c / 2) / c);
}

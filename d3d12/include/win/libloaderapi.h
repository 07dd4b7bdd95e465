// SPDX-License-Identifier: MIT
// Modules: this program, and the libraries of D3D12, which are part of it.
// [Win32: libloaderapi.h]
#pragma once

#include <handleapi.h>
#include <kaamos_text.h>

typedef INT_PTR(WINAPI* FARPROC)();

#define LOAD_LIBRARY_SEARCH_APPLICATION_DIR 0x200
#define LOAD_LIBRARY_SEARCH_SYSTEM32 0x800
#define LOAD_LIBRARY_SEARCH_DEFAULT_DIRS 0x1000

/// Null is this program; d3d12.dll, dxgi.dll, dxcore.dll, dxcompiler.dll and d3dcompiler_47.dll are
/// there too. Others are not (ERROR_MOD_NOT_FOUND).
///@{
EXTERN_C HMODULE WINAPI GetModuleHandleA(LPCSTR name);
EXTERN_C HMODULE WINAPI GetModuleHandleW(LPCWSTR name);
EXTERN_C BOOL WINAPI GetModuleHandleExA(DWORD flags, LPCSTR name, HMODULE* module);
EXTERN_C BOOL WINAPI GetModuleHandleExW(DWORD flags, LPCWSTR name, HMODULE* module);
EXTERN_C HMODULE WINAPI LoadLibraryA(LPCSTR name);
EXTERN_C HMODULE WINAPI LoadLibraryW(LPCWSTR name);
EXTERN_C HMODULE WINAPI LoadLibraryExA(LPCSTR name, HANDLE file, DWORD flags);
EXTERN_C HMODULE WINAPI LoadLibraryExW(LPCWSTR name, HANDLE file, DWORD flags);
///@}
EXTERN_C BOOL WINAPI FreeLibrary(HMODULE module);
/// The functions that create a library's first objects.
EXTERN_C FARPROC WINAPI GetProcAddress(HMODULE module, LPCSTR name);
/// The path of the program, with slashes, whichever the module.
///@{
EXTERN_C DWORD WINAPI GetModuleFileNameA(HMODULE module, LPSTR path, DWORD size);
EXTERN_C DWORD WINAPI GetModuleFileNameW(HMODULE module, LPWSTR path, DWORD size);
///@}

KAAMOS_TEXT_CALL(GetModuleHandle);
KAAMOS_TEXT_CALL(GetModuleHandleEx);
KAAMOS_TEXT_CALL(LoadLibrary);
KAAMOS_TEXT_CALL(LoadLibraryEx);
KAAMOS_TEXT_CALL(GetModuleFileName);

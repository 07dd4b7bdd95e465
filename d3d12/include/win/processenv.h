// SPDX-License-Identifier: MIT
// This program's command line and environment. [Win32: processenv.h]
#pragma once

#include <handleapi.h>
#include <kaamos_text.h>

/// As Windows writes it: arguments with blanks in quotation marks.
///@{
EXTERN_C LPSTR WINAPI GetCommandLineA();
EXTERN_C LPWSTR WINAPI GetCommandLineW();
///@}
EXTERN_C DWORD WINAPI GetEnvironmentVariableA(LPCSTR name, LPSTR value, DWORD size);
EXTERN_C DWORD WINAPI GetEnvironmentVariableW(LPCWSTR name, LPWSTR value, DWORD size);

#define STD_INPUT_HANDLE ((DWORD)-10)
#define STD_OUTPUT_HANDLE ((DWORD)-11)
#define STD_ERROR_HANDLE ((DWORD)-12)
/// This program's streams, for ReadFile and WriteFile.
EXTERN_C HANDLE WINAPI GetStdHandle(DWORD number);

KAAMOS_TEXT_CALL(GetCommandLine);
KAAMOS_TEXT_CALL(GetEnvironmentVariable);

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

KAAMOS_TEXT_CALL(GetCommandLine);
KAAMOS_TEXT_CALL(GetEnvironmentVariable);

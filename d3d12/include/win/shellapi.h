// SPDX-License-Identifier: MIT
// CommandLineToArgvW. [Win32: shellapi.h]
#pragma once

#include <processenv.h>
#include <winbase.h>

/// Free the result with LocalFree.
EXTERN_C LPWSTR* WINAPI CommandLineToArgvW(LPCWSTR command_line, int* count);

// SPDX-License-Identifier: MIT
// The macros by which windowsx.h unpacks messages. [Win32: windowsx.h]
#pragma once

#include <winuser.h>

#define GET_X_LPARAM(lparam) ((int)(short)LOWORD(lparam))
#define GET_Y_LPARAM(lparam) ((int)(short)HIWORD(lparam))

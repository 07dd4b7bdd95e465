// SPDX-License-Identifier: MIT
// What windowsx.h unpacks out of messages. [Win32: windowsx.h]
#pragma once

#include <winuser.h>

#define GET_X_LPARAM(lparam) ((int)(short)LOWORD(lparam))
#define GET_Y_LPARAM(lparam) ((int)(short)HIWORD(lparam))

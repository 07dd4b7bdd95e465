// SPDX-License-Identifier: MIT
// timeGetTime, as milliseconds of GetTickCount. [Win32: timeapi.h]
#pragma once

#include <profileapi.h>

#define TIMERR_NOERROR 0
inline DWORD timeGetTime() {
  return GetTickCount();
}
inline UINT timeBeginPeriod(UINT) {
  return TIMERR_NOERROR;
}
inline UINT timeEndPeriod(UINT) {
  return TIMERR_NOERROR;
}

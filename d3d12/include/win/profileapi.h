// SPDX-License-Identifier: MIT
// Clocks. [Win32: profileapi.h, sysinfoapi.h]
#pragma once

#include <minwindef.h>

/// Ticks of a clock that never goes back, one billion per second.
///@{
EXTERN_C BOOL WINAPI QueryPerformanceCounter(LARGE_INTEGER* count);
EXTERN_C BOOL WINAPI QueryPerformanceFrequency(LARGE_INTEGER* frequency);
///@}
/// Milliseconds since some time before the program started.
///@{
EXTERN_C DWORD WINAPI GetTickCount();
EXTERN_C ULONGLONG WINAPI GetTickCount64();
///@}

// SPDX-License-Identifier: MIT
// This machine, and the time of day. [Win32: sysinfoapi.h]
#pragma once

#include <minwindef.h>

typedef struct _SYSTEM_INFO {
  WORD wProcessorArchitecture;
  WORD wReserved;
  DWORD dwPageSize;
  LPVOID lpMinimumApplicationAddress;
  LPVOID lpMaximumApplicationAddress;
  DWORD_PTR dwActiveProcessorMask;
  DWORD dwNumberOfProcessors;
  DWORD dwProcessorType;
  DWORD dwAllocationGranularity;
  WORD wProcessorLevel;
  WORD wProcessorRevision;
} SYSTEM_INFO, *LPSYSTEM_INFO;
typedef struct _SYSTEMTIME {
  WORD wYear;
  WORD wMonth;
  WORD wDayOfWeek;
  WORD wDay;
  WORD wHour;
  WORD wMinute;
  WORD wSecond;
  WORD wMilliseconds;
} SYSTEMTIME, *LPSYSTEMTIME;
typedef struct _MEMORYSTATUSEX {
  DWORD dwLength;
  DWORD dwMemoryLoad;
  DWORDLONG ullTotalPhys;
  DWORDLONG ullAvailPhys;
  DWORDLONG ullTotalPageFile;
  DWORDLONG ullAvailPageFile;
  DWORDLONG ullTotalVirtual;
  DWORDLONG ullAvailVirtual;
  DWORDLONG ullAvailExtendedVirtual;
} MEMORYSTATUSEX, *LPMEMORYSTATUSEX;

EXTERN_C void WINAPI GetSystemInfo(LPSYSTEM_INFO info);
EXTERN_C void WINAPI GetSystemTime(LPSYSTEMTIME time);
EXTERN_C void WINAPI GetLocalTime(LPSYSTEMTIME time);
/// Units of 100 ns since 1601.
EXTERN_C void WINAPI GetSystemTimeAsFileTime(LPFILETIME time);
EXTERN_C BOOL WINAPI GlobalMemoryStatusEx(LPMEMORYSTATUSEX status);

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

typedef struct _OSVERSIONINFOEXW {
  DWORD dwOSVersionInfoSize;
  DWORD dwMajorVersion;
  DWORD dwMinorVersion;
  DWORD dwBuildNumber;
  DWORD dwPlatformId;
  WCHAR szCSDVersion[128];
  WORD wServicePackMajor;
  WORD wServicePackMinor;
  WORD wSuiteMask;
  BYTE wProductType;
  BYTE wReserved;
} OSVERSIONINFOEXW, RTL_OSVERSIONINFOEXW, *LPOSVERSIONINFOEXW, *PRTL_OSVERSIONINFOEXW;
#define VER_MINORVERSION 0x1
#define VER_MAJORVERSION 0x2
#define VER_BUILDNUMBER 0x4
#define VER_EQUAL 1
#define VER_GREATER_EQUAL 3
#define VER_SET_CONDITION(mask, type, condition) \
  ((mask) = VerSetConditionMask((mask), (type), (condition)))
/// Three bits of `condition` for each kind of version.
inline ULONGLONG VerSetConditionMask(ULONGLONG mask, DWORD type, BYTE condition) {
  for (int bit = 0; bit < 8; ++bit) {
    if ((type & (1u << bit)) != 0) mask |= (ULONGLONG)(condition & 7) << (3 * bit);
  }
  return mask;
}

EXTERN_C void WINAPI GetSystemInfo(LPSYSTEM_INFO info);
EXTERN_C void WINAPI GetSystemTime(LPSYSTEMTIME time);
EXTERN_C void WINAPI GetLocalTime(LPSYSTEMTIME time);
/// Units of 100 ns since 1601.
EXTERN_C void WINAPI GetSystemTimeAsFileTime(LPFILETIME time);
EXTERN_C BOOL WINAPI GlobalMemoryStatusEx(LPMEMORYSTATUSEX status);

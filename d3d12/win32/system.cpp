// SPDX-License-Identifier: MIT
// Clocks, debug output and this machine.
#include <windows.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <thread>

#include "d3d12/com/text.h"

namespace {

LONGLONG nanoseconds() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

SYSTEMTIME time_of_day(tm* (*convert)(const time_t*, tm*)) {
  const auto now = std::chrono::system_clock::now();
  const time_t seconds = std::chrono::system_clock::to_time_t(now);
  const auto whole = std::chrono::system_clock::from_time_t(seconds);
  const auto rest = std::chrono::duration_cast<std::chrono::milliseconds>(now - whole).count();
  tm parts = {};
  convert(&seconds, &parts);
  const auto word = [](int64_t value) { return static_cast<WORD>(value); };
  return {
      word(parts.tm_year + 1900), word(parts.tm_mon + 1), word(parts.tm_wday), word(parts.tm_mday),
      word(parts.tm_hour),        word(parts.tm_min),     word(parts.tm_sec),  word(rest)};
}

}  // namespace

extern "C" {

BOOL WINAPI QueryPerformanceCounter(LARGE_INTEGER* count) {
  count->QuadPart = nanoseconds();
  return TRUE;
}

BOOL WINAPI QueryPerformanceFrequency(LARGE_INTEGER* frequency) {
  frequency->QuadPart = 1'000'000'000;
  return TRUE;
}

ULONGLONG WINAPI GetTickCount64() {
  return static_cast<ULONGLONG>(nanoseconds() / 1'000'000);
}
DWORD WINAPI GetTickCount() {
  return static_cast<DWORD>(GetTickCount64());
}

void WINAPI OutputDebugStringA(LPCSTR text) {
  if (text != nullptr) std::fputs(text, stderr);
}

void WINAPI OutputDebugStringW(LPCWSTR text) {
  if (text != nullptr) std::fputs(kaamos::d3d12::to_utf8(text).c_str(), stderr);
}

void WINAPI GetSystemInfo(LPSYSTEM_INFO info) {
  *info = {};
  info->wProcessorArchitecture = 9;  // PROCESSOR_ARCHITECTURE_AMD64
  info->dwPageSize = static_cast<DWORD>(::sysconf(_SC_PAGESIZE));
  info->dwNumberOfProcessors = std::max(1u, std::thread::hardware_concurrency());
  info->dwAllocationGranularity = 65536;
}

void WINAPI GetSystemTimeAsFileTime(LPFILETIME time) {
  constexpr int64_t kFrom1601 = 116'444'736'000'000'000;
  const auto since_1970 = std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::system_clock::now().time_since_epoch());
  const int64_t ticks = since_1970.count() / 100 + kFrom1601;
  time->dwLowDateTime = static_cast<DWORD>(ticks);
  time->dwHighDateTime = static_cast<DWORD>(ticks >> 32);
}

void WINAPI GetSystemTime(LPSYSTEMTIME time) {
  *time = time_of_day(&::gmtime_r);
}
void WINAPI GetLocalTime(LPSYSTEMTIME time) {
  *time = time_of_day(&::localtime_r);
}

BOOL WINAPI GlobalMemoryStatusEx(LPMEMORYSTATUSEX status) {
  const auto page = static_cast<DWORDLONG>(::sysconf(_SC_PAGESIZE));
  const DWORD length = status->dwLength;
  *status = {};
  status->dwLength = length;
  status->ullTotalPhys = page * static_cast<DWORDLONG>(::sysconf(_SC_PHYS_PAGES));
  status->ullAvailPhys = page * static_cast<DWORDLONG>(::sysconf(_SC_AVPHYS_PAGES));
  status->ullTotalPageFile = status->ullTotalPhys;
  status->ullAvailPageFile = status->ullAvailPhys;
  status->ullTotalVirtual = status->ullAvailVirtual = DWORDLONG{1} << 47;
  status->dwMemoryLoad =
      static_cast<DWORD>(100 - 100 * status->ullAvailPhys / status->ullTotalPhys);
  return TRUE;
}

}  // extern "C"

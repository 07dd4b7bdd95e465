// SPDX-License-Identifier: MIT
// The part of Win32 that D3D12 programs use. README.md lists it.
#pragma once

#include <limits.h>
#include <string.h>

#include <consoleapi.h>
#include <debugapi.h>
#include <fileapi.h>
#include <handleapi.h>
#include <heapapi.h>
#include <libloaderapi.h>
#include <memoryapi.h>
#include <minwindef.h>
#include <objbase.h>
#include <processenv.h>
#include <processthreadsapi.h>
#include <profileapi.h>
#include <securitybaseapi.h>
#include <synchapi.h>
#include <sysinfoapi.h>
#include <winapifamily.h>
#include <winbase.h>
#include <winerror.h>
#include <winnls.h>
#include <winnt.h>
#include <winuser.h>
#ifndef WIN32_LEAN_AND_MEAN
#include <shellapi.h>
#include <timeapi.h>
#endif

#define ZeroMemory(destination, bytes) memset((destination), 0, (bytes))
#define FillMemory(destination, bytes, value) memset((destination), (value), (bytes))
#define CopyMemory(destination, source, bytes) memcpy((destination), (source), (bytes))
#define MoveMemory(destination, source, bytes) memmove((destination), (source), (bytes))
#define SecureZeroMemory(destination, bytes) memset((destination), 0, (bytes))

#ifndef TEXT
#ifdef UNICODE
#define TEXT(text) L##text
#else
#define TEXT(text) text
#endif
#endif

#ifndef NOMINMAX
// Not macros, which the standard library could not live with.
template <class A, class B>
constexpr auto max(const A& a, const B& b) {
  return a < b ? b : a;
}
template <class A, class B>
constexpr auto min(const A& a, const B& b) {
  return b < a ? b : a;
}
#endif

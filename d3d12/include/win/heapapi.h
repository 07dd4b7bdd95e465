// SPDX-License-Identifier: MIT
// The process heap. [Win32: heapapi.h]
#pragma once

#include <minwindef.h>
#include <stdlib.h>

#define HEAP_ZERO_MEMORY 0x8
inline HANDLE GetProcessHeap() {
  return (HANDLE)(LONG_PTR)1;
}
inline LPVOID HeapAlloc(HANDLE, DWORD flags, SIZE_T bytes) {
  return (flags & HEAP_ZERO_MEMORY) != 0 ? calloc(1, bytes) : malloc(bytes);
}
inline BOOL HeapFree(HANDLE, DWORD, LPVOID memory) {
  free(memory);
  return TRUE;
}

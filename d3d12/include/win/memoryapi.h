// SPDX-License-Identifier: MIT
// Pages of memory, and files that are mapped to memory. [Win32: memoryapi.h]
#pragma once

#include <handleapi.h>
#include <kaamos_text.h>
#include <stdlib.h>
#include <string.h>

#define MEM_COMMIT 0x1000
#define MEM_RESERVE 0x2000
#define MEM_DECOMMIT 0x4000
#define MEM_RELEASE 0x8000
#define PAGE_NOACCESS 0x01
#define PAGE_READONLY 0x02
#define PAGE_READWRITE 0x04

/// Zeros, from a multiple of 64 KiB, committed at once; null where `address` is not.
inline LPVOID VirtualAlloc(LPVOID address, SIZE_T bytes, DWORD, DWORD) {
  void* memory = NULL;
  if (address != NULL || bytes == 0 || posix_memalign(&memory, 65536, bytes) != 0) return NULL;
  return memset(memory, 0, bytes);
}
/// MEM_RELEASE frees what VirtualAlloc gave; MEM_DECOMMIT changes nothing.
inline BOOL VirtualFree(LPVOID address, SIZE_T, DWORD kind) {
  if (kind == MEM_RELEASE) free(address);
  return TRUE;
}

#define FILE_MAP_WRITE 0x2
#define FILE_MAP_READ 0x4
#define FILE_MAP_ALL_ACCESS 0xF001F
/// Pages that are read, or read and written; a file that is shorter grows. INVALID_HANDLE_VALUE is
/// memory alone. Names are ignored: there is one process.
///@{
EXTERN_C HANDLE WINAPI CreateFileMappingA(HANDLE file, LPSECURITY_ATTRIBUTES attributes,
                                          DWORD protection, DWORD size_high, DWORD size_low,
                                          LPCSTR name);
EXTERN_C HANDLE WINAPI CreateFileMappingW(HANDLE file, LPSECURITY_ATTRIBUTES attributes,
                                          DWORD protection, DWORD size_high, DWORD size_low,
                                          LPCWSTR name);
///@}
/// `offset` is a multiple of 64 KiB; 0 bytes is all that follows.
EXTERN_C LPVOID WINAPI MapViewOfFile(HANDLE mapping, DWORD access, DWORD offset_high,
                                     DWORD offset_low, SIZE_T bytes);
EXTERN_C BOOL WINAPI UnmapViewOfFile(LPCVOID address);
/// Writes the whole view, whichever the number of bytes.
EXTERN_C BOOL WINAPI FlushViewOfFile(LPCVOID address, SIZE_T bytes);

KAAMOS_TEXT_CALL(CreateFileMapping);

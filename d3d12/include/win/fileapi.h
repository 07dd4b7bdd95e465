// SPDX-License-Identifier: MIT
// Files. Paths may have backslashes. [Win32: fileapi.h]
#pragma once

#include <handleapi.h>
#include <kaamos_text.h>

#define GENERIC_READ 0x80000000u
#define GENERIC_WRITE 0x40000000u
#define GENERIC_ALL 0x10000000u
#define FILE_SHARE_READ 0x1
#define FILE_SHARE_WRITE 0x2
#define FILE_SHARE_DELETE 0x4
#define CREATE_NEW 1
#define CREATE_ALWAYS 2
#define OPEN_EXISTING 3
#define OPEN_ALWAYS 4
#define TRUNCATE_EXISTING 5
#define FILE_ATTRIBUTE_READONLY 0x1
#define FILE_ATTRIBUTE_HIDDEN 0x2
#define FILE_ATTRIBUTE_DIRECTORY 0x10
#define FILE_ATTRIBUTE_NORMAL 0x80
#define FILE_FLAG_SEQUENTIAL_SCAN 0x08000000
#define SECURITY_SQOS_PRESENT 0x00100000
#define SECURITY_ANONYMOUS 0
#define INVALID_FILE_ATTRIBUTES ((DWORD)-1)
#define INVALID_FILE_SIZE ((DWORD)0xFFFFFFFF)
#define INVALID_SET_FILE_POINTER ((DWORD)-1)
#define FILE_BEGIN 0
#define FILE_CURRENT 1
#define FILE_END 2

typedef struct _OVERLAPPED OVERLAPPED, *LPOVERLAPPED;
typedef struct _CREATEFILE2_EXTENDED_PARAMETERS {
  DWORD dwSize;
  DWORD dwFileAttributes;
  DWORD dwFileFlags;
  DWORD dwSecurityQosFlags;
  LPSECURITY_ATTRIBUTES lpSecurityAttributes;
  HANDLE hTemplateFile;
} CREATEFILE2_EXTENDED_PARAMETERS, *LPCREATEFILE2_EXTENDED_PARAMETERS;

typedef enum _FILE_INFO_BY_HANDLE_CLASS {
  FileBasicInfo,
  FileStandardInfo
} FILE_INFO_BY_HANDLE_CLASS;
typedef struct _FILE_STANDARD_INFO {
  LARGE_INTEGER AllocationSize;
  LARGE_INTEGER EndOfFile;
  DWORD NumberOfLinks;
  BOOLEAN DeletePending;
  BOOLEAN Directory;
} FILE_STANDARD_INFO, *PFILE_STANDARD_INFO;

#define KAAMOS_FIND_DATA(name, C) \
  typedef struct _##name {        \
    DWORD dwFileAttributes;       \
    FILETIME ftCreationTime;      \
    FILETIME ftLastAccessTime;    \
    FILETIME ftLastWriteTime;     \
    DWORD nFileSizeHigh;          \
    DWORD nFileSizeLow;           \
    DWORD dwReserved0;            \
    DWORD dwReserved1;            \
    C cFileName[MAX_PATH];        \
    C cAlternateFileName[14];     \
  } name, *P##name, *LP##name
KAAMOS_FIND_DATA(WIN32_FIND_DATAA, CHAR);
KAAMOS_FIND_DATA(WIN32_FIND_DATAW, WCHAR);
#undef KAAMOS_FIND_DATA
KAAMOS_TEXT_TYPE(WIN32_FIND_DATA);
typedef enum _FINDEX_INFO_LEVELS { FindExInfoStandard, FindExInfoBasic } FINDEX_INFO_LEVELS;
typedef enum _FINDEX_SEARCH_OPS {
  FindExSearchNameMatch,
  FindExSearchLimitToDirectories
} FINDEX_SEARCH_OPS;

EXTERN_C HANDLE WINAPI CreateFileA(LPCSTR path, DWORD access, DWORD share,
                                   LPSECURITY_ATTRIBUTES attributes, DWORD disposition, DWORD flags,
                                   HANDLE template_file);
EXTERN_C HANDLE WINAPI CreateFileW(LPCWSTR path, DWORD access, DWORD share,
                                   LPSECURITY_ATTRIBUTES attributes, DWORD disposition, DWORD flags,
                                   HANDLE template_file);
EXTERN_C HANDLE WINAPI CreateFile2(LPCWSTR path, DWORD access, DWORD share, DWORD disposition,
                                   LPCREATEFILE2_EXTENDED_PARAMETERS parameters);
/// Reads and writes wait; `overlapped` must be null.
///@{
EXTERN_C BOOL WINAPI ReadFile(HANDLE file, LPVOID buffer, DWORD size, LPDWORD read,
                              LPOVERLAPPED overlapped);
EXTERN_C BOOL WINAPI WriteFile(HANDLE file, LPCVOID buffer, DWORD size, LPDWORD written,
                               LPOVERLAPPED overlapped);
///@}
EXTERN_C DWORD WINAPI GetFileSize(HANDLE file, LPDWORD high);
EXTERN_C BOOL WINAPI GetFileSizeEx(HANDLE file, PLARGE_INTEGER size);
EXTERN_C DWORD WINAPI SetFilePointer(HANDLE file, LONG distance, PLONG high, DWORD method);
EXTERN_C BOOL WINAPI SetFilePointerEx(HANDLE file, LARGE_INTEGER distance, PLARGE_INTEGER position,
                                      DWORD method);
/// FileStandardInfo only.
EXTERN_C BOOL WINAPI GetFileInformationByHandleEx(HANDLE file, FILE_INFO_BY_HANDLE_CLASS kind,
                                                  LPVOID info, DWORD size);
/// A pattern has wildcards in its last part, and letter case does not count. Names come in order.
///@{
EXTERN_C HANDLE WINAPI FindFirstFileA(LPCSTR pattern, WIN32_FIND_DATAA* data);
EXTERN_C HANDLE WINAPI FindFirstFileW(LPCWSTR pattern, WIN32_FIND_DATAW* data);
EXTERN_C HANDLE WINAPI FindFirstFileExA(LPCSTR pattern, FINDEX_INFO_LEVELS level, LPVOID data,
                                        FINDEX_SEARCH_OPS search, LPVOID filter, DWORD flags);
EXTERN_C HANDLE WINAPI FindFirstFileExW(LPCWSTR pattern, FINDEX_INFO_LEVELS level, LPVOID data,
                                        FINDEX_SEARCH_OPS search, LPVOID filter, DWORD flags);
EXTERN_C BOOL WINAPI FindNextFileA(HANDLE search, WIN32_FIND_DATAA* data);
EXTERN_C BOOL WINAPI FindNextFileW(HANDLE search, WIN32_FIND_DATAW* data);
///@}
EXTERN_C BOOL WINAPI FindClose(HANDLE search);
EXTERN_C DWORD WINAPI GetFileAttributesA(LPCSTR path);
EXTERN_C DWORD WINAPI GetFileAttributesW(LPCWSTR path);
EXTERN_C BOOL WINAPI CreateDirectoryA(LPCSTR path, LPSECURITY_ATTRIBUTES attributes);
EXTERN_C BOOL WINAPI CreateDirectoryW(LPCWSTR path, LPSECURITY_ATTRIBUTES attributes);
EXTERN_C BOOL WINAPI DeleteFileA(LPCSTR path);
EXTERN_C BOOL WINAPI DeleteFileW(LPCWSTR path);
EXTERN_C DWORD WINAPI GetCurrentDirectoryA(DWORD size, LPSTR path);
EXTERN_C DWORD WINAPI GetCurrentDirectoryW(DWORD size, LPWSTR path);
EXTERN_C BOOL WINAPI SetCurrentDirectoryA(LPCSTR path);
EXTERN_C BOOL WINAPI SetCurrentDirectoryW(LPCWSTR path);

KAAMOS_TEXT_CALL(CreateFile);
KAAMOS_TEXT_CALL(FindFirstFile);
KAAMOS_TEXT_CALL(FindFirstFileEx);
KAAMOS_TEXT_CALL(FindNextFile);
KAAMOS_TEXT_CALL(GetFileAttributes);
KAAMOS_TEXT_CALL(CreateDirectory);
KAAMOS_TEXT_CALL(DeleteFile);
KAAMOS_TEXT_CALL(GetCurrentDirectory);
KAAMOS_TEXT_CALL(SetCurrentDirectory);

// SPDX-License-Identifier: MIT
// Paths of the shell, with slashes or backslashes. [Win32: shlwapi.h]
#pragma once

#include <fileapi.h>
#include <string.h>
#include <wchar.h>
#include <winbase.h>

/// Tells whether there is a file or folder of that name.
///@{
inline BOOL PathFileExistsA(LPCSTR path) {
  return GetFileAttributesA(path) != INVALID_FILE_ATTRIBUTES;
}
inline BOOL PathFileExistsW(LPCWSTR path) {
  return GetFileAttributesW(path) != INVALID_FILE_ATTRIBUTES;
}
///@}

/// Where `part` begins in `text`, whichever the case of ASCII letters; null if it is nowhere.
///@{
inline LPSTR StrStrIA(LPCSTR text, LPCSTR part) {
  return (LPSTR)strcasestr(text, part);
}
inline LPWSTR StrStrIW(LPCWSTR text, LPCWSTR part) {
  for (const SIZE_T length = wcslen(part);; ++text) {
    if (wcsncasecmp(text, part, length) == 0) return (LPWSTR)text;
    if (*text == 0) return NULL;
  }
}
///@}

KAAMOS_TEXT_CALL(PathFileExists);
KAAMOS_TEXT_CALL(StrStrI);

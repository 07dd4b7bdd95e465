// SPDX-License-Identifier: MIT
// Paths of the shell, with slashes or backslashes. [Win32: shlwapi.h]
#pragma once

#include <fileapi.h>
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

KAAMOS_TEXT_CALL(PathFileExists);

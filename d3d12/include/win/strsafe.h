// SPDX-License-Identifier: MIT
// Copies and prints that end with a zero. [Win32: strsafe.h]
#pragma once

#include <kaamos_crt.h>
#include <winerror.h>

#define STRSAFE_MAX_CCH 2147483647
#define STRSAFE_E_INSUFFICIENT_BUFFER ((HRESULT)0x8007007Au)
#define STRSAFE_E_INVALID_PARAMETER ((HRESULT)0x80070057u)

// The result of copying a text, which is cut where it does not fit.
inline HRESULT kaamos_fit(errno_t result) {
  return result == 0           ? S_OK
         : result == STRUNCATE ? STRSAFE_E_INSUFFICIENT_BUFFER
                               : STRSAFE_E_INVALID_PARAMETER;
}
inline HRESULT StringCchCopyA(LPSTR out, size_t count, LPCSTR text) {
  return kaamos_fit(strncpy_s(out, count, text, _TRUNCATE));
}
inline HRESULT StringCchCopyW(LPWSTR out, size_t count, LPCWSTR text) {
  return kaamos_fit(wcsncpy_s(out, count, text, _TRUNCATE));
}
inline HRESULT StringCchCatA(LPSTR out, size_t count, LPCSTR text) {
  return kaamos_fit(strncat_s(out, count, text, _TRUNCATE));
}
inline HRESULT StringCchCatW(LPWSTR out, size_t count, LPCWSTR text) {
  return kaamos_fit(wcsncat_s(out, count, text, _TRUNCATE));
}
inline HRESULT StringCchPrintfA(LPSTR out, size_t count, LPCSTR format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = kaamos_vprint(out, count, format, arguments);
  va_end(arguments);
  return length >= 0 ? S_OK : STRSAFE_E_INSUFFICIENT_BUFFER;
}
inline HRESULT StringCchPrintfW(LPWSTR out, size_t count, LPCWSTR format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = kaamos_vprint_wide(out, count, format, arguments);
  va_end(arguments);
  return length >= 0 ? S_OK : STRSAFE_E_INSUFFICIENT_BUFFER;
}
inline HRESULT StringCchLengthA(LPCSTR text, size_t limit, size_t* length) {
  const size_t n = strnlen_s(text, limit);
  if (text == nullptr || n == limit) return STRSAFE_E_INVALID_PARAMETER;
  if (length != nullptr) *length = n;
  return S_OK;
}
inline HRESULT StringCchLengthW(LPCWSTR text, size_t limit, size_t* length) {
  const size_t n = wcsnlen_s(text, limit);
  if (text == nullptr || n == limit) return STRSAFE_E_INVALID_PARAMETER;
  if (length != nullptr) *length = n;
  return S_OK;
}

#ifdef UNICODE
#define StringCchCopy StringCchCopyW
#define StringCchCat StringCchCatW
#define StringCchPrintf StringCchPrintfW
#define StringCchLength StringCchLengthW
#else
#define StringCchCopy StringCchCopyA
#define StringCchCat StringCchCatA
#define StringCchPrintf StringCchPrintfA
#define StringCchLength StringCchLengthA
#endif

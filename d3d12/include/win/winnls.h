// SPDX-License-Identifier: MIT
// Locales: there is one, of the United States. [Win32: winnls.h]
#pragma once

#include <kaamos_text.h>
#include <winbase.h>

typedef DWORD LCID, LCTYPE;
typedef WORD LANGID;
#define LANG_USER_DEFAULT 0x0400
#define LOCALE_USER_DEFAULT 0x0400
#define SORT_DEFAULT 0
#define MAKELCID(language, sort) ((DWORD)((((DWORD)(WORD)(sort)) << 16) | (WORD)(language)))
#define LOCALE_RETURN_NUMBER 0x20000000
#define LOCALE_IDEFAULTANSICODEPAGE 0x1004

/// Only the number of the code page, UTF-8; 0 for all else, as on failure.
///@{
inline int GetLocaleInfoA(LCID, LCTYPE type, LPSTR data, int size) {
  const DWORD page = CP_UTF8;
  if (type != (LOCALE_RETURN_NUMBER | LOCALE_IDEFAULTANSICODEPAGE)) return 0;
  if (size < (int)sizeof(page)) return size == 0 ? (int)sizeof(page) : 0;
  memcpy(data, &page, sizeof(page));
  return (int)sizeof(page);
}
inline int GetLocaleInfoW(LCID locale, LCTYPE type, LPWSTR data, int count) {
  return GetLocaleInfoA(locale, type, (LPSTR)data, count * (int)sizeof(WCHAR));
}
///@}
KAAMOS_TEXT_CALL(GetLocaleInfo);
/// UTF-8 has no such bytes.
inline BOOL IsDBCSLeadByte(BYTE) {
  return FALSE;
}
inline UINT GetACP() {
  return CP_UTF8;
}

// SPDX-License-Identifier: MIT
// The part of MSVC's C library beyond the standard that programs use. kaamos_add_d3d12_program
// includes it into every source, as MSVC has these names in <stdio.h>, <string.h> and so on.
//
// Formats of the functions here are MSVC's: in wide ones %s is a wide string, l makes an integer
// 32 bits wide, and I64 makes it 64. wprintf and fwprintf have them too; swprintf and the narrow
// calls of the standard keep this system's.
#pragma once

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>
#include <wchar.h>

typedef int errno_t;
typedef size_t rsize_t;
#define _TRUNCATE ((size_t)-1)
#ifndef STRUNCATE
#define STRUNCATE 80
#endif
#define _MAX_PATH 260
#define _MAX_DRIVE 3
#define _MAX_DIR 256
#define _MAX_FNAME 256
#define _MAX_EXT 256
#ifndef _countof
#define _countof(a) (sizeof(a) / sizeof((a)[0]))
#endif

extern "C" {
/// As vsnprintf and vswprintf, with MSVC's formats: the length, or -1 if `count` is too small,
/// which leaves the text cut short.
///@{
int kaamos_vprint(char* out, size_t count, const char* format, va_list arguments);
int kaamos_vprint_wide(wchar_t* out, size_t count, const wchar_t* format, va_list arguments);
///@}
/// The length that the text would have, or -1.
///@{
int kaamos_vlength(const char* format, va_list arguments);
int kaamos_vlength_wide(const wchar_t* format, va_list arguments);
///@}
/// To a stream: the length, or -1.
int kaamos_vfprint(FILE* file, const char* format, va_list arguments);
int kaamos_vfprint_wide(FILE* file, const wchar_t* format, va_list arguments);
/// As vsscanf and so on, with MSVC's formats, and a size behind each pointer to text: what does not
/// fit ends the call, and what it had found so far counts.
///@{
int kaamos_vscan(const char* text, const char* format, va_list arguments);
int kaamos_vscan_wide(const wchar_t* text, const wchar_t* format, va_list arguments);
int kaamos_vscan_file(FILE* file, const char* format, va_list arguments);
///@}
/// With slashes or backslashes in the path; kaamos_fopen is fopen.
FILE* _wfopen(const wchar_t* path, const wchar_t* mode);
FILE* kaamos_fopen(const char* path, const char* mode);
int _wtoi(const wchar_t* text);
double _wtof(const wchar_t* text);
void* _aligned_malloc(size_t size, size_t alignment);
void _aligned_free(void* memory);
errno_t _wsplitpath_s(const wchar_t* path, wchar_t* drive, size_t drive_count, wchar_t* dir,
                      size_t dir_count, wchar_t* name, size_t name_count, wchar_t* ext,
                      size_t ext_count);
errno_t _splitpath_s(const char* path, char* drive, size_t drive_count, char* dir, size_t dir_count,
                     char* name, size_t name_count, char* ext, size_t ext_count);
}

extern "C++" {

// A copy that does not fit leaves an empty string and returns ERANGE; with _TRUNCATE it is cut.
template <class C>
errno_t kaamos_copy(C* out, size_t count, const C* text, size_t length) {
  if (out == nullptr || count == 0) return 22;
  out[0] = C();
  if (text == nullptr) return 22;
  const bool cut = length == _TRUNCATE;
  size_t n = 0;
  while (n < length && text[n] != C()) ++n;
  if (n >= count && !cut) return 34;
  const size_t kept = n < count ? n : count - 1;
  for (size_t i = 0; i < kept; ++i) out[i] = text[i];
  out[kept] = C();
  return n == kept ? 0 : STRUNCATE;
}
template <class C>
errno_t kaamos_append(C* out, size_t count, const C* text, size_t length) {
  size_t used = 0;
  while (out != nullptr && used < count && out[used] != C()) ++used;
  if (out == nullptr || used == count) return 22;
  const errno_t result = kaamos_copy(out + used, count - used, text, length);
  if (result == 22 || result == 34) out[0] = C();
  return result;
}

#define KAAMOS_COPY_CALLS(C, copy, copy_n, append, append_n)               \
  inline errno_t copy(C* out, size_t count, const C* text) {               \
    return kaamos_copy(out, count, text, _TRUNCATE - 1);                   \
  }                                                                        \
  inline errno_t copy_n(C* out, size_t count, const C* text, size_t n) {   \
    return kaamos_copy(out, count, text, n);                               \
  }                                                                        \
  inline errno_t append(C* out, size_t count, const C* text) {             \
    return kaamos_append(out, count, text, _TRUNCATE - 1);                 \
  }                                                                        \
  inline errno_t append_n(C* out, size_t count, const C* text, size_t n) { \
    return kaamos_append(out, count, text, n);                             \
  }                                                                        \
  template <size_t N>                                                      \
  errno_t copy(C(&out)[N], const C* text) {                                \
    return copy(out, N, text);                                             \
  }                                                                        \
  template <size_t N>                                                      \
  errno_t copy_n(C(&out)[N], const C* text, size_t n) {                    \
    return copy_n(out, N, text, n);                                        \
  }                                                                        \
  template <size_t N>                                                      \
  errno_t append(C(&out)[N], const C* text) {                              \
    return append(out, N, text);                                           \
  }                                                                        \
  template <size_t N>                                                      \
  errno_t append_n(C(&out)[N], const C* text, size_t n) {                  \
    return append_n(out, N, text, n);                                      \
  }
KAAMOS_COPY_CALLS(char, strcpy_s, strncpy_s, strcat_s, strncat_s)
KAAMOS_COPY_CALLS(wchar_t, wcscpy_s, wcsncpy_s, wcscat_s, wcsncat_s)
#undef KAAMOS_COPY_CALLS

#define KAAMOS_PRINT_CALLS(C, vprint, vname, name, vname_n, name_n)                        \
  inline int vname(C* out, size_t count, const C* format, va_list arguments) {             \
    const int length = vprint(out, count, format, arguments);                              \
    if (length < 0 && out != nullptr && count != 0) out[0] = C();                          \
    return length;                                                                         \
  }                                                                                        \
  inline int vname_n(C* out, size_t count, size_t n, const C* format, va_list arguments) { \
    return vprint(out, n < count ? n + 1 : count, format, arguments);                      \
  }                                                                                        \
  inline int name(C* out, size_t count, const C* format, ...) {                            \
    va_list arguments;                                                                     \
    va_start(arguments, format);                                                           \
    const int length = vname(out, count, format, arguments);                               \
    va_end(arguments);                                                                     \
    return length;                                                                         \
  }                                                                                        \
  inline int name_n(C* out, size_t count, size_t n, const C* format, ...) {                \
    va_list arguments;                                                                     \
    va_start(arguments, format);                                                           \
    const int length = vname_n(out, count, n, format, arguments);                          \
    va_end(arguments);                                                                     \
    return length;                                                                         \
  }                                                                                        \
  template <size_t N>                                                                      \
  int vname(C(&out)[N], const C* format, va_list arguments) {                              \
    return vname(out, N, format, arguments);                                               \
  }                                                                                        \
  template <size_t N, class... Arguments>                                                  \
  int name(C(&out)[N], const C* format, Arguments... arguments) {                          \
    return name(out, N, format, arguments...);                                             \
  }                                                                                        \
  template <size_t N, class... Arguments>                                                  \
  int name_n(C(&out)[N], size_t n, const C* format, Arguments... arguments) {              \
    return name_n(out, N, n, format, arguments...);                                        \
  }
KAAMOS_PRINT_CALLS(char, kaamos_vprint, vsprintf_s, sprintf_s, _vsnprintf_s, _snprintf_s)
KAAMOS_PRINT_CALLS(wchar_t, kaamos_vprint_wide, vswprintf_s, swprintf_s, _vsnwprintf_s,
                   _snwprintf_s)
#undef KAAMOS_PRINT_CALLS

template <size_t N>
int _vsnprintf_s(char (&out)[N], size_t n, const char* format, va_list arguments) {
  return _vsnprintf_s(out, N, n, format, arguments);
}
template <size_t N>
int _vsnwprintf_s(wchar_t (&out)[N], size_t n, const wchar_t* format, va_list arguments) {
  return _vsnwprintf_s(out, N, n, format, arguments);
}

inline int printf_s(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = kaamos_vfprint(stdout, format, arguments);
  va_end(arguments);
  return length;
}
/// To the terminal.
///@{
inline int _vcprintf(const char* format, va_list arguments) {
  return kaamos_vfprint(stdout, format, arguments);
}
inline int _vcwprintf(const wchar_t* format, va_list arguments) {
  return kaamos_vfprint_wide(stdout, format, arguments);
}
///@}
inline int fprintf_s(FILE* file, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = kaamos_vfprint(file, format, arguments);
  va_end(arguments);
  return length;
}
inline int wprintf_s(const wchar_t* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = kaamos_vfprint_wide(stdout, format, arguments);
  va_end(arguments);
  return length;
}
/// The length that a text would have, or -1.
///@{
inline int _vscprintf(const char* format, va_list arguments) {
  return kaamos_vlength(format, arguments);
}
inline int _vscwprintf(const wchar_t* format, va_list arguments) {
  return kaamos_vlength_wide(format, arguments);
}
inline int _scprintf(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = _vscprintf(format, arguments);
  va_end(arguments);
  return length;
}
inline int _scwprintf(const wchar_t* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = _vscwprintf(format, arguments);
  va_end(arguments);
  return length;
}
///@}
inline int kaamos_fwprintf(FILE* file, const wchar_t* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int length = kaamos_vfprint_wide(file, format, arguments);
  va_end(arguments);
  return length;
}
inline int sscanf_s(const char* text, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int count = kaamos_vscan(text, format, arguments);
  va_end(arguments);
  return count;
}
inline int swscanf_s(const wchar_t* text, const wchar_t* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int count = kaamos_vscan_wide(text, format, arguments);
  va_end(arguments);
  return count;
}
inline int fscanf_s(FILE* file, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const int count = kaamos_vscan_file(file, format, arguments);
  va_end(arguments);
  return count;
}
// Paths have slashes here. Programs that look for their last backslash find the last of both.
inline char* kaamos_strrchr(const char* text, int c) {
  char* slash = (char*)strrchr(text, c);
  char* other = c == '\\' ? (char*)strrchr(text, '/') : nullptr;
  return other > slash ? other : slash;
}
inline wchar_t* kaamos_wcsrchr(const wchar_t* text, wchar_t c) {
  wchar_t* slash = (wchar_t*)wcsrchr(text, c);
  wchar_t* other = c == L'\\' ? (wchar_t*)wcsrchr(text, L'/') : nullptr;
  return other > slash ? other : slash;
}

inline errno_t memcpy_s(void* out, size_t count, const void* bytes, size_t size) {
  if (size > count) return 34;
  memcpy(out, bytes, size);
  return 0;
}
inline errno_t memmove_s(void* out, size_t count, const void* bytes, size_t size) {
  if (size > count) return 34;
  memmove(out, bytes, size);
  return 0;
}
inline errno_t fopen_s(FILE** file, const char* path, const char* mode) {
  *file = kaamos_fopen(path, mode);
  return *file != nullptr ? 0 : errno;
}
inline errno_t _wfopen_s(FILE** file, const wchar_t* path, const wchar_t* mode) {
  *file = _wfopen(path, mode);
  return *file != nullptr ? 0 : errno;
}
inline errno_t freopen_s(FILE** file, const char* path, const char* mode, FILE* old) {
  // A console's names stand for the terminal, which the streams are already.
  const bool console =
      path != nullptr && (strcmp(path, "CONOUT$") == 0 || strcmp(path, "CONIN$") == 0);
  *file = console ? old : freopen(path, mode, old);
  return *file != nullptr ? 0 : errno;
}
inline errno_t localtime_s(tm* out, const time_t* time) {
  return localtime_r(time, out) ? 0 : 22;
}
inline errno_t gmtime_s(tm* out, const time_t* time) {
  return gmtime_r(time, out) ? 0 : 22;
}
inline char* strtok_s(char* text, const char* set, char** rest) {
  return strtok_r(text, set, rest);
}
inline wchar_t* wcstok_s(wchar_t* text, const wchar_t* set, wchar_t** rest) {
  return wcstok(text, set, rest);
}
inline size_t strnlen_s(const char* text, size_t n) {
  return text != nullptr ? strnlen(text, n) : 0;
}
inline size_t wcsnlen_s(const wchar_t* text, size_t n) {
  return text != nullptr ? wcsnlen(text, n) : 0;
}
inline int _stricmp(const char* a, const char* b) {
  return strcasecmp(a, b);
}
inline int _strnicmp(const char* a, const char* b, size_t n) {
  return strncasecmp(a, b, n);
}
inline int _wcsicmp(const wchar_t* a, const wchar_t* b) {
  return wcscasecmp(a, b);
}
inline int _wcsnicmp(const wchar_t* a, const wchar_t* b, size_t n) {
  return wcsncasecmp(a, b, n);
}
inline char* _strdup(const char* text) {
  return strdup(text);
}
inline wchar_t* _wcsdup(const wchar_t* text) {
  return wcsdup(text);
}
inline errno_t _dupenv_s(char** value, size_t* size, const char* name) {
  const char* found = getenv(name);
  *value = found != nullptr ? strdup(found) : nullptr;
  if (size != nullptr) *size = found != nullptr ? strlen(found) + 1 : 0;
  return 0;
}
inline int _fseeki64(FILE* file, long long offset, int origin) {
  return fseeko(file, offset, origin);
}
inline long long _ftelli64(FILE* file) {
  return ftello(file);
}
}
#include <cstdio>
#include <cstring>
#include <cwchar>
namespace std {
using ::kaamos_fopen;
using ::kaamos_fwprintf;
using ::kaamos_strrchr;
using ::kaamos_wcsrchr;
using ::wprintf_s;
}  // namespace std
#define fopen kaamos_fopen
#define strrchr kaamos_strrchr
#define wcsrchr kaamos_wcsrchr
#define wprintf wprintf_s
#define fwprintf kaamos_fwprintf

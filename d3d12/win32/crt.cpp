// SPDX-License-Identifier: MIT
// MSVC's C library, where it differs.
#include <kaamos_crt.h>

#include <cerrno>
#include <string>

namespace {

// MSVC's format as the C library here reads it. In a wide format %s and %c are wide and %S is
// narrow; l is 32 bits, as long is on Windows; I64, I32 and I are its own.
template <class C>
std::basic_string<C> translate_format(const C* format) {
  const auto is = [](C c, char what) { return c == static_cast<C>(what); };
  std::basic_string<C> out;
  const auto copy_while = [&](const char* set) {
    for (; *format != C(); ++format) {
      const char* s = set;
      while (*s != 0 && !is(*format, *s)) ++s;
      if (*s == 0) return;
      out += *format;
    }
  };
  while (*format != C()) {
    out += *format;
    if (!is(*format++, '%')) continue;
    if (is(*format, '%')) {
      out += *format++;
      continue;
    }
    copy_while("-+ #0123456789.*'");
    int bits = 0;
    bool narrow = false, wide = false;
    if (is(*format, 'I')) {
      ++format;
      bits = 64;
      if (is(format[0], '6') && is(format[1], '4')) format += 2;
      if (is(format[0], '3') && is(format[1], '2')) format += 2, bits = 32;
    } else if (is(*format, 'l') && is(format[1], 'l')) {
      format += 2;
      bits = 64;
    } else if (is(*format, 'l') || is(*format, 'w')) {
      ++format;
      wide = true;
    } else if (is(*format, 'h') && !is(format[1], 'h')) {
      narrow = true;
      ++format;
      if (!is(*format, 's') && !is(*format, 'S') && !is(*format, 'c')) out += static_cast<C>('h');
    } else {
      copy_while("hjztL");
    }
    const bool text = is(*format, 's') || is(*format, 'c');
    const bool other_text = is(*format, 'S') || is(*format, 'C');
    if (text || other_text) {
      const bool as_wide = !narrow && (wide || text == (sizeof(C) > 1));
      if (as_wide) out += static_cast<C>('l');
      out += is(*format, 's') || is(*format, 'S') ? static_cast<C>('s') : static_cast<C>('c');
      ++format;
    } else {
      if (bits == 64) out.append(2, static_cast<C>('l'));
      if (*format != C()) out += *format++;
    }
  }
  return out;
}

}  // namespace

extern "C" {

int kaamos_vprint(char* out, size_t count, const char* format, va_list arguments) {
  if (out == nullptr || count == 0 || format == nullptr) return -1;
  const int length = std::vsnprintf(out, count, translate_format(format).c_str(), arguments);
  return length >= 0 && static_cast<size_t>(length) < count ? length : -1;
}

int kaamos_vprint_wide(wchar_t* out, size_t count, const wchar_t* format, va_list arguments) {
  if (out == nullptr || count == 0 || format == nullptr) return -1;
  const int length = std::vswprintf(out, count, translate_format(format).c_str(), arguments);
  if (length < 0) out[count - 1] = 0;
  return length;
}

int _wtoi(const wchar_t* text) {
  return static_cast<int>(std::wcstol(text, nullptr, 10));
}
double _wtof(const wchar_t* text) {
  return std::wcstod(text, nullptr);
}

void* _aligned_malloc(size_t size, size_t alignment) {
  void* memory = nullptr;
  const size_t least = alignment < sizeof(void*) ? sizeof(void*) : alignment;
  return posix_memalign(&memory, least, size) == 0 ? memory : nullptr;
}
void _aligned_free(void* memory) {
  std::free(memory);
}

}  // extern "C"

namespace {

template <class C>
errno_t split_path(const C* path, C* drive, size_t drive_count, C* dir, size_t dir_count, C* name,
                   size_t name_count, C* ext, size_t ext_count) {
  if (path == nullptr) return EINVAL;
  const std::basic_string<C> text = path;
  const C slashes[] = {'/', '\\', 0};
  const size_t start = text.size() > 1 && text[1] == static_cast<C>(':') ? 2 : 0;
  const size_t slash = text.find_last_of(slashes);
  const size_t base = slash == text.npos ? start : slash + 1;
  size_t dot = text.rfind(static_cast<C>('.'));
  if (dot == text.npos || dot < base) dot = text.size();
  const auto give = [&](C* out, size_t count, size_t first, size_t last) {
    return out == nullptr ? 0 : kaamos_copy(out, count, text.c_str() + first, last - first);
  };
  const errno_t results[] = {give(drive, drive_count, 0, start), give(dir, dir_count, start, base),
                             give(name, name_count, base, dot),
                             give(ext, ext_count, dot, text.size())};
  for (errno_t result : results) {
    if (result != 0) return result;
  }
  return 0;
}

}  // namespace

extern "C" {

errno_t _splitpath_s(const char* path, char* drive, size_t drive_count, char* dir, size_t dir_count,
                     char* name, size_t name_count, char* ext, size_t ext_count) {
  return split_path(path, drive, drive_count, dir, dir_count, name, name_count, ext, ext_count);
}
errno_t _wsplitpath_s(const wchar_t* path, wchar_t* drive, size_t drive_count, wchar_t* dir,
                      size_t dir_count, wchar_t* name, size_t name_count, wchar_t* ext,
                      size_t ext_count) {
  return split_path(path, drive, drive_count, dir, dir_count, name, name_count, ext, ext_count);
}

}  // extern "C"

// SPDX-License-Identifier: MIT
// MSVC's C library, where it differs.
#include <kaamos_crt.h>

#include <locale.h>
#include <cerrno>
#include <clocale>
#include <optional>
#include <string>
#include <vector>

#include "d3d12/com/text.h"

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

// Conversions between narrow and wide text are UTF-8's, whatever the program's locale.
class Utf8 {
 public:
  Utf8() : previous_(uselocale(locale())) {}
  ~Utf8() { uselocale(previous_); }
  Utf8(const Utf8&) = delete;
  Utf8& operator=(const Utf8&) = delete;

 private:
  static locale_t locale() {
    static const locale_t utf8 = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
    return utf8;
  }
  locale_t previous_;
};

// A call of scanf without sizes: the format as the C library here reads it, and the pointers.
template <class C>
struct Scan {
  std::basic_string<C> format;
  std::vector<void*> out;
};

constexpr size_t kMostConversions = 24;

// None if there are too many conversions. MSVC's size of a text becomes the conversion's width, if
// that is smaller.
template <class C>
std::optional<Scan<C>> read_scan(const C* format, va_list arguments) {
  Scan<C> scan;
  const auto is = [](C c, char what) { return c == static_cast<C>(what); };
  const auto put = [&](const char* text) {
    for (; *text != 0; ++text) scan.format += static_cast<C>(*text);
  };
  while (*format != C()) {
    const C c = *format++;
    scan.format += c;
    if (!is(c, '%')) continue;
    if (is(*format, '%')) {
      scan.format += *format++;
      continue;
    }
    const bool kept = !is(*format, '*');
    if (!kept) scan.format += *format++;
    size_t width = 0;
    while (*format >= static_cast<C>('0') && *format <= static_cast<C>('9')) {
      width = 10 * width + static_cast<size_t>(*format++ - static_cast<C>('0'));
    }
    std::string size;
    if (is(format[0], 'I')) {
      const bool is_32 = is(format[1], '3') && is(format[2], '2');
      const bool is_64 = is(format[1], '6') && is(format[2], '4');
      format += is_32 || is_64 ? 3 : 1;
      size = is_32 ? "" : "ll";
    }
    for (; is(*format, 'h') || is(*format, 'l') || is(*format, 'L') || is(*format, 'j') ||
           is(*format, 'z') || is(*format, 't') || is(*format, 'w');
         ++format) {
      size += static_cast<char>(*format);
    }
    if (*format == C()) break;
    const C kind = *format++;
    const bool character = is(kind, 'c') || is(kind, 'C');
    const bool text = character || is(kind, 's') || is(kind, 'S') || is(kind, '[');
    if (kept) {
      if (scan.out.size() == kMostConversions) return std::nullopt;
      scan.out.push_back(va_arg(arguments, void*));
    }
    if (text && kept) {
      // One character less, for the terminating zero.
      const size_t room = va_arg(arguments, unsigned) - (character ? 0 : 1);
      const size_t wanted = width == 0 && character ? 1 : width;
      width = wanted == 0 || wanted > room ? room : wanted;
      if (width == 0) return std::nullopt;
    }
    if (width != 0) put(std::to_string(width).c_str());
    if (text) {
      const bool capital = is(kind, 'S') || is(kind, 'C');
      const bool wide = size == "l" || size == "w" || (size != "h" && capital != (sizeof(C) > 1));
      if (wide) put("l");
      put(is(kind, '[') ? "[" : character ? "c" : "s");
      if (is(kind, '[')) {
        if (is(*format, '^')) scan.format += *format++;
        if (is(*format, ']')) scan.format += *format++;
        while (*format != C() && !is(*format, ']')) scan.format += *format++;
        if (*format != C()) scan.format += *format++;
      }
    } else {
      const bool real = is(kind, 'f') || is(kind, 'e') || is(kind, 'g') || is(kind, 'E') ||
                        is(kind, 'G') || is(kind, 'a');
      put(size == "l" && !real ? "" : size.c_str());  // long has 32 bits on Windows
      scan.format += kind;
    }
  }
  scan.out.resize(kMostConversions);
  return scan;
}

// Runs `call`, a function such as sscanf, with the format and kMostConversions pointers.
template <class C, class Call>
int run_scan(const C* format, va_list arguments, const Call& call) {
  const auto scan = format != nullptr ? read_scan(format, arguments) : std::nullopt;
  if (!scan) return EOF;
  const Utf8 utf8;
  const auto& p = scan->out;
  return call(scan->format.c_str(), p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8], p[9],
              p[10], p[11], p[12], p[13], p[14], p[15], p[16], p[17], p[18], p[19], p[20], p[21],
              p[22], p[23]);
}

// What swprintf would write into a buffer that is large enough, of up to 2^20 characters.
std::optional<std::wstring> print_whole(const wchar_t* format, va_list arguments) {
  if (format == nullptr) return std::nullopt;
  std::wstring text(256, L'\0');
  for (;;) {
    va_list again;
    va_copy(again, arguments);
    const int length = kaamos_vprint_wide(text.data(), text.size(), format, again);
    va_end(again);
    if (length >= 0) {
      text.resize(static_cast<size_t>(length));
      return text;
    }
    if (text.size() > (1u << 20)) return std::nullopt;
    text.resize(4 * text.size());
  }
}

}  // namespace

// For the constructor of std::exception that kaamos_add_d3d12_program adds.
void kaamos_print_exception(const char* text);
void kaamos_print_exception(const char* text) {
  std::fprintf(stderr, "std::exception: %s\n", text != nullptr ? text : "");
}

extern "C" {

int kaamos_vscan(const char* text, const char* format, va_list arguments) {
  if (text == nullptr) return EOF;
  return run_scan(format, arguments,
                  [&](auto... out) { return std::sscanf(text, out...); });  // NOLINT
}

int kaamos_vscan_wide(const wchar_t* text, const wchar_t* format, va_list arguments) {
  if (text == nullptr) return EOF;
  return run_scan(format, arguments, [&](auto... out) { return std::swscanf(text, out...); });
}

int kaamos_vscan_file(FILE* file, const char* format, va_list arguments) {
  if (file == nullptr) return EOF;
  return run_scan(format, arguments,
                  [&](auto... out) { return std::fscanf(file, out...); });  // NOLINT
}

int kaamos_vfprint(FILE* file, const char* format, va_list arguments) {
  if (file == nullptr || format == nullptr) return -1;
  const Utf8 utf8;
  return std::vfprintf(file, translate_format(format).c_str(), arguments);
}

// A stream has one width: this is narrow, so that it mixes with printf.
int kaamos_vfprint_wide(FILE* file, const wchar_t* format, va_list arguments) {
  if (file == nullptr) return -1;
  const auto text = print_whole(format, arguments);
  if (!text) return -1;
  const bool written = std::fputs(kaamos::d3d12::to_utf8(text->c_str()).c_str(), file) >= 0;
  return written ? static_cast<int>(text->size()) : -1;
}

int kaamos_vlength(const char* format, va_list arguments) {
  if (format == nullptr) return -1;
  const Utf8 utf8;
  return std::vsnprintf(nullptr, 0, translate_format(format).c_str(), arguments);
}

int kaamos_vlength_wide(const wchar_t* format, va_list arguments) {
  const auto text = print_whole(format, arguments);
  return text ? static_cast<int>(text->size()) : -1;
}

int kaamos_vprint(char* out, size_t count, const char* format, va_list arguments) {
  if (out == nullptr || count == 0 || format == nullptr) return -1;
  const Utf8 utf8;
  const int length = std::vsnprintf(out, count, translate_format(format).c_str(), arguments);
  return length >= 0 && static_cast<size_t>(length) < count ? length : -1;
}

int kaamos_vprint_wide(wchar_t* out, size_t count, const wchar_t* format, va_list arguments) {
  if (out == nullptr || count == 0 || format == nullptr) return -1;
  const Utf8 utf8;
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

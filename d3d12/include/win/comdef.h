// SPDX-License-Identifier: MIT
// _com_error: an HRESULT as an exception. [MSVC: comdef.h]
#pragma once

#include <combaseapi.h>
#include <kaamos_text.h>
#include <winbase.h>
#include <string>

class _com_error {
 public:
  _com_error(HRESULT result) noexcept : result_(result) {}  // NOLINT: implicit, as MSVC's
  HRESULT Error() const noexcept { return result_; }
  /// "0x80004005", or the code's name.
  const TCHAR* ErrorMessage() const {
    if (text_.empty()) {
      TCHAR text[256] = {};
      const DWORD length =
          FormatMessage(FORMAT_MESSAGE_FROM_SYSTEM, nullptr, (DWORD)result_, 0, text, 256, nullptr);
      text_.assign(text, length);
    }
    return text_.c_str();
  }

 private:
  HRESULT result_;
  mutable std::basic_string<TCHAR> text_;
};

[[noreturn]] inline void _com_raise_error(HRESULT result) {
  throw _com_error(result);
}

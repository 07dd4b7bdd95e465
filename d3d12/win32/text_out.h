// SPDX-License-Identifier: MIT
// Text that a call writes into the caller's buffer.
#pragma once

#include <windows.h>

#include <algorithm>
#include <string>

namespace kaamos::d3d12 {

/// Win32's rule: the length if the text fits with its zero, else the size that it needs.
template <class C>
DWORD hand_out_text(const std::basic_string<C>& text, C* out, DWORD size) {
  const auto length = static_cast<DWORD>(text.size());
  if (out == nullptr || size <= length) return length + 1;
  std::copy(text.begin(), text.end(), out);
  out[length] = C();
  return length;
}

}  // namespace kaamos::d3d12

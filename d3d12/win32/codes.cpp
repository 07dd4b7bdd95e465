// SPDX-License-Identifier: MIT
// Messages of error codes, and conversions of text.
#include <cstdio>
#include <cstring>

#include "d3d12/com/text.h"
#include "d3d12/win32/handles.h"

namespace kaamos::d3d12 {

namespace {

struct Code {
  HRESULT value;
  const char* name;
};
#define KAAMOS_CODE(name) \
  Code {                  \
    name, #name           \
  }
constexpr Code kCodes[] = {
    KAAMOS_CODE(S_OK),
    KAAMOS_CODE(E_NOTIMPL),
    KAAMOS_CODE(E_NOINTERFACE),
    KAAMOS_CODE(E_POINTER),
    KAAMOS_CODE(E_ABORT),
    KAAMOS_CODE(E_FAIL),
    KAAMOS_CODE(E_UNEXPECTED),
    KAAMOS_CODE(E_ACCESSDENIED),
    KAAMOS_CODE(E_HANDLE),
    KAAMOS_CODE(E_OUTOFMEMORY),
    KAAMOS_CODE(E_INVALIDARG),
    KAAMOS_CODE(E_NOT_SUFFICIENT_BUFFER),
    KAAMOS_CODE(E_BOUNDS),
    KAAMOS_CODE(DXGI_ERROR_INVALID_CALL),
    KAAMOS_CODE(DXGI_ERROR_NOT_FOUND),
    KAAMOS_CODE(DXGI_ERROR_MORE_DATA),
    KAAMOS_CODE(DXGI_ERROR_UNSUPPORTED),
    KAAMOS_CODE(DXGI_ERROR_DEVICE_REMOVED),
    KAAMOS_CODE(DXGI_ERROR_DEVICE_HUNG),
    KAAMOS_CODE(DXGI_ERROR_DEVICE_RESET),
    KAAMOS_CODE(DXGI_ERROR_WAS_STILL_DRAWING),
    KAAMOS_CODE(DXGI_ERROR_DRIVER_INTERNAL_ERROR),
    KAAMOS_CODE(DXGI_ERROR_NOT_CURRENTLY_AVAILABLE),
    KAAMOS_CODE(DXGI_ERROR_SDK_COMPONENT_MISSING),
    KAAMOS_CODE(D3D12_ERROR_ADAPTER_NOT_FOUND),
    KAAMOS_CODE(D3D12_ERROR_DRIVER_VERSION_MISMATCH),
    Code{HRESULT_FROM_WIN32(ERROR_FILE_NOT_FOUND), "ERROR_FILE_NOT_FOUND"},
    Code{HRESULT_FROM_WIN32(ERROR_PATH_NOT_FOUND), "ERROR_PATH_NOT_FOUND"},
    Code{HRESULT_FROM_WIN32(ERROR_MOD_NOT_FOUND), "ERROR_MOD_NOT_FOUND"},
    Code{HRESULT_FROM_WIN32(ERROR_PROC_NOT_FOUND), "ERROR_PROC_NOT_FOUND"},
    Code{HRESULT_FROM_WIN32(ERROR_FILE_EXISTS), "ERROR_FILE_EXISTS"},
    Code{HRESULT_FROM_WIN32(ERROR_ALREADY_EXISTS), "ERROR_ALREADY_EXISTS"},
    Code{HRESULT_FROM_WIN32(ERROR_NOT_FOUND), "ERROR_NOT_FOUND"},
};
#undef KAAMOS_CODE

std::string message_of(DWORD code) {
  const HRESULT result = HRESULT_FROM_WIN32(code);
  char number[16] = {};
  std::snprintf(number, sizeof(number), "0x%08X", code);
  for (const Code& c : kCodes) {
    if (c.value == result) return std::string(c.name) + " (" + number + ")";
  }
  return std::string("error ") + number;
}

template <class C>
DWORD hand_out_message(const std::basic_string<C>& text, DWORD flags, C* buffer, DWORD size) {
  const auto length = static_cast<DWORD>(text.size());
  C* out = buffer;
  if ((flags & FORMAT_MESSAGE_ALLOCATE_BUFFER) != 0) {
    out = static_cast<C*>(LocalAlloc(LPTR, (length + 1) * sizeof(C)));
    std::memcpy(static_cast<void*>(buffer), &out, sizeof(out));  // a pointer to a pointer
  } else if (size <= length) {
    SetLastError(ERROR_INSUFFICIENT_BUFFER);
    return 0;
  }
  std::copy(text.begin(), text.end(), out);
  out[length] = C();
  return length;
}

// Win32's rule of both conversions: a size of 0 asks for the size; text with its zero counts it.
template <class C>
int hand_out_converted(std::basic_string<C> text, bool with_zero, C* out, int size) {
  const int needed = static_cast<int>(text.size()) + (with_zero ? 1 : 0);
  if (size == 0) return needed;
  if (size < needed) {
    SetLastError(ERROR_INSUFFICIENT_BUFFER);
    return 0;
  }
  std::copy(text.begin(), text.end(), out);
  if (with_zero) out[text.size()] = C();
  return needed;
}

}  // namespace

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the functions below are global

extern "C" {

DWORD FormatMessageA(DWORD flags, LPCVOID, DWORD message, DWORD, LPSTR buffer, DWORD size, void*) {
  return hand_out_message(message_of(message), flags, buffer, size);
}
DWORD FormatMessageW(DWORD flags, LPCVOID, DWORD message, DWORD, LPWSTR buffer, DWORD size, void*) {
  return hand_out_message(to_wide(message_of(message)), flags, buffer, size);
}

int WINAPI MultiByteToWideChar(UINT, DWORD, LPCSTR text, int size, LPWSTR wide, int wide_size) {
  const auto length = size < 0 ? std::strlen(text) : static_cast<size_t>(size);
  return hand_out_converted(to_wide({text, length}), size < 0, wide, wide_size);
}

int WINAPI WideCharToMultiByte(UINT, DWORD, LPCWSTR wide, int wide_size, LPSTR text, int size,
                               LPCSTR, LPBOOL used) {
  if (used != nullptr) *used = FALSE;
  const auto length = wide_size < 0 ? std::wcslen(wide) : static_cast<size_t>(wide_size);
  return hand_out_converted(to_utf8(std::wstring_view(wide, length)), wide_size < 0, text, size);
}

}  // extern "C"

// SPDX-License-Identifier: MIT
// COM's base: IID_PPV_ARGS, memory. Apartments do not exist here: objects are free-threaded.
#pragma once

#include <stdlib.h>
#include <unknwnbase.h>
#include <type_traits>

extern "C++" {
template <class T>
void** IID_PPV_ARGS_Helper(T** pp) {
  static_assert(std::is_base_of<IUnknown, T>::value, "T is no COM interface");
  return reinterpret_cast<void**>(pp);
}
}
#define IID_PPV_ARGS(pp) __uuidof(**(pp)), IID_PPV_ARGS_Helper(pp)

enum COINIT { COINIT_APARTMENTTHREADED = 2, COINIT_MULTITHREADED = 0, COINIT_DISABLE_OLE1DDE = 4 };
inline HRESULT CoInitialize(void*) {
  return S_OK;
}
inline HRESULT CoInitializeEx(void*, DWORD) {
  return S_OK;
}
inline void CoUninitialize() {}
inline void* CoTaskMemAlloc(SIZE_T size) {
  return malloc(size);
}
inline void CoTaskMemFree(void* memory) {
  free(memory);
}

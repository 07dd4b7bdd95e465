// SPDX-License-Identifier: MIT
// Modules: this program, and the libraries of D3D12, which are linked into it.
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <string_view>

#include <d3dcompiler.h>
#include <directx/d3d12.h>
#include <directx/dxcore.h>
#include <dxcapi.h>
#include <dxgi1_6.h>
#include <dxgidebug.h>

#include "d3d12/com/text.h"
#include "d3d12/win32/handles.h"
#include "d3d12/win32/not_found.h"
#include "d3d12/win32/text_out.h"

namespace kaamos::d3d12 {

namespace {

struct Export {
  std::string_view name;
  FARPROC function;
};

template <class F>
FARPROC erase_type(F* function) {
  return reinterpret_cast<FARPROC>(reinterpret_cast<void*>(function));  // NOLINT: as it does
}

#define KAAMOS_EXPORT(name)  \
  Export {                   \
#name, erase_type(&name) \
  }
const Export kExports[] = {
    KAAMOS_EXPORT(D3D12CreateDevice),
    KAAMOS_EXPORT(D3D12GetDebugInterface),
    KAAMOS_EXPORT(D3D12GetInterface),
    KAAMOS_EXPORT(D3D12EnableExperimentalFeatures),
    KAAMOS_EXPORT(D3D12SerializeRootSignature),
    KAAMOS_EXPORT(D3D12SerializeVersionedRootSignature),
    KAAMOS_EXPORT(D3D12CreateRootSignatureDeserializer),
    KAAMOS_EXPORT(D3D12CreateVersionedRootSignatureDeserializer),
    KAAMOS_EXPORT(CreateDXGIFactory),
    KAAMOS_EXPORT(CreateDXGIFactory1),
    KAAMOS_EXPORT(CreateDXGIFactory2),
    KAAMOS_EXPORT(DXGIGetDebugInterface1),
    KAAMOS_EXPORT(DXGIGetDebugInterface),
    KAAMOS_EXPORT(DXGIDeclareAdapterRemovalSupport),
    Export{"DxcCreateInstance",
           erase_type(static_cast<HRESULT (*)(REFCLSID, REFIID, void**)>(&DxcCreateInstance))},
    Export{"DxcCreateInstance2",
           erase_type(
               static_cast<HRESULT (*)(IMalloc*, REFCLSID, REFIID, void**)>(&DxcCreateInstance2))},
    KAAMOS_EXPORT(D3DCompile),
    KAAMOS_EXPORT(D3DCompile2),
    KAAMOS_EXPORT(D3DCompileFromFile),
    KAAMOS_EXPORT(D3DReflect),
    KAAMOS_EXPORT(D3DReflectLibrary),
    KAAMOS_EXPORT(D3DCreateBlob),
    KAAMOS_EXPORT(D3DReadFileToBlob),
    KAAMOS_EXPORT(D3DWriteBlobToFile),
    KAAMOS_EXPORT(D3DGetBlobPart),
    KAAMOS_EXPORT(D3DPreprocess),
    Export{"DXCoreCreateAdapterFactory",
           erase_type(static_cast<HRESULT (*)(REFIID, void**)>(&DXCoreCreateAdapterFactory))},
};
#undef KAAMOS_EXPORT

constexpr std::string_view kModules[] = {"d3d12",          "dxgi",           "dxgidebug",  "dxcore",
                                         "d3d12core",      "d3d12sdklayers", "dxcompiler", "dxil",
                                         "d3dcompiler_47", "kernel32",       "user32"};

// "C:\dir\DXGI.dll" is dxgi.
std::string module_name(std::string path) {
  path = path.substr(path.find_last_of("/\\") + 1);
  std::transform(path.begin(), path.end(), path.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (path.ends_with(".dll")) path.resize(path.size() - 4);
  return path;
}

// Null is this program, whose number is 1.
HMODULE find_module(const std::string* name) {
  uintptr_t number = 1;
  if (name != nullptr) {
    const auto* found = std::find(std::begin(kModules), std::end(kModules), module_name(*name));
    if (found == std::end(kModules)) {
      tell_not_found("LoadLibrary", *name);
      SetLastError(ERROR_MOD_NOT_FOUND);
      return nullptr;
    }
    number = 2 + static_cast<uintptr_t>(found - std::begin(kModules));
  }
  return reinterpret_cast<HMODULE>(number);  // NOLINT: a module is a number
}

HMODULE find_module(LPCSTR name) {
  const std::string text = name != nullptr ? name : "";
  return find_module(name != nullptr ? &text : nullptr);
}

HMODULE find_module(LPCWSTR name) {
  const std::string text = to_utf8(name);
  return find_module(name != nullptr ? &text : nullptr);
}

std::string program_path() {
  char path[PATH_MAX] = {};
  const ssize_t length = ::readlink("/proc/self/exe", path, sizeof(path) - 1);
  return {path, length > 0 ? static_cast<size_t>(length) : 0};
}

// A path that does not fit is cut.
template <class C>
DWORD cut_text(std::basic_string<C> text, C* out, DWORD size) {
  if (out == nullptr || size == 0) return 0;
  if (text.size() >= size) {
    text.resize(size - 1);
    hand_out_text(text, out, size);
    SetLastError(ERROR_INSUFFICIENT_BUFFER);
    return size;
  }
  return hand_out_text(text, out, size);
}

}  // namespace

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the functions below are global

extern "C" {

HMODULE WINAPI GetModuleHandleA(LPCSTR name) {
  return find_module(name);
}
HMODULE WINAPI GetModuleHandleW(LPCWSTR name) {
  return find_module(name);
}
BOOL WINAPI GetModuleHandleExA(DWORD, LPCSTR name, HMODULE* module) {
  *module = find_module(name);
  return *module != nullptr;
}
BOOL WINAPI GetModuleHandleExW(DWORD, LPCWSTR name, HMODULE* module) {
  *module = find_module(name);
  return *module != nullptr;
}
HMODULE WINAPI LoadLibraryA(LPCSTR name) {
  return find_module(name);
}
HMODULE WINAPI LoadLibraryW(LPCWSTR name) {
  return find_module(name);
}
HMODULE WINAPI LoadLibraryExA(LPCSTR name, HANDLE, DWORD) {
  return find_module(name);
}
HMODULE WINAPI LoadLibraryExW(LPCWSTR name, HANDLE, DWORD) {
  return find_module(name);
}

BOOL WINAPI FreeLibrary(HMODULE module) {
  return succeed(module != nullptr, ERROR_INVALID_HANDLE, "FreeLibrary", "hLibModule is null.");
}

FARPROC WINAPI GetProcAddress(HMODULE, LPCSTR name) {
  // Numbers stand for names where the address is below 64 KiB.
  const bool is_name = reinterpret_cast<uintptr_t>(name) > 0xFFFF;  // NOLINT
  for (const Export& e : kExports) {
    if (is_name && e.name == name) return e.function;
  }
  SetLastError(ERROR_PROC_NOT_FOUND);
  return nullptr;
}

DWORD WINAPI GetModuleFileNameA(HMODULE, LPSTR path, DWORD size) {
  return cut_text(program_path(), path, size);
}
DWORD WINAPI GetModuleFileNameW(HMODULE, LPWSTR path, DWORD size) {
  return cut_text(to_wide(program_path()), path, size);
}

}  // extern "C"

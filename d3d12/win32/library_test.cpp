// SPDX-License-Identifier: MIT
#include <directx/d3d12.h>
#include <gtest/gtest.h>
#include <windows.h>

#include <filesystem>

namespace kaamos::d3d12 {
namespace {

TEST(Module, D3d12sLibrariesAreLoaded) {
  const HMODULE d3d12 = LoadLibraryW(L"d3d12.dll");
  ASSERT_NE(d3d12, nullptr);
  EXPECT_EQ(GetModuleHandleA("C:\\Windows\\System32\\D3D12.DLL"), d3d12);
  EXPECT_EQ(reinterpret_cast<void*>(GetProcAddress(d3d12, "D3D12CreateDevice")),
            reinterpret_cast<void*>(&D3D12CreateDevice));
  for (const char* name :
       {"dxgi.dll", "dxcore.dll", "dxcompiler.dll", "dxil.dll", "d3dcompiler_47.dll"}) {
    EXPECT_NE(LoadLibraryA(name), nullptr) << name;
  }
  for (const char* name :
       {"CreateDXGIFactory2", "DxcCreateInstance", "DxcCreateInstance2", "D3DCompile",
        "D3D12SerializeVersionedRootSignature", "DXCoreCreateAdapterFactory"}) {
    EXPECT_NE(GetProcAddress(d3d12, name), nullptr) << name;
  }
  EXPECT_TRUE(FreeLibrary(d3d12));
}

TEST(Module, OthersAreNotThere) {
  EXPECT_EQ(LoadLibraryW(L"WinPixGpuCapturer.dll"), nullptr);
  EXPECT_EQ(GetLastError(), DWORD{ERROR_MOD_NOT_FOUND});
  EXPECT_EQ(GetProcAddress(GetModuleHandleW(nullptr), "NoSuchFunction"), nullptr);
  EXPECT_EQ(GetLastError(), DWORD{ERROR_PROC_NOT_FOUND});
}

TEST(Module, ThisProgramHasAPath) {
  wchar_t path[MAX_PATH];
  const DWORD length = GetModuleFileNameW(nullptr, path, MAX_PATH);
  ASSERT_GT(length, 0u);
  EXPECT_TRUE(std::filesystem::exists(std::wstring(path, length)));
  char cut[4];
  EXPECT_EQ(GetModuleFileNameA(nullptr, cut, sizeof(cut)), sizeof(cut));
  EXPECT_EQ(GetLastError(), DWORD{ERROR_INSUFFICIENT_BUFFER});
  EXPECT_EQ(cut[3], '\0');
}

}  // namespace
}  // namespace kaamos::d3d12

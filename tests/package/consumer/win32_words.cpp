// SPDX-License-Identifier: MIT
// Win32 as sample programs write it: files through handles that close themselves, the program's own
// folder, windows, the screen's mode, and MSVC's C library. All names are in their UNICODE form.
#include <Windows.h>
#include <atlbase.h>
#include <comdef.h>
#include <d3d12.h>
#include <d3dcompiler.h>
#include <d3dx12/d3dx12.h>
#include <dwmapi.h>
#include <include\d3dx12\d3dx12.h>
#include <shlwapi.h>
#include <wrl.h>
#include <wrl\wrappers\corewrappers.h>

#include <cassert>
#include <cstdio>
#include <cwchar>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

namespace {

using Microsoft::WRL::Wrappers::Event;
using Microsoft::WRL::Wrappers::FileHandle;

std::wstring ProgramFolder() {
  WCHAR path[512];
  const DWORD size = GetModuleFileName(nullptr, path, _countof(path));
  if (size == 0 || size == _countof(path)) return {};
  if (WCHAR* last = wcsrchr(path, L'\\')) last[1] = L'\0';
  return path;
}

// The two pointers of MSVC that hold a COM object.
_COM_SMARTPTR_TYPEDEF(ID3DBlob, __uuidof(ID3DBlob));

bool HoldsBlobs() {
  CComPtr<ID3DBlob> blob;
  if (FAILED(D3DCreateBlob(16, &blob))) return false;
  ID3DBlobPtr same(blob);
  CComPtr<IUnknown> unknown;
  if (FAILED(blob.QueryInterface(&unknown))) return false;
  return same->GetBufferSize() == 16 && blob.IsEqualObject(unknown);
}

// D3D12 as Agility SDK 1.619 declares it, with older headers too.
bool AsksWhatNewHeadersHave() {
  CComPtr<ID3D12Device> device;
  if (FAILED(D3D12CreateDevice(nullptr, D3D_FEATURE_LEVEL_12_1, IID_PPV_ARGS(&device))))
    return false;
  D3D12_FEATURE_DATA_SHADER_MODEL model = {D3D_SHADER_MODEL_6_9};
  D3D12_FEATURE_DATA_D3D12_OPTIONS22 reorder = {};
  return SUCCEEDED(
             device->CheckFeatureSupport(D3D12_FEATURE_SHADER_MODEL, &model, sizeof(model))) &&
         SUCCEEDED(device->CheckFeatureSupport(D3D12_FEATURE_D3D12_OPTIONS22, &reorder,
                                               sizeof(reorder))) &&
         model.HighestShaderModel == D3D_SHADER_MODEL_6_9 &&
         !reorder.ShaderExecutionReorderingActuallyReorders;
}

// As many a WinMain does.
HRESULT ForgetsToReturn() {
  wprintf(L"%s formats\n", L"Wide");
}

bool ReadWhole(const std::wstring& name, std::vector<byte>& bytes) {
  CREATEFILE2_EXTENDED_PARAMETERS parameters = {};
  parameters.dwSize = sizeof(parameters);
  parameters.dwFileAttributes = FILE_ATTRIBUTE_NORMAL;
  parameters.dwFileFlags = FILE_FLAG_SEQUENTIAL_SCAN;
  parameters.dwSecurityQosFlags = SECURITY_ANONYMOUS;
  FileHandle file(
      CreateFile2(name.c_str(), GENERIC_READ, FILE_SHARE_READ, OPEN_EXISTING, &parameters));
  if (file.Get() == INVALID_HANDLE_VALUE) return false;
  FILE_STANDARD_INFO info = {};
  if (!GetFileInformationByHandleEx(file.Get(), FileStandardInfo, &info, sizeof(info)))
    return false;
  if (info.EndOfFile.HighPart != 0) return false;
  bytes.resize(info.EndOfFile.LowPart);
  DWORD read = 0;
  return ReadFile(file.Get(), bytes.data(), info.EndOfFile.LowPart, &read, nullptr) &&
         read == bytes.size();
}

// Streams take wide paths, and backslashes.
bool Streams(const std::wstring& folder) {
  std::ofstream((folder + L"words.txt").c_str()) << "wide";
  std::ifstream wide(folder + L"words.txt");
  std::string text, again;
  wide >> text;
  std::ifstream narrow(".\\none\\..\\words.txt");
  std::fstream both;
  both.open((folder + L".\\words.txt").c_str(), std::ios::in);
  both >> again;
  return text == "wide" && again == "wide" && !narrow && std::ifstream(L"none.txt").fail();
}

LRESULT CALLBACK Procedure(HWND window, UINT message, WPARAM wide, LPARAM lparam) {
  return DefWindowProc(window, message, wide, lparam);
}

// MSVC's constructor of std::exception takes a text.
bool ThrowsText() {
  try {
    throw std::exception("a text that is printed");
  } catch (const std::exception&) {
    return true;
  }
}

bool ShowWindows() {
  WNDCLASS kind = {};
  kind.lpfnWndProc = Procedure;
  kind.lpszClassName = L"Words";
  if (RegisterClass(&kind) == 0) return false;
  const HWND window = CreateWindowW(L"Words", L"Words", WS_OVERLAPPEDWINDOW, CW_USEDEFAULT, 0, 320,
                                    200, NULL, NULL, GetModuleHandle(NULL), NULL);
  if (window == NULL) return false;
  SetWindowLong(window, GWL_STYLE, GetWindowLong(window, GWL_STYLE) & ~WS_CAPTION);
  DEVMODE mode = {};
  mode.dmSize = sizeof(mode);
  if (!EnumDisplaySettings(nullptr, ENUM_CURRENT_SETTINGS, &mode)) return false;
  SetWindowPos(window, HWND_TOPMOST, mode.dmPosition.x, mode.dmPosition.y,
               static_cast<int>(mode.dmPelsWidth), static_cast<int>(mode.dmPelsHeight),
               SWP_FRAMECHANGED | SWP_NOACTIVATE);
  return DestroyWindow(window) != FALSE;
}

}  // namespace

int wmain(int argc, wchar_t** argv) {
#ifdef _DEBUG
  printf_s("a Debug build\n");
#endif
  assert(argc == 1);
  const std::wstring folder = ProgramFolder();
  if (folder.empty() || std::wstring(argv[0]).find(L"win32_words") == std::wstring::npos) return 1;
  std::vector<byte> bytes;
  if (!ReadWhole(folder + L"CMakeCache.txt", bytes) || bytes.empty()) return 2;
  if (!ShowWindows() || !ThrowsText()) return 3;
  Event event(CreateEventEx(nullptr, nullptr, 0, EVENT_MODIFY_STATE | SYNCHRONIZE));
  if (!event.IsValid() || WaitForSingleObject(event.Get(), 0) != WAIT_TIMEOUT) return 4;
  float x = 0, y = 0;
  char word[16];
  if (sscanf_s("vertex 1.5 2", "%15s %f %f", word, static_cast<unsigned>(sizeof(word)), &x, &y) !=
      3) {
    return 5;
  }
  if (!HoldsBlobs() || !AsksWhatNewHeadersHave()) return 7;
  if (!PathFileExists(folder.c_str())) return 8;
  if (!Streams(folder)) return 9;
  ForgetsToReturn();
  printf_s("Win32: %ls read, %S %I64u\n", L"CMakeCache.txt", L"bytes", static_cast<UINT64>(1));
  return y == 2.0f ? 0 : 6;
}

// SPDX-License-Identifier: MIT
// Windows: what they are, and what their functions change. Their messages are in
// window_messages.cpp.
#include "d3d12/win32/window.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "d3d12/com/text.h"
#include "d3d12/win32/handles.h"
#include "d3d12/win32/not_found.h"
#include "d3d12/win32/text_out.h"
#include "d3d12/win32/window_state.h"

namespace kaamos::d3d12 {

namespace {

constexpr int kScreenWidth = 1920;
constexpr int kScreenHeight = 1080;
constexpr SIZE kDefaultSize = {1280, 720};
constexpr int kDefaultFrames = 3;

// False past the screen's only mode.
template <class Mode>
BOOL give_mode(DWORD number, Mode* mode) {
  if (mode == nullptr) return FALSE;
  if (number != 0 && number != ENUM_CURRENT_SETTINGS && number != ENUM_REGISTRY_SETTINGS) {
    return FALSE;
  }
  *mode = {};
  mode->dmSize = sizeof(Mode);
  mode->dmBitsPerPel = 32;
  mode->dmPelsWidth = kScreenWidth;
  mode->dmPelsHeight = kScreenHeight;
  mode->dmDisplayFrequency = 60;
  return TRUE;
}

RECT screen() {
  return {0, 0, kScreenWidth, kScreenHeight};
}

bool succeed_window(bool found, const char* call) {
  return succeed(found, ERROR_INVALID_WINDOW_HANDLE, call, "hWnd names no window that lives.") != 0;
}

// A class is told by its name or, below 0x10000, by its number.
template <class C>
std::wstring class_key(const C* name) {
  const auto number = reinterpret_cast<uintptr_t>(name);  // NOLINT: Win32's rule
  if (number < 0x10000) return L"#" + std::to_wstring(number);
  if constexpr (std::is_same_v<C, char>) {
    return to_wide(name);
  } else {
    return name;
  }
}

template <class Desc>
ATOM register_class(const Desc* desc, bool wide, const char* call) {
  if (desc == nullptr || desc->lpfnWndProc == nullptr || desc->lpszClassName == nullptr) {
    return static_cast<ATOM>(succeed(false, ERROR_INVALID_PARAMETER, call,
                                     "the class has no lpfnWndProc or no lpszClassName."));
  }
  const std::wstring key = class_key(desc->lpszClassName);
  const ATOM atom = Windows::instance().add_class(key, {desc->lpfnWndProc, wide});
  succeed(atom != 0, ERROR_CLASS_ALREADY_EXISTS, call,
          "the class " + to_utf8(key) + " is there already.");
  return atom;
}

template <class C>
BOOL unregister_class(const C* name, const char* call) {
  const std::wstring key = class_key(name);
  return succeed(Windows::instance().remove_class(key), ERROR_CLASS_DOES_NOT_EXIST, call,
                 "there is no class " + to_utf8(key) + ".");
}

// [Win32: CreateWindowEx] WM_NCCREATE that returns FALSE, or WM_CREATE that returns -1, ends it.
template <class Create>
HWND create_window(Create create, std::wstring title, const char* call) {
  const std::wstring key = class_key(create.lpszClass);
  const auto found = Windows::instance().find_class(key);
  if (!found) {
    succeed(false, ERROR_CANNOT_FIND_WND_CLASS, call, "there is no class " + to_utf8(key) + ".");
    return nullptr;
  }
  if (create.x == CW_USEDEFAULT) create.x = create.y = 0;
  if (create.cx == CW_USEDEFAULT) {
    create.cx = kDefaultSize.cx;
    create.cy = kDefaultSize.cy;
  }
  auto window = std::make_shared<Window>();
  window->procedure = found->procedure;
  window->wide = found->wide;
  window->thread = current_queue();
  window->title = std::move(title);
  window->place = {create.x, create.y, create.x + std::max(create.cx, 0),
                   create.y + std::max(create.cy, 0)};
  window->values = {{GWL_STYLE, create.style},
                    {GWL_EXSTYLE, static_cast<LONG_PTR>(create.dwExStyle)},
                    {GWLP_HINSTANCE, reinterpret_cast<LONG_PTR>(create.hInstance)}};  // NOLINT
  const HWND handle = Windows::instance().add(window);
  const auto told = reinterpret_cast<LPARAM>(&create);  // NOLINT: Win32's rule
  if (SendMessageW(handle, WM_NCCREATE, 0, told) == 0 ||
      SendMessageW(handle, WM_CREATE, 0, told) == -1) {
    DestroyWindow(handle);
    return nullptr;
  }
  if ((create.style & WS_VISIBLE) != 0) ShowWindow(handle, SW_SHOW);
  return handle;
}

LPARAM pack(LONG low, LONG high) {
  return MAKELONG(static_cast<WORD>(low), static_cast<WORD>(high));
}

void tell_size(HWND handle, const RECT& place) {
  SendMessageW(handle, WM_SIZE, SIZE_RESTORED,
               pack(place.right - place.left, place.bottom - place.top));
}

BOOL set_place(HWND handle, RECT place, const char* call) {
  const auto window = Windows::instance().find(handle);
  if (!succeed_window(window != nullptr, call)) return FALSE;
  RECT before = {};
  {
    std::lock_guard lock(Windows::instance().mutex);
    before = window->place;
    window->place = place;
    window->needs_paint = true;
  }
  if (before.left != place.left || before.top != place.top) {
    SendMessageW(handle, WM_MOVE, 0, pack(place.left, place.top));
  }
  if (before.right - before.left != place.right - place.left ||
      before.bottom - before.top != place.bottom - place.top) {
    tell_size(handle, place);
  }
  return TRUE;
}

LONG_PTR exchange_value(HWND handle, int index, const LONG_PTR* value, const char* call) {
  const auto window = Windows::instance().find(handle);
  if (!succeed_window(window != nullptr, call)) return 0;
  std::lock_guard lock(Windows::instance().mutex);
  if (index == GWLP_WNDPROC) {
    const auto before = reinterpret_cast<LONG_PTR>(window->procedure);            // NOLINT
    if (value != nullptr) window->procedure = reinterpret_cast<WNDPROC>(*value);  // NOLINT
    return before;
  }
  const LONG_PTR before = window->values[index];
  if (value != nullptr) window->values[index] = *value;
  return before;
}

BOOL set_title(HWND handle, std::wstring title, const char* call) {
  const auto window = Windows::instance().find(handle);
  if (!succeed_window(window != nullptr, call)) return FALSE;
  std::lock_guard lock(Windows::instance().mutex);
  window->title = std::move(title);
  return TRUE;
}

std::wstring title_of(HWND handle, const char* call) {
  const auto window = Windows::instance().find(handle);
  if (!succeed_window(window != nullptr, call)) return {};
  std::lock_guard lock(Windows::instance().mutex);
  return window->title;
}

template <class C>
int give_title(std::basic_string<C> title, C* text, int count) {
  if (text == nullptr || count <= 0) return 0;
  title.resize(std::min(title.size(), static_cast<size_t>(count - 1)));
  return static_cast<int>(hand_out_text(title, text, static_cast<DWORD>(count)));
}

int show_message(const std::string& text, const std::string& caption, UINT type) {
  std::fprintf(stderr, "%s: %s\n", caption.c_str(), text.c_str());
  print_not_found();  // most boxes of programs tell of a failure
  const UINT buttons = type & 0xF;
  return buttons == MB_YESNO || buttons == MB_YESNOCANCEL ? IDYES : IDOK;
}

}  // namespace

std::optional<SIZE> window_size(HWND handle) {
  const auto window = Windows::instance().find(handle);
  if (window == nullptr) return std::nullopt;
  std::lock_guard lock(Windows::instance().mutex);
  const RECT& place = window->place;
  return SIZE{place.right - place.left, place.bottom - place.top};
}

int frame_limit() {
  const char* text = std::getenv("KAAMOS_FRAMES");
  if (text == nullptr) return kDefaultFrames;
  char* end = nullptr;
  const long frames = std::strtol(text, &end, 10);
  if (*text != 0 && *end == 0 && frames >= 1 && frames <= INT_MAX) return static_cast<int>(frames);
  succeed(false, ERROR_INVALID_PARAMETER, "KAAMOS_FRAMES",
          "it is \"" + std::string(text) + "\"; allowed are whole numbers from 1. The default, " +
              std::to_string(kDefaultFrames) + ", is taken.");
  return kDefaultFrames;
}

void count_frame(HWND handle) {
  const auto window = Windows::instance().find(handle);
  if (window == nullptr) return;
  static const int limit = frame_limit();
  int frames = 0;
  {
    std::lock_guard lock(Windows::instance().mutex);
    frames = ++window->frames;
  }
  if (frames >= limit) PostMessageW(handle, WM_CLOSE, 0, 0);
}

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the functions below are global

extern "C" {

ATOM WINAPI RegisterClassA(const WNDCLASSA* desc) {
  return register_class(desc, false, "RegisterClass");
}
ATOM WINAPI RegisterClassW(const WNDCLASSW* desc) {
  return register_class(desc, true, "RegisterClass");
}
ATOM WINAPI RegisterClassExA(const WNDCLASSEXA* desc) {
  return register_class(desc, false, "RegisterClassEx");
}
ATOM WINAPI RegisterClassExW(const WNDCLASSEXW* desc) {
  return register_class(desc, true, "RegisterClassEx");
}
BOOL WINAPI UnregisterClassA(LPCSTR name, HINSTANCE) {
  return unregister_class(name, "UnregisterClass");
}
BOOL WINAPI UnregisterClassW(LPCWSTR name, HINSTANCE) {
  return unregister_class(name, "UnregisterClass");
}

HWND WINAPI CreateWindowExA(DWORD ex_style, LPCSTR class_name, LPCSTR title, DWORD style, int x,
                            int y, int width, int height, HWND parent, HMENU menu,
                            HINSTANCE instance, LPVOID parameter) {
  const CREATESTRUCTA create = {
      parameter, instance,   menu,    parent, height, width, y, x, static_cast<LONG>(style),
      title,     class_name, ex_style};
  return create_window(create, to_wide(title != nullptr ? title : ""), "CreateWindowEx");
}
HWND WINAPI CreateWindowExW(DWORD ex_style, LPCWSTR class_name, LPCWSTR title, DWORD style, int x,
                            int y, int width, int height, HWND parent, HMENU menu,
                            HINSTANCE instance, LPVOID parameter) {
  const CREATESTRUCTW create = {
      parameter, instance,   menu,    parent, height, width, y, x, static_cast<LONG>(style),
      title,     class_name, ex_style};
  return create_window(create, title != nullptr ? title : L"", "CreateWindowEx");
}

BOOL WINAPI DestroyWindow(HWND handle) {
  const auto window = Windows::instance().find(handle);
  if (window == nullptr) {
    SetLastError(ERROR_INVALID_WINDOW_HANDLE);  // no message: many programs close what is closed
    return FALSE;
  }
  {
    std::lock_guard lock(Windows::instance().mutex);
    if (window->destroying) return TRUE;  // out of its own WM_DESTROY
    window->destroying = true;
  }
  SendMessageW(handle, WM_DESTROY, 0, 0);
  SendMessageW(handle, WM_NCDESTROY, 0, 0);
  Windows::instance().remove(handle);
  return TRUE;
}

BOOL WINAPI IsWindow(HWND handle) {
  return Windows::instance().find(handle) != nullptr;
}

BOOL WINAPI ShowWindow(HWND handle, int command) {
  const auto window = Windows::instance().find(handle);
  if (!succeed_window(window != nullptr, "ShowWindow")) return FALSE;
  const bool show = command != SW_HIDE && command != SW_MINIMIZE && command != SW_SHOWMINIMIZED;
  bool before = false;
  RECT place = {};
  {
    std::lock_guard lock(Windows::instance().mutex);
    before = window->visible;
    window->visible = show;
    window->needs_paint = show;
    place = window->place;
  }
  if (before == show) return before;
  SendMessageW(handle, WM_SHOWWINDOW, show ? TRUE : FALSE, 0);
  if (show) {
    SendMessageW(handle, WM_ACTIVATEAPP, TRUE, 0);
    SendMessageW(handle, WM_ACTIVATE, WA_ACTIVE, 0);
    SendMessageW(handle, WM_SETFOCUS, 0, 0);
    tell_size(handle, place);
    SendMessageW(handle, WM_MOVE, 0, pack(place.left, place.top));
  }
  return before;
}

BOOL WINAPI UpdateWindow(HWND handle) {
  const auto window = Windows::instance().find(handle);
  if (!succeed_window(window != nullptr, "UpdateWindow")) return FALSE;
  bool paint = false;
  {
    std::lock_guard lock(Windows::instance().mutex);
    paint = window->visible && window->needs_paint;
  }
  if (paint) SendMessageW(handle, WM_PAINT, 0, 0);
  return TRUE;
}

BOOL WINAPI IsWindowVisible(HWND handle) {
  const auto window = Windows::instance().find(handle);
  if (window == nullptr) return FALSE;
  std::lock_guard lock(Windows::instance().mutex);
  return window->visible;
}

BOOL WINAPI SetWindowPos(HWND handle, HWND, int x, int y, int width, int height, UINT flags) {
  RECT place = {};
  if (!GetWindowRect(handle, &place)) return FALSE;
  const LONG left = (flags & SWP_NOMOVE) != 0 ? place.left : x;
  const LONG top = (flags & SWP_NOMOVE) != 0 ? place.top : y;
  if ((flags & SWP_NOSIZE) != 0) {
    width = place.right - place.left;
    height = place.bottom - place.top;
  }
  if (!set_place(handle, {left, top, left + width, top + height}, "SetWindowPos")) return FALSE;
  if ((flags & SWP_SHOWWINDOW) != 0) ShowWindow(handle, SW_SHOW);
  return TRUE;
}

BOOL WINAPI MoveWindow(HWND handle, int x, int y, int width, int height, BOOL) {
  return set_place(handle, {x, y, x + width, y + height}, "MoveWindow");
}

BOOL WINAPI GetClientRect(HWND handle, LPRECT rect) {
  if (handle == GetDesktopWindow()) return *rect = screen(), TRUE;
  const auto size = window_size(handle);
  if (!succeed_window(size.has_value(), "GetClientRect")) return FALSE;
  *rect = {0, 0, size->cx, size->cy};
  return TRUE;
}

BOOL WINAPI GetWindowRect(HWND handle, LPRECT rect) {
  if (handle == GetDesktopWindow()) return *rect = screen(), TRUE;
  const auto window = Windows::instance().find(handle);
  if (!succeed_window(window != nullptr, "GetWindowRect")) return FALSE;
  std::lock_guard lock(Windows::instance().mutex);
  *rect = window->place;
  return TRUE;
}

LONG_PTR WINAPI SetWindowLongPtrA(HWND handle, int index, LONG_PTR value) {
  return exchange_value(handle, index, &value, "SetWindowLongPtr");
}
LONG_PTR WINAPI SetWindowLongPtrW(HWND handle, int index, LONG_PTR value) {
  return exchange_value(handle, index, &value, "SetWindowLongPtr");
}
LONG_PTR WINAPI GetWindowLongPtrA(HWND handle, int index) {
  return exchange_value(handle, index, nullptr, "GetWindowLongPtr");
}
LONG_PTR WINAPI GetWindowLongPtrW(HWND handle, int index) {
  return exchange_value(handle, index, nullptr, "GetWindowLongPtr");
}

LONG WINAPI SetWindowLongA(HWND handle, int index, LONG value) {
  return static_cast<LONG>(SetWindowLongPtrA(handle, index, value));
}
LONG WINAPI SetWindowLongW(HWND handle, int index, LONG value) {
  return static_cast<LONG>(SetWindowLongPtrW(handle, index, value));
}
LONG WINAPI GetWindowLongA(HWND handle, int index) {
  return static_cast<LONG>(GetWindowLongPtrA(handle, index));
}
LONG WINAPI GetWindowLongW(HWND handle, int index) {
  return static_cast<LONG>(GetWindowLongPtrW(handle, index));
}

BOOL WINAPI SetWindowTextA(HWND handle, LPCSTR text) {
  return set_title(handle, to_wide(text != nullptr ? text : ""), "SetWindowText");
}
BOOL WINAPI SetWindowTextW(HWND handle, LPCWSTR text) {
  return set_title(handle, text != nullptr ? text : L"", "SetWindowText");
}
int WINAPI GetWindowTextA(HWND handle, LPSTR text, int count) {
  return give_title(to_utf8(title_of(handle, "GetWindowText")), text, count);
}
int WINAPI GetWindowTextW(HWND handle, LPWSTR text, int count) {
  return give_title(title_of(handle, "GetWindowText"), text, count);
}

int WINAPI MessageBoxA(HWND, LPCSTR text, LPCSTR caption, UINT type) {
  return show_message(text != nullptr ? text : "", caption != nullptr ? caption : "Error", type);
}
int WINAPI MessageBoxW(HWND, LPCWSTR text, LPCWSTR caption, UINT type) {
  return show_message(to_utf8(text), caption != nullptr ? to_utf8(caption) : "Error", type);
}

HANDLE WINAPI LoadImageA(HINSTANCE, LPCSTR name, UINT, int, int, UINT flags) {
  if ((flags & LR_LOADFROMFILE) != 0 && GetFileAttributesA(name) == INVALID_FILE_ATTRIBUTES) {
    tell_not_found("LoadImage", to_path(name));
    return nullptr;
  }
  SetLastError(ERROR_RESOURCE_TYPE_NOT_FOUND);
  return nullptr;
}
HANDLE WINAPI LoadImageW(HINSTANCE instance, LPCWSTR name, UINT type, int width, int height,
                         UINT flags) {
  return LoadImageA(instance, (flags & LR_LOADFROMFILE) != 0 ? to_utf8(name).c_str() : nullptr,
                    type, width, height, flags);
}

int WINAPI GetSystemMetrics(int index) {
  switch (index) {
    case SM_CXSCREEN:
    case SM_CXVIRTUALSCREEN:
      return kScreenWidth;
    case SM_CYSCREEN:
    case SM_CYVIRTUALSCREEN:
      return kScreenHeight;
    default:
      return 0;
  }
}
BOOL WINAPI GetMonitorInfoA(HMONITOR, LPMONITORINFO info) {
  info->rcMonitor = info->rcWork = screen();
  info->dwFlags = 1;  // MONITORINFOF_PRIMARY
  return TRUE;
}
// The screen has one mode.
BOOL WINAPI EnumDisplaySettingsA(LPCSTR, DWORD number, DEVMODEA* mode) {
  return give_mode(number, mode);
}
BOOL WINAPI EnumDisplaySettingsW(LPCWSTR, DWORD number, DEVMODEW* mode) {
  return give_mode(number, mode);
}
BOOL WINAPI GetMonitorInfoW(HMONITOR monitor, LPMONITORINFO info) {
  return GetMonitorInfoA(monitor, info);
}

}  // extern "C"

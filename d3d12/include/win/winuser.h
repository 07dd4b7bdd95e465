// SPDX-License-Identifier: MIT
// Windows of a program: of the size it asks for, never shown, without input. A window lives for
// KAAMOS_FRAMES frames (default 3), then it is closed as if its user had done so.
// [Win32: winuser.h, wingdi.h]
#pragma once

#include <handleapi.h>
#include <kaamos_text.h>
#include <windef.h>

typedef LRESULT(CALLBACK* WNDPROC)(HWND, UINT, WPARAM, LPARAM);

typedef struct tagWNDCLASSEXA {
  UINT cbSize;
  UINT style;
  WNDPROC lpfnWndProc;
  int cbClsExtra;
  int cbWndExtra;
  HINSTANCE hInstance;
  HICON hIcon;
  HCURSOR hCursor;
  HBRUSH hbrBackground;
  LPCSTR lpszMenuName;
  LPCSTR lpszClassName;
  HICON hIconSm;
} WNDCLASSEXA, *LPWNDCLASSEXA;
typedef struct tagWNDCLASSEXW {
  UINT cbSize;
  UINT style;
  WNDPROC lpfnWndProc;
  int cbClsExtra;
  int cbWndExtra;
  HINSTANCE hInstance;
  HICON hIcon;
  HCURSOR hCursor;
  HBRUSH hbrBackground;
  LPCWSTR lpszMenuName;
  LPCWSTR lpszClassName;
  HICON hIconSm;
} WNDCLASSEXW, *LPWNDCLASSEXW;
typedef struct tagWNDCLASSA {
  UINT style;
  WNDPROC lpfnWndProc;
  int cbClsExtra;
  int cbWndExtra;
  HINSTANCE hInstance;
  HICON hIcon;
  HCURSOR hCursor;
  HBRUSH hbrBackground;
  LPCSTR lpszMenuName;
  LPCSTR lpszClassName;
} WNDCLASSA, *LPWNDCLASSA;
typedef struct tagWNDCLASSW {
  UINT style;
  WNDPROC lpfnWndProc;
  int cbClsExtra;
  int cbWndExtra;
  HINSTANCE hInstance;
  HICON hIcon;
  HCURSOR hCursor;
  HBRUSH hbrBackground;
  LPCWSTR lpszMenuName;
  LPCWSTR lpszClassName;
} WNDCLASSW, *LPWNDCLASSW;
typedef struct tagCREATESTRUCTA {
  LPVOID lpCreateParams;
  HINSTANCE hInstance;
  HMENU hMenu;
  HWND hwndParent;
  int cy;
  int cx;
  int y;
  int x;
  LONG style;
  LPCSTR lpszName;
  LPCSTR lpszClass;
  DWORD dwExStyle;
} CREATESTRUCTA, *LPCREATESTRUCTA;
typedef struct tagCREATESTRUCTW {
  LPVOID lpCreateParams;
  HINSTANCE hInstance;
  HMENU hMenu;
  HWND hwndParent;
  int cy;
  int cx;
  int y;
  int x;
  LONG style;
  LPCWSTR lpszName;
  LPCWSTR lpszClass;
  DWORD dwExStyle;
} CREATESTRUCTW, *LPCREATESTRUCTW;
typedef struct tagMSG {
  HWND hwnd;
  UINT message;
  WPARAM wParam;
  LPARAM lParam;
  DWORD time;
  POINT pt;
} MSG, *PMSG, *LPMSG;
typedef struct tagPAINTSTRUCT {
  HDC hdc;
  BOOL fErase;
  RECT rcPaint;
  BOOL fRestore;
  BOOL fIncUpdate;
  BYTE rgbReserved[32];
} PAINTSTRUCT, *PPAINTSTRUCT, *LPPAINTSTRUCT;
typedef struct tagMINMAXINFO {
  POINT ptReserved;
  POINT ptMaxSize;
  POINT ptMaxPosition;
  POINT ptMinTrackSize;
  POINT ptMaxTrackSize;
} MINMAXINFO, *PMINMAXINFO, *LPMINMAXINFO;
typedef struct tagMONITORINFO {
  DWORD cbSize;
  RECT rcMonitor;
  RECT rcWork;
  DWORD dwFlags;
} MONITORINFO, *LPMONITORINFO;

KAAMOS_TEXT_TYPE(WNDCLASSEX);
KAAMOS_TEXT_TYPE(WNDCLASS);
KAAMOS_TEXT_TYPE(CREATESTRUCT);
KAAMOS_TEXT_TYPE(LPCREATESTRUCT);

#include <winuser_constants.h>
#include <winuser_input.h>

// Classes and windows
EXTERN_C ATOM WINAPI RegisterClassA(const WNDCLASSA* desc);
EXTERN_C ATOM WINAPI RegisterClassW(const WNDCLASSW* desc);
EXTERN_C ATOM WINAPI RegisterClassExA(const WNDCLASSEXA* desc);
EXTERN_C ATOM WINAPI RegisterClassExW(const WNDCLASSEXW* desc);
EXTERN_C BOOL WINAPI UnregisterClassA(LPCSTR name, HINSTANCE instance);
EXTERN_C BOOL WINAPI UnregisterClassW(LPCWSTR name, HINSTANCE instance);
/// CW_USEDEFAULT is 1280 by 720. Frames and title bars take no space.
///@{
EXTERN_C HWND WINAPI CreateWindowExA(DWORD ex_style, LPCSTR class_name, LPCSTR title, DWORD style,
                                     int x, int y, int width, int height, HWND parent, HMENU menu,
                                     HINSTANCE instance, LPVOID parameter);
EXTERN_C HWND WINAPI CreateWindowExW(DWORD ex_style, LPCWSTR class_name, LPCWSTR title, DWORD style,
                                     int x, int y, int width, int height, HWND parent, HMENU menu,
                                     HINSTANCE instance, LPVOID parameter);
///@}
EXTERN_C BOOL WINAPI DestroyWindow(HWND window);
EXTERN_C BOOL WINAPI IsWindow(HWND window);
EXTERN_C BOOL WINAPI ShowWindow(HWND window, int command);
EXTERN_C BOOL WINAPI UpdateWindow(HWND window);
EXTERN_C BOOL WINAPI IsWindowVisible(HWND window);
EXTERN_C BOOL WINAPI SetWindowPos(HWND window, HWND after, int x, int y, int width, int height,
                                  UINT flags);
EXTERN_C BOOL WINAPI MoveWindow(HWND window, int x, int y, int width, int height, BOOL repaint);
EXTERN_C BOOL WINAPI GetClientRect(HWND window, LPRECT rect);
EXTERN_C BOOL WINAPI GetWindowRect(HWND window, LPRECT rect);
EXTERN_C LONG_PTR WINAPI SetWindowLongPtrA(HWND window, int index, LONG_PTR value);
EXTERN_C LONG_PTR WINAPI SetWindowLongPtrW(HWND window, int index, LONG_PTR value);
EXTERN_C LONG_PTR WINAPI GetWindowLongPtrA(HWND window, int index);
EXTERN_C LONG_PTR WINAPI GetWindowLongPtrW(HWND window, int index);
EXTERN_C LONG WINAPI SetWindowLongA(HWND window, int index, LONG value);
EXTERN_C LONG WINAPI SetWindowLongW(HWND window, int index, LONG value);
EXTERN_C LONG WINAPI GetWindowLongA(HWND window, int index);
EXTERN_C LONG WINAPI GetWindowLongW(HWND window, int index);
EXTERN_C BOOL WINAPI SetWindowTextA(HWND window, LPCSTR text);
EXTERN_C BOOL WINAPI SetWindowTextW(HWND window, LPCWSTR text);
EXTERN_C int WINAPI GetWindowTextA(HWND window, LPSTR text, int count);
EXTERN_C int WINAPI GetWindowTextW(HWND window, LPWSTR text, int count);

// Messages
EXTERN_C BOOL WINAPI PeekMessageA(LPMSG message, HWND window, UINT first, UINT last, UINT remove);
EXTERN_C BOOL WINAPI PeekMessageW(LPMSG message, HWND window, UINT first, UINT last, UINT remove);
EXTERN_C BOOL WINAPI GetMessageA(LPMSG message, HWND window, UINT first, UINT last);
EXTERN_C BOOL WINAPI GetMessageW(LPMSG message, HWND window, UINT first, UINT last);
EXTERN_C LRESULT WINAPI DispatchMessageA(const MSG* message);
EXTERN_C LRESULT WINAPI DispatchMessageW(const MSG* message);
EXTERN_C LRESULT WINAPI SendMessageA(HWND window, UINT message, WPARAM wparam, LPARAM lparam);
EXTERN_C LRESULT WINAPI SendMessageW(HWND window, UINT message, WPARAM wparam, LPARAM lparam);
EXTERN_C BOOL WINAPI PostMessageA(HWND window, UINT message, WPARAM wparam, LPARAM lparam);
EXTERN_C BOOL WINAPI PostMessageW(HWND window, UINT message, WPARAM wparam, LPARAM lparam);
EXTERN_C LRESULT WINAPI DefWindowProcA(HWND window, UINT message, WPARAM wparam, LPARAM lparam);
EXTERN_C LRESULT WINAPI DefWindowProcW(HWND window, UINT message, WPARAM wparam, LPARAM lparam);
EXTERN_C void WINAPI PostQuitMessage(int code);
EXTERN_C HDC WINAPI BeginPaint(HWND window, LPPAINTSTRUCT paint);
EXTERN_C BOOL WINAPI EndPaint(HWND window, const PAINTSTRUCT* paint);
EXTERN_C BOOL WINAPI ValidateRect(HWND window, const RECT* rect);
EXTERN_C BOOL WINAPI InvalidateRect(HWND window, const RECT* rect, BOOL erase);
inline BOOL TranslateMessage(const MSG*) {
  return FALSE;
}

/// Writes to the standard error stream; the answer is IDOK, or IDYES where there is no such button.
///@{
EXTERN_C int WINAPI MessageBoxA(HWND window, LPCSTR text, LPCSTR caption, UINT type);
EXTERN_C int WINAPI MessageBoxW(HWND window, LPCWSTR text, LPCWSTR caption, UINT type);
///@}
#define ENUM_CURRENT_SETTINGS ((DWORD)-1)
#define ENUM_REGISTRY_SETTINGS ((DWORD)-2)
#define KAAMOS_DEVMODE(name, C)  \
  typedef struct _##name {       \
    C dmDeviceName[32];          \
    WORD dmSpecVersion;          \
    WORD dmDriverVersion;        \
    WORD dmSize;                 \
    WORD dmDriverExtra;          \
    DWORD dmFields;              \
    POINT dmPosition;            \
    DWORD dmDisplayOrientation;  \
    DWORD dmDisplayFixedOutput;  \
    short dmColor;               \
    short dmDuplex;              \
    short dmYResolution;         \
    short dmTTOption;            \
    short dmCollate;             \
    C dmFormName[32];            \
    WORD dmLogPixels;            \
    DWORD dmBitsPerPel;          \
    DWORD dmPelsWidth;           \
    DWORD dmPelsHeight;          \
    DWORD dmDisplayFlags;        \
    DWORD dmDisplayFrequency;    \
    DWORD kaamos_of_printers[8]; \
  } name, *P##name, *LP##name
KAAMOS_DEVMODE(DEVMODEA, CHAR);
KAAMOS_DEVMODE(DEVMODEW, WCHAR);
#undef KAAMOS_DEVMODE
KAAMOS_TEXT_TYPE(DEVMODE);

/// The one monitor has 1920 by 1080 pixels, 32 bits each, 60 times a second.
///@{
EXTERN_C int WINAPI GetSystemMetrics(int index);
EXTERN_C BOOL WINAPI EnumDisplaySettingsA(LPCSTR device, DWORD mode, DEVMODEA* settings);
EXTERN_C BOOL WINAPI EnumDisplaySettingsW(LPCWSTR device, DWORD mode, DEVMODEW* settings);
EXTERN_C BOOL WINAPI GetMonitorInfoA(HMONITOR monitor, LPMONITORINFO info);
EXTERN_C BOOL WINAPI GetMonitorInfoW(HMONITOR monitor, LPMONITORINFO info);
///@}

// Frames take no space, so that a window's rectangle is that of its content.
inline BOOL AdjustWindowRect(LPRECT, DWORD, BOOL) {
  return TRUE;
}
inline BOOL AdjustWindowRectEx(LPRECT, DWORD, BOOL, DWORD) {
  return TRUE;
}
inline HMONITOR MonitorFromWindow(HWND, DWORD) {
  return (HMONITOR)(LONG_PTR)1;
}
inline HMONITOR MonitorFromPoint(POINT, DWORD) {
  return (HMONITOR)(LONG_PTR)1;
}
/// No user minimises or maximises a window.
///@{
inline BOOL IsIconic(HWND) {
  return FALSE;
}
inline BOOL IsZoomed(HWND) {
  return FALSE;
}
///@}

// There is no cursor and no icon.
inline HCURSOR LoadCursorA(HINSTANCE, LPCSTR) {
  return (HCURSOR)(LONG_PTR)1;
}
inline HCURSOR LoadCursorW(HINSTANCE, LPCWSTR) {
  return (HCURSOR)(LONG_PTR)1;
}
inline HICON LoadIconA(HINSTANCE, LPCSTR) {
  return (HICON)(LONG_PTR)1;
}
inline HICON LoadIconW(HINSTANCE, LPCWSTR) {
  return (HICON)(LONG_PTR)1;
}
inline BOOL DestroyIcon(HICON) {
  return TRUE;
}
/// There are no image files for windows: null, with GetLastError() ERROR_RESOURCE_TYPE_NOT_FOUND.
///@{
EXTERN_C HANDLE WINAPI LoadImageA(HINSTANCE instance, LPCSTR name, UINT type, int width, int height,
                                  UINT flags);
EXTERN_C HANDLE WINAPI LoadImageW(HINSTANCE instance, LPCWSTR name, UINT type, int width,
                                  int height, UINT flags);
///@}

// The desktop has every window; the foreground is no window of this program.
inline HWND GetDesktopWindow() {
  return (HWND)(LONG_PTR)1;
}
inline HWND GetForegroundWindow() {
  return NULL;
}
inline BOOL IsChild(HWND, HWND) {
  return FALSE;
}
inline HWND GetParent(HWND) {
  return NULL;
}
inline BOOL IsWindowUnicode(HWND) {
  return TRUE;
}
inline HWND SetFocus(HWND) {
  return NULL;
}
inline HWND GetFocus() {
  return NULL;
}
inline BOOL SetForegroundWindow(HWND) {
  return TRUE;
}
inline BOOL BringWindowToTop(HWND) {
  return TRUE;
}
inline BOOL FlashWindow(HWND, BOOL) {
  return FALSE;
}
inline BOOL SetProcessDPIAware() {
  return TRUE;
}
inline UINT GetDpiForWindow(HWND) {
  return 96;
}

// Nothing is drawn with GDI.
typedef DWORD COLORREF;
#define RGB(r, g, b) ((COLORREF)((r) | ((g) << 8) | ((b) << 16)))
#define WHITE_BRUSH 0
#define BLACK_BRUSH 4
#define NULL_BRUSH 5
#define HOLLOW_BRUSH NULL_BRUSH
inline HGDIOBJ GetStockObject(int index) {
  return (HGDIOBJ)(LONG_PTR)(index + 1);
}
inline BOOL DeleteObject(HGDIOBJ) {
  return TRUE;
}
inline HRGN CreateRectRgn(int, int, int, int) {
  return (HRGN)(LONG_PTR)1;
}
inline HBRUSH CreateSolidBrush(COLORREF) {
  return (HBRUSH)(LONG_PTR)1;
}
/// The monitor has 96 dots an inch.
inline int GetDeviceCaps(HDC, int index) {
  switch (index) {
    case LOGPIXELSX:
    case LOGPIXELSY:
      return 96;
    case HORZRES:
      return 1920;
    case VERTRES:
      return 1080;
    case BITSPIXEL:
      return 32;
    case VREFRESH:
      return 60;
    default:
      return 0;
  }
}
inline HDC GetDC(HWND) {
  return (HDC)(LONG_PTR)1;
}
inline int ReleaseDC(HWND, HDC) {
  return 1;
}

KAAMOS_TEXT_CALL(RegisterClass);
KAAMOS_TEXT_CALL(RegisterClassEx);
KAAMOS_TEXT_CALL(UnregisterClass);
KAAMOS_TEXT_CALL(CreateWindowEx);
KAAMOS_TEXT_CALL(SetWindowLongPtr);
KAAMOS_TEXT_CALL(GetWindowLongPtr);
KAAMOS_TEXT_CALL(SetWindowLong);
KAAMOS_TEXT_CALL(GetWindowLong);
KAAMOS_TEXT_CALL(EnumDisplaySettings);
KAAMOS_TEXT_CALL(SetWindowText);
KAAMOS_TEXT_CALL(GetWindowText);
KAAMOS_TEXT_CALL(PeekMessage);
KAAMOS_TEXT_CALL(GetMessage);
KAAMOS_TEXT_CALL(DispatchMessage);
KAAMOS_TEXT_CALL(SendMessage);
KAAMOS_TEXT_CALL(PostMessage);
KAAMOS_TEXT_CALL(DefWindowProc);
KAAMOS_TEXT_CALL(MessageBox);
KAAMOS_TEXT_CALL(GetMonitorInfo);
KAAMOS_TEXT_CALL(LoadCursor);
KAAMOS_TEXT_CALL(LoadIcon);
KAAMOS_TEXT_CALL(LoadImage);
inline HWND CreateWindowA(LPCSTR class_name, LPCSTR title, DWORD style, int x, int y, int width,
                          int height, HWND parent, HMENU menu, HINSTANCE instance,
                          LPVOID parameter) {
  return CreateWindowExA(0, class_name, title, style, x, y, width, height, parent, menu, instance,
                         parameter);
}
inline HWND CreateWindowW(LPCWSTR class_name, LPCWSTR title, DWORD style, int x, int y, int width,
                          int height, HWND parent, HMENU menu, HINSTANCE instance,
                          LPVOID parameter) {
  return CreateWindowExW(0, class_name, title, style, x, y, width, height, parent, menu, instance,
                         parameter);
}
inline HWND CreateWindow(LPCSTR class_name, LPCSTR title, DWORD style, int x, int y, int width,
                         int height, HWND parent, HMENU menu, HINSTANCE instance,
                         LPVOID parameter) {
  return CreateWindowA(class_name, title, style, x, y, width, height, parent, menu, instance,
                       parameter);
}
inline HWND CreateWindow(LPCWSTR class_name, LPCWSTR title, DWORD style, int x, int y, int width,
                         int height, HWND parent, HMENU menu, HINSTANCE instance,
                         LPVOID parameter) {
  return CreateWindowW(class_name, title, style, x, y, width, height, parent, menu, instance,
                       parameter);
}

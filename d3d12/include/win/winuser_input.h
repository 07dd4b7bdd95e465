// SPDX-License-Identifier: MIT
// Keyboard, mouse and raw input, of which there is none: no key is down and nothing moves.
// [Win32: winuser.h]
#pragma once

#include <kaamos_text.h>
#include <windef.h>
#include <winuser_constants.h>

inline HCURSOR SetCursor(HCURSOR) {
  return NULL;
}
inline int ShowCursor(BOOL show) {
  return show ? 0 : -1;
}
inline SHORT GetAsyncKeyState(int) {
  return 0;
}
inline SHORT GetKeyState(int) {
  return 0;
}
inline BOOL GetCursorPos(LPPOINT point) {
  return point->x = point->y = 0, TRUE;
}
inline BOOL SetCursorPos(int, int) {
  return TRUE;
}
inline BOOL ScreenToClient(HWND, LPPOINT) {
  return TRUE;
}
inline BOOL ClientToScreen(HWND, LPPOINT) {
  return TRUE;
}
inline HWND SetCapture(HWND) {
  return NULL;
}
inline BOOL ReleaseCapture() {
  return TRUE;
}
inline HWND GetCapture() {
  return NULL;
}
/// Points of windows and of the screen are the same.
inline int MapWindowPoints(HWND, HWND, LPPOINT, UINT) {
  return 0;
}
inline BOOL ClipCursor(const RECT*) {
  return TRUE;
}
typedef struct tagCURSORINFO {
  DWORD cbSize;
  DWORD flags;
  HCURSOR hCursor;
  POINT ptScreenPos;
} CURSORINFO, *PCURSORINFO, *LPCURSORINFO;
/// The cursor is hidden.
inline BOOL GetCursorInfo(PCURSORINFO info) {
  info->flags = 0;
  info->hCursor = NULL;
  info->ptScreenPos.x = info->ptScreenPos.y = 0;
  return TRUE;
}

inline BOOL GetKeyboardState(BYTE* keys) {
  for (int i = 0; i < 256; ++i) keys[i] = 0;
  return TRUE;
}
/// No key has a code.
///@{
inline UINT MapVirtualKeyA(UINT, UINT) {
  return 0;
}
inline UINT MapVirtualKeyW(UINT, UINT) {
  return 0;
}
///@}
KAAMOS_TEXT_CALL(MapVirtualKey);
inline HKL GetKeyboardLayout(DWORD) {
  return (HKL)(LONG_PTR)0x04090409;
}
inline LPARAM GetMessageExtraInfo() {
  return 0;
}

typedef struct tagTRACKMOUSEEVENT {
  DWORD cbSize;
  DWORD dwFlags;
  HWND hwndTrack;
  DWORD dwHoverTime;
} TRACKMOUSEEVENT, *LPTRACKMOUSEEVENT;
/// The mouse neither hovers nor leaves.
inline BOOL TrackMouseEvent(LPTRACKMOUSEEVENT) {
  return TRUE;
}

DECLARE_HANDLE(HRAWINPUT);
typedef struct tagRAWINPUTDEVICE {
  USHORT usUsagePage;
  USHORT usUsage;
  DWORD dwFlags;
  HWND hwndTarget;
} RAWINPUTDEVICE, *PRAWINPUTDEVICE, *LPRAWINPUTDEVICE;
typedef const RAWINPUTDEVICE* PCRAWINPUTDEVICE;
typedef struct tagRAWINPUTHEADER {
  DWORD dwType;
  DWORD dwSize;
  HANDLE hDevice;
  WPARAM wParam;
} RAWINPUTHEADER, *PRAWINPUTHEADER;
typedef struct tagRAWMOUSE {
  USHORT usFlags;
  union {
    ULONG ulButtons;
    struct {
      USHORT usButtonFlags;
      USHORT usButtonData;
    };
  };
  ULONG ulRawButtons;
  LONG lLastX;
  LONG lLastY;
  ULONG ulExtraInformation;
} RAWMOUSE, *PRAWMOUSE;
typedef struct tagRAWKEYBOARD {
  USHORT MakeCode;
  USHORT Flags;
  USHORT Reserved;
  USHORT VKey;
  UINT Message;
  ULONG ExtraInformation;
} RAWKEYBOARD, *PRAWKEYBOARD;
typedef struct tagRAWHID {
  DWORD dwSizeHid;
  DWORD dwCount;
  BYTE bRawData[1];
} RAWHID, *PRAWHID;
typedef struct tagRAWINPUT {
  RAWINPUTHEADER header;
  union {
    RAWMOUSE mouse;
    RAWKEYBOARD keyboard;
    RAWHID hid;
  } data;
} RAWINPUT, *PRAWINPUT, *LPRAWINPUT;
/// Devices are taken and never report.
inline BOOL RegisterRawInputDevices(PCRAWINPUTDEVICE, UINT, UINT) {
  return TRUE;
}
/// There is no input to get: (UINT)-1.
inline UINT GetRawInputData(HRAWINPUT, UINT, LPVOID, UINT*, UINT) {
  return (UINT)-1;
}

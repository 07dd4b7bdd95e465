// SPDX-License-Identifier: MIT
// The desktop's composition: there is none. [Win32: dwmapi.h]
#pragma once

#include <windef.h>
#include <winerror.h>

#define DWM_BB_ENABLE 0x1
#define DWM_BB_BLURREGION 0x2
#define DWM_BB_TRANSITIONONMAXIMIZED 0x4

typedef struct _DWM_BLURBEHIND {
  DWORD dwFlags;
  BOOL fEnable;
  HRGN hRgnBlur;
  BOOL fTransitionOnMaximized;
} DWM_BLURBEHIND, *PDWM_BLURBEHIND;

/// E_INVALIDARG for a null pointer, S_OK and FALSE otherwise.
inline HRESULT DwmIsCompositionEnabled(BOOL* enabled) {
  return enabled == NULL ? E_INVALIDARG : (*enabled = FALSE, S_OK);
}
/// What a desktop without composition answers.
///@{
inline HRESULT DwmGetColorizationColor(DWORD*, BOOL*) {
  return DWM_E_COMPOSITIONDISABLED;
}
inline HRESULT DwmEnableBlurBehindWindow(HWND, const DWM_BLURBEHIND*) {
  return DWM_E_COMPOSITIONDISABLED;
}
///@}
inline HRESULT DwmFlush() {
  return DWM_E_COMPOSITIONDISABLED;
}
/// Attributes are taken and change nothing.
inline HRESULT DwmSetWindowAttribute(HWND, DWORD, LPCVOID, DWORD) {
  return S_OK;
}

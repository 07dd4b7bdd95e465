// SPDX-License-Identifier: MIT
// Messages: each thread has a queue. WM_PAINT comes while a window has to be painted and nothing
// else waits; a thread that waits for messages has its windows painted again, as nothing else would
// ever come.
#include <windows.h>

#include <chrono>

#include "d3d12/win32/handles.h"
#include "d3d12/win32/window_state.h"

namespace kaamos::d3d12 {

namespace {

constexpr std::chrono::milliseconds kRefresh(16);

bool passes(const MSG& message, HWND window, UINT first, UINT last) {
  if (window != nullptr && message.hwnd != window) return false;
  return (first == 0 && last == 0) || (message.message >= first && message.message <= last);
}

// Posted messages come first, then WM_QUIT, then WM_PAINT. [Win32: GetMessage]
bool take(MessageQueue& queue, std::unique_lock<std::mutex>& lock, LPMSG message, HWND window,
          UINT first, UINT last, bool remove) {
  for (auto at = queue.posted.begin(); at != queue.posted.end(); ++at) {
    if (!passes(*at, window, first, last)) continue;
    *message = *at;
    if (remove) queue.posted.erase(at);
    return true;
  }
  if (queue.quit) {
    *message = {nullptr, WM_QUIT, static_cast<WPARAM>(*queue.quit), 0, 0, {}};
    if (remove) queue.quit.reset();
    return true;
  }
  const HWND paint = Windows::instance().find_to_paint(queue, lock);
  const MSG painted = {paint, WM_PAINT, 0, 0, 0, {}};
  if (paint == nullptr || !passes(painted, window, first, last)) return false;
  *message = painted;
  return true;
}

BOOL peek(LPMSG message, HWND window, UINT first, UINT last, UINT remove) {
  const auto queue = current_queue();
  std::unique_lock lock(Windows::instance().mutex);
  const bool found = take(*queue, lock, message, window, first, last, (remove & PM_REMOVE) != 0);
  if (found) message->time = GetTickCount();
  return found;
}

BOOL get(LPMSG message, HWND window, UINT first, UINT last) {
  const auto queue = current_queue();
  std::unique_lock lock(Windows::instance().mutex);
  while (!take(*queue, lock, message, window, first, last, true)) {
    if (queue->changed.wait_for(lock, kRefresh) == std::cv_status::timeout) {
      Windows::instance().paint_all(*queue, lock);
    }
  }
  message->time = GetTickCount();
  return message->message != WM_QUIT;
}

BOOL set_needs_paint(HWND handle, bool needs, const char* call) {
  const auto window = Windows::instance().find(handle);
  if (window == nullptr) {
    return succeed(false, ERROR_INVALID_WINDOW_HANDLE, call, "hWnd names no window that lives.");
  }
  std::lock_guard lock(Windows::instance().mutex);
  window->needs_paint = needs;
  if (needs) window->thread->changed.notify_all();
  return TRUE;
}

LRESULT default_procedure(HWND handle, UINT message) {
  switch (message) {
    case WM_NCCREATE:
      return TRUE;
    case WM_CLOSE:
      DestroyWindow(handle);
      return 0;
    case WM_PAINT:
      set_needs_paint(handle, false, "DefWindowProc");
      return 0;
    case WM_ERASEBKGND:
      return TRUE;
    case WM_NCHITTEST:
      return HTCLIENT;
    default:
      return 0;
  }
}

}  // namespace

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the functions below are global

extern "C" {

BOOL WINAPI PeekMessageA(LPMSG message, HWND window, UINT first, UINT last, UINT remove) {
  return peek(message, window, first, last, remove);
}
BOOL WINAPI PeekMessageW(LPMSG message, HWND window, UINT first, UINT last, UINT remove) {
  return peek(message, window, first, last, remove);
}
BOOL WINAPI GetMessageA(LPMSG message, HWND window, UINT first, UINT last) {
  return get(message, window, first, last);
}
BOOL WINAPI GetMessageW(LPMSG message, HWND window, UINT first, UINT last) {
  return get(message, window, first, last);
}

LRESULT WINAPI DispatchMessageW(const MSG* message) {
  return message->hwnd != nullptr
             ? SendMessageW(message->hwnd, message->message, message->wParam, message->lParam)
             : 0;
}
LRESULT WINAPI DispatchMessageA(const MSG* message) {
  return DispatchMessageW(message);
}

// Calls the procedure on the thread that sends, whichever the window's.
LRESULT WINAPI SendMessageW(HWND handle, UINT message, WPARAM wparam, LPARAM lparam) {
  const auto window = Windows::instance().find(handle);
  if (window == nullptr) {
    return succeed(false, ERROR_INVALID_WINDOW_HANDLE, "SendMessage",
                   "hWnd names no window that lives.");
  }
  WNDPROC procedure = nullptr;
  {
    std::lock_guard lock(Windows::instance().mutex);
    procedure = window->procedure;
  }
  return procedure(handle, message, wparam, lparam);
}
LRESULT WINAPI SendMessageA(HWND handle, UINT message, WPARAM wparam, LPARAM lparam) {
  return SendMessageW(handle, message, wparam, lparam);
}

BOOL WINAPI PostMessageW(HWND handle, UINT message, WPARAM wparam, LPARAM lparam) {
  auto queue = current_queue();
  if (handle != nullptr) {
    const auto window = Windows::instance().find(handle);
    if (window == nullptr) {
      return succeed(false, ERROR_INVALID_WINDOW_HANDLE, "PostMessage",
                     "hWnd names no window that lives.");
    }
    queue = window->thread;
  }
  std::lock_guard lock(Windows::instance().mutex);
  queue->posted.push_back({handle, message, wparam, lparam, 0, {}});
  queue->changed.notify_all();
  return TRUE;
}
BOOL WINAPI PostMessageA(HWND handle, UINT message, WPARAM wparam, LPARAM lparam) {
  return PostMessageW(handle, message, wparam, lparam);
}

void WINAPI PostQuitMessage(int code) {
  const auto queue = current_queue();
  std::lock_guard lock(Windows::instance().mutex);
  queue->quit = code;
  queue->changed.notify_all();
}

LRESULT WINAPI DefWindowProcW(HWND handle, UINT message, WPARAM, LPARAM) {
  return default_procedure(handle, message);
}
LRESULT WINAPI DefWindowProcA(HWND handle, UINT message, WPARAM, LPARAM) {
  return default_procedure(handle, message);
}

HDC WINAPI BeginPaint(HWND handle, LPPAINTSTRUCT paint) {
  *paint = {};
  if (!set_needs_paint(handle, false, "BeginPaint")) return nullptr;
  paint->hdc = GetDC(handle);
  GetClientRect(handle, &paint->rcPaint);
  return paint->hdc;
}
BOOL WINAPI EndPaint(HWND, const PAINTSTRUCT*) {
  return TRUE;
}
BOOL WINAPI ValidateRect(HWND handle, const RECT*) {
  return set_needs_paint(handle, false, "ValidateRect");
}
BOOL WINAPI InvalidateRect(HWND handle, const RECT*, BOOL) {
  return set_needs_paint(handle, true, "InvalidateRect");
}

}  // extern "C"

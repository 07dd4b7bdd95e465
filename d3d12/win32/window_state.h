// SPDX-License-Identifier: MIT
// The state of a window, the queue of messages of each thread, and the list of both.
#pragma once

#include <windows.h>

#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace kaamos::d3d12 {

/// The messages of one thread. Guarded by Windows::mutex.
struct MessageQueue {
  std::deque<MSG> posted;
  std::optional<int> quit;  // PostQuitMessage's code
  std::condition_variable changed;
};

/// This thread's.
std::shared_ptr<MessageQueue> current_queue();

struct WindowClass {
  WNDPROC procedure = nullptr;
  bool wide = false;
};

/// Guarded by Windows::mutex.
struct Window {
  WNDPROC procedure = nullptr;
  bool wide = false;  // its text is of wchar_t
  std::shared_ptr<MessageQueue> thread;
  std::wstring title;
  RECT place = {};  // in pixels of the screen
  std::map<int, LONG_PTR> values;
  bool visible = false;
  bool needs_paint = false;
  bool destroying = false;
  int frames = 0;
};

/// Every window and class of the process. Its functions lock; a window's members need the lock.
class Windows {
 public:
  static Windows& instance();

  /// 0 if there is such a class.
  ATOM add_class(const std::wstring& name, WindowClass added);
  bool remove_class(const std::wstring& name);
  /// `name` may be "#" and a number.
  std::optional<WindowClass> find_class(const std::wstring& name);

  HWND add(std::shared_ptr<Window> window);
  void remove(HWND handle);
  std::shared_ptr<Window> find(HWND handle);
  /// A visible window of this queue that has to be painted; null if there is none.
  HWND find_to_paint(const MessageQueue& queue, std::unique_lock<std::mutex>& lock);
  /// Has every visible window of this queue painted, as if it had been covered.
  void paint_all(const MessageQueue& queue, std::unique_lock<std::mutex>& lock);

  std::mutex mutex;

 private:
  std::map<std::wstring, std::pair<ATOM, WindowClass>> classes_;
  std::map<HWND, std::shared_ptr<Window>> windows_;
  ATOM next_class_ = 0xC000;
  uintptr_t next_window_ = 0x10000;
};

}  // namespace kaamos::d3d12

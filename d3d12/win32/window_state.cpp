// SPDX-License-Identifier: MIT
#include "d3d12/win32/window_state.h"

#include <algorithm>

namespace kaamos::d3d12 {

std::shared_ptr<MessageQueue> current_queue() {
  thread_local const auto queue = std::make_shared<MessageQueue>();
  return queue;
}

Windows& Windows::instance() {
  static Windows* windows = new Windows;  // lives on: threads may present when the program ends
  return *windows;
}

ATOM Windows::add_class(const std::wstring& name, WindowClass added) {
  std::lock_guard lock(mutex);
  const auto [at, is_new] = classes_.try_emplace(name, next_class_, added);
  return is_new ? next_class_++ : ATOM{0};
}

bool Windows::remove_class(const std::wstring& name) {
  std::lock_guard lock(mutex);
  return classes_.erase(name) != 0;
}

std::optional<WindowClass> Windows::find_class(const std::wstring& name) {
  std::lock_guard lock(mutex);
  const auto found = std::find_if(classes_.begin(), classes_.end(), [&](const auto& entry) {
    return entry.first == name || L"#" + std::to_wstring(entry.second.first) == name;
  });
  if (found == classes_.end()) return std::nullopt;
  return found->second.second;
}

HWND Windows::add(std::shared_ptr<Window> window) {
  std::lock_guard lock(mutex);
  next_window_ += 2;
  const auto handle = reinterpret_cast<HWND>(next_window_);  // NOLINT: a handle is a number
  windows_.emplace(handle, std::move(window));
  return handle;
}

void Windows::remove(HWND handle) {
  std::lock_guard lock(mutex);
  const auto found = windows_.find(handle);
  if (found == windows_.end()) return;
  std::erase_if(found->second->thread->posted, [&](const MSG& m) { return m.hwnd == handle; });
  windows_.erase(found);
}

std::shared_ptr<Window> Windows::find(HWND handle) {
  std::lock_guard lock(mutex);
  const auto found = windows_.find(handle);
  return found != windows_.end() ? found->second : nullptr;
}

HWND Windows::find_to_paint(const MessageQueue& queue, std::unique_lock<std::mutex>&) {
  for (const auto& [handle, window] : windows_) {
    if (window->thread.get() == &queue && window->visible && window->needs_paint) return handle;
  }
  return nullptr;
}

void Windows::paint_all(const MessageQueue& queue, std::unique_lock<std::mutex>&) {
  for (const auto& [handle, window] : windows_) {
    if (window->thread.get() == &queue && window->visible) window->needs_paint = true;
  }
}

}  // namespace kaamos::d3d12

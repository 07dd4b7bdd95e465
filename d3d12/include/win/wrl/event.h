// SPDX-License-Identifier: MIT
// Microsoft::WRL::Wrappers::Event: a handle that closes itself.
#pragma once

#include <synchapi.h>

namespace Microsoft::WRL::Wrappers {

class Event {
 public:
  Event() = default;
  explicit Event(HANDLE handle) : handle_(handle) {}
  Event(Event&& other) noexcept : handle_(other.Detach()) {}
  Event& operator=(Event&& other) noexcept {
    if (this != &other) Attach(other.Detach());
    return *this;
  }
  ~Event() { Close(); }

  bool IsValid() const { return handle_ != nullptr; }
  HANDLE Get() const { return handle_; }
  HANDLE* GetAddressOf() { return &handle_; }
  HANDLE* ReleaseAndGetAddressOf() {
    Close();
    return &handle_;
  }
  void Attach(HANDLE handle) {
    Close();
    handle_ = handle;
  }
  HANDLE Detach() {
    const HANDLE out = handle_;
    handle_ = nullptr;
    return out;
  }
  void Close() {
    if (handle_ != nullptr) CloseHandle(handle_);
    handle_ = nullptr;
  }

 private:
  HANDLE handle_ = nullptr;
};

}  // namespace Microsoft::WRL::Wrappers

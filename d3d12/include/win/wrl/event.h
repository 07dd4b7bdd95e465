// SPDX-License-Identifier: MIT
// Microsoft::WRL::Wrappers::Event and FileHandle: handles that close themselves.
#pragma once

#include <handleapi.h>
#include <synchapi.h>

namespace Microsoft::WRL::Wrappers {

/// `Traits::invalid()`: what a handle without an object is.
template <class Traits>
class HandleT {
 public:
  HandleT() = default;
  explicit HandleT(HANDLE handle) : handle_(handle) {}
  HandleT(HandleT&& other) noexcept : handle_(other.Detach()) {}
  HandleT& operator=(HandleT&& other) noexcept {
    if (this != &other) Attach(other.Detach());
    return *this;
  }
  ~HandleT() { Close(); }

  bool IsValid() const { return handle_ != Traits::invalid(); }
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
    handle_ = Traits::invalid();
    return out;
  }
  void Close() {
    if (IsValid()) CloseHandle(handle_);
    handle_ = Traits::invalid();
  }

 private:
  HANDLE handle_ = Traits::invalid();
};

namespace HandleTraits {
struct EventTraits {
  static HANDLE invalid() { return nullptr; }
};
struct FileHandleTraits {
  static HANDLE invalid() { return INVALID_HANDLE_VALUE; }
};
}  // namespace HandleTraits

using Event = HandleT<HandleTraits::EventTraits>;
using FileHandle = HandleT<HandleTraits::FileHandleTraits>;

}  // namespace Microsoft::WRL::Wrappers

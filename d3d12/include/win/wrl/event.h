// SPDX-License-Identifier: MIT
// Microsoft::WRL::Wrappers::Event, Mutex and FileHandle: handles that close themselves.
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

/// Has a mutex as long as it lives.
template <class Traits>
class HandleLock {
 public:
  explicit HandleLock(HANDLE handle) : handle_(handle) {}
  HandleLock(HandleLock&& other) noexcept : handle_(other.handle_) { other.handle_ = nullptr; }
  HandleLock& operator=(HandleLock&&) = delete;
  ~HandleLock() { Unlock(); }
  bool IsLocked() const { return handle_ != nullptr; }
  void Unlock() {
    if (IsLocked()) ReleaseMutex(handle_);
    handle_ = nullptr;
  }

 private:
  HANDLE handle_;
};

namespace HandleTraits {
struct MutexTraits {
  static HANDLE invalid() { return nullptr; }
};
struct EventTraits {
  static HANDLE invalid() { return nullptr; }
};
struct FileHandleTraits {
  static HANDLE invalid() { return INVALID_HANDLE_VALUE; }
};
}  // namespace HandleTraits

using Event = HandleT<HandleTraits::EventTraits>;
class Mutex : public HandleT<HandleTraits::MutexTraits> {
 public:
  typedef HandleLock<HandleTraits::MutexTraits> SyncLock;
  explicit Mutex(HANDLE handle) : HandleT(handle) {}
  /// Waits for the mutex; what it returns has none after a timeout.
  ///@{
  SyncLock Lock(DWORD milliseconds = INFINITE) { return Lock(Get(), milliseconds); }
  static SyncLock Lock(HANDLE handle, DWORD milliseconds = INFINITE) {
    return SyncLock(WaitForSingleObjectEx(handle, milliseconds, FALSE) == WAIT_OBJECT_0 ? handle
                                                                                        : nullptr);
  }
  ///@}
};
using FileHandle = HandleT<HandleTraits::FileHandleTraits>;

}  // namespace Microsoft::WRL::Wrappers

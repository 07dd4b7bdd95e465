// SPDX-License-Identifier: MIT
// Every handle of the process, and the objects that handles name.
#pragma once

#include <windows.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace kaamos::d3d12 {

/// The object that a handle names: an event or a file.
class HandleObject {
 public:
  HandleObject() = default;
  HandleObject(const HandleObject&) = delete;
  HandleObject& operator=(const HandleObject&) = delete;
  virtual ~HandleObject() = default;
};

/// Thread-safe. Numbers are not used again, so that a closed handle stays invalid.
class Handles {
 public:
  static Handles& instance();

  HANDLE add(std::shared_ptr<HandleObject> object);
  /// False if no object has this handle.
  bool close(HANDLE handle);
  /// The object, or null if there is none of this type.
  template <class Object>
  std::shared_ptr<Object> find(HANDLE handle) {
    return std::dynamic_pointer_cast<Object>(find_any(handle));
  }
  std::shared_ptr<HandleObject> find_any(HANDLE handle);

 private:
  std::mutex mutex_;
  std::map<HANDLE, std::shared_ptr<HandleObject>> objects_;
  uintptr_t next_ = 0x100;
};

/// TRUE if `done`, else FALSE with GetLastError() `error`, and KA4042: "call: text".
BOOL succeed(bool done, DWORD error, const std::string& call, const std::string& text);

}  // namespace kaamos::d3d12

// SPDX-License-Identifier: MIT
#include "d3d12/win32/handles.h"

#include "d3d12/com/report.h"

namespace kaamos::d3d12 {

namespace {

thread_local DWORD last_error = ERROR_SUCCESS;

}  // namespace

Handles& Handles::instance() {
  static Handles* handles = new Handles;  // lives on: threads may wait when the program ends
  return *handles;
}

HANDLE Handles::add(std::shared_ptr<HandleObject> object) {
  std::lock_guard lock(mutex_);
  next_ += 4;                                           // as Windows numbers them
  const auto handle = reinterpret_cast<HANDLE>(next_);  // NOLINT: a handle is a number
  objects_.emplace(handle, std::move(object));
  return handle;
}

bool Handles::close(HANDLE handle) {
  std::shared_ptr<HandleObject> object;  // freed outside of the lock
  std::lock_guard lock(mutex_);
  const auto found = objects_.find(handle);
  if (found == objects_.end()) return false;
  object = std::move(found->second);
  objects_.erase(found);
  return true;
}

std::shared_ptr<HandleObject> Handles::find_any(HANDLE handle) {
  std::lock_guard lock(mutex_);
  const auto found = objects_.find(handle);
  return found != objects_.end() ? found->second : nullptr;
}

BOOL succeed(bool done, DWORD error, const std::string& call, const std::string& text) {
  if (done) return TRUE;
  last_error = error;
  process_reporter().fail(ErrorId::kWin32, call + ": " + text);
  return FALSE;
}

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the functions below are global

extern "C" {

BOOL WINAPI CloseHandle(HANDLE object) {
  return succeed(Handles::instance().close(object), ERROR_INVALID_HANDLE, "CloseHandle",
                 "the handle names no object that lives.");
}

BOOL WINAPI DuplicateHandle(HANDLE, HANDLE source, HANDLE, HANDLE* dest, DWORD, BOOL,
                            DWORD options) {
  auto object = Handles::instance().find_any(source);
  if (dest == nullptr || object == nullptr) {
    return succeed(false, ERROR_INVALID_HANDLE, "DuplicateHandle",
                   "the handle names no object that lives.");
  }
  *dest = Handles::instance().add(std::move(object));
  if ((options & DUPLICATE_CLOSE_SOURCE) != 0) Handles::instance().close(source);
  return TRUE;
}

DWORD WINAPI GetLastError() {
  return last_error;
}
void WINAPI SetLastError(DWORD error) {
  last_error = error;
}

}  // extern "C"

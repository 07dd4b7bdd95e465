// SPDX-License-Identifier: MIT
// Events and waits.
#include "d3d12/win32/event.h"

#include <chrono>
#include <condition_variable>
#include <list>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <vector>

namespace kaamos::d3d12 {

namespace {

// A thread that waits. Whoever sets an event lets waits go, as Windows does: a wait that was let go
// stays so, whatever happens to the event before its thread runs.
struct Waiter {
  std::span<const std::shared_ptr<Event>> events;
  bool all;
  std::thread::id thread;
  std::optional<DWORD> found;  // the index of the first that is set, or 0 once all are
  std::condition_variable changed;
};

// One lock serves for all events: programs wait once a frame.
struct Waits {
  std::mutex mutex;
  std::list<Waiter*> waiters;  // the longest wait first
};
Waits& waits() {
  static Waits* all = new Waits;  // lives on: threads may wait when the program ends
  return *all;
}

bool is_free(const Event& event, std::thread::id thread) {
  const auto* mutex = dynamic_cast<const Mutex*>(&event);
  return event.set || (mutex != nullptr && mutex->count != 0 && mutex->owner == thread);
}

void take(Event& event, std::thread::id thread) {
  if (!event.manual_reset) event.set = false;
  if (auto* mutex = dynamic_cast<Mutex*>(&event)) {
    mutex->owner = thread;
    ++mutex->count;
  }
}

// Lets a wait go if its events are set, and resets those that reset themselves.
void try_let_go(Waiter& waiter) {
  size_t count = 0;
  for (DWORD i = 0; i < waiter.events.size(); ++i) {
    if (!is_free(*waiter.events[i], waiter.thread)) continue;
    ++count;
    if (!waiter.all && !waiter.found) waiter.found = i;
  }
  if (waiter.all && count == waiter.events.size()) waiter.found = 0;
  if (!waiter.found) return;
  for (DWORD i = 0; i < waiter.events.size(); ++i) {
    if (waiter.all || i == *waiter.found) take(*waiter.events[i], waiter.thread);
  }
}

// None when the time is up.
std::optional<DWORD> wait(std::span<const std::shared_ptr<Event>> events, bool all,
                          DWORD milliseconds) {
  std::unique_lock lock(waits().mutex);
  Waiter waiter{events, all, std::this_thread::get_id(), {}, {}};
  try_let_go(waiter);
  if (waiter.found || milliseconds == 0) return waiter.found;
  const auto place = waits().waiters.insert(waits().waiters.end(), &waiter);
  const auto let_go = [&] { return waiter.found.has_value(); };
  if (milliseconds == INFINITE) {
    waiter.changed.wait(lock, let_go);
  } else {
    waiter.changed.wait_for(lock, std::chrono::milliseconds(milliseconds), let_go);
  }
  waits().waiters.erase(place);
  return waiter.found;
}

BOOL change(HANDLE handle, bool value, const char* call) {
  auto event = Handles::instance().find<Event>(handle);
  if (std::dynamic_pointer_cast<Mutex>(event) != nullptr) event = nullptr;
  if (event != nullptr) set_event(*event, value);
  return succeed(event != nullptr, ERROR_INVALID_HANDLE, call,
                 "the handle names no event that lives.");
}

}  // namespace

HANDLE make_event(bool manual_reset, bool set) {
  return Handles::instance().add(std::make_shared<Event>(manual_reset, set));
}

namespace {

void let_waits_go() {
  for (Waiter* waiter : waits().waiters) {
    if (waiter->found) continue;
    try_let_go(*waiter);
    if (waiter->found) waiter->changed.notify_one();
  }
}

HANDLE make_mutex(bool owned) {
  auto mutex = std::make_shared<Mutex>();
  if (owned) take(*mutex, std::this_thread::get_id());
  return Handles::instance().add(std::move(mutex));
}

}  // namespace

void set_event(Event& event, bool value) {
  std::lock_guard lock(waits().mutex);
  event.set = value;
  if (value) let_waits_go();
}

size_t waiting_threads() {
  std::lock_guard lock(waits().mutex);
  return waits().waiters.size();
}

}  // namespace kaamos::d3d12

using namespace kaamos::d3d12;  // NOLINT: the functions below are global

extern "C" {

HANDLE WINAPI CreateEventA(LPSECURITY_ATTRIBUTES, BOOL manual_reset, BOOL initial_state, LPCSTR) {
  return make_event(manual_reset != FALSE, initial_state != FALSE);
}

HANDLE WINAPI CreateEventW(LPSECURITY_ATTRIBUTES, BOOL manual_reset, BOOL initial_state, LPCWSTR) {
  return make_event(manual_reset != FALSE, initial_state != FALSE);
}

HANDLE WINAPI CreateEventExA(LPSECURITY_ATTRIBUTES, LPCSTR, DWORD flags, DWORD) {
  return make_event((flags & CREATE_EVENT_MANUAL_RESET) != 0,
                    (flags & CREATE_EVENT_INITIAL_SET) != 0);
}

HANDLE WINAPI CreateEventExW(LPSECURITY_ATTRIBUTES, LPCWSTR, DWORD flags, DWORD) {
  return make_event((flags & CREATE_EVENT_MANUAL_RESET) != 0,
                    (flags & CREATE_EVENT_INITIAL_SET) != 0);
}

BOOL WINAPI SetEvent(HANDLE event) {
  return change(event, true, "SetEvent");
}

BOOL WINAPI ResetEvent(HANDLE event) {
  return change(event, false, "ResetEvent");
}

HANDLE WINAPI CreateMutexA(LPSECURITY_ATTRIBUTES, BOOL owned, LPCSTR) {
  return make_mutex(owned != FALSE);
}

HANDLE WINAPI CreateMutexW(LPSECURITY_ATTRIBUTES, BOOL owned, LPCWSTR) {
  return make_mutex(owned != FALSE);
}

BOOL WINAPI ReleaseMutex(HANDLE handle) {
  const auto mutex = Handles::instance().find<Mutex>(handle);
  if (mutex == nullptr) {
    return succeed(false, ERROR_INVALID_HANDLE, "ReleaseMutex",
                   "the handle names no mutex that lives.");
  }
  std::lock_guard lock(waits().mutex);
  if (mutex->count == 0 || mutex->owner != std::this_thread::get_id()) {
    return succeed(false, ERROR_NOT_OWNER, "ReleaseMutex", "this thread does not have the mutex.");
  }
  if (--mutex->count == 0) {
    mutex->set = true;
    let_waits_go();
  }
  return TRUE;
}

DWORD WINAPI WaitForMultipleObjects(DWORD count, const HANDLE* objects, BOOL wait_all,
                                    DWORD milliseconds) {
  std::vector<std::shared_ptr<Event>> events;
  for (DWORD i = 0; i < count && objects != nullptr; ++i) {
    events.push_back(Handles::instance().find<Event>(objects[i]));
    if (events.back() == nullptr) {
      succeed(false, ERROR_INVALID_HANDLE, "WaitForMultipleObjects",
              "object " + std::to_string(i) + " is no event and no mutex that lives.");
      return WAIT_FAILED;
    }
  }
  if (events.empty() || count > MAXIMUM_WAIT_OBJECTS) {
    succeed(false, ERROR_INVALID_PARAMETER, "WaitForMultipleObjects",
            "nCount is " + std::to_string(count) + "; allowed are 1 to 64, and a list of them.");
    return WAIT_FAILED;
  }
  const auto found = wait(events, wait_all != FALSE, milliseconds);
  return found ? WAIT_OBJECT_0 + *found : WAIT_TIMEOUT;
}

DWORD WINAPI WaitForMultipleObjectsEx(DWORD count, const HANDLE* objects, BOOL wait_all,
                                      DWORD milliseconds, BOOL) {
  return WaitForMultipleObjects(count, objects, wait_all, milliseconds);
}

DWORD WINAPI WaitForSingleObject(HANDLE object, DWORD milliseconds) {
  return WaitForMultipleObjects(1, &object, FALSE, milliseconds);
}

DWORD WINAPI WaitForSingleObjectEx(HANDLE object, DWORD milliseconds, BOOL) {
  return WaitForSingleObject(object, milliseconds);
}

void WINAPI Sleep(DWORD milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

}  // extern "C"

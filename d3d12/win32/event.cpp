// SPDX-License-Identifier: MIT
// Events and waits.
#include "d3d12/win32/event.h"

#include <chrono>
#include <condition_variable>
#include <optional>
#include <thread>
#include <vector>

namespace kaamos::d3d12 {

namespace {

// One lock and condition serve for all events: programs wait once a frame.
struct Waits {
  std::mutex mutex;
  std::condition_variable changed;
};
Waits& waits() {
  static Waits* all = new Waits;  // lives on: threads may wait when the program ends
  return *all;
}

// The index of the first that is set, or 0 once all are; none when the time is up. Events that
// reset themselves do so in the thread that they let go.
std::optional<DWORD> wait(const std::vector<std::shared_ptr<Event>>& events, bool all,
                          DWORD milliseconds) {
  std::unique_lock lock(waits().mutex);
  std::optional<DWORD> found;
  const auto ready = [&] {
    size_t count = 0;
    for (DWORD i = 0; i < events.size(); ++i) {
      if (!events[i]->set) continue;
      ++count;
      if (!all && !found) found = i;
    }
    if (all && count == events.size()) found = 0;
    return found.has_value();
  };
  if (milliseconds == INFINITE) {
    waits().changed.wait(lock, ready);
  } else {
    waits().changed.wait_for(lock, std::chrono::milliseconds(milliseconds), ready);
  }
  if (!found) return std::nullopt;
  for (DWORD i = 0; i < events.size(); ++i) {
    if ((all || i == *found) && !events[i]->manual_reset) events[i]->set = false;
  }
  return found;
}

BOOL change(HANDLE handle, bool value, const char* call) {
  const auto event = Handles::instance().find<Event>(handle);
  if (event != nullptr) set_event(*event, value);
  return succeed(event != nullptr, ERROR_INVALID_HANDLE, call,
                 "the handle names no event that lives.");
}

}  // namespace

HANDLE make_event(bool manual_reset, bool set) {
  return Handles::instance().add(std::make_shared<Event>(manual_reset, set));
}

void set_event(Event& event, bool value) {
  std::lock_guard lock(waits().mutex);
  event.set = value;
  if (value) waits().changed.notify_all();
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

DWORD WINAPI WaitForMultipleObjects(DWORD count, const HANDLE* objects, BOOL wait_all,
                                    DWORD milliseconds) {
  std::vector<std::shared_ptr<Event>> events;
  for (DWORD i = 0; i < count && objects != nullptr; ++i) {
    events.push_back(Handles::instance().find<Event>(objects[i]));
    if (events.back() == nullptr) {
      succeed(false, ERROR_INVALID_HANDLE, "WaitForMultipleObjects",
              "object " + std::to_string(i) + " is no event that lives.");
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

// SPDX-License-Identifier: MIT
// Events and mutexes, which programs wait for by a handle.
#pragma once

#include <cstddef>
#include <thread>

#include "d3d12/win32/handles.h"

namespace kaamos::d3d12 {

class Event : public HandleObject {
 public:
  Event(bool resets_by_hand, bool initially_set)
      : manual_reset(resets_by_hand), set(initially_set) {}
  const bool manual_reset;
  bool set;  // guarded by the lock of all waits
};

/// A mutex: an event that resets itself and that one thread at a time may wait for again. `set`
/// says that no thread has it.
class Mutex final : public Event {
 public:
  Mutex() : Event(false, true) {}
  std::thread::id owner;  // guarded by the lock of all waits, as is the next
  size_t count = 0;       // how often the owner has waited
};

HANDLE make_event(bool manual_reset, bool set);
/// Sets or resets it, and lets waits go.
void set_event(Event& event, bool value);
/// Returns how many threads wait at this moment.
size_t waiting_threads();

}  // namespace kaamos::d3d12

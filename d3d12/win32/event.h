// SPDX-License-Identifier: MIT
// Events, which programs wait for by a handle.
#pragma once

#include <cstddef>

#include "d3d12/win32/handles.h"

namespace kaamos::d3d12 {

class Event : public HandleObject {
 public:
  Event(bool resets_by_hand, bool initially_set)
      : manual_reset(resets_by_hand), set(initially_set) {}
  const bool manual_reset;
  bool set;  // guarded by the lock of all waits
};

HANDLE make_event(bool manual_reset, bool set);
/// Sets or resets it, and lets waits go.
void set_event(Event& event, bool value);
/// Returns how many threads wait at this moment.
size_t waiting_threads();

}  // namespace kaamos::d3d12

// SPDX-License-Identifier: MIT
//
// The backends that a device can be created on.
#pragma once

#include <vector>

#include "runtime/backend/backend.h"

namespace rtapi::detail {

// The known backends, the default first. Those of this build are in it from the start.
std::vector<const kaamos::runtime::BackendFactory*> backends();
// Adds one, e.g. a test's; the same name replaces. `factory` outlives every use.
void register_backend(const kaamos::runtime::BackendFactory* factory);

}  // namespace rtapi::detail

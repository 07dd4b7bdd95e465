// SPDX-License-Identifier: MIT
// The id of an interface and its name, for messages.
#pragma once

#include <guiddef.h>

namespace kaamos::d3d12 {

struct InterfaceId {
  GUID guid;
  const char* name;
};

}  // namespace kaamos::d3d12

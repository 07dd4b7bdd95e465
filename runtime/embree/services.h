// SPDX-License-Identifier: MIT
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::embree {

// What the shaders of this backend may call; one table for all dispatches.
const shader::Services& services();

}  // namespace kaamos::embree

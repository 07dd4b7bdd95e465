// SPDX-License-Identifier: MIT
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::embree {

// The functions that the shaders of this backend may call; one table for all dispatches.
const shader::Services& services();

}  // namespace kaamos::embree

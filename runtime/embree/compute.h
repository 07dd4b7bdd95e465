// SPDX-License-Identifier: MIT
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::embree {

// Services::group_barrier: returns once all threads of the group have reached a barrier or ended.
void group_barrier(shader::ComputeGroup& group);

}  // namespace kaamos::embree

// SPDX-License-Identifier: MIT
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::embree {

// Services::group_barrier: returns once all threads of the group have reached a barrier or ended.
void group_barrier(shader::ComputeGroup& group);

// Services::wave: returns once the lanes that take part have come to the operation.
void wave_operation(shader::ComputeGroup& group, const shader::WaveCall& call);

}  // namespace kaamos::embree

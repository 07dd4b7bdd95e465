// SPDX-License-Identifier: MIT
//
// Wave operations whose lanes come on several fibers. [runtime/hlsl/analysis/wave_paths.h]
#pragma once

#include <vector>

#include "kaamos/shader/wave_op.h"

namespace kaamos::embree {

// A call that waits at a wave operation.
struct WaveArrival {
  const shader::WaveCall* call = nullptr;
  uint32_t first_lane = 0;  // of the wave; the call's lane 0
};

// Those of a wave's arrivals that go on together. `arrivals` must not be empty.
std::vector<WaveArrival> least_path(const std::vector<WaveArrival>& arrivals);

// Gives each of them its results.
void run_wave(const std::vector<WaveArrival>& arrivals);

// Answers what waits for nobody; returns false for any other operation. `first_thread` is the index
// in its group of the call's lane 0.
bool answer_at_once(const shader::WaveCall& call, uint32_t first_thread,
                    const shader::ComputeGroup& group);

}  // namespace kaamos::embree

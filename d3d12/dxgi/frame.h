// SPDX-License-Identifier: MIT
// Presented frames become PNG files and go to the program's callback.
#pragma once

#include <kaamos_present.h>

#include "d3d12/com/report.h"

namespace kaamos::d3d12 {

/// Returns whether anybody wants to see frame `number` of a swap chain: KAAMOS_PRESENT names a
/// folder and KAAMOS_PRESENT_EVERY (a whole number ≥ 1, default 1) divides it, or there is a
/// callback.
bool wants_frame(UINT64 number);

/// Calls the callback and writes `KAAMOS_PRESENT/frame_00007.png`, of swap chain 2 and later
/// `chain2_frame_00007.png`. The folder is made. Colours are as a monitor would show them: floats
/// are linear with 1 as white, alpha is left out.
/// @errors KA4041 once for each swap chain; the program goes on.
rtapi::Status deliver_frame(const KaamosFrame& frame, UINT chain);

}  // namespace kaamos::d3d12

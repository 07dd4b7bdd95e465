// SPDX-License-Identifier: MIT
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::embree {

// Services::report_hit.
shader::ReportHitResult report_hit(shader::Invocation& invocation, float t, uint32_t hit_kind,
                                   const void* attributes, uint32_t attribute_bytes);

}  // namespace kaamos::embree

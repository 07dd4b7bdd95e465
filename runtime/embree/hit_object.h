// SPDX-License-Identifier: MIT
//
// HitObject::Invoke and LoadLocalRootTableConstant; HitObject::TraceRay is with TraceRay. [DXR:
// HitObject]
#pragma once

#include "kaamos/shader/abi.h"

namespace kaamos::embree {

// Services::invoke_hit_object.
void invoke_hit_object(shader::Invocation& caller, const shader::HitObject& hit, void* payload,
                       uint32_t payload_bytes);

// Services::record_constant.
uint32_t record_constant(shader::Invocation& caller, const shader::HitObject& hit, uint32_t offset);

}  // namespace kaamos::embree

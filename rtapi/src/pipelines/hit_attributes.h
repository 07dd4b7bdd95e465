// SPDX-License-Identifier: MIT
//
// The attributes of a hit group: what its intersection shader reports and its other shaders take.
#pragma once

#include <string>

#include "rtapi/src/pipelines/state_object_impl.h"

namespace rtapi::detail {

const char* stage_name(shader::Stage stage);   // "closest-hit"
std::string describe(const Subject& subject);  // "hit group \"Sofa\""

// Errors: KA0524 sizes differ. Warns of KA0553: they differ where nothing is read.
Status check_attributes(const DeviceImpl& device, const Subject& group);

}  // namespace rtapi::detail

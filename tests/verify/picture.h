// SPDX-License-Identifier: MIT
//
// Traces the picture on a device: bottom levels of triangles and of a box, instances, hit groups,
// a local root signature, an intersection shader, a second ray from a closest-hit shader.
#pragma once

#include <rtapi/rtapi.h>

#include <string>
#include <vector>

#include "tests/verify/scene.h"

namespace kaamos::verify {

// The source of its shaders; file() names it in messages.
std::string picture_source();
// Compiled when Kaamos was built: needs neither compiler nor interpreter.
rtapi::ShaderLibrary built_in_library();

// kTexels, row after row. Throws rtapi::ResultError.
std::vector<Texel> trace_picture(const rtapi::Device& device, const rtapi::ShaderLibrary& library);

}  // namespace kaamos::verify

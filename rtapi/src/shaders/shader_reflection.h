// SPDX-License-Identifier: MIT
// ShaderReflection of the compiler's intermediate form.
#pragma once

#include <rtapi/shader_reflection.h>

#include "runtime/hlsl/ir/ir.h"

namespace rtapi::detail {

ShaderReflection reflect(const kaamos::hlsl::ir::Module& module);

}  // namespace rtapi::detail

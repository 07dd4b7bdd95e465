// SPDX-License-Identifier: MIT
//
// Function names as DXC mangles them: Microsoft's scheme with HLSL's vectors and matrices as class
// templates, e.g. "\01?Hit@@YAXUPayload@@UBuiltInTriangleIntersectionAttributes@@@Z".
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "runtime/hlsl/check/names/types.h"

namespace kaamos::hlsl {

struct FunctionInfo;

struct MangledParameter {
  const Type* type = nullptr;
  bool is_reference = false;  // numeric out and inout parameters
};

// `qualified` is "ns::f"; a template instance is "f<float, 3>", with its arguments passed
// separately.
std::string mangle(std::string_view qualified, const Type* result,
                   std::span<const MangledParameter> parameters, bool is_method = false,
                   std::string_view template_arguments = {});
std::string mangle(const FunctionInfo& function);
// Mangles one type as it appears in a template argument list.
std::string mangle_type(const Type* type);
// Microsoft's encoding of a number in a template argument, without the leading "$0".
std::string mangle_number(int64_t value);

}  // namespace kaamos::hlsl

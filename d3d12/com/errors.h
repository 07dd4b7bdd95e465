// SPDX-License-Identifier: MIT
// Errors of this library: ids KA4000 to KA4099, rows of errors.inc.
#pragma once

#include <rtapi/result.h>

#include <cstdint>
#include <string>

namespace kaamos::d3d12 {

enum class ErrorId : uint16_t {
#define KAAMOS_D3D12_ERROR(number, name, code, title, rule, cure) name = number,
#define KAAMOS_D3D12_WARNING(number, name, title, rule, cure) name = number,
#include "d3d12/com/errors.inc"
#undef KAAMOS_D3D12_WARNING
#undef KAAMOS_D3D12_ERROR
};

/// "KA4011 title: detail". `detail` says what, where, actual and allowed, and what to do.
rtapi::Error make_error(ErrorId id, const std::string& detail);

}  // namespace kaamos::d3d12

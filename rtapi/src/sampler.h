// SPDX-License-Identifier: MIT
#pragma once

#include <rtapi/descriptor.h>
#include <rtapi/result.h>
#include <rtapi/root_signature.h>

#include "rtapi/src/error_table.h"

namespace rtapi::detail {

// Numbers in range, no NaN; `id` and `what` are for the message.
Status CheckSampler(const SamplerDesc& desc, Id id, std::string_view what);

SamplerDesc ToSamplerDesc(const StaticSamplerDesc& desc);

}  // namespace rtapi::detail

// SPDX-License-Identifier: MIT
#pragma once

#include <rtapi/descriptor.h>
#include <rtapi/result.h>
#include <rtapi/root_signature.h>

#include "rtapi/src/errors/error_table.h"

namespace rtapi::detail {

// Checks that numbers are in range and not NaN; `id` and `what` go into the message.
Status check_sampler(const SamplerDesc& desc, Id id, std::string_view what);

SamplerDesc to_sampler_desc(const StaticSamplerDesc& desc);

}  // namespace rtapi::detail

// SPDX-License-Identifier: MIT
//
// Reads opacity micromap arrays and the indices of linked triangles from GPU memory, checks every
// byte against the allocations and copies it. What is undefined in DXR becomes an unknown state, so
// that any-hit shaders decide, with a warning.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <rtapi/result.h>

#include "runtime/backend/commands.h"
#include "runtime/structures/opacity_micromap.h"

namespace kaamos::runtime {

struct StructureEnvironment;

// An index as it lies in memory, of 1, 2 or 4 bytes: special ones are negative in every format.
int64_t load_micromap_index(const uint8_t* in, uint32_t bytes);

// Error KA0790: the descs lie outside the live allocations. Warning KA0799: a micromap that cannot
// be read, or a histogram that does not fit.
rtapi::Result<std::shared_ptr<const MicromapArray>> read_micromaps(
    const StructureEnvironment& environment, const BuildCommand& command);

// The linkages of a bottom level's geometries, null for those without; empty if none has one. Error
// KA0790: indices lie outside the live allocations. Warning KA0799: an index that is none.
rtapi::Result<std::vector<std::shared_ptr<MicromapLinkage>>> read_linkages(
    const StructureEnvironment& environment, const BuildCommand& command);

}  // namespace kaamos::runtime

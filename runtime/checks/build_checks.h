// SPDX-License-Identifier: MIT
//
// Checks what a build reads (indices, vertices, boxes and instance records) against DXR's rules.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/checks/proof_inputs.h"

namespace kaamos::checks {

// Reports KA0472, KA0473 of each geometry.
std::vector<GeometryContents> check_geometries(const ProofInputs& inputs,
                                               const runtime::BuildCommand& command);
// KA0474, KA0476.
void check_instances(const ProofInputs& inputs,
                     const std::vector<rtapi::RaytracingInstanceDesc>& instances);
// KA0470: an update whose indices, or whose inactive vertices or boxes, differ from its source's.
void check_update_contents(const ProofInputs& inputs, const runtime::BuildCommand& command,
                           const std::vector<GeometryContents>& contents);
// KA0471: memory ranges of one build that must not overlap.
void check_ranges(const ProofInputs& inputs, const runtime::BuildCommand& command,
                  uint64_t dest_bytes, uint64_t scratch_bytes);

}  // namespace kaamos::checks

// SPDX-License-Identifier: MIT
//
// What rays are traced against: whether it is there, is what it was when it was referred to, and
// may be traced as it is.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/backend/backend.h"
#include "runtime/checks/proof_inputs.h"

namespace kaamos::checks {

std::string shader_name(const runtime::LinkedShader& shader);  // "miss shader \"Sky\""
std::string call_place(const shader::TraceCall& call);         // " (sky.hlsl:12)"
// What checked code recorded of a call that traces.
shader::TraceCall call_of(const runtime::ReachedFrom& from);

// Names of an instance's bottom level, and of its first geometry with micromaps, if it has any.
std::string level_name(const ProofInputs& inputs, const TrackedInstance& instance);
std::string linked_name(const ProofInputs& inputs, const TrackedInstance& instance,
                        const TrackedStructure& level);

// Whether a pipeline or RayQuery must allow micromaps, or clusters, for a ray with these flags.
// [DXR: D3D12_RAYTRACING_PIPELINE_FLAGS; RAYQUERY_FLAG]
bool meets_micromaps(const TrackedInstance& instance, const TrackedStructure& level,
                     uint32_t ray_flags);
bool meets_clusters(const TrackedStructure& level, uint32_t ray_flags);

// Checks the structure behind one acceleration structure binding: it exists, is a top level, and is
// not stale. `user` says who traces: "ray generation shader \"RayGen\", t0 \"scene\"". False: a
// problem was reported.
bool check_top_level(const ProofInputs& inputs, uint64_t address, const std::string& user);
// The same for what a RayQuery reached; and that it permits what it reaches.
bool check_inline_reached(const ProofInputs& inputs, const runtime::ReachedFrom& from);

}  // namespace kaamos::checks

// SPDX-License-Identifier: MIT
//
// State objects made from states.hlsl and subobjects.hlsl.
#pragma once

#include <string>
#include <vector>

#include "tests/conformance/context.h"

namespace kaamos::conformance {

inline constexpr auto kCollection = rtapi::StateObjectType::kCollection;
inline constexpr auto kPipeline = rtapi::StateObjectType::kRaytracingPipeline;
inline constexpr auto kNoFlags = rtapi::StateObjectFlags::kNone;
inline constexpr auto kMayStayUnresolved =
    rtapi::StateObjectFlags::kAllowLocalDependenciesOnExternalDefinitions;
inline constexpr auto kOthersMayUse =
    rtapi::StateObjectFlags::kAllowExternalDependenciesOnLocalDefinitions;
inline constexpr auto kAdditions = rtapi::StateObjectFlags::kAllowStateObjectAdditions;

// The library with only these exports; an empty list exports all.
rtapi::DxilLibraryDesc states(std::vector<rtapi::ExportDesc> exports = {});
// The same for the library with subobjects.
rtapi::DxilLibraryDesc subobjects(std::vector<rtapi::ExportDesc> exports);
std::vector<rtapi::ExportDesc> named(const std::vector<std::string>& names);

// n constants, so that an association shows as 4 n bytes of arguments.
rtapi::LocalRootSignature local(Context& t, uint32_t constants);
// Binds the buffer of Start.
rtapi::GlobalRootSignature global(Context& t);

// Both configs (payload 16, attributes 8, depth 1), then the flags, if any.
rtapi::StateObjectDesc configs(rtapi::StateObjectType type = kPipeline,
                               rtapi::StateObjectFlags flags = kNoFlags, uint32_t depth = 1,
                               uint32_t payload_bytes = 16);
// The configs, a global root signature and the library.
rtapi::StateObjectDesc complete(Context& t, std::vector<rtapi::ExportDesc> exports = {},
                                rtapi::StateObjectType type = kPipeline,
                                rtapi::StateObjectFlags flags = kNoFlags);
rtapi::HitGroupDesc triangles(const std::string& name, const std::string& closest = "HitA",
                              const std::string& any = "");

rtapi::Result<rtapi::StateObject> make(Context& t, const rtapi::StateObjectDesc& desc);
bool has(const rtapi::StateObject& object, const std::string& name);
// Size in bytes of the local arguments of each of these exports.
std::vector<uint32_t> local_bytes(const rtapi::StateObject& object,
                                  const std::vector<std::string>& names);

// Runs Start with these callables in the table and returns their answers. `identifiers`: whose
// identifiers the table holds, if not the pipeline's own.
std::vector<uint32_t> call(Context& t, const rtapi::StateObject& pipeline,
                           const std::vector<std::string>& callables,
                           const rtapi::StateObject* identifiers = nullptr);

}  // namespace kaamos::conformance

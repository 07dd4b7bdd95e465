// SPDX-License-Identifier: MIT
//
// The commands that make, copy and describe acceleration structures, as far as they do not depend
// on what traverses them: checks, sizes, DXR's rules for updates and copies, messages.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/backend/backend.h"
#include "runtime/backend/commands.h"
#include "runtime/structures/structure_map.h"

namespace kaamos::runtime {

struct StructureEnvironment {
  const Context& context;
  StructureMap& structures;
  const char* backend_name;  // for messages
  void warn(const char* id, const std::string& text) const;
};

// Upper estimates from counts and flags alone, growing with every count. Backends keep the
// structures themselves: pages of the result buffer beyond the first are never touched.
rtapi::RaytracingAccelerationStructurePrebuildInfo estimate_sizes(
    rtapi::RaytracingAccelerationStructureType type, BuildFlags flags,
    std::span<const rtapi::RaytracingGeometryDesc> geometries, uint32_t instance_count);

// Makes the level: `source` is what to update, or null. Sets result.bottom_level or top_level, and
// compacted_bytes to what it holds, which is cut to the size afterwards.
using BuildLevel = std::function<rtapi::Status(const AccelerationStructure* source,
                                               AccelerationStructure& result)>;

// Errors remove the device; whatever does no harm is a message. KA0790, 0791: inputs; KA0793:
// update of what cannot be updated; KA0795: destination too small.
rtapi::Status build_structure(const StructureEnvironment& environment, const BuildCommand& command,
                              const BuildLevel& build_level);
rtapi::Status emit_postbuild_info(
    const StructureEnvironment& environment,
    const rtapi::RaytracingAccelerationStructurePostbuildInfoDesc& desc,
    std::span<const uint64_t> sources);

// KA0795 if `bytes` reach past the buffer at `address`.
rtapi::Status check_destination(const AddressMap& addresses, uint64_t address, uint64_t bytes);
// Whether two ranges of so many bytes have some in common.
bool overlap(uint64_t a, uint64_t b, uint64_t bytes);
// COMPACTED_SIZE of what holds so many bytes.
uint64_t compacted_size(uint64_t size_bytes, uint64_t held_bytes);

// KA0794: more primitives than DXR allows in a geometry.
rtapi::Status check_primitive_count(const rtapi::RaytracingGeometryDesc& desc, uint32_t index);

// Whether an update of a bottom level with these inputs keeps to DXR's rules: same geometries,
// counts, formats and flags, the transform as null as it was. KA0793 says which rule is broken.
// [DXR: Bottom-level acceleration structure updates]
rtapi::Status check_update(std::span<const GeometryShape> built, BuildFlags built_flags,
                           std::span<const rtapi::RaytracingGeometryDesc> geometries,
                           BuildFlags flags);
// KA0798.
void warn_out_of_range(const StructureEnvironment& environment, uint64_t address,
                       uint64_t triangles);

}  // namespace kaamos::runtime

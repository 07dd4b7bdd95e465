// SPDX-License-Identifier: MIT
//
// The commands that build, copy and describe acceleration structures, as far as they do not depend
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
#include "runtime/backend/errors.h"
#include "runtime/structures/structure_map.h"

namespace kaamos::runtime {

struct StructureEnvironment {
  const Context& context;
  StructureMap& structures;
  const char* backend_name;    // for messages
  bool has_micromaps = false;  // BackendDevice::has_micromaps
  void warn(Id id, const std::string& text) const;
};

// Upper bounds from counts and flags alone, growing with every count. Backends keep the structures
// themselves: pages of the result buffer beyond the first are never touched.
rtapi::RaytracingAccelerationStructurePrebuildInfo estimate_sizes(const BuildCommand& inputs);

// Builds the level. `source` is the structure to update, or null; result.linkages are those of the
// new structure. Sets result.bottom_level or top_level, and compacted_bytes to the memory that it
// takes, which is then clamped to the structure's size.
using BuildLevel = std::function<rtapi::Status(const AccelerationStructure* source,
                                               AccelerationStructure& result)>;

// An error removes the device; anything harmless is a message. KA0790, 0791: inputs; KA0793: the
// source cannot be updated; KA0795: destination too small.
rtapi::Status build_structure(const StructureEnvironment& environment, const BuildCommand& command,
                              const BuildLevel& build_level);
rtapi::Status emit_postbuild_info(
    const StructureEnvironment& environment,
    const rtapi::RaytracingAccelerationStructurePostbuildInfoDesc& desc,
    std::span<const uint64_t> sources);

// KA0795 if `bytes` extend past the end of the buffer at `address`.
rtapi::Status check_destination(const AddressMap& addresses, uint64_t address, uint64_t bytes);
// Returns whether two ranges of `bytes` bytes overlap.
bool overlap(uint64_t a, uint64_t b, uint64_t bytes);
// COMPACTED_SIZE of a structure that takes `held_bytes` bytes.
uint64_t compacted_size(uint64_t size_bytes, uint64_t held_bytes);

// KA0794: more primitives than DXR allows in a geometry.
rtapi::Status check_primitive_count(const rtapi::RaytracingGeometryDesc& desc, uint32_t index);

// Checks that an update of a bottom level with these inputs keeps to DXR's rules: the same
// geometries, counts, formats and flags, and a null transform only where it was null. KA0793 says
// which rule is broken. `linked`: which geometries have micromaps; empty: none. [DXR: Bottom-level
// acceleration structure updates]
rtapi::Status check_update(std::span<const GeometryShape> built, BuildFlags built_flags,
                           std::span<const rtapi::RaytracingGeometryDesc> geometries,
                           BuildFlags flags, const std::vector<bool>& linked = {});
// Warns with KA0798.
void warn_out_of_range(const StructureEnvironment& environment, uint64_t address,
                       uint64_t triangles);

}  // namespace kaamos::runtime

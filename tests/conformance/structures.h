// SPDX-License-Identifier: MIT
//
// Acceleration structures step by step, for rules about builds, updates and copies; and pictures of
// them to compare.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/conformance/program.h"

namespace kaamos::conformance {

using BuildFlags = rtapi::RaytracingAccelerationStructureBuildFlags;
using CopyMode = rtapi::RaytracingAccelerationStructureCopyMode;
using InfoType = rtapi::RaytracingAccelerationStructurePostbuildInfoType;
using StructureType = rtapi::RaytracingAccelerationStructureType;
using Infos = std::vector<rtapi::RaytracingAccelerationStructurePostbuildInfoDesc>;

struct Inputs {
  StructureType type = StructureType::kTopLevel;
  BuildFlags flags = BuildFlags::kNone;
  std::vector<rtapi::RaytracingGeometryDesc> geometries = {};
  rtapi::GpuVirtualAddress instances = 0;
  uint32_t instance_count = 0;

  // Points into this object.
  rtapi::BuildRaytracingAccelerationStructureInputs desc() const;
};
Inputs bottom_inputs(Context& t, const std::vector<Geometry>& geometries,
                     BuildFlags flags = BuildFlags::kNone);
Inputs top_inputs(Context& t, const std::vector<rtapi::RaytracingInstanceDesc>& instances,
                  BuildFlags flags = BuildFlags::kNone);
rtapi::RaytracingAccelerationStructurePrebuildInfo sizes_of(Context& t, const Inputs& inputs);
rtapi::Buffer memory_for(Context& t, const Inputs& inputs);

// A build with scratch memory of its own. `source` is the structure to update, or 0.
rtapi::BuildRaytracingAccelerationStructureDesc build_desc(Context& t, const Inputs& inputs,
                                                           rtapi::GpuVirtualAddress dest,
                                                           rtapi::GpuVirtualAddress source = 0);

// The first error of recording, or else of executing. An error during execution removes the device,
// so tests that cause one need a context of their own.
using Commands = std::function<void(rtapi::CommandList& list)>;
rtapi::Status record(Context& t, const Commands& commands);  // does not execute
rtapi::Status execute(Context& t, const Commands& commands);

rtapi::Status build(Context& t, const Inputs& inputs, const rtapi::Buffer& dest,
                    const rtapi::Buffer& source = {}, const Infos& infos = {});
rtapi::Buffer build_new(Context& t, const Inputs& inputs);
// Sets PERFORM_UPDATE.
rtapi::Status update(Context& t, Inputs inputs, const rtapi::Buffer& dest,
                     const rtapi::Buffer& source);
rtapi::Status copy(Context& t, const rtapi::Buffer& dest, const rtapi::Buffer& source,
                   CopyMode mode);
// Copies into memory of the size that postbuild info gives for the mode.
rtapi::Buffer copy_new(Context& t, const rtapi::Buffer& source, CopyMode mode);

// Returns what Emit writes for one structure: one value, or two for kSerialization.
std::vector<uint64_t> info_of(Context& t, const rtapi::Buffer& structure, InfoType type);
std::vector<uint64_t> words64(const std::vector<uint32_t>& words);
// Over the memory of an upload buffer.
template <class T>
void overwrite(const rtapi::Buffer& buffer, const std::vector<T>& elements) {
  std::memcpy(buffer.Map().value().data(), elements.data(), elements.size() * sizeof(T));
}

// Fifteen triangles at different depths in two geometries, the second with a transform; `depth`
// moves them further away.
std::vector<Geometry> meadow(float depth = 0);
// Three boxes at x = -4, 0 and 4; the third is a geometry of its own.
std::vector<Geometry> boxes();

// Returns what 144 rays along z see of triangles. Hit records 0 to 3, one per geometry in order.
std::vector<Seen> picture(Context& t, const rtapi::Buffer& top_level);
std::vector<Seen> picture_of_bottom(Context& t, const rtapi::Buffer& bottom_level);
void same_picture(Context& t, const std::string& what, const std::vector<Seen>& found,
                  const std::vector<Seen>& expected);
bool differ(const std::vector<Seen>& a, const std::vector<Seen>& b);
// t of the first hit of one ray along z near x = 0, for a bottom or a top level.
float t_of_bottom(Context& t, const rtapi::Buffer& bottom_level);
float t_of_top(Context& t, const rtapi::Buffer& top_level);
// A mask with bit 8 * GeometryIndex() + PrimitiveIndex() for each box whose intersection shader ran
// for a ray along z at x. Implementations may enlarge boxes: only what must be hit is certain.
uint32_t boxes_met(Context& t, const rtapi::Buffer& top_level, float x);
void meets_boxes(Context& t, const std::string& what, const rtapi::Buffer& top_level);

// Records a build of these geometries after `change` has been applied to the inputs.
rtapi::Status record_changed(Context& t, Inputs inputs, const std::function<void(Inputs&)>& change);

// The tests of as_build_tests that are about vertices.
std::vector<RuleTest> as_vertices_tests();

}  // namespace kaamos::conformance

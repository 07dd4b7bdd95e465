// SPDX-License-Identifier: MIT
//
// Opacity micromaps for tests: arrays, linked triangles, and rays at known micro-triangles.
#pragma once

#include <deque>
#include <vector>

#include "tests/conformance/structures.h"

namespace kaamos::conformance {

struct Micromap {
  uint32_t level = 0;
  rtapi::RaytracingOpacityMicromapFormat format =
      rtapi::RaytracingOpacityMicromapFormat::kOc1_4State;
  std::vector<uint32_t> states = {};  // 4^level of them
};
// States that differ from one micro-triangle to the next; 2-state formats have their low bits.
Micromap pattern(uint32_t level, rtapi::RaytracingOpacityMicromapFormat format, uint32_t seed);

// The inputs of an array, in upload buffers.
struct MicromapInputs {
  std::vector<rtapi::RaytracingOpacityMicromapHistogramEntry> histogram;
  rtapi::Buffer bits;
  rtapi::Buffer descs;
  rtapi::RaytracingOpacityMicromapArrayDesc array;
  BuildFlags flags = BuildFlags::kNone;

  // `bytes_between` lie between two micromaps, `stride` between two descs.
  MicromapInputs(Context& t, const std::vector<Micromap>& micromaps, uint32_t bytes_between = 0,
                 uint32_t stride = 8);
  MicromapInputs(const MicromapInputs&) = delete;
  // Points into this object.
  rtapi::BuildRaytracingAccelerationStructureInputs desc() const;
};
rtapi::Buffer array_of(Context& t, const std::vector<Micromap>& micromaps,
                       BuildFlags flags = BuildFlags::kNone);

// Micromap indices in a format: special ones as their low bits.
rtapi::Buffer indices_of(Context& t, const std::vector<int32_t>& indices, rtapi::Format format,
                         uint32_t stride);

// Right-angled triangles in the plane z = 5, the k-th with its first vertex at (3 k, 0) and legs of
// length 2 along x and y: vertex 1 is at (3 k + 2, 0).
Geometry row_of_triangles(uint32_t count, rtapi::RaytracingGeometryFlags flags);
// A ray along z that meets triangle k of a row at these barycentrics, of an instance moved by y.
Ray ray_in(uint32_t triangle, double u, double v, double y = 0);

// Barycentrics of the middle of micro-triangle k, by DXR's definition of the order.
struct Barycentrics {
  double u;
  double v;
};
Barycentrics middle_of(uint32_t level, uint32_t micro_triangle);

// The inputs of a bottom level with linked geometries.
class LinkedInputs {
 public:
  explicit LinkedInputs(BuildFlags flags = BuildFlags::kNone) { inputs.flags = flags; }
  LinkedInputs(const LinkedInputs&) = delete;
  // Returns the linkage, to be changed before a build.
  rtapi::RaytracingGeometryOmmLinkageDesc& add(
      Context& t, const Geometry& geometry, const rtapi::RaytracingGeometryOmmLinkageDesc& linkage);
  void add_plain(Context& t, const Geometry& geometry);

  Inputs inputs = {StructureType::kBottomLevel};

 private:
  std::deque<rtapi::RaytracingGeometryTrianglesDesc> triangles_;
  std::deque<rtapi::RaytracingGeometryOmmLinkageDesc> linkages_;
};
rtapi::RaytracingGeometryOmmLinkageDesc linkage_of(const rtapi::Buffer& array,
                                                   const rtapi::Buffer& indices = {},
                                                   rtapi::Format format = rtapi::Format::kUnknown,
                                                   uint32_t stride = 0, uint32_t base = 0);

// What a ray finds out about a triangle.
enum Found : uint32_t { kFoundNothing, kFoundOpaque, kFoundByAnyHit };
Found found_by(const Seen& seen);

// Hit group Counted in a pipeline that allows micromaps.
struct MicromapProgram : Standard {
  explicit MicromapProgram(Context& t, bool allowed = true);
  // What rays at the middles of all micro-triangles of triangle k find.
  std::vector<Found> found_at(const rtapi::Buffer& top_level, uint32_t triangle, uint32_t level,
                              uint32_t flags = 0);
};
// What the states of a micromap mean for rays without flags.
std::vector<Found> expected_of(const Micromap& micromap);
// Compares triangle k of a bottom level with a micromap.
void shows(Context& t, const std::string& what, const rtapi::Buffer& bottom_level,
           uint32_t triangle, const Micromap& micromap);

}  // namespace kaamos::conformance

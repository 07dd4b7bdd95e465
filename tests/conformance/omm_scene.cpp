// SPDX-License-Identifier: MIT
#include "tests/conformance/omm.h"

namespace kaamos::conformance {

using namespace rtapi;

using MicromapFormat = RaytracingOpacityMicromapFormat;

Micromap pattern(uint32_t level, MicromapFormat format, uint32_t seed) {
  Micromap out = {level, format, {}};
  const uint32_t mask = format == MicromapFormat::kOc1_2State ? 1 : 3;
  for (uint32_t i = 0; i < 1u << 2 * level; ++i) {
    const uint32_t mixed = (i + 1) * 2654435761u + seed * 40503u;
    out.states.push_back((mixed >> 16 ^ mixed >> 7) & mask);
  }
  return out;
}

MicromapInputs::MicromapInputs(Context& t, const std::vector<Micromap>& micromaps,
                               uint32_t bytes_between, uint32_t stride) {
  std::vector<uint8_t> bytes;
  std::vector<uint8_t> records(micromaps.size() * stride + 8);
  for (size_t i = 0; i < micromaps.size(); ++i) {
    const Micromap& micromap = micromaps[i];
    const uint32_t width = micromap.format == MicromapFormat::kOc1_2State ? 1 : 2;
    bytes.resize(bytes.size() + bytes_between, 0xFF);
    const RaytracingOpacityMicromapDesc desc = {static_cast<uint32_t>(bytes.size()),
                                                static_cast<uint16_t>(micromap.level),
                                                static_cast<uint16_t>(micromap.format)};
    std::memcpy(&records[i * stride], &desc, sizeof(desc));
    std::vector<uint8_t> packed((micromap.states.size() * width + 7) / 8);
    for (size_t k = 0; k < micromap.states.size(); ++k) {
      packed[k * width / 8] |= static_cast<uint8_t>(micromap.states[k] << k * width % 8);
    }
    bytes.insert(bytes.end(), packed.begin(), packed.end());
    histogram.push_back({1, micromap.level, micromap.format});
  }
  bits = t.upload(bytes);
  descs = t.upload(records);
  array.NumOmmHistogramEntries = static_cast<uint32_t>(histogram.size());
  array.InputBuffer = bits.GetGPUVirtualAddress();
  array.PerOmmDescs = {descs.GetGPUVirtualAddress(), stride};
}

BuildRaytracingAccelerationStructureInputs MicromapInputs::desc() const {
  static_assert(sizeof(RaytracingOpacityMicromapArrayDesc) == 40);
  const_cast<MicromapInputs*>(this)->array.pOmmHistogram = histogram.data();
  BuildRaytracingAccelerationStructureInputs out;
  out.Type = StructureType::kOpacityMicromapArray;
  out.Flags = flags;
  out.NumDescs = 1;
  out.pOpacityMicromapArrayDesc = &array;
  return out;
}

Buffer array_of(Context& t, const std::vector<Micromap>& micromaps, BuildFlags flags) {
  MicromapInputs inputs(t, micromaps);
  inputs.flags = flags;
  return t.build(inputs.desc());
}

Buffer indices_of(Context& t, const std::vector<int32_t>& indices, Format format, uint32_t stride) {
  const uint32_t bytes = format == Format::kR8Uint ? 1 : format == Format::kR16Uint ? 2 : 4;
  std::vector<uint8_t> out(indices.size() * stride + bytes);
  for (size_t i = 0; i < indices.size(); ++i) std::memcpy(&out[i * stride], &indices[i], bytes);
  return t.upload(out);
}

Geometry row_of_triangles(uint32_t count, RaytracingGeometryFlags flags) {
  Geometry out;
  out.flags = flags;
  for (uint32_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(3 * i);
    out.vertices.insert(out.vertices.end(), {x, 0, 5, x + 2, 0, 5, x, 2, 5});
  }
  return out;
}

Ray ray_in(uint32_t triangle, double u, double v, double y) {
  Ray ray;
  ray.origin[0] = static_cast<float>(3.0 * triangle + 2 * u);
  ray.origin[1] = static_cast<float>(y + 2 * v);
  return ray;
}

namespace {

struct Corners {
  Barycentrics a, b, c;
};

Barycentrics between(Barycentrics a, Barycentrics b) {
  return {(a.u + b.u) / 2, (a.v + b.v) / 2};
}

}  // namespace

Barycentrics middle_of(uint32_t level, uint32_t micro_triangle) {
  Corners now = {{0, 0}, {1, 0}, {0, 1}};
  for (uint32_t depth = level; depth-- > 0;) {
    const auto [a, b, c] = now;
    const Barycentrics ab = between(a, b), bc = between(b, c), ca = between(c, a);
    const Corners quarters[] = {{a, ab, ca}, {ca, bc, ab}, {ab, b, bc}, {bc, ca, c}};
    now = quarters[micro_triangle >> 2 * depth & 3];
  }
  return {(now.a.u + now.b.u + now.c.u) / 3, (now.a.v + now.b.v + now.c.v) / 3};
}

RaytracingGeometryOmmLinkageDesc& LinkedInputs::add(
    Context& t, const Geometry& geometry, const RaytracingGeometryOmmLinkageDesc& linkage) {
  RaytracingGeometryDesc desc = t.describe({geometry})[0];
  triangles_.push_back(desc.Triangles);
  linkages_.push_back(linkage);
  desc.Type = RaytracingGeometryType::kOmmTriangles;
  desc.OmmTriangles = {&triangles_.back(), &linkages_.back()};
  inputs.geometries.push_back(desc);
  return linkages_.back();
}

void LinkedInputs::add_plain(Context& t, const Geometry& geometry) {
  inputs.geometries.push_back(t.describe({geometry})[0]);
}

RaytracingGeometryOmmLinkageDesc linkage_of(const Buffer& array, const Buffer& indices,
                                            Format format, uint32_t stride, uint32_t base) {
  RaytracingGeometryOmmLinkageDesc out;
  if (indices) out.OpacityMicromapIndexBuffer = {indices.GetGPUVirtualAddress(), stride};
  out.OpacityMicromapIndexFormat = format;
  out.OpacityMicromapBaseLocation = base;
  if (array) out.OpacityMicromapArray = array.GetGPUVirtualAddress();
  return out;
}

Found found_by(const Seen& seen) {
  if (seen.any_hits != 0) return kFoundByAnyHit;
  return seen.end == kClosestHitRan ? kFoundOpaque : kFoundNothing;
}

MicromapProgram::MicromapProgram(Context& t, bool allowed) : Standard(t) {
  if (allowed) set_pipeline_flags(RaytracingPipelineFlags::kAllowOpacityMicromaps);
  records("Counted", 4);
}

std::vector<Found> MicromapProgram::found_at(const Buffer& top_level, uint32_t triangle,
                                             uint32_t level, uint32_t flags) {
  std::vector<Ray> list;
  for (uint32_t k = 0; k < 1u << 2 * level; ++k) {
    const auto [u, v] = middle_of(level, k);
    list.push_back(ray_in(triangle, u, v));
    list.back().flags = flags;
  }
  scene = top_level;
  std::vector<Found> out;
  for (const Seen& seen : trace(list)) out.push_back(found_by(seen));
  return out;
}

std::vector<Found> expected_of(const Micromap& micromap) {
  std::vector<Found> out;
  for (const uint32_t state : micromap.states) {
    out.push_back(state == 0 ? kFoundNothing : state == 1 ? kFoundOpaque : kFoundByAnyHit);
  }
  return out;
}

void shows(Context& t, const std::string& what, const Buffer& bottom_level, uint32_t triangle,
           const Micromap& micromap) {
  MicromapProgram program(t);
  const Buffer top = t.top_level({instance(bottom_level)});
  const auto found = program.found_at(top, triangle, micromap.level);
  const auto expected = expected_of(micromap);
  for (size_t k = 0; k < found.size(); ++k) {
    if (found[k] == expected[k]) continue;
    t.fail(what + ", triangle " + std::to_string(triangle) + ", micro-triangle " +
           std::to_string(k) + ": found " + std::to_string(found[k]) + ", expected " +
           std::to_string(expected[k]));
    return;
  }
}

}  // namespace kaamos::conformance

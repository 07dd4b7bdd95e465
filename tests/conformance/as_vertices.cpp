// SPDX-License-Identifier: MIT
//
// Acceleration structures: what builds read of vertices.
#include <cmath>

#include "tests/conformance/structures.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

// One vertex format: how a component is encoded, and which value that gives.
struct VertexCase {
  Format format;
  const char* name;
  int components;       // as read by the build
  int component_bytes;  // for 10:10:10:2, all components together
  uint32_t low, one, half;
  float half_value;
  bool is_signed;
};
constexpr VertexCase kVertexCases[] = {
    {Format::kR32G32Float, "R32G32_FLOAT", 2, 4, 0xBF800000, 0x3F800000, 0x3F000000, 0.5f, true},
    {Format::kR32G32B32Float, "R32G32B32_FLOAT", 3, 4, 0xBF800000, 0x3F800000, 0x3F000000, 0.5f,
     true},
    {Format::kR16G16Float, "R16G16_FLOAT", 2, 2, 0xBC00, 0x3C00, 0x3800, 0.5f, true},
    {Format::kR16G16B16A16Float, "R16G16B16A16_FLOAT", 3, 2, 0xBC00, 0x3C00, 0x3800, 0.5f, true},
    {Format::kR16G16Snorm, "R16G16_SNORM", 2, 2, 0x8000, 0x7FFF, 0x4000, 16384 / 32767.0f, true},
    {Format::kR16G16B16A16Snorm, "R16G16B16A16_SNORM", 3, 2, 0x8000, 0x7FFF, 0x4000,
     16384 / 32767.0f, true},
    {Format::kR16G16Unorm, "R16G16_UNORM", 2, 2, 0, 0xFFFF, 0x8000, 32768 / 65535.0f, false},
    {Format::kR16G16B16A16Unorm, "R16G16B16A16_UNORM", 3, 2, 0, 0xFFFF, 0x8000, 32768 / 65535.0f,
     false},
    {Format::kR10G10B10A2Unorm, "R10G10B10A2_UNORM", 3, 4, 0, 0x3FF, 0x200, 512 / 1023.0f, false},
    {Format::kR8G8Unorm, "R8G8_UNORM", 2, 1, 0, 0xFF, 0x80, 128 / 255.0f, false},
    {Format::kR8G8B8A8Unorm, "R8G8B8A8_UNORM", 3, 1, 0, 0xFF, 0x80, 128 / 255.0f, false},
    {Format::kR8G8Snorm, "R8G8_SNORM", 2, 1, 0x80, 0x7F, 0x40, 64 / 127.0f, true},
    {Format::kR8G8B8A8Snorm, "R8G8B8A8_SNORM", 3, 1, 0x80, 0x7F, 0x40, 64 / 127.0f, true},
};

// (low, low), (1, low), (low, 1) at z = half. An A component, where there is one, is all ones; with
// `overlap` the next vertex takes its place.
std::vector<uint8_t> encoded_triangle(const VertexCase& format, bool overlap, uint32_t& stride) {
  const uint32_t corners[3][3] = {{format.low, format.low, format.half},
                                  {format.one, format.low, format.half},
                                  {format.low, format.one, format.half}};
  const bool packed = format.format == Format::kR10G10B10A2Unorm;
  const auto bytes = static_cast<uint32_t>(format.component_bytes);
  const bool has_alpha = format.components == 3 && format.format != Format::kR32G32B32Float;
  stride = packed ? 4 : bytes * (format.components + (has_alpha && !overlap ? 1 : 0));
  std::vector<uint8_t> out(size_t{stride} * 3, 0xFF);
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t* c = corners[i];
    uint8_t* at = &out[i * stride];
    if (packed) {
      const uint32_t word = c[0] | c[1] << 10 | c[2] << 20 | 3u << 30;
      std::memcpy(at, &word, 4);
      continue;
    }
    for (int k = 0; k < format.components; ++k) {
      std::memcpy(at + static_cast<uint32_t>(k) * bytes, &c[k], bytes);
    }
  }
  return out;
}

void check_format(Context& t, Standard& program, const VertexCase& format, bool overlap) {
  uint32_t stride = 0;
  const auto vertices = t.upload(encoded_triangle(format, overlap, stride));
  Inputs inputs = bottom_inputs(t, {triangle(5)});
  auto& desc = inputs.geometries[0].Triangles;
  desc.VertexFormat = format.format;
  desc.VertexBuffer = {vertices.GetGPUVirtualAddress(), stride};
  program.scene = t.top_level({instance(build_new(t, inputs))});
  const float low = format.is_signed ? -1 : 0, size = 1 - low;
  const auto at = [](float x, float y) {
    Ray ray;
    ray.origin[0] = x;
    ray.origin[1] = y;
    ray.origin[2] = -1;
    return ray;
  };
  const float e = 1e-5f, inner = low + 0.3f * size;
  const auto seen = program.trace({at(low + 0.25f * size, inner), at(low + e, inner),
                                   at(low - e, inner), at(inner, low + e), at(inner, low - e),
                                   at(1 - 3 * e, low + e), at(1 + e, low + e)});
  const std::string name = std::string(format.name) + (overlap ? ", tight: " : ": ");
  std::vector<uint32_t> hits;
  for (const Seen& each : seen) hits.push_back(each.end == kClosestHitRan ? 1 : 0);
  t.equal(name + "hits inside, and inside and outside of each end", hits, {1, 1, 0, 1, 0, 1, 0});
  t.close(name + "z", seen[0].t - 1, format.components == 3 ? format.half_value : 0, 2e-6f);
  t.close(name + "x", seen[0].barycentrics[0], 0.25f, 1e-5f);
  t.close(name + "y", seen[0].barycentrics[1], 0.3f, 1e-5f);
}

void vertex_formats(Context& t) {
  Standard program(t);
  program.record("Plain");
  for (const VertexCase& format : kVertexCases) {
    for (const bool overlap : {false, true}) check_format(t, program, format, overlap);
  }
  const Inputs inputs = bottom_inputs(t, {triangle(5)});
  for (const Format format : {Format::kUnknown, Format::kR32G32B32A32Float, Format::kR32Float,
                              Format::kR8G8B8A8Uint, Format::kR16G16B16A16Uint}) {
    t.refused("format " + std::to_string(static_cast<uint32_t>(format)),
              record_changed(t, inputs,
                             [&](Inputs& in) { in.geometries[0].Triangles.VertexFormat = format; }),
              "KA0703");
  }
}

void flat_formats_are_transformed_in_space(Context& t) {
  const std::vector<float> flat = {0, 3, 3, -3, -3, -3};
  Inputs inputs = bottom_inputs(t, {triangle(5)});
  auto& desc = inputs.geometries[0].Triangles;
  desc.VertexFormat = Format::kR32G32Float;
  desc.VertexBuffer = {t.upload(flat).GetGPUVirtualAddress(), 8};
  // z = x / 2 + 5; the third column must have no effect.
  desc.Transform3x4 =
      t.upload(std::vector<float>{1, 0, 40, 0, 0, 1, 50, 0, 0.5f, 0, 60, 5}).GetGPUVirtualAddress();
  Standard program(t);
  program.record("Plain");
  program.scene = t.top_level({instance(build_new(t, inputs))});
  const auto seen = program.trace({ray_at(-1.1f, -1), ray_at(0.9f, -1)});
  t.close("t at x = -1", seen[0].t, 4.5f, 1e-4f);
  t.close("t at x = 1", seen[1].t, 5.5f, 1e-4f);
}

void vertex_addresses_and_strides(Context& t) {
  const auto check = [&](const char* what, Format format, uint64_t stride, uint64_t offset,
                         bool allowed) {
    Inputs inputs = bottom_inputs(t, {triangle(5)});
    auto& desc = inputs.geometries[0].Triangles;
    const Status status = record_changed(t, inputs, [&](Inputs& in) {
      auto& changed = in.geometries[0].Triangles;
      changed.VertexFormat = format;
      changed.VertexBuffer = {t.zeros(1 << 20).GetGPUVirtualAddress() + offset, stride};
    });
    if (allowed) {
      t.accepted(what, status);
    } else {
      t.refused(what, status, "KA0705");
    }
    desc = {};
  };
  check("floats at 4, stride 20", Format::kR32G32B32Float, 20, 4, true);
  check("floats at 2", Format::kR32G32B32Float, 12, 2, false);
  check("floats, stride 14", Format::kR32G32B32Float, 14, 0, false);
  check("halves at 2, stride 6", Format::kR16G16B16A16Float, 6, 2, true);
  check("halves at 1", Format::kR16G16B16A16Float, 6, 1, false);
  check("halves, stride 7", Format::kR16G16Float, 7, 0, false);
  check("bytes at 1, stride 3", Format::kR8G8B8A8Unorm, 3, 1, true);
  check("10:10:10:2, stride 4", Format::kR10G10B10A2Unorm, 4, 4, true);
  check("10:10:10:2, stride 8", Format::kR10G10B10A2Unorm, 8, 0, false);
  check("10:10:10:2 at 2", Format::kR10G10B10A2Unorm, 4, 2, false);
  check("stride 262144", Format::kR32G32B32Float, 262144, 0, true);

  const auto t_with_stride = [&](uint64_t stride, uint64_t real_stride) {
    const auto source = triangle(5).vertices;
    std::vector<float> vertices(2 * real_stride / 4 + 3);
    for (size_t i = 0; i < 3; ++i) {
      std::memcpy(&vertices[i * real_stride / 4], &source[3 * i], 12);
    }
    Inputs inputs = bottom_inputs(t, {triangle(6)});
    inputs.geometries[0].Triangles.VertexBuffer = {t.upload(vertices).GetGPUVirtualAddress(),
                                                   stride};
    return t_of_bottom(t, build_new(t, inputs));
  };
  t.close("t with stride 0x10000000C", t_with_stride(0x10000000Cull, 12), 5, 1e-3f);
  t.close("t with stride 65540", t_with_stride(65540, 65540), 5, 1e-3f);
}

void transforms_apply_at_the_build(Context& t) {
  const float m[12] = {0.8f, -0.3f, 0.1f, 0.5f, 0.2f, 1.1f, -0.2f, -0.4f, 0.1f, 0.05f, 1.2f, 1};
  Geometry plain = meadow()[0], moved = plain;
  for (size_t i = 0; i < plain.vertices.size(); i += 3) {
    const float* p = &plain.vertices[i];
    for (size_t row = 0; row < 3; ++row) {
      moved.vertices[i + row] =
          m[4 * row] * p[0] + m[4 * row + 1] * p[1] + m[4 * row + 2] * p[2] + m[4 * row + 3];
    }
  }
  Inputs inputs = bottom_inputs(t, {plain});
  const Buffer vertices = t.upload(plain.vertices);
  auto& desc = inputs.geometries[0].Triangles;
  desc.VertexBuffer.StartAddress = vertices.GetGPUVirtualAddress();
  const auto without = picture_of_bottom(t, build_new(t, inputs));
  const Buffer transform = t.upload(std::vector<float>(m, m + 12));
  desc.Transform3x4 = transform.GetGPUVirtualAddress();
  const Buffer built = build_new(t, inputs);
  overwrite(transform, std::vector<float>(12, 0.0f));
  const auto with = picture_of_bottom(t, built);
  same_picture(t, "transformed", with, picture_of_bottom(t, t.bottom_level({moved})));
  same_picture(t, "NULL", without, picture_of_bottom(t, t.bottom_level({plain})));
  t.holds("the transform changes what is seen", differ(with, without));
  t.holds("the vertices are as they were",
          std::memcmp(vertices.Map().value().data(), plain.vertices.data(),
                      plain.vertices.size() * 4) == 0);
  t.refused(
      "a transform at 8 bytes past a multiple of 16",
      record_changed(t, inputs, [](Inputs& in) { in.geometries[0].Triangles.Transform3x4 += 8; }),
      "KA0707");
}

}  // namespace

std::vector<RuleTest> as_vertices_tests() {
  return {{"AS-09", vertex_formats},
          {"AS-10", flat_formats_are_transformed_in_space},
          {"AS-11", vertex_addresses_and_strides},
          {"AS-12", transforms_apply_at_the_build}};
}

}  // namespace kaamos::conformance

// SPDX-License-Identifier: MIT
//
// Acceleration structures: what builds read.
#include <shaders/as.h>

#include <cmath>

#include "tests/conformance/structures.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

// Records a build of these geometries, or of what `change` makes of them.
Status record_changed(Context& t, Inputs inputs, const std::function<void(Inputs&)>& change) {
  const Buffer memory = memory_for(t, inputs);
  const Buffer scratch = t.zeros(1 << 16);
  change(inputs);
  BuildRaytracingAccelerationStructureDesc desc;
  desc.Inputs = inputs.desc();
  desc.DestAccelerationStructureData = memory.GetGPUVirtualAddress();
  desc.ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress();
  return record(t, [&](CommandList& list) { list.BuildRaytracingAccelerationStructure(desc); });
}

void one_kind_of_geometry(Context& t) {
  const Inputs triangles = bottom_inputs(t, {triangle(5)});
  const Inputs procedural = bottom_inputs(t, {box(5)});
  t.accepted("triangles", record_changed(t, triangles, [](Inputs&) {}));
  t.accepted("boxes", record_changed(t, procedural, [](Inputs&) {}));
  t.refused("triangles, then boxes",
            record_changed(
                t, triangles,
                [&](Inputs& inputs) { inputs.geometries.push_back(procedural.geometries[0]); }),
            "KA0702");
  t.refused(
      "boxes, then triangles",
      record_changed(t, procedural,
                     [&](Inputs& inputs) { inputs.geometries.push_back(triangles.geometries[0]); }),
      "KA0702");
}

void layouts_of_descs(Context& t) {
  const Inputs bottom = bottom_inputs(t, meadow());
  std::vector<const RaytracingGeometryDesc*> pointers;
  for (const auto& each : bottom.geometries) pointers.push_back(&each);
  auto through_pointers = bottom.desc();
  through_pointers.DescsLayout = ElementsLayout::kArrayOfPointers;
  through_pointers.ppGeometryDescs = pointers.data();
  const std::vector<RaytracingInstanceDesc> instances = {instance(build_new(t, bottom), -3),
                                                         instance(t.build(through_pointers), 3)};
  const auto expected = picture(t, t.top_level(instances));
  for (const bool swapped : {false, true}) {
    // Far apart, and not in their order.
    const Buffer first = t.upload(std::vector{instances[swapped ? 1 : 0]});
    const Buffer second = t.upload(std::vector{instances[swapped ? 0 : 1]});
    std::vector<GpuVirtualAddress> addresses = {first.GetGPUVirtualAddress(),
                                                second.GetGPUVirtualAddress()};
    if (swapped) std::swap(addresses[0], addresses[1]);
    BuildRaytracingAccelerationStructureInputs top;
    top.NumDescs = 2;
    top.DescsLayout = ElementsLayout::kArrayOfPointers;
    top.InstanceDescs = t.upload(addresses).GetGPUVirtualAddress();
    same_picture(t, swapped ? "pointers, swapped" : "pointers", picture(t, t.build(top)), expected);
  }
}

void when_inputs_are_read(Context& t) {
  const Buffer vertices = t.upload(triangle(5).vertices);
  Inputs bottom = bottom_inputs(t, {triangle(5)});
  bottom.geometries[0].Triangles.VertexBuffer.StartAddress = vertices.GetGPUVirtualAddress();
  const Buffer bottom_memory = memory_for(t, bottom);
  const Buffer instances = t.upload(std::vector{instance(bottom_memory, 50)});
  Inputs top = top_inputs(t, {instance(bottom_memory)});
  top.instances = instances.GetGPUVirtualAddress();
  const Buffer top_memory = memory_for(t, top);
  auto bottom_build = build_desc(t, bottom, bottom_memory.GetGPUVirtualAddress());
  auto top_build = build_desc(t, top, top_memory.GetGPUVirtualAddress());

  CommandList list = t.device().CreateCommandList().value();
  list.BuildRaytracingAccelerationStructure(bottom_build);
  list.ResourceBarrier(ResourceBarrier::Uav());
  list.BuildRaytracingAccelerationStructure(top_build);
  bottom.geometries[0] = {};  // host memory was copied
  bottom_build = top_build = {};
  overwrite(vertices, triangle(7).vertices);  // GPU memory was not
  overwrite(instances, std::vector{instance(bottom_memory)});
  t.queue().ExecuteAndWait(list).value();
  t.close("t of vertices written between recording and execution", t_of_top(t, top_memory), 7,
          1e-3f);
  overwrite(vertices, triangle(9).vertices);
  overwrite(instances, std::vector{instance(bottom_memory, 50)});
  t.close("t after inputs were overwritten", t_of_top(t, top_memory), 7, 1e-3f);
}

void inputs_may_go(Context& t) {
  Buffer top;
  {
    const auto vertices = CreateUploadBuffer(t.device(), triangle(5).vertices).value();
    Inputs bottom = bottom_inputs(t, {triangle(6)});
    bottom.geometries[0].Triangles.VertexBuffer.StartAddress = vertices.GetGPUVirtualAddress();
    const auto instances =
        CreateUploadBuffer(t.device(), std::vector{instance(build_new(t, bottom))}).value();
    Inputs inputs = top_inputs(t, {RaytracingInstanceDesc{}});
    inputs.instances = instances.GetGPUVirtualAddress();
    top = build_new(t, inputs);
  }
  // What stands where they stood says something else.
  for (int i = 0; i < 4; ++i) t.upload(triangle(8, 100).vertices);
  t.close("t", t_of_top(t, top), 5, 1e-3f);
}

std::vector<float> expanded(const std::vector<float>& vertices,
                            const std::vector<uint32_t>& indices) {
  std::vector<float> out;
  for (const uint32_t i : indices) {
    out.insert(out.end(), vertices.begin() + 3 * i, vertices.begin() + 3 * i + 3);
  }
  return out;
}

// Geometry 0 with indices into its own vertices.
Inputs indexed_inputs(Context& t, const std::vector<uint32_t>& indices, Format format) {
  Inputs out = bottom_inputs(t, {meadow()[0]});
  auto& triangles = out.geometries[0].Triangles;
  triangles.IndexFormat = format;
  triangles.IndexCount = static_cast<uint32_t>(indices.size());
  triangles.IndexBuffer =
      format == Format::kR32Uint
          ? t.upload(indices).GetGPUVirtualAddress()
          : t.upload(std::vector<uint16_t>(indices.begin(), indices.end())).GetGPUVirtualAddress();
  return out;
}

void indexed_is_expanded(Context& t) {
  const std::vector<uint32_t> indices = {21, 22, 23, 0,  1,  2,  8,  7,  6,
                                         3,  4,  5,  15, 16, 17, 13, 14, 12};
  Geometry flat;
  flat.vertices = expanded(meadow()[0].vertices, indices);
  const auto expected = picture_of_bottom(t, t.bottom_level({flat}));
  for (const Format format : {Format::kR16Uint, Format::kR32Uint}) {
    same_picture(t, format == Format::kR16Uint ? "16 bits" : "32 bits",
                 picture_of_bottom(t, build_new(t, indexed_inputs(t, indices, format))), expected);
  }
}

void index_formats(Context& t) {
  const Inputs indexed = indexed_inputs(t, {0, 1, 2}, Format::kR32Uint);
  const auto refused = [&](const char* what,
                           const std::function<void(RaytracingGeometryTrianglesDesc&)>& change) {
    t.refused(
        what,
        record_changed(t, indexed, [&](Inputs& inputs) { change(inputs.geometries[0].Triangles); }),
        "KA0704");
  };
  t.accepted("R32_UINT", record_changed(t, indexed, [](Inputs&) {}));
  t.accepted("R16_UINT at 2 bytes past a multiple of 4", record_changed(t, indexed, [](Inputs& in) {
               in.geometries[0].Triangles.IndexFormat = Format::kR16Uint;
               in.geometries[0].Triangles.IndexBuffer += 2;
             }));
  refused("R8_UINT", [](auto& desc) { desc.IndexFormat = Format::kR8Uint; });
  refused("UNKNOWN with an index buffer", [](auto& desc) {
    desc.IndexFormat = Format::kUnknown;
    desc.IndexCount = 0;
  });
  refused("UNKNOWN with a count", [](auto& desc) {
    desc.IndexFormat = Format::kUnknown;
    desc.IndexBuffer = 0;
  });
  refused("a count and no buffer", [](auto& desc) { desc.IndexBuffer = 0; });
  refused("R32_UINT and no buffer", [](auto& desc) { desc.IndexBuffer = desc.IndexCount = 0; });
  refused("32-bit indices at 2 bytes past a multiple of 4",
          [](auto& desc) { desc.IndexBuffer += 2; });
  refused("16-bit indices at an odd address", [](auto& desc) {
    desc.IndexFormat = Format::kR16Uint;
    desc.IndexBuffer += 1;
  });
}

// Our policy: such a triangle is never hit, and nothing outside is read.
void indices_past_the_vertices(Context& t) {
  std::vector<uint32_t> indices(24);
  for (uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
  auto wild = indices;
  indices[0] = indices[1];  // never hit
  wild[2] = 0x7FFFFFFF;
  same_picture(t, "one index past VertexCount",
               picture_of_bottom(t, build_new(t, indexed_inputs(t, wild, Format::kR32Uint))),
               picture_of_bottom(t, build_new(t, indexed_inputs(t, indices, Format::kR32Uint))));
}

void primitives_are_whole_ones(Context& t) {
  Geometry some = meadow()[0];
  some.vertices.resize(9 * 2);
  const auto expected = picture_of_bottom(t, t.bottom_level({some}));
  some.vertices.insert(some.vertices.end(), {0.1f, -50, 1});
  same_picture(t, "7 vertices", picture_of_bottom(t, t.bottom_level({some})), expected);
  same_picture(t, "8 indices",
               picture_of_bottom(
                   t, build_new(t, indexed_inputs(t, {0, 1, 2, 3, 4, 5, 6, 7}, Format::kR32Uint))),
               expected);
}

// Vertex data of one format: how a component is written, and what it then is.
struct VertexCase {
  Format format;
  const char* name;
  int components;       // that are read
  int component_bytes;  // of 10:10:10:2 all together
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

// (low, low), (1, low), (low, 1) at z = half. Where an A component follows, it is all ones, and
// with `overlap` the next vertex takes its place.
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
  // z = x / 2 + 5, and a third column that nothing may come of.
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

void box_addresses_and_strides(Context& t) {
  Inputs inputs = bottom_inputs(t, {box(5)});
  auto& desc = inputs.geometries[0].AABBs;
  desc.AABBCount = 4;
  desc.AABBs.StrideInBytes = 0;
  t.equal("primitives of stride 0 that the intersection shader ran for",
          boxes_met(t, t.top_level({instance(build_new(t, inputs))}), 0), 0xFu);

  // min and max in their places, at stride 40.
  const std::vector<float> spread = {-1, -1, 4, 1, 1, 6, 0, 0, 0, 0, 49, -1, 4, 51, 1, 6};
  desc.AABBCount = 2;
  desc.AABBs = {t.upload(spread).GetGPUVirtualAddress(), 40};
  const Buffer scene = t.top_level({instance(build_new(t, inputs))});
  t.holds("the first is met at x = 0", (boxes_met(t, scene, 0) & 1) != 0);
  t.holds("the second is met at x = 50", (boxes_met(t, scene, 50) & 2) != 0);

  const auto refused = [&](const char* what, const char* id,
                           const std::function<void(RaytracingGeometryAabbsDesc&)>& change) {
    t.refused(what, record_changed(t, inputs, [&](Inputs& in) { change(in.geometries[0].AABBs); }),
              id);
  };
  refused("an address at 4", "KA0708", [](auto& in) { in.AABBs.StartAddress += 4; });
  refused("stride 28", "KA0708", [](auto& in) { in.AABBs.StrideInBytes = 28; });
  refused("2^32 boxes, which 32 bits would take for none", "KA0709",
          [](auto& in) { in.AABBCount = 1ull << 32; });
}

void instances_written_by_a_shader(Context& t) {
  const Buffer bottom = t.bottom_level({triangle(5)});
  std::vector<uint32_t> raw(32, 0);
  const auto write = [&](size_t word, const std::vector<float>& rows, uint32_t id, uint32_t mask,
                         uint32_t contribution, uint32_t flags) {
    std::memcpy(&raw[word], rows.data(), 48);
    raw[word + 12] = id | mask << 24;
    raw[word + 13] = contribution | flags << 24;
    const uint64_t address = bottom.GetGPUVirtualAddress();
    std::memcpy(&raw[word + 14], &address, 8);
  };
  // x' = 2 y + 20, y' = x / 4, z' = z + 3: rows, then columns.
  write(0, {0, 2, 0, 20, 0.25f, 0, 0, 0, 0, 0, 1, 3}, 0xABCDEF, 0x40, 2, 0);
  // Front faces are counterclockwise.
  write(16, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, 7, 0x81, 1, 2);
  Standard writer(t, kaamos_shaders_as(), {"WriteInstances", "NotePrimitive"});
  writer.create();
  writer.raygen("WriteInstances");
  auto dispatch = writer.tables();
  dispatch.Width = 2;
  const Buffer source = t.upload(raw), written = t.zeros(kWordBytes);
  Inputs top = top_inputs(t, {RaytracingInstanceDesc{}, RaytracingInstanceDesc{}});
  top.instances = written.GetGPUVirtualAddress();
  const Buffer scene = memory_for(t, top);
  const auto desc = build_desc(t, top, scene.GetGPUVirtualAddress());
  t.accepted(
      "descs of a shader", execute(t, [&](CommandList& list) {
        list.SetComputeRootSignature(writer.global);
        list.SetPipelineState1(writer.pipeline);
        list.SetComputeRootShaderResourceView(1, source.GetGPUVirtualAddress());
        list.SetComputeRootUnorderedAccessView(2, written.GetGPUVirtualAddress());
        list.DispatchRays(dispatch);
        list.ResourceBarrier(ResourceBarrier::Transition(written, ResourceStates::kUnorderedAccess,
                                                         ResourceStates::kNonPixelShaderResource));
        list.BuildRaytracingAccelerationStructure(desc);
      }));

  Standard program(t);
  program.records("Plain", 3);
  program.scene = scene;
  Ray masked = ray_at(20);
  masked.mask = 0xBF;
  const auto seen = program.trace({ray_at(20), ray_at(0), masked});
  t.equal("InstanceID of the first", seen[0].instance_id, 0xABCDEFu);
  t.equal("InstanceIndex of the first", seen[0].instance_index, 0u);
  t.equal("record of the first", seen[0].record, 2u);
  t.close("t of the first", seen[0].t, 8, 1e-3f);
  t.equal("InstanceID of the second", seen[1].instance_id, 7u);
  t.equal("InstanceIndex of the second", seen[1].instance_index, 1u);
  t.equal("record of the second", seen[1].record, 1u);
  t.equal("a ray without the first's mask", seen[2].end, kMissRan);
  // A triangle(): clockwise from the front. The first is mirrored, which does not count.
  t.equal("kind of hit of the first", seen[0].hit_kind, kHitKindTriangleFrontFace);
  t.equal("kind of hit of the second", seen[1].hit_kind, kHitKindTriangleBackFace);

  t.refused("an array at 8 bytes past a multiple of 16",
            record_changed(t, top, [](Inputs& in) { in.instances += 8; }), "KA0717");
}

void no_descs(Context& t) {
  const Buffer empty = t.bottom_level({});
  Standard program(t);
  program.record("Plain");
  t.equal("end in an empty top level", program.trace(t.top_level({})).end, kMissRan);
  t.equal("end of an instance of nothing", program.trace(t.top_level({instance(empty)})).end,
          kMissRan);
  const Buffer both = t.top_level({instance(empty), instance(t.bottom_level({triangle(5)}))});
  t.equal("InstanceIndex beside it", program.trace(both).instance_index, 1u);
}

void limits(Context& t) {
  const auto check = [&](const char* what, const Inputs& inputs) {
    t.refused(what, t.device().GetRaytracingAccelerationStructurePrebuildInfo(inputs.desc()),
              "KA0709");
  };
  Inputs top = top_inputs(t, {RaytracingInstanceDesc{}});
  top.instance_count = (1u << 24) + 1;
  check("2^24 + 1 instances", top);
  Inputs bottom = bottom_inputs(t, {box(5), box(6)});
  bottom.geometries[0].AABBs.AABBCount = 1u << 28;
  bottom.geometries[1].AABBs.AABBCount = (1u << 28) + 1;
  check("2^29 + 1 boxes in two geometries", bottom);
  bottom.geometries[1].AABBs.AABBCount = 1u << 28;
  t.accepted("2^29 boxes",
             t.device().GetRaytracingAccelerationStructurePrebuildInfo(bottom.desc()));
  auto many = bottom.desc();
  many.NumDescs = (1u << 24) + 1;
  t.refused("2^24 + 1 geometries", t.device().GetRaytracingAccelerationStructurePrebuildInfo(many),
            "KA0709");
}

}  // namespace

std::vector<RuleTest> as_build_tests() {
  return {{"AS-01", one_kind_of_geometry},
          {"AS-02", layouts_of_descs},
          {"AS-03", when_inputs_are_read},
          {"AS-04", inputs_may_go},
          {"AS-05", indexed_is_expanded},
          {"AS-06", index_formats},
          {"AS-07", indices_past_the_vertices, "KA0472"},
          {"AS-08", primitives_are_whole_ones},
          {"AS-09", vertex_formats},
          {"AS-10", flat_formats_are_transformed_in_space},
          {"AS-11", vertex_addresses_and_strides},
          {"AS-12", transforms_apply_at_the_build},
          {"AS-13", box_addresses_and_strides},
          {"AS-14", instances_written_by_a_shader},
          {"AS-15", no_descs},
          {"AS-16", limits}};
}

}  // namespace kaamos::conformance

// SPDX-License-Identifier: MIT
//
// Acceleration structures: what builds read.
#include <shaders/as.h>

#include "tests/conformance/structures.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

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
    // Far apart and out of order.
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
  bottom.geometries[0] = {};  // host memory has been copied by now
  bottom_build = top_build = {};
  overwrite(vertices, triangle(7).vertices);  // GPU memory has not been copied
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
  // Other data takes the place of the old buffers.
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

// Geometry 0 with these indices into its own vertices.
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

// Our policy: such a triangle is never hit, and nothing out of bounds is read.
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

void box_addresses_and_strides(Context& t) {
  Inputs inputs = bottom_inputs(t, {box(5)});
  auto& desc = inputs.geometries[0].AABBs;
  desc.AABBCount = 4;
  desc.AABBs.StrideInBytes = 0;
  t.equal("primitives of stride 0 that the intersection shader ran for",
          boxes_met(t, t.top_level({instance(build_new(t, inputs))}), 0), 0xFu);

  // min and max interleaved, at stride 40.
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
  // x' = 2 y + 20, y' = x / 4, z' = z + 3, row by row.
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
  // A triangle() is clockwise seen from its front. Mirroring the first instance does not change
  // that.
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
  std::vector<RuleTest> tests = {{"AS-01", one_kind_of_geometry},
                                 {"AS-02", layouts_of_descs},
                                 {"AS-03", when_inputs_are_read},
                                 {"AS-04", inputs_may_go},
                                 {"AS-05", indexed_is_expanded},
                                 {"AS-06", index_formats},
                                 {"AS-07", indices_past_the_vertices, "KA0472"},
                                 {"AS-08", primitives_are_whole_ones},
                                 {"AS-13", box_addresses_and_strides},
                                 {"AS-14", instances_written_by_a_shader},
                                 {"AS-15", no_descs},
                                 {"AS-16", limits}};
  const std::vector<RuleTest> more = as_vertices_tests();
  tests.insert(tests.end(), more.begin(), more.end());
  return tests;
}

}  // namespace kaamos::conformance

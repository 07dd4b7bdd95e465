// SPDX-License-Identifier: MIT
//
// Acceleration structures: their memory, the states of what they are made from, barriers.
#include "tests/conformance/structures.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr ResourceStates kStructureState = ResourceStates::kRaytracingAccelerationStructure;

void addresses_are_aligned(Context& t) {
  const Inputs inputs = bottom_inputs(t, {triangle(5)}, BuildFlags::kAllowUpdate);
  const Buffer large = t.structure_memory(1 << 20), other = t.structure_memory(1 << 20);
  const Buffer bytes = t.zeros(1 << 20);
  const GpuVirtualAddress place = large.GetGPUVirtualAddress() + 256;
  const auto check = [&](const char* what, GpuVirtualAddress dest, GpuVirtualAddress source,
                         uint64_t scratch_offset, bool update) {
    Inputs changed = inputs;
    if (update) changed.flags = changed.flags | BuildFlags::kPerformUpdate;
    auto desc = build_desc(t, changed, dest, source);
    desc.ScratchAccelerationStructureData = bytes.GetGPUVirtualAddress() + scratch_offset;
    t.refused(
        what,
        record(t, [&](CommandList& list) { list.BuildRaytracingAccelerationStructure(desc); }),
        "KA0711");
  };
  check("dest of a build", place + 128, 0, 0, false);
  check("scratch of a build", place, 0, 128, false);
  check("dest of an update", place + 128, other.GetGPUVirtualAddress(), 0, true);
  check("source of an update", place, other.GetGPUVirtualAddress() + 128, 0, true);
  check("scratch of an update", place, other.GetGPUVirtualAddress(), 128, true);
  const GpuVirtualAddress structure = other.GetGPUVirtualAddress();
  const auto check_copy = [&](const char* what, GpuVirtualAddress dest, GpuVirtualAddress source,
                              CopyMode mode) {
    const auto copied = [&](GpuVirtualAddress to, GpuVirtualAddress from) {
      return record(
          t, [&](CommandList& list) { list.CopyRaytracingAccelerationStructure(to, from, mode); });
    };
    t.accepted(std::string(what) + ", both aligned", copied(dest, source));
    t.refused(std::string(what) + ", dest", copied(dest + 64, source), "KA0711");
    t.refused(std::string(what) + ", source", copied(dest, source + 64), "KA0711");
  };
  check_copy("clone", place, structure, CopyMode::kClone);
  check_copy("compact", place, structure, CopyMode::kCompact);
  check_copy("serialize", bytes.GetGPUVirtualAddress(), structure, CopyMode::kSerialize);
  check_copy("decode", bytes.GetGPUVirtualAddress(), structure,
             CopyMode::kVisualizationDecodeForTools);
  check_copy("deserialize", place, bytes.GetGPUVirtualAddress(), CopyMode::kDeserialize);
  t.refused("source of postbuild info",
            record(t,
                   [&](CommandList& list) {
                     const GpuVirtualAddress source = structure + 64;
                     list.EmitRaytracingAccelerationStructurePostbuildInfo(
                         {bytes.GetGPUVirtualAddress(), InfoType::kCurrentSize}, {&source, 1});
                   }),
            "KA0711");
}

// No bottom level can lie at an address that is not a multiple of 256. Our policy treats instances
// that name such an address like those that name any address without a bottom level: they are
// inactive.
void instanced_addresses_are_aligned(Context& t) {
  const Buffer bottom = t.bottom_level({triangle(5)});
  auto misaligned = instance(bottom);
  misaligned.AccelerationStructure += 128;
  t.distance("t", t_of_top(t, t.top_level({misaligned, instance(t.bottom_level({triangle(7)}))})),
             7.0f);
  addresses_are_aligned(t);
}

void buffers_of_structures(Context& t) {
  const auto create = [&](HeapType heap, ResourceFlags flags, ResourceStates state) {
    BufferDesc desc;
    desc.SizeInBytes = 65536;
    desc.Heap = heap;
    desc.Flags = flags;
    desc.InitialState = state;
    return t.device().CreateBuffer(desc);
  };
  t.accepted("as it has to be",
             create(HeapType::kDefault, ResourceFlags::kAllowUnorderedAccess, kStructureState));
  t.refused("without unordered access",
            create(HeapType::kDefault, ResourceFlags::kNone, kStructureState));
  t.refused("on the upload heap", create(HeapType::kUpload, ResourceFlags::kNone, kStructureState));
  t.refused("on the readback heap",
            create(HeapType::kReadback, ResourceFlags::kNone, kStructureState));
  t.refused("combined with another state",
            create(HeapType::kDefault, ResourceFlags::kAllowUnorderedAccess,
                   kStructureState | ResourceStates::kUnorderedAccess));
  const Inputs inputs = bottom_inputs(t, {triangle(5)});
  for (const ResourceStates state : {ResourceStates::kCommon, ResourceStates::kUnorderedAccess}) {
    const Buffer other =
        create(HeapType::kDefault, ResourceFlags::kAllowUnorderedAccess, state).value();
    const auto desc = build_desc(t, inputs, other.GetGPUVirtualAddress());
    t.refused(
        "a build into a buffer of another state",
        record(t, [&](CommandList& list) { list.BuildRaytracingAccelerationStructure(desc); }),
        "KA0713");
  }
}

void the_state_is_permanent(Context& t) {
  const Buffer structure = t.structure_memory(65536), other = t.zeros(65536);
  const auto refused = [&](const char* what, const Buffer& buffer, ResourceStates before,
                           ResourceStates after) {
    CommandList list = t.device().CreateCommandList().value();
    list.ResourceBarrier(ResourceBarrier::Transition(buffer, before, after));
    t.refused(what, list.Close());
    t.refused(std::string(what) + ", executed", t.queue().ExecuteAndWait(list));
  };
  refused("out of it", structure, kStructureState, ResourceStates::kUnorderedAccess);
  refused("out of it, to common", structure, kStructureState, ResourceStates::kCommon);
  refused("into it", other, ResourceStates::kUnorderedAccess, kStructureState);
  refused("as if it had another", structure, ResourceStates::kUnorderedAccess,
          ResourceStates::kNonPixelShaderResource);
  t.accepted("a UAV barrier", record(t, [&](CommandList& list) {
               list.ResourceBarrier(ResourceBarrier::Uav(structure));
             }));
  t.accepted("the device works on", t.device().GetDeviceRemovedReason());
}

// Each buffer has memory of its own, so the structures in it overlap nothing else.
void structures_share_no_memory(Context& t) {
  struct Range {
    GpuVirtualAddress first, last;
    bool structures;
  };
  std::vector<Range> ranges;
  for (const uint64_t bytes : {1ull, 256ull, 65536ull, 65537ull, 1048576ull}) {
    for (const bool structures : {false, true}) {
      for (int i = 0; i < 4; ++i) {
        const Buffer buffer = structures ? t.structure_memory(bytes) : t.zeros(bytes);
        ranges.push_back(
            {buffer.GetGPUVirtualAddress(), buffer.GetGPUVirtualAddress() + bytes - 1, structures});
      }
    }
  }
  for (const Range& a : ranges) {
    for (const Range& b : ranges) {
      t.holds("no buffer with structures overlaps one without",
              a.structures == b.structures || a.last < b.first || b.last < a.first);
    }
  }
}

// Inputs on the default heap in state NON_PIXEL_SHADER_RESOURCE, results in UNORDERED_ACCESS.
void states_of_inputs_and_results(Context& t) {
  const auto on_default_heap = [&](const auto& elements) {
    const Buffer buffer = t.zeros(elements.size() * sizeof(elements[0]));
    const Buffer source = t.upload(elements);
    execute(t, [&](CommandList& list) {
      list.ResourceBarrier(ResourceBarrier::Transition(buffer, ResourceStates::kUnorderedAccess,
                                                       ResourceStates::kCopyDest));
      list.CopyBufferRegion(buffer, 0, source, 0, source.size());
      list.ResourceBarrier(ResourceBarrier::Transition(buffer, ResourceStates::kCopyDest,
                                                       ResourceStates::kNonPixelShaderResource));
    }).value();
    return buffer;
  };
  Inputs inputs = bottom_inputs(t, {meadow()[1]});
  auto& desc = inputs.geometries[0].Triangles;
  std::vector<uint16_t> indices(desc.VertexCount);
  for (size_t i = 0; i < indices.size(); ++i) indices[i] = static_cast<uint16_t>(i);
  const auto expected = picture_of_bottom(t, build_new(t, inputs));
  desc.VertexBuffer.StartAddress = on_default_heap(meadow()[1].vertices).GetGPUVirtualAddress();
  desc.Transform3x4 = on_default_heap(meadow()[1].transform).GetGPUVirtualAddress();
  desc.IndexBuffer = on_default_heap(indices).GetGPUVirtualAddress();
  desc.IndexFormat = Format::kR16Uint;
  desc.IndexCount = desc.VertexCount;
  const Buffer bottom = build_new(t, inputs);
  Inputs top = top_inputs(t, {instance(bottom)});
  top.instances = on_default_heap(std::vector{instance(bottom)}).GetGPUVirtualAddress();
  same_picture(t, "inputs on the default heap", picture(t, build_new(t, top)), expected);

  Inputs procedural = bottom_inputs(t, boxes());
  for (size_t i = 0; i < 2; ++i) {
    procedural.geometries[i].AABBs.AABBs.StartAddress =
        on_default_heap(boxes()[i].boxes).GetGPUVirtualAddress();
  }
  meets_boxes(t, "boxes on the default heap", t.top_level({instance(build_new(t, procedural))}));

  // A buffer that is written must allow unordered access.
  const Buffer read_only = t.upload(std::vector<uint32_t>(65536));
  const Buffer memory = memory_for(t, inputs);
  auto build = build_desc(t, inputs, memory.GetGPUVirtualAddress());
  build.ScratchAccelerationStructureData = read_only.GetGPUVirtualAddress();
  t.refused("scratch memory without unordered access", record(t, [&](CommandList& list) {
              list.BuildRaytracingAccelerationStructure(build);
            }));
  const GpuVirtualAddress structure = bottom.GetGPUVirtualAddress();
  t.refused("postbuild info into it", record(t, [&](CommandList& list) {
              list.EmitRaytracingAccelerationStructurePostbuildInfo(
                  {read_only.GetGPUVirtualAddress(), InfoType::kCurrentSize}, {&structure, 1});
            }));
  for (const CopyMode mode : {CopyMode::kSerialize, CopyMode::kVisualizationDecodeForTools}) {
    t.refused("copy into it, mode " + std::to_string(static_cast<uint32_t>(mode)),
              record(t, [&](CommandList& list) {
                list.CopyRaytracingAccelerationStructure(read_only.GetGPUVirtualAddress(),
                                                         structure, mode);
              }));
  }
}

// A whole frame in one list: builds, a trace, an update and a rebuild, a trace.
void uav_barriers_order(Context& t) {
  const Buffer early = t.upload(triangle(5).vertices), late = t.upload(triangle(7).vertices);
  Inputs bottom =
      bottom_inputs(t, {triangle(5)}, BuildFlags::kAllowUpdate | BuildFlags::kAllowCompaction);
  auto& vertices = bottom.geometries[0].Triangles.VertexBuffer.StartAddress;
  vertices = early.GetGPUVirtualAddress();
  const Buffer bottom_memory = memory_for(t, bottom), clone = memory_for(t, bottom);
  const Inputs top = top_inputs(t, {instance(bottom_memory)});
  const Inputs top_of_clone = top_inputs(t, {instance(clone)});
  const Buffer scene = memory_for(t, top);
  Standard program(t);
  program.record("Plain");
  program.prepare({Ray{}});
  const auto dispatch = program.tables();
  std::vector<Buffer> results;
  CommandList list = t.device().CreateCommandList().value();
  const auto barrier = [&] { list.ResourceBarrier(ResourceBarrier::Uav()); };
  const auto trace = [&] {
    results.push_back(t.zeros(kWordBytes));
    list.SetComputeRootSignature(program.global);
    list.SetPipelineState1(program.pipeline);
    list.SetComputeRootShaderResourceView(0, scene.GetGPUVirtualAddress());
    list.SetComputeRootShaderResourceView(1, program.rays.GetGPUVirtualAddress());
    list.SetComputeRootUnorderedAccessView(2, results.back().GetGPUVirtualAddress());
    list.DispatchRays(dispatch);
  };
  list.BuildRaytracingAccelerationStructure(
      build_desc(t, bottom, bottom_memory.GetGPUVirtualAddress()));
  barrier();
  list.CopyRaytracingAccelerationStructure(clone.GetGPUVirtualAddress(),
                                           bottom_memory.GetGPUVirtualAddress(), CopyMode::kClone);
  list.BuildRaytracingAccelerationStructure(build_desc(t, top, scene.GetGPUVirtualAddress()));
  barrier();
  trace();
  barrier();
  vertices = late.GetGPUVirtualAddress();
  bottom.flags = bottom.flags | BuildFlags::kPerformUpdate;
  list.BuildRaytracingAccelerationStructure(build_desc(
      t, bottom, bottom_memory.GetGPUVirtualAddress(), bottom_memory.GetGPUVirtualAddress()));
  barrier();
  list.BuildRaytracingAccelerationStructure(build_desc(t, top, scene.GetGPUVirtualAddress()));
  barrier();
  trace();
  barrier();
  list.BuildRaytracingAccelerationStructure(
      build_desc(t, top_of_clone, scene.GetGPUVirtualAddress()));
  barrier();
  trace();
  t.accepted("the list", t.queue().ExecuteAndWait(list));
  std::vector<float> found;
  for (const Buffer& each : results) found.push_back(seen_of(t.read(each), 1)[0].t);
  t.distance("t after a build, after an update, of the clone from before", found, {5, 7, 5});
}

void info_of_a_build_is_that_of_emit(Context& t) {
  const Inputs inputs = bottom_inputs(t, meadow(), BuildFlags::kAllowCompaction);
  const Buffer memory = memory_for(t, inputs), out = t.zeros(128);
  const GpuVirtualAddress at = out.GetGPUVirtualAddress(),
                          structure = memory.GetGPUVirtualAddress();
  const std::pair<InfoType, uint64_t> places[] = {{InfoType::kCompactedSize, 0},
                                                  {InfoType::kToolsVisualization, 8},
                                                  {InfoType::kSerialization, 16},
                                                  {InfoType::kCurrentSize, 32}};
  Infos infos;
  for (const auto& [type, offset] : places) infos.push_back({at + offset, type});
  const auto desc = build_desc(t, inputs, structure);
  t.accepted("the list", execute(t, [&](CommandList& list) {
               list.BuildRaytracingAccelerationStructure(desc, infos);
               list.ResourceBarrier(ResourceBarrier::Uav());
               for (const auto& [type, offset] : places) {
                 list.EmitRaytracingAccelerationStructurePostbuildInfo({at + 64 + offset, type},
                                                                       {&structure, 1});
               }
             }));
  const auto words = words64(t.read(out));
  for (size_t i = 0; i < 5; ++i) {
    t.equal("word " + std::to_string(i), words[i], words[i + 8]);
    // A bottom level has no pointers.
    t.holds("word " + std::to_string(i) + " was written", (words[i] != 0) == (i != 3));
  }
}

void scratch_holds_nothing(Context& t) {
  const Inputs first = bottom_inputs(t, meadow()), second = bottom_inputs(t, meadow(3));
  const Buffer memory[2] = {memory_for(t, first), memory_for(t, second)};
  auto builds = std::vector{build_desc(t, first, memory[0].GetGPUVirtualAddress()),
                            build_desc(t, second, memory[1].GetGPUVirtualAddress())};
  const auto bytes = std::max<uint64_t>(256, std::max(sizes_of(t, first).ScratchDataSizeInBytes,
                                                      sizes_of(t, second).ScratchDataSizeInBytes));
  const Buffer scratch = t.zeros(bytes);
  const Buffer junk = t.upload(std::vector<uint8_t>(bytes, 0xFF));
  t.accepted("the list", execute(t, [&](CommandList& list) {
               const auto scribble = [&] {
                 list.ResourceBarrier(ResourceBarrier::Transition(
                     scratch, ResourceStates::kUnorderedAccess, ResourceStates::kCopyDest));
                 list.CopyBufferRegion(scratch, 0, junk, 0, bytes);
                 list.ResourceBarrier(ResourceBarrier::Transition(
                     scratch, ResourceStates::kCopyDest, ResourceStates::kUnorderedAccess));
               };
               scribble();
               for (auto& desc : builds) {
                 desc.ScratchAccelerationStructureData = scratch.GetGPUVirtualAddress();
                 list.BuildRaytracingAccelerationStructure(desc);
                 list.ResourceBarrier(ResourceBarrier::Uav());
               }
               scribble();
             }));
  same_picture(t, "first", picture_of_bottom(t, memory[0]),
               picture_of_bottom(t, t.bottom_level(meadow())));
  same_picture(t, "second", picture_of_bottom(t, memory[1]),
               picture_of_bottom(t, t.bottom_level(meadow(3))));
}

void allowed_on_compute_lists(Context& t) {
  const Inputs inputs = bottom_inputs(t, {triangle(5)});
  const Buffer memory = memory_for(t, inputs), other = memory_for(t, inputs), out = t.zeros(8);
  const auto desc = build_desc(t, inputs, memory.GetGPUVirtualAddress());
  const GpuVirtualAddress structure = memory.GetGPUVirtualAddress();
  const Commands build = [&](CommandList& list) {
    list.BuildRaytracingAccelerationStructure(desc);
  };
  const Commands emit = [&](CommandList& list) {
    list.EmitRaytracingAccelerationStructurePostbuildInfo(
        {out.GetGPUVirtualAddress(), InfoType::kCurrentSize}, {&structure, 1});
  };
  const Commands copy = [&](CommandList& list) {
    list.CopyRaytracingAccelerationStructure(other.GetGPUVirtualAddress(), structure,
                                             CopyMode::kClone);
  };
  const std::pair<const char*, Commands> all[] = {{"build", build}, {"emit", emit}, {"copy", copy}};
  for (const auto& [name, commands] : all) {
    t.accepted(name, execute(t, commands));
    CommandList closed = t.device().CreateCommandList().value();
    closed.Close().value();
    commands(closed);
    t.holds(std::string(name) + " on a closed list is an error", !closed.GetErrors().empty());
  }
  t.equal("CURRENT_SIZE", words64(t.read(out))[0], sizes_of(t, inputs).ResultDataMaxSizeInBytes);
  t.close("t of the copy", t_of_bottom(t, other), 5, 1e-3f);
}

// CopyBufferRegion into a structure is refused, and a structure's bytes copied by a shader are no
// structure.
void structures_are_immutable(Context& t) {
  const Buffer built = t.bottom_level({triangle(5)}), plain = t.zeros(65536);
  const Buffer other = t.structure_memory(built.size());
  const auto copied = [&](const Buffer& dest, const Buffer& source) {
    return record(t, [&](CommandList& list) { list.CopyBufferRegion(dest, 0, source, 0, 256); });
  };
  t.refused("bytes out of a structure", copied(plain, built));
  t.refused("bytes into a structure", copied(built, plain));
  t.refused("bytes of one structure to another", copied(other, built));
  t.refused("the whole buffer",
            record(t, [&](CommandList& list) { list.CopyResource(other, built); }));
  t.close("t of the structure", t_of_bottom(t, built), 5, 1e-3f);
  t.equal("t where nothing was built", t_of_bottom(t, other), -1.0f);
}

void a_build_over_it_ends_a_structure(Context& t) {
  const Inputs inputs = bottom_inputs(t, {triangle(5)}), later = bottom_inputs(t, {triangle(7)});
  const uint64_t bytes = sizes_of(t, inputs).ResultDataMaxSizeInBytes;
  t.holds("the structure is larger than 256 bytes", bytes > 256);
  const Buffer memory = t.structure_memory(2 * bytes);
  build(t, inputs, memory).value();
  t.close("t of the first", t_of_bottom(t, memory), 5, 1e-3f);
  const GpuVirtualAddress inside = memory.GetGPUVirtualAddress() + 256;
  const auto desc = build_desc(t, later, inside);
  execute(t, [&](CommandList& list) { list.BuildRaytracingAccelerationStructure(desc); }).value();
  auto second = instance(memory, 50);
  second.AccelerationStructure = inside;
  Standard program(t);
  program.record("Plain");
  program.scene = t.top_level({instance(memory), second});
  const auto seen = program.trace({ray_at(0), ray_at(50)});
  t.equal("end at the first", seen[0].end, kMissRan);
  t.close("t of the second", seen[1].t, 7, 1e-3f);
}

void top_levels_follow_bottom_levels(Context& t) {
  const BuildFlags flags = BuildFlags::kAllowUpdate;
  Inputs bottom = bottom_inputs(t, {triangle(5)}, flags);
  const Buffer memory = memory_for(t, bottom);
  build(t, bottom, memory).value();
  const Inputs top = top_inputs(t, {instance(memory)}, flags);
  const Buffer scene = build_new(t, top);
  t.close("t at first", t_of_top(t, scene), 5, 1e-3f);
  bottom.geometries = t.describe({triangle(7)});
  update(t, bottom, memory, memory).value();
  update(t, top, scene, scene).value();
  t.close("t after an update of both", t_of_top(t, scene), 7, 1e-3f);
  bottom.geometries = t.describe({triangle(9), triangle(10)});
  const Buffer rebuilt = memory_for(t, bottom);
  build(t, bottom, rebuilt).value();
  Inputs moved = top_inputs(t, {instance(rebuilt)}, flags);
  build(t, moved, scene).value();
  t.close("t after both were rebuilt", t_of_top(t, scene), 9, 1e-3f);
  build(t, bottom_inputs(t, {triangle(6)}, flags), rebuilt).value();
  update(t, moved, scene, scene).value();
  t.close("t after a rebuild and an update", t_of_top(t, scene), 6, 1e-3f);
}

void bottom_levels_may_come_later(Context& t) {
  const Buffer bottom = t.bottom_level(meadow());
  const Buffer top = t.top_level({instance(bottom)});
  const auto expected = picture(t, top);
  const Buffer saved_bottom = copy_new(t, bottom, CopyMode::kSerialize);
  auto words = words64(t.read(copy_new(t, top, CopyMode::kSerialize)));
  t.equal("pointers", words[6], uint64_t{1});
  t.equal("the pointer", words[7], bottom.GetGPUVirtualAddress());
  const auto header = words64(t.read(saved_bottom));
  const Buffer new_bottom = t.structure_memory(header[5]);
  words[7] = new_bottom.GetGPUVirtualAddress();
  // The top level first.
  const Buffer new_top = copy_new(t, t.upload(words), CopyMode::kDeserialize);
  copy(t, new_bottom, saved_bottom, CopyMode::kDeserialize).value();
  same_picture(t, "the top level came first", picture(t, new_top), expected);
}

}  // namespace

std::vector<RuleTest> as_memory_tests() {
  return {{"AS-20", instanced_addresses_are_aligned, "KA0476"},
          {"AS-21", buffers_of_structures},
          {"AS-22", the_state_is_permanent},
          {"AS-23", structures_share_no_memory},
          {"AS-24", states_of_inputs_and_results},
          {"AS-25", uav_barriers_order},
          {"AS-26", info_of_a_build_is_that_of_emit},
          {"AS-27", scratch_holds_nothing},
          {"AS-28", allowed_on_compute_lists},
          {"AS-29", structures_are_immutable, "KA0476"},
          {"AS-30", a_build_over_it_ends_a_structure, "KA0476"},
          {"AS-31", top_levels_follow_bottom_levels},
          {"AS-32", bottom_levels_may_come_later}};
}

}  // namespace kaamos::conformance

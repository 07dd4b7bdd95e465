// SPDX-License-Identifier: MIT
//
// Acceleration structures: sizes before a build, information after it.
#include <algorithm>

#include "tests/conformance/structures.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

using Sizes = RaytracingAccelerationStructurePrebuildInfo;

bool equal_sizes(const Sizes& a, const Sizes& b) {
  return a.ResultDataMaxSizeInBytes == b.ResultDataMaxSizeInBytes &&
         a.ScratchDataSizeInBytes == b.ScratchDataSizeInBytes &&
         a.UpdateScratchDataSizeInBytes == b.UpdateScratchDataSizeInBytes;
}

void sizes_read_no_gpu_memory(Context& t) {
  Inputs triangles = bottom_inputs(t, meadow(), BuildFlags::kAllowUpdate);
  for (auto& each : triangles.geometries) {
    each.Triangles.IndexFormat = Format::kR32Uint;
    each.Triangles.IndexCount = 60;
    each.Triangles.IndexBuffer = t.zeros(240).GetGPUVirtualAddress();
  }
  Inputs procedural = bottom_inputs(t, boxes());
  Inputs top = top_inputs(t, {instance(t.bottom_level({triangle(5)})), RaytracingInstanceDesc{}});
  const Sizes real[] = {sizes_of(t, triangles), sizes_of(t, procedural), sizes_of(t, top)};
  for (const GpuVirtualAddress wild : {GpuVirtualAddress{0xDEADBEEF000}, GpuVirtualAddress{1}}) {
    for (auto& each : triangles.geometries) {
      each.Triangles.IndexBuffer = each.Triangles.VertexBuffer.StartAddress = wild;
      if (each.Triangles.Transform3x4 != 0) each.Triangles.Transform3x4 = wild;
    }
    for (auto& each : procedural.geometries) each.AABBs.AABBs.StartAddress = wild;
    top.instances = wild;
    t.holds("triangles", equal_sizes(sizes_of(t, triangles), real[0]));
    t.holds("boxes", equal_sizes(sizes_of(t, procedural), real[1]));
    t.holds("instances", equal_sizes(sizes_of(t, top), real[2]));
  }
  for (auto& each : triangles.geometries) each.Triangles.IndexBuffer = 0;
  t.holds("indices without a buffer", equal_sizes(sizes_of(t, triangles), real[0]));
  auto pointers = top.desc();
  pointers.DescsLayout = ElementsLayout::kArrayOfPointers;
  t.holds("pointers to instances",
          equal_sizes(t.device().GetRaytracingAccelerationStructurePrebuildInfo(pointers).value(),
                      real[2]));
}

// Inputs with any part smaller need no more memory.
void sizes_suffice_for_less(Context& t) {
  const auto check = [&](const std::string& what, const Inputs& larger, const Inputs& smaller) {
    const Sizes a = sizes_of(t, larger), b = sizes_of(t, smaller);
    t.holds(what + ": result", b.ResultDataMaxSizeInBytes <= a.ResultDataMaxSizeInBytes);
    t.holds(what + ": scratch", b.ScratchDataSizeInBytes <= a.ScratchDataSizeInBytes);
    t.holds(what + ": update", b.UpdateScratchDataSizeInBytes <= a.UpdateScratchDataSizeInBytes);
  };
  uint32_t random = 12345;
  const auto below = [&random](uint32_t limit) {
    random = random * 1664525u + 1013904223u;
    return (random >> 8) % (limit + 1);
  };
  for (uint32_t flags = 0; flags < 32; ++flags) {
    if ((flags & 12) == 12) continue;
    for (int round = 0; round < 8; ++round) {
      Inputs larger = bottom_inputs(t, {triangle(5)}, static_cast<BuildFlags>(flags));
      auto one = larger.geometries[0];
      one.Triangles.IndexFormat = Format::kR32Uint;
      one.Triangles.IndexBuffer = 4;
      larger.geometries.assign(1 + below(6), one);
      for (auto& each : larger.geometries) {
        each.Triangles.VertexCount = below(100000);
        each.Triangles.IndexCount = below(100000);
      }
      Inputs smaller = larger;
      smaller.geometries.resize(1 + below(static_cast<uint32_t>(larger.geometries.size()) - 1));
      for (auto& each : smaller.geometries) {
        each.Triangles.VertexCount = below(each.Triangles.VertexCount);
        each.Triangles.IndexCount = below(each.Triangles.IndexCount);
      }
      check("triangles", larger, smaller);
      Inputs procedural = bottom_inputs(t, {box(5)}, static_cast<BuildFlags>(flags));
      procedural.geometries[0].AABBs.AABBCount = below(100000);
      Inputs fewer = procedural;
      fewer.geometries[0].AABBs.AABBCount =
          below(static_cast<uint32_t>(procedural.geometries[0].AABBs.AABBCount));
      check("boxes", procedural, fewer);
      Inputs top;
      top.flags = static_cast<BuildFlags>(flags);
      top.instances = 16;
      top.instance_count = below(100000);
      Inputs less = top;
      less.instance_count = below(top.instance_count);
      check("instances", top, less);
    }
  }
  // And a smaller build fits into the memory.
  const Buffer memory = memory_for(t, bottom_inputs(t, meadow()));
  build(t, bottom_inputs(t, {meadow()[1]}), memory).value();
  same_picture(t, "less in the memory of more", picture_of_bottom(t, memory),
               picture_of_bottom(t, t.bottom_level({meadow()[1]})));
}

void scratch_of_updates(Context& t) {
  for (const bool top : {false, true}) {
    const auto inputs = [&](BuildFlags flags) {
      return top ? top_inputs(t, {instance(t.bottom_level({triangle(5)}))}, flags)
                 : bottom_inputs(t, {triangle(5)}, flags);
    };
    t.equal("bytes without ALLOW_UPDATE",
            sizes_of(t, inputs(BuildFlags::kAllowCompaction)).UpdateScratchDataSizeInBytes,
            uint64_t{0});
    Inputs updatable = inputs(BuildFlags::kAllowUpdate);
    const uint64_t bytes = sizes_of(t, updatable).UpdateScratchDataSizeInBytes;
    const Buffer memory = build_new(t, updatable);
    auto desc = build_desc(t, updatable, memory.GetGPUVirtualAddress());
    desc.Inputs.Flags = BuildFlags::kAllowUpdate | BuildFlags::kPerformUpdate;
    desc.SourceAccelerationStructureData = desc.DestAccelerationStructureData;
    desc.ScratchAccelerationStructureData = bytes == 0 ? 0 : t.zeros(bytes).GetGPUVirtualAddress();
    for (int i = 0; i < 3; ++i) {
      t.accepted("an update with that much", execute(t, [&](CommandList& list) {
                   list.BuildRaytracingAccelerationStructure(desc);
                 }));
    }
  }
}

Inputs large_inputs(Context& t, BuildFlags flags) {
  Geometry many;
  for (int i = 0; i < 500; ++i) {
    const Geometry one = triangle(5 + 0.01f * static_cast<float>(i), 0.02f * static_cast<float>(i));
    many.vertices.insert(many.vertices.end(), one.vertices.begin(), one.vertices.end());
  }
  return bottom_inputs(t, {many}, flags);
}

void compacted_sizes(Context& t) {
  for (const auto flags :
       {BuildFlags::kAllowCompaction, BuildFlags::kAllowCompaction | BuildFlags::kPreferFastBuild,
        BuildFlags::kAllowCompaction | BuildFlags::kAllowUpdate}) {
    for (const Inputs& inputs :
         {large_inputs(t, flags), bottom_inputs(t, boxes(), flags), bottom_inputs(t, {}, flags),
          top_inputs(t, std::vector(70, instance(t.bottom_level({triangle(5)}))), flags)}) {
      const Buffer memory = build_new(t, inputs);
      const uint64_t compacted = info_of(t, memory, InfoType::kCompactedSize)[0];
      t.holds("COMPACTED_SIZE is not 0", compacted > 0);
      t.holds("COMPACTED_SIZE is at most CURRENT_SIZE",
              compacted <= info_of(t, memory, InfoType::kCurrentSize)[0]);
    }
  }
}

void current_sizes(Context& t) {
  const Inputs inputs = large_inputs(t, BuildFlags::kAllowCompaction);
  const Buffer memory = build_new(t, inputs);
  t.equal("as built", info_of(t, memory, InfoType::kCurrentSize)[0],
          sizes_of(t, inputs).ResultDataMaxSizeInBytes);
  const uint64_t compacted = info_of(t, memory, InfoType::kCompactedSize)[0];
  const Buffer compact = copy_new(t, memory, CopyMode::kCompact);
  t.equal("compacted", info_of(t, compact, InfoType::kCurrentSize)[0], compacted);
  const Buffer clone = copy_new(t, compact, CopyMode::kClone);
  t.equal("a clone of that", info_of(t, clone, InfoType::kCurrentSize)[0], compacted);
}

void serialization_sizes(Context& t) {
  const Buffer a = t.bottom_level({triangle(5)}), b = t.bottom_level(boxes());
  // Three instances of two bottom levels, and one without a bottom level.
  const Buffer top =
      t.top_level({instance(a), instance(b, 5, 4), instance(a, 10), RaytracingInstanceDesc{}});
  const std::pair<const char*, Buffer> all[] = {{"top level", top}, {"bottom level", a}};
  for (const auto& [name, structure] : all) {
    const auto sizes = info_of(t, structure, InfoType::kSerialization);
    const auto words = words64(t.read(copy_new(t, structure, CopyMode::kSerialize)));
    const std::string what = name;
    t.equal(what + ": size in the header", words[4], sizes[0]);
    t.equal(what + ": pointers in the header", words[6], sizes[1]);
    t.holds(what + ": the size includes header and pointers", sizes[0] >= 56 + 8 * sizes[1]);
  }
  const auto pointers = info_of(t, top, InfoType::kSerialization)[1];
  t.equal("pointers, one for each instance", pointers, uint64_t{4});
  t.equal("pointers of a bottom level", info_of(t, a, InfoType::kSerialization)[1], uint64_t{0});
}

void postbuild_info(Context& t) {
  std::vector<Buffer> structures;
  std::vector<GpuVirtualAddress> sources;
  for (size_t count : {1, 40, 7}) {
    Geometry some;
    for (size_t i = 0; i < count; ++i) {
      const Geometry one = triangle(5 + static_cast<float>(i));
      some.vertices.insert(some.vertices.end(), one.vertices.begin(), one.vertices.end());
    }
    structures.push_back(build_new(t, bottom_inputs(t, {some}, BuildFlags::kAllowCompaction)));
    sources.push_back(structures.back().GetGPUVirtualAddress());
  }
  for (uint32_t type = 0; type < 4; ++type) {
    const auto info_type = static_cast<InfoType>(type);
    const size_t each = info_type == InfoType::kSerialization ? 2 : 1;
    const Buffer out = t.upload(std::vector<uint32_t>(1));
    const Buffer array = t.zeros(8 * (3 * each + 2));
    t.accepted("emit", execute(t, [&](CommandList& list) {
                 // At 8 bytes, the natural alignment.
                 list.EmitRaytracingAccelerationStructurePostbuildInfo(
                     {array.GetGPUVirtualAddress() + 8, info_type}, sources);
               }));
    const auto words = words64(t.read(array));
    std::vector<uint64_t> expected = {0};
    for (const Buffer& structure : structures) {
      for (const uint64_t word : info_of(t, structure, info_type)) expected.push_back(word);
    }
    expected.push_back(0);
    t.equal("array of type " + std::to_string(type), words, expected);
  }
  const Buffer out = t.zeros(64);
  const GpuVirtualAddress at = out.GetGPUVirtualAddress();
  const Inputs inputs = bottom_inputs(t, {triangle(5)}, BuildFlags::kAllowCompaction);
  const Buffer memory = memory_for(t, inputs);
  const auto build_with = [&](const Infos& infos) {
    const auto desc = build_desc(t, inputs, memory.GetGPUVirtualAddress());
    return record(
        t, [&](CommandList& list) { list.BuildRaytracingAccelerationStructure(desc, infos); });
  };
  t.accepted("two types",
             build_with({{at, InfoType::kCurrentSize}, {at + 8, InfoType::kCompactedSize}}));
  t.refused("a type twice",
            build_with({{at, InfoType::kCurrentSize}, {at + 8, InfoType::kCurrentSize}}), "KA0715");
  t.refused("at 4 bytes", build_with({{at + 4, InfoType::kCurrentSize}}), "KA0715");
  t.refused("an undefined type", build_with({{at, static_cast<InfoType>(4)}}), "KA0715");
  t.refused("an array past its buffer", record(t, [&](CommandList& list) {
              list.EmitRaytracingAccelerationStructurePostbuildInfo(
                  {at + 24, InfoType::kSerialization}, sources);
            }));
}

// Decodes a structure as a tool would, rebuilds it from the result, and compares.
void decoding_for_tools(Context& t) {
  const Buffer triangles = t.bottom_level(meadow()), procedural = t.bottom_level(boxes());
  const auto decoded_words = [&](const Buffer& structure) {
    const Buffer decoded = copy_new(t, structure, CopyMode::kVisualizationDecodeForTools);
    return std::pair(decoded, words64(t.read(decoded)));
  };
  for (const bool of_boxes : {false, true}) {
    const Buffer& bottom = of_boxes ? procedural : triangles;
    const auto [decoded, words] = decoded_words(bottom);
    t.equal("type and number of descs of a bottom level", words[0],
            uint64_t{1} | uint64_t{2} << 32);
    Inputs again;
    again.type = StructureType::kBottomLevel;
    again.geometries.resize(2);
    std::memcpy(static_cast<void*>(again.geometries.data()), &words[1],
                2 * sizeof(RaytracingGeometryDesc));
    const Buffer scene = t.top_level({instance(build_new(t, again))});
    if (of_boxes) {
      meets_boxes(t, "boxes", scene);
      continue;
    }
    same_picture(t, "triangles", picture(t, scene), picture_of_bottom(t, bottom));
    // Geometry 0 has no transform, so its floats come back unchanged.
    const auto& first = again.geometries[0].Triangles;
    const auto vertices = meadow()[0].vertices;
    t.equal("vertices", first.VertexCount, static_cast<uint32_t>(vertices.size() / 3));
    const uint64_t offset = first.VertexBuffer.StartAddress - decoded.GetGPUVirtualAddress();
    const auto bytes = t.read(decoded);
    t.holds("the vertices lie in the decoded data",
            offset % 4 == 0 && offset / 4 + vertices.size() <= bytes.size());
    t.holds("the vertices are the same",
            std::memcmp(&bytes[offset / 4], vertices.data(), vertices.size() * 4) == 0);
  }
  std::vector<RaytracingInstanceDesc> instances = {
      instance(triangles, -1), RaytracingInstanceDesc{}, instance(procedural, 2, 4)};
  instances[0].InstanceID = 0xABCDEF;
  instances[0].InstanceMask = 0x7F;
  instances[2].Flags = 5;
  instances[1].Transform[1][2] = 4;
  const auto [decoded, words] = decoded_words(t.top_level(instances));
  t.equal("type and number of descs of a top level", words[0], uint64_t{3} << 32);
  t.holds("the instance descs are the same",
          std::memcmp(&words[1], instances.data(), 3 * sizeof(RaytracingInstanceDesc)) == 0);
}

}  // namespace

std::vector<RuleTest> as_info_tests() {
  return {{"AS-40", sizes_read_no_gpu_memory},
          {"AS-41", sizes_suffice_for_less},
          {"AS-42", scratch_of_updates},
          {"AS-43", compacted_sizes},
          {"AS-44", current_sizes},
          {"AS-45", serialization_sizes},
          {"AS-46", postbuild_info},
          {"AS-47", decoding_for_tools}};
}

}  // namespace kaamos::conformance

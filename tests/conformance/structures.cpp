// SPDX-License-Identifier: MIT
#include "tests/conformance/structures.h"

#include <shaders/as.h>

#include <algorithm>
#include <cmath>

namespace kaamos::conformance {

using namespace rtapi;

BuildRaytracingAccelerationStructureInputs Inputs::desc() const {
  BuildRaytracingAccelerationStructureInputs out;
  out.Type = type;
  out.Flags = flags;
  if (type == StructureType::kTopLevel) {
    out.NumDescs = instance_count;
    out.InstanceDescs = instances;
  } else {
    out.NumDescs = static_cast<uint32_t>(geometries.size());
    out.pGeometryDescs = geometries.data();
  }
  return out;
}

Inputs bottom_inputs(Context& t, const std::vector<Geometry>& geometries, BuildFlags flags) {
  return {StructureType::kBottomLevel, flags, t.describe(geometries)};
}

Inputs top_inputs(Context& t, const std::vector<RaytracingInstanceDesc>& instances,
                  BuildFlags flags) {
  Inputs out;
  out.flags = flags;
  out.instance_count = static_cast<uint32_t>(instances.size());
  if (!instances.empty()) out.instances = t.upload(instances).GetGPUVirtualAddress();
  return out;
}

RaytracingAccelerationStructurePrebuildInfo sizes_of(Context& t, const Inputs& inputs) {
  return t.device().GetRaytracingAccelerationStructurePrebuildInfo(inputs.desc()).value();
}

Buffer memory_for(Context& t, const Inputs& inputs) {
  return t.structure_memory(sizes_of(t, inputs).ResultDataMaxSizeInBytes);
}

BuildRaytracingAccelerationStructureDesc build_desc(Context& t, const Inputs& inputs,
                                                    GpuVirtualAddress dest,
                                                    GpuVirtualAddress source) {
  const auto sizes = sizes_of(t, inputs);
  const uint64_t scratch = HasAny(inputs.flags, BuildFlags::kPerformUpdate)
                               ? sizes.UpdateScratchDataSizeInBytes
                               : sizes.ScratchDataSizeInBytes;
  BuildRaytracingAccelerationStructureDesc out;
  out.Inputs = inputs.desc();
  out.DestAccelerationStructureData = dest;
  out.SourceAccelerationStructureData = source;
  out.ScratchAccelerationStructureData =
      t.zeros(std::max<uint64_t>(scratch, 256)).GetGPUVirtualAddress();
  return out;
}

Status record(Context& t, const Commands& commands) {
  CommandList list = t.device().CreateCommandList().value();
  commands(list);
  return list.Close();
}

Status execute(Context& t, const Commands& commands) {
  CommandList list = t.device().CreateCommandList().value();
  commands(list);
  if (Status s = list.Close(); !s) return s;
  return t.queue().ExecuteAndWait(list);
}

Status build(Context& t, const Inputs& inputs, const Buffer& dest, const Buffer& source,
             const Infos& infos) {
  const auto desc =
      build_desc(t, inputs, dest.GetGPUVirtualAddress(), source.GetGPUVirtualAddress());
  return execute(
      t, [&](CommandList& list) { list.BuildRaytracingAccelerationStructure(desc, infos); });
}

Buffer build_new(Context& t, const Inputs& inputs) {
  const Buffer memory = memory_for(t, inputs);
  build(t, inputs, memory).value();
  return memory;
}

Status update(Context& t, Inputs inputs, const Buffer& dest, const Buffer& source) {
  inputs.flags = inputs.flags | BuildFlags::kPerformUpdate;
  return build(t, inputs, dest, source);
}

Status copy(Context& t, const Buffer& dest, const Buffer& source, CopyMode mode) {
  return execute(t, [&](CommandList& list) {
    list.CopyRaytracingAccelerationStructure(dest.GetGPUVirtualAddress(),
                                             source.GetGPUVirtualAddress(), mode);
  });
}

Buffer copy_new(Context& t, const Buffer& source, CopyMode mode) {
  Buffer dest;
  switch (mode) {
    case CopyMode::kClone:
      dest = t.structure_memory(info_of(t, source, InfoType::kCurrentSize)[0]);
      break;
    case CopyMode::kCompact:
      dest = t.structure_memory(info_of(t, source, InfoType::kCompactedSize)[0]);
      break;
    case CopyMode::kVisualizationDecodeForTools:
      dest = t.zeros(info_of(t, source, InfoType::kToolsVisualization)[0]);
      break;
    case CopyMode::kSerialize:
      dest = t.zeros(info_of(t, source, InfoType::kSerialization)[0]);
      break;
    case CopyMode::kDeserialize: {
      const auto words = words64(t.read(source));
      dest = t.structure_memory(words[5]);  // DeserializedSizeInBytes
      break;
    }
  }
  copy(t, dest, source, mode).value();
  return dest;
}

std::vector<uint64_t> info_of(Context& t, const Buffer& structure, InfoType type) {
  const Buffer out = t.zeros(16);
  const GpuVirtualAddress source = structure.GetGPUVirtualAddress();
  execute(t, [&](CommandList& list) {
    list.EmitRaytracingAccelerationStructurePostbuildInfo({out.GetGPUVirtualAddress(), type},
                                                          {&source, 1});
  }).value();
  auto words = words64(t.read(out));
  if (type != InfoType::kSerialization) words.resize(1);
  return words;
}

std::vector<uint64_t> words64(const std::vector<uint32_t>& words) {
  std::vector<uint64_t> out(words.size() / 2);
  std::memcpy(out.data(), words.data(), out.size() * sizeof(uint64_t));
  return out;
}

std::vector<Geometry> meadow(float depth) {
  std::vector<Geometry> out(2);
  for (int i = 0; i < 15; ++i) {
    const float x = 0.9f * static_cast<float>(i * 7 % 15) - 6;
    Geometry one = triangle(2 + depth + 0.83f * static_cast<float>(i), x);
    for (size_t k = 0; k < one.vertices.size(); k += 3) {
      one.vertices[k] = x + 0.3f * (one.vertices[k] - x);
      one.vertices[k + 1] = 0.8f * one.vertices[k + 1] + 0.31f * static_cast<float>(i % 5);
    }
    auto& into = out[static_cast<size_t>(i % 2)].vertices;
    into.insert(into.end(), one.vertices.begin(), one.vertices.end());
  }
  out[1].transform = {0.9f, 0.1f, 0, 0.4f, -0.1f, 1.1f, 0, 0.2f, 0, 0, 1, 0.37f};
  return out;
}

std::vector<Geometry> boxes() {
  std::vector<Geometry> out(2);
  out[0] = box(9, -4);
  out[0].boxes.push_back(box(10, 0).boxes[0]);
  out[1] = box(11, 4);
  return out;
}

namespace {

Standard tracer(Context& t) {
  Standard program(t);
  program.records("Plain", 4);
  return program;
}

bool same(const Seen& a, const Seen& b) {
  const auto near = [](float x, float y) {
    return std::fabs(x - y) <= 1e-4f * std::max(1.0f, std::fabs(y));
  };
  return a.end == b.end && a.record == b.record && a.instance_index == b.instance_index &&
         a.instance_id == b.instance_id && a.geometry == b.geometry && a.primitive == b.primitive &&
         a.hit_kind == b.hit_kind && near(a.t, b.t) && near(a.barycentrics[0], b.barycentrics[0]) &&
         near(a.barycentrics[1], b.barycentrics[1]);
}

}  // namespace

std::vector<Seen> picture(Context& t, const Buffer& top_level) {
  Standard program = tracer(t);
  program.scene = top_level;
  std::vector<Ray> rays;
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 12; ++x) {
      rays.push_back(
          ray_at(-6.013f + static_cast<float>(x), -3.017f + 0.6f * static_cast<float>(y)));
      rays.back().multiplier = 1;
    }
  }
  return program.trace(rays);
}

std::vector<Seen> picture_of_bottom(Context& t, const Buffer& bottom_level) {
  return picture(t, t.top_level({instance(bottom_level)}));
}

void same_picture(Context& t, const std::string& what, const std::vector<Seen>& found,
                  const std::vector<Seen>& expected) {
  const auto hits = std::count_if(expected.begin(), expected.end(),
                                  [](const Seen& each) { return each.end == kClosestHitRan; });
  t.holds(what + ": the picture shows hits and misses",
          hits > 2 && hits < static_cast<ptrdiff_t>(expected.size()));
  size_t different = 0;
  for (size_t i = 0; i < expected.size(); ++i) {
    if (same(found[i], expected[i])) continue;
    if (different++ == 0) {
      t.fail(what + ": ray " + std::to_string(i) + " ends with " + std::to_string(found[i].end) +
             " at t = " + std::to_string(found[i].t) + " on primitive " +
             std::to_string(found[i].primitive) + ", expected " + std::to_string(expected[i].end) +
             " at t = " + std::to_string(expected[i].t) + " on primitive " +
             std::to_string(expected[i].primitive));
    }
  }
  if (different > 1) t.fail(what + ": " + std::to_string(different) + " rays differ");
}

bool differ(const std::vector<Seen>& a, const std::vector<Seen>& b) {
  return !std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

float t_of_top(Context& t, const Buffer& top_level) {
  Standard program = tracer(t);
  const Seen seen = program.trace(top_level);
  return seen.end == kClosestHitRan ? seen.t : -1;
}

uint32_t boxes_met(Context& t, const Buffer& top_level, float x) {
  Standard program(t, kaamos_shaders_as(), {"WriteInstances", "NotePrimitive"});
  program.group("Noting", "BoxClosest", "", "NotePrimitive");
  program.local(kRecordSignature, {"Noting"});
  program.record("Noting");
  program.scene = top_level;
  program.trace(ray_at(x));
  return program.intersections();
}

void meets_boxes(Context& t, const std::string& what, const Buffer& top_level) {
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t bit = i < 2 ? i : 8;
    const float x = -4 + 4 * static_cast<float>(i);
    t.holds(what + ": the box at x = " + std::to_string(x) + " is met",
            (boxes_met(t, top_level, x) >> bit & 1) != 0);
  }
}

float t_of_bottom(Context& t, const Buffer& bottom_level) {
  return t_of_top(t, t.top_level({instance(bottom_level)}));
}

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

}  // namespace kaamos::conformance

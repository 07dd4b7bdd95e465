// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: opacity micromaps of clusters.
#include <string>
#include <utility>

#include "tests/conformance/cls.h"
#include "tests/conformance/omm.h"

namespace kaamos::conformance::cls {

namespace {

using MicromapFormat = RaytracingOpacityMicromapFormat;
using GeometryFlags = RaytracingGeometryFlags;

constexpr uint32_t kLevel = 2;  // of all micromaps here
constexpr uint32_t kDisableOmms = 0x20;
constexpr uint32_t kForceTwoStates = 0x10;

Micromap map_of(uint32_t seed) {
  return pattern(kLevel, MicromapFormat::kOc1_4State, seed);
}
// One that is the same everywhere, as special indices and geometry flags mean it.
Micromap uniform(uint32_t state) {
  return {kLevel, MicromapFormat::kOc1_4State, std::vector<uint32_t>(16, state)};
}
constexpr uint32_t kTransparentState = 0;
constexpr uint32_t kOpaqueState = 1;
constexpr uint32_t kUnknownState = 3;  // any-hit decides

// A cluster of a row of triangles with micromaps, and how it is built.
struct Linked {
  TrianglesDesc desc = triangles_desc(1, Flags::kAllowOmm);
  ClusterArgs args;

  Linked(Context& t, uint32_t triangles, const Buffer& array, GeometryFlags flags = {}) {
    args = cluster(t, row_of_triangles(triangles, flags));
    if (array) args.OpacityMicromapArray = array.GetGPUVirtualAddress();
  }
  void set_indices(Context& t, RtasIndexFormat format, const std::vector<int32_t>& indices,
                   uint32_t stride = 0) {
    const auto bytes = static_cast<uint32_t>(format);
    std::vector<uint8_t> memory(indices.size() * std::max(stride, bytes) + 4, 0x55);
    for (size_t i = 0; i < indices.size(); ++i) {
      std::memcpy(&memory[i * (stride == 0 ? bytes : stride)], &indices[i], bytes);
    }
    desc.OpacityMicromapIndexFormat = format;
    args.OpacityMicromapIndexBuffer = t.upload(memory).GetGPUVirtualAddress();
    args.OpacityMicromapIndexBufferStride = static_cast<uint16_t>(stride);
  }
  uint64_t build(Context& t) const {
    return cls::build(t, desc, std::vector<ClusterArgs>{args})[0];
  }
};

uint64_t linked_level(Context& t, const std::vector<uint64_t>& clusters) {
  RtasClasInputsDesc desc = level_desc(1, static_cast<uint32_t>(clusters.size()));
  desc.Flags = Flags::kAllowOmm;
  LevelArgs args;
  args.ClasAddressCount = static_cast<uint32_t>(clusters.size());
  args.ClasAddressArray = t.upload(clusters).GetGPUVirtualAddress();
  return build(t, desc, std::vector<LevelArgs>{args})[0];
}

// Compares the triangles of a cluster with micromaps.
void shows(Context& t, const std::string& what, const Buffer& top,
           const std::vector<Micromap>& expected, uint32_t ray_flags = 0) {
  MicromapProgram program(t);
  for (uint32_t k = 0; k < expected.size(); ++k) {
    const bool same = program.found_at(top, k, kLevel, ray_flags) == expected_of(expected[k]);
    t.holds(what + ", triangle " + std::to_string(k), same);
  }
}
void shows(Context& t, const std::string& what, const Linked& linked,
           const std::vector<Micromap>& expected) {
  shows(t, what, top_of(t, linked_level(t, {linked.build(t)})), expected);
}

void arrays_and_indices(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const std::vector<Micromap> maps = {map_of(1), map_of(2), map_of(3)};
  const Buffer array = array_of(t, maps);
  Linked counted(t, 2, array);
  counted.args.OpacityMicromapBaseLocation = 1;
  shows(t, "without indices", counted, {maps[1], maps[2]});
  Linked none(t, 2, {});
  shows(t, "neither", none, {uniform(kUnknownState), uniform(kUnknownState)});
  Linked ignored(t, 2, {});
  ignored.set_indices(t, RtasIndexFormat::kUint8, {-1, -2});
  ignored.desc.OpacityMicromapIndexFormat = RtasIndexFormat::kNone;
  shows(t, "indices without a format", ignored, {uniform(kUnknownState), uniform(kUnknownState)});
  Linked special(t, 4, {});
  special.set_indices(t, RtasIndexFormat::kUint8, {-1, -2, -3, -4});
  shows(t, "special ones without an array", special,
        {uniform(kTransparentState), uniform(kOpaqueState), uniform(kUnknownState),
         uniform(kUnknownState)});
  own.noted("all of them", "");
}

void index_formats(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const std::vector<Micromap> maps = {map_of(1), map_of(2), map_of(3)};
  const Buffer array = array_of(t, maps);
  for (const uint32_t bytes : {1u, 2u, 4u}) {
    for (const uint32_t stride : {0u, 4u, 8u}) {
      Linked linked(t, 3, array);
      linked.args.OpacityMicromapBaseLocation = 1;
      linked.set_indices(t, static_cast<RtasIndexFormat>(bytes), {1, -2, 0}, stride);
      shows(t, std::to_string(bytes) + " bytes, stride " + std::to_string(stride), linked,
            {maps[2], uniform(kOpaqueState), maps[1]});
    }
  }
  own.noted("strides", "");
  Linked odd(t, 1, array);
  odd.set_indices(t, RtasIndexFormat::kUint16, {0, 0, 0}, 3);
  t.equal("an odd stride", odd.build(t), 0u);
  own.noted("an odd stride", "multiples of 2");
  Linked outside(t, 1, array);
  outside.set_indices(t, RtasIndexFormat::kUint32, {0});
  outside.args.OpacityMicromapIndexBuffer += 8;
  t.equal("indices outside of their buffer", outside.build(t), 0u);
  own.noted("indices outside of their buffer", "the micromap indices");
}

// -5: the triangle's own flag, whatever else the cluster has.
void skipped_triangles(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const Micromap map = map_of(1);
  const Buffer array = array_of(t, {map});
  for (const bool opaque : {false, true}) {
    Linked linked(t, 2, array, opaque ? GeometryFlags::kOpaque : GeometryFlags::kNone);
    linked.set_indices(t, RtasIndexFormat::kUint8, {-5, 0});
    shows(t, opaque ? "opaque" : "not opaque", linked,
          {uniform(opaque ? kOpaqueState : kUnknownState), map});
  }
  own.noted("all of it", "");
}

void permissions(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const Micromap map = map_of(1);
  const Buffer array = array_of(t, {map});
  Linked linked(t, 1, array);
  const uint64_t good = linked.build(t);
  own.noted("with the flag", "");
  Linked without = linked;
  without.desc.Flags = Flags::kNone;
  without.build(t);
  own.noted("a cluster without the flag", "lacks kAllowOmm");
  without = linked;
  without.desc.Limits.MaxOpacityMicromapIndicesPerCluster = 0;
  without.build(t);
  own.noted("more than its limit", "MaxOpacityMicromapIndicesPerCluster is 0");
  const uint64_t level = level_of(t, {good});
  own.noted("a bottom level without the flag", "lacks kAllowOmm");
  shows(t, "a bottom level without the flag", top_of(t, level), {map});
  RtasClusterMovesDesc moves;
  moves.MaxArgCount = 1;
  moves.Type = RtasMoveOperationType::kClusterLevelAccelerationStructure;
  moves.MaxBytesMoved = 4096;
  const auto move = [&] {
    const Buffer arguments = t.upload(std::vector<RtasMoveClusterObjectsArgs>{{good}});
    Batch batch = batch_of(t, inputs_of(moves), arguments);
    batch.memory = t.structure_memory(4096);
    batch.data.BatchResultData = batch.memory.GetGPUVirtualAddress();
    t.accepted("a move", run(t, inputs_of(moves), batch));
    return addresses_in(t, batch)[0];
  };
  move();
  own.noted("a move without the flag", "lacks kAllowOmm");
  moves.Flags = RtasClusterMoveOperationFlags::kAllowOmm;
  shows(t, "a moved one", top_of(t, linked_level(t, {move()})), {map});
  own.noted("a moved one", "");
}

void disabled_by_instances(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const Micromap map = map_of(1);
  const Buffer array = array_of(t, {map});
  Linked linked(t, 1, array);
  linked.args.ClusterFlags = RtasClusterFlags::kAllowDisableOmms;
  // Clusters without micromaps need no permission.
  ClusterArgs plain = cluster(t, triangle(9, 30));
  const uint64_t level = linked_level(
      t, {linked.build(t), build(t, triangles_desc(1), std::vector<ClusterArgs>{plain})[0]});
  RaytracingInstanceDesc desc = instance_of(level);
  desc.Flags = kDisableOmms;
  shows(t, "disabled", t.top_level({desc}), {uniform(kUnknownState)});
  desc.Flags = kForceTwoStates;
  Micromap two = map;
  for (uint32_t& state : two.states) state &= 1;
  shows(t, "two states", t.top_level({desc}), {two});
  desc.Flags = 0;
  shows(t, "by itself", t.top_level({desc}), {map});
  own.noted("all of it", "");
}

// The address counts, not what was there when the cluster was built.
void array_comes_later(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const std::vector<Micromap> maps = {map_of(4)};
  MicromapInputs inputs(t, maps);
  const auto desc = inputs.desc();
  const auto sizes = t.device().GetRaytracingAccelerationStructurePrebuildInfo(desc).value();
  const Buffer memory = t.structure_memory(sizes.ResultDataMaxSizeInBytes);
  const Linked linked(t, 1, memory);
  const uint64_t level = linked_level(t, {linked.build(t)});
  t.accepted("the array", execute(t, [&](CommandList& list) {
               list.BuildRaytracingAccelerationStructure(
                   {.DestAccelerationStructureData = memory.GetGPUVirtualAddress(),
                    .Inputs = desc,
                    .ScratchAccelerationStructureData =
                        t.zeros(std::max<uint64_t>(sizes.ScratchDataSizeInBytes, 256))
                            .GetGPUVirtualAddress()});
             }));
  shows(t, "an array that was built last", top_of(t, level), maps);
  own.noted("all of it", "");
}

void templates(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const Micromap map = map_of(6);
  const Buffer array = array_of(t, {map});
  const Linked linked(t, 1, array);
  RtasClusterTemplateTrianglesInputsDesc desc;
  desc.Limits = linked.desc.Limits;
  desc.Flags = Flags::kAllowOmm;
  RtasBuildClusterTemplatesFromTrianglesArgs args;
  args.TrianglesArgs = linked.args;
  const uint64_t made =
      build(t, desc, std::vector<RtasBuildClusterTemplatesFromTrianglesArgs>{args})[0];
  RtasInstantiateClusterTemplateInputsDesc instances;
  instances.Limits = linked.desc.Limits;
  instances.Flags = Flags::kAllowOmm;
  RtasInstantiateClusterTemplatesArgs instance;
  instance.ClusterTemplate = made;
  instance.VertexBuffer = {linked.args.VertexBuffer, 0};
  const auto all = std::vector<RtasInstantiateClusterTemplatesArgs>{instance};
  shows(t, "an instance", top_of(t, linked_level(t, build(t, instances, all))), {map});
  own.noted("with the flag", "");
  instances.Flags = Flags::kNone;
  build(t, instances, all);
  own.noted("without the flag", "lacks kAllowOmm");
}

}  // namespace

std::vector<RuleTest> micromap_tests() {
  return {{"CLS-17", arrays_and_indices},    {"CLS-18", index_formats},
          {"CLS-18", skipped_triangles},     {"CLS-19, IND-34", permissions},
          {"CLS-20", disabled_by_instances}, {"CLS-21", array_comes_later},
          {"CLS-30, IND-34", templates}};
}

}  // namespace kaamos::conformance::cls

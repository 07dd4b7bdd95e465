// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: the copies that there are of what operations made: serialized, deserialized, and
// decoded for tools.
#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "tests/conformance/cls.h"
#include "tests/conformance/omm.h"

namespace kaamos::conformance::cls {

namespace {

using Header = SerializedRaytracingAccelerationStructureHeader1;
using Block = SerializedRaytracingAccelerationStructureBlock;
using ToolsHeader = BuildRaytracingAccelerationStructureToolsVisualizationHeader;
using ptl::Operations;
using ptl::WriteArgs;

Status copy_to(Context& t, GpuVirtualAddress dest, GpuVirtualAddress source, CopyMode mode) {
  return execute(
      t, [&](CommandList& list) { list.CopyRaytracingAccelerationStructure(dest, source, mode); });
}
std::vector<uint64_t> info_at(Context& t, GpuVirtualAddress source, InfoType type) {
  const Buffer out = t.zeros(16);
  t.accepted("postbuild info", execute(t, [&](CommandList& list) {
               list.EmitRaytracingAccelerationStructurePostbuildInfo(
                   {out.GetGPUVirtualAddress(), type}, {&source, 1});
             }));
  return words64(t.read(out));
}

// The serialized form of a structure, in host memory.
struct Serialized {
  std::vector<uint32_t> words;
  std::vector<uint64_t> info;  // as postbuild info gave it

  Serialized(Context& t, GpuVirtualAddress source) {
    info = info_at(t, source, InfoType::kSerialization);
    const Buffer dest = t.zeros(info[0]);
    t.accepted("serialization",
               copy_to(t, dest.GetGPUVirtualAddress(), source, CopyMode::kSerialize));
    words = t.read(dest);
    t.equal("its size", header().SerializedSizeInBytesIncludingHeader, info[0]);
    t.equal("its blocks", uint64_t{header().NumBlocks}, info[1]);
    t.holds("its identifier", t.device().CheckDriverMatchingIdentifier(
                                  SerializedDataType::kRaytracingAccelerationStructure,
                                  header().DriverMatchingIdentifier) ==
                                  DriverMatchingIdentifierStatus::kCompatibleWithDevice);
  }
  Header header() const {
    Header header;
    std::memcpy(static_cast<void*>(&header), words.data(), sizeof(header));
    return header;
  }
  Block block() const {
    Block block;
    std::memcpy(static_cast<void*>(&block), &words[14], sizeof(block));
    return block;
  }
  std::vector<uint64_t> pointers() const {
    std::vector<uint64_t> out(block().NumBlockPointersAfterHeader);
    std::memcpy(out.data(), &words[18], out.size() * 8);
    return out;
  }
  void set_pointers(const std::vector<uint64_t>& addresses) {
    std::memcpy(&words[18], addresses.data(), addresses.size() * 8);
  }
  void has_block(Context& t, SerializedBlockType type, const std::vector<uint64_t>& addresses) {
    t.equal("postamble", static_cast<uint32_t>(header().HeaderPostambleType), 0xFFFFFFFFu);
    t.equal("type of the block", static_cast<uint32_t>(block().Type), static_cast<uint32_t>(type));
    t.equal("addresses", pointers(), addresses);
  }
  Buffer room(Context& t) const { return t.structure_memory(header().DeserializedSizeInBytes); }
  Status deserialize(Context& t, const Buffer& dest) const {
    const Buffer bytes = t.upload(words);
    return copy_to(t, dest.GetGPUVirtualAddress(), bytes.GetGPUVirtualAddress(),
                   CopyMode::kDeserialize);
  }
};

void clusters_and_levels(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const auto clusters = build(
      t, triangles_desc(),
      std::vector<ClusterArgs>{cluster(t, triangle(5), 3, 77), cluster(t, triangle(8, 10), 65535)});
  const uint64_t level = level_of(t, clusters);
  Serialized first(t, clusters[0]);
  const Serialized second(t, clusters[1]);
  Serialized whole(t, level);
  t.equal("blocks of a cluster without micromaps", first.info[1], uint64_t{0});
  whole.has_block(t, SerializedBlockType::kClusterLevel, clusters);

  // The bottom level comes first, then a top level, then the clusters.
  const Buffer at_first = first.room(t);
  const Buffer at_second = second.room(t);
  whole.set_pointers({at_first.GetGPUVirtualAddress(), at_second.GetGPUVirtualAddress()});
  const Buffer at_level = whole.room(t);
  t.accepted("a bottom level", whole.deserialize(t, at_level));
  const Buffer top = top_of(t, at_level.GetGPUVirtualAddress());
  own.notes->clear();
  t.distance("without its clusters", depths_at(t, top, {0, 10}), {-1, -1});
  t.holds("a note", own.notes->size() == 1 &&
                        own.notes->front().find("lacks 2 of its 2 clusters") != std::string::npos);
  own.notes->clear();
  t.accepted("the second cluster", second.deserialize(t, at_second));
  t.distance("with one cluster", depths_at(t, top, {0, 10}), {-1, 8});
  t.accepted("the first cluster", first.deserialize(t, at_first));
  const auto seen = look(t, top, {0, 10});
  t.distance("with both", depths_at(t, top, {0, 10}), {5, 8});
  t.equal("geometry index", seen[0].geometry, 3u);
  t.equal("another", seen[1].geometry, 65535u);
  own.noted("all of it", "");
  t.distance("the original", depths_at(t, top_of(t, level), {0, 10}), {5, 8});

  // A deserialized one is as good as any: it can be serialized, and be in other bottom levels.
  whole = Serialized(t, at_level.GetGPUVirtualAddress());
  whole.has_block(t, SerializedBlockType::kClusterLevel,
                  {at_first.GetGPUVirtualAddress(), at_second.GetGPUVirtualAddress()});
  t.distance("another bottom level",
             depths_at(t, top_of(t, level_of(t, {at_first.GetGPUVirtualAddress()})), {0, 10}),
             {5, -1});
  // The same cluster twice, by another address.
  whole.set_pointers({at_first.GetGPUVirtualAddress(), 0});
  t.accepted("without one", whole.deserialize(t, at_level));
  t.distance("without one", depths_at(t, top_of(t, at_level.GetGPUVirtualAddress()), {0, 10}),
             {5, -1});
  const Serialized empty(t, level_of(t, {}));
  t.equal("blocks of an empty one", empty.info[1], uint64_t{1});
  t.equal("its clusters", empty.pointers().size(), size_t{0});
}

void what_refers_to_it(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const auto clusters =
      build(t, triangles_desc(), std::vector<ClusterArgs>{cluster(t, triangle(5))});
  const Serialized made(t, clusters[0]);
  Serialized level(t, level_of(t, clusters));
  const Buffer at_cluster = made.room(t);
  level.set_pointers({at_cluster.GetGPUVirtualAddress()});
  const Buffer at_level = level.room(t);
  // A partitioned top level that an operation makes meanwhile.
  t.accepted("a bottom level", level.deserialize(t, at_level));
  const Buffer top = ptl::build_new(t, ptl::small_inputs(), {{ptl::write(at_level, 2, 0)}});
  t.accepted("its cluster", made.deserialize(t, at_cluster));
  t.equal("what is hit", ptl::slots_at(t, top, {0}), ptl::Slots{2});
}

void damage(Context& outer) {
  const auto refused = [&](const char* what, size_t at, uint32_t bits) {
    Own own(outer);
    Context& t = own.t;
    const auto clusters =
        build(t, triangles_desc(), std::vector<ClusterArgs>{cluster(t, triangle(5))});
    Serialized level(t, level_of(t, clusters));
    const Buffer dest = level.room(t);
    level.words[at] ^= bits;
    t.refused(what, level.deserialize(t, dest), "KA0789");
  };
  refused("another driver", 0, 1);
  refused("another version", 4, 2);
  refused("another type of block", 14, 3);
  refused("an address in no buffer", 19, 0x40000000);
  refused("a changed type", 22, 1);
  for (const auto mode : {CopyMode::kClone, CopyMode::kCompact}) {
    Own own(outer);
    Context& t = own.t;
    const uint64_t level = level_from(t, {cluster(t, triangle(5))});
    const Buffer dest = t.structure_memory(1 << 12);
    t.refused("a copy of a bottom level", copy_to(t, dest.GetGPUVirtualAddress(), level, mode),
              "KA0796");
  }
}

void templates(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  RtasClusterTemplateTrianglesInputsDesc desc;
  desc.Limits = triangles_desc().Limits;
  RtasBuildClusterTemplatesFromTrianglesArgs args;
  args.TrianglesArgs = cluster(t, triangle(5), 7, 40);
  args.TrianglesArgs.VertexBuffer = 0;
  args.TrianglesArgs.PositionTruncateBitCount = 22;
  // Three of them, so that not all are at multiples of 128.
  const auto made =
      build(t, desc, std::vector<RtasBuildClusterTemplatesFromTrianglesArgs>{args, args, args});
  for (const uint64_t from : made) {
    const Serialized bytes(t, from);
    t.equal("blocks", bytes.info[1], uint64_t{0});
    const Buffer room = t.structure_memory(bytes.header().DeserializedSizeInBytes + 32);
    const uint64_t dest = room.GetGPUVirtualAddress() + kRtasClusterTemplateByteAlignment;
    t.accepted("a template", copy_to(t, dest, t.upload(bytes.words).GetGPUVirtualAddress(),
                                     CopyMode::kDeserialize));
    RtasInstantiateClusterTemplateInputsDesc instantiate;
    instantiate.Limits = desc.Limits;
    RtasInstantiateClusterTemplatesArgs instance;
    instance.ClusterTemplate = dest;
    instance.GeometryIndexOffset = 1;
    instance.VertexBuffer = {t.upload(triangle(5).vertices).GetGPUVirtualAddress(), 0};
    const auto clusters =
        build(t, instantiate, std::vector<RtasInstantiateClusterTemplatesArgs>{instance});
    const auto seen = look(t, top_of(t, level_of(t, clusters)), {0});
    t.equal("its geometry index", seen[0].geometry, 8u);
    t.distance("its instance, truncated", depths_at(t, top_of(t, level_of(t, clusters)), {0}), {4});
  }
  own.noted("all of it", "");
}

void micromaps(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  constexpr uint32_t kLevel = 2;
  const Micromap map = pattern(kLevel, RaytracingOpacityMicromapFormat::kOc1_4State, 3);
  const Buffer array = array_of(t, {map});
  ClusterArgs args = cluster(t, row_of_triangles(1, {}));
  args.OpacityMicromapArray = array.GetGPUVirtualAddress();
  const uint64_t made =
      build(t, triangles_desc(1, Flags::kAllowOmm), std::vector<ClusterArgs>{args})[0];
  Serialized bytes(t, made);
  bytes.has_block(t, SerializedBlockType::kOpacityMicromaps, {array.GetGPUVirtualAddress()});
  // The array comes last.
  const Serialized array_bytes(t, array.GetGPUVirtualAddress());
  const Buffer at_array = array_bytes.room(t);
  bytes.set_pointers({at_array.GetGPUVirtualAddress()});
  const Buffer at_cluster = bytes.room(t);
  t.accepted("a cluster", bytes.deserialize(t, at_cluster));
  RtasClasInputsDesc desc = level_desc(1, 1);
  desc.Flags = Flags::kAllowOmm;
  LevelArgs level;
  level.ClasAddressCount = 1;
  level.ClasAddressArray =
      t.upload(std::vector<uint64_t>{at_cluster.GetGPUVirtualAddress()}).GetGPUVirtualAddress();
  const Buffer top = top_of(t, build(t, desc, std::vector<LevelArgs>{level})[0]);
  t.accepted("its array", array_bytes.deserialize(t, at_array));
  MicromapProgram program(t);
  t.holds("the pattern", program.found_at(top, 0, kLevel, 0) == expected_of(map));
}

// Decodes, and returns the buffer that the addresses in it name.
template <class Desc>
Buffer decode(Context& t, GpuVirtualAddress source, StructureType type, std::vector<Desc>& descs) {
  const uint64_t bytes = info_at(t, source, InfoType::kToolsVisualization)[0];
  const Buffer dest = t.zeros(bytes);
  t.accepted("decoding", copy_to(t, dest.GetGPUVirtualAddress(), source,
                                 CopyMode::kVisualizationDecodeForTools));
  const auto words = t.read(dest);
  ToolsHeader header;
  std::memcpy(static_cast<void*>(&header), words.data(), sizeof(header));
  t.equal("type", static_cast<uint32_t>(header.Type), static_cast<uint32_t>(type));
  descs.resize(header.NumDescs);
  std::memcpy(static_cast<void*>(descs.data()), &words[2], descs.size() * sizeof(Desc));
  return dest;
}

void decoded(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const auto clusters = build(
      t, triangles_desc(),
      std::vector<ClusterArgs>{cluster(t, meadow()[0], 3, 77), cluster(t, triangle(8, 10), 9)});
  const std::vector<float> places = {-6, -4, -2, 0, 2, 4, 6, 10};
  const auto expected = depths_at(t, top_of(t, level_of(t, clusters)), places);
  TrianglesDesc desc = triangles_desc();
  desc.IndexFormat = RtasIndexFormat::kUint8;
  desc.OpacityMicromapIndexFormat = RtasIndexFormat::kUint32;
  std::vector<ClusterArgs> all;
  std::vector<Buffer> keep;
  for (const uint64_t each : clusters) {
    std::vector<ClusterArgs> one;
    keep.push_back(decode(t, each, StructureType::kClusterLevel, one));
    t.equal("descs", one.size(), size_t{1});
    all.push_back(one[0]);
  }
  t.equal("ClusterID", all[0].ClusterID, 77u);
  const auto again = build(t, desc, all);
  t.distance("built again", depths_at(t, top_of(t, level_of(t, again)), places), expected);

  std::vector<LevelArgs> levels;
  const uint64_t level = level_of(t, clusters);
  keep.push_back(decode(t, level, StructureType::kClusteredBottomLevel, levels));
  t.equal("descs of a bottom level", levels.size(), size_t{1});
  t.distance("a bottom level built again",
             depths_at(t, top_of(t, build(t, level_desc(), levels)[0]), places), expected);

  RtasClusterTemplateTrianglesInputsDesc template_desc;
  template_desc.Limits = desc.Limits;
  RtasBuildClusterTemplatesFromTrianglesArgs args;
  args.TrianglesArgs = cluster(t, triangle(5), 7, 40);
  args.TrianglesArgs.VertexBuffer = 0;
  args.InstantiationBoundingBoxLimit =
      t.upload(std::vector<float>{-3, -3, 5, 3, 3, 5}).GetGPUVirtualAddress();
  const uint64_t made =
      build(t, template_desc, std::vector<RtasBuildClusterTemplatesFromTrianglesArgs>{args})[0];
  std::vector<RtasBuildClusterTemplatesFromTrianglesArgs> templates;
  keep.push_back(decode(t, made, StructureType::kClusterTemplate, templates));
  template_desc.IndexFormat = RtasIndexFormat::kUint32;
  own.noted("so far", "");
  const uint64_t copy = build(t, template_desc, templates)[0];
  RtasInstantiateClusterTemplateInputsDesc instantiate;
  instantiate.Limits = desc.Limits;
  RtasInstantiateClusterTemplatesArgs instance;
  instance.ClusterTemplate = copy;
  instance.VertexBuffer = {t.upload(triangle(6).vertices).GetGPUVirtualAddress(), 0};
  const auto instances =
      build(t, instantiate, std::vector<RtasInstantiateClusterTemplatesArgs>{instance});
  own.noted("its box", "outside of the template's InstantiationBoundingBoxLimit");
  const auto seen = look(t, top_of(t, level_of(t, instances)), {0});
  t.equal("a template built again", seen[0].geometry, 7u);
}

// Instances of two bottom levels, in partitions that are moved.
Operations of_partitions(const Buffer& near, const Buffer& far) {
  Operations all;
  all.writes = {ptl::write(near, 1, 0, 0), ptl::write(far, 3, 10, 1),
                ptl::write(near, 4, 20, ptl::kGlobal), ptl::write(near, 6, 30, 2)};
  all.writes[1].InstanceID = 0xDEADBEEF;
  all.writes[3].AccelerationStructure = 0;
  all.writes[3].InstanceFlags = ptl::InstanceFlags::kEnableExplicitAabb;
  all.writes[3].ExplicitAABB = {20, -10, 0, 40, 10, 20};
  all.translations = {ptl::translate(1, 1), ptl::translate(ptl::kGlobal, 0, 0, 2)};
  return all;
}

void partitioned(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const auto inputs = ptl::small_inputs(ptl::TlasFlags::kEnablePartitionTranslation);
  const Buffer near = t.bottom_level({triangle(5)});
  const Buffer far = t.bottom_level({triangle(8)});
  const Buffer top = ptl::build_new(t, inputs, of_partitions(near, far));
  const ptl::Slots expected = {1, 3, 4, -1};
  const std::vector<float> places = {0, 11, 20, 30};
  t.equal("the original", ptl::slots_at(t, top, places), expected);
  Serialized bytes(t, top.GetGPUVirtualAddress());
  const uint64_t a = near.GetGPUVirtualAddress();
  bytes.has_block(t, SerializedBlockType::kBottomLevel,
                  {0, a, 0, far.GetGPUVirtualAddress(), a, 0, 0, 0});

  // It comes first, and its bottom levels after it.
  const Serialized near_bytes(t, a);
  const Serialized far_bytes(t, far.GetGPUVirtualAddress());
  const Buffer at_near = near_bytes.room(t);
  const Buffer at_far = far_bytes.room(t);
  const uint64_t b = at_near.GetGPUVirtualAddress();
  bytes.set_pointers({0, b, 0, at_far.GetGPUVirtualAddress(), b, 0, 0, 0});
  const Buffer copy = bytes.room(t);
  t.accepted("a partitioned top level", bytes.deserialize(t, copy));
  t.accepted("a bottom level", near_bytes.deserialize(t, at_near));
  t.accepted("another", far_bytes.deserialize(t, at_far));
  own.noted("so far", "");
  const auto seen = ptl::look(t, copy, places);
  t.equal("the same", ptl::slots_at(t, copy, places), expected);
  t.equal("InstanceID", seen[1].instance_id, 0xDEADBEEFu);
  t.distance("of a partition that is moved", seen[2].t, 7);

  // The source of what follows, in place and elsewhere: translations and members are there.
  Operations more;
  more.updates = {{6, 0, b}};
  t.accepted("an update", ptl::run(t, inputs, ptl::in_memory(t, more), copy, copy));
  t.equal("in place", ptl::slots_at(t, copy, places), ptl::Slots({1, 3, 4, 6}));
  more = {};
  more.writes = {ptl::write(at_near, 0, 40, 1)};
  const Buffer apart = ptl::build_new(t, inputs, more, copy);
  t.equal("elsewhere", ptl::slots_at(t, apart, {0, 11, 20, 30, 41}), ptl::Slots({1, 3, 4, 6, 0}));
  own.noted("all of it", "");
}

void decoded_partitions(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const auto inputs = ptl::small_inputs(ptl::TlasFlags::kEnablePartitionTranslation);
  const Buffer near = t.bottom_level({triangle(5)});
  const Buffer far = t.bottom_level({triangle(8)});
  const Buffer top = ptl::build_new(t, inputs, of_partitions(near, far));
  std::vector<RtasPartitionedTlasOperation> all;
  const Buffer keep =
      decode(t, top.GetGPUVirtualAddress(), StructureType::kPartitionedTopLevel, all);
  t.equal("operations", all.size(), size_t{2});
  t.equal("writes", all[0].ArgCount, 4u);
  t.equal("translations", all[1].ArgCount, 2u);
  const Buffer again = ptl::memory_of(t, inputs);
  t.accepted("built again", ptl::run(t, inputs, all, again));
  t.equal("the same", ptl::slots_at(t, again, {0, 11, 20, 30}), ptl::Slots({1, 3, 4, -1}));
  t.distance("of a partition that is moved", ptl::look(t, again, {20})[0].t, 7);
  own.noted("all of it", "");
}

void cluster_levels_in_partitions(Context& outer) {
  Own own(outer);
  Context& t = own.t;
  const uint64_t level = level_from(t, {cluster(t, triangle(5), 3)});
  WriteArgs args = ptl::write({}, 2, 0);
  args.AccelerationStructure = level;
  const Buffer top = ptl::build_new(t, ptl::small_inputs(), {{args}});
  const Serialized bytes(t, top.GetGPUVirtualAddress());
  const Buffer copy = bytes.room(t);
  t.accepted("deserialized", bytes.deserialize(t, copy));
  t.equal("what is hit", ptl::slots_at(t, copy, {0}), ptl::Slots{2});
}

}  // namespace

std::vector<RuleTest> copy_tests() {
  return {{"CLS-39", clusters_and_levels},
          {"CLS-39", what_refers_to_it},
          {"CLS-39, IND-24", damage},
          {"CLS-39", templates},
          {"CLS-39", micromaps},
          {"CLS-39", decoded},
          {"PTL-10, PTL-31", partitioned},
          {"PTL-10, PTL-31", decoded_partitions},
          {"PTL-10, CLS-39", cluster_levels_in_partitions}};
}

}  // namespace kaamos::conformance::cls

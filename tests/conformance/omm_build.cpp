// SPDX-License-Identifier: MIT
//
// Opacity micromaps in builds, updates, copies and serialized form.
#include <algorithm>

#include "tests/conformance/omm.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

using MicromapFormat = RaytracingOpacityMicromapFormat;
constexpr auto kTwoStates = MicromapFormat::kOc1_2State;
constexpr auto kFourStates = MicromapFormat::kOc1_4State;
constexpr auto kNonOpaque = RaytracingGeometryFlags::kNone;

std::vector<Micromap> three() {
  return {pattern(0, kTwoStates, 1), pattern(3, kFourStates, 2), pattern(2, kFourStates, 3)};
}

// A bottom level whose triangle k has micromap k of the array.
Buffer linked_to(Context& t, const Buffer& array, uint32_t count,
                 BuildFlags flags = BuildFlags::kNone) {
  LinkedInputs linked(flags);
  linked.add(t, row_of_triangles(count, kNonOpaque), linkage_of(array));
  return build_new(t, linked.inputs);
}

void shows_all(Context& t, const std::string& what, const Buffer& bottom,
               const std::vector<Micromap>& micromaps) {
  for (uint32_t k = 0; k < micromaps.size(); ++k) shows(t, what, bottom, k, micromaps[k]);
}

void arrays_are_built(Context& t) {
  const auto micromaps = three();
  shows_all(t, "packed", linked_to(t, array_of(t, micromaps), 3), micromaps);
  // Micromaps at odd bytes, and descs with padding.
  for (const auto& [bytes, stride] : {std::pair(1u, 8u), std::pair(3u, 12u)}) {
    const MicromapInputs inputs(t, micromaps, bytes, stride);
    shows_all(t, "with gaps", linked_to(t, t.build(inputs.desc()), 3), micromaps);
  }
  // The same desc for all: stride 0.
  MicromapInputs one(t, {micromaps[1]});
  one.histogram[0].Count = 3;
  one.array.PerOmmDescs.StrideInBytes = 0;
  shows_all(t, "one desc", linked_to(t, t.build(one.desc()), 3),
            {micromaps[1], micromaps[1], micromaps[1]});
}

void inputs_are_checked(Context& t) {
  const MicromapInputs inputs(t, three());
  const auto sizes = [&](const auto& change) {
    auto desc = inputs.desc();
    auto array = inputs.array;
    array.pOmmHistogram = inputs.histogram.data();
    desc.pOpacityMicromapArrayDesc = &array;
    change(desc, array);
    return t.device().GetRaytracingAccelerationStructurePrebuildInfo(desc);
  };
  const auto plain = sizes([](auto&, auto&) {});
  t.accepted("an array", plain);
  const auto dummy = sizes([](auto&, auto& array) {
    array.InputBuffer = 0x80;
    array.PerOmmDescs.StartAddress = 0x80;
  });
  t.equal("size with dummy addresses", dummy.value().ResultDataMaxSizeInBytes,
          plain.value().ResultDataMaxSizeInBytes);
  t.refused("no desc", sizes([](auto& desc, auto&) { desc.NumDescs = 0; }), "KA0746");
  t.refused("two descs", sizes([](auto& desc, auto&) { desc.NumDescs = 2; }), "KA0746");
  t.refused("pointers",
            sizes([](auto& desc, auto&) { desc.DescsLayout = ElementsLayout::kArrayOfPointers; }),
            "KA0746");
  for (const auto flags : {BuildFlags::kAllowUpdate, BuildFlags::kPerformUpdate,
                           BuildFlags::kMinimizeMemory, BuildFlags::kAllowDisableOmms}) {
    t.refused("build flag " + std::to_string(static_cast<uint32_t>(flags)),
              sizes([&](auto& desc, auto&) { desc.Flags = flags; }), "KA0746");
  }
  t.accepted("compaction", sizes([](auto& desc, auto&) {
               desc.Flags = BuildFlags::kAllowCompaction | BuildFlags::kPreferFastBuild;
             }));
}

void inputs_may_go(Context& t) {
  const auto micromaps = three();
  const MicromapInputs inputs(t, micromaps);
  const Buffer array = t.build(inputs.desc());
  const Buffer indices = indices_of(t, {2, 1, 0}, Format::kR16Uint, 2);
  LinkedInputs linked;
  linked.add(t, row_of_triangles(3, kNonOpaque), linkage_of(array, indices, Format::kR16Uint, 2));
  const Buffer bottom = build_new(t, linked.inputs);
  overwrite(inputs.bits, std::vector<uint8_t>(inputs.bits.size(), 0xFF));
  overwrite(inputs.descs, std::vector<uint8_t>(inputs.descs.size(), 0xFF));
  overwrite(indices, std::vector<uint8_t>(indices.size(), 0xFF));
  shows_all(t, "inputs overwritten", bottom, {micromaps[2], micromaps[1], micromaps[0]});
}

void indices_and_special_ones(Context& t) {
  const auto micromaps = three();
  const Buffer array = array_of(t, micromaps);
  const auto all = [](uint32_t state) { return Micromap{0, kFourStates, {state}}; };
  for (const auto& [format, stride] :
       {std::pair(Format::kR8Uint, 8u), std::pair(Format::kR16Uint, 2u),
        std::pair(Format::kR32Uint, 12u)}) {
    LinkedInputs linked;
    linked.add(t, row_of_triangles(6, kNonOpaque),
               linkage_of(array, indices_of(t, {-1, 0, -2, 1, -3, -4}, format, stride), format,
                          stride, 1));
    shows_all(t, "format " + std::to_string(static_cast<uint32_t>(format)),
              build_new(t, linked.inputs),
              {all(0), micromaps[1], all(1), micromaps[2], all(2), all(3)});
  }
  LinkedInputs base;
  base.add(t, row_of_triangles(2, kNonOpaque), linkage_of(array, {}, Format::kUnknown, 0, 1));
  shows_all(t, "base without indices", build_new(t, base.inputs), {micromaps[1], micromaps[2]});
  LinkedInputs none;
  none.add(t, row_of_triangles(2, kNonOpaque),
           linkage_of({}, indices_of(t, {-2, -1}, Format::kR8Uint, 1), Format::kR8Uint, 1));
  shows_all(t, "no array", build_new(t, none.inputs), {all(1), all(0)});
}

void indices_that_are_none(Context& t) {
  LinkedInputs linked;
  linked.add(t, row_of_triangles(3, kNonOpaque),
             linkage_of(array_of(t, {pattern(0, kTwoStates, 1)}),
                        indices_of(t, {1, 200, -5}, Format::kR32Uint, 4), Format::kR32Uint, 4));
  const Micromap unknown = {0, kFourStates, {3}};
  shows_all(t, "past the array, and -5", build_new(t, linked.inputs), {unknown, unknown, unknown});
}

void linkage_updates(Context& t) {
  const std::vector<Micromap> first = {pattern(2, kFourStates, 1)};
  const std::vector<Micromap> second = {pattern(2, kFourStates, 9)};
  const Buffer a = array_of(t, first);
  const Buffer b = array_of(t, second);
  for (const bool may : {false, true}) {
    LinkedInputs linked(may ? BuildFlags::kAllowUpdate | BuildFlags::kAllowOmmLinkageUpdate
                            : BuildFlags::kAllowUpdate);
    auto& linkage = linked.add(t, row_of_triangles(1, kNonOpaque), linkage_of(a));
    const Buffer bottom = build_new(t, linked.inputs);
    if (may) linkage = linkage_of(b);
    const Buffer copy = memory_for(t, linked.inputs);
    update(t, linked.inputs, copy, bottom).value();
    shows_all(t, may ? "new linkage, copy" : "old linkage, copy", copy, may ? second : first);
    shows_all(t, "the source of the update", bottom, first);
    update(t, linked.inputs, bottom, bottom).value();
    shows_all(t, may ? "new linkage" : "old linkage", bottom, may ? second : first);
  }
}

void a_linkage_cannot_come_or_go(Context& shared) {
  Context t(shared.target().device_desc(), shared.target());  // the error removes the device
  LinkedInputs linked(BuildFlags::kAllowUpdate | BuildFlags::kAllowOmmLinkageUpdate);
  linked.add(t, row_of_triangles(1, kNonOpaque),
             linkage_of(array_of(t, {pattern(0, kTwoStates, 1)})));
  const Buffer bottom = build_new(t, linked.inputs);
  LinkedInputs plain(linked.inputs.flags);
  plain.add_plain(t, row_of_triangles(1, kNonOpaque));
  shared.refused("an update without linkage", update(t, plain.inputs, bottom, bottom), "KA0793");
}

void arrays_are_replaced(Context& t) {
  const std::vector<Micromap> first = {pattern(3, kFourStates, 1)};
  const std::vector<Micromap> second = {pattern(3, kFourStates, 9)};
  const MicromapInputs before(t, first);
  const MicromapInputs after(t, second);
  const Buffer array = t.build(before.desc());
  LinkedInputs linked(BuildFlags::kAllowUpdate | BuildFlags::kAllowOmmLinkageUpdate);
  linked.add(t, row_of_triangles(1, kNonOpaque), linkage_of(array));
  const Buffer bottom = build_new(t, linked.inputs);
  BuildRaytracingAccelerationStructureDesc again;
  again.Inputs = after.desc();
  again.DestAccelerationStructureData = array.GetGPUVirtualAddress();
  again.ScratchAccelerationStructureData = t.zeros(4096).GetGPUVirtualAddress();
  execute(t, [&](CommandList& list) { list.BuildRaytracingAccelerationStructure(again); }).value();
  update(t, linked.inputs, bottom, bottom).value();
  shows_all(t, "new linkage", bottom, second);
}

void arrays_are_copied(Context& t) {
  const auto micromaps = three();
  const Buffer array = array_of(t, micromaps, BuildFlags::kAllowCompaction);
  const uint64_t compacted = info_of(t, array, InfoType::kCompactedSize)[0];
  t.holds("the compacted size is no larger",
          compacted != 0 && compacted <= info_of(t, array, InfoType::kCurrentSize)[0]);
  const Buffer small = copy_new(t, array, CopyMode::kCompact);
  t.equal("current size of the compacted", info_of(t, small, InfoType::kCurrentSize)[0], compacted);
  shows_all(t, "compacted", linked_to(t, small, 3), micromaps);
  shows_all(t, "cloned", linked_to(t, copy_new(t, array, CopyMode::kClone), 3), micromaps);
  t.equal("pointers", info_of(t, array, InfoType::kSerialization)[1], uint64_t{0});
}

void linked_levels_are_copied(Context& t) {
  const auto micromaps = three();
  const Buffer bottom = linked_to(t, array_of(t, micromaps), 3, BuildFlags::kAllowCompaction);
  shows_all(t, "clone", copy_new(t, bottom, CopyMode::kClone), micromaps);
  shows_all(t, "compacted", copy_new(t, bottom, CopyMode::kCompact), micromaps);
}

void linked_levels_are_serialized(Context& t) {
  const auto micromaps = three();
  const Buffer array = array_of(t, micromaps);
  LinkedInputs linked;
  linked.add(t, row_of_triangles(3, kNonOpaque), linkage_of(array));
  const Buffer bottom = build_new(t, linked.inputs);
  t.equal("blocks", info_of(t, bottom, InfoType::kSerialization)[1], uint64_t{1});
  const Buffer bytes = copy_new(t, bottom, CopyMode::kSerialize);
  auto words = t.read(bytes);
  SerializedRaytracingAccelerationStructureHeader1 header;
  std::memcpy(static_cast<void*>(&header), words.data(), sizeof(header));
  t.equal("size", header.SerializedSizeInBytesIncludingHeader,
          info_of(t, bottom, InfoType::kSerialization)[0]);
  t.equal("blocks in the header", header.NumBlocks, 1u);
  t.equal("postamble", static_cast<uint32_t>(header.HeaderPostambleType), 0xFFFFFFFFu);
  SerializedRaytracingAccelerationStructureBlock block;
  std::memcpy(static_cast<void*>(&block), &words[14], sizeof(block));
  t.equal("type of the block", static_cast<uint32_t>(block.Type), 0u);
  t.equal("addresses", block.NumBlockPointersAfterHeader, uint64_t{1});
  uint64_t address = 0;
  std::memcpy(&address, &words[18], 8);
  t.equal("address", address, array.GetGPUVirtualAddress());

  // The bottom level first, its array second, both at new places.
  const Buffer array_bytes = copy_new(t, array, CopyMode::kSerialize);
  const Buffer new_array = t.structure_memory(info_of(t, array, InfoType::kCurrentSize)[0]);
  address = new_array.GetGPUVirtualAddress();
  std::memcpy(&words[18], &address, 8);
  const Buffer patched = t.upload(words);
  const Buffer again = t.structure_memory(header.DeserializedSizeInBytes);
  copy(t, again, patched, CopyMode::kDeserialize).value();
  copy(t, new_array, array_bytes, CopyMode::kDeserialize).value();
  shows_all(t, "deserialized", again, micromaps);

  const Buffer plain = t.bottom_level({row_of_triangles(1, kNonOpaque)});
  const auto old = t.read(copy_new(t, plain, CopyMode::kSerialize));
  t.equal("postamble of a plain one", old[13], 0u);
}

void decoded_inputs_build_the_same(Context& t) {
  const auto micromaps = three();
  const Buffer array = array_of(t, micromaps);
  const Buffer decoded_array = copy_new(t, array, CopyMode::kVisualizationDecodeForTools);
  const auto words = t.read(decoded_array);
  t.equal("type", words[0], 2u);
  t.equal("descs", words[1], 1u);
  RaytracingOpacityMicromapArrayDesc desc;
  std::memcpy(static_cast<void*>(&desc), &words[2], sizeof(desc));
  t.equal("entries", desc.NumOmmHistogramEntries, 3u);
  const auto at = [](const Buffer& buffer, const auto& in, uint64_t address) {
    return &in[(address - buffer.GetGPUVirtualAddress()) / 4];
  };
  std::vector<RaytracingOpacityMicromapHistogramEntry> histogram(3);
  std::memcpy(static_cast<void*>(histogram.data()),
              at(decoded_array, words, reinterpret_cast<uint64_t>(desc.pOmmHistogram)), 36);
  for (size_t i = 0; i < 3; ++i) {
    t.equal("level", histogram[i].SubdivisionLevel, micromaps[i].level);
    t.equal("format", static_cast<uint32_t>(histogram[i].Format),
            static_cast<uint32_t>(micromaps[i].format));
  }
  const Buffer bottom = linked_to(t, array, 3);
  const Buffer decoded = copy_new(t, bottom, CopyMode::kVisualizationDecodeForTools);
  const auto level = t.read(decoded);
  t.equal("type of the level", level[0], 1u);
  RaytracingGeometryDesc geometry;
  std::memcpy(static_cast<void*>(&geometry), &level[2], sizeof(geometry));
  t.equal("type of the geometry", static_cast<uint32_t>(geometry.Type), 2u);
  RaytracingGeometryOmmLinkageDesc linkage;
  std::memcpy(static_cast<void*>(&linkage),
              at(decoded, level, reinterpret_cast<uint64_t>(geometry.OmmTriangles.pOmmLinkage)),
              sizeof(linkage));
  t.equal("array", linkage.OpacityMicromapArray, array.GetGPUVirtualAddress());
  t.equal("index of triangle 2",
          *(at(decoded, level, linkage.OpacityMicromapIndexBuffer.StartAddress) + 2), 2u);
}

}  // namespace

std::vector<RuleTest> omm_build_tests() {
  return {{"OMM-02, OMM-06, OMM-07", arrays_are_built},
          {"OMM-01, OMM-03, OMM-09", inputs_are_checked},
          {"OMM-12, OMM-21", inputs_may_go},
          {"OMM-15, OMM-18", indices_and_special_ones},
          {"OMM-19, OMM-20", indices_that_are_none},
          {"OMM-22, OMM-23", linkage_updates},
          {"OMM-22", a_linkage_cannot_come_or_go},
          {"OMM-24", arrays_are_replaced},
          {"OMM-10, OMM-11", arrays_are_copied},
          {"OMM-27", linked_levels_are_copied},
          {"OMM-50, OMM-51, OMM-52, OMM-54", linked_levels_are_serialized},
          {"OMM-53", decoded_inputs_build_the_same}};
}

}  // namespace kaamos::conformance

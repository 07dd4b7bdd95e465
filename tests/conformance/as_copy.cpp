// SPDX-License-Identifier: MIT
//
// Acceleration structures: copies in every mode.
#include "tests/conformance/structures.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

constexpr BuildFlags kCompactable = BuildFlags::kAllowCompaction;

void copies_leave_the_source(Context& t) {
  const Buffer bottom = build_new(t, bottom_inputs(t, meadow(), kCompactable));
  const auto expected = picture_of_bottom(t, bottom);
  const auto before = info_of(t, bottom, InfoType::kCurrentSize);
  for (const CopyMode mode : {CopyMode::kClone, CopyMode::kCompact, CopyMode::kSerialize,
                              CopyMode::kVisualizationDecodeForTools}) {
    copy_new(t, bottom, mode);
    same_picture(t, "the source after mode " + std::to_string(static_cast<uint32_t>(mode)),
                 picture_of_bottom(t, bottom), expected);
    t.equal("its size", info_of(t, bottom, InfoType::kCurrentSize), before);
  }
  const Buffer saved = copy_new(t, bottom, CopyMode::kSerialize);
  const auto bytes = t.read(saved);
  copy_new(t, saved, CopyMode::kDeserialize);
  t.holds("serialized bytes after they were read", t.read(saved) == bytes);

  t.refused("a copy onto itself", record(t, [&](CommandList& list) {
              list.CopyRaytracingAccelerationStructure(
                  bottom.GetGPUVirtualAddress(), bottom.GetGPUVirtualAddress(), CopyMode::kClone);
            }));
  for (const CopyMode mode : {CopyMode::kClone, CopyMode::kCompact}) {
    for (const bool after : {true, false}) {
      Context own(t.target());
      const Inputs inputs = bottom_inputs(own, meadow(), kCompactable);
      const uint64_t bytes_each = sizes_of(own, inputs).ResultDataMaxSizeInBytes;
      const Buffer memory = own.structure_memory(4 * bytes_each);
      const GpuVirtualAddress at = memory.GetGPUVirtualAddress() + 256;
      const auto desc = build_desc(own, inputs, at);
      execute(own, [&](CommandList& list) {
        list.BuildRaytracingAccelerationStructure(desc);
      }).value();
      t.refused("a copy that overlaps its source",
                execute(own,
                        [&](CommandList& list) {
                          list.CopyRaytracingAccelerationStructure(after ? at + 256 : at - 256, at,
                                                                   mode);
                        }),
                "KA0796");
    }
  }
  Context own(t.target());
  const Buffer nothing = own.structure_memory(65536);
  t.refused("a copy of nothing", copy(own, own.structure_memory(65536), nothing, CopyMode::kClone),
            "KA0796");
}

// The addresses in a top level's instance descs, as tools see them.
std::vector<uint64_t> instanced_addresses(Context& t, const Buffer& top, size_t count) {
  const auto words = words64(t.read(copy_new(t, top, CopyMode::kVisualizationDecodeForTools)));
  std::vector<uint64_t> out;
  for (size_t i = 0; i < count; ++i) out.push_back(words[1 + 8 * i + 7]);
  return out;
}

void clones(Context& t) {
  const Inputs inputs = bottom_inputs(t, meadow(), BuildFlags::kAllowUpdate);
  const Buffer bottom = build_new(t, inputs);
  const auto expected = picture_of_bottom(t, bottom);
  const Buffer clone = copy_new(t, bottom, CopyMode::kClone);
  t.equal("size of the clone", info_of(t, clone, InfoType::kCurrentSize),
          info_of(t, bottom, InfoType::kCurrentSize));
  build(t, bottom_inputs(t, {triangle(5)}), bottom).value();
  same_picture(t, "the clone after its source was overwritten", picture_of_bottom(t, clone),
               expected);
  t.accepted("an update of the clone",
             update(t, bottom_inputs(t, meadow(1), BuildFlags::kAllowUpdate), clone, clone));
  same_picture(t, "after it", picture_of_bottom(t, clone),
               picture_of_bottom(t, t.bottom_level(meadow(1))));

  const Buffer top = t.top_level({instance(clone), instance(bottom, 20)});
  const auto seen = picture(t, top);
  const Buffer top_clone = copy_new(t, top, CopyMode::kClone);
  t.equal("addresses of bottom levels in the clone", instanced_addresses(t, top_clone, 2),
          {clone.GetGPUVirtualAddress(), bottom.GetGPUVirtualAddress()});
  build(t, top_inputs(t, {}), top).value();
  same_picture(t, "the clone of a top level", picture(t, top_clone), seen);
}

void compaction(Context& t) {
  for (const BuildFlags flags : {kCompactable, kCompactable | BuildFlags::kAllowUpdate}) {
    const Inputs inputs = bottom_inputs(t, meadow(), flags);
    const Buffer bottom = build_new(t, inputs);
    const auto expected = picture_of_bottom(t, bottom);
    const Buffer compact = copy_new(t, bottom, CopyMode::kCompact);
    build(t, bottom_inputs(t, {triangle(5)}), bottom).value();
    same_picture(t, "compacted", picture_of_bottom(t, compact), expected);
    if (!HasAny(flags, BuildFlags::kAllowUpdate)) continue;
    t.accepted("an update of the compacted structure",
               update(t, bottom_inputs(t, meadow(1), flags), compact, compact));
    same_picture(t, "after it", picture_of_bottom(t, compact),
                 picture_of_bottom(t, t.bottom_level(meadow(1))));
  }
  const Buffer top = build_new(
      t,
      top_inputs(t, {instance(t.bottom_level(meadow())), RaytracingInstanceDesc{}}, kCompactable));
  const auto expected = picture(t, top);
  same_picture(t, "a compacted top level", picture(t, copy_new(t, top, CopyMode::kCompact)),
               expected);
  // Our policy for what DXR leaves undefined.
  Context own(t.target());
  const Buffer plain = own.bottom_level(meadow());
  t.refused("without ALLOW_COMPACTION",
            copy(own, own.structure_memory(plain.size()), plain, CopyMode::kCompact), "KA0796");
}

void serialized_form(Context& t) {
  const Inputs bottom_in = bottom_inputs(t, meadow());
  const Buffer bottom = build_new(t, bottom_in);
  const Inputs top_in = top_inputs(t, {instance(bottom), instance(bottom, 9)});
  const Buffer top = build_new(t, top_in);
  // The bottom levels need not exist.
  build(t, bottom_inputs(t, {triangle(5)}), bottom).value();
  const std::pair<Buffer, Inputs> all[] = {{bottom, bottom_inputs(t, {triangle(5)})},
                                           {top, top_in}};
  for (const auto& [structure, inputs] : all) {
    const auto sizes = info_of(t, structure, InfoType::kSerialization);
    // The bytes behind the end stay as they are.
    const Buffer dest = t.zeros(sizes[0] + 64);
    t.accepted("serialize", copy(t, dest, structure, CopyMode::kSerialize));
    const auto words = words64(t.read(dest));
    t.equal("SerializedSizeInBytesIncludingHeader", words[4], sizes[0]);
    t.equal("NumBottomLevelAccelerationStructurePointersAfterHeader", words[6], sizes[1]);
    t.equal("the same", sizes[1], structure == top ? uint64_t{2} : uint64_t{0});
    t.holds("DeserializedSizeInBytes is at most the original size",
            words[5] > 0 && words[5] <= sizes_of(t, inputs).ResultDataMaxSizeInBytes);
    for (size_t i = 0; i < sizes[1]; ++i) {
      t.equal("pointer " + std::to_string(i), words[7 + i], bottom.GetGPUVirtualAddress());
    }
    for (size_t i = 0; i < 8; ++i) {
      t.equal("word " + std::to_string(i) + " behind the end", words[sizes[0] / 8 + i],
              uint64_t{0});
    }
  }
  Context own(t.target());
  const Buffer small = own.bottom_level(meadow());
  t.refused("too small a destination", copy(own, own.zeros(128), small, CopyMode::kSerialize),
            "KA0795");
}

void deserialized_structures(Context& t) {
  const BuildFlags flags = BuildFlags::kAllowUpdate | kCompactable;
  const Buffer bottom = build_new(t, bottom_inputs(t, meadow(), flags));
  const Buffer procedural = build_new(t, bottom_inputs(t, boxes(), flags));
  auto moved = instance(procedural, 1000, 4);
  moved.InstanceID = 77;
  const Inputs top_in = top_inputs(t, {instance(bottom), RaytracingInstanceDesc{}, moved}, flags);
  const Buffer top = build_new(t, top_in);
  const auto expected = picture(t, top);
  // To new addresses, after the old structures have been destroyed.
  std::vector<std::vector<uint64_t>> saved;
  for (const Buffer& each : {bottom, procedural, top}) {
    saved.push_back(words64(t.read(copy_new(t, each, CopyMode::kSerialize))));
    t.holds("DeserializedSizeInBytes is at most the size",
            saved.back()[5] <= info_of(t, each, InfoType::kCurrentSize)[0]);
  }
  for (const Buffer& each : {bottom, procedural}) {
    build(t, bottom_inputs(t, {triangle(1)}), each).value();
  }
  const Buffer new_bottom = copy_new(t, t.upload(saved[0]), CopyMode::kDeserialize);
  const Buffer new_procedural = copy_new(t, t.upload(saved[1]), CopyMode::kDeserialize);
  t.equal("addresses, one for each instance",
          std::vector<uint64_t>(saved[2].begin() + 6, saved[2].begin() + 10),
          {3, bottom.GetGPUVirtualAddress(), 0, procedural.GetGPUVirtualAddress()});
  saved[2][7] = new_bottom.GetGPUVirtualAddress();
  saved[2][9] = new_procedural.GetGPUVirtualAddress();
  const Buffer new_top = copy_new(t, t.upload(saved[2]), CopyMode::kDeserialize);
  same_picture(t, "deserialized", picture(t, new_top), expected);
  meets_boxes(t, "deserialized boxes", t.top_level({instance(new_procedural)}));
  t.accepted("an update of what was deserialized",
             update(t, bottom_inputs(t, meadow(1), flags), new_bottom, new_bottom));
  same_picture(t, "after it", picture_of_bottom(t, new_bottom),
               picture_of_bottom(t, t.bottom_level(meadow(1))));
  copy_new(t, new_procedural, CopyMode::kCompact);
  // And on another device.
  Context other(t.target());
  const Buffer there = copy_new(other, other.upload(saved[0]), CopyMode::kDeserialize);
  same_picture(t, "on another device", picture_of_bottom(other, there),
               picture_of_bottom(t, t.bottom_level(meadow())));
  // Damaged data is refused.
  saved[0][saved[0].size() / 2] ^= 1;
  t.refused("damaged data", copy(other, other.structure_memory(saved[0][5]), other.upload(saved[0]),
                                 CopyMode::kDeserialize));
}

void identifiers_of_drivers(Context& t) {
  using Match = DriverMatchingIdentifierStatus;
  const auto bytes = t.read(copy_new(t, t.bottom_level({triangle(5)}), CopyMode::kSerialize));
  SerializedDataDriverMatchingIdentifier own;
  std::memcpy(static_cast<void*>(&own), bytes.data(), sizeof(own));
  const auto check = [&](const std::string& what,
                         const SerializedDataDriverMatchingIdentifier& identifier, Match expected) {
    const Match found = t.device().CheckDriverMatchingIdentifier(
        SerializedDataType::kRaytracingAccelerationStructure, identifier);
    t.equal(what, static_cast<uint32_t>(found), static_cast<uint32_t>(expected));
  };
  check("its own", own, Match::kCompatibleWithDevice);
  check("nothing", {}, Match::kUnrecognized);
  for (size_t i = 0; i < sizeof(own); ++i) {
    auto changed = own;
    reinterpret_cast<uint8_t*>(&changed)[i] ^= 0x10;
    check("byte " + std::to_string(i) + " changed", changed,
          i < sizeof(Guid) ? Match::kUnrecognized : Match::kIncompatibleVersion);
  }
  const auto other_type =
      t.device().CheckDriverMatchingIdentifier(static_cast<SerializedDataType>(1), own);
  t.equal("another type of data", static_cast<uint32_t>(other_type),
          static_cast<uint32_t>(Match::kUnsupportedType));
}

void copies_touch_no_bottom_level(Context& t) {
  const Inputs inputs = bottom_inputs(t, meadow());
  const Buffer bottom = build_new(t, inputs);
  const Buffer top = build_new(t, top_inputs(t, {instance(bottom)}, kCompactable));
  // Another build overwrites the bottom level, which is rebuilt in its place after the copies.
  build(t, top_inputs(t, {}), bottom).value();
  const Buffer clone = copy_new(t, top, CopyMode::kClone);
  const Buffer compact = copy_new(t, top, CopyMode::kCompact);
  const Buffer saved = copy_new(t, top, CopyMode::kSerialize);
  const Buffer decoded = copy_new(t, top, CopyMode::kVisualizationDecodeForTools);
  t.equal("a top level without instances still stands there", t_of_top(t, bottom), -1.0f);
  t.equal("address in a clone", instanced_addresses(t, clone, 1), {bottom.GetGPUVirtualAddress()});
  t.equal("address in a compacted copy", instanced_addresses(t, compact, 1),
          {bottom.GetGPUVirtualAddress()});
  t.equal("address in a decoded copy", words64(t.read(decoded))[8], bottom.GetGPUVirtualAddress());
  t.equal("address in a serialized copy", words64(t.read(saved))[7], bottom.GetGPUVirtualAddress());
  build(t, inputs, bottom).value();
  same_picture(t, "the clone", picture(t, clone), picture_of_bottom(t, bottom));
}

}  // namespace

std::vector<RuleTest> as_copy_tests() {
  return {{"AS-70", copies_leave_the_source},
          {"AS-71", clones},
          {"AS-72, ERR-14", compaction},
          {"AS-73", serialized_form},
          {"AS-74", deserialized_structures},
          {"AS-75", identifiers_of_drivers},
          {"AS-76", copies_touch_no_bottom_level, "KA0463"}};
}

}  // namespace kaamos::conformance

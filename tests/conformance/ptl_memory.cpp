// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: what operations on partitioned top levels read from GPU memory, and where it lies.
#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include "tests/conformance/ptl.h"
#include "tests/conformance/structures.h"

namespace kaamos::conformance::ptl {

namespace {

void copied_and_read(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  auto inputs = small_inputs();
  const Buffer args = t.upload(std::vector<WriteArgs>{write(bottom, 1, 0)});
  const std::vector<RtasPartitionedTlasOperation> all = {
      {Type::kWriteInstance, 1, {args.GetGPUVirtualAddress(), 0}}};
  const Buffer dest = memory_of(t, inputs);
  t.accepted("a build", execute(t, [&](CommandList& list) {
               add_operation(list, inputs, data_of(t, inputs, all, dest, {}));
               inputs.InstanceCount = 0;
               overwrite(args, std::vector<WriteArgs>{write(bottom, 2, 0)});
             }));
  t.equal("the instance", slots_at(t, dest, {0}), Slots{2});
  t.accepted("no operations",
             record(t, [](CommandList& list) { list.ExecuteIndirectRTASOperations({}); }));
  t.refused("flags",
            record(t,
                   [](CommandList& list) {
                     list.ExecuteIndirectRTASOperations(
                         {}, static_cast<ExecuteIndirectRtasOperationsFlags>(1));
                   }),
            "KA0748");
  CommandList closed = t.device().CreateCommandList().value();
  closed.Close().value();
  closed.ExecuteIndirectRTASOperations({});
  t.holds("a closed list", !closed.GetErrors().empty());
  own.noted("all of it", "");
}

void addresses(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const auto inputs = small_inputs();
  const Buffer dest = t.structure_memory(1 << 16);
  const Buffer plain = t.zeros(1 << 16);
  const auto good = data_of(t, inputs, {}, dest, {});
  t.accepted("as it should be", run(t, inputs, good));
  const auto refused = [&](const char* what, auto change) {
    auto data = good;
    change(data);
    t.refused(what, record(t, [&](CommandList& list) { add_operation(list, inputs, data); }),
              "KA0749");
  };
  refused("dest", [](auto& d) { d.DestAccelerationStructureData += 128; });
  refused("source",
          [](auto& d) { d.SourceAccelerationStructureData = d.DestAccelerationStructureData + 8; });
  refused("scratch", [](auto& d) { d.ScratchAccelerationStructureData += 16; });
  refused("no scratch", [](auto& d) { d.ScratchAccelerationStructureData = 0; });
  refused("no count", [](auto& d) { d.IndirectPartitionedTlasOpCount = 0; });
  refused("count", [](auto& d) { d.IndirectPartitionedTlasOpCount += 2; });
  refused("operations",
          [&](auto& d) { d.IndirectPartitionedTlasOps = plain.GetGPUVirtualAddress() + 4; });
  refused("a plain buffer",
          [&](auto& d) { d.DestAccelerationStructureData = plain.GetGPUVirtualAddress(); });
  refused("a buffer that is too small", [&](auto& d) {
    d.DestAccelerationStructureData = dest.GetGPUVirtualAddress() + 65536 - 256;
  });
  DeviceDesc desc = t.target().device_desc();
  const Device without = CreateDevice(desc).value();
  RtasOperationInputs in;
  in.pPartitionedTLASInputsDesc = &inputs;
  t.equal("size without the option",
          without.GetRTASOperationPrebuildInfo(in).ResultDataMaxSizeInBytes, 0u);
  CommandList list = without.CreateCommandList().value();
  add_operation(list, inputs, good);
  t.refused("an operation without the option", list.Close(), "KA0549");
  desc.IndirectRtasOperations = true;
  desc.ShaderModel = ShaderModel::k6_9;
  t.refused("the option without shader model 6.10", CreateDevice(desc), "KA0914");
}

void order_and_types(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const Buffer other = t.bottom_level({triangle(7)});
  const auto inputs = small_inputs(TlasFlags::kEnablePartitionTranslation);
  const Operations before = {{write(bottom, 0, 0), write(bottom, 1, 10)}};
  std::vector<RtasPartitionedTlasOperation> all = in_memory(
      t, {{write(bottom, 2, 20, 1)}, {{1, 0, other.GetGPUVirtualAddress()}}, {translate(0, 1)}});
  std::vector<int> order = {0, 1, 2};
  do {
    const Buffer top = build_new(t, inputs, before);
    std::vector<RtasPartitionedTlasOperation> ordered;
    for (const int i : order) ordered.push_back(all[i]);
    t.accepted("any order", run(t, inputs, ordered, top, top));
    const auto seen = look(t, top, {1, 11, 20});
    t.distance("translated", seen[0].t, 5);
    t.distance("updated and translated", seen[1].t, 7);
    t.equal("written", seen[2].instance_index, 2u);
  } while (std::next_permutation(order.begin(), order.end()));
  own.noted("orders", "");
  const Buffer top = build_new(t, inputs, before);
  t.accepted("no operation", run(t, inputs, {}, top, top));
  t.equal("as it was", slots_at(t, top, {0, 10}), Slots({0, 1}));
  t.accepted("two of a type",
             run(t, inputs,
                 {operation(t, Type::kWriteInstance, std::vector<WriteArgs>{write(bottom, 4, 30)}),
                  operation(t, Type::kWriteInstance, std::vector<WriteArgs>{write(bottom, 5, 40)})},
                 top, top));
  own.noted("two of a type", "another of type 0");
  t.equal("the last counts", slots_at(t, top, {30, 40}), Slots({-1, 5}));
  t.accepted(
      "an undefined type",
      run(t, inputs, {{static_cast<Type>(7), 1, {top.GetGPUVirtualAddress(), 0}}}, top, top));
  own.noted("an undefined type", "has type 7");
}

void strides(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const auto inputs = small_inputs();
  struct Padded {
    WriteArgs args;
    uint64_t padding = ~uint64_t{0};
  };
  const Buffer padded =
      t.upload(std::vector<Padded>{{write(bottom, 1, 0)}, {write(bottom, 2, 10)}});
  const Buffer top = memory_of(t, inputs);
  const uint64_t address = padded.GetGPUVirtualAddress();
  t.accepted("a stride",
             run(t, inputs, {{Type::kWriteInstance, 2, {address, sizeof(Padded)}}}, top));
  own.noted("a stride", "");
  t.equal("with a stride", slots_at(t, top, {0, 10}), Slots({1, 2}));
  const auto left_out = [&](const char* what, uint32_t count, uint64_t at, uint64_t stride,
                            const char* words) {
    t.accepted(what, run(t, inputs, {{Type::kWriteInstance, count, {at, stride}}}, top, top));
    own.noted(what, words);
    t.equal(what, slots_at(t, top, {0, 10}), Slots({1, 2}));
  };
  left_out("a stride of 108", 2, address, 108, "stride 108");
  left_out("an address that is odd", 1, address + 4, 0, "multiples of 8");
  left_out("more than there are", 1u << 20, address, 0, "1048576 with stride 104");
  left_out("in no buffer", 1, 0x1000, 0, "0 bytes from there on");
  left_out("an address of 0", 3, 0, 0, "0 bytes from there on");
}

void duplicates(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const Buffer other = t.bottom_level({triangle(7)});
  const auto inputs = small_inputs(TlasFlags::kEnablePartitionTranslation);
  const Buffer top = build_new(t, inputs, {{write(bottom, 0, 0), write(bottom, 1, 10)}});
  own.noted("none", "");
  t.accepted(
      "twice written",
      run(t, inputs, in_memory(t, {{write(bottom, 2, 20), write(bottom, 2, 30)}}), top, top));
  own.noted("twice written", "instance 2 is written twice");
  t.equal("the last counts", slots_at(t, top, {20, 30}), Slots({-1, 2}));
  t.accepted(
      "written and updated",
      run(t, inputs, in_memory(t, {{write(bottom, 1, 10)}, {{1, 0, other.GetGPUVirtualAddress()}}}),
          top, top));
  own.noted("written and updated", "written by the same operation");
  t.distance("WRITE counts", look(t, top, {10})[0].t, 5);
  t.accepted(
      "different ones",
      run(t, inputs, in_memory(t, {{write(bottom, 1, 10)}, {{0, 0, other.GetGPUVirtualAddress()}}}),
          top, top));
  own.noted("different ones", "");
  t.distance("updated", look(t, top, {0})[0].t, 7);
  t.accepted("twice translated",
             run(t, inputs, in_memory(t, {{}, {}, {translate(0, 3), translate(0, 1)}}), top, top));
  own.noted("twice translated", "partition 0 is translated twice");
  t.equal("the last counts there, too", slots_at(t, top, {1, 11, 13}), Slots({0, 1, -1}));
}

void sizes(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const auto bytes = [&](RtasPartitionedTlasInputsDesc inputs) {
    return sizes_of(t, inputs).ResultDataMaxSizeInBytes;
  };
  const auto base = small_inputs();
  t.equal("multiple of 256", bytes(base) % 256, 0u);
  using Member = uint32_t RtasPartitionedTlasInputsDesc::*;
  for (const Member member : {&RtasPartitionedTlasInputsDesc::InstanceCount,
                              &RtasPartitionedTlasInputsDesc::MaxInstancePerPartitionCount,
                              &RtasPartitionedTlasInputsDesc::PartitionCount,
                              &RtasPartitionedTlasInputsDesc::MaxInstanceInGlobalPartitionCount}) {
    uint64_t last = bytes(base);
    for (int i = 0; i < 6; ++i) {
      auto larger = base;
      larger.*member <<= i;
      t.holds("a size that grows", bytes(larger) >= last);
      last = bytes(larger);
    }
  }
  t.holds("scratch", sizes_of(t, base).ScratchDataSizeInBytes > 0);
  const auto refused = [&](const char* what, RtasPartitionedTlasInputsDesc inputs) {
    t.equal(what, bytes(inputs), 0u);
    t.refused(what,
              record(t,
                     [&](CommandList& list) {
                       add_operation(list, inputs, data_of(t, base, {}, memory_of(t, base), {}));
                     }),
              "KA0748");
  };
  refused("both hints", small_inputs(TlasFlags::kFastTrace | TlasFlags::kFastBuild));
  refused("undefined flags", small_inputs(static_cast<TlasFlags>(8)));
  auto inputs = base;
  inputs.InstanceCount = (1u << 24) + 1;
  refused("too many instances", inputs);
  inputs = base;
  inputs.PartitionCount = (1u << 24) + 1;
  refused("too many partitions", inputs);
  const Buffer bottom = t.bottom_level({triangle(5)});
  const Buffer top = build_new(t, small_inputs(TlasFlags::kFastBuild), {{write(bottom, 1, 0)}});
  t.accepted("another hint", run(t, small_inputs(TlasFlags::kFastTrace), {}, top, top));
  t.equal("the same hits", slots_at(t, top, {0}), Slots{1});
}

void classic_calls(Context& outer) {
  for (const CopyMode mode : {CopyMode::kClone, CopyMode::kCompact}) {
    Partitioned own(outer);
    Context& t = own.t;
    const Buffer top = build_new(t, small_inputs(), {});
    t.refused("a copy", copy(t, t.structure_memory(1 << 16), top, mode), "KA0796");
  }
  for (const InfoType type : {InfoType::kCompactedSize, InfoType::kCurrentSize}) {
    Partitioned own(outer);
    Context& t = own.t;
    const Buffer top = build_new(t, small_inputs(), {});
    t.refused("its size",
              execute(t,
                      [&](CommandList& list) {
                        const GpuVirtualAddress source = top.GetGPUVirtualAddress();
                        list.EmitRaytracingAccelerationStructurePostbuildInfo(
                            {t.zeros(8).GetGPUVirtualAddress(), type}, std::span(&source, 1));
                      }),
              "KA0796");
  }
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer top = build_new(t, small_inputs(), {});
  t.refused("an update of it", update(t, top_inputs(t, {}, BuildFlags::kAllowUpdate), top, top),
            "KA0793");
}

void ranges(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const auto inputs = small_inputs();
  const Buffer top = build_new(t, inputs, {{write(bottom, 0, 0)}});
  const auto written = [&](const char* what, const WriteArgs& args, const char* words) {
    t.accepted(what, run(t, inputs, in_memory(t, {{args}}), top, top));
    own.noted(what, words);
  };
  written("an index", write(bottom, 8, 10), "InstanceIndex is 8");
  written("a partition", write(bottom, 1, 10, 4), "PartitionIndex is 4");
  auto args = write(bottom, 2, 10);
  args.InstanceMask = 0x101;
  written("a mask", args, "InstanceMask is 257");
  args = write(bottom, 3, 20);
  args.InstanceContributionToHitGroupIndex = 0x1000001;
  written("a contribution", args, "is 16777217");
  const auto seen = look(t, top, {0, 10, 20});
  t.equal("the first", seen[0].instance_index, 0u);
  t.equal("the low bits of the mask", seen[1].instance_index, 2u);
  t.equal("the low bits of the contribution", seen[2].record, 1u);
  Standard program(t);
  program.records("Plain", 1);
  program.scene = top;
  Ray ray = ray_at(10);
  ray.mask = 2;
  t.equal("another mask", program.trace(ray).end, uint32_t{kMissRan});
}

// Numbers that are mostly near what means something.
class Words {
 public:
  uint32_t next() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    const auto word = static_cast<uint32_t>(state_ >> 32);
    switch (word & 7) {
      case 0:
        return word;
      case 1:
        return 0;
      case 2:
        return 0xFFFFFFFF;
      case 3:
        return std::bit_cast<uint32_t>(static_cast<float>(word >> 24) - 128);
      default:
        return word >> 4 & 15;
    }
  }

 private:
  uint64_t state_ = 1;
};

// Whatever stands in GPU memory, nothing outside of buffers is read, and the device goes on.
void random_arguments(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const auto inputs = small_inputs(TlasFlags::kEnablePartitionTranslation);
  const Buffer top = build_new(t, inputs, {});
  constexpr uint32_t kWords = 256, kRuns = 500;
  const Buffer memory = t.upload(std::vector<uint32_t>(kWords));
  auto data = data_of(t, inputs, {}, top, top);
  data.IndirectPartitionedTlasOpCount = memory.GetGPUVirtualAddress();
  data.IndirectPartitionedTlasOps = memory.GetGPUVirtualAddress() + 8;
  Words words;
  for (uint32_t i = 0; i < kRuns; ++i) {
    std::vector<uint32_t> all(kWords);
    for (uint32_t& word : all) word = words.next();
    all[0] &= 3;
    for (uint32_t operation = 0; operation < 3; ++operation) {
      uint32_t* at = &all[2 + 6 * operation];
      at[0] = words.next() & 3;
      if ((words.next() & 3) == 0) continue;  // an address of no meaning
      const uint64_t address = memory.GetGPUVirtualAddress() + 80 + 8 * (words.next() & 15);
      at[1] &= 15;
      std::memcpy(at + 2, &address, 8);
      at[4] = 8 * (at[4] & 31);
      at[5] = 0;
    }
    // Some arguments name the bottom level.
    const uint64_t address = bottom.GetGPUVirtualAddress();
    for (uint32_t word = 20; word + 2 < kWords; word += 2) {
      if ((words.next() & 7) == 0) std::memcpy(&all[word], &address, 8);
    }
    overwrite(memory, all);
    t.accepted("run " + std::to_string(i), run(t, inputs, data));
  }
  t.holds("notes", !own.notes->empty());
  own.notes->clear();
  t.accepted("a good one",
             run(t, inputs, in_memory(t, {{write(bottom, 1, 0)}, {}, {translate(0, 0)}}),
                 memory_of(t, inputs)));
  own.noted("a good one", "");
  look(t, top, {0, 1, 2});
}

}  // namespace

std::vector<RuleTest> memory_tests() {
  return {{"IND-01, IND-05, IND-06", copied_and_read},
          {"PTL-01", addresses},
          {"PTL-05", order_and_types},
          {"PTL-06", strides},
          {"PTL-07", duplicates},
          {"PTL-08, PTL-09", sizes},
          {"PTL-10", classic_calls},
          {"PTL-12", ranges},
          {"PTL-12", random_arguments}};
}

}  // namespace kaamos::conformance::ptl

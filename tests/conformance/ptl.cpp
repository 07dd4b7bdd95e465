// SPDX-License-Identifier: MIT
//
// EXPERIMENTAL: partitioned top levels.
#include <shaders/values.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <string>
#include <utility>

#include "tests/conformance/rq.h"
#include "tests/conformance/structures.h"

namespace kaamos::conformance {

using namespace rtapi;

namespace {

using WriteArgs = RtasPartitionedTlasWriteInstanceArgs;
using UpdateArgs = RtasPartitionedTlasUpdateInstanceArgs;
using TranslateArgs = RtasPartitionedTlasTranslatePartitionArgs;
using Type = RtasPartitionedTlasOperationType;
using TlasFlags = RtasPartitionedTlasFlags;
using InstanceFlags = RtasPartitionedTlasInstanceFlags;

constexpr uint32_t kGlobal = kRtasPartitionIndexGlobalPartition;

// A context with a device that has these operations, and what it said of them.
struct Partitioned {
  explicit Partitioned(Context& outer) : Partitioned(outer, outer.target().device_desc()) {}
  Partitioned(Context& outer, DeviceDesc desc)
      : t(with_operations(std::move(desc), notes), outer.target()), outer_(outer) {}
  ~Partitioned() {
    for (const std::string& failure : t.failures()) outer_.fail(failure);
  }
  Partitioned(const Partitioned&) = delete;
  Partitioned& operator=(const Partitioned&) = delete;

  // Expects that there was one note since the last call, with these words; "": that there was none.
  void noted(const std::string& what, const std::string& words) {
    const std::vector<std::string> all = std::exchange(*notes, {});
    const bool as_expected =
        words.empty() ? all.empty() : all.size() == 1 && all[0].find(words) != std::string::npos;
    if (as_expected) return;
    std::string text;
    for (const auto& one : all) text += one + "; ";
    t.fail(what + ": expected a note with \"" + words + "\", there were: " + text);
  }

  std::shared_ptr<std::vector<std::string>> notes = std::make_shared<std::vector<std::string>>();
  Context t;

 private:
  static DeviceDesc with_operations(DeviceDesc desc,
                                    std::shared_ptr<std::vector<std::string>> notes) {
    desc.IndirectRtasOperations = true;
    desc.OnMessage = [notes = std::move(notes)](const Message& message) {
      const bool about = message.Text.starts_with("KA0788") || message.Text.starts_with("KA0797");
      if (about) notes->push_back(message.Text);
    };
    return desc;
  }
  Context& outer_;
};

struct Operations {
  std::vector<WriteArgs> writes = {};
  std::vector<UpdateArgs> updates = {};
  std::vector<TranslateArgs> translations = {};
};

template <class Args>
RtasPartitionedTlasOperation operation(Context& t, Type type, const std::vector<Args>& args) {
  return {type,
          static_cast<uint32_t>(args.size()),
          {args.empty() ? 0 : t.upload(args).GetGPUVirtualAddress(), 0}};
}

std::vector<RtasPartitionedTlasOperation> in_memory(Context& t, const Operations& all) {
  std::vector<RtasPartitionedTlasOperation> out;
  if (!all.writes.empty()) out.push_back(operation(t, Type::kWriteInstance, all.writes));
  if (!all.updates.empty()) out.push_back(operation(t, Type::kUpdateInstance, all.updates));
  if (!all.translations.empty()) {
    out.push_back(operation(t, Type::kTranslatePartition, all.translations));
  }
  return out;
}

RtasOperationPrebuildInfo sizes_of(Context& t, const RtasPartitionedTlasInputsDesc& inputs) {
  RtasOperationInputs in;
  in.pPartitionedTLASInputsDesc = &inputs;
  return t.device().GetRTASOperationPrebuildInfo(in);
}

// Eight slots in four partitions.
RtasPartitionedTlasInputsDesc small_inputs(TlasFlags flags = TlasFlags::kNone) {
  return {flags, 8, 8, 4, 8};
}

RtasPartitionedTlasOperationData data_of(Context& t, const RtasPartitionedTlasInputsDesc& inputs,
                                         const std::vector<RtasPartitionedTlasOperation>& all,
                                         const Buffer& dest, const Buffer& source) {
  RtasPartitionedTlasOperationData data;
  data.SourceAccelerationStructureData = source ? source.GetGPUVirtualAddress() : 0;
  data.DestAccelerationStructureData = dest.GetGPUVirtualAddress();
  data.ScratchAccelerationStructureData =
      t.zeros(sizes_of(t, inputs).ScratchDataSizeInBytes).GetGPUVirtualAddress();
  data.IndirectPartitionedTlasOpCount =
      t.upload(std::vector<uint32_t>{static_cast<uint32_t>(all.size())}).GetGPUVirtualAddress();
  if (!all.empty()) data.IndirectPartitionedTlasOps = t.upload(all).GetGPUVirtualAddress();
  return data;
}

void add_operation(CommandList& list, const RtasPartitionedTlasInputsDesc& inputs,
                   const RtasPartitionedTlasOperationData& data) {
  RtasOperationInputs in;
  in.pPartitionedTLASInputsDesc = &inputs;
  RtasOperationDesc desc;
  desc.pInputs = &in;
  desc.pPartitionedTlasOperationData = &data;
  list.ExecuteIndirectRTASOperations(std::span(&desc, 1));
}

Status run(Context& t, const RtasPartitionedTlasInputsDesc& inputs,
           const RtasPartitionedTlasOperationData& data) {
  return execute(t, [&](CommandList& list) { add_operation(list, inputs, data); });
}

Status run(Context& t, const RtasPartitionedTlasInputsDesc& inputs,
           const std::vector<RtasPartitionedTlasOperation>& all, const Buffer& dest,
           const Buffer& source = {}) {
  return run(t, inputs, data_of(t, inputs, all, dest, source));
}

Buffer memory_of(Context& t, const RtasPartitionedTlasInputsDesc& inputs) {
  return t.structure_memory(sizes_of(t, inputs).ResultDataMaxSizeInBytes);
}

Buffer build_new(Context& t, const RtasPartitionedTlasInputsDesc& inputs, const Operations& all,
                 const Buffer& source = {}) {
  const Buffer dest = memory_of(t, inputs);
  t.accepted("a build", run(t, inputs, in_memory(t, all), dest, source));
  return dest;
}

WriteArgs write(const Buffer& bottom, uint32_t index, float x, uint32_t partition = 0) {
  WriteArgs args;
  args.Transform[0][3] = x;
  args.InstanceID = 100 + index;
  args.AccelerationStructure = bottom ? bottom.GetGPUVirtualAddress() : 0;
  args.InstanceIndex = index;
  args.PartitionIndex = partition;
  return args;
}

TranslateArgs translate(uint32_t partition, float x, float y = 0, float z = 0) {
  return {partition, {x, y, z}};
}

std::vector<Seen> look(Context& t, const Buffer& top, const std::vector<float>& places) {
  Standard program(t);
  program.records("Plain", 4);
  program.scene = top;
  std::vector<Ray> list;
  for (const float x : places) list.push_back(ray_at(x));
  return program.trace(list);
}

// Which slot each ray along z hits; -1: a miss.
std::vector<int> slots_at(Context& t, const Buffer& top, const std::vector<float>& places) {
  std::vector<int> out;
  for (const Seen& seen : look(t, top, places)) {
    out.push_back(seen.end == kClosestHitRan ? static_cast<int>(seen.instance_index) : -1);
  }
  return out;
}

using Slots = std::vector<int>;

// ObjectToWorld3x4()[0][3] of what a ray along z hits.
float world_x(Context& t, const Buffer& top, float x) {
  Standard program(t, kaamos_shaders_values(), {"ClosestRay"});
  program.group("Ray", "ClosestRay");
  program.hit("Ray");
  program.scene = top;
  program.prepare({ray_at(x)});
  constexpr uint32_t kRows = 24000 + 24;  // kObjectWords of values.hlsl
  return std::bit_cast<float>(program.run()[kRows / 4 + 3]);
}

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

void sources(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const auto inputs = small_inputs();
  const Buffer a = build_new(
      t, inputs, {{write(bottom, 1, 0), write(bottom, 3, 10, 1), write(bottom, 6, 20, kGlobal)}});
  const std::vector<float> places = {0, 10, 20, 30, 40};
  t.equal("three of eight", slots_at(t, a, places), Slots({1, 3, 6, -1, -1}));
  const Buffer b = build_new(t, inputs, {{write(bottom, 0, 30)}}, a);
  const Buffer c = build_new(t, inputs, {{write(bottom, 1, 40)}}, a);
  t.equal("a", slots_at(t, a, places), Slots({1, 3, 6, -1, -1}));
  t.equal("b", slots_at(t, b, places), Slots({1, 3, 6, 0, -1}));
  t.equal("c", slots_at(t, c, places), Slots({-1, 3, 6, -1, 1}));
  t.accepted("in place", run(t, inputs, in_memory(t, {{write(bottom, 3, 30)}}), a, a));
  t.equal("a, changed", slots_at(t, a, places), Slots({1, -1, 6, 3, -1}));
  t.equal("b, as it was", slots_at(t, b, places), Slots({1, 3, 6, 0, -1}));
  own.noted("all of it", "");
  t.accepted("no partitioned top level as the source",
             run(t, inputs, {}, b, t.top_level({conformance::instance(bottom)})));
  own.noted("no partitioned top level as the source", "there is no partitioned top level");
  t.equal("b, still as it was", slots_at(t, b, places), Slots({1, 3, 6, 0, -1}));
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

void whole_records(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const Buffer other = t.bottom_level({triangle(7)});
  auto one = write(bottom, 5, 0);
  one.InstanceID = 0xDEADBEEF;
  one.InstanceContributionToHitGroupIndex = 2;
  const auto inputs = small_inputs();
  const Buffer top = build_new(t, inputs, {{one, write(bottom, 2, 10)}});
  auto seen = look(t, top, {0, 10});
  t.equal("InstanceID", seen[0].instance_id, 0xDEADBEEFu);
  t.equal("InstanceIndex", seen[0].instance_index, 5u);
  t.equal("record", seen[0].record, 2u);
  t.equal("InstanceIndex of the other", seen[1].instance_index, 2u);
  const Asked asked = ask(t, top, ray_at(0));
  t.equal("InstanceID of a query", asked.instance_id, 0xDEADBEEFu);
  t.accepted("an update",
             run(t, inputs, in_memory(t, {{}, {{5, 3, other.GetGPUVirtualAddress()}}}), top, top));
  seen = look(t, top, {0});
  t.equal("InstanceID after it", seen[0].instance_id, 0xDEADBEEFu);
  t.equal("record after it", seen[0].record, 3u);
  t.distance("bottom level after it", seen[0].t, 7);
  t.accepted("a write", run(t, inputs, in_memory(t, {{write(bottom, 5, 0, 3)}}), top, top));
  seen = look(t, top, {0});
  t.equal("InstanceID, written anew", seen[0].instance_id, 105u);
  t.equal("record, written anew", seen[0].record, 0u);
  own.noted("all of it", "");
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

void instance_flags(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5, 0, RaytracingGeometryFlags::kNone)});
  for (uint32_t flags = 0; flags < 16; ++flags) {
    if ((flags & 12) == 12) continue;  // exclude each other
    auto args = write(bottom, 0, 0);
    args.InstanceFlags = static_cast<InstanceFlags>(flags);
    const Buffer partitioned = build_new(t, small_inputs(), {{args}});
    const Buffer classic = t.top_level({conformance::instance(bottom, 0, 0, flags)});
    for (const uint32_t ray_flags : {0x0u, 0x1u, 0x2u, 0x10u, 0x20u, 0x40u, 0x80u}) {
      Ray ray = ray_at(0);
      ray.flags = ray_flags;
      const auto trace = [&](const Buffer& top) {
        Standard program(t);
        program.records("Counted", 1);
        program.scene = top;
        return program.trace(ray);
      };
      const Seen a = trace(partitioned), b = trace(classic);
      const std::string what =
          "instance flags " + std::to_string(flags) + ", ray flags " + std::to_string(ray_flags);
      t.equal(what + ", end", a.end, b.end);
      t.equal(what + ", any-hit shaders", a.any_hits, b.any_hits);
      t.equal(what + ", HitKind", a.hit_kind, b.hit_kind);
    }
  }
}

void inactive(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  std::vector<WriteArgs> all;
  for (uint32_t i = 0; i < 6; ++i) all.push_back(write(bottom, i, 10.f * static_cast<float>(i)));
  all[1].InstanceMask = 0;
  all[2].AccelerationStructure = 0;
  all[3].Transform[1][3] = std::numeric_limits<float>::quiet_NaN();
  for (auto& row : all[4].Transform) row[0] = row[1] = row[2] = 0;
  // Those that are degenerate do not count for the limit.
  auto inputs = small_inputs();
  inputs.MaxInstancePerPartitionCount = 4;
  const Buffer top = build_new(t, inputs, {all});
  own.noted("four of six", "");
  t.equal("what is hit", slots_at(t, top, {0, 10, 20, 30, 40, 50}), Slots({0, -1, -1, -1, -1, 5}));
  inputs.MaxInstancePerPartitionCount = 3;
  build_new(t, inputs, {all});
  own.noted("a limit", "partition 0 has 4 instances");
  inputs = small_inputs();
  inputs.MaxInstanceInGlobalPartitionCount = 0;
  build_new(t, inputs, {{write(bottom, 0, 0, kGlobal)}});
  own.noted("the global partition's", "the global partition has 1 instances");
}

void full_partitions(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  auto inputs = small_inputs();
  inputs.MaxInstancePerPartitionCount = 1;
  const Buffer top = build_new(t, inputs, {{write(bottom, 0, 0, 0), write(bottom, 1, 10, 1)}});
  t.accepted(
      "they change places",
      run(t, inputs, in_memory(t, {{write(bottom, 0, 0, 1), write(bottom, 1, 10, 0)}}), top, top));
  own.noted("only the end counts", "");
  t.equal("what is hit", slots_at(t, top, {0, 10}), Slots({0, 1}));
}

void explicit_boxes(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  auto args = write({}, 0, 0);
  args.InstanceFlags = InstanceFlags::kEnableExplicitAabb;
  args.ExplicitAABB = {-4, -4, 4, 4, 4, 6};
  const auto inputs = small_inputs();
  const Buffer top = build_new(t, inputs, {{args}});
  t.equal("disabled", slots_at(t, top, {0}), Slots{-1});
  const UpdateArgs enable = {0, 0, bottom.GetGPUVirtualAddress()};
  t.accepted("enabled", run(t, inputs, in_memory(t, {{}, {enable}}), top, top));
  own.noted("enabled", "");
  t.equal("enabled", slots_at(t, top, {0}), Slots{0});
  args.ExplicitAABB.MaxZ = 4.5f;
  args.AccelerationStructure = enable.AccelerationStructure;
  t.accepted("a small box", run(t, inputs, in_memory(t, {{args}}), top, top));
  own.noted("a small box", t.target().checked ? "outside of its ExplicitAABB" : "");
}

void updates(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const auto inputs = small_inputs();
  const Buffer top = build_new(t, inputs, {{write({}, 0, 0), write(bottom, 1, 10)}});
  const auto left_out = [&](const char* what, const UpdateArgs& args, const char* words) {
    t.accepted(what, run(t, inputs, in_memory(t, {{}, {args}}), top, top));
    own.noted(what, words);
    t.equal(what, slots_at(t, top, {0, 10, 20}), Slots({-1, 1, -1}));
  };
  const uint64_t address = bottom.GetGPUVirtualAddress();
  left_out("without bottom level or box", {0, 0, address}, "without a bottom level");
  left_out("never written", {2, 0, address}, "was never written");
  left_out("no bottom level", {1, 0, 0}, "AccelerationStructure is 0");
  left_out("no such instance", {9, 0, address}, "InstanceIndex is 9");
  t.accepted("no structure there",
             run(t, inputs, in_memory(t, {{}, {{1, 0, top.GetGPUVirtualAddress()}}}), top, top));
  own.noted("no structure there", "there is no bottom level at its address");
  t.equal("no structure there", slots_at(t, top, {10}), Slots{-1});
}

void translations(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const auto inputs = small_inputs(TlasFlags::kEnablePartitionTranslation);
  const Buffer top =
      build_new(t, inputs,
                {{write(bottom, 0, 0), write(bottom, 1, 10, 1), write(bottom, 2, 20, kGlobal)},
                 {},
                 {translate(0, 1), translate(kGlobal, 0, 0, 3)}});
  t.equal("once", slots_at(t, top, {1, 10, 20}), Slots({0, 1, 2}));
  t.distance("the global one", look(t, top, {20})[0].t, 8);
  t.accepted("again", run(t, inputs, in_memory(t, {{}, {}, {translate(0, 1)}}), top, top));
  t.equal("it replaces", slots_at(t, top, {1, 3, 10}), Slots({0, -1, 1}));
  t.accepted("a later write", run(t, inputs, in_memory(t, {{write(bottom, 3, 30)}}), top, top));
  t.equal("it persists", slots_at(t, top, {31, 29.2f}), Slots({3, -1}));
  t.equal("ObjectToWorld", world_x(t, top, 31), 31.f);
  // 2^24 + 1 is halfway between two floats, and the even one is 2^24.
  t.accepted("far away",
             run(t, inputs, in_memory(t, {{write(bottom, 4, 16777216)}, {}, {translate(0, 1)}}),
                 top, top));
  t.equal("to the nearest even", world_x(t, top, 16777216), 16777216.f);
  own.noted("all of it", "");
  const auto without = small_inputs();
  t.accepted("without the flag", run(t, without, {}, top, top));
  t.equal("dropped", slots_at(t, top, {0, 10}), Slots({0, 1}));
  t.accepted("TRANSLATE without the flag",
             run(t, without, in_memory(t, {{}, {}, {translate(0, 1)}}), top, top));
  own.noted("TRANSLATE without the flag", "needs kEnablePartitionTranslation");
  t.accepted("with it again", run(t, inputs, {}, top, top));
  t.equal("zero again", slots_at(t, top, {0, 10}), Slots({0, 1}));
  t.accepted("no such partition",
             run(t, inputs, in_memory(t, {{}, {}, {translate(4, 1)}}), top, top));
  own.noted("no such partition", "PartitionIndex is 4");
}

void resizes(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level({triangle(5)});
  auto inputs = small_inputs();
  inputs.InstanceCount = 4;
  const Buffer four = build_new(t, inputs, {{write(bottom, 0, 0), write(bottom, 3, 10, 3)}});
  inputs.InstanceCount = 8;
  const Buffer eight = build_new(t, inputs, {{write(bottom, 7, 20)}}, four);
  t.equal("8", slots_at(t, eight, {0, 10, 20}), Slots({0, 3, 7}));
  inputs.InstanceCount = 2;
  const Buffer two = build_new(t, inputs, {}, eight);
  t.equal("2", slots_at(t, two, {0, 10, 20}), Slots({0, -1, -1}));
  own.noted("counts of instances", "");
  inputs.InstanceCount = 8;
  inputs.PartitionCount = 3;
  const Buffer fewer = build_new(t, inputs, {}, eight);
  own.noted("a partition goes", "instance 3 is in partition 3");
  t.equal("its member is disabled", slots_at(t, fewer, {0, 10, 20}), Slots({0, -1, 7}));
  build_new(t, inputs, {{write(bottom, 3, 10, 2)}}, eight);
  own.noted("its member is written", "");
}

void empty_ones(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  t.equal("nothing written", slots_at(t, build_new(t, small_inputs(), {}), {0}), Slots{-1});
  t.equal("no instances", slots_at(t, build_new(t, {TlasFlags::kNone, 0, 0, 4, 0}, {}), {0}),
          Slots{-1});
  const Buffer bottom = t.bottom_level({triangle(5)});
  const Buffer global =
      build_new(t, {TlasFlags::kNone, 2, 0, 0, 2}, {{write(bottom, 1, 0, kGlobal)}});
  t.equal("no partitions", slots_at(t, global, {0}), Slots{1});
  own.noted("all of it", "");
}

// The same picture, also through hit objects.
void as_a_top_level(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  const Buffer bottom = t.bottom_level(meadow());
  const auto both = [&] {
    const Buffer partitioned = build_new(t, small_inputs(), {{write(bottom, 0, 0, 2)}});
    RaytracingInstanceDesc same = conformance::instance(bottom);
    same.InstanceID = 100;
    same_picture(t, "the meadow", picture(t, partitioned), picture(t, t.top_level({same})));
  };
  both();
  if (t.target().tier < RaytracingTier::kTier1_2) return;
  t.trace_through_hit_objects(true);
  both();
}

void many(Context& outer) {
  Partitioned own(outer);
  Context& t = own.t;
  constexpr uint32_t kCount = 100'000, kPartitions = 300;
  const Buffer bottom = t.bottom_level({triangle(5)});
  const RtasPartitionedTlasInputsDesc inputs = {TlasFlags::kNone, kCount, 400, kPartitions, 0};
  std::vector<WriteArgs> all;
  for (uint32_t i = 0; i < kCount; ++i) {
    all.push_back(write(bottom, i, 3.f * static_cast<float>(i), i % kPartitions));
  }
  const Buffer top = build_new(t, inputs, {all});
  t.accepted("one more write", run(t, inputs, in_memory(t, {{write(bottom, 7, -10)}}), top, top));
  own.noted("all of it", "");
  t.equal("what is hit", slots_at(t, top, {0, 21, -10, 3.f * 54321, 3.f * 99999}),
          Slots({0, -1, 7, 54321, 99999}));
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

std::vector<RuleTest> ptl_tests() {
  return {{"IND-01, IND-05", copied_and_read},
          {"PTL-01", addresses},
          {"PTL-02, PTL-03", sources},
          {"PTL-05", order_and_types},
          {"PTL-06", strides},
          {"PTL-07", duplicates},
          {"PTL-08, PTL-09", sizes},
          {"PTL-10", classic_calls},
          {"PTL-11, PTL-18, PTL-20", whole_records},
          {"PTL-12", ranges},
          {"PTL-12", random_arguments},
          {"PTL-13", instance_flags},
          {"PTL-14, PTL-15", inactive},
          {"PTL-15", full_partitions},
          {"PTL-16", explicit_boxes},
          {"PTL-17", updates},
          {"PTL-21, PTL-22, PTL-23, PTL-24", translations},
          {"PTL-25", resizes},
          {"PTL-28", as_a_top_level},
          {"PTL-30", empty_ones},
          {"PTL-32", many}};
}

}  // namespace kaamos::conformance

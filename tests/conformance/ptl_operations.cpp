// SPDX-License-Identifier: MIT
#include "tests/conformance/ptl.h"

#include <utility>

#include "tests/conformance/structures.h"

namespace kaamos::conformance::ptl {

namespace {

DeviceDesc with_operations(DeviceDesc desc, std::shared_ptr<std::vector<std::string>> notes) {
  desc.IndirectRtasOperations = true;
  desc.OnMessage = [notes = std::move(notes)](const Message& message) {
    const bool about = message.Text.starts_with("KA0788") || message.Text.starts_with("KA0797");
    if (about) notes->push_back(message.Text);
  };
  return desc;
}

}  // namespace

Partitioned::Partitioned(Context& outer)
    : t(with_operations(outer.target().device_desc(), notes), outer.target()), outer_(outer) {}

Partitioned::~Partitioned() {
  for (const std::string& failure : t.failures()) outer_.fail(failure);
}

void Partitioned::noted(const std::string& what, const std::string& words) {
  const std::vector<std::string> all = std::exchange(*notes, {});
  const bool as_expected =
      words.empty() ? all.empty() : all.size() == 1 && all[0].find(words) != std::string::npos;
  if (as_expected) return;
  std::string text;
  for (const auto& one : all) text += one + "; ";
  t.fail(what + ": expected a note with \"" + words + "\", there were: " + text);
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

RtasPartitionedTlasInputsDesc small_inputs(TlasFlags flags) {
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
           const Buffer& source) {
  return run(t, inputs, data_of(t, inputs, all, dest, source));
}

Buffer memory_of(Context& t, const RtasPartitionedTlasInputsDesc& inputs) {
  return t.structure_memory(sizes_of(t, inputs).ResultDataMaxSizeInBytes);
}

Buffer build_new(Context& t, const RtasPartitionedTlasInputsDesc& inputs, const Operations& all,
                 const Buffer& source) {
  const Buffer dest = memory_of(t, inputs);
  t.accepted("a build", run(t, inputs, in_memory(t, all), dest, source));
  return dest;
}

WriteArgs write(const Buffer& bottom, uint32_t index, float x, uint32_t partition) {
  WriteArgs args;
  args.Transform[0][3] = x;
  args.InstanceID = 100 + index;
  args.AccelerationStructure = bottom ? bottom.GetGPUVirtualAddress() : 0;
  args.InstanceIndex = index;
  args.PartitionIndex = partition;
  return args;
}

TranslateArgs translate(uint32_t partition, float x, float y, float z) {
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

Slots slots_at(Context& t, const Buffer& top, const std::vector<float>& places) {
  Slots out;
  for (const Seen& seen : look(t, top, places)) {
    out.push_back(seen.end == kClosestHitRan ? static_cast<int>(seen.instance_index) : -1);
  }
  return out;
}

}  // namespace kaamos::conformance::ptl

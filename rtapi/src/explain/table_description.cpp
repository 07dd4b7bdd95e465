// SPDX-License-Identifier: MIT
#include <rtapi/table_description.h>

#include <algorithm>
#include <cstring>

#include "rtapi/src/explain/address_text.h"
#include "rtapi/src/pipelines/root_signature_impl.h"
#include "rtapi/src/pipelines/state_object_impl.h"
#include "runtime/structures/partitioned_instances.h"
#include "runtime/structures/structure_map.h"

namespace rtapi {

using namespace detail;

namespace {

using runtime::LinkedRecord;
using runtime::LinkedShader;
using runtime::RecordKind;

constexpr uint64_t kIdentifierBytes = kShaderIdentifierSizeInBytes;

struct TableKind {
  const char* name;
  RecordKind kind;
};
constexpr TableKind kRayGeneration = {"ray generation", RecordKind::kRayGeneration};
constexpr TableKind kMiss = {"miss", RecordKind::kMiss};
constexpr TableKind kHitGroup = {"hit group", RecordKind::kHitGroup};
constexpr TableKind kCallable = {"callable", RecordKind::kCallable};

// Collects the HLSL resources that read the local argument at an offset.
void add_names(const LinkedShader* shader, uint32_t offset, std::vector<std::string>& names) {
  if (shader == nullptr || shader->library == nullptr) return;
  for (size_t i = 0; i < shader->slots.size() && i < shader->library->binding_count; ++i) {
    const shader::BindingSlot& slot = shader->slots[i];
    if (slot.source == shader::SlotSource::kUnbound || !slot.local) continue;
    if (slot.source == shader::SlotSource::kStaticSampler || slot.argument_offset != offset) {
      continue;
    }
    const std::string name = shader->library->bindings[i].name;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
}

std::string register_of(shader::RegisterClass register_class, uint32_t index, uint32_t space,
                        uint32_t count = 1) {
  std::string text = concat("tubs"[static_cast<uint32_t>(register_class) & 3], index);
  if (count == kUnboundedDescriptors) {
    text += "..";
  } else if (count > 1) {
    text += concat("..", index + count - 1);
  }
  return space == 0 ? text : concat(text, ", space", space);
}

std::vector<std::string> registers_of(const RootParameter& parameter) {
  using shader::RegisterClass;
  switch (parameter.ParameterType) {
    case RootParameterType::k32BitConstants:
      return {register_of(RegisterClass::kConstantBuffer, parameter.Constants.ShaderRegister,
                          parameter.Constants.RegisterSpace)};
    case RootParameterType::kCbv:
      return {register_of(RegisterClass::kConstantBuffer, parameter.Descriptor.ShaderRegister,
                          parameter.Descriptor.RegisterSpace)};
    case RootParameterType::kSrv:
      return {register_of(RegisterClass::kShaderResource, parameter.Descriptor.ShaderRegister,
                          parameter.Descriptor.RegisterSpace)};
    case RootParameterType::kUav:
      return {register_of(RegisterClass::kUnorderedAccess, parameter.Descriptor.ShaderRegister,
                          parameter.Descriptor.RegisterSpace)};
    case RootParameterType::kDescriptorTable:
      break;
  }
  std::vector<std::string> registers;
  for (const DescriptorRange& range : parameter.DescriptorTable.Ranges) {
    registers.push_back(register_of(static_cast<RegisterClass>(range.RangeType),
                                    range.BaseShaderRegister, range.RegisterSpace,
                                    range.NumDescriptors));
  }
  return registers;
}

// Decodes the tables of one dispatch.
class Describer {
 public:
  Describer(const DeviceImpl& device, const runtime::LinkedPipeline& pipeline,
            const TableDescriptionDesc& desc)
      : device_(device), pipeline_(pipeline), desc_(desc) {
    out_.StateObject = pipeline.name;
    out_.RayTypes = desc.RayTypes;
  }

  Result<TableDescription> run() {
    const DispatchRaysDesc& d = desc_.Dispatch;
    const auto& generation = d.RayGenerationShaderRecord;
    decode(kRayGeneration, {generation.StartAddress, generation.SizeInBytes, 0});
    decode(kMiss, d.MissShaderTable);
    decode(kHitGroup, d.HitGroupTable);
    decode(kCallable, d.CallableShaderTable);
    add_miss_reaches();
    if (Status s = add_hit_reaches(); !s.ok()) return s.error();
    return std::move(out_);
  }

 private:
  void decode(const TableKind& kind, const GpuVirtualAddressRangeAndStride& range);
  TableRecord decode_record(const TableKind& kind, const DescribedTable& table, uint64_t index);
  void decode_arguments(const DescribedTable& table, const LinkedRecord& record,
                        const uint8_t* bytes, uint64_t readable, TableRecord& out);
  TableArgument decode_argument(const LinkedRecord& record, uint32_t parameter,
                                const uint8_t* argument);
  void decode_descriptor_table(const RootParameter& parameter, TableArgument& out);
  void add_miss_reaches();
  void add_reaches_of(DescribedTable& table, const RaytracingInstanceDesc& instance,
                      uint32_t index_of_instance, uint32_t id);
  Status add_hit_reaches();
  void add_reach(DescribedTable& table, uint64_t index, const TableReach& reach);
  void add_problem(std::string text) { out_.Problems.push_back(std::move(text)); }
  DescribedTable* find(const char* name);

  const DeviceImpl& device_;
  const runtime::LinkedPipeline& pipeline_;
  const TableDescriptionDesc& desc_;
  TableDescription out_;
  uint64_t out_of_table_ = 0;
  std::string first_out_of_table_;
};

DescribedTable* Describer::find(const char* name) {
  for (DescribedTable& table : out_.Tables) {
    if (table.Name == name) return &table;
  }
  return nullptr;
}

void Describer::decode(const TableKind& kind, const GpuVirtualAddressRangeAndStride& range) {
  if (range.StartAddress == 0) return;
  DescribedTable table;
  table.Name = kind.name;
  table.Address = describe_where(device_, range.StartAddress);
  table.SizeInBytes = range.SizeInBytes;
  table.StrideInBytes = range.StrideInBytes;
  uint64_t count = 0;
  if (range.SizeInBytes >= kIdentifierBytes) {
    count = range.StrideInBytes == 0
                ? 1
                : (range.SizeInBytes - kIdentifierBytes) / range.StrideInBytes + 1;
  }
  const uint64_t shown = std::min<uint64_t>(count, desc_.MaxRecords);
  table.RecordsLeftOut = count - shown;
  for (uint64_t i = 0; i < shown; ++i) {
    table.Records.push_back(decode_record(kind, table, i));
    if (table.Records.back().State == TableRecordState::kUnreadable) {
      add_problem(concat(kind.name, " table: record ", i, " lies at ",
                         ToText(table.Records.back().Address), ", which cannot be read"));
      table.RecordsLeftOut += shown - i - 1;
      break;
    }
  }
  out_.Tables.push_back(std::move(table));
}

TableRecord Describer::decode_record(const TableKind& kind, const DescribedTable& table,
                                     uint64_t index) {
  TableRecord out;
  out.Index = index;
  out.Address = describe_where(device_, table.Address.Address + index * table.StrideInBytes);
  const uint64_t readable = device_.addresses.bytes_from(out.Address.Address);
  if (readable < kIdentifierBytes || out.Address.Address % 4 != 0) {
    out.State = TableRecordState::kUnreadable;
    return out;
  }
  const uint8_t* bytes = device_.addresses.host(out.Address.Address);
  if (runtime::is_null_identifier(bytes)) return out;
  const LinkedRecord* record = pipeline_.identifiers.find(bytes);
  if (record == nullptr) {
    out.State = TableRecordState::kUnknown;
    add_problem(concat(kind.name, " table: record ", index,
                       " holds no identifier of this state object. Was it written, and with an "
                       "identifier of this state object?"));
    return out;
  }
  out.State = record->kind == kind.kind ? TableRecordState::kKnown : TableRecordState::kWrongTable;
  out.Export = record->name;
  const auto name = [](const LinkedShader* shader) { return shader ? shader->name : ""; };
  out.Shader = name(record->shader);
  out.AnyHitShader = name(record->any_hit);
  out.ClosestHitShader = name(record->closest_hit);
  out.IntersectionShader = name(record->intersection);
  if (out.State == TableRecordState::kWrongTable) {
    add_problem(concat(kind.name, " table: record ", index, " names ", in_quotes(record->name),
                       ", which belongs in another table; nothing runs for it"));
    return out;
  }
  decode_arguments(table, *record, bytes, readable, out);
  return out;
}

void Describer::decode_arguments(const DescribedTable& table, const LinkedRecord& record,
                                 const uint8_t* bytes, uint64_t readable, TableRecord& out) {
  if (!record.local_root_signature) return;
  const RootSignature& signature = record.local_root_signature;
  out.ArgumentBytes = signature.GetArgumentBytes();
  const uint64_t needed = kIdentifierBytes + out.ArgumentBytes;
  if (table.StrideInBytes != 0 && table.StrideInBytes < needed) {
    add_problem(concat(table.Name, " table: record ", out.Index, " (", in_quotes(record.name),
                       ") takes ", needed, " bytes, the stride is ", table.StrideInBytes,
                       ": it reaches into the next record. Make the stride at least ",
                       align_up(needed, kRaytracingShaderRecordByteAlignment)));
  }
  if (out.Index * table.StrideInBytes + needed > table.SizeInBytes) {
    add_problem(concat(table.Name, " table: record ", out.Index, " (", in_quotes(record.name),
                       ") takes ", needed, " bytes and reaches past the table's ",
                       table.SizeInBytes));
  }
  for (uint32_t i = 0; i < signature.GetDesc().Parameters.size(); ++i) {
    const RootParameter& parameter = signature.GetDesc().Parameters[i];
    const uint64_t offset = kIdentifierBytes + signature.GetArgumentOffset(i);
    const uint64_t size = parameter.ParameterType == RootParameterType::k32BitConstants
                              ? uint64_t{parameter.Constants.Num32BitValues} * 4
                              : 8;
    if (offset + size > readable) break;
    out.Arguments.push_back(decode_argument(record, i, bytes + offset));
    const TableArgument& argument = out.Arguments.back();
    const std::string where = concat(
        table.Name, " table: record ", out.Index, " (", in_quotes(record.name), "), argument ",
        argument.Registers.empty() ? std::string("without registers") : argument.Registers.front());
    if (argument.Type == RootParameterType::kDescriptorTable) {
      if (!argument.HandleIsLive) {
        add_problem(concat(where, ": ", hex(argument.Handle),
                           " is no slot of a live shader-visible descriptor heap"));
      }
    } else if (argument.Type != RootParameterType::k32BitConstants && !argument.Address.Live &&
               argument.Address.Address != 0) {
      add_problem(concat(where, ": ", ToText(argument.Address)));
    }
  }
}

TableArgument Describer::decode_argument(const LinkedRecord& record, uint32_t index,
                                         const uint8_t* argument) {
  const RootSignature& signature = record.local_root_signature;
  const RootParameter& parameter = signature.GetDesc().Parameters[index];
  TableArgument out;
  out.Type = parameter.ParameterType;
  out.OffsetInBytes = static_cast<uint32_t>(kIdentifierBytes) + signature.GetArgumentOffset(index);
  out.Registers = registers_of(parameter);
  for (const auto* s : {record.shader, record.intersection, record.any_hit, record.closest_hit}) {
    add_names(s, signature.GetArgumentOffset(index), out.Names);
  }
  if (parameter.ParameterType == RootParameterType::k32BitConstants) {
    out.Constants.resize(parameter.Constants.Num32BitValues);
    std::memcpy(out.Constants.data(), argument, out.Constants.size() * 4);
    return out;
  }
  uint64_t value = 0;
  std::memcpy(&value, argument, sizeof value);
  if (parameter.ParameterType != RootParameterType::kDescriptorTable) {
    out.Address = describe_where(device_, value);
    return out;
  }
  out.Handle = value;
  decode_descriptor_table(parameter, out);
  return out;
}

void Describer::decode_descriptor_table(const RootParameter& parameter, TableArgument& out) {
  const auto slot = device_.find_slot(GpuDescriptorHandle{out.Handle});
  if (!slot) return;
  out.HandleIsLive = true;
  out.Heap = slot->heap_name;
  out.Slot = slot->index;
  uint64_t next = 0;  // offset of the next appended range, in descriptors
  for (const DescriptorRange& range : parameter.DescriptorTable.Ranges) {
    const uint64_t first = range.OffsetInDescriptorsFromTableStart == kDescriptorRangeOffsetAppend
                               ? next
                               : range.OffsetInDescriptorsFromTableStart;
    uint64_t end = range.NumDescriptors == kUnboundedDescriptors ? slot->count_from_here
                                                                 : first + range.NumDescriptors;
    next = end;
    end = std::min<uint64_t>(end, slot->count_from_here);
    for (uint64_t i = first; i < end; ++i) {
      if (out.Descriptors.size() == desc_.MaxDescriptorsPerTable) {
        out.DescriptorsLeftOut += static_cast<uint32_t>(end - i);
        break;
      }
      out.Descriptors.push_back(describe_descriptor(device_, slot->slot[i]));
      out.Descriptors.back().Slot = slot->index + static_cast<uint32_t>(i);
    }
  }
}

void Describer::add_reach(DescribedTable& table, uint64_t index, const TableReach& reach) {
  // A stride of 0 makes every index the first record. [DXR: Shader record stride]
  const uint64_t record = table.StrideInBytes == 0 ? 0 : index;
  if (record < table.Records.size()) {
    TableRecord& to = table.Records[record];
    if (to.ReachCount++ < desc_.MaxReachesPerRecord) to.ReachedBy.push_back(reach);
  } else if (table.RecordsLeftOut == 0 && out_of_table_++ == 0) {
    first_out_of_table_ =
        concat("hit group table: instance ", reach.InstanceIndex, ", geometry ",
               reach.GeometryIndex, ", ray type ", reach.RayType, " asks for record ", index,
               ", the table has ", table.Records.size());
  }
}

void Describer::add_miss_reaches() {
  DescribedTable* table = find(kMiss.name);
  for (uint32_t type = 0; type < desc_.RayTypes.size() && table != nullptr; ++type) {
    const uint64_t index = desc_.RayTypes[type].MissShaderIndex & 0xFFFFu;
    const uint64_t record = table->StrideInBytes == 0 ? 0 : index;
    if (record < table->Records.size()) {
      table->Records[record].ReachedBy.push_back({0, 0, 0, type});
      ++table->Records[record].ReachCount;
    } else if (table->RecordsLeftOut == 0) {
      add_problem(concat("miss table: ray type ", type, " asks for record ", index,
                         ", the table has ", table->Records.size()));
    }
  }
}

void Describer::add_reaches_of(DescribedTable& table, const RaytracingInstanceDesc& instance,
                               uint32_t index_of_instance, uint32_t id) {
  const auto bottom = device_.backend->find_structure(instance.AccelerationStructure);
  if (bottom == nullptr || bottom->bottom_level == nullptr) return;
  const auto geometries = static_cast<uint32_t>(bottom->bottom_level->geometry_shapes().size());
  for (uint32_t g = 0; g < geometries; ++g) {
    for (uint32_t type = 0; type < desc_.RayTypes.size(); ++type) {
      const RayTypeDesc& ray = desc_.RayTypes[type];
      const uint64_t index =
          uint64_t{ray.RayContributionToHitGroupIndex & 15u} +
          uint64_t{ray.MultiplierForGeometryContributionToHitGroupIndex & 15u} * g +
          instance.InstanceContributionToHitGroupIndex;
      add_reach(table, index, {index_of_instance, id, g, type});
    }
  }
}

Status Describer::add_hit_reaches() {
  if (desc_.TopLevel == 0) return {};
  const auto top = device_.backend->find_structure(desc_.TopLevel);
  if (top == nullptr || top->top_level == nullptr) {
    return make_error(Id::kTableDescription, "there is no top level at ",
                      ToText(describe_where(device_, desc_.TopLevel)),
                      "; it was never built, or has been overwritten");
  }
  DescribedTable* table = find(kHitGroup.name);
  if (table == nullptr) return {};
  uint32_t index_of_instance = 0;
  runtime::for_each_instance(*top, [&](const RaytracingInstanceDesc& instance, uint32_t id) {
    add_reaches_of(*table, instance, index_of_instance++, id);
  });
  if (out_of_table_ != 0) {
    add_problem(concat(first_out_of_table_,
                       out_of_table_ == 1 ? "" : concat(" (and ", out_of_table_ - 1, " more)"),
                       "; nothing runs for it. Do SizeInBytes, StrideInBytes and the contributions "
                       "agree?"));
  }
  return {};
}

}  // namespace

Result<TableDescription> DescribeShaderTables(const Device& device, const StateObject& state_object,
                                              const TableDescriptionDesc& desc) {
  if (!device)
    return make_error(Id::kNullHandle, "DescribeShaderTables: the device is an empty handle");
  if (Status s = CheckHandle(device.impl(), state_object, "DescribeShaderTables: the state object");
      !s.ok()) {
    return s.error();
  }
  const StateObjectImpl& state = *state_object.impl();
  if (state.linked == nullptr || state.type != StateObjectType::kRaytracingPipeline) {
    return make_error(
        Id::kTableDescription,
        "the state object is a collection, but tables hold identifiers of a pipeline");
  }
  const std::lock_guard lock(device.impl()->execute_mutex);
  return Describer(*device.impl(), *state.linked, desc).run();
}

}  // namespace rtapi

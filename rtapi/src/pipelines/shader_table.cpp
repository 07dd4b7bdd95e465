// SPDX-License-Identifier: MIT
#include <rtapi/shader_table.h>

#include <algorithm>
#include <cstring>

#include "rtapi/src/pipelines/state_object_impl.h"

namespace rtapi {

using namespace detail;

namespace {

constexpr size_t kIdentifierBytes = kShaderIdentifierSizeInBytes;
constexpr const char* kKinds[] = {"32-bit constants", "an address", "a descriptor table"};

size_t wanted_kind(RootParameterType type) {
  switch (type) {
    case RootParameterType::k32BitConstants:
      return 0;
    case RootParameterType::kDescriptorTable:
      return 2;
    default:
      return 1;
  }
}

Status write_argument(const RootSignature& signature, uint32_t index, const LocalArgument& argument,
                      const std::string& where, std::vector<std::byte>& record) {
  const RootParameter& parameter = signature.GetDesc().Parameters[index];
  const size_t wanted = wanted_kind(parameter.ParameterType);
  if (argument.value().index() != wanted) {
    return make_error(Id::kTableArgumentKind, where, ": argument ", index, " is ",
                      kKinds[argument.value().index()], ", but the local root signature expects ",
                      kKinds[wanted]);
  }
  const void* source = nullptr;
  size_t bytes = 8;
  if (const auto* constants = std::get_if<std::vector<std::byte>>(&argument.value())) {
    bytes = constants->size();
    source = constants->data();
    if (bytes != size_t{parameter.Constants.Num32BitValues} * 4) {
      return make_error(Id::kTableArgumentSize, where, ": argument ", index, " has ", bytes,
                        " bytes, but the local root signature expects ",
                        size_t{parameter.Constants.Num32BitValues} * 4);
    }
  } else if (const auto* address = std::get_if<GpuVirtualAddress>(&argument.value())) {
    source = address;
  } else {
    source = &std::get<GpuDescriptorHandle>(argument.value()).ptr;
  }
  std::memcpy(record.data() + kIdentifierBytes + signature.GetArgumentOffset(index), source, bytes);
  return {};
}

}  // namespace

Result<uint32_t> ShaderTable::AddRecord(std::string_view export_name,
                                        std::span<const LocalArgument> arguments) {
  const std::string where =
      concat(in_quotes(name_), ", record ", records_.size(), " (", export_name, ")");
  const auto* linked = state_object_ ? state_object_.impl()->find_record(export_name) : nullptr;
  if (!linked) {
    std::string known;
    for (const auto& n : state_object_.GetIdentifiableExports()) {
      known += concat(known.empty() ? "" : ", ", n);
    }
    return make_error(Id::kTableUnknownExport, where, ": the state object has the exports ",
                      known.empty() ? "(none)" : known);
  }
  const RootSignature signature = state_object_.GetLocalRootSignature(export_name);
  const size_t count = signature.GetDesc().Parameters.size();
  if (arguments.size() != count) {
    return make_error(Id::kTableArgumentCount, where, ": ", arguments.size(),
                      " arguments; its local root signature has ", count, " parameters",
                      signature ? "" : " (it has none)");
  }
  std::vector<std::byte> record(kIdentifierBytes + signature.GetArgumentBytes());
  std::memcpy(record.data(), linked->identifier.data(), kIdentifierBytes);
  for (uint32_t i = 0; i < count; ++i) {
    if (Status s = write_argument(signature, i, arguments[i], where, record); !s.ok()) {
      return s.error();
    }
  }
  has_ray_generation_ |= linked->kind == runtime::RecordKind::kRayGeneration;
  records_.push_back(std::move(record));
  return record_count() - 1;
}

uint32_t ShaderTable::AddNullRecord() {
  records_.emplace_back(kIdentifierBytes);
  return record_count() - 1;
}

uint32_t ShaderTable::stride_bytes() const {
  size_t largest = kIdentifierBytes;
  for (const auto& record : records_) largest = std::max(largest, record.size());
  return static_cast<uint32_t>(align_up(largest, has_ray_generation_
                                                     ? kRaytracingShaderTableByteAlignment
                                                     : kRaytracingShaderRecordByteAlignment));
}

std::vector<std::byte> ShaderTable::bytes() const {
  const size_t stride = stride_bytes();
  std::vector<std::byte> out(records_.size() * stride);
  for (size_t i = 0; i < records_.size(); ++i) {
    std::memcpy(out.data() + i * stride, records_[i].data(), records_[i].size());
  }
  return out;
}

Status ShaderTable::Build(const Device& device) {
  if (records_.empty()) {
    buffer_ = {};
    return {};
  }
  const auto contents = bytes();
  auto buffer = device.CreateBuffer(
      {.SizeInBytes = contents.size(), .Heap = HeapType::kUpload, .Name = name_});
  if (!buffer.ok()) return buffer.error();
  buffer_ = std::move(*buffer);
  std::memcpy(buffer_.data<std::byte>().data(), contents.data(), contents.size());
  return {};
}

GpuVirtualAddressRangeAndStride ShaderTable::GetTable() const {
  if (!buffer_) return {};
  return {buffer_.GetGPUVirtualAddress(), buffer_.size(), stride_bytes()};
}

GpuVirtualAddressRange ShaderTable::GetRecord(uint32_t index) const {
  if (!buffer_ || index >= records_.size()) return {};
  const uint64_t stride = stride_bytes();
  return {buffer_.GetGPUVirtualAddress() + index * stride, stride};
}

}  // namespace rtapi

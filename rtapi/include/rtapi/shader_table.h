// SPDX-License-Identifier: MIT
//
// Builds the bytes of a shader table by export names. A convenience: a table is memory, and may be
// written by hand as well.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <rtapi/device.h>
#include <rtapi/resource.h>
#include <rtapi/state_object.h>

namespace rtapi {

// The argument of one parameter of a local root signature.
class LocalArgument {
 public:
  // 32-bit constants: any trivially copyable value of 4 n bytes.
  template <class T>
  static LocalArgument Constants(const T& value) {
    static_assert(sizeof(T) % 4 == 0 && std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    return LocalArgument(std::vector<std::byte>(bytes, bytes + sizeof(T)));
  }
  static LocalArgument Constants(std::span<const uint32_t> values) {
    auto bytes = std::as_bytes(values);
    return LocalArgument(std::vector<std::byte>(bytes.begin(), bytes.end()));
  }
  // A root CBV, SRV or UAV.
  static LocalArgument Address(GpuVirtualAddress address) { return LocalArgument(address); }
  static LocalArgument Address(const Buffer& buffer) {
    return LocalArgument(buffer.GetGPUVirtualAddress());
  }
  // A descriptor table.
  static LocalArgument Table(GpuDescriptorHandle handle) { return LocalArgument(handle); }

  using Value = std::variant<std::vector<std::byte>, GpuVirtualAddress, GpuDescriptorHandle>;
  const Value& value() const { return value_; }

 private:
  explicit LocalArgument(Value value) : value_(std::move(value)) {}
  Value value_;
};

// One table of records: identifier, then the arguments laid out by the export's local root
// signature. The stride fits the largest record; it is a multiple of 32, or of 64 in a table with
// ray generation records, so that each of them may be DispatchRaysDesc::RayGenerationShaderRecord.
class ShaderTable {
 public:
  explicit ShaderTable(StateObject state_object, std::string name = "shader table")
      : state_object_(std::move(state_object)), name_(std::move(name)) {}

  // Appends a record; returns its index. `arguments`: one per parameter of the local root
  // signature, in order. Errors name export, parameter, given and wanted kind.
  Result<uint32_t> AddRecord(std::string_view export_name,
                             std::span<const LocalArgument> arguments = {});
  Result<uint32_t> AddRecord(std::string_view export_name,
                             std::initializer_list<LocalArgument> arguments) {
    return AddRecord(export_name,
                     std::span<const LocalArgument>(arguments.begin(), arguments.size()));
  }
  // A record whose identifier is NULL: nothing runs. [DXR: Shader identifier]
  uint32_t AddNullRecord();

  uint32_t record_count() const { return static_cast<uint32_t>(records_.size()); }
  uint32_t stride_bytes() const;  // of an empty table 32
  std::vector<std::byte> bytes() const;

  // Writes the table into an upload buffer of its own. Call again after further records.
  Status Build(const Device& device);
  // After Build; an empty table gives a zero range.
  GpuVirtualAddressRangeAndStride GetTable() const;
  // One record; a zero range past the end.
  GpuVirtualAddressRange GetRecord(uint32_t index) const;
  const Buffer& buffer() const { return buffer_; }

 private:
  StateObject state_object_;
  std::string name_;
  std::vector<std::vector<std::byte>> records_;
  bool has_ray_generation_ = false;
  Buffer buffer_;
};

}  // namespace rtapi

// SPDX-License-Identifier: MIT
/// @file
/// Builds the bytes of a shader table by export names. A convenience: a table is memory, and may be
/// written by hand as well.
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

/// The argument of one parameter of a local root signature, for ShaderTable::AddRecord.
class LocalArgument {
 public:
  /// 32-bit constants: the bytes of a trivially copyable value of 4 n bytes, which are copied.
  template <class T>
  static LocalArgument Constants(const T& value) {
    static_assert(sizeof(T) % 4 == 0 && std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    return LocalArgument(std::vector<std::byte>(bytes, bytes + sizeof(T)));
  }
  /// 32-bit constants: these values, which are copied.
  static LocalArgument Constants(std::span<const uint32_t> values) {
    auto bytes = std::as_bytes(values);
    return LocalArgument(std::vector<std::byte>(bytes.begin(), bytes.end()));
  }
  /// A root CBV, SRV or UAV by its address. The record keeps nothing alive.
  static LocalArgument Address(GpuVirtualAddress address) { return LocalArgument(address); }
  /// A root CBV, SRV or UAV: byte 0 of a buffer. The record does not keep the buffer alive.
  static LocalArgument Address(const Buffer& buffer) {
    return LocalArgument(buffer.GetGPUVirtualAddress());
  }
  /// A descriptor table: its first descriptor, in a heap that is set when rays are dispatched.
  static LocalArgument Table(GpuDescriptorHandle handle) { return LocalArgument(handle); }

  /// Constants, an address, or a descriptor table.
  using Value = std::variant<std::vector<std::byte>, GpuVirtualAddress, GpuDescriptorHandle>;
  /// Returns the value that was given.
  const Value& value() const { return value_; }

 private:
  explicit LocalArgument(Value value) : value_(std::move(value)) {}
  Value value_;
};

/// One table of records: each is a shader identifier, then arguments laid out by the export's local
/// root signature. The stride fits the largest record; it is a multiple of 32, or of 64 in a table
/// with ray generation records, so that each of them may be
/// DispatchRaysDesc::RayGenerationShaderRecord. Not thread-safe.
/// [DXR: Shader tables; Shader table memory initialization]
class ShaderTable {
 public:
  /// An empty table of records of one state object, which it keeps alive. `name` stands in messages
  /// and names the buffer.
  explicit ShaderTable(StateObject state_object, std::string name = "shader table")
      : state_object_(std::move(state_object)), name_(std::move(name)) {}

  /// Appends a record and returns its index. `export_name` is a ray generation, miss or callable
  /// shader or a hit group; `arguments` are one for each parameter of its local root signature, in
  /// order, none where it has no such signature.
  /// @errors KA0840 unknown export; KA0841 number, KA0842 kind, KA0843 size of an argument. The
  /// message names export and parameter, what was given and what is wanted. Nothing is appended.
  Result<uint32_t> AddRecord(std::string_view export_name,
                             std::span<const LocalArgument> arguments = {});
  /// @overload
  Result<uint32_t> AddRecord(std::string_view export_name,
                             std::initializer_list<LocalArgument> arguments) {
    return AddRecord(export_name,
                     std::span<const LocalArgument>(arguments.begin(), arguments.size()));
  }
  /// Appends a record whose identifier is NULL, so that nothing runs for it, and returns its index.
  /// [DXR: Shader identifier]
  uint32_t AddNullRecord();

  /// Records so far.
  uint32_t record_count() const { return static_cast<uint32_t>(records_.size()); }
  /// Bytes from one record to the next; 32 for an empty table. It grows with the largest record.
  uint32_t stride_bytes() const;
  /// The table as it will lie in memory: record_count() * stride_bytes() bytes, padded by zeros.
  std::vector<std::byte> bytes() const;

  /// Writes the table into a new upload buffer, which this object owns. Call again after further
  /// records; a list that was recorded before then still has the old addresses.
  /// @errors those of Device::CreateBuffer: KA0904 an empty device, KA0905, KA0990.
  Status Build(const Device& device);
  /// The table as DispatchRaysDesc takes it, after Build; a zero range before, and for an empty
  /// table.
  GpuVirtualAddressRangeAndStride GetTable() const;
  /// One record as DispatchRaysDesc::RayGenerationShaderRecord takes it, after Build; a zero range
  /// before, and past the end.
  GpuVirtualAddressRange GetRecord(uint32_t index) const;
  /// The buffer that Build made; empty before. Dispatches need it alive.
  const Buffer& buffer() const { return buffer_; }

 private:
  StateObject state_object_;
  std::string name_;
  std::vector<std::vector<std::byte>> records_;
  bool has_ray_generation_ = false;
  Buffer buffer_;
};

}  // namespace rtapi

// SPDX-License-Identifier: MIT
//
// What all serialized acceleration structures have in common: D3D12's header, the addresses of what
// the structure refers to, and the checksum; and how the rest is written and read, in units of 8
// bytes.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <rtapi/raytracing.h>
#include <rtapi/result.h>

#include "runtime/backend/errors.h"

namespace kaamos::runtime {

using SerializedHeader = rtapi::SerializedRaytracingAccelerationStructureHeader;

struct SerializedFrame {
  rtapi::RaytracingAccelerationStructureType type =
      rtapi::RaytracingAccelerationStructureType::kTopLevel;
  uint32_t flags = 0;       // build flags
  uint64_t count = 0;       // of elements: what they are depends on the type
  uint64_t size_bytes = 0;  // DeserializedSizeInBytes
  // None: the addresses follow the header as those of bottom levels do.
  std::optional<rtapi::SerializedBlockType> block;
  std::vector<uint64_t> pointers;

  // The size of the header, the addresses and what precedes the contents.
  uint64_t bytes() const;
  // NumBottomLevelAccelerationStructurePointers of the postbuild info.
  uint64_t pointers_or_blocks() const { return block ? 1 : pointers.size(); }
};

constexpr uint64_t padded(uint64_t bytes) {
  return (bytes + 7) / 8 * 8;
}

class SerializedWriter {
 public:
  SerializedWriter() = default;  // only counts
  explicit SerializedWriter(std::span<uint8_t> out) : out_(out.data()) {}
  uint64_t bytes() const { return bytes_; }
  void put(const void* data, uint64_t bytes) {
    if (out_ != nullptr) {
      if (bytes != 0) std::memcpy(out_ + bytes_, data, bytes);
      std::memset(out_ + bytes_ + bytes, 0, padded(bytes) - bytes);
    }
    bytes_ += padded(bytes);
  }
  template <typename T>
  void put(const T& value) {
    put(&value, sizeof(value));
  }
  template <typename T>
  void put_array(std::span<const T> values) {
    put(values.data(), values.size_bytes());
  }
  template <typename T>
  void put_array(const std::vector<T>& values) {
    put_array(std::span<const T>(values));
  }

 private:
  uint8_t* out_ = nullptr;
  uint64_t bytes_ = 0;
};

// Every read is checked against the end; one that does not fit changes nothing.
class SerializedReader {
 public:
  explicit SerializedReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}
  uint64_t left() const { return bytes_.size() - at_; }
  const uint8_t* here() const { return bytes_.data() + at_; }
  // Null if there are fewer.
  const uint8_t* take(uint64_t bytes) {
    if (bytes > left() || padded(bytes) > left()) return nullptr;
    const uint8_t* taken = here();
    at_ += padded(bytes);
    return taken;
  }
  template <typename T>
  bool get(T& value) {
    const uint8_t* bytes = take(sizeof(T));
    if (bytes != nullptr) std::memcpy(static_cast<void*>(&value), bytes, sizeof(T));
    return bytes != nullptr;
  }
  template <typename T>
  bool get_array(uint64_t count, std::vector<T>& values) {
    if (count > left() / sizeof(T)) return false;
    const uint8_t* bytes = take(count * sizeof(T));
    if (bytes == nullptr) return false;
    values.resize(count);
    if (count != 0) std::memcpy(static_cast<void*>(values.data()), bytes, count * sizeof(T));
    return true;
  }

 private:
  std::span<const uint8_t> bytes_;
  uint64_t at_ = 0;
};

rtapi::Error serialized_error(const std::string& what);

// Writes the frame of what takes `all_bytes` with its contents, for which seal_serialized has to
// follow.
void put_frame(const SerializedFrame& frame, uint64_t all_bytes, SerializedWriter& writer);
// Reads it, and checks identifier, extent and checksum; `contents` gets the rest. Error KA0789.
rtapi::Result<SerializedFrame> parse_frame(std::span<const uint8_t> bytes,
                                           std::span<const uint8_t>& contents);

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
// The container of compiled shaders and root signatures: a header with a checksum, and parts that
// are named by four characters. [DXC: docs/DXIL.rst, DXIL Container Format]
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <rtapi/result.h>

namespace kaamos::d3d12 {

/// The number of a name of four characters: fourcc("RTS0").
constexpr uint32_t fourcc(const char (&name)[5]) {
  uint32_t out = 0;
  for (int i = 3; i >= 0; --i) out = out << 8 | static_cast<uint8_t>(name[i]);
  return out;
}

struct Part {
  uint32_t fourcc;
  std::span<const std::byte> bytes;
};

/// A container with the parts in their order, each at an offset that 4 divides.
std::vector<std::byte> write_container(std::span<const Part> parts);

/// The parts of a container; they point into `bytes`. A checksum of zeros is that of an unsigned
/// container, which DXC makes without its validator, and is not compared.
/// @errors KA4020 `bytes` is null or holds no whole container; the message names the offset.
rtapi::Result<std::vector<Part>> read_container(const void* bytes, size_t size);

}  // namespace kaamos::d3d12

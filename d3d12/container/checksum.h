// SPDX-License-Identifier: MIT
// The checksum of containers: MD5 with another padding. The length in bits is the first word of the
// last block, and a second one, which no MD5 has, is its last word.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace kaamos::d3d12 {

/// Computes a container's checksum from its bytes 20 and up, all that follow the checksum itself.
std::array<uint32_t, 4> container_checksum(std::span<const std::byte> bytes);

/// MD5 as it is. [RFC 1321]
std::array<uint32_t, 4> md5(std::span<const std::byte> bytes);

}  // namespace kaamos::d3d12

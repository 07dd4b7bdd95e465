// SPDX-License-Identifier: MIT
#include "runtime/operations/cluster_vertices.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "runtime/backend/dispatch_checks.h"
#include "runtime/structures/build_inputs.h"

namespace kaamos::runtime {

using rtapi::Format;
using rtapi::RtasVertexFormat;

namespace {

struct KnownFormat {
  VertexLayout layout;
  Format format;  // of classic builds, with the same first components
};

// By RtasVertexFormat.
constexpr KnownFormat kFormats[] = {
    {{0, 1}, Format::kUnknown},           {{8, 4}, Format::kR32G32Float},
    {{12, 4}, Format::kR32G32B32Float},   {{4, 2}, Format::kR16G16Float},
    {{6, 2}, Format::kR16G16B16A16Float}, {{4, 2}, Format::kR16G16Unorm},
    {{6, 2}, Format::kR16G16B16A16Unorm}, {{4, 2}, Format::kR16G16Snorm},
    {{6, 2}, Format::kR16G16B16A16Snorm}, {{2, 1}, Format::kR8G8Unorm},
    {{3, 1}, Format::kR8G8B8A8Unorm},     {{2, 1}, Format::kR8G8Snorm},
    {{3, 1}, Format::kR8G8B8A8Snorm},     {{4, 4}, Format::kR10G10B10A2Unorm}};

uint32_t load_word(const uint8_t* in) {
  uint32_t word;
  std::memcpy(&word, in, sizeof(word));
  return word;
}

// Little-endian bits, which must be inside the block.
uint32_t load_bits(const uint8_t* in, uint64_t first, uint32_t count) {
  uint32_t value = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint64_t bit = first + i;
    value |= static_cast<uint32_t>(in[bit / 8] >> (bit % 8) & 1) << i;
  }
  return value;
}

std::vector<float> decode_compressed(const AddressMap& addresses, const VertexSource& source,
                                     std::string& why) {
  const auto outside = [&](uint64_t bytes) {
    why = "the block of positions " + at_address(addresses, source.address) + " needs " +
          std::to_string(bytes) + " bytes, but the buffer has " +
          std::to_string(addresses.bytes_from(source.address));
  };
  if (source.address % 4 != 0) {
    why = "the block of positions " + at_address(addresses, source.address) +
          " must be at a multiple of 4";
    return {};
  }
  if (!addresses.contains(source.address, 12)) return outside(12), std::vector<float>();
  const uint8_t* block = addresses.host(source.address);
  const CompressedHeader header = read_compressed_header(block);
  const uint64_t bytes = header.bytes(source.count);
  if (!addresses.contains(source.address, bytes)) return outside(bytes), std::vector<float>();
  std::vector<float> xyz(3 * size_t{source.count});
  uint64_t bit = 0;
  for (size_t i = 0; i < xyz.size(); ++i) {
    const size_t axis = i % 3;
    const auto offset = static_cast<int32_t>(load_bits(block + 12, bit, header.bits[axis]));
    bit += header.bits[axis];
    xyz[i] = std::ldexp(static_cast<float>(header.anchor[axis] + offset),
                        static_cast<int>(header.exponent) - 127);
  }
  return xyz;
}

}  // namespace

VertexLayout vertex_layout(RtasVertexFormat format) {
  return kFormats[static_cast<uint32_t>(format)].layout;
}

CompressedHeader read_compressed_header(const uint8_t* block) {
  uint32_t words[3];
  for (int i = 0; i < 3; ++i) words[i] = load_word(block + 4 * i);
  CompressedHeader header;
  header.exponent = words[0] & 0xFF;
  for (int i = 0; i < 3; ++i) header.anchor[i] = static_cast<int32_t>(words[i]) >> 8;
  header.bits[0] = (words[1] & 15) + 1;
  header.bits[1] = (words[1] >> 4 & 15) + 1;
  header.bits[2] = (words[2] & 15) + 1;
  return header;
}

uint32_t vertices_inside(const AddressMap& addresses, const VertexSource& source) {
  const uint32_t bytes = vertex_layout(source.format).bytes;
  const uint64_t stride = source.stride == 0 ? bytes : source.stride;
  const uint64_t available = addresses.bytes_from(source.address);
  if (available < bytes) return 0;
  return static_cast<uint32_t>(std::min<uint64_t>(source.count, (available - bytes) / stride + 1));
}

void truncate_vertices(std::vector<float>& xyz, uint32_t bits) {
  if (bits == 0) return;
  const uint32_t mask = bits >= 32 ? 0 : ~0u << bits;
  for (float& x : xyz) x = std::bit_cast<float>(std::bit_cast<uint32_t>(x) & mask);
}

std::vector<float> decode_vertices(const AddressMap& addresses, const VertexSource& source,
                                   std::string& why) {
  if (source.format == RtasVertexFormat::kCompressed1) {
    return decode_compressed(addresses, source, why);
  }
  const KnownFormat& known = kFormats[static_cast<uint32_t>(source.format)];
  const uint64_t stride = source.stride == 0 ? known.layout.bytes : source.stride;
  if (source.address % known.layout.alignment != 0 || stride % known.layout.alignment != 0) {
    why = "the vertices " + at_address(addresses, source.address) + " have stride " +
          std::to_string(stride) + "; address and stride must be multiples of " +
          std::to_string(known.layout.alignment);
    return {};
  }
  rtapi::RaytracingGeometryTrianglesDesc desc = {};
  desc.VertexFormat = known.format;
  desc.VertexCount = vertices_inside(addresses, source);
  std::vector<float> xyz(3 * size_t{desc.VertexCount});
  if (desc.VertexCount != 0) {
    desc.VertexBuffer = {reinterpret_cast<uint64_t>(addresses.host(source.address)), stride};
    decode_vertices(desc, xyz.data());
  }
  truncate_vertices(xyz, source.truncated_bits);
  xyz.resize(3 * size_t{source.count}, std::numeric_limits<float>::quiet_NaN());
  return xyz;
}

}  // namespace kaamos::runtime

// SPDX-License-Identifier: MIT
#include "runtime/structures/build_inputs.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <limits>

#include "runtime/backend/errors.h"
#include "runtime/errors/text.h"

namespace kaamos::runtime {
namespace {

using rtapi::Format;
using rtapi::RaytracingGeometryDesc;
using rtapi::RaytracingGeometryTrianglesDesc;
using rtapi::RaytracingGeometryType;

float half_to_float(uint16_t half) {
  const uint32_t sign = uint32_t{half & 0x8000u} << 16;
  const uint32_t exponent = (half >> 10) & 0x1Fu;
  const uint32_t mantissa = half & 0x3FFu;
  if (exponent == 0) {
    const float magnitude = static_cast<float>(mantissa) * 0x1p-24f;
    return sign != 0 ? -magnitude : magnitude;
  }
  const uint32_t bits = exponent == 31 ? sign | 0x7F800000u | mantissa << 13
                                       : sign | (exponent + 112) << 23 | mantissa << 13;
  float value;
  std::memcpy(&value, &bits, sizeof(value));
  return value;
}

template <typename T>
T load(const uint8_t* address) {
  T value;
  std::memcpy(&value, address, sizeof(T));
  return value;
}

// Reads one vertex of a format; z stays 0 for two components. [DXR: vertex formats]
using DecodeVertex = void (*)(const uint8_t* in, float out[3]);

template <int kComponents>
void decode_float(const uint8_t* in, float out[3]) {
  for (int i = 0; i < kComponents; ++i) out[i] = load<float>(in + 4 * i);
}
template <int kComponents>
void decode_half(const uint8_t* in, float out[3]) {
  for (int i = 0; i < kComponents; ++i) out[i] = half_to_float(load<uint16_t>(in + 2 * i));
}
template <typename T, int kComponents>
void decode_norm(const uint8_t* in, float out[3]) {
  // The most negative SNORM value is -1, too. [D3D11.3 3.2.3.1]
  constexpr float kScale = static_cast<float>(std::numeric_limits<T>::max());
  for (int i = 0; i < kComponents; ++i) {
    out[i] = std::max(static_cast<float>(load<T>(in + sizeof(T) * i)) / kScale, -1.0f);
  }
}
void decode_unorm10(const uint8_t* in, float out[3]) {
  const uint32_t bits = load<uint32_t>(in);
  for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(bits >> (10 * i) & 0x3FFu) / 1023.0f;
}

struct VertexFormat {
  DecodeVertex decode = nullptr;
  uint32_t bytes = 0;  // bytes read per vertex: a fourth component is never read
};

VertexFormat vertex_format(Format format) {
  switch (format) {
    case Format::kR32G32Float:
      return {decode_float<2>, 8};
    case Format::kR32G32B32Float:
      return {decode_float<3>, 12};
    case Format::kR16G16Float:
      return {decode_half<2>, 4};
    case Format::kR16G16B16A16Float:
      return {decode_half<3>, 6};
    case Format::kR16G16Snorm:
      return {decode_norm<int16_t, 2>, 4};
    case Format::kR16G16B16A16Snorm:
      return {decode_norm<int16_t, 3>, 6};
    case Format::kR16G16Unorm:
      return {decode_norm<uint16_t, 2>, 4};
    case Format::kR16G16B16A16Unorm:
      return {decode_norm<uint16_t, 3>, 6};
    case Format::kR10G10B10A2Unorm:
      return {decode_unorm10, 4};
    case Format::kR8G8Unorm:
      return {decode_norm<uint8_t, 2>, 2};
    case Format::kR8G8B8A8Unorm:
      return {decode_norm<uint8_t, 3>, 3};
    case Format::kR8G8Snorm:
      return {decode_norm<int8_t, 2>, 2};
    case Format::kR8G8B8A8Snorm:
      return {decode_norm<int8_t, 3>, 3};
    default:
      return {};
  }
}

// Only the low 32 bits count. [DXR: D3D12_GPU_VIRTUAL_ADDRESS_AND_STRIDE of vertex buffers]
uint64_t vertex_stride(const RaytracingGeometryTrianglesDesc& desc) {
  return desc.VertexBuffer.StrideInBytes & 0xFFFFFFFFu;
}

uint32_t index_bytes(Format format) {
  return format == Format::kR16Uint ? 2 : 4;
}

rtapi::Status outside(uint32_t geometry, const char* what, uint64_t address, uint64_t bytes,
                      uint64_t available) {
  return make_error(
      Id::kInputOutOfBounds,
      "geometry " + std::to_string(geometry) + ", " + what + " at address " + errors::hex(address) +
          " needs " + std::to_string(bytes) + " bytes, but its buffer has " +
          std::to_string(available) +
          " from there on. Check address, count and stride, and that the buffer is alive.");
}

rtapi::Status check_range(uint32_t geometry, const char* what, uint64_t address, uint64_t bytes,
                          const AddressMap& addresses) {
  if (bytes == 0) return {};
  const uint64_t available = addresses.bytes_from(address);
  return bytes <= available ? rtapi::Status{} : outside(geometry, what, address, bytes, available);
}

// Bytes from the start of the first element to the end of the last; saturates.
uint64_t span_bytes(uint64_t count, uint64_t stride, uint64_t element) {
  if (count == 0) return 0;
  if (stride != 0 && count - 1 > (UINT64_MAX / 2) / stride) return UINT64_MAX;
  return (count - 1) * stride + element;
}

rtapi::Status check_triangles(const RaytracingGeometryTrianglesDesc& desc, uint32_t index,
                              const AddressMap& addresses) {
  const VertexFormat format = vertex_format(desc.VertexFormat);
  const bool indexed = desc.IndexFormat != Format::kUnknown;
  if (format.decode == nullptr ||
      (indexed && desc.IndexFormat != Format::kR16Uint && desc.IndexFormat != Format::kR32Uint)) {
    return make_error(
        Id::kInputFormat,
        "geometry " + std::to_string(index) + " has DXGI vertex format " +
            std::to_string(static_cast<uint32_t>(desc.VertexFormat)) + " and index format " +
            std::to_string(static_cast<uint32_t>(desc.IndexFormat)) +
            "; use a vertex format of D3D12_RAYTRACING_GEOMETRY_TRIANGLES_DESC, and R16_UINT, "
            "R32_UINT or UNKNOWN for indices.");
  }
  const uint64_t vertices = span_bytes(desc.VertexCount, vertex_stride(desc), format.bytes);
  if (auto s = check_range(index, "vertices", desc.VertexBuffer.StartAddress, vertices, addresses);
      !s) {
    return s;
  }
  if (indexed) {
    const uint64_t bytes = uint64_t{desc.IndexCount} * index_bytes(desc.IndexFormat);
    if (auto s = check_range(index, "indices", desc.IndexBuffer, bytes, addresses); !s) return s;
  }
  return check_range(index, "Transform3x4", desc.Transform3x4, desc.Transform3x4 != 0 ? 48 : 0,
                     addresses);
}

}  // namespace

uint64_t primitive_count(const RaytracingGeometryDesc& desc) {
  if (desc.Type == RaytracingGeometryType::kProceduralPrimitiveAabbs) return desc.AABBs.AABBCount;
  const bool indexed = desc.Triangles.IndexFormat != Format::kUnknown;
  return (indexed ? desc.Triangles.IndexCount : desc.Triangles.VertexCount) / 3;
}

rtapi::Status check_inputs(const RaytracingGeometryDesc& desc, uint32_t index,
                           const AddressMap& addresses) {
  if (desc.Type == RaytracingGeometryType::kTriangles) {
    return check_triangles(desc.Triangles, index, addresses);
  }
  const uint64_t bytes = span_bytes(desc.AABBs.AABBCount, desc.AABBs.AABBs.StrideInBytes,
                                    sizeof(rtapi::RaytracingAabb));
  return check_range(index, "AABBs", desc.AABBs.AABBs.StartAddress, bytes, addresses);
}

RaytracingGeometryDesc as_host_sees(const RaytracingGeometryDesc& desc,
                                    const AddressMap& addresses) {
  const auto host = [&](uint64_t address) {
    return address == 0 ? 0 : reinterpret_cast<uint64_t>(addresses.host(address));
  };
  RaytracingGeometryDesc result = desc;
  if (desc.Type == RaytracingGeometryType::kProceduralPrimitiveAabbs) {
    result.AABBs.AABBs.StartAddress = host(desc.AABBs.AABBs.StartAddress);
    return result;
  }
  result.Triangles.VertexBuffer.StartAddress = host(desc.Triangles.VertexBuffer.StartAddress);
  result.Triangles.IndexBuffer = host(desc.Triangles.IndexBuffer);
  result.Triangles.Transform3x4 = host(desc.Triangles.Transform3x4);
  return result;
}

void decode_vertices(const RaytracingGeometryTrianglesDesc& desc, float* xyz) {
  const VertexFormat format = vertex_format(desc.VertexFormat);
  const auto* in = reinterpret_cast<const uint8_t*>(desc.VertexBuffer.StartAddress);
  const uint64_t stride = vertex_stride(desc);
  const auto* m = reinterpret_cast<const float*>(desc.Transform3x4);
  for (uint32_t i = 0; i < desc.VertexCount; ++i, in += stride, xyz += 3) {
    float p[3] = {0, 0, 0};
    format.decode(in, p);
    for (int row = 0; row < 3; ++row) {
      xyz[row] = m == nullptr ? p[row]
                              : m[4 * row] * p[0] + m[4 * row + 1] * p[1] + m[4 * row + 2] * p[2] +
                                    m[4 * row + 3];
    }
  }
}

uint32_t decode_indices(const RaytracingGeometryTrianglesDesc& desc, uint32_t* indices) {
  const bool indexed = desc.IndexFormat != Format::kUnknown;
  const uint32_t triangles = (indexed ? desc.IndexCount : desc.VertexCount) / 3;
  const auto* in = reinterpret_cast<const uint8_t*>(desc.IndexBuffer);
  uint32_t out_of_range = 0;
  for (uint32_t triangle = 0; triangle < triangles; ++triangle, indices += 3) {
    bool valid = true;
    for (uint32_t corner = 0; corner < 3; ++corner) {
      const uint64_t i = 3 * uint64_t{triangle} + corner;
      uint32_t value = static_cast<uint32_t>(i);
      if (indexed) {
        value = desc.IndexFormat == Format::kR16Uint ? load<uint16_t>(in + 2 * i)
                                                     : load<uint32_t>(in + 4 * i);
      }
      indices[corner] = value;
      valid &= value < desc.VertexCount;
    }
    if (!valid) {
      indices[0] = indices[1] = indices[2] = 0;
      ++out_of_range;
    }
  }
  return out_of_range;
}

PaddedBounds padded_bounds(const rtapi::RaytracingAabb& box) {
  const float lower[3] = {box.MinX, box.MinY, box.MinZ};
  const float upper[3] = {box.MaxX, box.MaxY, box.MaxZ};
  PaddedBounds result = {};
  result.active = true;
  float largest = 0;
  for (int i = 0; i < 3; ++i) {
    if (std::isnan(lower[i]) || std::isnan(upper[i])) result.active = false;
    // Boxes may be unbounded.
    result.lower[i] = std::clamp(lower[i], -1e18f, 1e18f);
    result.upper[i] = std::clamp(upper[i], -1e18f, 1e18f);
  }
  for (int i = 0; i < 3; ++i) {
    largest = std::max({largest, std::fabs(result.lower[i]), std::fabs(result.upper[i])});
  }
  bool inverted = false;
  for (int i = 0; i < 3; ++i) inverted |= result.lower[i] > result.upper[i];
  const float pad = 4 * FLT_EPSILON * largest + 16 * FLT_MIN;
  for (int i = 0; i < 3; ++i) {
    if (inverted) {
      result.lower[i] = result.upper[i] = 0.5f * result.lower[i] + 0.5f * result.upper[i];
    }
    result.lower[i] -= pad;
    result.upper[i] += pad;
  }
  return result;
}

const rtapi::RaytracingAabb& aabb_at(const rtapi::RaytracingGeometryAabbsDesc& desc,
                                     uint64_t primitive) {
  return *reinterpret_cast<const rtapi::RaytracingAabb*>(desc.AABBs.StartAddress +
                                                         primitive * desc.AABBs.StrideInBytes);
}

}  // namespace kaamos::runtime

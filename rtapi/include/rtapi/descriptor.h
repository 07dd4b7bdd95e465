// SPDX-License-Identifier: MIT
//
// Descriptor heaps, views and samplers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <rtapi/types.h>

namespace rtapi {

namespace detail {
struct DescriptorHeapImpl;
}

enum class DescriptorHeapType : uint32_t { kCbvSrvUav = 0, kSampler = 1 };
enum class DescriptorHeapFlags : uint32_t { kNone = 0, kShaderVisible = 1 };
template <>
inline constexpr bool kIsFlags<DescriptorHeapFlags> = true;

struct DescriptorHeapDesc {
  DescriptorHeapType Type = DescriptorHeapType::kCbvSrvUav;
  uint32_t NumDescriptors = 0;  // 1 .. 1,000,000; shader-visible samplers: .. 2048
  DescriptorHeapFlags Flags = DescriptorHeapFlags::kNone;
  std::string Name = {};
};

// Slots of 32 bytes, all null descriptors at first.
class DescriptorHeap {
 public:
  DescriptorHeap() = default;
  explicit DescriptorHeap(std::shared_ptr<detail::DescriptorHeapImpl> impl)
      : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const DescriptorHeap&) const = default;

  const DescriptorHeapDesc& GetDesc() const;
  CpuDescriptorHandle GetCPUDescriptorHandleForHeapStart() const;
  GpuDescriptorHandle GetGPUDescriptorHandleForHeapStart() const;  // 0 unless shader-visible
  CpuDescriptorHandle GetCPUDescriptorHandle(uint32_t index) const {
    return GetCPUDescriptorHandleForHeapStart().Offset(index);
  }
  GpuDescriptorHandle GetGPUDescriptorHandle(uint32_t index) const {
    return GetGPUDescriptorHandleForHeapStart().Offset(index);
  }
  const std::shared_ptr<detail::DescriptorHeapImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::DescriptorHeapImpl> impl_;
};

// ---------------------------------------------------------------------------------------------
// Shader resource views

enum class SrvDimension : uint32_t {
  kUnknown = 0,
  kBuffer = 1,
  kTexture1D = 2,
  kTexture1DArray = 3,
  kTexture2D = 4,
  kTexture2DArray = 5,
  kTexture3D = 8,
  kTextureCube = 9,
  kTextureCubeArray = 10,
  kRaytracingAccelerationStructure = 11,
};

enum class BufferSrvFlags : uint32_t { kNone = 0, kRaw = 1 };
template <>
inline constexpr bool kIsFlags<BufferSrvFlags> = true;

struct BufferSrv {
  uint64_t FirstElement = 0;         // in elements
  uint32_t NumElements = 0;          // 0: to the end of the buffer
  uint32_t StructureByteStride = 0;  // structured: multiple of 4 up to 2048, Format kUnknown
  BufferSrvFlags Flags = BufferSrvFlags::kNone;  // raw: Format kR32Typeless
};
struct Tex1DSrv {
  uint32_t MostDetailedMip = 0;
  uint32_t MipLevels = 0xFFFFFFFFu;  // ~0: to the end of the chain
  float ResourceMinLODClamp = 0;
};
struct Tex1DArraySrv {
  uint32_t MostDetailedMip = 0;
  uint32_t MipLevels = 0xFFFFFFFFu;
  uint32_t FirstArraySlice = 0;
  uint32_t ArraySize = 0xFFFFFFFFu;  // ~0: to the end of the array
  float ResourceMinLODClamp = 0;
};
struct Tex2DSrv {
  uint32_t MostDetailedMip = 0;
  uint32_t MipLevels = 0xFFFFFFFFu;
  uint32_t PlaneSlice = 0;
  float ResourceMinLODClamp = 0;
};
struct Tex2DArraySrv {
  uint32_t MostDetailedMip = 0;
  uint32_t MipLevels = 0xFFFFFFFFu;
  uint32_t FirstArraySlice = 0;
  uint32_t ArraySize = 0xFFFFFFFFu;
  uint32_t PlaneSlice = 0;
  float ResourceMinLODClamp = 0;
};
struct Tex3DSrv {
  uint32_t MostDetailedMip = 0;
  uint32_t MipLevels = 0xFFFFFFFFu;
  float ResourceMinLODClamp = 0;
};
struct TexCubeSrv {
  uint32_t MostDetailedMip = 0;
  uint32_t MipLevels = 0xFFFFFFFFu;
  float ResourceMinLODClamp = 0;
};
struct TexCubeArraySrv {
  uint32_t MostDetailedMip = 0;
  uint32_t MipLevels = 0xFFFFFFFFu;
  uint32_t First2DArrayFace = 0;
  uint32_t NumCubes = 0xFFFFFFFFu;
  float ResourceMinLODClamp = 0;
};
struct RaytracingAccelerationStructureSrv {
  GpuVirtualAddress Location = 0;  // 0: a null acceleration structure, missed by every ray
};

// Only the member that ViewDimension names counts.
struct ShaderResourceViewDesc {
  rtapi::Format Format = rtapi::Format::kUnknown;  // textures: kUnknown is the texture's own
  SrvDimension ViewDimension = SrvDimension::kUnknown;
  uint32_t Shader4ComponentMapping = kDefaultShader4ComponentMapping;
  BufferSrv Buffer = {};
  Tex1DSrv Texture1D = {};
  Tex1DArraySrv Texture1DArray = {};
  Tex2DSrv Texture2D = {};
  Tex2DArraySrv Texture2DArray = {};
  Tex3DSrv Texture3D = {};
  TexCubeSrv TextureCube = {};
  TexCubeArraySrv TextureCubeArray = {};
  RaytracingAccelerationStructureSrv RaytracingAccelerationStructure = {};
};

// ---------------------------------------------------------------------------------------------
// Unordered access views

enum class UavDimension : uint32_t {
  kUnknown = 0,
  kBuffer = 1,
  kTexture1D = 2,
  kTexture1DArray = 3,
  kTexture2D = 4,
  kTexture2DArray = 5,
  kTexture3D = 8,
};

enum class BufferUavFlags : uint32_t { kNone = 0, kRaw = 1 };
template <>
inline constexpr bool kIsFlags<BufferUavFlags> = true;

struct BufferUav {
  uint64_t FirstElement = 0;
  uint32_t NumElements = 0;  // 0: to the end of the buffer
  uint32_t StructureByteStride = 0;
  uint64_t CounterOffsetInBytes = 0;  // must be 0: append counters are not supported
  BufferUavFlags Flags = BufferUavFlags::kNone;
};
struct Tex1DUav {
  uint32_t MipSlice = 0;
};
struct Tex1DArrayUav {
  uint32_t MipSlice = 0;
  uint32_t FirstArraySlice = 0;
  uint32_t ArraySize = 0xFFFFFFFFu;
};
struct Tex2DUav {
  uint32_t MipSlice = 0;
  uint32_t PlaneSlice = 0;
};
struct Tex2DArrayUav {
  uint32_t MipSlice = 0;
  uint32_t FirstArraySlice = 0;
  uint32_t ArraySize = 0xFFFFFFFFu;
  uint32_t PlaneSlice = 0;
};
struct Tex3DUav {
  uint32_t MipSlice = 0;
  uint32_t FirstWSlice = 0;
  uint32_t WSize = 0xFFFFFFFFu;
};

struct UnorderedAccessViewDesc {
  rtapi::Format Format = rtapi::Format::kUnknown;
  UavDimension ViewDimension = UavDimension::kUnknown;
  BufferUav Buffer = {};
  Tex1DUav Texture1D = {};
  Tex1DArrayUav Texture1DArray = {};
  Tex2DUav Texture2D = {};
  Tex2DArrayUav Texture2DArray = {};
  Tex3DUav Texture3D = {};
};

struct ConstantBufferViewDesc {
  GpuVirtualAddress BufferLocation = 0;  // 256-byte aligned; 0: null view
  uint32_t SizeInBytes = 0;              // a multiple of 256, at most 65536
};

// ---------------------------------------------------------------------------------------------
// Samplers

enum class Filter : uint32_t {
  kMinMagMipPoint = 0,
  kMinMagPointMipLinear = 0x1,
  kMinPointMagLinearMipPoint = 0x4,
  kMinPointMagMipLinear = 0x5,
  kMinLinearMagMipPoint = 0x10,
  kMinLinearMagPointMipLinear = 0x11,
  kMinMagLinearMipPoint = 0x14,
  kMinMagMipLinear = 0x15,
  kAnisotropic = 0x55,
  kComparisonMinMagMipPoint = 0x80,
  kComparisonMinMagPointMipLinear = 0x81,
  kComparisonMinPointMagLinearMipPoint = 0x84,
  kComparisonMinPointMagMipLinear = 0x85,
  kComparisonMinLinearMagMipPoint = 0x90,
  kComparisonMinLinearMagPointMipLinear = 0x91,
  kComparisonMinMagLinearMipPoint = 0x94,
  kComparisonMinMagMipLinear = 0x95,
  kComparisonAnisotropic = 0xD5,
  kMinimumMinMagMipPoint = 0x100,
  kMinimumMinMagMipLinear = 0x115,
  kMaximumMinMagMipPoint = 0x180,
  kMaximumMinMagMipLinear = 0x195,
};

enum class TextureAddressMode : uint32_t {
  kWrap = 1,
  kMirror = 2,
  kClamp = 3,
  kBorder = 4,
  kMirrorOnce = 5,
};

enum class ComparisonFunc : uint32_t {
  kNone = 0,
  kNever = 1,
  kLess = 2,
  kEqual = 3,
  kLessEqual = 4,
  kGreater = 5,
  kNotEqual = 6,
  kGreaterEqual = 7,
  kAlways = 8,
};

enum class StaticBorderColor : uint32_t {
  kTransparentBlack = 0,
  kOpaqueBlack = 1,
  kOpaqueWhite = 2,
};

inline constexpr float kFloat32Max = 3.402823466e+38f;

struct SamplerDesc {
  rtapi::Filter Filter = rtapi::Filter::kMinMagMipLinear;
  TextureAddressMode AddressU = TextureAddressMode::kWrap;
  TextureAddressMode AddressV = TextureAddressMode::kWrap;
  TextureAddressMode AddressW = TextureAddressMode::kWrap;
  float MipLODBias = 0;        // -16 .. 15.99
  uint32_t MaxAnisotropy = 1;  // 0 .. 16; counts for anisotropic filters
  rtapi::ComparisonFunc ComparisonFunc = rtapi::ComparisonFunc::kNever;
  float BorderColor[4] = {0, 0, 0, 0};
  float MinLOD = 0;
  float MaxLOD = kFloat32Max;
};

}  // namespace rtapi

// SPDX-License-Identifier: MIT
/// @file
/// Descriptor heaps, views and samplers.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <rtapi/types.h>

namespace rtapi {

namespace detail {
struct DescriptorHeapImpl;
}

/// The kind of descriptors that a heap holds. [D3D12: D3D12_DESCRIPTOR_HEAP_TYPE]
enum class DescriptorHeapType : uint32_t {
  kCbvSrvUav = 0,
  kSampler = 1,
  kRtv = 2,  ///< render target views; never shader-visible
  kDsv = 3,  ///< depth-stencil views; never shader-visible
};
/// Tells whether shaders see a heap. [D3D12: D3D12_DESCRIPTOR_HEAP_FLAGS]
enum class DescriptorHeapFlags : uint32_t { kNone = 0, kShaderVisible = 1 };
template <>
inline constexpr bool kIsFlags<DescriptorHeapFlags> = true;

/// Describes a heap for Device::CreateDescriptorHeap. [D3D12: D3D12_DESCRIPTOR_HEAP_DESC]
struct DescriptorHeapDesc {
  DescriptorHeapType Type = DescriptorHeapType::kCbvSrvUav;  ///< what it holds
  /// 1 to 1,000,000; shader-visible sampler heaps: to 2048.
  uint32_t NumDescriptors = 0;
  DescriptorHeapFlags Flags = DescriptorHeapFlags::kNone;  ///< kShaderVisible, to be set on a list
  std::string Name = {};                                   ///< for messages
};

/// An array of slots of 32 bytes, all null descriptors at first. A copyable handle; the slots live
/// as long as a handle, a list that has the heap set, or a recorded dispatch refers to them.
/// [D3D12: ID3D12DescriptorHeap]
class DescriptorHeap {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same heap.
  ///@{
  DescriptorHeap() = default;
  explicit DescriptorHeap(std::shared_ptr<detail::DescriptorHeapImpl> impl)
      : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const DescriptorHeap&) const = default;
  ///@}

  /// Returns the desc that the heap was created with; a default desc for an empty handle.
  const DescriptorHeapDesc& GetDesc() const;
  /// Slot 0 for the host to write; 0 for an empty handle.
  /// [D3D12: GetCPUDescriptorHandleForHeapStart]
  CpuDescriptorHandle GetCPUDescriptorHandleForHeapStart() const;
  /// Slot 0 for root arguments and shader records; 0 unless the heap is shader-visible.
  /// [D3D12: GetGPUDescriptorHandleForHeapStart]
  GpuDescriptorHandle GetGPUDescriptorHandleForHeapStart() const;
  /// Slot `index`, 0 to NumDescriptors - 1, which is not checked here.
  CpuDescriptorHandle GetCPUDescriptorHandle(uint32_t index) const {
    return GetCPUDescriptorHandleForHeapStart().Offset(index);
  }
  /// Slot `index` of a shader-visible heap, 0 to NumDescriptors - 1, which is not checked here.
  GpuDescriptorHandle GetGPUDescriptorHandle(uint32_t index) const {
    return GetGPUDescriptorHandleForHeapStart().Offset(index);
  }
  /// For the library itself.
  const std::shared_ptr<detail::DescriptorHeapImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::DescriptorHeapImpl> impl_;
};

// ---------------------------------------------------------------------------------------------
// Shader resource views

/// The kind of resource that a shader resource view looks at, and so the member of
/// ShaderResourceViewDesc that counts. [D3D12: D3D12_SRV_DIMENSION; DXR: Additional SRV type]
enum class SrvDimension : uint32_t {
  kUnknown = 0,
  kBuffer = 1,
  kTexture1D = 2,
  kTexture1DArray = 3,
  kTexture2D = 4,
  kTexture2DArray = 5,
  kTexture2DMS = 6,
  kTexture2DMSArray = 7,
  kTexture3D = 8,
  kTextureCube = 9,
  kTextureCubeArray = 10,
  kRaytracingAccelerationStructure = 11,
};

/// kRaw: the buffer is a ByteAddressBuffer. [D3D12: D3D12_BUFFER_SRV_FLAGS]
enum class BufferSrvFlags : uint32_t { kNone = 0, kRaw = 1 };
template <>
inline constexpr bool kIsFlags<BufferSrvFlags> = true;

/// A view of a buffer, of one of three kinds. Structured: StructureByteStride is not 0, Format is
/// kUnknown. Raw: kRaw is set, Format is kR32Typeless, elements have 4 bytes, and the view starts
/// at a multiple of 16 bytes. Typed: neither, and Format is one that the backend supports.
/// [D3D12: D3D12_BUFFER_SRV]
struct BufferSrv {
  uint64_t FirstElement = 0;         ///< in elements, not bytes
  uint32_t NumElements = 0;          ///< 0: to the end of the buffer
  uint32_t StructureByteStride = 0;  ///< bytes: a multiple of 2 up to 2048; 0: not structured
  BufferSrvFlags Flags = BufferSrvFlags::kNone;  ///< kRaw or none
};
/// Mip levels of a 1-D texture. [D3D12: D3D12_TEX1D_SRV]
struct Tex1DSrv {
  uint32_t MostDetailedMip = 0;      ///< the level that shaders know as 0
  uint32_t MipLevels = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the chain
  float ResourceMinLODClamp = 0;     ///< see Tex2DSrv::ResourceMinLODClamp
};
/// Mip levels and elements of a 1-D texture array. [D3D12: D3D12_TEX1D_ARRAY_SRV]
struct Tex1DArraySrv {
  uint32_t MostDetailedMip = 0;      ///< the level that shaders know as 0
  uint32_t MipLevels = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the chain
  uint32_t FirstArraySlice = 0;      ///< the element that shaders know as 0
  uint32_t ArraySize = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the array
  float ResourceMinLODClamp = 0;     ///< see Tex2DSrv::ResourceMinLODClamp
};
/// Mip levels of a 2-D texture. [D3D12: D3D12_TEX2D_SRV]
struct Tex2DSrv {
  uint32_t MostDetailedMip = 0;      ///< the level that shaders know as 0
  uint32_t MipLevels = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the chain
  uint32_t PlaneSlice = 0;           ///< ignored: the format says which plane
  /// The finest level that may be read, counted in the texture's mips, in steps of 1/256: sampling
  /// stays at or above it, loads of a whole level below are out of bounds, and a level past the
  /// view's last makes it a null view. The first two need VK_EXT_image_view_min_lod on Vulkan,
  /// which lavapipe lacks.
  float ResourceMinLODClamp = 0;
};
/// Mip levels and elements of a 2-D texture array. [D3D12: D3D12_TEX2D_ARRAY_SRV]
struct Tex2DArraySrv {
  uint32_t MostDetailedMip = 0;      ///< the level that shaders know as 0
  uint32_t MipLevels = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the chain
  uint32_t FirstArraySlice = 0;      ///< the element that shaders know as 0
  uint32_t ArraySize = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the array
  uint32_t PlaneSlice = 0;           ///< ignored: the format says which plane
  float ResourceMinLODClamp = 0;     ///< see Tex2DSrv::ResourceMinLODClamp
};
/// Elements of a multisampled texture array. [D3D12: D3D12_TEX2DMS_ARRAY_SRV]
struct Tex2DMSArraySrv {
  uint32_t FirstArraySlice = 0;      ///< the element that shaders know as 0
  uint32_t ArraySize = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the array
};
/// Mip levels of a 3-D texture. [D3D12: D3D12_TEX3D_SRV]
struct Tex3DSrv {
  uint32_t MostDetailedMip = 0;      ///< the level that shaders know as 0
  uint32_t MipLevels = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the chain
  float ResourceMinLODClamp = 0;     ///< see Tex2DSrv::ResourceMinLODClamp
};
/// The first six elements of a square 2-D texture as a cube. [D3D12: D3D12_TEXCUBE_SRV]
struct TexCubeSrv {
  uint32_t MostDetailedMip = 0;      ///< the level that shaders know as 0
  uint32_t MipLevels = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the chain
  float ResourceMinLODClamp = 0;     ///< see Tex2DSrv::ResourceMinLODClamp
};
/// Elements of a square 2-D texture array as cubes of six. [D3D12: D3D12_TEXCUBE_ARRAY_SRV]
struct TexCubeArraySrv {
  uint32_t MostDetailedMip = 0;      ///< the level that shaders know as 0
  uint32_t MipLevels = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the chain
  uint32_t First2DArrayFace = 0;     ///< the array element that is face 0 of cube 0
  uint32_t NumCubes = 0xFFFFFFFFu;   ///< at least 1; ~0: as many as the array still holds
  float ResourceMinLODClamp = 0;     ///< see Tex2DSrv::ResourceMinLODClamp
};
/// A top-level acceleration structure. [DXR: Additional SRV type]
struct RaytracingAccelerationStructureSrv {
  /// A multiple of 256 in a live buffer. 0: a null structure, which every ray misses.
  GpuVirtualAddress Location = 0;
};

/// Describes a view for Device::CreateShaderResourceView. ViewDimension says which of the members
/// after Shader4ComponentMapping counts.
/// [D3D12: D3D12_SHADER_RESOURCE_VIEW_DESC]
struct ShaderResourceViewDesc {
  /// Textures: the texture's own format, which kUnknown stands for, or a typed one of its family;
  /// FLOAT for FLOAT, and no SNORM for UNORM, unless it is typeless. Buffers: see BufferSrv.
  rtapi::Format Format = rtapi::Format::kUnknown;
  SrvDimension ViewDimension = SrvDimension::kUnknown;  ///< goes with the resource
  /// Textures: 3 bits for each component that a shader sees, red lowest: 0 to 3 is a component of
  /// the texture, 4 is zero, 5 is one. [D3D12: D3D12_ENCODE_SHADER_4_COMPONENT_MAPPING]
  uint32_t Shader4ComponentMapping = kDefaultShader4ComponentMapping;
  /// The part of the resource that the view looks at.
  ///@{
  BufferSrv Buffer = {};
  Tex1DSrv Texture1D = {};
  Tex1DArraySrv Texture1DArray = {};
  Tex2DSrv Texture2D = {};
  Tex2DArraySrv Texture2DArray = {};
  Tex2DMSArraySrv Texture2DMSArray = {};  ///< kTexture2DMS has no part: it is element 0
  Tex3DSrv Texture3D = {};
  TexCubeSrv TextureCube = {};
  TexCubeArraySrv TextureCubeArray = {};
  RaytracingAccelerationStructureSrv RaytracingAccelerationStructure = {};
  ///@}
};

// ---------------------------------------------------------------------------------------------
// Unordered access views

/// The kind of resource that an unordered access view looks at, and so the member of
/// UnorderedAccessViewDesc that counts. [D3D12: D3D12_UAV_DIMENSION]
enum class UavDimension : uint32_t {
  kUnknown = 0,
  kBuffer = 1,
  kTexture1D = 2,
  kTexture1DArray = 3,
  kTexture2D = 4,
  kTexture2DArray = 5,
  kTexture3D = 8,
};

/// kRaw: the buffer is a RWByteAddressBuffer. [D3D12: D3D12_BUFFER_UAV_FLAGS]
enum class BufferUavFlags : uint32_t { kNone = 0, kRaw = 1 };
template <>
inline constexpr bool kIsFlags<BufferUavFlags> = true;

/// A view of a buffer: structured, raw or typed, by the rules of BufferSrv.
/// [D3D12: D3D12_BUFFER_UAV]
struct BufferUav {
  uint64_t FirstElement = 0;          ///< in elements, not bytes
  uint32_t NumElements = 0;           ///< 0: to the end of the buffer
  uint32_t StructureByteStride = 0;   ///< bytes: a multiple of 2 up to 2048; 0: not structured
  uint64_t CounterOffsetInBytes = 0;  ///< of the counter in its buffer: a multiple of 4096
  BufferUavFlags Flags = BufferUavFlags::kNone;  ///< kRaw or none
};
/// One mip level of a 1-D texture. [D3D12: D3D12_TEX1D_UAV]
struct Tex1DUav {
  uint32_t MipSlice = 0;  ///< the level
};
/// One mip level of some elements of a 1-D texture array. [D3D12: D3D12_TEX1D_ARRAY_UAV]
struct Tex1DArrayUav {
  uint32_t MipSlice = 0;             ///< the level
  uint32_t FirstArraySlice = 0;      ///< the element that shaders know as 0
  uint32_t ArraySize = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the array
};
/// One mip level of a 2-D texture. [D3D12: D3D12_TEX2D_UAV]
struct Tex2DUav {
  uint32_t MipSlice = 0;    ///< the level
  uint32_t PlaneSlice = 0;  ///< ignored: the format says which plane
};
/// One mip level of some elements of a 2-D texture array. [D3D12: D3D12_TEX2D_ARRAY_UAV]
struct Tex2DArrayUav {
  uint32_t MipSlice = 0;             ///< the level
  uint32_t FirstArraySlice = 0;      ///< the element that shaders know as 0
  uint32_t ArraySize = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end of the array
  uint32_t PlaneSlice = 0;           ///< ignored: the format says which plane
};
/// One mip level of a 3-D texture. [D3D12: D3D12_TEX3D_UAV]
struct Tex3DUav {
  uint32_t MipSlice = 0;         ///< the level
  uint32_t FirstWSlice = 0;      ///< the depth that shaders know as 0; Vulkan: only 0 (KA0961)
  uint32_t WSize = 0xFFFFFFFFu;  ///< at least 1; ~0: to the end; Vulkan: only all of them (KA0961)
};

/// Describes a view for Device::CreateUnorderedAccessView. ViewDimension says which of the members
/// after it counts. [D3D12: D3D12_UNORDERED_ACCESS_VIEW_DESC]
struct UnorderedAccessViewDesc {
  /// As in ShaderResourceViewDesc; the backend must support it for unordered access.
  rtapi::Format Format = rtapi::Format::kUnknown;
  UavDimension ViewDimension = UavDimension::kUnknown;  ///< goes with the resource
  /// The part of the resource that the view looks at.
  ///@{
  BufferUav Buffer = {};
  Tex1DUav Texture1D = {};
  Tex1DArrayUav Texture1DArray = {};
  Tex2DUav Texture2D = {};
  Tex2DArrayUav Texture2DArray = {};
  Tex3DUav Texture3D = {};
  ///@}
};

/// Describes a view for Device::CreateConstantBufferView.
/// [D3D12: D3D12_CONSTANT_BUFFER_VIEW_DESC]
struct ConstantBufferViewDesc {
  GpuVirtualAddress BufferLocation = 0;  ///< a multiple of 256 in a live buffer; 0: a null view
  uint32_t SizeInBytes = 0;              ///< a multiple of 256 up to 65536, all in that buffer
};

// ---------------------------------------------------------------------------------------------
// Samplers

/// The way in which a sampler filters: when the texture is reduced (min), enlarged (mag), and
/// between mip levels. Comparison filters serve SampleCmp; minimum and maximum filters return the
/// least or the largest of the texels that have a weight. Any other combination of D3D12_FILTER's
/// bits is accepted too. [D3D12: D3D12_FILTER]
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

/// The way in which a texture continues beyond its edges. [D3D12: D3D12_TEXTURE_ADDRESS_MODE]
enum class TextureAddressMode : uint32_t {
  kWrap = 1,
  kMirror = 2,
  kClamp = 3,
  kBorder = 4,
  kMirrorOnce = 5,
};

/// The function by which a comparison sampler compares the reference value with a texel.
/// [D3D12: D3D12_COMPARISON_FUNC]
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

/// Border colour of a static sampler. [D3D12: D3D12_STATIC_BORDER_COLOR]
enum class StaticBorderColor : uint32_t {
  kTransparentBlack = 0,
  kOpaqueBlack = 1,
  kOpaqueWhite = 2,
  kOpaqueBlackUint = 3,  ///< the integers 0, 0, 0, 1
  kOpaqueWhiteUint = 4,  ///< the integers 1, 1, 1, 1
};

/// How a static sampler reads. [D3D12: D3D12_SAMPLER_FLAGS]
enum class SamplerFlags : uint32_t {
  kNone = 0,
  kUintBorderColor = 0x1,  ///< BorderColor is of integers, for textures of integers
};
template <>
inline constexpr bool kIsFlags<SamplerFlags> = true;

/// The largest finite float: a MaxLOD without effect. [D3D12: D3D12_FLOAT32_MAX]
inline constexpr float kFloat32Max = 3.402823466e+38f;

/// Describes a sampler for Device::CreateSampler. [D3D12: D3D12_SAMPLER_DESC]
struct SamplerDesc {
  rtapi::Filter Filter = rtapi::Filter::kMinMagMipLinear;  ///< how texels are mixed
  /// The way in which the texture continues beyond its edges, along each axis.
  ///@{
  TextureAddressMode AddressU = TextureAddressMode::kWrap;
  TextureAddressMode AddressV = TextureAddressMode::kWrap;
  TextureAddressMode AddressW = TextureAddressMode::kWrap;
  ///@}
  float MipLODBias = 0;        ///< added to the level of detail: -16 to 15.99
  uint32_t MaxAnisotropy = 1;  ///< 0 to 16; for anisotropic filters
  /// For comparison filters.
  rtapi::ComparisonFunc ComparisonFunc = rtapi::ComparisonFunc::kNever;
  float BorderColor[4] = {0, 0, 0, 0};  ///< red, green, blue, alpha for kBorder; no NaN
  /// The range of the level of detail; no NaN.
  ///@{
  float MinLOD = 0;
  float MaxLOD = kFloat32Max;
  ///@}
};

}  // namespace rtapi

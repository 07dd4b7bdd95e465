// SPDX-License-Identifier: MIT
/// @file
/// Root signatures, version 1.2: what root arguments there are and which registers they feed.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include <rtapi/descriptor.h>
#include <rtapi/result.h>
#include <rtapi/types.h>

namespace rtapi {

namespace detail {
struct RootSignatureImpl;
}

/// The kind of registers that a range feeds: t, u, b or s. [D3D12: D3D12_DESCRIPTOR_RANGE_TYPE]
enum class DescriptorRangeType : uint32_t { kSrv = 0, kUav = 1, kCbv = 2, kSampler = 3 };

/// Promises that a driver may rely on about descriptors and their data. Accepted and without
/// effect. [D3D12: D3D12_DESCRIPTOR_RANGE_FLAGS]
enum class DescriptorRangeFlags : uint32_t {
  kNone = 0,
  kDescriptorsVolatile = 0x1,
  kDataVolatile = 0x2,
  kDataStaticWhileSetAtExecute = 0x4,
  kDataStatic = 0x8,
  kDescriptorsStaticKeepingBufferBoundsChecks = 0x10000,
};
template <>
inline constexpr bool kIsFlags<DescriptorRangeFlags> = true;

/// Successive registers that successive descriptors of a table feed (KA0607).
/// [D3D12: D3D12_DESCRIPTOR_RANGE1]
struct DescriptorRange {
  DescriptorRangeType RangeType = DescriptorRangeType::kSrv;  ///< which registers
  uint32_t NumDescriptors = 1;      ///< at least 1; kUnboundedDescriptors: no end
  uint32_t BaseShaderRegister = 0;  ///< the first register
  uint32_t RegisterSpace = 0;       ///< up to 0xFFFFFFEF; those above are reserved (KA0605)
  DescriptorRangeFlags Flags = DescriptorRangeFlags::kNone;  ///< without effect
  /// Descriptors from the start of the table; kDescriptorRangeOffsetAppend: right behind the range
  /// before, which then must not be unbounded.
  uint32_t OffsetInDescriptorsFromTableStart = kDescriptorRangeOffsetAppend;
};

/// A descriptor table: the argument is the handle of its first descriptor.
/// [D3D12: D3D12_ROOT_DESCRIPTOR_TABLE1]
struct RootDescriptorTable {
  /// At least one; samplers and views do not mix in a table (KA0606).
  std::vector<DescriptorRange> Ranges = {};
};

/// Constants that a constant buffer register reads from the root arguments.
/// [D3D12: D3D12_ROOT_CONSTANTS]
struct RootConstants {
  uint32_t ShaderRegister = 0;  ///< b register
  uint32_t RegisterSpace = 0;   ///< up to 0xFFFFFFEF (KA0605)
  uint32_t Num32BitValues = 0;  ///< at least 1 (KA0609)
};

/// Promises that a driver may rely on about a root descriptor's data. Accepted and without effect.
/// [D3D12: D3D12_ROOT_DESCRIPTOR_FLAGS]
enum class RootDescriptorFlags : uint32_t {
  kNone = 0,
  kDataVolatile = 0x2,
  kDataStaticWhileSetAtExecute = 0x4,
  kDataStatic = 0x8,
};
template <>
inline constexpr bool kIsFlags<RootDescriptorFlags> = true;

/// A root CBV, SRV or UAV: the argument is an address. It serves constant buffers, raw and
/// structured buffers and acceleration structures; textures and typed buffers need a table
/// (KA0529). Of an array without a size it is element 0, and the others are null; one with a size
/// needs a table (KA0529). [D3D12: D3D12_ROOT_DESCRIPTOR1]
struct RootDescriptor {
  uint32_t ShaderRegister = 0;                             ///< b, t or u register
  uint32_t RegisterSpace = 0;                              ///< up to 0xFFFFFFEF (KA0605)
  RootDescriptorFlags Flags = RootDescriptorFlags::kNone;  ///< without effect
};

/// The kind of root parameter. [D3D12: D3D12_ROOT_PARAMETER_TYPE]
enum class RootParameterType : uint32_t {
  kDescriptorTable = 0,  ///< DescriptorTable counts
  k32BitConstants = 1,   ///< Constants counts
  kCbv = 2,              ///< Descriptor counts
  kSrv = 3,              ///< Descriptor counts
  kUav = 4,              ///< Descriptor counts
};

/// The shaders that see a parameter. Compute and ray tracing shaders see only those with kAll.
/// [D3D12: D3D12_SHADER_VISIBILITY; DXR: Note on shader visibility]
enum class ShaderVisibility : uint32_t {
  kAll = 0,
  kVertex = 1,
  kHull = 2,
  kDomain = 3,
  kGeometry = 4,
  kPixel = 5,
  kAmplification = 6,
  kMesh = 7,
};

/// One root parameter, or one parameter of a shader record in a local root signature. The static
/// functions make the usual ones. [D3D12: D3D12_ROOT_PARAMETER1]
struct RootParameter {
  RootParameterType ParameterType = RootParameterType::kDescriptorTable;  ///< which member counts
  /// The parameter by its type.
  ///@{
  RootDescriptorTable DescriptorTable = {};
  RootConstants Constants = {};
  RootDescriptor Descriptor = {};
  ///@}
  /// The shaders that see it; in a local root signature kAll (KA0603).
  rtapi::ShaderVisibility ShaderVisibility = rtapi::ShaderVisibility::kAll;

  /// A descriptor table. It costs 1 DWORD, in a shader record 8 bytes.
  static RootParameter Table(std::vector<DescriptorRange> ranges) {
    RootParameter p;
    p.DescriptorTable.Ranges = std::move(ranges);
    return p;
  }
  /// `num_values` 32-bit constants for register `b<shader_register>`. Each costs 1 DWORD.
  static RootParameter Constants32(uint32_t num_values, uint32_t shader_register,
                                   uint32_t space = 0) {
    RootParameter p;
    p.ParameterType = RootParameterType::k32BitConstants;
    p.Constants = {shader_register, space, num_values};
    return p;
  }
  /// A root CBV for register `b<shader_register>`. It costs 2 DWORDs.
  static RootParameter Cbv(uint32_t shader_register, uint32_t space = 0) {
    return Root(RootParameterType::kCbv, shader_register, space);
  }
  /// A root SRV for register `t<shader_register>`: a buffer or an acceleration structure. It costs
  /// 2 DWORDs.
  static RootParameter Srv(uint32_t shader_register, uint32_t space = 0) {
    return Root(RootParameterType::kSrv, shader_register, space);
  }
  /// A root UAV for register `u<shader_register>`. It costs 2 DWORDs.
  static RootParameter Uav(uint32_t shader_register, uint32_t space = 0) {
    return Root(RootParameterType::kUav, shader_register, space);
  }

 private:
  static RootParameter Root(RootParameterType type, uint32_t shader_register, uint32_t space) {
    RootParameter p;
    p.ParameterType = type;
    p.Descriptor = {shader_register, space, RootDescriptorFlags::kNone};
    return p;
  }
};

/// A sampler that is part of the root signature and takes no argument (KA0610). The members are
/// those of SamplerDesc, by its rules. An array without a size of samplers in a shader may start at
/// its register: whatever the index, it reads this sampler. One with a size may not (KA0529).
/// [D3D12: D3D12_STATIC_SAMPLER_DESC1]
struct StaticSamplerDesc {
  rtapi::Filter Filter = rtapi::Filter::kAnisotropic;  ///< how texels are mixed
  /// The way in which the texture continues beyond its edges, along each axis.
  ///@{
  TextureAddressMode AddressU = TextureAddressMode::kWrap;
  TextureAddressMode AddressV = TextureAddressMode::kWrap;
  TextureAddressMode AddressW = TextureAddressMode::kWrap;
  ///@}
  float MipLODBias = 0;         ///< added to the level of detail: -16 to 15.99
  uint32_t MaxAnisotropy = 16;  ///< 0 to 16; for anisotropic filters
  /// For comparison filters.
  rtapi::ComparisonFunc ComparisonFunc = rtapi::ComparisonFunc::kLessEqual;
  StaticBorderColor BorderColor = StaticBorderColor::kOpaqueWhite;  ///< for kBorder
  /// The range of the level of detail; no NaN.
  ///@{
  float MinLOD = 0;
  float MaxLOD = kFloat32Max;
  ///@}
  uint32_t ShaderRegister = 0;  ///< s register
  uint32_t RegisterSpace = 0;   ///< up to 0xFFFFFFEF (KA0605)
  /// The shaders that see it; in a local root signature kAll (KA0603).
  rtapi::ShaderVisibility ShaderVisibility = rtapi::ShaderVisibility::kAll;
  SamplerFlags Flags = SamplerFlags::kNone;  ///< version 1.2 of root signatures
};

/// Flags that say what a root signature is for. Those of stages that do not exist here are without
/// effect. [D3D12: D3D12_ROOT_SIGNATURE_FLAGS]
enum class RootSignatureFlags : uint32_t {
  kNone = 0,
  kAllowInputAssemblerInputLayout = 0x1,  ///< needed by pipelines with an InputLayout
  kDenyVertexShaderRootAccess = 0x2,      ///< the vertex shader has no resources
  kDenyHullShaderRootAccess = 0x4,
  kDenyDomainShaderRootAccess = 0x8,
  kDenyGeometryShaderRootAccess = 0x10,
  kDenyPixelShaderRootAccess = 0x20,  ///< the pixel shader has no resources
  kAllowStreamOutput = 0x40,
  kLocalRootSignature = 0x80,  ///< with no other flag (KA0602)
  kDenyAmplificationShaderRootAccess = 0x100,
  kDenyMeshShaderRootAccess = 0x200,
  kCbvSrvUavHeapDirectlyIndexed = 0x400,  ///< shaders may use ResourceDescriptorHeap
  kSamplerHeapDirectlyIndexed = 0x800,    ///< shaders may use SamplerDescriptorHeap
};
template <>
inline constexpr bool kIsFlags<RootSignatureFlags> = true;

/// Describes a root signature for Device::CreateRootSignature, which checks it. No register may be
/// fed twice for one stage (KA0604). A global one costs up to 64 DWORDs (KA0600); the arguments of
/// a local one take up to 4064 bytes (KA0601). [D3D12: D3D12_ROOT_SIGNATURE_DESC1]
struct RootSignatureDesc {
  std::vector<RootParameter> Parameters = {};            ///< by their index calls set them
  std::vector<StaticSamplerDesc> StaticSamplers = {};    ///< take no arguments
  RootSignatureFlags Flags = RootSignatureFlags::kNone;  ///< kLocalRootSignature: a local one
};

/// Parses HLSL's root signature language, with keywords in any case, e.g. "RootFlags(0), CBV(b0),
/// DescriptorTable(SRV(t0, numDescriptors = unbounded))". Only the form is checked; the rules are,
/// when Device::CreateRootSignature takes the result. [HLSL: Specifying root signatures]
/// @errors KA0608 names the column, from 1, and what was expected there.
Result<RootSignatureDesc> ParseRootSignature(std::string_view text);

/// Checks a description as Device::CreateRootSignature does, without a device.
/// [D3D12: D3D12SerializeRootSignature]
/// @errors KA0600 to KA0607, KA0609 and KA0610, as of Device::CreateRootSignature
Status CheckRootSignature(const RootSignatureDesc& desc);

/// Describes what arguments there are: global ones set on a command list, local ones in shader
/// records. A copyable handle; state objects, pipelines, command signatures and lists keep what
/// they use alive. [D3D12: ID3D12RootSignature; DXR: Local root signatures vs global root
/// signatures]
class RootSignature {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same object.
  ///@{
  RootSignature() = default;
  explicit RootSignature(std::shared_ptr<const detail::RootSignatureImpl> impl)
      : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const RootSignature&) const = default;
  ///@}

  /// Returns the desc that the signature was created with, appended ranges with the offsets that
  /// they got. A default desc for an empty handle.
  const RootSignatureDesc& GetDesc() const;
  /// True for a local root signature; false for an empty handle.
  bool is_local() const;
  /// Returns where the argument of a parameter starts, in bytes. Local ones: from the end of the
  /// identifier, i.e. from byte 32 of the record. Constants lie at multiples of 4; everything else
  /// takes 8 bytes at multiples of 8. 0 for a parameter that does not exist, and for an empty
  /// handle. [DXR: Shader table memory initialization]
  uint32_t GetArgumentOffset(uint32_t parameter_index) const;
  /// Bytes of all arguments, without padding at the end; 0 for an empty handle. A shader record
  /// takes 32 more. [DXR: Shader table memory initialization]
  uint32_t GetArgumentBytes() const;

  /// For the library itself.
  const std::shared_ptr<const detail::RootSignatureImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<const detail::RootSignatureImpl> impl_;
};

}  // namespace rtapi

// SPDX-License-Identifier: MIT
//
// Root signatures, version 1.1: what root arguments there are and which registers they feed.
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

enum class DescriptorRangeType : uint32_t { kSrv = 0, kUav = 1, kCbv = 2, kSampler = 3 };

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

struct DescriptorRange {
  DescriptorRangeType RangeType = DescriptorRangeType::kSrv;
  uint32_t NumDescriptors = 1;  // kUnboundedDescriptors: no end
  uint32_t BaseShaderRegister = 0;
  uint32_t RegisterSpace = 0;
  DescriptorRangeFlags Flags = DescriptorRangeFlags::kNone;
  // Descriptors from the start of the table; append: right after the range before.
  uint32_t OffsetInDescriptorsFromTableStart = kDescriptorRangeOffsetAppend;
};

struct RootDescriptorTable {
  std::vector<DescriptorRange> Ranges = {};
};

struct RootConstants {
  uint32_t ShaderRegister = 0;
  uint32_t RegisterSpace = 0;
  uint32_t Num32BitValues = 0;
};

enum class RootDescriptorFlags : uint32_t {
  kNone = 0,
  kDataVolatile = 0x2,
  kDataStaticWhileSetAtExecute = 0x4,
  kDataStatic = 0x8,
};
template <>
inline constexpr bool kIsFlags<RootDescriptorFlags> = true;

struct RootDescriptor {
  uint32_t ShaderRegister = 0;
  uint32_t RegisterSpace = 0;
  RootDescriptorFlags Flags = RootDescriptorFlags::kNone;
};

enum class RootParameterType : uint32_t {
  kDescriptorTable = 0,
  k32BitConstants = 1,
  kCbv = 2,
  kSrv = 3,
  kUav = 4,
};

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

// One of the three members counts, by ParameterType.
struct RootParameter {
  RootParameterType ParameterType = RootParameterType::kDescriptorTable;
  RootDescriptorTable DescriptorTable = {};
  RootConstants Constants = {};
  RootDescriptor Descriptor = {};
  rtapi::ShaderVisibility ShaderVisibility = rtapi::ShaderVisibility::kAll;

  static RootParameter Table(std::vector<DescriptorRange> ranges) {
    RootParameter p;
    p.DescriptorTable.Ranges = std::move(ranges);
    return p;
  }
  static RootParameter Constants32(uint32_t num_values, uint32_t shader_register,
                                   uint32_t space = 0) {
    RootParameter p;
    p.ParameterType = RootParameterType::k32BitConstants;
    p.Constants = {shader_register, space, num_values};
    return p;
  }
  static RootParameter Cbv(uint32_t shader_register, uint32_t space = 0) {
    return Root(RootParameterType::kCbv, shader_register, space);
  }
  static RootParameter Srv(uint32_t shader_register, uint32_t space = 0) {
    return Root(RootParameterType::kSrv, shader_register, space);
  }
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

struct StaticSamplerDesc {
  rtapi::Filter Filter = rtapi::Filter::kAnisotropic;
  TextureAddressMode AddressU = TextureAddressMode::kWrap;
  TextureAddressMode AddressV = TextureAddressMode::kWrap;
  TextureAddressMode AddressW = TextureAddressMode::kWrap;
  float MipLODBias = 0;
  uint32_t MaxAnisotropy = 16;
  rtapi::ComparisonFunc ComparisonFunc = rtapi::ComparisonFunc::kLessEqual;
  StaticBorderColor BorderColor = StaticBorderColor::kOpaqueWhite;
  float MinLOD = 0;
  float MaxLOD = kFloat32Max;
  uint32_t ShaderRegister = 0;
  uint32_t RegisterSpace = 0;
  rtapi::ShaderVisibility ShaderVisibility = rtapi::ShaderVisibility::kAll;
};

enum class RootSignatureFlags : uint32_t {
  kNone = 0,
  kAllowInputAssemblerInputLayout = 0x1,
  kDenyVertexShaderRootAccess = 0x2,
  kDenyHullShaderRootAccess = 0x4,
  kDenyDomainShaderRootAccess = 0x8,
  kDenyGeometryShaderRootAccess = 0x10,
  kDenyPixelShaderRootAccess = 0x20,
  kAllowStreamOutput = 0x40,
  kLocalRootSignature = 0x80,  // with no other flag
  kDenyAmplificationShaderRootAccess = 0x100,
  kDenyMeshShaderRootAccess = 0x200,
  kCbvSrvUavHeapDirectlyIndexed = 0x400,
  kSamplerHeapDirectlyIndexed = 0x800,
};
template <>
inline constexpr bool kIsFlags<RootSignatureFlags> = true;

struct RootSignatureDesc {
  std::vector<RootParameter> Parameters = {};
  std::vector<StaticSamplerDesc> StaticSamplers = {};
  RootSignatureFlags Flags = RootSignatureFlags::kNone;
};

// Parses HLSL's root signature language, e.g. "RootFlags(0), CBV(b0), DescriptorTable(SRV(t0,
// numDescriptors = unbounded))". Errors name the column. [HLSL: Specifying root signatures]
Result<RootSignatureDesc> ParseRootSignature(std::string_view text);

class RootSignature {
 public:
  RootSignature() = default;
  explicit RootSignature(std::shared_ptr<const detail::RootSignatureImpl> impl)
      : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const RootSignature&) const = default;

  const RootSignatureDesc& GetDesc() const;
  bool is_local() const;
  // Where the arguments of a parameter lie. Local ones: bytes from the end of the identifier, i.e.
  // from byte 32 of the record; constants at multiples of 4, everything else 8 bytes at multiples
  // of 8. [DXR: Shader table memory initialization]
  uint32_t GetArgumentOffset(uint32_t parameter_index) const;
  // Bytes of all arguments, no padding at the end. A record takes 32 more.
  uint32_t GetArgumentBytes() const;

  const std::shared_ptr<const detail::RootSignatureImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<const detail::RootSignatureImpl> impl_;
};

}  // namespace rtapi

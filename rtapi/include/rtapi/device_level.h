// SPDX-License-Identifier: MIT
/// @file
/// The level of ray tracing and the shader model that a device has, and their names.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <rtapi/result.h>

namespace rtapi {

/// The level of ray tracing that a device has; DeviceDesc::Tier chooses. Each has what those below
/// it have. [DXR: D3D12_RAYTRACING_TIER]
enum class RaytracingTier : uint32_t {
  kNotSupported = 0,  ///< no structures, no ray tracing pipelines, no RayQuery (KA0545)
  kTier1_0 = 10,      ///< pipelines and shader tables
  /// RayQuery, the two skip flags of rays and pipelines, AddToStateObject, GeometryIndex, indirect
  /// DispatchRays and seven vertex formats.
  kTier1_1 = 11,
  kTier1_2 = 12,  ///< opacity micromaps, HitObject and MaybeReorderThread
  kTier2_0 =
      20,  ///< EXPERIMENTAL: clusters, partitioned top levels, indirect builds; not offered yet
};

/// The highest tier that this version has, on every backend.
inline constexpr RaytracingTier kHighestRaytracingTier = RaytracingTier::kTier1_2;

/// The highest shader model whose libraries a device takes; DeviceDesc::ShaderModel chooses.
/// [D3D12: D3D_SHADER_MODEL]
enum class ShaderModel : uint32_t {
  k6_0 = 0x60,
  k6_1 = 0x61,
  k6_2 = 0x62,
  k6_3 = 0x63,
  k6_4 = 0x64,
  k6_5 = 0x65,
  k6_6 = 0x66,
  k6_7 = 0x67,
  k6_8 = 0x68,
  k6_9 = 0x69,
  /// EXPERIMENTAL, since its specification still moves: TriangleObjectPositions, DebugBreak. A
  /// device has it only where it is asked for.
  k6_10 = 0x6A,
};

/// The highest shader model that is final, on every backend, and what a device has by default.
inline constexpr ShaderModel kHighestShaderModel = ShaderModel::k6_9;
/// EXPERIMENTAL: the highest one that a device can be asked for.
inline constexpr ShaderModel kExperimentalShaderModel = ShaderModel::k6_10;

/// Returns "none", "1.0", "1.1", "1.2" or "2.0"; "unknown" for a value of none of them.
const char* GetName(RaytracingTier tier);
/// Returns "6.0" to "6.10"; "unknown" for a value of none of them.
std::string GetName(ShaderModel model);

/// Reads a name that GetName gives, offered or not.
/// @errors KA0914 it is no name of a tier; the message lists them.
Result<RaytracingTier> ParseRaytracingTier(std::string_view name);
/// Reads a name that GetName gives, offered or not.
/// @errors KA0914 it is no name of a shader model; the message says which there are.
Result<ShaderModel> ParseShaderModel(std::string_view name);

}  // namespace rtapi

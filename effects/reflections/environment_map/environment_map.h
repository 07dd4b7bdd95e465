// SPDX-License-Identifier: MIT
/// @file
/// Environment maps: the light of a standing scene, seen from a few points, blurred by roughness.
/// [survey 6.2; Lagarde & Zanuttini 2012]
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "effects/engine/effect_pass.h"

namespace kaamos::effects {

/// Describes how the maps are made.
struct EnvironmentDesc {
  std::vector<EnvironmentProbe> probes;  ///< 1 to 64
  std::uint32_t side = 64;               ///< texels of a face: a power of two from 16 to 1024
  std::uint32_t rays = 4;                ///< of each texel, at least 1
  std::uint32_t directions = 256;        ///< that a texel of a blurred level is the mean of
};

/// EffectSettings::constants of make_environment_reflections.
struct EnvironmentConstants {
  std::uint32_t side = 64;         ///< EnvironmentDesc::side
  std::uint32_t rays = 4;          ///< EnvironmentDesc::rays
  std::uint32_t directions = 256;  ///< EnvironmentDesc::directions
  std::uint32_t probes = 4;        ///< that are found, at most, where the scene has none
};

/// Checks whether maps can be made as `desc` says.
/// @errors KA3070 a number out of its range, a box without an inside, or a probe that is no finite
/// point.
rtapi::Status check_environment(const EnvironmentDesc& desc);

/// Levels of a cube, the last for roughness 1.
inline constexpr std::uint32_t kEnvironmentLevels = 5;

/// The cubes of a scene. Copies share them.
class EnvironmentMap {
 public:
  /// Renders and blurs them. `scope` needs EffectNeeds::lights and EffectNeeds::volume; u20 and t5
  /// of its views are used meanwhile.
  /// @errors those of check_environment and of the device.
  static rtapi::Result<EnvironmentMap> create(const EffectScope& scope,
                                              const EnvironmentDesc& desc);
  /// That of the scene's probes, which the effects of a frame with such constants share. Needs as
  /// `create`.
  /// @errors those of environment_probes and of `create`.
  static rtapi::Result<EnvironmentMap> of_scene(const EffectScope& scope,
                                                const EnvironmentConstants& constants = {});
  /// Sets the place of the camera, to which the probes are relative from now on. Nothing that reads
  /// them may run.
  /// @errors those of rtapi::Device::CreateBuffer.
  rtapi::Status set_origin(const rtapi::Device& device, const glm::dvec3& camera, PassViews& views);
  /// Binds the cubes as environment_map.hlsli reads them: t5; set_origin binds the probes, t6.
  /// @errors those of rtapi::Device::CreateShaderResourceView.
  rtapi::Status bind(PassViews& views) const;
  /// Bytes of the cubes.
  std::uint64_t bytes() const;
  /// R16G16B16A16_FLOAT: six faces for each probe, kEnvironmentLevels levels.
  const rtapi::Texture& cubes() const { return cubes_; }

 private:
  EnvironmentDesc desc_;
  rtapi::Texture cubes_;
  rtapi::Buffer probes_;
};

/// The environment map of an effect that looks up there what it does not find otherwise; or none.
class EnvironmentFallback {
 public:
  /// With `is_wanted` a map of the scene's probes. The scope's device and views must stay.
  /// @errors those of EnvironmentMap::of_scene.
  static rtapi::Result<EnvironmentFallback> create(const EffectScope& scope, bool is_wanted);
  /// Its part of EffectPass::begin_frame.
  /// @errors those of EnvironmentMap::set_origin.
  rtapi::Status begin_frame(const Camera& camera);
  /// True if there is a map.
  explicit operator bool() const { return map_.has_value(); }
  /// Bytes of its cubes.
  std::uint64_t bytes() const { return map_ ? map_->bytes() : 0; }

 private:
  const rtapi::Device* device_ = nullptr;
  PassViews* views_ = nullptr;
  std::optional<EnvironmentMap> map_;
};

/// The shaders that make the maps, which are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> environment_bake_library();
/// Reflections from the maps alone. Register u0 of space3 is no sum: radiance as reflections_pass
/// has it. Needs as EnvironmentMap::create.
/// @errors those of EnvironmentMap::of_scene and of ComputePass::create.
rtapi::Result<std::unique_ptr<EffectPass>> make_environment_reflections(const EffectScope& scope);
/// Its shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> environment_reflections_library();

}  // namespace kaamos::effects

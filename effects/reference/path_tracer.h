// SPDX-License-Identifier: MIT
/// @file
/// The reference: a path tracer that shares with the frame only the scene and the camera.
/// README.md has its equations.
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "effects/engine/frame.h"
#include "effects/engine/outcome.h"
#include "effects/engine/ray_pass.h"

namespace kaamos::effects {

/// The way light is found. The second and third are for tests and for teaching: their mean is the
/// same.
enum class PathWays : std::uint32_t {
  kBoth,            ///< by sampling lights and directions, weighted by the balance heuristic
  kLightsOnly,      ///< by sampling lights; directions find what cannot be sampled
  kDirectionsOnly,  ///< by sampling directions; lights without an extent are sampled all the same
};

/// Describes what paths may do.
struct PathTracerDesc {
  /// Bounces of a path after the surface that the camera sees; kUnlimitedBounces: as long as
  /// Russian roulette lets it go on.
  std::uint32_t bounces = 0xFFFFFFFFu;
  float occlusion_radius = 4.0f;  ///< metres, of the layer "visibility"; 0: not traced
  /// Up to so many lamps are sampled each where the camera looks, and have layers of their own.
  std::uint32_t lamps_apart = 16;
  PathWays ways = PathWays::kBoth;  ///< how light is found
  /// Part of its own colour that a pane of glass lets through of light that reaches a surface, 0 to
  /// 1, as GlassShadowConstants::tint. Negative: glass casts no shadows, and the layer sun_tint is
  /// white.
  float glass_tint = -1.0f;
};

/// PathTracerDesc::bounces of no limit.
inline constexpr std::uint32_t kUnlimitedBounces = 0xFFFFFFFFu;

/// Pictures of the reference, sums over samples: registers u0 to u11 of space3.
enum PathLayer : std::uint32_t {
  kPathRadiance,    ///< what the camera sees, glass included; a: samples, here and below
  kPathEmission,    ///< emission of what the camera sees, or the sky
  kPathSun,         ///< light of the sun, by both lobes
  kPathLamps,       ///< light of the local lights, by both lobes
  kPathIndirect,    ///< the diffuse lobe under all other light
  kPathFirst,       ///< the part of it that was reflected once on its way
  kPathReflection,  ///< the specular lobe under all other light
  kPathGlass,       ///< of the glass in front; a: what it lets through
  kPathVisibility,  ///< r: ambient visibility up to the radius, g: visible part of the sun's disk
  kPathDiffuseAlbedo,   ///< what the diffuse lobe of the surface in view reflects of even light
  kPathSpecularAlbedo,  ///< the same of the specular lobe
  kPathSunTint,         ///< what glass lets through of the sun [PathTracerDesc::glass_tint]
  kPathLayerCount
};

/// "radiance", "emission", ...: names of the layers in files.
const char* path_layer_name(PathLayer layer);

/// The paths of a frame. Not for several threads at once.
class PathTracer {
 public:
  /// Finds the lights of a valid scene and makes the pipeline. `frame` and `gpu` are of that scene,
  /// seen from `origin`; `states`: where its instances are.
  /// @errors those of the device.
  static rtapi::Result<PathTracer> create(const rtapi::Device& device, const Frame& frame,
                                          const GpuScene& gpu, const Scene& scene,
                                          std::span<const InstanceState> states,
                                          const glm::dvec3& origin, const PathTracerDesc& desc,
                                          rtapi::ShaderLibrary library);

  /// Records `count` samples of each pixel of `row_count` rows from `first_row` on. Layers then
  /// hold their sums. Samples of one seed continue each other; other seeds are independent.
  void record(rtapi::CommandList& list, const Frame& frame, std::uint32_t seed,
              std::uint32_t first_sample, std::uint32_t count, std::uint32_t first_row,
              std::uint32_t row_count) const;

  /// The picture of a layer.
  const rtapi::Texture& layer(PathLayer layer) const { return layers_[layer]; }
  /// Sums of each lamp: four floats a pixel, radiance and visibility, picture by picture. One
  /// element where lamps() is 0.
  const rtapi::Buffer& each_lamp() const { return each_lamp_; }
  /// Lamps that have layers of their own.
  std::uint32_t lamps() const { return lamps_; }
  /// Emissive triangles that are sampled.
  std::uint32_t emitters() const { return words_.emitters; }

 private:
  // Mirrors PathConstants of path_tracer.hlsl.
  struct Words {
    std::uint32_t seed = 0;
    std::uint32_t bounces = 0;
    std::uint32_t emitters = 0;
    std::uint32_t has_sun = 0;
    std::uint32_t has_sky = 0;
    std::uint32_t has_glass = 0;
    std::uint32_t lamps_apart = 0;
    float occlusion_radius = 0;
    PathWays ways = PathWays::kBoth;
    float glass_tint = -1.0f;
  };

  rtapi::Status create_tables(const rtapi::Device& device, const Scene& scene,
                              std::span<const InstanceState> states, const glm::dvec3& origin);
  rtapi::Status create_layers(const rtapi::Device& device, const Frame& frame);

  Words words_;
  RayPass pass_;
  PassViews views_;
  std::vector<rtapi::Buffer> tables_;  // t0 to t4
  std::vector<rtapi::Texture> layers_;
  rtapi::Buffer each_lamp_;
  std::uint32_t lamps_ = 0;
};

/// The shaders that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> path_tracer_library();

}  // namespace kaamos::effects

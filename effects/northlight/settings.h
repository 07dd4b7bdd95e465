// SPDX-License-Identifier: MIT
/// @file
/// The settings that can be chosen for a frame.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effects/composition/enlarge/enlarge.h"
#include "effects/composition/taa/taa.h"
#include "effects/denoise/denoise.h"
#include "effects/geometry/structures/structures.h"
#include "effects/indirect/indirect_diffuse/volume.h"
#include "effects/light/direct/direct.h"
#include "effects/northlight/effects.h"
#include "effects/surfaces/ray_order/ray_order.h"

namespace kaamos::effects {

/// Paths per cell that is baked when it is read, if VolumeSettings::samples allows as many.
inline constexpr std::uint32_t kDemandPaths = 64;

/// The volume of indirect light, which effects read that need it.
struct VolumeSettings {
  /// Every cell is baked before the first frame. false: those that the frame's rays read, before
  /// the first frame and between frames, by kDemandPaths paths each and filtered [VolumeOnDemand].
  /// A file always holds all cells.
  bool whole = false;
  std::optional<float> cell;          ///< metres; none: by the size of the scene
  std::uint32_t samples = 1024;       ///< paths per cell at most [BakeDesc]
  float error = 0.03f;                ///< standard error that is enough for a cell [BakeDesc]
  std::uint32_t bounces = 64;         ///< after the first hit, at most
  std::uint32_t lights = kBakeAll;    ///< BakedLights
  std::optional<std::uint32_t> seed;  ///< of the paths; none: the frame's
  std::string file;                   ///< read if it is there, else baked and written; empty: baked
  std::shared_ptr<const IndirectVolume> given;  ///< instead of a file and of baking
};

/// The way in which a frame finds what its pixels show. The pictures are the same, but for pixels
/// at edges.
enum class Primary : std::uint8_t {
  kRays,    ///< by rays: the reference
  kRaster,  ///< by draws [effects/surfaces/gbuffer/raster_gbuffer.h]
};

/// The size of a frame, its effects and how good they are.
struct FrameSettings {
  std::uint32_t width = 1280;  ///< pixels, 1 to 16384
  std::uint32_t height = 720;  ///< pixels, 1 to 16384
  std::uint32_t seed = 0;      ///< the same seed gives the same frame
  /// The effects that are rendered, by the names of the registry. [choose_effects]
  std::map<std::string, EffectSettings> effects;
  /// Signals are denoised and put together with local lights and glass. false: only effects that
  /// are plain, as they are; another one is then an error. [Effect::is_plain]
  bool whole_frame = true;
  DenoiseDesc denoise;                                   ///< of a whole frame
  VolumeSettings volume;                                 ///< for effects that read it
  LightCulling light_culling = LightCulling::kClusters;  ///< of main lighting; the same picture
  LightMaps light_maps = LightMaps::kTraced;             ///< the atlas of shadow maps
  /// The combination of the strongest lights' shadow maps and contact shadows.
  ContactCombination contact = ContactCombination::kProduct;
  bool taa = false;            ///< antialiasing over the frames of a sequence
  TaaConstants taa_constants;  ///< with which numbers
  float enlarge = 1.0f;  ///< the finished radiance has so many times the width and height, 1 to 4
  EnlargeConstants enlarge_constants;   ///< with which numbers
  bool moving = false;                  ///< frames of a sequence: structures follow what moves
  StructureOptions structures;          ///< how they do
  RayOrder order = RayOrder::kPixels;   ///< of rays; the frame stays the same
  Primary primary = Primary::kRays;     ///< of the G-buffer
  bool ray_cones = true;                ///< [FrameDesc]
  bool curvature_to_roughness = false;  ///< [curvature_pass]
  float sun_angular_radius = -1.0f;     ///< [FrameDesc]
  std::uint32_t sun_map = 0;  ///< texels, 0 to kMaxSunMap; for SunAtHits::kByMap [FrameDesc]
  std::uint32_t max_pass_views = 256;  ///< [FrameDesc]
  /// Rows per dispatch. 0: as many as take a quarter of a second.
  std::uint32_t rows = 0;
};

/// These effects with their defaults, and those that they include. "all": every one, of which the
/// frame leaves out what another one takes the place of, unless it is named besides. An
/// unknown name is kept, and FrameRenderer::create refuses it.
std::map<std::string, EffectSettings> choose_effects(
    const std::vector<std::string>& names,
    const std::vector<Effect>& effects = northlight_effects());

/// The pixel of each 2 x 2 that has rays in a frame of a sequence. [PassConstants::pixel_offset]
///@{
std::uint32_t rotating_offset(std::uint32_t index);                               ///< in turns
std::uint32_t pixel_offset(const EffectSettings& settings, std::uint32_t index);  ///< of an effect
///@}

/// The first of the samples that a pixel gets in a frame of a sequence: each frame in which it has
/// rays goes on with its sequence, so that samples are spread as evenly over several frames as
/// within one. [PassConstants::first_sample]
std::uint32_t first_sample(const EffectSettings& settings, std::uint32_t index);

/// Brings along what the chosen effects include, by name what was named. [Effect::includes]
void add_included(std::map<std::string, EffectSettings>& chosen,
                  const std::vector<Effect>& effects);

/// Local lights of a scene, as many as light_constants makes.
std::uint32_t count_local_lights(const Scene& scene);
/// Returns whether an instance is transparent.
bool has_glass(const Scene& scene);
/// Returns whether the scene has what an effect is about: a sun, local lights, glass, glossy
/// materials.
bool scene_offers(const Scene& scene, const EffectNeeds& needs);

/// Returns whether an effect among these is not plain and so needs a whole frame.
/// [Effect::is_plain]
bool need_whole_frame(const std::map<std::string, EffectSettings>& chosen,
                      const std::vector<Effect>& effects = northlight_effects());

/// The chosen effect in whose favour another one is left out; null: none.
const Effect* what_replaces(const FrameSettings& settings, const std::vector<Effect>& effects,
                            const Effect& effect);
/// Returns whether an effect is rendered: chosen, and of use in this scene.
bool is_rendered(const Scene& scene, const FrameSettings& settings,
                 const std::vector<Effect>& effects, const std::string& name);
/// Returns whether reflections are chosen, and left out because nothing shows them.
bool is_matte(const Scene& scene, const FrameSettings& settings,
              const std::vector<Effect>& effects);

/// @errors KA3046 an unknown name in settings.effects; one that is not plain without
/// settings.whole_frame; a map of the sun that is too large.
rtapi::Status check_settings(const FrameSettings& settings, const std::vector<Effect>& effects);
/// Checks a camera against the chosen effects.
/// @errors KA3046 it is orthographic, and an effect needs perspective.
rtapi::Status check_camera(const Camera& camera, const FrameSettings& settings,
                           const std::vector<Effect>& effects);

}  // namespace kaamos::effects

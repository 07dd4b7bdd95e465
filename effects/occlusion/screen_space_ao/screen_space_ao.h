// SPDX-License-Identifier: MIT
/// @file
/// Ambient occlusion from the depth picture alone: the techniques that look at points or march
/// around each pixel, and their small filters. Visibility: 1 is open, 0 occluded. [survey 7.1 to
/// 7.3]
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstdint>
#include <vector>

#include "effects/engine/compute_pass.h"
#include "effects/engine/frame.h"
#include "effects/engine/pass_views.h"

namespace kaamos::effects {

/// The reach of the occluders that a game looks for on the screen, metres. [XeGTAO 1.30: radius]
inline constexpr float kDefaultScreenSpaceRadius = 0.5f;

/// The techniques.
enum class ScreenSpaceAoKind : std::uint8_t {
  kCrytek,      ///< points in a sphere
  kHemisphere,  ///< points in a hemisphere
  kHbao,        ///< sines of horizons
  kGtao,        ///< the cosine between horizons
};

/// Constants b0, space3: mirrors CrytekConstants of crytek_ao.hlsl. [Mittring 2007]
struct CrytekConstants {
  std::uint32_t filter_passes = 1;  ///< 0: the noise stays
  std::uint32_t samples = 16;       ///< points in the sphere, in pairs
  std::uint32_t remap = 0;          ///< 1: twice the open part, so that an open wall is white
};

/// Mirrors HemisphereConstants of hemisphere_ao.hlsl. [survey 7.1]
struct HemisphereConstants {
  std::uint32_t filter_passes = 1;  ///< 0: the noise stays
  std::uint32_t samples = 16;       ///< points in the hemisphere
  float bias = 0.025f;              ///< of depth, in radii
  /// 2: a second layer of depth is drawn and asked besides. Holds for the pass's life.
  std::uint32_t layers = 1;
  float separation = 0.5f;  ///< of the layers, in radii
};

/// Mirrors HbaoConstants of hbao.hlsl. [Bavoil, Sainz and Dimitrov 2008]
struct HbaoConstants {
  std::uint32_t filter_passes = 1;    ///< 0: the noise stays
  std::uint32_t directions = 6;       ///< about each pixel
  std::uint32_t steps = 6;            ///< in each direction
  float angle_bias = 0.5235988f;      ///< radians that horizons must rise above the surface
  float strength = 1.0f;              ///< factor on occlusion
  float most_pixels = 100.0f;         ///< that a march is long
  std::uint32_t half_resolution = 0;  ///< as that of GtaoConstants
  std::uint32_t rotations = 0;        ///< as that of GtaoConstants
  float fresh = 1.0f;                 ///< as that of GtaoConstants
};

/// Mirrors GtaoConstants of gtao.hlsl. The defaults are XeGTAO's, at its high quality.
/// [Jimenez et al. 2016]
struct GtaoConstants {
  std::uint32_t filter_passes = 1;   ///< 0: the noise stays
  std::uint32_t slices = 3;          ///< through the view ray of each pixel
  std::uint32_t steps = 3;           ///< to each side of a slice
  float radius_multiplier = 1.457f;  ///< on the radius
  float falloff_range =
      0.615f;                  ///< last part of the radius over which occluders fade; 0: a hard end
  float sample_power = 2.0f;   ///< above 1: more steps near the pixel
  float thin_occluder = 0.0f;  ///< 0 to 0.7: occluders deeper than wide count less
  float final_power = 2.2f;    ///< on visibility
  float least = 0.03f;         ///< visibility
  float least_pixels = 1.3f;   ///< that the first step goes
  float level_offset = 3.3f;   ///< larger: finer levels of the depth picture
  float normal_flattening = 0.05f;  ///< part by which slices that the normal leaves are made up for
  std::uint32_t noise = 1;          ///< 0: the same directions and steps everywhere
  float pull = 1e-5f;               ///< part of its depth by which a pixel moves nearer
  /// 1: one of each 2 x 2 pixels is looked at, and the others are worked out from those; where
  /// frames are averaged, each of the four in turn.
  std::uint32_t half_resolution = 0;
  /// Frames after which directions repeat, of a tile of 4 x 4 pixels; 0: XeGTAO's sequence.
  std::uint32_t rotations = 0;
  /// The mean over frames, where surfaces are now: least weight of the new one; 1: no mean.
  float fresh = 1.0f;
  /// 1: occluders reflect light, as much as the surface itself. The result has its colour.
  std::uint32_t multibounce = 0;
  std::uint32_t bent_normals = 0;  ///< 1: the mean open direction is found too
};

/// GTAO as the paper has it: one direction for each of 2 x 2 pixels, six rotations of it over
/// frames, whose mean it is. The rest is XeGTAO's.
GtaoConstants gtao_over_frames();

/// GTAO without what makes pictures pleasing: no powers, no clamps, a hard end of the radius as
/// rays have it, the finest depth only. What remains is missing information and sampling.
GtaoConstants accurate_gtao(std::uint32_t slices, std::uint32_t steps);

/// The shaders of crytek_ao.hlsl that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> crytek_ao_library();
/// The shaders of hemisphere_ao.hlsl that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> hemisphere_ao_library();
/// The shaders of hbao.hlsl that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> hbao_library();
/// The shaders of gtao.hlsl that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> gtao_library();
/// The shaders of occlusion_filter.hlsl that are built into the program.
/// @errors KA0910 they were made for another version of the ABI.
rtapi::Result<rtapi::ShaderLibrary> occlusion_filter_library();

/// One technique over one frame.
class ScreenSpaceAo {
 public:
  /// Makes the pipelines and the pictures between them. `technique`: the kind's library; `filter`:
  /// that of occlusion_filter.hlsl. `views` must have the result, a picture of the frame's size of
  /// R32G32B32A32_FLOAT, at register u0, and with bent normals another one for those, in world
  /// space, at u3; other registers are set here. It must outlive the passes. `words`: the kind's
  /// constants; record may have others with as many pictures.
  /// @errors those of the device, among them KA0990 no memory; KA0537 a library without a kernel.
  static rtapi::Result<ScreenSpaceAo> create(const rtapi::Device& device, const Frame& frame,
                                             ScreenSpaceAoKind kind,
                                             const rtapi::ShaderLibrary& technique,
                                             const rtapi::ShaderLibrary& filter, PassViews& views,
                                             const std::array<std::uint32_t, kPassWords>& words);
  /// The host's work of a frame, before anything is recorded: what was recorded for the frame
  /// before becomes history.
  /// @errors those of PassViews::set_unordered_access.
  rtapi::Status begin_frame();
  /// Records the whole picture, behind the G-buffer. `words` are the kind's constants;
  /// constants.radius is how far occluders reach, metres; 0 gives a white picture.
  void record(rtapi::CommandList& list, const Frame& frame, const PassConstants& constants,
              const std::array<std::uint32_t, kPassWords>& words);
  /// Bytes of the pictures between the passes.
  std::uint64_t bytes() const;

 private:
  rtapi::Status create_pictures(const rtapi::Device& device, const Frame& frame,
                                const std::array<std::uint32_t, kPassWords>& words);
  rtapi::Status create_levels(const rtapi::Device& device, const Frame& frame,
                              const rtapi::ShaderLibrary& technique);
  rtapi::Status bind_history();

  ScreenSpaceAoKind kind_ = ScreenSpaceAoKind::kCrytek;
  PassViews* views_ = nullptr;
  std::vector<ComputePass> shrink_;  // GTAO's levels of depth
  ComputePass technique_, filter_, upscale_, accumulate_;
  std::vector<rtapi::Texture> levels_;
  rtapi::Texture raw_, filtered_, raw_bent_, filtered_bent_;  // null: no bent normals
  rtapi::Texture history_[2], bent_history_[2];               // null: no mean over frames
  std::uint32_t newest_ = 0;                                  // what this frame writes
  bool is_recorded_ = false, has_history_ = false;
};

}  // namespace kaamos::effects

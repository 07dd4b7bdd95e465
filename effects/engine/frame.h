// SPDX-License-Identifier: MIT
/// @file
/// The pictures and the global root table that all effects of a frame share.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "effects/assets/image/image.h"
#include "effects/assets/scene/light_constants.h"
#include "effects/assets/scene/scene.h"
#include "effects/engine/gpu_scene.h"
#include "effects/engine/pass_views.h"

namespace kaamos::effects {

/// Mirrors FrameConstants of effects/shaders/frame.hlsli.
struct FrameConstants {
  /// half the picture's width at distance 1, or anywhere where rays are parallel
  glm::vec3 camera_right;
  float near_plane;     ///< metres, for the reversed-Z depth
  glm::vec3 camera_up;  ///< half the picture's height at distance 1
  /// Radians that a pixel's side covers, metres where rays are parallel; 0: no ray cones.
  float pixel_angle;
  glm::vec3 camera_forward;    ///< unit
  std::uint32_t seed;          ///< of random numbers
  glm::vec3 direction_to_sun;  ///< unit
  float tan_sun_radius;        ///< tangent of its angular radius
  glm::vec3 sun_irradiance;    ///< on a surface that faces the sun; black without one
  std::uint32_t light_count;   ///< local lights
  glm::vec3 sky_zenith;        ///< radiance
  std::uint32_t frame_index;   ///< in its sequence
  glm::vec3 sky_horizon;       ///< radiance
  float over_right;            ///< 1 / length(camera_right)
  glm::vec3 sky_ground;        ///< radiance
  float over_up;               ///< 1 / length(camera_up)
  /// The camera of the frame before, as above; in the first frame the current one.
  ///@{
  glm::vec3 previous_right;
  float over_previous_right;
  glm::vec3 previous_up;
  float over_previous_up;
  glm::vec3 previous_forward;
  ///@}
  float white;                    ///< radiance that the exposure takes to 1
  glm::vec3 camera_motion;        ///< metres, from the camera before to this one
  std::uint32_t is_orthographic;  ///< 1: the camera's rays are parallel
  glm::vec2 jitter;               ///< pixels, added to the primary rays
  glm::vec2 previous_jitter;      ///< that of the frame before
  SunMapConstants sun_map;        ///< in the atlas of shadow maps
};
static_assert(sizeof(FrameConstants) == 256);

/// Mirrors PassConstants of frame.hlsli.
struct PassConstants {
  std::uint32_t first_sample = 0;  ///< of each pixel that the dispatch takes
  std::uint32_t sample_count = 0;  ///< samples of each pixel, from first_sample on
  float radius = 0;                ///< metres, how far rays of ambient occlusion reach
  std::uint32_t first_row = 0;     ///< of the band of the picture that is dispatched
  std::uint32_t sorted = 0;        ///< 1: in the order that a RaySorter made
  std::uint32_t pixel_step = 1;    ///< 2: rays at one pixel of each 2 x 2 only
  std::uint32_t accumulate = 1;    ///< 0: pictures of sums begin anew, whatever stands in them
  std::uint32_t pixel_offset = 0;  ///< which of the 2 x 2: bit 0 to the right, bit 1 below
  std::uint32_t sharpness = 1;     ///< 0: nobody reads how sharp shadows are, so that rays may end
                                   ///< at the first hit that they find
  std::uint32_t again = 0;         ///< 1: samples of the frame before are taken again, as the
                                   ///< camera saw them then
};

/// The number of pixels of a side of `size` pixels that get rays: every `constants.pixel_step`-th.
///@{
std::uint32_t traced_columns(const PassConstants& constants, std::uint32_t size);
std::uint32_t traced_rows(const PassConstants& constants, std::uint32_t size);
///@}

/// Pictures of a frame in the order of their registers u0, u1, ...
enum FrameTexture : std::uint32_t {
  kDepth,          ///< R32_FLOAT: near plane over view depth; 0: a miss
  kViewZ,          ///< R32_FLOAT: metres along the camera's axis; 0: a miss
  kNormal,         ///< R16G16_SNORM: geometric normal, octahedral, towards the camera
  kShadingNormal,  ///< R16G16_SNORM: as kNormal, with normal maps
  kBaseColor,      ///< R8G8B8A8_UNORM: EncodeColor of encoding.hlsli
  kEmissive,       ///< R16G16B16A16_FLOAT: radiance; w: EncodeDielectric of encoding.hlsli
  kMaterial,       ///< R8G8B8A8_UNORM: roughness, metallic, EncodeDielectric; z is 1: unlit
  kIds,            ///< R32G32_UINT: instance + 1, primitive; 0: a miss
  kPosition,       ///< R32G32B32A32_FLOAT: relative to the camera; w: offset of ray origins
  kRadiance,       ///< R32G32B32A32_FLOAT: what the camera sees
  kMotion,         ///< R32G32B32A32_FLOAT: to where the surface was a frame ago
  kFrameTextureCount
};

/// Parameters of the global root signature.
enum FrameRootParameter : std::uint32_t {
  kRootViews,       ///< table: the scene, materials, blue noise, pictures, textures
  kRootSamplers,    ///< table: the scene's samplers
  kRootFrame,       ///< CBV b0
  kRootPass,        ///< constants b1
  kRootPassViews,   ///< table: space3, of the pass alone
  kRootPassWords,   ///< constants b0, space3
  kRootGeometries,  ///< table: space4, vertices and indices of every geometry
};

/// The properties of a frame besides the scene.
struct FrameDesc {
  std::uint32_t width = 1280;  ///< pixels
  std::uint32_t height = 720;  ///< pixels
  std::uint32_t seed = 0;      ///< of random numbers
  /// Radians; replaces the scene's. Negative: the scene's own.
  float sun_angular_radius = -1.0f;
  /// Rays are cones that choose the level of detail of textures; false: level 0 is read
  /// everywhere, as the deck does.
  bool ray_cones = true;
  /// Texels along the side of the sun's map in the atlas of shadow maps, which covers the scene as
  /// it is at time 0; 0: none, at most kMaxSunMap.
  std::uint32_t sun_map = 0;
  /// At most so many passes of a frame's life may have views of their own.
  std::uint32_t max_pass_views = 256;
};

/// The data that a frame of a sequence has and the first one does not.
struct FrameTime {
  std::uint32_t index = 0;          ///< in its sequence, from 0
  Camera previous_camera;           ///< of the frame before
  glm::vec2 jitter{0.0f};           ///< pixels, of the primary rays
  glm::vec2 previous_jitter{0.0f};  ///< that of the frame before
};

/// Resources of one frame. Shared by its passes; a copy refers to the same pictures.
class Frame {
 public:
  /// Makes the pictures, buffers and descriptors of a frame of a valid scene. `gpu` is the same
  /// scene on the device, relative to the camera; the frame keeps its textures alive.
  /// @errors those of the device, among them KA0990 no memory and KA0908 a picture that is too
  /// large.
  static rtapi::Result<Frame> create(const rtapi::Device& device, const Scene& scene,
                                     const GpuScene& gpu, const Camera& camera,
                                     const FrameDesc& desc);

  /// A frame with pictures and pass views of its own, which are empty, that shares everything else:
  /// passes made for this frame can be dispatched over it too.
  /// @errors those of the device, as of create.
  rtapi::Result<Frame> create_twin(const rtapi::Device& device, const GpuScene& gpu) const;

  /// The global one, see FrameRootParameter.
  const rtapi::RootSignature& root_signature() const { return root_signature_; }
  /// The one of hit group records: vertices t0, indices t1, HitConstants b0, all in space2.
  const rtapi::RootSignature& local_root_signature() const { return local_root_signature_; }
  /// Size of its pictures, pixels.
  ///@{
  std::uint32_t width() const { return desc_.width; }
  std::uint32_t height() const { return desc_.height; }
  /// Texels along the side of the sun's map; 0: there is none, as in scenes without a sun.
  std::uint32_t sun_map() const { return desc_.sun_map; }
  ///@}

  /// Goes on to the next frame of a sequence, which the next dispatches render: another camera, and
  /// so other constants and lights. The top level must be relative to that camera by then.
  /// @errors those of rtapi::Device::CreateBuffer.
  rtapi::Status set_camera(const rtapi::Device& device, const Scene& scene, const Camera& camera,
                           const FrameTime& time);
  /// Takes over the camera, lights and seed of the frame that this one is a twin of.
  /// @errors those of rtapi::Device::CreateShaderResourceView.
  rtapi::Status follow(const rtapi::Device& device, const Frame& original);
  /// Sets the seed of random numbers, from the next set_camera on.
  void set_seed(std::uint32_t seed) { desc_.seed = seed; }
  /// Puts the top level and the previous instances of `gpu` in place of those before (t0, t4). Its
  /// textures and materials must be those that the frame was made with. No dispatch of this frame
  /// may run meanwhile.
  /// @errors those of rtapi::Device::CreateShaderResourceView.
  rtapi::Status set_scene(const rtapi::Device& device, const GpuScene& gpu);
  /// Sets the pixels in the order in which sorted dispatches take them (t5), a word for each place,
  /// and the keys that they were sorted by (u11); without `keys` none can be written.
  /// @errors those of rtapi::Device::CreateShaderResourceView.
  rtapi::Status set_ray_order(const rtapi::Device& device, const rtapi::Buffer& keys,
                              const rtapi::Buffer& order) const;
  /// Descriptors for one pass, in the heap of the frame. They are never given back.
  /// @errors KA3040 FrameDesc::max_pass_views of them are in use already.
  rtapi::Result<PassViews> create_pass_views(const rtapi::Device& device) const;
  /// Gives the descriptors of all passes back: none of those passes may run again.
  void release_pass_views() { *pass_views_ = 0; }
  /// Makes a picture of zeros of the frame's size, see effects::create_picture.
  /// @errors those of rtapi::Device::CreateTexture.
  rtapi::Result<rtapi::Texture> create_picture(const rtapi::Device& device, std::string name,
                                               rtapi::Format format) const;

  /// Records what a dispatch needs besides its pipeline: heaps, root signature and root arguments.
  void bind(rtapi::CommandList& list, const PassConstants& constants,
            const PassArguments& arguments = {}) const;
  /// The same for draws; all but the pipeline, targets, viewport and what the input assembler
  /// reads.
  void bind_draws(rtapi::CommandList& list, const PassArguments& arguments) const;
  /// One of its pictures, in unordered-access state.
  const rtapi::Texture& texture(FrameTexture texture) const { return textures_[texture]; }

  /// One of its pictures as floats, see read_picture.
  /// @errors those of rtapi::ReadbackTexture.
  rtapi::Result<FloatImage> read(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                 FrameTexture texture) const;

 private:
  rtapi::Status create_root_signatures(const rtapi::Device& device);
  rtapi::Status create_textures(const rtapi::Device& device);
  rtapi::Status create_views(const rtapi::Device& device, const GpuScene& gpu);
  rtapi::Status write_structured_view(const rtapi::Device& device, const rtapi::Buffer& buffer,
                                      std::uint32_t stride, std::uint32_t index) const;
  rtapi::Status create_geometry_views(const rtapi::Device& device, const GpuScene& gpu);
  rtapi::Status create_samplers(const rtapi::Device& device, const Scene& scene);

  FrameDesc desc_;
  Bounds bounds_;  // of the scene, where it has a map of the sun
  rtapi::RootSignature root_signature_;
  rtapi::RootSignature local_root_signature_;
  rtapi::DescriptorHeap views_;
  rtapi::DescriptorHeap samplers_;
  std::uint32_t first_geometry_ = 0;  // of kRootGeometries, in views_
  rtapi::Buffer constants_;
  rtapi::Buffer blue_noise_, specular_albedo_;
  rtapi::Buffer lights_;
  std::shared_ptr<std::uint32_t> pass_views_;  // number in use; copies of a frame share its heap
  std::vector<rtapi::Texture> textures_;
};

/// The constants of a camera, sun and sky. Colours that are not finite become black, so that they
/// cannot spoil anything else.
FrameConstants frame_constants(const Scene& scene, const Camera& camera, const FrameDesc& desc,
                               const FrameTime& time);

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
// The pictures and the global root table that all effects of a frame share.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "effects/frame/pass_views.h"
#include "effects/image/image.h"
#include "effects/scene/gpu_scene.h"
#include "effects/scene/scene.h"

namespace kaamos::effects {

/// Mirrors FrameConstants of effects/shaders/frame.hlsli.
struct FrameConstants {
  glm::vec3 camera_right;
  float near_plane;
  glm::vec3 camera_up;
  float pixel_angle;
  glm::vec3 camera_forward;
  std::uint32_t seed;
  glm::vec3 direction_to_sun;
  float tan_sun_radius;
  glm::vec3 sun_irradiance;
  std::uint32_t light_count;
  glm::vec3 sky_zenith;
  std::uint32_t frame_index;
  glm::vec3 sky_horizon;
  float over_right;
  glm::vec3 sky_ground;
  float over_up;
  glm::vec3 previous_right;
  float over_previous_right;
  glm::vec3 previous_up;
  float over_previous_up;
  glm::vec3 previous_forward;
  float padding4;
  glm::vec3 camera_motion;
  float padding5;
  glm::vec2 jitter;
  glm::vec2 previous_jitter;
};
static_assert(sizeof(FrameConstants) == 208);

/// Mirrors PassConstants of frame.hlsli.
struct PassConstants {
  std::uint32_t first_sample = 0;
  std::uint32_t sample_count = 0;
  float radius = 0;
  std::uint32_t first_row = 0;
  std::uint32_t sorted = 0;      ///< 1: in the order that a RaySorter made
  std::uint32_t pixel_step = 1;  ///< 2: rays at even pixels of even rows only
  std::uint32_t accumulate = 1;  ///< 0: pictures of sums begin anew, whatever stands in them
};

/// Pictures of a frame in the order of their registers u0, u1, ...
enum FrameTexture : std::uint32_t {
  kDepth,
  kViewZ,
  kNormal,
  kShadingNormal,
  kBaseColor,
  kEmissive,
  kMaterial,
  kIds,
  kPosition,
  kAmbientOcclusionSum,
  kSunVisibilitySum,
  kRadiance,
  kMotion,
  kFrameTextureCount
};

/// Parameters of the global root signature.
enum FrameRootParameter : std::uint32_t {
  kRootViews,      ///< table: the scene, materials, blue noise, pictures, textures
  kRootSamplers,   ///< table: the scene's samplers
  kRootFrame,      ///< CBV b0
  kRootPass,       ///< constants b1
  kRootPassViews,  ///< table: space3, of the pass alone
  kRootPassWords,  ///< constants b0, space3
};

/// What a frame looks like besides the scene.
struct FrameDesc {
  std::uint32_t width = 1280;
  std::uint32_t height = 720;
  std::uint32_t seed = 0;
  /// Radians; replaces the scene's. Negative: the scene's own.
  float sun_angular_radius = -1.0f;
  /// Rays are cones that choose the level of detail of textures; false: level 0 is read
  /// everywhere, as the deck does.
  bool ray_cones = true;
  /// How many passes of a frame's life may have views of their own.
  std::uint32_t max_pass_views = 256;
};

/// What a frame of a sequence has that the first does not.
struct FrameTime {
  std::uint32_t index = 0;
  Camera previous_camera;
  glm::vec2 jitter{0.0f};  ///< pixels, of the primary rays
  glm::vec2 previous_jitter{0.0f};
};

/// Resources of one frame. Shared by its passes; a copy refers to the same pictures.
class Frame {
 public:
  static rtapi::Result<Frame> create(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                     const Scene& scene, const GpuScene& gpu, const Camera& camera,
                                     const FrameDesc& desc);

  const rtapi::RootSignature& root_signature() const { return root_signature_; }
  /// Of hit group records: vertices t0, indices t1, HitConstants b0, all in space2.
  const rtapi::RootSignature& local_root_signature() const { return local_root_signature_; }
  std::uint32_t width() const { return desc_.width; }
  std::uint32_t height() const { return desc_.height; }

  /// Goes on to the next frame of a sequence, which the next dispatches render: another camera, and
  /// so other constants and lights. The top level must be relative to that camera by then.
  rtapi::Status set_camera(const rtapi::Device& device, const Scene& scene, const Camera& camera,
                           const FrameTime& time);
  /// What random numbers follow from, behind the next set_camera.
  void set_seed(std::uint32_t seed) { desc_.seed = seed; }
  /// Puts the top level and the previous instances of `gpu` in place of those before (t0, t4). Its
  /// textures and materials must be those that the frame was made with. No dispatch of this frame
  /// may run meanwhile.
  rtapi::Status set_scene(const rtapi::Device& device, const GpuScene& gpu);
  /// A word per pixel each: what rays are sorted by (u13), and the pixels in that order (t5).
  /// [effects/ray_order]
  rtapi::Status set_ray_order(const rtapi::Device& device, const rtapi::Buffer& keys,
                              const rtapi::Buffer& order) const;
  /// Descriptors for one pass. Error: FrameDesc::max_pass_views are in use.
  rtapi::Result<PassViews> create_pass_views(const rtapi::Device& device) const;
  /// A picture of the frame's size.
  rtapi::Result<rtapi::Texture> create_picture(const rtapi::Device& device, std::string name,
                                               rtapi::Format format) const;

  /// Sets heaps, root signature and root arguments of a dispatch.
  void bind(rtapi::CommandList& list, const PassConstants& constants,
            const PassArguments& arguments = {}) const;
  /// Writes zero to a picture of floats.
  void clear(rtapi::CommandList& list, FrameTexture texture) const;
  const rtapi::Texture& texture(FrameTexture texture) const { return textures_[texture]; }

  /// [read_picture]
  rtapi::Result<FloatImage> read(const rtapi::Device& device, rtapi::CommandQueue& queue,
                                 FrameTexture texture) const;

 private:
  rtapi::Status create_root_signatures(const rtapi::Device& device);
  rtapi::Status create_textures(const rtapi::Device& device);
  rtapi::Status create_views(const rtapi::Device& device, const GpuScene& gpu);
  rtapi::Status write_structured_view(const rtapi::Device& device, const rtapi::Buffer& buffer,
                                      std::uint32_t stride, std::uint32_t index) const;
  rtapi::Status create_samplers(const rtapi::Device& device, const Scene& scene);

  FrameDesc desc_;
  rtapi::RootSignature root_signature_;
  rtapi::RootSignature local_root_signature_;
  rtapi::DescriptorHeap views_;
  rtapi::DescriptorHeap samplers_;
  rtapi::Buffer constants_;
  rtapi::Buffer blue_noise_;
  rtapi::Buffer lights_;
  std::shared_ptr<std::uint32_t> pass_views_;  // number in use; copies of a frame share its heap
  std::vector<rtapi::Texture> textures_;
};

/// The constants of a camera, sun and sky.
FrameConstants frame_constants(const Scene& scene, const Camera& camera, const FrameDesc& desc,
                               const FrameTime& time);

}  // namespace kaamos::effects

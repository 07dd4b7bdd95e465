// SPDX-License-Identifier: MIT
#include "effects/engine/frame.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "effects/assets/common/blue_noise.h"
#include "effects/assets/common/errors.h"
#include "effects/assets/common/specular_albedo.h"
#include "effects/assets/scene/light_constants.h"
#include "effects/engine/picture.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

struct TextureInfo {
  const char* name;
  Format format;
};

constexpr TextureInfo kTextures[kFrameTextureCount] = {
    {"depth", Format::kR32Float},
    {"view z", Format::kR32Float},
    {"normal", Format::kR16G16Snorm},
    {"shading normal", Format::kR16G16Snorm},
    {"base color", Format::kR8G8B8A8Unorm},
    {"emissive", Format::kR16G16B16A16Float},
    {"material", Format::kR8G8B8A8Unorm},
    {"ids", Format::kR32G32Uint},
    {"position", Format::kR32G32B32A32Float},
    {"radiance", Format::kR32G32B32A32Float},
    {"motion", Format::kR32G32B32A32Float},
};

// Layout of the view heap: t0..t6, then u0.., then the scene's textures, then its geometries'
// vertices and indices, then the passes' own views.
constexpr std::uint32_t kRayOrder = 5;
constexpr std::uint32_t kSpecularAlbedo = kRayOrder + 1;
constexpr std::uint32_t kFirstPicture = kSpecularAlbedo + 1;
constexpr std::uint32_t kRayKeys = kFirstPicture + kFrameTextureCount;
constexpr std::uint32_t kFirstSceneTexture = kRayKeys + 1;

TextureAddressMode address_mode(Wrap wrap) {
  switch (wrap) {
    case Wrap::kRepeat:
      return TextureAddressMode::kWrap;
    case Wrap::kMirror:
      return TextureAddressMode::kMirror;
    case Wrap::kClamp:
      return TextureAddressMode::kClamp;
  }
  return TextureAddressMode::kWrap;
}

// D3D12's filter number: bit 0 is linear between mips, bit 2 linear magnification, bit 4 linear
// minification.
rtapi::Filter filter(const Sampler& sampler) {
  const auto linear = [](Filter f) { return f == Filter::kLinear ? 1u : 0u; };
  return static_cast<rtapi::Filter>(linear(sampler.mip_filter) | linear(sampler.mag_filter) << 2 |
                                    linear(sampler.min_filter) << 4);
}

// Turns a sky or sun with NaN or infinite values black, so that it cannot spoil anything else.
glm::vec3 finite_or_black(const glm::vec3& color) {
  return std::isfinite(color.x) && std::isfinite(color.y) && std::isfinite(color.z)
             ? color
             : glm::vec3(0.0f);
}

void set_sun(FrameConstants& c, const Sun& sun, float radius) {
  // A flat disk cannot cover half the sky.
  constexpr float kLargestRadius = 1.5f;
  c.tan_sun_radius = std::tan(radius > 0 ? std::min(radius, kLargestRadius) : 0.0f);
  c.direction_to_sun = finite_or_black(sun.direction_to_sun);
  c.sun_irradiance = finite_or_black(sun.irradiance);
  if (c.direction_to_sun == glm::vec3(0.0f)) {
    c.direction_to_sun = glm::vec3(0, 1, 0);
    c.sun_irradiance = glm::vec3(0.0f);
  }
}

}  // namespace

std::uint32_t traced_columns(const PassConstants& constants, std::uint32_t size) {
  return (size + constants.pixel_step - 1 - (constants.pixel_offset & 1)) / constants.pixel_step;
}

std::uint32_t traced_rows(const PassConstants& constants, std::uint32_t size) {
  return (size + constants.pixel_step - 1 - (constants.pixel_offset >> 1)) / constants.pixel_step;
}

FrameConstants frame_constants(const Scene& scene, const Camera& camera, const FrameDesc& desc,
                               const FrameTime& time) {
  FrameConstants c = {};
  const double half_height = camera.picture_half_height();
  const double aspect = static_cast<double>(desc.width) / desc.height;
  const auto set_axes = [&](const Camera& of, glm::vec3& right, glm::vec3& up, glm::vec3& forward) {
    const double half = of.picture_half_height();
    right = glm::vec3(glm::dvec3(of.camera_to_world[0]) * half * aspect);
    up = glm::vec3(glm::dvec3(of.camera_to_world[1]) * half);
    forward = glm::vec3(of.forward());
  };
  set_axes(camera, c.camera_right, c.camera_up, c.camera_forward);
  set_axes(time.previous_camera, c.previous_right, c.previous_up, c.previous_forward);
  c.over_right = 1 / glm::length(c.camera_right);
  c.over_up = 1 / glm::length(c.camera_up);
  c.over_previous_right = 1 / glm::length(c.previous_right);
  c.over_previous_up = 1 / glm::length(c.previous_up);
  c.camera_motion = glm::vec3(camera.position() - time.previous_camera.position());
  c.is_orthographic = camera.is_orthographic() ? 1 : 0;
  c.frame_index = time.index;
  c.jitter = time.jitter;
  c.previous_jitter = time.previous_jitter;
  c.near_plane = static_cast<float>(camera.near_plane);
  c.pixel_angle = desc.ray_cones ? static_cast<float>(2 * half_height / desc.height) : 0.0f;
  c.seed = desc.seed;
  const Sun sun = scene.sun.value_or(Sun{{0, 1, 0}, glm::vec3(0.0f), 0.0f});
  const float radius = desc.sun_angular_radius >= 0 ? desc.sun_angular_radius : sun.angular_radius;
  set_sun(c, sun, radius);
  c.white = scene.exposure > 0 ? 1 / scene.exposure : std::numeric_limits<float>::max();
  c.sky_zenith = finite_or_black(scene.sky.zenith);
  c.sky_horizon = finite_or_black(scene.sky.horizon);
  c.sky_ground = finite_or_black(scene.sky.ground);
  return c;
}

rtapi::Status Frame::create_root_signatures(const Device& device) {
  RootSignatureDesc global;
  std::vector<DescriptorRange> views;
  views.push_back({.RangeType = DescriptorRangeType::kSrv, .NumDescriptors = kFirstPicture});
  views.push_back({.RangeType = DescriptorRangeType::kUav,
                   .NumDescriptors = kFirstSceneTexture - kFirstPicture});
  views.push_back({.RangeType = DescriptorRangeType::kSrv,
                   .NumDescriptors = kUnboundedDescriptors,
                   .RegisterSpace = 1});
  global.Parameters.push_back(RootParameter::Table(views));
  global.Parameters.push_back(RootParameter::Table({{.RangeType = DescriptorRangeType::kSampler,
                                                     .NumDescriptors = kUnboundedDescriptors,
                                                     .RegisterSpace = 1}}));
  global.Parameters.push_back(RootParameter::Cbv(0));
  global.Parameters.push_back(RootParameter::Constants32(sizeof(PassConstants) / 4, 1));
  global.Parameters.push_back(RootParameter::Table({{.RangeType = DescriptorRangeType::kSrv,
                                                     .NumDescriptors = kPassShaderResources,
                                                     .RegisterSpace = 3},
                                                    {.RangeType = DescriptorRangeType::kUav,
                                                     .NumDescriptors = kPassUnorderedAccess,
                                                     .RegisterSpace = 3}}));
  global.Parameters.push_back(RootParameter::Constants32(kPassWords, 0, 3));
  global.Parameters.push_back(RootParameter::Table({{.RangeType = DescriptorRangeType::kSrv,
                                                     .NumDescriptors = kUnboundedDescriptors,
                                                     .RegisterSpace = 4}}));
  // s0, space3: passes read smooth pictures of their own with it.
  StaticSamplerDesc linear;
  linear.Filter = rtapi::Filter::kMinMagMipLinear;
  linear.AddressU = linear.AddressV = linear.AddressW = TextureAddressMode::kClamp;
  linear.RegisterSpace = 3;
  global.StaticSamplers.push_back(linear);
  global.Flags = RootSignatureFlags::kAllowInputAssemblerInputLayout;
  const auto created = device.CreateRootSignature(global);
  if (!created) return created.error();
  root_signature_ = *created;

  RootSignatureDesc local;
  local.Flags = RootSignatureFlags::kLocalRootSignature;
  local.Parameters.push_back(RootParameter::Srv(0, 2));
  local.Parameters.push_back(RootParameter::Srv(1, 2));
  local.Parameters.push_back(RootParameter::Constants32(sizeof(HitConstants) / 4, 0, 2));
  const auto created_local = device.CreateRootSignature(local);
  if (!created_local) return created_local.error();
  local_root_signature_ = *created_local;
  return {};
}

rtapi::Status Frame::create_textures(const Device& device) {
  for (const TextureInfo& info : kTextures) {
    const auto created = create_picture(device, info.name, info.format);
    if (!created) return created.error();
    textures_.push_back(*created);
  }
  return {};
}

rtapi::Result<Texture> Frame::create_picture(const Device& device, std::string name,
                                             Format format) const {
  return effects::create_picture(device, std::move(name), format, desc_.width, desc_.height);
}

rtapi::Result<PassViews> Frame::create_pass_views(const Device& device) const {
  if (*pass_views_ == desc_.max_pass_views) {
    return make_error(ErrorId::kFrame,
                      "the frame has room for " + std::to_string(desc_.max_pass_views) +
                          " passes with views of their own and one more was asked for; raise "
                          "FrameDesc::max_pass_views");
  }
  const std::uint32_t first =
      views_.GetDesc().NumDescriptors - kPassViews * (desc_.max_pass_views - *pass_views_);
  ++*pass_views_;
  return PassViews(device, views_, first);
}

rtapi::Status Frame::create_views(const Device& device, const GpuScene& gpu) {
  DescriptorHeapDesc heap;
  first_geometry_ = kFirstSceneTexture + static_cast<std::uint32_t>(gpu.textures.size());
  heap.NumDescriptors = first_geometry_ + 2 * static_cast<std::uint32_t>(gpu.geometries.size()) +
                        desc_.max_pass_views * kPassViews;
  heap.Flags = DescriptorHeapFlags::kShaderVisible;
  heap.Name = "views";
  const auto created = device.CreateDescriptorHeap(heap);
  if (!created) return created.error();
  views_ = *created;

  if (const auto s = set_scene(device, gpu); !s) return s;
  const auto structured = [&](const Buffer& buffer, std::uint32_t stride, std::uint32_t index) {
    return write_structured_view(device, buffer, stride, index);
  };
  if (const auto s = structured(gpu.materials, sizeof(MaterialConstants), 1); !s) return s;
  if (const auto s = structured(blue_noise_, sizeof(glm::vec2), 2); !s) return s;
  if (const auto s = structured(lights_, sizeof(LightConstants), 3); !s) return s;
  if (const auto s = structured(specular_albedo_, sizeof(glm::vec2), kSpecularAlbedo); !s) return s;
  for (std::uint32_t i = 0; i < kFrameTextureCount; ++i) {
    const auto handle = views_.GetCPUDescriptorHandle(kFirstPicture + i);
    if (const auto s = device.CreateUnorderedAccessView(textures_[i], handle); !s) return s;
  }
  for (std::uint32_t i = 0; i < gpu.textures.size(); ++i) {
    const auto handle = views_.GetCPUDescriptorHandle(kFirstSceneTexture + i);
    if (const auto s = device.CreateShaderResourceView(gpu.textures[i], handle); !s) return s;
  }
  return create_geometry_views(device, gpu);
}

rtapi::Status Frame::create_geometry_views(const Device& device, const GpuScene& gpu) {
  std::uint32_t slot = first_geometry_;
  for (const GpuGeometry& geometry : gpu.geometries) {
    for (const GpuRange& range : {geometry.vertex_range(), geometry.index_range()}) {
      ShaderResourceViewDesc view;
      view.Format = Format::kR32Typeless;
      view.ViewDimension = SrvDimension::kBuffer;
      view.Buffer.Flags = BufferSrvFlags::kRaw;
      view.Buffer.FirstElement = range.offset_bytes / 4;
      view.Buffer.NumElements = static_cast<std::uint32_t>((range.size_bytes + 3) / 4);
      const auto handle = views_.GetCPUDescriptorHandle(slot++);
      // A view of no elements would reach to the end of the buffer.
      const Buffer buffer = range.size_bytes > 0 ? range.buffer : Buffer();
      if (const auto s = device.CreateShaderResourceView(buffer, view, handle); !s) return s;
    }
  }
  return {};
}

rtapi::Status Frame::create_samplers(const Device& device, const Scene& scene) {
  DescriptorHeapDesc heap;
  heap.Type = DescriptorHeapType::kSampler;
  heap.NumDescriptors = static_cast<std::uint32_t>(scene.samplers.size());
  heap.Flags = DescriptorHeapFlags::kShaderVisible;
  heap.Name = "samplers";
  const auto created = device.CreateDescriptorHeap(heap);
  if (!created) return created.error();
  samplers_ = *created;
  for (std::uint32_t i = 0; i < scene.samplers.size(); ++i) {
    const Sampler& sampler = scene.samplers[i];
    SamplerDesc desc;
    desc.Filter = filter(sampler);
    desc.AddressU = address_mode(sampler.wrap_u);
    desc.AddressV = address_mode(sampler.wrap_v);
    if (!sampler.mipmapped) desc.MaxLOD = 0;
    if (const auto s = device.CreateSampler(desc, samplers_.GetCPUDescriptorHandle(i)); !s)
      return s;
  }
  return {};
}

rtapi::Result<Frame> Frame::create(const Device& device, const Scene& scene, const GpuScene& gpu,
                                   const Camera& camera, const FrameDesc& desc) {
  Frame frame;
  frame.desc_ = desc;
  if (desc.sun_map != 0) frame.bounds_ = scene_bounds(scene);
  if (!scene.sun || frame.bounds_.empty()) frame.desc_.sun_map = 0;
  frame.pass_views_ = std::make_shared<std::uint32_t>(0);
  if (const auto s = frame.set_camera(device, scene, camera, {.previous_camera = camera}); !s) {
    return s.error();
  }
  const auto buffer = CreateUploadBuffer(device, blue_noise_tile(), "blue noise");
  if (!buffer) return buffer.error();
  frame.blue_noise_ = *buffer;
  const auto albedo = CreateUploadBuffer(device, split_albedo_table(), "specular albedo");
  if (!albedo) return albedo.error();
  frame.specular_albedo_ = *albedo;
  if (const auto s = frame.create_root_signatures(device); !s) return s.error();
  if (const auto s = frame.create_textures(device); !s) return s.error();
  if (const auto s = frame.create_views(device, gpu); !s) return s.error();
  if (const auto s = frame.create_samplers(device, scene); !s) return s.error();
  return frame;
}

rtapi::Result<Frame> Frame::create_twin(const Device& device, const GpuScene& gpu) const {
  Frame twin = *this;
  twin.pass_views_ = std::make_shared<std::uint32_t>(0);
  twin.textures_.clear();
  if (const auto s = twin.create_textures(device); !s) return s.error();
  if (const auto s = twin.create_views(device, gpu); !s) return s.error();
  return twin;
}

rtapi::Status Frame::follow(const Device& device, const Frame& original) {
  desc_.seed = original.desc_.seed;
  constants_ = original.constants_;
  lights_ = original.lights_;
  return write_structured_view(device, lights_, sizeof(LightConstants), 3);
}

rtapi::Status Frame::set_camera(const Device& device, const Scene& scene, const Camera& camera,
                                const FrameTime& time) {
  std::vector<LightConstants> lights = light_constants(scene, camera.position());
  // Constant buffers are read in whole blocks of 256 bytes. [D3D12: constant buffer placement]
  std::vector<std::byte> constants(256);
  FrameConstants values = frame_constants(scene, camera, desc_, time);
  values.light_count = static_cast<std::uint32_t>(lights.size());
  if (desc_.sun_map != 0) {
    values.sun_map =
        sun_map_constants(bounds_, values.direction_to_sun, desc_.sun_map, camera.position());
  }
  std::memcpy(constants.data(), &values, sizeof values);
  auto buffer = CreateUploadBuffer(device, constants, "frame constants");
  if (!buffer) return buffer.error();
  constants_ = *buffer;
  lights.resize(std::max<std::size_t>(lights.size(), 1));
  buffer = CreateUploadBuffer(device, lights, "lights");
  if (!buffer) return buffer.error();
  lights_ = *buffer;
  if (!views_) return {};
  return write_structured_view(device, lights_, sizeof(LightConstants), 3);
}

rtapi::Status Frame::set_scene(const Device& device, const GpuScene& gpu) {
  ShaderResourceViewDesc top_level;
  top_level.ViewDimension = SrvDimension::kRaytracingAccelerationStructure;
  top_level.RaytracingAccelerationStructure.Location = gpu.top_level.GetGPUVirtualAddress();
  if (const auto s =
          device.CreateShaderResourceView({}, top_level, views_.GetCPUDescriptorHandle(0));
      !s) {
    return s;
  }
  return write_structured_view(device, gpu.previous_instances, sizeof(PreviousInstance), 4);
}

rtapi::Status Frame::set_ray_order(const Device& device, const Buffer& keys,
                                   const Buffer& order) const {
  const auto ordered = write_structured_view(device, order, sizeof(std::uint32_t), kRayOrder);
  if (!ordered || !keys) return ordered;
  UnorderedAccessViewDesc view;
  view.ViewDimension = UavDimension::kBuffer;
  view.Buffer.StructureByteStride = sizeof(std::uint32_t);
  view.Buffer.NumElements = static_cast<std::uint32_t>(keys.size() / sizeof(std::uint32_t));
  return device.CreateUnorderedAccessView(keys, view, views_.GetCPUDescriptorHandle(kRayKeys));
}

rtapi::Status Frame::write_structured_view(const Device& device, const Buffer& buffer,
                                           std::uint32_t stride, std::uint32_t index) const {
  ShaderResourceViewDesc view;
  view.ViewDimension = SrvDimension::kBuffer;
  view.Buffer.StructureByteStride = stride;
  view.Buffer.NumElements = static_cast<std::uint32_t>(buffer.size() / stride);
  return device.CreateShaderResourceView(buffer, view, views_.GetCPUDescriptorHandle(index));
}

void Frame::bind(CommandList& list, const PassConstants& constants,
                 const PassArguments& arguments) const {
  list.SetDescriptorHeaps({views_, samplers_});
  list.SetComputeRootSignature(root_signature_);
  list.SetComputeRootDescriptorTable(kRootViews, views_.GetGPUDescriptorHandleForHeapStart());
  list.SetComputeRootDescriptorTable(kRootSamplers, samplers_.GetGPUDescriptorHandleForHeapStart());
  list.SetComputeRootConstantBufferView(kRootFrame, constants_.GetGPUVirtualAddress());
  list.SetComputeRoot32BitConstants(kRootPass, constants);
  list.SetComputeRootDescriptorTable(kRootGeometries,
                                     views_.GetGPUDescriptorHandle(first_geometry_));
  if (arguments.views == nullptr) return;
  list.SetComputeRootDescriptorTable(kRootPassViews, arguments.views->table());
  list.SetComputeRoot32BitConstants(kRootPassWords, arguments.words);
}

void Frame::bind_draws(CommandList& list, const PassArguments& arguments) const {
  list.SetDescriptorHeaps({views_, samplers_});
  list.SetGraphicsRootSignature(root_signature_);
  list.SetGraphicsRootDescriptorTable(kRootViews, views_.GetGPUDescriptorHandleForHeapStart());
  list.SetGraphicsRootDescriptorTable(kRootSamplers,
                                      samplers_.GetGPUDescriptorHandleForHeapStart());
  list.SetGraphicsRootConstantBufferView(kRootFrame, constants_.GetGPUVirtualAddress());
  list.SetGraphicsRootDescriptorTable(kRootGeometries,
                                      views_.GetGPUDescriptorHandle(first_geometry_));
  if (arguments.views == nullptr) return;
  list.SetGraphicsRootDescriptorTable(kRootPassViews, arguments.views->table());
  list.SetGraphicsRoot32BitConstants(kRootPassWords, arguments.words);
}

rtapi::Result<FloatImage> Frame::read(const Device& device, CommandQueue& queue,
                                      FrameTexture texture) const {
  return read_picture(device, queue, textures_[texture]);
}

}  // namespace kaamos::effects

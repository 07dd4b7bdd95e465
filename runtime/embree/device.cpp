// SPDX-License-Identifier: MIT
#include "runtime/embree/device.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <utility>

#include "runtime/backend/compute_limits.h"
#include "runtime/backend/errors.h"
#include "runtime/embree/state_object.h"
#include "runtime/raster/sample_positions.h"
#include "runtime/raster/target_codec.h"
#include "runtime/shader/texture/format_codec.h"

namespace kaamos::embree {
namespace {

// Each thread of the device has so much for the groups that it runs.
constexpr uint64_t kMostGroupsharedBytes = 16 << 20;

// simd256: on this kind of processor Embree would choose four-wide trees, but eight-wide ones trace
// 8 to 33 % faster. Ignored on processors without AVX.
constexpr char kEmbreeConfig[] = "frequency_level=simd256";

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "CPU";
}

std::string embree_version() {
  return std::to_string(RTC_VERSION_MAJOR) + "." + std::to_string(RTC_VERSION_MINOR) + "." +
         std::to_string(RTC_VERSION_PATCH);
}

uint32_t hardware_threads() {
  return std::max(std::thread::hardware_concurrency(), 1u);
}

rtapi::DeviceInfo device_info() {
  rtapi::DeviceInfo info;
  info.Backend = "embree";
  info.Name = processor_name() + ", Embree " + embree_version();
  info.Description = "Ray tracing on the CPU by Embree " + embree_version() + " with " +
                     std::to_string(hardware_threads()) + " hardware threads";
  info.HardwareThreads = hardware_threads();
  return info;
}

std::vector<rtapi::DeviceInfo> enumerate() {
  return {device_info()};
}

int arena_threads(uint32_t wanted) {
  return static_cast<int>(wanted == 0 ? hardware_threads() : std::min(wanted, 1024u));
}

BuildContext::Exact exact_of(rtapi::TraversalPrecision precision) {
  switch (precision) {
    case rtapi::TraversalPrecision::kExact:
      return BuildContext::Exact::kAll;
    case rtapi::TraversalPrecision::kRobust:
      return BuildContext::Exact::kNonOpaque;
    default:
      return BuildContext::Exact::kNone;
  }
}

rtapi::Error out_of_memory(const std::string& what, uint64_t bytes) {
  return runtime::make_error(runtime::Id::kOutOfMemory, what + " of " + std::to_string(bytes) +
                                                            " bytes could not be allocated.");
}

}  // namespace

Device::Device(const rtapi::DeviceDesc& desc, const runtime::Context& context)
    : info_(device_info()),
      context_(context),
      robust_(desc.Precision != rtapi::TraversalPrecision::kFast),
      exact_(exact_of(desc.Precision)),
      wave_lanes_(desc.WaveLanes == 0 ? shader::kDefaultWaveLanes : desc.WaveLanes),
      arena_(arena_threads(desc.Threads)) {
  if (desc.Threads > hardware_threads()) {
    parallelism_.emplace(tbb::global_control::max_allowed_parallelism, arena_threads(desc.Threads));
  }
}

rtapi::Result<std::unique_ptr<runtime::BackendDevice>> Device::create(
    const rtapi::DeviceDesc& desc, const runtime::Context& context) {
  std::unique_ptr<Device> device(new Device(desc, context));
  std::string config = kEmbreeConfig;
  if (const char* more = std::getenv("KAAMOS_EMBREE_CONFIG")) config += std::string(",") + more;
  // isa=sse simulates a machine without AVX, so use the pack filter of such a machine as well.
  device->pack_filter_ =
      config.find("isa=sse") == std::string::npos ? fastest_pack_filter() : filter_pack_sse2;
  device->embree_ = rtcNewDevice(config.c_str());
  if (device->embree_ == nullptr) {
    return runtime::make_error(runtime::Id::kEmbreeUnusable,
                               "it does not start and reports error " +
                                   std::to_string(static_cast<int>(rtcGetDeviceError(nullptr))) +
                                   ".");
  }
  if (auto s = device->check_embree(); !s) return s.error();
  rtcSetDeviceMemoryMonitorFunction(device->embree_, count_bytes, device.get());
  return std::unique_ptr<runtime::BackendDevice>(std::move(device));
}

Device::~Device() {
  // Structures hold scenes of the Embree device. Buffers may outlive it, but the structures in them
  // may not.
  memory_->evict(0, UINT64_MAX);
  if (embree_ != nullptr) {
    rtcSetDeviceMemoryMonitorFunction(embree_, nullptr, nullptr);
    rtcReleaseDevice(embree_);
  }
}

rtapi::Status Device::check_embree() const {
  struct Need {
    RTCDeviceProperty property;
    bool wanted;
    const char* name;
  };
  const Need needs[] = {
      {RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED, true, "ray masks"},
      {RTC_DEVICE_PROPERTY_FILTER_FUNCTION_SUPPORTED, true, "filter functions"},
      {RTC_DEVICE_PROPERTY_TRIANGLE_GEOMETRY_SUPPORTED, true, "triangles"},
      {RTC_DEVICE_PROPERTY_USER_GEOMETRY_SUPPORTED, true, "user geometry"},
      {RTC_DEVICE_PROPERTY_BACKFACE_CULLING_ENABLED, false, "back-face culling of its own"},
  };
  for (const Need& need : needs) {
    if ((rtcGetDeviceProperty(embree_, need.property) != 0) == need.wanted) continue;
    return runtime::make_error(
        runtime::Id::kEmbreeUnusable, rtapi::ErrorCode::kUnsupported,
        std::string("it was built ") + (need.wanted ? "without " : "with ") + need.name + ".");
  }
  return {};
}

bool Device::count_bytes(void* self, ssize_t bytes, bool) {
  static_cast<Device*>(self)->embree_bytes_ += bytes;
  return true;
}

rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> Device::create_buffer(
    const rtapi::BufferDesc& desc) {
  uint8_t* block = Memory::allocate(desc.SizeInBytes);
  if (block == nullptr) return out_of_memory("buffer \"" + desc.Name + "\"", desc.SizeInBytes);
  return std::shared_ptr<runtime::BackendBuffer>(
      std::make_shared<Buffer>(memory_, block, desc.SizeInBytes));
}

namespace {

rtapi::Result<std::shared_ptr<runtime::BackendTexture>> texture_or_error(
    std::shared_ptr<Texture> texture, const rtapi::TextureDesc& desc) {
  if (texture != nullptr) return std::shared_ptr<runtime::BackendTexture>(std::move(texture));
  const rtapi::FormatInfo format = rtapi::GetFormatInfo(desc.Format);
  return out_of_memory("texture \"" + desc.Name + "\"",
                       uint64_t{desc.Width} * desc.Height * desc.DepthOrArraySize * format.bytes /
                           (format.block_side * format.block_side));
}

}  // namespace

rtapi::Result<std::shared_ptr<runtime::BackendTexture>> Device::create_texture(
    const rtapi::TextureDesc& desc) {
  return texture_or_error(Texture::create(desc, views_), desc);
}

rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> Device::create_placed_buffer(
    const runtime::HeapPlace& place, const rtapi::BufferDesc& desc) {
  runtime::MappedPages mapping = place.map();
  if (!mapping) return out_of_memory("buffer \"" + desc.Name + "\"", desc.SizeInBytes);
  return std::shared_ptr<runtime::BackendBuffer>(
      std::make_shared<Buffer>(memory_, std::move(mapping), desc.SizeInBytes));
}

rtapi::Result<std::shared_ptr<runtime::BackendTexture>> Device::create_placed_texture(
    const runtime::HeapPlace& place, const rtapi::TextureDesc& desc) {
  return texture_or_error(Texture::create(desc, views_, &place), desc);
}

rtapi::Result<uint64_t> Device::create_texture_view(runtime::BackendTexture& texture,
                                                    const runtime::TextureViewDesc& desc) {
  auto& viewed = static_cast<Texture&>(texture);
  const shader::TextureView* view = viewed.view(desc, arena_);
  if (view == nullptr) {
    return out_of_memory("the decoded copy of a block-compressed texture",
                         viewed.stored().size_bytes());
  }
  return reinterpret_cast<uint64_t>(view);
}

rtapi::Result<uint64_t> Device::create_sampler(const rtapi::SamplerDesc& desc) {
  return reinterpret_cast<uint64_t>(views_->sampler(sampler_state_of(desc)));
}

bool Device::supports_format(rtapi::Format format, bool unordered_access) const {
  const shader::FormatCodec& codec = shader::format_codec(static_cast<uint32_t>(format));
  if (rtapi::GetFormatInfo(format).block_side != 1) return !unordered_access;
  return codec.bytes != 0 && (!unordered_access || codec.encode != nullptr);
}

rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> Device::create_raytracing_pipeline(
    std::shared_ptr<const runtime::LinkedPipeline> pipeline) {
  return std::shared_ptr<runtime::BackendPipeline>(
      std::make_shared<RaytracingPipeline>(std::move(pipeline)));
}

rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> Device::create_compute_pipeline(
    std::shared_ptr<const runtime::LinkedCompute> pipeline) {
  const std::string waves = "those of this device have " + std::to_string(wave_lanes_) +
                            ", which DeviceDesc::WaveLanes sets to 4, 8, 16 or 32.";
  if (auto s = runtime::check_wave_size(*pipeline, wave_lanes_, wave_lanes_, waves); !s) {
    return s.error();
  }
  if (auto s = runtime::check_groupshared(*pipeline, kMostGroupsharedBytes); !s) return s.error();
  return std::shared_ptr<runtime::BackendPipeline>(
      std::make_shared<ComputePipeline>(std::move(pipeline)));
}

bool Device::supports_target(rtapi::Format format, bool blended) const {
  if (rtapi::IsDepthFormat(format)) return !blended;
  const raster::TargetCodec& codec = raster::target_codec(format);
  return codec.bytes != 0 && !(blended && codec.integer);
}

bool Device::supports_samples(rtapi::Format format, uint32_t count) const {
  const bool drawn = format == rtapi::Format::kUnknown || supports_target(format, false);
  return drawn && raster::has_sample_positions(count);
}

rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> Device::create_graphics_pipeline(
    std::shared_ptr<const runtime::LinkedGraphics> pipeline) {
  return std::shared_ptr<runtime::BackendPipeline>(
      std::make_shared<GraphicsPipeline>(std::move(pipeline)));
}

rtapi::Result<std::shared_ptr<runtime::BackendQueryHeap>> Device::create_query_heap(
    rtapi::QueryHeapType type, uint32_t count) {
  if (type != rtapi::QueryHeapType::kTimestamp) {
    return std::shared_ptr<runtime::BackendQueryHeap>(
        std::make_shared<runtime::CountingQueries>(type, count));
  }
  return std::shared_ptr<runtime::BackendQueryHeap>(std::make_shared<Timestamps>(count));
}

rtapi::RaytracingAccelerationStructurePrebuildInfo Device::prebuild_info(
    const runtime::BuildCommand& inputs) const {
  return runtime::estimate_sizes(inputs);
}

void Device::add_counters(const Counters& counters) {
  const std::lock_guard lock(statistics_mutex_);
  counters_.add(counters);
}

rtapi::RaytracingStatistics Device::statistics() const {
  const std::lock_guard lock(statistics_mutex_);
  rtapi::RaytracingStatistics result;
  result.TraceRayCalls = counters_.rays;
  result.VisibilityRays = counters_.visibility_rays;
  result.Hits = counters_.rays - counters_.misses;
  result.Misses = counters_.misses;
  result.AnyHitInvocations = counters_.any_hit_calls;
  result.IntersectionInvocations = counters_.intersection_calls;
  result.ClosestHitInvocations = counters_.closest_hit_calls;
  result.MissInvocations = counters_.miss_calls;
  result.CallableInvocations = counters_.callable_calls;
  return result;
}

void Device::reset_statistics() {
  const std::lock_guard lock(statistics_mutex_);
  counters_ = {};
}

const runtime::BackendFactory& backend_factory() {
  static const runtime::BackendFactory factory = {"embree", enumerate, Device::create};
  return factory;
}

}  // namespace kaamos::embree

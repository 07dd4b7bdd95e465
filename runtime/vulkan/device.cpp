// SPDX-License-Identifier: MIT
#include "runtime/vulkan/device.h"
#include "runtime/backend/errors.h"
#include "runtime/vulkan/textures/texture_format.h"

#include <utility>

namespace kaamos::vulkan {

rtapi::Result<std::unique_ptr<runtime::BackendDevice>> Device::create(
    const rtapi::DeviceDesc& desc, const runtime::Context& context) {
  if (desc.Precision == rtapi::TraversalPrecision::kExact) {
    return runtime::make_error(
        runtime::Id::kPrecisionUnsupported,
        "the Vulkan backend does not have kExact, because the driver does the "
        "traversal; use kRobust.");
  }
  std::unique_ptr<Device> device(new Device(context));
  if (auto s = device->start(desc); !s) return s.error();
  return std::unique_ptr<runtime::BackendDevice>(std::move(device));
}

rtapi::Status Device::start(const rtapi::DeviceDesc& desc) {
  auto gpu = Gpu::create();
  if (!gpu) return gpu.error();
  gpu_ = *gpu;
  coverage_ = std::make_unique<CoverageWords>(*gpu_);
  gpu_->set_coverage(coverage_.get());
  auto descriptors = DescriptorSet::create(gpu_);
  if (!descriptors) return descriptors.error();
  descriptors_ = *descriptors;
  auto layout = PipelineLayout::create(gpu_, descriptors_, desc.CollectStatistics);
  if (!layout) return layout.error();
  layout_ = *layout;
  stream_ = std::make_unique<CommandStream>(gpu_);
  auto textures = TextureStore::create(gpu_, descriptors_);
  if (!textures) return textures.error();
  textures_ = *std::move(textures);
  auto structures = AccelerationStructures::create(gpu_, memory_, context_);
  if (!structures) return structures.error();
  structures_ = *std::move(structures);
  memory_->on_buffer_end(
      [this](uint64_t address, uint64_t size_bytes) { structures_->evict(address, size_bytes); });
  for (const std::string& name : gpu_->unknown_workarounds()) {
    warn(runtime::Id::kUnknownWorkaround,
         "KAAMOS_VULKAN_DISABLE_WORKAROUNDS or KAAMOS_VULKAN_ENABLE_WORKAROUNDS names \"" + name +
             "\"; runtime/vulkan/README.md and draws/README.md there list the known ones.");
  }
  return {};
}

rtapi::Status Device::validation_status() {
  if (!gpu_->instance().validates()) return {};
  const auto messages = gpu_->instance().validation_messages(&validation_position_);
  if (messages.empty()) return {};
  return runtime::make_error(
      runtime::Id::kValidationFinding,
      std::to_string(messages.size()) + " messages; the first is: " + messages[0]);
}

Device::~Device() {
  memory_->on_buffer_end(nullptr);
  if (gpu_ != nullptr) gpu_->set_coverage(nullptr);
}

rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> Device::create_buffer(
    const rtapi::BufferDesc& desc) {
  return memory_->create_buffer(*gpu_, desc, memory_);
}

rtapi::Result<std::shared_ptr<runtime::BackendTexture>> Device::create_texture(
    const rtapi::TextureDesc& desc) {
  return textures_->create_texture(desc);
}

rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> Device::create_placed_buffer(
    const runtime::HeapPlace& place, const rtapi::BufferDesc& desc) {
  return memory_->place_buffer(*gpu_, place, desc, memory_);
}

rtapi::Result<std::shared_ptr<runtime::BackendTexture>> Device::create_placed_texture(
    const runtime::HeapPlace& place, const rtapi::TextureDesc& desc) {
  return textures_->create_placed_texture(place, desc);
}

uint64_t Device::placed_bytes(const rtapi::TextureDesc& desc) const {
  return textures_->placed_bytes(desc);
}

rtapi::Result<uint64_t> Device::create_texture_view(runtime::BackendTexture& texture,
                                                    const runtime::TextureViewDesc& desc) {
  return textures_->create_view(texture, desc);
}

rtapi::Result<uint64_t> Device::create_sampler(const rtapi::SamplerDesc& desc) {
  return textures_->create_sampler(desc);
}

bool Device::supports_format(rtapi::Format format, bool unordered_access) const {
  return textures_->supports_format(format, unordered_access);
}

rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> Device::create_raytracing_pipeline(
    std::shared_ptr<const runtime::LinkedPipeline> pipeline) {
  return RaytracingPipeline::create(layout_, std::move(pipeline));
}

bool Device::supports_target(rtapi::Format format, bool blended) const {
  const TextureFormat known = texture_format(format);
  if (!gpu_->features().graphics_lacks.empty() || known.format == VK_FORMAT_UNDEFINED) return false;
  const VkFormatFeatureFlags2 features = format_features(gpu_->physical_device(), known.format);
  if ((known.aspects & VK_IMAGE_ASPECT_COLOR_BIT) == 0) {
    return !blended && rtapi::IsDepthFormat(format) &&
           (features & VK_FORMAT_FEATURE_2_DEPTH_STENCIL_ATTACHMENT_BIT) != 0;
  }
  const bool snorm = rtapi::GetFormatInfo(format).type == rtapi::FormatClass::kSnorm;
  if (blended && snorm && gpu_->workarounds().has(Workaround::kRefuseSnormBlend)) return false;
  const VkFormatFeatureFlags2 needed = blended ? VK_FORMAT_FEATURE_2_COLOR_ATTACHMENT_BLEND_BIT
                                               : VK_FORMAT_FEATURE_2_COLOR_ATTACHMENT_BIT;
  return known.plain && (features & needed) != 0;
}

bool Device::supports_samples(rtapi::Format format, uint32_t count) const {
  const VkPhysicalDeviceLimits& limits = gpu_->properties().core.limits;
  if (count > 1 && (!limits.standardSampleLocations || !gpu_->features().sample_shading)) {
    return false;
  }
  const TextureFormat known = texture_format(format);
  if (format == rtapi::Format::kUnknown) {
    return (limits.framebufferNoAttachmentsSampleCounts & limits.framebufferColorSampleCounts &
            count) != 0;
  }
  if (known.format == VK_FORMAT_UNDEFINED) return false;
  const bool color = (known.aspects & VK_IMAGE_ASPECT_COLOR_BIT) != 0;
  VkImageFormatProperties properties = {};
  const VkImageUsageFlags usage =
      VK_IMAGE_USAGE_SAMPLED_BIT |
      (color ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT : VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
  const VkResult r = vkGetPhysicalDeviceImageFormatProperties(
      gpu_->physical_device(), known.format, VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL, usage, 0,
      &properties);
  return r == VK_SUCCESS && (properties.sampleCounts & count) != 0;
}

rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> Device::create_graphics_pipeline(
    std::shared_ptr<const runtime::LinkedGraphics> pipeline) {
  return GraphicsPipeline::create(layout_, std::move(pipeline));
}

rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> Device::create_compute_pipeline(
    std::shared_ptr<const runtime::LinkedCompute> pipeline) {
  return ComputePipeline::create(layout_, std::move(pipeline));
}

rtapi::Result<std::shared_ptr<runtime::BackendQueryHeap>> Device::create_query_heap(
    rtapi::QueryHeapType type, uint32_t count) {
  if (type != rtapi::QueryHeapType::kTimestamp) {
    const GpuFeatures& features = gpu_->features();
    const bool statistics = type == rtapi::QueryHeapType::kPipelineStatistics;
    const std::string lacks = !features.graphics_lacks.empty() ? features.graphics_lacks
                              : statistics && !features.pipeline_statistics
                                  ? "pipelineStatisticsQuery"
                                  : "";
    if (!lacks.empty()) {
      return runtime::make_error(runtime::Id::kNoQueries, gpu_->info().Name + " lacks " + lacks);
    }
    return std::shared_ptr<runtime::BackendQueryHeap>(
        std::make_shared<runtime::CountingQueries>(type, count));
  }
  return Timestamps::create(gpu_, count);
}

rtapi::RaytracingAccelerationStructurePrebuildInfo Device::prebuild_info(
    const runtime::BuildCommand& inputs) const {
  return structures_->prebuild_info(inputs);
}

rtapi::RaytracingStatistics Device::statistics() const {
  const std::lock_guard lock(statistics_mutex_);
  return statistics_;
}

void Device::reset_statistics() {
  const std::lock_guard lock(statistics_mutex_);
  statistics_ = {};
}

void Device::add(const rtapi::RaytracingStatistics& statistics) {
  const std::lock_guard lock(statistics_mutex_);
  statistics_.TraceRayCalls += statistics.TraceRayCalls;
  statistics_.VisibilityRays += statistics.VisibilityRays;
  statistics_.Hits += statistics.Hits;
  statistics_.Misses += statistics.Misses;
  statistics_.AnyHitInvocations += statistics.AnyHitInvocations;
  statistics_.IntersectionInvocations += statistics.IntersectionInvocations;
  statistics_.ClosestHitInvocations += statistics.ClosestHitInvocations;
  statistics_.MissInvocations += statistics.MissInvocations;
  statistics_.CallableInvocations += statistics.CallableInvocations;
}

void Device::warn(runtime::Id id, const std::string& text) const {
  context_.message(runtime::make_message(id, text));
}

const runtime::BackendFactory& backend_factory() {
  static const runtime::BackendFactory factory = {"vulkan", Gpu::enumerate, Device::create};
  return factory;
}

}  // namespace kaamos::vulkan

// SPDX-License-Identifier: MIT
//
// The Vulkan backend as rtapi sees it.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "runtime/backend/backend.h"
#include "runtime/backend/errors.h"
#include "runtime/vulkan/draws/draw.h"
#include "runtime/vulkan/memory/memory.h"
#include "runtime/vulkan/memory/timestamps.h"
#include "runtime/vulkan/rays/dispatch.h"
#include "runtime/vulkan/rays/state_object.h"
#include "runtime/vulkan/spirv/coverage_words.h"
#include "runtime/vulkan/structures/acceleration_structure.h"
#include "runtime/vulkan/textures/texture.h"

namespace kaamos::vulkan {

class Device final : public runtime::BackendDevice {
 public:
  // Errors: those of Gpu::create, KA0991.
  static rtapi::Result<std::unique_ptr<runtime::BackendDevice>> create(
      const rtapi::DeviceDesc& desc, const runtime::Context& context);
  ~Device() override;

  const rtapi::DeviceInfo& info() const override { return gpu_->info(); }
  rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> create_buffer(
      const rtapi::BufferDesc& desc) override;
  rtapi::Result<std::shared_ptr<runtime::BackendTexture>> create_texture(
      const rtapi::TextureDesc& desc) override;
  rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> create_placed_buffer(
      const runtime::HeapPlace& place, const rtapi::BufferDesc& desc) override;
  rtapi::Result<std::shared_ptr<runtime::BackendTexture>> create_placed_texture(
      const runtime::HeapPlace& place, const rtapi::TextureDesc& desc) override;
  uint64_t placed_bytes(const rtapi::TextureDesc& desc) const override;
  rtapi::Result<uint64_t> create_texture_view(runtime::BackendTexture& texture,
                                              const runtime::TextureViewDesc& desc) override;
  rtapi::Result<uint64_t> create_sampler(const rtapi::SamplerDesc& desc) override;
  bool supports_format(rtapi::Format format, bool unordered_access) const override;
  bool supports_target(rtapi::Format format, bool blended) const override;
  bool supports_samples(rtapi::Format format, uint32_t count) const override;
  rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> create_raytracing_pipeline(
      std::shared_ptr<const runtime::LinkedPipeline> pipeline) override;
  rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> create_compute_pipeline(
      std::shared_ptr<const runtime::LinkedCompute> pipeline) override;
  rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> create_graphics_pipeline(
      std::shared_ptr<const runtime::LinkedGraphics> pipeline) override;
  rtapi::Result<std::shared_ptr<runtime::BackendQueryHeap>> create_query_heap(
      rtapi::QueryHeapType type, uint32_t count) override;
  uint64_t timestamp_frequency() const override { return vulkan::timestamp_frequency(*gpu_); }
  rtapi::RaytracingAccelerationStructurePrebuildInfo prebuild_info(
      const runtime::BuildCommand& inputs) const override;
  bool has_micromaps() const override { return vulkan::has_micromaps(*gpu_); }
  rtapi::Status execute(std::span<const runtime::Command> commands) override;
  std::shared_ptr<const runtime::AccelerationStructure> find_structure(
      uint64_t address) const override {
    return structures_->find(address);
  }
  rtapi::RaytracingStatistics statistics() const override;
  void reset_statistics() override;

  // For the code of the commands; see execute.cpp.
  const runtime::Context& context() const { return context_; }
  Gpu& gpu() { return *gpu_; }
  CommandStream& stream() { return *stream_; }
  AccelerationStructures& structures() { return *structures_; }
  TextureStore& textures() { return *textures_; }
  DispatchEnvironment dispatch_environment() {
    return {stream_.get(),  memory_.get(), structures_.get(), &scratch_, {},
            &check_memory_, &context_};
  }
  DrawBlocks& draw_blocks() { return draw_blocks_; }
  void add(const rtapi::RaytracingStatistics& statistics);
  void warn(runtime::Id id, const std::string& text) const;

 private:
  explicit Device(const runtime::Context& context) : context_(context) {}
  rtapi::Status start(const rtapi::DeviceDesc& desc);
  // KA0959 if the validation layers have reported anything since the last call.
  rtapi::Status validation_status();

  runtime::Context context_;
  // Members are in order of dependency.
  std::shared_ptr<Gpu> gpu_;
  std::unique_ptr<CoverageWords> coverage_;
  std::shared_ptr<DescriptorSet> descriptors_;
  std::shared_ptr<PipelineLayout> layout_;
  std::shared_ptr<Memory> memory_ = std::make_shared<Memory>();
  std::unique_ptr<CommandStream> stream_;
  std::unique_ptr<TextureStore> textures_;
  std::unique_ptr<AccelerationStructures> structures_;
  DispatchMemory scratch_;
  DispatchMemory check_memory_;  // only for checked devices
  DrawBlocks draw_blocks_;
  size_t validation_position_ = 0;
  mutable std::mutex statistics_mutex_;  // guards the next member
  rtapi::RaytracingStatistics statistics_;
};

// The factory that rtapi/src/backends.cpp lists.
const runtime::BackendFactory& backend_factory();

}  // namespace kaamos::vulkan

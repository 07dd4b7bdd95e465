// SPDX-License-Identifier: MIT
//
// The Embree backend as rtapi sees it.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "runtime/backend/backend.h"
#include "runtime/backend/errors.h"
#include "runtime/embree/dispatch.h"
#include "runtime/embree/memory.h"
#include "runtime/embree/texture.h"
#include "runtime/embree/timestamps.h"
#include "runtime/raster/rasterizer.h"
#include "runtime/structures/structure_commands.h"

namespace kaamos::embree {

class Device final : public runtime::BackendDevice {
 public:
  static rtapi::Result<std::unique_ptr<runtime::BackendDevice>> create(
      const rtapi::DeviceDesc& desc, const runtime::Context& context);
  ~Device() override;

  const rtapi::DeviceInfo& info() const override { return info_; }
  rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> create_buffer(
      const rtapi::BufferDesc& desc) override;
  rtapi::Result<std::shared_ptr<runtime::BackendTexture>> create_texture(
      const rtapi::TextureDesc& desc) override;
  rtapi::Result<std::shared_ptr<runtime::BackendBuffer>> create_placed_buffer(
      const runtime::HeapPlace& place, const rtapi::BufferDesc& desc) override;
  rtapi::Result<std::shared_ptr<runtime::BackendTexture>> create_placed_texture(
      const runtime::HeapPlace& place, const rtapi::TextureDesc& desc) override;
  rtapi::Result<uint64_t> create_texture_view(runtime::BackendTexture& texture,
                                              const runtime::TextureViewDesc& desc) override;
  rtapi::Result<uint64_t> create_sampler(const rtapi::SamplerDesc& desc) override;
  bool supports_format(rtapi::Format format, bool unordered_access) const override;
  bool supports_target(rtapi::Format format, bool blended) const override;
  bool supports_samples(rtapi::Format format, uint32_t count) const override;
  bool supports_resolve(rtapi::ResolveMode mode) const override {
    return mode != rtapi::ResolveMode::kDecompress;
  }
  rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> create_raytracing_pipeline(
      std::shared_ptr<const runtime::LinkedPipeline> pipeline) override;
  rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> create_compute_pipeline(
      std::shared_ptr<const runtime::LinkedCompute> pipeline) override;
  rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> create_graphics_pipeline(
      std::shared_ptr<const runtime::LinkedGraphics> pipeline) override;
  rtapi::Result<std::shared_ptr<runtime::BackendQueryHeap>> create_query_heap(
      rtapi::QueryHeapType type, uint32_t count) override;
  uint64_t timestamp_frequency() const override { return Timestamps::kFrequency; }
  rtapi::RaytracingAccelerationStructurePrebuildInfo prebuild_info(
      const runtime::BuildCommand& inputs) const override;
  bool has_micromaps() const override { return true; }
  rtapi::Status execute(std::span<const runtime::Command> commands) override;
  std::shared_ptr<const runtime::AccelerationStructure> find_structure(
      uint64_t address) const override {
    return memory_->find(address);
  }
  bool observe_draws(runtime::DrawObservation* observation) override {
    observation_ = observation;
    return true;
  }
  rtapi::RaytracingStatistics statistics() const override;
  void reset_statistics() override;

  // For the code of the commands; see execute.cpp and acceleration_structure.cpp.
  const runtime::Context& context() const { return context_; }
  Memory& memory() { return *memory_; }
  BuildContext build_context() const { return {embree_, robust_, exact_, pack_filter_}; }
  // Bytes that Embree currently holds for this device.
  int64_t embree_bytes() const { return embree_bytes_.load(); }
  runtime::StructureEnvironment structure_environment() {
    return {context_, *memory_, "Embree", true};
  }
  DispatchEnvironment dispatch_environment() {
    return {&arena_, memory_.get(), &context_, wave_lanes_};
  }
  tbb::task_arena& arena() { return arena_; }
  // One pass at a time: its memory stays from list to list.
  raster::Rasterizer& rasterizer() { return rasterizer_; }
  runtime::DrawObservation* observation() const { return observation_; }
  void add_counters(const Counters& counters);

 private:
  Device(const rtapi::DeviceDesc& desc, const runtime::Context& context);
  static bool count_bytes(void* self, ssize_t bytes, bool post);
  // Ok if this Embree has what Kaamos needs; if not, the status says why.
  rtapi::Status check_embree() const;

  rtapi::DeviceInfo info_;
  runtime::Context context_;
  bool robust_ = true;
  PackFilter pack_filter_ = filter_pack_sse2;
  BuildContext::Exact exact_ = BuildContext::Exact::kNone;
  uint32_t wave_lanes_ = shader::kDefaultWaveLanes;
  std::optional<tbb::global_control> parallelism_;  // allows more threads than the machine has
  tbb::task_arena arena_;
  RTCDevice embree_ = nullptr;
  std::atomic<int64_t> embree_bytes_ = 0;
  std::shared_ptr<ViewPool> views_ = std::make_shared<ViewPool>();
  raster::Rasterizer rasterizer_;
  runtime::DrawObservation* observation_ = nullptr;
  std::shared_ptr<Memory> memory_ = std::make_shared<Memory>();
  mutable std::mutex statistics_mutex_;
  Counters counters_;
};

// The factory that rtapi/src/backends.cpp lists.
const runtime::BackendFactory& backend_factory();

}  // namespace kaamos::embree

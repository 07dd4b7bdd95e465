// SPDX-License-Identifier: MIT
//
// Linked pipelines as Vulkan pipelines.
#pragma once

#include <memory>
#include <unordered_map>
#include <vector>

#include "runtime/backend/backend.h"
#include "runtime/vulkan/gpu/gpu.h"
#include "runtime/vulkan/rays/pipeline_cache.h"
#include "runtime/vulkan/rays/shader_table.h"
#include "runtime/vulkan/textures/descriptor_set.h"

namespace kaamos::vulkan {

// The layout that every pipeline uses: the bindless set and a push constant, the address of the
// DispatchBlock.
class PipelineLayout {
 public:
  static rtapi::Result<std::shared_ptr<PipelineLayout>> create(
      std::shared_ptr<Gpu> gpu, std::shared_ptr<DescriptorSet> descriptors,
      bool collect_statistics = false);
  ~PipelineLayout();
  PipelineLayout(const PipelineLayout&) = delete;
  PipelineLayout& operator=(const PipelineLayout&) = delete;

  VkPipelineLayout handle() const { return handle_; }
  Gpu& gpu() const { return *gpu_; }
  bool collect_statistics() const { return collect_statistics_; }
  // Those with this layout.
  PipelineCache& pipelines() { return pipelines_; }
  // Bind a pipeline and the set; push the address of a block.
  void bind(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline) const;
  void push(VkCommandBuffer commands, uint64_t block_address) const;

 private:
  PipelineLayout(std::shared_ptr<Gpu> gpu, std::shared_ptr<DescriptorSet> descriptors)
      : gpu_(std::move(gpu)), descriptors_(std::move(descriptors)) {}

  std::shared_ptr<Gpu> gpu_;
  std::shared_ptr<DescriptorSet> descriptors_;
  bool collect_statistics_ = false;
  VkPipelineLayout handle_ = VK_NULL_HANDLE;
  PipelineCache pipelines_;
};

class RaytracingPipeline final : public runtime::BackendPipeline {
 public:
  static rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> create(
      std::shared_ptr<PipelineLayout> layout,
      std::shared_ptr<const runtime::LinkedPipeline> linked);

  const runtime::LinkedPipeline& linked() const { return *linked_; }
  const PipelineLayout& layout() const { return *layout_; }
  // Null if the pipeline has no ray generation shader, so that nothing can run.
  VkPipeline handle() const { return compiled_ ? compiled_->handle() : VK_NULL_HANDLE; }
  const GroupHandles& groups() const { return groups_; }
  // Binds it; the caller still has to push a block.
  void bind(VkCommandBuffer commands) const;
  // The depth to which traces may nest: what the pipeline declares, or the device's limit if that
  // is lower.
  uint32_t max_trace_depth() const { return max_trace_depth_; }
  // A shader uses hit objects, so that dispatches need the records of twins.
  bool has_twins() const { return has_twins_; }
  // Indexed by kShaderConstant - 1.
  const std::vector<const runtime::LinkedShader*>& stage_shaders() const { return stage_shaders_; }

 private:
  RaytracingPipeline(std::shared_ptr<PipelineLayout> layout,
                     std::shared_ptr<const runtime::LinkedPipeline> linked)
      : layout_(std::move(layout)), linked_(std::move(linked)) {}
  rtapi::Status start();
  rtapi::Status read_handles(const std::vector<const runtime::LinkedRecord*>& records,
                             const std::vector<const runtime::LinkedShader*>& twins);

  std::shared_ptr<PipelineLayout> layout_;
  std::shared_ptr<const runtime::LinkedPipeline> linked_;
  std::shared_ptr<const CompiledPipeline> compiled_;
  std::vector<const runtime::LinkedShader*> stage_shaders_;
  uint32_t max_trace_depth_ = 0;
  bool has_twins_ = false;
  uint32_t stack_bytes_ = 0;  // 0: Vulkan's default
  GroupHandles groups_;
};

class ComputePipeline final : public runtime::BackendPipeline {
 public:
  static rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> create(
      std::shared_ptr<PipelineLayout> layout, std::shared_ptr<const runtime::LinkedCompute> linked);

  const PipelineLayout& layout() const { return *layout_; }
  VkPipeline handle() const { return compiled_->handle(); }
  const runtime::LinkedShader& shader() const { return linked_->shader; }

 private:
  ComputePipeline(std::shared_ptr<PipelineLayout> layout,
                  std::shared_ptr<const runtime::LinkedCompute> linked)
      : layout_(std::move(layout)), linked_(std::move(linked)) {}

  std::shared_ptr<PipelineLayout> layout_;
  std::shared_ptr<const runtime::LinkedCompute> linked_;
  std::shared_ptr<const CompiledPipeline> compiled_;
};

// The depth to which callable shaders may nest. In DXR only the stack limits them, and drivers
// offer no way to query it. [DXR: Ray recursion limit]
inline constexpr uint32_t kMaxCallableDepth = 63;
// On lavapipe without workaround CALLABLES.
inline constexpr uint32_t kMaxBareCallableDepth = 31;

}  // namespace kaamos::vulkan

// SPDX-License-Identifier: MIT
//
// Linked graphics pipelines as Vulkan pipelines. What D3D12 leaves to the draw and Vulkan wants in
// the pipeline makes variants of one.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <vector>

#include "runtime/backend/backend.h"
#include "runtime/backend/draw_commands.h"
#include "runtime/backend/linked_graphics.h"
#include "runtime/vulkan/draws/vertex_input.h"
#include "runtime/vulkan/rays/state_object.h"

namespace kaamos::vulkan {

// The targets and buffers that are bound when a pipeline draws.
struct GraphicsVariant {
  std::array<rtapi::Format, rtapi::kSimultaneousRenderTargetCount> colors = {};  // kUnknown: none
  uint32_t color_count = 0;
  rtapi::Format depth = rtapi::Format::kUnknown;
  // The layers of the targets; 0 unless the pipeline's own code picks one.
  uint32_t layers = 0;
  // A bit for each binding without a buffer, whose elements are four zeros. [RAS-14]
  uint32_t unbound = 0;
  // By binding; empty: strides come with the buffers. [VertexBinding::takes]
  std::vector<uint32_t> strides;

  bool operator==(const GraphicsVariant&) const = default;
};

class GraphicsPipeline final : public runtime::BackendPipeline {
 public:
  // With the variant for the formats of its description. Errors: KA0952, KA0954, KA0963, KA0965 the
  // device lacks what graphics pipelines need, KA0966, KA0967.
  static rtapi::Result<std::shared_ptr<runtime::BackendPipeline>> create(
      std::shared_ptr<PipelineLayout> layout,
      std::shared_ptr<const runtime::LinkedGraphics> linked);
  ~GraphicsPipeline() override;

  const runtime::LinkedGraphics& linked() const { return *linked_; }
  const PipelineLayout& layout() const { return *layout_; }
  const VertexInput& inputs() const { return inputs_; }
  // Thread-safe; made once each. Errors: KA0952.
  rtapi::Result<VkPipeline> variant(const GraphicsVariant& wanted);
  // Returns whether GraphicsVariant::layers is needed: a geometry shader of the backend's own picks
  // layers.
  bool needs_layers() const;
  // Returns whether its pixel shader writes memory, whose writes are not to be lost. [RAS-104]
  bool pixels_write_memory() const;

 private:
  GraphicsPipeline(std::shared_ptr<PipelineLayout> layout,
                   std::shared_ptr<const runtime::LinkedGraphics> linked)
      : layout_(std::move(layout)), linked_(std::move(linked)) {}
  rtapi::Status start();
  rtapi::Result<VkPipeline> create_variant(const GraphicsVariant& wanted);

  struct Made {
    GraphicsVariant variant;
    VkPipeline handle;
  };

  std::shared_ptr<PipelineLayout> layout_;
  std::shared_ptr<const runtime::LinkedGraphics> linked_;
  VertexInput inputs_;
  std::vector<uint32_t> pixel_code_;  // with the vertex shader's locations; empty: no shader
  std::vector<uint32_t> geometry_code_;
  std::vector<uint32_t> barycentrics_code_;  // a geometry shader; empty: none is needed
  std::mutex mutex_;                         // guards the next member
  std::vector<Made> variants_;
};

}  // namespace kaamos::vulkan

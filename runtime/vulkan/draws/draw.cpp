// SPDX-License-Identifier: MIT
#include "runtime/vulkan/draws/draw.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "runtime/vulkan/draws/draw_state.h"
#include "runtime/vulkan/rays/checks.h"

namespace kaamos::vulkan {
namespace {

constexpr uint64_t kPlaceBytes = kStatusBytes + kBlockBytes;
constexpr uint64_t kPlacesPerBuffer = 1024;
constexpr uint64_t kZeroElementBytes = 16;

bool has_targets(const runtime::DrawTargets& targets) {
  const auto* end = targets.color.begin() + targets.color_count;
  return targets.depth.texture != nullptr ||
         std::any_of(targets.color.begin(), end,
                     [](const runtime::TargetView& view) { return view.texture != nullptr; });
}

rtapi::Format bound_format(const runtime::TargetView& view) {
  return view.texture == nullptr ? rtapi::Format::kUnknown : view.format;
}

VkPrimitiveTopology topology_of(rtapi::PrimitiveTopology topology) {
  // Both count them in the same order, D3D from 1 and Vulkan from 0.
  static_assert(VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP ==
                static_cast<int>(rtapi::PrimitiveTopology::kTriangleStrip) - 1);
  return static_cast<VkPrimitiveTopology>(static_cast<uint32_t>(topology) - 1);
}

bool writes_depth(const runtime::DrawCommand& command) {
  const rtapi::DepthStencilDesc& desc = command.linked->depth_stencil;
  return desc.DepthEnable && desc.DepthWriteMask == rtapi::DepthWriteMask::kAll &&
         !command.state->targets.depth.read_only_depth;
}

uint32_t stencil_write_mask(const runtime::DrawCommand& command,
                            const rtapi::DepthStencilOpDesc& face) {
  return command.state->targets.depth.read_only_stencil ? 0u : face.StencilWriteMask;
}

bool is_unbound(const rtapi::VertexBufferView& view) {
  return view.BufferLocation == 0;
}

uint32_t stride_of(const rtapi::VertexBufferView& view) {
  return is_unbound(view) ? 0 : view.StrideInBytes;
}

const GraphicsPipeline& graphics_of(const runtime::DrawCommand& command) {
  return static_cast<const GraphicsPipeline&>(*command.pipeline);
}

}  // namespace

rtapi::Result<DrawBlocks::Place> DrawBlocks::next(Gpu& gpu) {
  const uint64_t number = used_ / kPlacesPerBuffer;
  if (number == buffers_.size()) {
    auto made =
        gpu.create_buffer(kPlacesPerBuffer * kPlaceBytes, "blocks of draws", InitialContents::kAny);
    if (!made) return made.error();
    buffers_.push_back(std::move(*made));
  }
  const uint64_t offset = used_++ % kPlacesPerBuffer * kPlaceBytes;
  const GpuBuffer& buffer = *buffers_[number];
  return Place{buffer.host() + offset, buffer.address() + offset};
}

rtapi::Result<const GpuBuffer*> DrawBlocks::zeros(Gpu& gpu) {
  if (zeros_ == nullptr) {
    auto made = gpu.create_buffer(kZeroElementBytes, "zeros for vertices");
    if (!made) return made.error();
    zeros_ = std::move(*made);
  }
  return zeros_.get();
}

bool DrawPass::is_checked() const {
  return environment_.context != nullptr && environment_.context->reporter != nullptr;
}

CountedOutcome DrawPass::draw(const runtime::DrawCommand& command, const std::string& label) {
  CountedOutcome outcome;
  // Whatever writes the indices, or the memory of checks, must be done first.
  if (needs_rewriting(command) || is_checked()) outcome = flush();
  if (outcome.status) outcome.status = record(command, label);
  if (!outcome.status || !is_checked()) return outcome;
  outcome = flush();
  outcome.reached = tell_checks(environment_, command.linked->shaders(), {});
  return outcome;
}

rtapi::Result<VkPipeline> DrawPass::pipeline_of(const runtime::DrawCommand& command) const {
  auto& pipeline = static_cast<GraphicsPipeline&>(*command.pipeline);
  const runtime::DrawState& state = *command.state;
  GraphicsVariant wanted;
  wanted.color_count = state.targets.color_count;
  for (uint32_t i = 0; i < wanted.color_count; ++i) {
    wanted.colors[i] = bound_format(state.targets.color[i]);
  }
  wanted.depth = bound_format(state.targets.depth);
  if (pipeline.needs_layers()) wanted.layers = area_of(state.targets, {}).layers;
  const auto& bindings = pipeline.inputs().bindings;
  bool all_taken = true;
  for (uint32_t i = 0; i < bindings.size(); ++i) {
    const rtapi::VertexBufferView& view = state.vertex_buffers[bindings[i].slot];
    wanted.strides.push_back(stride_of(view));
    all_taken = all_taken && bindings[i].takes(stride_of(view));
    if (is_unbound(view)) wanted.unbound |= 1u << i;
  }
  if (all_taken) wanted.strides.clear();
  return pipeline.variant(wanted);
}

rtapi::Result<uint64_t> DrawPass::write_block(const runtime::DrawCommand& command,
                                              const std::string& label) {
  if (!has_scene_) {
    auto scene = environment_.structures->tables();
    if (!scene) return scene.error();
    scene_ = *scene;
    has_scene_ = true;
    auto checks = begin_checks(environment_, 0);
    if (!checks) return checks.error();
    checks_ = *checks;
  }
  auto place = blocks_.next(environment_.stream->gpu());
  if (!place) return place.error();
  shader::spirv::DispatchFeedback status;
  status.checks = checks_;
  std::memcpy(place->host, &status, sizeof(status));
  shader::spirv::DispatchBlock block = dispatch_block(command.bindings, scene_);
  block.status = place->address;
  block.dimensions[0] = pass_.area().layers;
  // An SV_Depth that is not a number becomes this: below every viewport's range, to whose lower end
  // it is limited then. [RAS-69]
  const bool replaces = environment_.stream->gpu().workarounds().has(Workaround::kReplaceNanDepth);
  block.base[0] = std::bit_cast<uint32_t>(replaces ? std::numeric_limits<float>::lowest()
                                                   : std::numeric_limits<float>::quiet_NaN());
  std::memcpy(place->host + kStatusBytes, &block, sizeof(block));
  waiting_.push_back({label, place->host});
  return place->address + kStatusBytes;
}

rtapi::Status DrawPass::bind_vertices(VkCommandBuffer commands,
                                      const runtime::DrawCommand& command) {
  const auto& bindings = graphics_of(command).inputs().bindings;
  if (bindings.empty()) return {};
  std::vector<VkBuffer> buffers;
  std::vector<VkDeviceSize> offsets, sizes, strides;
  bool all_taken = true;
  for (const VertexBinding& binding : bindings) {
    const rtapi::VertexBufferView& view = command.state->vertex_buffers[binding.slot];
    const GpuBuffer* buffer = environment_.memory->find(view.BufferLocation);
    uint64_t offset = buffer == nullptr ? 0 : view.BufferLocation - buffer->address();
    if (is_unbound(view)) {
      auto zeros = blocks_.zeros(environment_.stream->gpu());
      if (!zeros) return zeros.error();
      buffer = *zeros;
      offset = 0;
    } else if (view.SizeInBytes == 0) {
      buffer = nullptr;
    }
    buffers.push_back(buffer == nullptr ? VK_NULL_HANDLE : buffer->handle());
    offsets.push_back(buffer == nullptr ? 0 : buffer->offset() + offset);
    sizes.push_back(is_unbound(view)    ? kZeroElementBytes
                    : buffer == nullptr ? VK_WHOLE_SIZE
                                        : view.SizeInBytes);
    strides.push_back(stride_of(view));
    all_taken = all_taken && binding.takes(stride_of(view));
  }
  environment_.stream->gpu().vk().vkCmdBindVertexBuffers2(
      commands, 0, static_cast<uint32_t>(buffers.size()), buffers.data(), offsets.data(),
      sizes.data(), all_taken ? strides.data() : nullptr);
  return {};
}

rtapi::Status DrawPass::set_state(VkCommandBuffer commands, const runtime::DrawCommand& command,
                                  bool restarts) {
  const VolkDeviceTable& vk = environment_.stream->gpu().vk();
  const runtime::DrawState& state = *command.state;
  const bool one = command.linked->vertex_columns.viewport_array_index == runtime::kNoColumn;
  const uint32_t count = one ? 1 : rtapi::kViewportAndScissorRectCount;
  const ViewportsAndScissors all = viewports_and_scissors(state, pass_.area());
  vk.vkCmdSetViewportWithCount(commands, count, all.viewports.data());
  vk.vkCmdSetScissorWithCount(commands, count, all.scissors.data());
  vk.vkCmdSetBlendConstants(commands, state.blend_factor);
  vk.vkCmdSetPrimitiveTopology(commands, topology_of(state.topology));
  vk.vkCmdSetPrimitiveRestartEnable(commands, restarts);
  vk.vkCmdSetDepthWriteEnable(commands, writes_depth(command));
  const rtapi::DepthStencilDesc& desc = command.linked->depth_stencil;
  vk.vkCmdSetStencilWriteMask(commands, VK_STENCIL_FACE_FRONT_BIT,
                              stencil_write_mask(command, desc.FrontFace));
  vk.vkCmdSetStencilWriteMask(commands, VK_STENCIL_FACE_BACK_BIT,
                              stencil_write_mask(command, desc.BackFace));
  vk.vkCmdSetStencilReference(commands, VK_STENCIL_FACE_FRONT_BIT, state.front_stencil);
  vk.vkCmdSetStencilReference(commands, VK_STENCIL_FACE_BACK_BIT, state.back_stencil);
  return bind_vertices(commands, command);
}

rtapi::Status DrawPass::record(const runtime::DrawCommand& command, const std::string& label) {
  Gpu& gpu = environment_.stream->gpu();
  const VolkDeviceTable& vk = gpu.vk();
  const GraphicsPipeline& pipeline = graphics_of(command);
  const runtime::DrawState& state = *command.state;
  auto handle = pipeline_of(command);
  if (!handle) return handle.error();
  IndexSource indices;
  if (command.indexed) {
    auto source = index_source(gpu, *environment_.memory, command, index_memory_);
    if (!source) return source.error();
    indices = *source;
  }
  RenderArea reach;
  if (!has_targets(state.targets)) reach = reach_of(state, gpu);
  auto commands = pass_.open(state.targets, reach, label);
  if (!commands) return commands.error();
  if (pipeline.pixels_write_memory() && gpu.workarounds().has(Workaround::kKeepMemoryWrites)) {
    if (auto s = pass_.keep_memory_writes(); !s) return s;
  }
  auto block = write_block(command, label);
  if (!block) return block.error();
  const bool anew = set_in_ != pass_.number();
  if (anew || set_pipeline_ != *handle) {
    pipeline.layout().bind(*commands, VK_PIPELINE_BIND_POINT_GRAPHICS, *handle);
  }
  pipeline.layout().push(*commands, *block);
  if (anew || set_pipeline_ != *handle || set_state_ != command.state ||
      set_restart_ != indices.restarts) {
    if (auto s = set_state(*commands, command, indices.restarts); !s) return s;
  }
  set_in_ = pass_.number();
  set_pipeline_ = *handle;
  set_state_ = command.state;
  set_restart_ = indices.restarts;
  const rtapi::DrawIndexedArguments& a = command.arguments;
  if (!command.indexed) {
    vk.vkCmdDraw(*commands, a.IndexCountPerInstance, a.InstanceCount, a.StartIndexLocation,
                 a.StartInstanceLocation);
    return {};
  }
  vk.vkCmdBindIndexBuffer(*commands, indices.buffer, indices.offset, indices.type);
  vk.vkCmdDrawIndexed(*commands, a.IndexCountPerInstance, a.InstanceCount, indices.first,
                      a.BaseVertexLocation, a.StartInstanceLocation);
  return {};
}

void DrawPass::barrier() {
  pass_.end();
  environment_.stream->everything();
}

CountedOutcome DrawPass::flush() {
  CountedOutcome outcome;
  CommandStream& stream = *environment_.stream;
  outcome.status = pass_.finish();
  if (outcome.status) {
    const std::string label =
        waiting_.empty() ? "" : waiting_.front().label + " to " + waiting_.back().label;
    outcome.status = waiting_.empty() ? stream.flush() : flush_guarded(stream, label);
  }
  if (outcome.status) outcome.status = pass_.read_counts(counted_);
  for (const Waiting& draw : std::exchange(waiting_, {})) {
    add_counts(draw.status, outcome.statistics);
    if (outcome.status) outcome.status = status_of(draw.status, 0, 0, draw.label);
  }
  blocks_.reset();
  index_memory_.reset();
  has_scene_ = false;
  set_state_.reset();
  set_in_ = 0;
  return outcome;
}

}  // namespace kaamos::vulkan

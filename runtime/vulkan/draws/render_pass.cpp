// SPDX-License-Identifier: MIT
#include "runtime/vulkan/draws/render_pass.h"

#include <algorithm>
#include <array>
#include <utility>

#include "runtime/vulkan/textures/clear_value.h"
#include "runtime/vulkan/textures/image.h"

namespace kaamos::vulkan {
namespace {

using runtime::ClearTargetCommand;
using runtime::TargetView;

// The same texels, whatever may be done to them.
bool same_view(const TargetView& a, const TargetView& b) {
  return a.texture == b.texture && a.format == b.format && a.mip == b.mip &&
         a.first_slice == b.first_slice && a.slice_count == b.slice_count;
}

bool covers(const RenderArea& area, const RenderArea& wanted) {
  return area.width >= wanted.width && area.height >= wanted.height;
}

VkRect2D rect_of(const rtapi::Rect& rect) {
  return {{rect.left, rect.top},
          {static_cast<uint32_t>(rect.right - rect.left),
           static_cast<uint32_t>(rect.bottom - rect.top)}};
}

VkImageAspectFlags aspects_to_clear(const ClearTargetCommand& command) {
  if (!command.depth_stencil) return VK_IMAGE_ASPECT_COLOR_BIT;
  VkImageAspectFlags aspects = command.clear_depth ? VK_IMAGE_ASPECT_DEPTH_BIT : 0;
  if (command.clear_stencil && rtapi::HasStencil(command.view.format)) {
    aspects |= VK_IMAGE_ASPECT_STENCIL_BIT;
  }
  return aspects;
}

VkClearValue value_of(const ClearTargetCommand& command) {
  VkClearValue value = {};
  if (command.depth_stencil) {
    value.depthStencil = clear_depth(command);
  } else {
    value.color = clear_color(command.view.format, command.color);
  }
  return value;
}

rtapi::Result<VkImageView> view_of(const TargetView& target) {
  if (target.texture == nullptr) return VkImageView{VK_NULL_HANDLE};
  return static_cast<Image&>(*target.texture).target_view(target);
}

VkRenderingAttachmentInfo attachment_of(VkImageView view) {
  VkRenderingAttachmentInfo info = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  info.imageView = view;
  info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
  info.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  return info;
}

void begin_with_clear(VkRenderingAttachmentInfo& info, const ClearTargetCommand& command) {
  info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  info.clearValue = value_of(command);
}

}  // namespace

RenderArea area_of(const runtime::DrawTargets& targets, const RenderArea& wanted) {
  RenderArea area = {UINT32_MAX, UINT32_MAX, UINT32_MAX};
  bool any = false;
  const auto add = [&](const TargetView& view) {
    if (view.texture == nullptr) return;
    any = true;
    area.width = std::min(area.width, view.width);
    area.height = std::min(area.height, view.height);
    area.layers = std::min(area.layers, view.slice_count);
  };
  for (uint32_t i = 0; i < targets.color_count; ++i) add(targets.color[i]);
  add(targets.depth);
  return any ? area : wanted;
}

RenderPass::~RenderPass() {
  Gpu& gpu = stream_.gpu();
  gpu.vk().vkDestroyQueryPool(gpu.device(), queries_, nullptr);
}

rtapi::Result<VkCommandBuffer> RenderPass::open(const runtime::DrawTargets& targets,
                                                const RenderArea& wanted,
                                                const std::string& label) {
  const RenderArea area = area_of(targets, wanted);
  if (open_ && targets_ == targets && covers(area_, area)) return commands_;
  if (auto s = begin(targets, area, label, true); !s) return s.error();
  begin_counting();
  return commands_;
}

const ClearTargetCommand* RenderPass::waiting_for(const TargetView& view,
                                                  const RenderArea& area) const {
  const bool whole =
      view.width == area.width && view.height == area.height && view.slice_count == area.layers;
  if (view.texture == nullptr || !whole) return nullptr;
  const auto it =
      std::find_if(waiting_.begin(), waiting_.end(),
                   [&](const ClearTargetCommand& one) { return same_view(one.view, view); });
  return it == waiting_.end() ? nullptr : &*it;
}

rtapi::Status RenderPass::begin(const runtime::DrawTargets& targets, const RenderArea& area,
                                const std::string& label, bool take_clears) {
  end();
  std::array<VkRenderingAttachmentInfo, rtapi::kSimultaneousRenderTargetCount> colors;
  std::vector<const ClearTargetCommand*> taken;
  const auto take = [&](const TargetView& view) {
    const ClearTargetCommand* clear = take_clears ? waiting_for(view, area) : nullptr;
    if (clear != nullptr) taken.push_back(clear);
    return clear;
  };
  for (uint32_t i = 0; i < targets.color_count; ++i) {
    auto view = view_of(targets.color[i]);
    if (!view) return view.error();
    colors[i] = attachment_of(*view);
    if (const auto* clear = take(targets.color[i])) begin_with_clear(colors[i], *clear);
  }
  auto depth_view = view_of(targets.depth);
  if (!depth_view) return depth_view.error();
  VkRenderingAttachmentInfo depth = attachment_of(*depth_view);
  VkRenderingAttachmentInfo stencil = depth;
  if (const auto* clear = take(targets.depth)) {
    const VkImageAspectFlags aspects = aspects_to_clear(*clear);
    if ((aspects & VK_IMAGE_ASPECT_DEPTH_BIT) != 0) begin_with_clear(depth, *clear);
    if ((aspects & VK_IMAGE_ASPECT_STENCIL_BIT) != 0) begin_with_clear(stencil, *clear);
  }
  // The others come first.
  for (const ClearTargetCommand& clear : std::exchange(waiting_, {})) {
    const bool is_taken = std::any_of(taken.begin(), taken.end(), [&](const auto* one) {
      return same_view(one->view, clear.view);
    });
    if (is_taken) continue;
    if (auto s = clear_alone(clear); !s) return s;
  }
  stream_.everything();
  auto commands = stream_.record(label);
  if (!commands) return commands.error();
  commands_ = *commands;
  if (queries_ != VK_NULL_HANDLE) {
    stream_.gpu().vk().vkCmdResetQueryPool(commands_, queries_, 0, 1);
  }
  if (counting_.what().any()) {
    if (auto s = counting_.prepare(commands_); !s) return s;
  }
  VkRenderingInfo info = {VK_STRUCTURE_TYPE_RENDERING_INFO};
  info.renderArea = {{0, 0}, {area.width, area.height}};
  info.layerCount = area.layers;
  info.colorAttachmentCount = targets.color_count;
  info.pColorAttachments = colors.data();
  if (*depth_view != VK_NULL_HANDLE) {
    info.pDepthAttachment = &depth;
    if (rtapi::HasStencil(targets.depth.format)) info.pStencilAttachment = &stencil;
  }
  stream_.gpu().vk().vkCmdBeginRendering(commands_, &info);
  open_ = true;
  ++number_;
  targets_ = targets;
  area_ = area;
  return {};
}

void RenderPass::begin_counting() {
  if (!counting_.what().any()) return;
  counting_.begin(commands_);
  counts_open_ = true;
}

rtapi::Status RenderPass::keep_memory_writes() {
  // A query of samples that counts does the same.
  if (query_open_ || (counts_open_ && counting_.what().samples)) return {};
  Gpu& gpu = stream_.gpu();
  if (queries_ == VK_NULL_HANDLE) {
    VkQueryPoolCreateInfo info = {VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    info.queryType = VK_QUERY_TYPE_OCCLUSION;
    info.queryCount = 1;
    const VkResult r = gpu.vk().vkCreateQueryPool(gpu.device(), &info, nullptr, &queries_);
    if (r != VK_SUCCESS) return gpu.error(r, "an occlusion query");
    // Queries are reset outside of renderings.
    if (auto s = begin(runtime::DrawTargets(targets_), area_, "draws", false); !s) return s;
    begin_counting();
  }
  gpu.vk().vkCmdBeginQuery(commands_, queries_, 0, VK_QUERY_CONTROL_PRECISE_BIT);
  query_open_ = true;
  return {};
}

void RenderPass::end() {
  if (!open_) return;
  const VolkDeviceTable& vk = stream_.gpu().vk();
  if (query_open_) vk.vkCmdEndQuery(commands_, queries_, 0);
  if (counts_open_) counting_.end(commands_);
  vk.vkCmdEndRendering(commands_);
  open_ = query_open_ = counts_open_ = false;
  stream_.everything();
}

rtapi::Status RenderPass::finish() {
  end();
  return clear_waiting();
}

rtapi::Status RenderPass::clear_waiting() {
  for (const ClearTargetCommand& clear : std::exchange(waiting_, {})) {
    if (auto s = clear_alone(clear); !s) return s;
  }
  return {};
}

RenderPass::Place RenderPass::place_of(const ClearTargetCommand& command) const {
  // A clear is no work that counts.
  if (!open_ || counts_open_) return {};
  const bool whole = command.view.slice_count == area_.layers &&
                     command.view.width == area_.width && command.view.height == area_.height;
  if (!whole) return {};
  if (command.depth_stencil) return {same_view(command.view, targets_.depth), 0};
  for (uint32_t i = 0; i < targets_.color_count; ++i) {
    if (same_view(command.view, targets_.color[i])) return {true, i};
  }
  return {};
}

rtapi::Status RenderPass::clear(const ClearTargetCommand& command) {
  if (aspects_to_clear(command) == 0) return {};
  if (const Place place = place_of(command); place.found) {
    clear_inside(command, place.attachment);
    return {};
  }
  end();
  const auto overlaps = [&](const ClearTargetCommand& one) {
    return one.view.texture == command.view.texture && !same_view(one.view, command.view);
  };
  if (!command.whole || std::any_of(waiting_.begin(), waiting_.end(), overlaps)) {
    if (auto s = clear_waiting(); !s) return s;
  }
  if (!command.whole) return clear_alone(command);
  for (ClearTargetCommand& one : waiting_) {
    if (!same_view(one.view, command.view)) continue;
    const ClearTargetCommand before = std::exchange(one, command);
    if (before.clear_depth && !one.clear_depth) one.depth = before.depth;
    if (before.clear_stencil && !one.clear_stencil) one.stencil = before.stencil;
    one.clear_depth = one.clear_depth || before.clear_depth;
    one.clear_stencil = one.clear_stencil || before.clear_stencil;
    return {};
  }
  waiting_.push_back(command);
  return {};
}

// A rendering of its own.
rtapi::Status RenderPass::clear_alone(const ClearTargetCommand& command) {
  runtime::DrawTargets targets;
  if (command.depth_stencil) {
    targets.depth = command.view;
  } else {
    targets.color[0] = command.view;
    targets.color_count = 1;
  }
  const char* const label =
      command.depth_stencil ? "ClearDepthStencilView" : "ClearRenderTargetView";
  if (auto s = begin(targets, area_of(targets, {}), label, false); !s) return s;
  clear_inside(command, 0);
  end();
  return {};
}

void RenderPass::clear_inside(const ClearTargetCommand& command, uint32_t attachment) {
  const VkClearAttachment what = {aspects_to_clear(command), attachment, value_of(command)};
  std::vector<VkClearRect> rects;
  if (command.whole) {
    rects.push_back({{{0, 0}, {area_.width, area_.height}}, 0, area_.layers});
  }
  for (const rtapi::Rect& rect : command.rects) rects.push_back({rect_of(rect), 0, area_.layers});
  stream_.gpu().vk().vkCmdClearAttachments(commands_, 1, &what, static_cast<uint32_t>(rects.size()),
                                           rects.data());
}

}  // namespace kaamos::vulkan

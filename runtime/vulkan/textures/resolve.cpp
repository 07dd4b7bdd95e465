// SPDX-License-Identifier: MIT
#include "runtime/vulkan/textures/resolve.h"

#include "runtime/vulkan/textures/image.h"
#include "runtime/vulkan/textures/texture_format.h"

namespace kaamos::vulkan {
namespace {

Image& image_of(const runtime::TextureCopyPlace& place) {
  return static_cast<Image&>(*place.texture);
}

VkImageSubresourceLayers layers_of(const runtime::TextureCopyPlace& place) {
  return {VK_IMAGE_ASPECT_COLOR_BIT, place.mip, place.array_element, 1};
}

VkOffset3D offset_of(const runtime::TextureCopyPlace& place) {
  return {static_cast<int32_t>(place.origin[0]), static_cast<int32_t>(place.origin[1]), 0};
}

bool has_format(const runtime::TextureCopyPlace& place, rtapi::Format format) {
  return image_format(image_of(place).desc()).format == texture_format(format).format;
}

runtime::TargetView view_of(const runtime::TextureCopyPlace& place, rtapi::Format format) {
  const VkExtent3D extent = image_of(place).extent(place.mip);
  runtime::TargetView view;
  view.texture = place.texture;
  view.format = format;
  view.mip = place.mip;
  view.first_slice = place.array_element;
  view.width = extent.width;
  view.height = extent.height;
  view.samples = image_of(place).desc().SampleDesc.Count;
  return view;
}

void resolve_images(CommandStream& stream, VkCommandBuffer commands,
                    const runtime::ResolveCommand& command) {
  VkImageResolve region = {};
  region.srcSubresource = layers_of(command.source);
  region.srcOffset = offset_of(command.source);
  region.dstSubresource = layers_of(command.dest);
  region.dstOffset = offset_of(command.dest);
  region.extent = {command.extent[0], command.extent[1], 1};
  stream.gpu().vk().vkCmdResolveImage(commands, image_of(command.source).handle(),
                                      VK_IMAGE_LAYOUT_GENERAL, image_of(command.dest).handle(),
                                      VK_IMAGE_LAYOUT_GENERAL, 1, &region);
}

// As a rendering that draws nothing, whose views have the format.
rtapi::Status resolve_views(CommandStream& stream, VkCommandBuffer commands,
                            const runtime::ResolveCommand& command) {
  auto source = image_of(command.source).target_view(view_of(command.source, command.format));
  if (!source) return source.error();
  auto dest = image_of(command.dest).target_view(view_of(command.dest, command.format));
  if (!dest) return dest.error();
  VkRenderingAttachmentInfo attachment = {VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  attachment.imageView = *source;
  attachment.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
  attachment.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
  attachment.resolveImageView = *dest;
  attachment.resolveImageLayout = VK_IMAGE_LAYOUT_GENERAL;
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo info = {VK_STRUCTURE_TYPE_RENDERING_INFO};
  const VkOffset3D offset = offset_of(command.dest);
  info.renderArea = {{offset.x, offset.y}, {command.extent[0], command.extent[1]}};
  info.layerCount = 1;
  info.colorAttachmentCount = 1;
  info.pColorAttachments = &attachment;
  const VolkDeviceTable& vk = stream.gpu().vk();
  vk.vkCmdBeginRendering(commands, &info);
  vk.vkCmdEndRendering(commands);
  return {};
}

}  // namespace

rtapi::Status resolve(CommandStream& stream, const runtime::ResolveCommand& command) {
  stream.everything();
  auto commands = stream.record("ResolveSubresource");
  if (!commands) return commands.error();
  const bool moves = command.dest.origin[0] != command.source.origin[0] ||
                     command.dest.origin[1] != command.source.origin[1];
  const bool own_format =
      has_format(command.dest, command.format) && has_format(command.source, command.format);
  // A rendering resolves to the same place only.
  if (own_format || moves) {
    resolve_images(stream, *commands, command);
  } else if (auto s = resolve_views(stream, *commands, command); !s) {
    return s;
  }
  stream.keep(command.source.texture);
  stream.keep(command.dest.texture);
  return {};
}

}  // namespace kaamos::vulkan

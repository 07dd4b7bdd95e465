// SPDX-License-Identifier: MIT
#include "runtime/vulkan/draws/vertex_input.h"

#include <algorithm>
#include <string>

#include "runtime/backend/errors.h"
#include "runtime/vulkan/textures/texture_format.h"

namespace kaamos::vulkan {
namespace {

bool can_be_vertices(const Gpu& gpu, const TextureFormat& format) {
  VkFormatProperties properties;
  vkGetPhysicalDeviceFormatProperties(gpu.physical_device(), format.format, &properties);
  const bool has_all_channels = format.channels.a == VK_COMPONENT_SWIZZLE_A;
  return has_all_channels && (properties.bufferFeatures & VK_FORMAT_FEATURE_VERTEX_BUFFER_BIT) != 0;
}

uint32_t binding_of(const runtime::LinkedElement& element, std::vector<VertexBinding>& bindings) {
  const uint32_t end = element.offset_bytes + rtapi::GetFormatInfo(element.format).bytes;
  for (size_t i = 0; i < bindings.size(); ++i) {
    VertexBinding& known = bindings[i];
    if (known.slot != element.slot || known.per_instance != element.per_instance ||
        known.step_rate != element.step_rate) {
      continue;
    }
    known.extent_bytes = std::max(known.extent_bytes, end);
    return static_cast<uint32_t>(i);
  }
  bindings.push_back({element.slot, element.per_instance, element.step_rate, end});
  return static_cast<uint32_t>(bindings.size() - 1);
}

VkFormat zero_format(rtapi::Format format) {
  switch (rtapi::GetFormatInfo(format).type) {
    case rtapi::FormatClass::kUint:
      return VK_FORMAT_R32G32B32A32_UINT;
    case rtapi::FormatClass::kSint:
      return VK_FORMAT_R32G32B32A32_SINT;
    default:
      return VK_FORMAT_R32G32B32A32_SFLOAT;
  }
}

// The number of the input, which is its location.
uint32_t location_of(const shader::GraphicsDesc& code, uint32_t first_column) {
  uint32_t i = 0;
  while (i < code.input_count && code.inputs[i].first_column != first_column) ++i;
  return i;
}

}  // namespace

rtapi::Result<VertexInput> vertex_input(const Gpu& gpu, const runtime::LinkedGraphics& linked) {
  VertexInput result;
  for (const runtime::LinkedElement& element : linked.elements) {
    const TextureFormat format = texture_format(element.format);
    if (!can_be_vertices(gpu, format)) {
      return runtime::make_error(runtime::Id::kVertexFormatUnsupported,
                                 "graphics pipeline \"" + linked.name +
                                     "\" has an element of DXGI format " +
                                     std::to_string(static_cast<uint32_t>(element.format)) +
                                     " in slot " + std::to_string(element.slot) +
                                     ", which vertices on " + gpu.info().Name + " cannot have.");
    }
    result.attributes.push_back({location_of(linked.vertex_desc(), element.first_column),
                                 binding_of(element, result.bindings), format.format,
                                 element.offset_bytes});
    result.zero_formats.push_back(zero_format(element.format));
  }
  return result;
}

}  // namespace kaamos::vulkan

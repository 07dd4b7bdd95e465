// SPDX-License-Identifier: MIT
#include "runtime/vulkan/textures/clear_value.h"

#include <algorithm>
#include <cmath>

namespace kaamos::vulkan {
namespace {

double limited(double value, double low, double high) {
  if (std::isnan(value)) return 0;
  return std::min(std::max(std::trunc(value), low), high);
}

uint32_t component_bits(rtapi::Format format, int component) {
  const uint32_t bits = rtapi::GetFormatInfo(format).channel_bits;
  if (bits != 0) return bits;
  return component == 3 ? 2 : 10;  // R10G10B10A2
}

float nearest_step(float depth, double steps) {
  return static_cast<float>(std::floor(static_cast<double>(depth) * steps + 0.5) / steps);
}

}  // namespace

VkClearColorValue clear_color(rtapi::Format format, const float color[4]) {
  VkClearColorValue value = {};
  const rtapi::FormatClass type = rtapi::GetFormatInfo(format).type;
  for (int i = 0; i < 4; ++i) {
    const auto given = static_cast<double>(color[i]);
    const double range = std::ldexp(1.0, static_cast<int>(component_bits(format, i)));
    if (type == rtapi::FormatClass::kUint) {
      value.uint32[i] = static_cast<uint32_t>(limited(given, 0, range - 1));
    } else if (type == rtapi::FormatClass::kSint) {
      value.int32[i] = static_cast<int32_t>(limited(given, -range / 2, range / 2 - 1));
    } else {
      value.float32[i] = color[i];
    }
  }
  return value;
}

VkClearDepthStencilValue clear_depth(const runtime::ClearTargetCommand& command) {
  VkClearDepthStencilValue value = {command.depth, command.stencil};
  if (command.view.format == rtapi::Format::kD16Unorm) {
    value.depth = nearest_step(command.depth, 65535);
  } else if (command.view.format == rtapi::Format::kD24UnormS8Uint) {
    value.depth = nearest_step(command.depth, 16777215);
  }
  return value;
}

}  // namespace kaamos::vulkan

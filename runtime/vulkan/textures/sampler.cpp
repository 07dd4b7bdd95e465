// SPDX-License-Identifier: MIT
#include "runtime/vulkan/textures/sampler.h"
#include "runtime/backend/errors.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>

namespace kaamos::vulkan {
namespace {

using rtapi::SamplerDesc;
using rtapi::TextureAddressMode;

// Bits of D3D12_FILTER.
constexpr uint32_t kMipLinear = 0x1;
constexpr uint32_t kMagLinear = 0x4;
constexpr uint32_t kMinLinear = 0x10;
constexpr uint32_t kAnisotropic = 0x40;
constexpr uint32_t kReduction = 0x180;
constexpr uint32_t kComparison = 0x80;
constexpr uint32_t kMinimum = 0x100;

bool equal(const SamplerDesc& a, const SamplerDesc& b) {
  static_assert(sizeof(SamplerDesc) == 13 * 4);  // it has no padding
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

VkSamplerAddressMode address_mode(TextureAddressMode mode) {
  switch (mode) {
    case TextureAddressMode::kMirror:
      return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case TextureAddressMode::kClamp:
      return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    case TextureAddressMode::kBorder:
      return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER;
    case TextureAddressMode::kMirrorOnce:
      return VK_SAMPLER_ADDRESS_MODE_MIRROR_CLAMP_TO_EDGE;
    default:
      return VK_SAMPLER_ADDRESS_MODE_REPEAT;
  }
}

// One of Vulkan's fixed colours; none if it needs a custom one.
std::optional<VkBorderColor> fixed_border(const float color[4]) {
  const auto is = [&](float rgb, float a) {
    return color[0] == rgb && color[1] == rgb && color[2] == rgb && color[3] == a;
  };
  if (is(0, 0)) return VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;
  if (is(0, 1)) return VK_BORDER_COLOR_FLOAT_OPAQUE_BLACK;
  if (is(1, 1)) return VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE;
  return std::nullopt;
}

rtapi::Error lacking(const Gpu& gpu, const char* what) {
  return runtime::make_error(runtime::Id::kSamplerUnsupported,
                             gpu.info().Name + " has no " + what + ".");
}

// Replaces numbers that comparisons and clamps cannot handle by plain ones.
float lod(float value) {
  return std::clamp(value, -VK_LOD_CLAMP_NONE, VK_LOD_CLAMP_NONE);
}

}  // namespace

SamplerPool::~SamplerPool() {
  for (const Known& known : known_) {
    gpu_->vk().vkDestroySampler(gpu_->device(), known.sampler, nullptr);
  }
}

rtapi::Result<uint64_t> SamplerPool::sampler(const SamplerDesc& desc) {
  const std::lock_guard lock(mutex_);
  for (const Known& known : known_) {
    if (equal(known.desc, desc)) return uint64_t{known.index};
  }
  const auto filter = static_cast<uint32_t>(desc.Filter);
  const VkPhysicalDeviceLimits& limits = gpu_->properties().core.limits;
  VkSamplerCreateInfo info = {VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
  info.magFilter = (filter & kMagLinear) != 0 ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
  info.minFilter = (filter & kMinLinear) != 0 ? VK_FILTER_LINEAR : VK_FILTER_NEAREST;
  info.mipmapMode =
      (filter & kMipLinear) != 0 ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = address_mode(desc.AddressU);
  info.addressModeV = address_mode(desc.AddressV);
  info.addressModeW = address_mode(desc.AddressW);
  info.mipLodBias =
      std::clamp(desc.MipLODBias, -limits.maxSamplerLodBias, limits.maxSamplerLodBias);
  info.anisotropyEnable =
      (filter & kAnisotropic) != 0 && desc.MaxAnisotropy > 1 && gpu_->features().sampler_anisotropy;
  info.maxAnisotropy = std::clamp(static_cast<float>(desc.MaxAnisotropy), 1.0f,
                                  std::max(limits.maxSamplerAnisotropy, 1.0f));
  info.compareEnable = (filter & kReduction) == kComparison;
  if (info.compareEnable && desc.ComparisonFunc != rtapi::ComparisonFunc::kNone) {
    info.compareOp = static_cast<VkCompareOp>(static_cast<uint32_t>(desc.ComparisonFunc) - 1);
  }
  info.minLod = lod(desc.MinLOD);
  info.maxLod = std::max(lod(desc.MaxLOD), info.minLod);

  VkSamplerCustomBorderColorCreateInfoEXT border = {
      VK_STRUCTURE_TYPE_SAMPLER_CUSTOM_BORDER_COLOR_CREATE_INFO_EXT};
  VkSamplerReductionModeCreateInfo reduction = {
      VK_STRUCTURE_TYPE_SAMPLER_REDUCTION_MODE_CREATE_INFO};
  const TextureAddressMode modes[] = {desc.AddressU, desc.AddressV, desc.AddressW};
  const auto any = [&](TextureAddressMode mode) {
    return std::find(std::begin(modes), std::end(modes), mode) != std::end(modes);
  };
  if (any(TextureAddressMode::kMirrorOnce) && !gpu_->features().mirror_clamp_to_edge) {
    return lacking(*gpu_, "address mode kMirrorOnce (samplerMirrorClampToEdge)");
  }
  if (any(TextureAddressMode::kBorder)) {
    const auto fixed = fixed_border(desc.BorderColor);
    if (!fixed && !gpu_->features().custom_border_color) {
      return lacking(*gpu_,
                     "border colours other than transparent black, opaque black and opaque white "
                     "(VK_EXT_custom_border_color)");
    }
    info.borderColor = fixed.value_or(VK_BORDER_COLOR_FLOAT_CUSTOM_EXT);
    if (!fixed) {
      std::copy_n(desc.BorderColor, 4, border.customBorderColor.float32);
      border.pNext = info.pNext;
      info.pNext = &border;
    }
  }
  if ((filter & kReduction) >= kMinimum) {
    if (!gpu_->features().sampler_filter_minmax) {
      return lacking(*gpu_, "minimum and maximum filters (samplerFilterMinmax)");
    }
    reduction.reductionMode = (filter & kReduction) == kMinimum ? VK_SAMPLER_REDUCTION_MODE_MIN
                                                                : VK_SAMPLER_REDUCTION_MODE_MAX;
    reduction.pNext = info.pNext;
    info.pNext = &reduction;
  }
  Known known = {desc, VK_NULL_HANDLE, 0};
  const VkResult r = gpu_->vk().vkCreateSampler(gpu_->device(), &info, nullptr, &known.sampler);
  if (r != VK_SUCCESS) return gpu_->error(r, "a sampler");
  auto index = descriptors_->add_sampler(known.sampler);
  if (!index) {
    gpu_->vk().vkDestroySampler(gpu_->device(), known.sampler, nullptr);
    return index.error();
  }
  known.index = *index;
  known_.push_back(known);
  return uint64_t{known.index};
}

}  // namespace kaamos::vulkan

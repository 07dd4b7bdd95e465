// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_webp.h"

#include <algorithm>
#include <string_view>

#ifdef KAAMOS_HAS_WEBP
#include <webp/decode.h>

#include <memory>
#endif

namespace kaamos::effects {

bool is_webp(std::span<const std::uint8_t> bytes) {
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()),
                               std::min<std::size_t>(bytes.size(), 12));
  return start.starts_with("RIFF") && start.ends_with("WEBP") && start.size() == 12;
}

#ifdef KAAMOS_HAS_WEBP

bool can_read_webp() {
  return true;
}

std::optional<WebpHeader> read_webp_header(std::span<const std::uint8_t> bytes) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(bytes.data(), bytes.size(), &features) != VP8_STATUS_OK) return {};
  return WebpHeader{features.width, features.height, features.has_animation != 0};
}

bool decode_webp(std::span<const std::uint8_t> bytes, TextureImage& to) {
  int width = 0, height = 0;
  const std::unique_ptr<std::uint8_t, void (*)(void*)> texels(
      WebPDecodeRGBA(bytes.data(), bytes.size(), &width, &height), &WebPFree);
  if (!texels) return false;
  to.width = static_cast<std::uint32_t>(width);
  to.height = static_cast<std::uint32_t>(height);
  to.mips.emplace_back(texels.get(), texels.get() + std::size_t{to.width} * to.height * 4);
  return true;
}

#else

bool can_read_webp() {
  return false;
}

std::optional<WebpHeader> read_webp_header(std::span<const std::uint8_t>) {
  return {};
}

bool decode_webp(std::span<const std::uint8_t>, TextureImage&) {
  return false;
}

#endif

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/byte_sampling.h"

#include <algorithm>
#include <array>

#include "kaamos/shader/texture_view.h"
#include "runtime/shader/texture/format_codec.h"
#include "runtime/shader/texture/level_of_detail.h"
#include "runtime/shader/texture/texture_address.h"

namespace kaamos::shader {
namespace {

constexpr uint32_t kR8G8B8A8Unorm = 28;
constexpr uint32_t kR8G8B8A8UnormSrgb = 29;

// Filter numbers; anisotropic filters count as linear ones. [D3D12_ENCODE_BASIC_FILTER]
constexpr uint32_t kAllLinear = 0x15, kAnisotropic = 0x40;

using Channels = float __attribute__((vector_size(16)));
using Bytes4 = uint8_t __attribute__((vector_size(4)));

// Instead of a division for each texel's alpha: 4 % of a sample's time.
constexpr std::array<float, 256> kUnormToFloat = [] {
  std::array<float, 256> table{};
  for (uint32_t i = 0; i < 256; ++i) table[i] = static_cast<float>(i) / 255.0f;
  return table;
}();

template <bool Srgb>
[[gnu::always_inline]] inline Channels byte_texel(const uint8_t* at) {
  if constexpr (Srgb) {
    return Channels{srgb_to_linear(at[0]), srgb_to_linear(at[1]), srgb_to_linear(at[2]),
                    kUnormToFloat[at[3]]};
  } else {
    Bytes4 bytes;
    __builtin_memcpy(&bytes, at, sizeof(bytes));
    return __builtin_convertvector(bytes, Channels) / 255.0f;
  }
}

template <bool Srgb>
[[gnu::always_inline]] inline Channels bytes_on_mip(const TextureMip& mip,
                                                    const SamplerState& sampler, const float* u) {
  const LinearTaps x = linear_taps(static_cast<AddressMode>(sampler.address[0]), u[0],
                                   static_cast<int32_t>(mip.width), 0);
  const LinearTaps y = linear_taps(static_cast<AddressMode>(sampler.address[1]), u[1],
                                   static_cast<int32_t>(mip.height), 0);
  const auto row = [&](int32_t at) {
    const uint8_t* texels = mip.texels + static_cast<uint64_t>(at) * mip.row_pitch;
    const Channels first = byte_texel<Srgb>(texels + uint64_t{4} * static_cast<uint32_t>(x.first));
    const Channels second =
        byte_texel<Srgb>(texels + uint64_t{4} * static_cast<uint32_t>(x.second));
    return first + x.weight * (second - first);
  };
  const Channels first = row(y.first);
  return first + y.weight * (row(y.second) - first);
}

template <bool Srgb>
Texel sample_mips_of_bytes(const TextureMip* mips, float weight, const SamplerState& sampler,
                           const float* u) {
  Channels color = bytes_on_mip<Srgb>(mips[0], sampler, u);
  if (weight != 0.0f) color += weight * (bytes_on_mip<Srgb>(mips[1], sampler, u) - color);
  Texel texel;
  __builtin_memcpy(texel.bits, &color, sizeof(texel.bits));
  return texel;
}

bool is_there(const TextureMip& mip) {
  return mip.texels != nullptr && mip.width != 0 && mip.height != 0;
}

bool has_no_border(uint32_t mode) {
  return mode == static_cast<uint32_t>(AddressMode::kWrap) ||
         mode == static_cast<uint32_t>(AddressMode::kMirror) ||
         mode == static_cast<uint32_t>(AddressMode::kClamp);
}

}  // namespace

bool sample_bytes(const SampleArguments& arguments, Texel& texel) {
  const TextureView* view = texture_view(*arguments.texture);
  const SamplerState* sampler = sampler_state(*arguments.sampler);
  if (view == nullptr || sampler == nullptr) return false;
  const bool srgb = view->direct_format == kR8G8B8A8UnormSrgb;
  const uint32_t filter = sampler->filter & ~kAnisotropic;
  if ((!srgb && view->direct_format != kR8G8B8A8Unorm) || filter != kAllLinear ||
      !has_no_border(sampler->address[0]) || !has_no_border(sampler->address[1]) ||
      (arguments.offset[0] | arguments.offset[1]) != 0) {
    return false;
  }
  const float last = static_cast<float>(view->mip_count - 1);
  float lod = clamped_lod(*view, *sampler, arguments.min_lod, arguments.lod);
  lod = lod > 0 ? std::min(lod, last) : 0.0f;
  const auto level = static_cast<uint32_t>(lod);
  const float weight = lod - static_cast<float>(level);
  const TextureMip* mips = view->mips + level;
  if (!is_there(mips[0]) || (weight != 0.0f && !is_there(mips[1]))) return false;
  texel = srgb ? sample_mips_of_bytes<true>(mips, weight, *sampler, arguments.coordinates)
               : sample_mips_of_bytes<false>(mips, weight, *sampler, arguments.coordinates);
  return true;
}

}  // namespace kaamos::shader

// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/byte_sampling.h"

#include <algorithm>
#include <array>

#include "kaamos/shader/cpu_level.h"
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

using Floats4 = float __attribute__((vector_size(16)));
using Channels = Floats4;
using Ints4 = int32_t __attribute__((vector_size(16)));
using Bytes4 = uint8_t __attribute__((vector_size(4)));

// Replaces a division for each texel's alpha, which saves 4 % of a sample's time.
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

// fast_floor() of each component.
[[gnu::always_inline]] inline Floats4 floor_of(Floats4 x) {
  const Ints4 has_fraction = ((Ints4)x & 0x7FFFFFFF) < 0x4B000000;  // below 2^23
  const Floats4 in_range = (Floats4)((Ints4)x & has_fraction);
  const Floats4 truncated =
      __builtin_convertvector(__builtin_convertvector(in_range, Ints4), Floats4);
  return has_fraction ? (truncated > x ? truncated - 1.0f : truncated) : x;
}

// linear_taps() along both axes for both mips at once: u and v on the first mip, then u and v on
// the second.
struct Taps {
  Ints4 first;
  Ints4 second;
  Floats4 weight;
};

[[gnu::always_inline]] inline Taps taps_of(const SamplerState& sampler, const float* u,
                                           const TextureMip& mip, const TextureMip& next) {
  const auto mode0 = static_cast<int32_t>(sampler.address[0]);
  const auto mode1 = static_cast<int32_t>(sampler.address[1]);
  const Ints4 mode = {mode0, mode1, mode0, mode1};
  const Ints4 clamps = mode == static_cast<int32_t>(AddressMode::kClamp);
  const Ints4 mirrors = mode == static_cast<int32_t>(AddressMode::kMirror);
  const Ints4 size = {static_cast<int32_t>(mip.width), static_cast<int32_t>(mip.height),
                      static_cast<int32_t>(next.width), static_cast<int32_t>(next.height)};
  const Ints4 period = mirrors ? size + size : size;
  const Floats4 at = {u[0], u[1], u[0], u[1]};
  const Floats4 repeats = mirrors ? Floats4{} + 2.0f : Floats4{} + 1.0f;
  const Floats4 part = mirrors ? Floats4{} + 0.5f : Floats4{} + 1.0f;
  Floats4 reduced = clamps ? at : at - repeats * floor_of(at * part);
  reduced = reduced == reduced ? reduced : Floats4{};
  const Floats4 x = reduced * __builtin_convertvector(size, Floats4) - 0.5f;
  const Floats4 whole = floor_of(x);
  const Floats4 fraction = x - whole;
  // Past the edge of every texture, but far from overflow.
  const Floats4 near = whole > 0x1p28f ? Floats4{} + 0x1p28f : whole;
  const Ints4 i = __builtin_convertvector(near < -0x1p28f ? Floats4{} - 0x1p28f : near, Ints4);
  const auto texel = [&](Ints4 index) {
    const Ints4 last = size - 1;
    const Ints4 clamped = index < 0 ? Ints4{} : index < last ? index : last;
    const Ints4 wrapped =
        index + (index < 0 ? period : Ints4{}) - (index >= period ? period : Ints4{});
    return clamps ? clamped : wrapped < size ? wrapped : period - 1 - wrapped;
  };
  return {texel(i), texel(i + 1), fraction == fraction ? fraction : Floats4{}};
}

// Mip says which of the two mips.
template <bool Srgb, int Mip>
[[gnu::always_inline]] inline Channels bytes_on_mip(const TextureMip& mip, const Taps& taps) {
  constexpr int kX = 2 * Mip, kY = 2 * Mip + 1;
  const auto row = [&](int32_t at) {
    const uint8_t* texels = mip.texels + static_cast<uint64_t>(at) * mip.row_pitch;
    const Channels first =
        byte_texel<Srgb>(texels + uint64_t{4} * static_cast<uint32_t>(taps.first[kX]));
    const Channels second =
        byte_texel<Srgb>(texels + uint64_t{4} * static_cast<uint32_t>(taps.second[kX]));
    return first + taps.weight[kX] * (second - first);
  };
  const Channels first = row(taps.first[kY]);
  return first + taps.weight[kY] * (row(taps.second[kY]) - first);
}

template <bool Srgb>
[[gnu::always_inline]] inline Texel sample_mips_of_bytes(const TextureMip* mips, float weight,
                                                         const SamplerState& sampler,
                                                         const float* u) {
  const Taps taps = taps_of(sampler, u, mips[0], mips[weight != 0.0f ? 1 : 0]);
  Channels color = bytes_on_mip<Srgb, 0>(mips[0], taps);
  if (weight != 0.0f) color += weight * (bytes_on_mip<Srgb, 1>(mips[1], taps) - color);
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

[[gnu::always_inline]] inline bool sample_here(const SampleArguments& arguments, Texel& texel) {
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

#if defined(__x86_64__)
[[gnu::target("avx2")]] bool sample_by_avx2(const SampleArguments& arguments, Texel& texel) {
  return sample_here(arguments, texel);
}
#endif

}  // namespace

bool sample_bytes(const SampleArguments& arguments, Texel& texel) {
#if defined(__x86_64__)
  if (cpu_level() == CpuLevel::kAvx2) return sample_by_avx2(arguments, texel);
#endif
  return sample_here(arguments, texel);
}

}  // namespace kaamos::shader

// SPDX-License-Identifier: MIT
#include "runtime/shader/texture/texture_sampling.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "kaamos/shader/texture_view.h"
#include "runtime/shader/texture/byte_sampling.h"
#include "runtime/shader/texture/cube_face.h"
#include "runtime/shader/texture/format_codec.h"
#include "runtime/shader/texture/level_of_detail.h"
#include "runtime/shader/texture/texel_access.h"
#include "runtime/shader/texture/texture_address.h"

namespace kaamos::shader {
namespace {

constexpr uint32_t kR32G32B32A32Float = 2;
constexpr uint32_t kR8G8B8A8Unorm = 28;
constexpr uint32_t kR8G8B8A8UnormSrgb = 29;

// Values of the filter. [D3D12_ENCODE_BASIC_FILTER]
constexpr uint32_t kMipLinear = 1, kMagLinear = 4, kMinLinear = 16;
enum class Reduction : uint32_t { kStandard = 0, kComparison = 1, kMinimum = 2, kMaximum = 3 };

// A texel on its way through the filter: four floats (or the bits of integers) in one register.
using Channels = float __attribute__((vector_size(16)));
using Bytes4 = uint8_t __attribute__((vector_size(4)));
struct Color {
  Channels c;
};

bool is_cube(TextureDimension dimension) {
  return dimension == TextureDimension::kCube || dimension == TextureDimension::kCubeArray;
}

// The number of coordinates that address texels, and which one is the array element.
struct Axes {
  int spatial;
  int element;  // -1: none
};
Axes axes_of(TextureDimension dimension) {
  switch (dimension) {
    case TextureDimension::k1D:
      return {1, -1};
    case TextureDimension::k1DArray:
      return {1, 1};
    case TextureDimension::k2DArray:
      return {2, 2};
    case TextureDimension::k3D:
      return {3, -1};
    case TextureDimension::kCubeArray:
      return {2, 3};
    default:
      return {2, -1};
  }
}

bool passes(uint32_t comparison, float reference, float texel) {
  switch (comparison) {
    case 2:
      return reference < texel;
    case 3:
      return reference == texel;
    case 4:
      return reference <= texel;
    case 5:
      return reference > texel;
    case 6:
      return reference != texel;
    case 7:
      return reference >= texel;
    case 8:
      return true;
    default:
      return false;
  }
}

// One sample: where it reads, and how the texels are converted and blended.
class Sampling {
 public:
  Sampling(const SampleArguments& arguments, const TextureView& view, const SamplerState& sampler,
           bool compare)
      : arguments_(arguments),
        view_(view),
        sampler_(sampler),
        codec_(format_codec(view.format)),
        compare_(compare),
        axes_(axes_of(view.dimension)) {
    const auto reduction = static_cast<Reduction>(sampler.filter >> 7 & 3u);
    reduction_ = compare || reduction == Reduction::kComparison ? Reduction::kStandard : reduction;
    blends_ = compare || codec_.number == NumberClass::kFloat;
    reference_ = arguments.comparison;
    // As a depth buffer of that format would store it.
    if (codec_.normalized) reference_ = std::clamp(reference_, 0.0f, 1.0f);
    for (int i = 0; i < 3; ++i) u_[i] = arguments.coordinates[i];
    set_slice();
  }

  bool readable() const { return codec_.bytes != 0; }

  // `lod` is the level of detail before the sampler's bias and clamps.
  Color at_lod(float lod) const;
  float lod_of_gradients() const;
  // The texels of a footprint on mip 0, in gather's order.
  void gather_texels(Color texels[4]) const;

  Texel result(const Color& color) const {
    Texel texel;
    __builtin_memcpy(texel.bits, &color.c, sizeof(texel.bits));
    return compare_ ? texel : swizzled(view_, codec_.number, texel);
  }

 private:
  struct Place {  // the place of a footprint on one mip
    const TextureMip& mip;
    uint32_t slice;
  };

  void set_slice() {
    if (is_cube(view_.dimension)) {
      const double d[3] = {static_cast<double>(u_[0]), static_cast<double>(u_[1]),
                           static_cast<double>(u_[2])};
      const CubePlace place = cube_place(d);
      face_ = place.face;
      u_[0] = static_cast<float>(place.u);
      u_[1] = static_cast<float>(place.v);
    }
    if (axes_.element < 0) return;
    const uint32_t count = is_cube(view_.dimension) ? view_.slice_count / 6 : view_.slice_count;
    const float element = std::nearbyint(arguments_.coordinates[axes_.element]);
    const float last = count > 0 ? static_cast<float>(count - 1) : 0.0f;
    slice_ = element > 0 ? static_cast<uint32_t>(std::min(element, last)) : 0;  // NaN gives 0
  }

  uint32_t first_slice() const { return is_cube(view_.dimension) ? slice_ * 6 + face_ : slice_; }

  // Texels of a mip are only read if this is true.
  bool has_texels(const TextureMip& mip) const {
    if (mip.texels == nullptr || mip.width == 0 || mip.height == 0) return false;
    if (is_cube(view_.dimension)) {
      return mip.width == mip.height && slice_ * 6 + 5 < view_.slice_count;
    }
    return slice_ < (view_.dimension == TextureDimension::k3D ? mip.depth : view_.slice_count);
  }

  // No address mode applies at the edges of cube faces: seamless_texel() continues across them.
  AddressMode mode(int axis) const {
    return is_cube(view_.dimension) ? AddressMode::kClamp
                                    : static_cast<AddressMode>(sampler_.address[axis]);
  }

  Color on_mip(uint32_t mip, bool linear) const;
  Color linear_cube(const TextureMip& mip) const;
  Color linear_rows(const Place& place, int32_t z, const LinearTaps& x, const LinearTaps& y) const;
  void cube_taps(const TextureMip& mip, Color taps[4], float weights[2]) const;
  Color seamless_texel(const TextureMip& mip, int32_t x, int32_t y) const;
  Color texel(const TextureMip& mip, int32_t x, int32_t y, int32_t slice) const;
  Color border() const;
  Color compared(const Color& color) const {
    const bool pass = passes(sampler_.comparison, reference_, color.c[0]);
    return Color{Channels{pass ? 1.0f : 0.0f, 0, 0, 0}};
  }
  Color blend(const Color& a, const Color& b, float weight) const;

  const SampleArguments& arguments_;
  const TextureView& view_;
  const SamplerState& sampler_;
  const FormatCodec& codec_;
  bool compare_;
  Axes axes_;
  Reduction reduction_;
  bool blends_;
  float reference_;
  float u_[3];
  uint32_t slice_ = 0;
  uint32_t face_ = 0;
};

Color Sampling::border() const {
  Color color;
  for (int i = 0; i < 4; ++i) {
    const float value = sampler_.border_color[i];
    uint32_t bits = std::bit_cast<uint32_t>(value);
    if (codec_.number != NumberClass::kFloat) bits = value >= 0.5f ? 1u : 0u;
    if ((codec_.channels >> i & 1u) == 0) bits = missing_channel(codec_.number, i);
    color.c[i] = std::bit_cast<float>(bits);
  }
  return compare_ ? compared(color) : color;
}

// Indices must be in range or kBorderTexel.
[[gnu::always_inline]] inline Color Sampling::texel(const TextureMip& mip, int32_t x, int32_t y,
                                                    int32_t slice) const {
  if ((x | y | slice) < 0) return border();
  const uint8_t* at = mip.texels + static_cast<uint64_t>(slice) * mip.slice_pitch +
                      static_cast<uint64_t>(y) * mip.row_pitch +
                      static_cast<uint64_t>(x) * codec_.bytes;
  Color color;
  // The most common formats, without an indirect call.
  if (view_.format == kR8G8B8A8Unorm) {
    Bytes4 bytes;
    __builtin_memcpy(&bytes, at, sizeof(bytes));
    color.c = __builtin_convertvector(bytes, Channels) / 255.0f;
  } else if (view_.format == kR8G8B8A8UnormSrgb) {
    color.c = Channels{srgb_to_linear(at[0]), srgb_to_linear(at[1]), srgb_to_linear(at[2]),
                       static_cast<float>(at[3]) / 255.0f};
  } else if (view_.format == kR32G32B32A32Float) {
    __builtin_memcpy(&color.c, at, sizeof(color.c));
  } else {
    const Texel decoded = codec_.decode(at);
    __builtin_memcpy(&color.c, decoded.bits, sizeof(color.c));
  }
  return compare_ ? compared(color) : color;
}

// With a weight of 0, a NaN or infinity in the other texel has no effect.
[[gnu::always_inline]] inline Color Sampling::blend(const Color& a, const Color& b,
                                                    float weight) const {
  if (weight == 0.0f) return a;
  if (reduction_ == Reduction::kStandard) return Color{a.c + weight * (b.c - a.c)};
  Color result;
  for (int i = 0; i < 4; ++i) {
    result.c[i] =
        reduction_ == Reduction::kMinimum ? std::fmin(a.c[i], b.c[i]) : std::fmax(a.c[i], b.c[i]);
  }
  return result;
}

Color Sampling::linear_rows(const Place& place, int32_t z, const LinearTaps& x,
                            const LinearTaps& y) const {
  const auto row = [&](int32_t at) {
    const Color first = texel(place.mip, x.first, at, z);
    if (x.weight == 0.0f) return first;
    return blend(first, texel(place.mip, x.second, at, z), x.weight);
  };
  const Color first = row(y.first);
  return y.weight == 0.0f ? first : blend(first, row(y.second), y.weight);
}

Color Sampling::on_mip(uint32_t level, bool linear) const {
  const TextureMip& mip = view_.mips[level];
  if (!has_texels(mip)) return Color{Channels{}};
  const auto size = [](uint32_t n) { return static_cast<int32_t>(n); };
  const int32_t* offset = arguments_.offset;
  const bool is_1d = axes_.spatial == 1, is_3d = axes_.spatial == 3;
  if (!linear) {
    const int32_t x = point_tap(mode(0), u_[0], size(mip.width), offset[0]);
    const int32_t y = is_1d ? 0 : point_tap(mode(1), u_[1], size(mip.height), offset[1]);
    const int32_t z = is_3d ? point_tap(mode(2), u_[2], size(mip.depth), offset[2])
                            : static_cast<int32_t>(first_slice());
    return texel(mip, x, y, z);
  }
  if (is_cube(view_.dimension)) return linear_cube(mip);
  const Place place{mip, first_slice()};
  const LinearTaps x = linear_taps(mode(0), u_[0], size(mip.width), offset[0]);
  const LinearTaps y =
      is_1d ? LinearTaps{0, 0, 0.0f} : linear_taps(mode(1), u_[1], size(mip.height), offset[1]);
  if (!is_3d) return linear_rows(place, static_cast<int32_t>(place.slice), x, y);
  const LinearTaps z = linear_taps(mode(2), u_[2], size(mip.depth), offset[2]);
  const Color first = linear_rows(place, z.first, x, y);
  return z.weight == 0.0f ? first : blend(first, linear_rows(place, z.second, x, y), z.weight);
}

// ---------------------------------------------------------------------------------------------
// Cubes: filtering continues across the edges of a face.

// x or y, but not both, may be one texel outside of the face. In double, because on large faces the
// distance to the neighbour's outermost texel is below the resolution of float.
Color Sampling::seamless_texel(const TextureMip& mip, int32_t x, int32_t y) const {
  const int32_t size = static_cast<int32_t>(mip.width);
  if (x >= 0 && x < size && y >= 0 && y < size) {
    return texel(mip, x, y, static_cast<int32_t>(slice_ * 6 + face_));
  }
  double direction[3];
  cube_direction({face_, (x + 0.5) / size, (y + 0.5) / size}, direction);
  const CubePlace place = cube_place(direction);
  const auto index = [size](double u) {
    return std::clamp(static_cast<int32_t>(u * size), 0, size - 1);
  };
  return texel(mip, index(place.u), index(place.v), static_cast<int32_t>(slice_ * 6 + place.face));
}

// The texels of the footprint: upper left, upper right, lower left, lower right.
void Sampling::cube_taps(const TextureMip& mip, Color taps[4], float weights[2]) const {
  const int32_t size = static_cast<int32_t>(mip.width);
  int32_t at[2];
  for (int axis = 0; axis < 2; ++axis) {
    const float x = u_[axis] * static_cast<float>(size) - 0.5f;
    const float whole = std::floor(x);
    at[axis] = static_cast<int32_t>(whole);
    weights[axis] = x - whole;
  }
  const auto outside = [size](int32_t i) { return i < 0 || i >= size; };
  int corner = -1;
  for (int i = 0; i < 4; ++i) {
    const int32_t x = at[0] + (i & 1), y = at[1] + (i >> 1);
    if (outside(x) && outside(y)) {
      corner = i;
    } else {
      taps[i] = seamless_texel(mip, x, y);
    }
  }
  if (corner < 0) return;
  // Only three faces meet in a corner: the fourth texel is the mean of the others.
  Color mean = {};
  for (int i = 0; i < 4; ++i) {
    if (i != corner) mean.c += taps[i].c / 3.0f;
  }
  taps[corner] = reduction_ == Reduction::kStandard && blends_ ? mean : taps[corner ^ 1];
}

Color Sampling::linear_cube(const TextureMip& mip) const {
  Color taps[4];
  float weights[2];
  cube_taps(mip, taps, weights);
  return blend(blend(taps[0], taps[1], weights[0]), blend(taps[2], taps[3], weights[0]),
               weights[1]);
}

// ---------------------------------------------------------------------------------------------
// Levels of detail. [D3D11.3 7.18.10]

Color Sampling::at_lod(float lod) const {
  lod = clamped_lod(view_, sampler_, arguments_.min_lod, lod);
  const bool linear = blends_ && (sampler_.filter & (lod > 0 ? kMinLinear : kMagLinear)) != 0;
  const float last = static_cast<float>(view_.mip_count - 1);
  lod = lod > 0 ? std::min(lod, last) : 0.0f;
  if (!blends_ || (sampler_.filter & kMipLinear) == 0) {
    return on_mip(static_cast<uint32_t>(std::min(std::floor(lod + 0.5f), last)), linear);
  }
  const auto level = static_cast<uint32_t>(lod);
  const float weight = lod - static_cast<float>(level);
  const Color first = on_mip(level, linear);
  return weight == 0.0f ? first : blend(first, on_mip(level + 1, linear), weight);
}

float Sampling::lod_of_gradients() const {
  const TextureMip& mip = view_.mips[0];
  double size[3] = {static_cast<double>(mip.width), static_cast<double>(mip.height),
                    static_cast<double>(mip.depth)};
  double longest = 0;
  for (const float* gradient : {arguments_.ddx, arguments_.ddy}) {
    double g[3] = {static_cast<double>(gradient[0]), static_cast<double>(gradient[1]),
                   static_cast<double>(gradient[2])};
    if (is_cube(view_.dimension)) {
      // u = (a / |m| + 1) / 2, so du = (da - (a / |m|) d|m|) / (2 |m|)
      const cube::Face& f = cube::kFaces[face_];
      const double major = std::abs(static_cast<double>(arguments_.coordinates[f.major]));
      const double major_change = f.major_sign * g[f.major];
      const double du =
          f.u_sign * g[f.u_axis] - (2 * static_cast<double>(u_[0]) - 1) * major_change;
      const double dv =
          f.v_sign * g[f.v_axis] - (2 * static_cast<double>(u_[1]) - 1) * major_change;
      g[0] = du / (2 * major);
      g[1] = dv / (2 * major);
    }
    double square = 0;
    for (int i = 0; i < axes_.spatial; ++i) square += g[i] * size[i] * g[i] * size[i];
    longest = std::max(longest, square);
  }
  return static_cast<float>(0.5 * std::log2(longest));
}

void Sampling::gather_texels(Color texels[4]) const {
  const TextureMip& mip = view_.mips[0];
  if (!has_texels(mip)) return;
  if (is_cube(view_.dimension)) {
    Color taps[4];
    float weights[2];
    cube_taps(mip, taps, weights);
    texels[0] = taps[2], texels[1] = taps[3], texels[2] = taps[1], texels[3] = taps[0];
    return;
  }
  const int32_t* offset = arguments_.offset;
  const LinearTaps x = linear_taps(mode(0), u_[0], static_cast<int32_t>(mip.width), offset[0]);
  const LinearTaps y = linear_taps(mode(1), u_[1], static_cast<int32_t>(mip.height), offset[1]);
  const auto slice = static_cast<int32_t>(first_slice());
  texels[0] = texel(mip, x.first, y.second, slice);
  texels[1] = texel(mip, x.second, y.second, slice);
  texels[2] = texel(mip, x.second, y.first, slice);
  texels[3] = texel(mip, x.first, y.first, slice);
}

// ---------------------------------------------------------------------------------------------

template <class Result, class Use>
Result with_sampling(const SampleArguments& arguments, bool compare, const Use& use) {
  const TextureView* view = texture_view(*arguments.texture);
  const SamplerState* sampler = sampler_state(*arguments.sampler);
  if (view == nullptr || sampler == nullptr) return Result{};
  const Sampling sampling(arguments, *view, *sampler, compare);
  return sampling.readable() ? use(sampling) : Result{};
}

Texel gathered(const SampleArguments& arguments, bool compare) {
  return with_sampling<Texel>(arguments, compare, [&](const Sampling& sampling) {
    Color texels[4] = {};
    sampling.gather_texels(texels);
    Texel result;
    for (int i = 0; i < 4; ++i) {
      result.bits[i] = sampling.result(texels[i]).bits[compare ? 0 : arguments.component & 3u];
    }
    return result;
  });
}

}  // namespace

Texel sample_level(const SampleArguments& arguments) {
  Texel texel;
  if (sample_bytes(arguments, texel)) return texel;
  return with_sampling<Texel>(arguments, false, [&](const Sampling& sampling) {
    return sampling.result(sampling.at_lod(arguments.lod));
  });
}

Texel sample_gradient(const SampleArguments& arguments) {
  return with_sampling<Texel>(arguments, false, [&](const Sampling& sampling) {
    return sampling.result(sampling.at_lod(sampling.lod_of_gradients()));
  });
}

float level_of_detail(const SampleArguments& arguments) {
  return with_sampling<float>(
      arguments, false, [&](const Sampling& sampling) { return sampling.lod_of_gradients(); });
}

float sample_compare_level(const SampleArguments& arguments) {
  return with_sampling<float>(arguments, true, [&](const Sampling& sampling) {
    return sampling.at_lod(arguments.lod).c[0];
  });
}

Texel gather(const SampleArguments& arguments) {
  return gathered(arguments, false);
}
Texel gather_compare(const SampleArguments& arguments) {
  return gathered(arguments, true);
}

void set_texture_services(Services& services) {
  services.sample_level = sample_level;
  services.sample_gradient = sample_gradient;
  services.sample_compare_level = sample_compare_level;
  services.level_of_detail = level_of_detail;
  services.gather = gather;
  services.gather_compare = gather_compare;
  services.load_texel = load_texel;
  services.store_texel = store_texel;
  services.load_typed = load_typed;
  services.store_typed = store_typed;
  services.texel_address = texel_address;
  services.typed_address = typed_address;
  services.texture_dimensions = texture_dimensions;
}

}  // namespace kaamos::shader

// SPDX-License-Identifier: MIT
#include "runtime/raster/blend.h"

#include <cstring>

namespace kaamos::raster {
namespace {

constexpr int kLanes = shader::kGraphicsLanes;

struct Component {
  float v[kLanes];
};
struct Colors {
  Component c[4];
};

float clamped(float value, float low) {
  if (!(value == value)) return 0;
  return value < low ? low : value > 1 ? 1 : value;
}

struct Operands {
  Colors source, second, destination;
  float factor[4];
};

// The factor of component c.
Component factor_of(rtapi::Blend blend, const Operands& in, int c) {
  using B = rtapi::Blend;
  Component out;
  const auto each = [&](const auto& f) {
    for (int i = 0; i < kLanes; ++i) out.v[i] = f(i);
  };
  const Component& source = in.source.c[c];
  const Component& source_alpha = in.source.c[3];
  const Component& destination = in.destination.c[c];
  const Component& destination_alpha = in.destination.c[3];
  switch (blend) {
    case B::kOne:
      each([](int) { return 1.0f; });
      break;
    case B::kSrcColor:
      each([&](int i) { return source.v[i]; });
      break;
    case B::kInvSrcColor:
      each([&](int i) { return 1.0f - source.v[i]; });
      break;
    case B::kSrcAlpha:
      each([&](int i) { return source_alpha.v[i]; });
      break;
    case B::kInvSrcAlpha:
      each([&](int i) { return 1.0f - source_alpha.v[i]; });
      break;
    case B::kDestAlpha:
      each([&](int i) { return destination_alpha.v[i]; });
      break;
    case B::kInvDestAlpha:
      each([&](int i) { return 1.0f - destination_alpha.v[i]; });
      break;
    case B::kDestColor:
      each([&](int i) { return destination.v[i]; });
      break;
    case B::kInvDestColor:
      each([&](int i) { return 1.0f - destination.v[i]; });
      break;
    case B::kSrcAlphaSat:
      each([&](int i) {
        const float left = 1.0f - destination_alpha.v[i];
        return c == 3 ? 1.0f : source_alpha.v[i] < left ? source_alpha.v[i] : left;
      });
      break;
    case B::kSrc1Color:
      each([&](int i) { return in.second.c[c].v[i]; });
      break;
    case B::kInvSrc1Color:
      each([&](int i) { return 1.0f - in.second.c[c].v[i]; });
      break;
    case B::kSrc1Alpha:
      each([&](int i) { return in.second.c[3].v[i]; });
      break;
    case B::kInvSrc1Alpha:
      each([&](int i) { return 1.0f - in.second.c[3].v[i]; });
      break;
    case B::kBlendFactor:
      each([&](int) { return in.factor[c]; });
      break;
    case B::kInvBlendFactor:
      each([&](int) { return 1.0f - in.factor[c]; });
      break;
    default:
      each([](int) { return 0.0f; });
  }
  return out;
}

Component combined(rtapi::BlendOp op, const Component& source, const Component& source_factor,
                   const Component& destination, const Component& destination_factor) {
  Component out;
  for (int i = 0; i < kLanes; ++i) {
    const float s = source.v[i];
    const float d = destination.v[i];
    const float weighted_s = s * source_factor.v[i];
    const float weighted_d = d * destination_factor.v[i];
    switch (op) {
      case rtapi::BlendOp::kAdd:
        out.v[i] = weighted_s + weighted_d;
        break;
      case rtapi::BlendOp::kSubtract:
        out.v[i] = weighted_s - weighted_d;
        break;
      case rtapi::BlendOp::kRevSubtract:
        out.v[i] = weighted_d - weighted_s;
        break;
      case rtapi::BlendOp::kMin:
        out.v[i] = s < d ? s : d;
        break;
      case rtapi::BlendOp::kMax:
        out.v[i] = s > d ? s : d;
        break;
    }
  }
  return out;
}

}  // namespace

void blend_colors(const rtapi::RenderTargetBlendDesc& desc, const TargetCodec& codec,
                  const float blend_factor[4], const shader::Column* source,
                  const shader::Column* second, const shader::Column* destination,
                  shader::Column* result) {
  Operands in;
  std::memcpy(&in.source, source, sizeof(in.source));
  std::memcpy(&in.second, second == nullptr ? source : second, sizeof(in.second));
  std::memcpy(&in.destination, destination, sizeof(in.destination));
  std::memcpy(in.factor, blend_factor, sizeof(in.factor));
  if (codec.clamped) {
    const float low = codec.clamped_signed ? -1.0f : 0.0f;
    for (Colors* colors : {&in.source, &in.second}) {
      for (Component& component : colors->c) {
        for (float& value : component.v) value = clamped(value, low);
      }
    }
    for (float& value : in.factor) value = clamped(value, low);
  }
  for (int c = 0; c < 4; ++c) {
    const bool alpha = c == 3;
    const Component out =
        combined(alpha ? desc.BlendOpAlpha : desc.BlendOp, in.source.c[c],
                 factor_of(alpha ? desc.SrcBlendAlpha : desc.SrcBlend, in, c), in.destination.c[c],
                 factor_of(alpha ? desc.DestBlendAlpha : desc.DestBlend, in, c));
    std::memcpy(result[c], &out, sizeof(out));
  }
}

void apply_logic_op(rtapi::LogicOp op, const shader::Column& destination, shader::Column& words) {
  using L = rtapi::LogicOp;
  const auto each = [&](const auto& f) {
    for (int i = 0; i < kLanes; ++i) words[i] = f(words[i], destination[i]);
  };
  switch (op) {
    case L::kClear:
      return each([](uint32_t, uint32_t) { return 0u; });
    case L::kSet:
      return each([](uint32_t, uint32_t) { return ~0u; });
    case L::kCopy:
      return;
    case L::kCopyInverted:
      return each([](uint32_t s, uint32_t) { return ~s; });
    case L::kNoop:
      return each([](uint32_t, uint32_t d) { return d; });
    case L::kInvert:
      return each([](uint32_t, uint32_t d) { return ~d; });
    case L::kAnd:
      return each([](uint32_t s, uint32_t d) { return s & d; });
    case L::kNand:
      return each([](uint32_t s, uint32_t d) { return ~(s & d); });
    case L::kOr:
      return each([](uint32_t s, uint32_t d) { return s | d; });
    case L::kNor:
      return each([](uint32_t s, uint32_t d) { return ~(s | d); });
    case L::kXor:
      return each([](uint32_t s, uint32_t d) { return s ^ d; });
    case L::kEquiv:
      return each([](uint32_t s, uint32_t d) { return ~(s ^ d); });
    case L::kAndReverse:
      return each([](uint32_t s, uint32_t d) { return s & ~d; });
    case L::kAndInverted:
      return each([](uint32_t s, uint32_t d) { return ~s & d; });
    case L::kOrReverse:
      return each([](uint32_t s, uint32_t d) { return s | ~d; });
    case L::kOrInverted:
      return each([](uint32_t s, uint32_t d) { return ~s | d; });
  }
}

}  // namespace kaamos::raster

// SPDX-License-Identifier: MIT
//
// Textures, typed buffers, dimensions: calls the prelude's functions with operands padded to four
// components, which is the form that the ABI has.
#include <kaamos/shader/prelude.h>

#include <cstring>

#include "runtime/hlsl/interpret/evaluate.h"
#include "runtime/hlsl/interpret/kernels.h"

namespace kaamos::hlsl::interpret {

using ir::ResourceKind;
using ir::SampleKind;
using shader::Descriptor;
using shader::float4;
using shader::int4;
using shader::vec;

namespace {

// Any numeric value as four components of To; missing ones are zero.
template <class To>
vec<To, 4> widen(const Node& node, Frame& frame) {
  const std::byte* bytes = evaluate(node, frame);
  return with_scalar(node.expr->type->scalar, [&](auto type) {
    using From = typename decltype(type)::type;
    vec<To, 4> out{};
    for (uint32_t i = 0; i < node.count && i < 4; ++i) {
      out.e[i] = shader::op::Convert<To>::apply(read_as<From>(bytes + i * sizeof(From)));
    }
    return out;
  });
}

bool is_buffer(const Node& resource) {
  const ResourceKind kind = resource.expr->type->resource;
  return kind == ResourceKind::kBuffer || kind == ResourceKind::kRWBuffer;
}

int4 coordinates(const Node& resource, const Node& location, int32_t mip, const int4& offset,
                 Frame& frame) {
  const ResourceKind kind = resource.expr->type->resource;
  const auto at = shader::truncate<shader::int3>(widen<int32_t>(location, frame));
  return kind == ResourceKind::kTexture1DArray || kind == ResourceKind::kRWTexture1DArray
             ? shader::texel_coordinates_1d_array(at, mip, offset)
             : shader::texel_coordinates(at, mip, offset);
}

// Calls make(type) with vec<component type, 4> and keeps the components that the node has.
template <class Make>
const std::byte* keep_texel(const Node& node, Frame& frame, const Make& make) {
  std::byte* out = frame.temporaries + node.slot;
  with_scalar(node.expr->type->scalar, [&](auto type) {
    using T = typename decltype(type)::type;
    if constexpr (!std::is_same_v<T, bool> && sizeof(T) <= 4) {
      const vec<T, 4> value = make(std::type_identity<vec<T, 4>>{});
      std::memcpy(out, &value, node.bytes);
    } else {
      std::memset(out, 0, node.bytes);  // no format has such components
    }
  });
  return out;
}

const std::byte* typed_load(const Node& node, Frame& frame) {
  const Node& resource = *node.operands[0];
  const shader::Invocation& invocation = *frame.context->invocation;
  const auto descriptor = evaluate_as<Descriptor>(resource, frame);
  if (is_buffer(resource)) {
    const auto element = widen<uint32_t>(*node.operands[1], frame).e[0];
    return keep_texel(node, frame, [&](auto type) {
      return shader::load_typed<typename decltype(type)::type>(invocation, descriptor, element);
    });
  }
  const size_t count = node.operands.size();
  const int32_t mip = count > 2 ? widen<int32_t>(*node.operands[2], frame).e[0] : 0;
  const int4 offset = count > 3 ? widen<int32_t>(*node.operands[3], frame) : int4{};
  const int4 at = coordinates(resource, *node.operands[1], mip, offset, frame);
  return keep_texel(node, frame, [&](auto type) {
    return shader::load_texel<typename decltype(type)::type>(invocation, descriptor, at);
  });
}

// Number of operands after {texture, sampler, location}, without the offset.
size_t fixed_operands(SampleKind kind) {
  switch (kind) {
    case SampleKind::kLevel:
    case SampleKind::kGatherCompare:
      return 4;
    case SampleKind::kGradient:
    case SampleKind::kCompareLevel:
    case SampleKind::kLevelOfDetail:
      return 5;
    case SampleKind::kGather:
      return 3;
  }
  return 3;
}

const std::byte* sample(const Node& node, Frame& frame) {
  const shader::Invocation& invocation = *frame.context->invocation;
  const auto texture = evaluate_as<Descriptor>(*node.operands[0], frame);
  const auto sampler = evaluate_as<Descriptor>(*node.operands[1], frame);
  const float4 location = widen<float>(*node.operands[2], frame);
  const SampleKind kind = node.expr->sample;
  const size_t fixed = fixed_operands(kind);
  const float4 third = fixed > 3 ? widen<float>(*node.operands[3], frame) : float4{};
  const float4 fourth = fixed > 4 ? widen<float>(*node.operands[4], frame) : float4{};
  const int4 offset =
      node.operands.size() > fixed ? widen<int32_t>(*node.operands[fixed], frame) : int4{};
  return keep_texel(node, frame, [&](auto type) {
    using V = typename decltype(type)::type;
    switch (kind) {
      case SampleKind::kLevel:
        return shader::sample_level<V>(invocation, texture, sampler, location, third.e[0], offset);
      case SampleKind::kGradient:
        return shader::sample_gradient<V>(invocation, texture, sampler, location, third, fourth,
                                          offset);
      case SampleKind::kCompareLevel:
        return shader::sample_compare_level<V>(invocation, texture, sampler, location, third.e[0],
                                               fourth.e[0], offset);
      case SampleKind::kLevelOfDetail:
        return shader::splat<V>(shader::op::Convert<shader::scalar_of<V>>::apply(
            shader::level_of_detail(invocation, texture, sampler, location, third, fourth)));
      case SampleKind::kGather:
        return shader::gather<V>(invocation, texture, sampler, location, node.expr->index, offset);
      case SampleKind::kGatherCompare:
        return shader::gather_compare<V>(invocation, texture, sampler, location, third.e[0],
                                         offset);
    }
    return V{};
  });
}

const std::byte* dimensions(const Node& node, Frame& frame) {
  const auto descriptor = evaluate_as<Descriptor>(*node.operands[0], frame);
  const uint32_t mip =
      node.operands.size() > 1 ? widen<uint32_t>(*node.operands[1], frame).e[0] : 0;
  const shader::uint4 size = shader::dimensions(*frame.context->invocation, descriptor, mip);
  std::byte* out = frame.temporaries + node.slot;
  std::memcpy(out, &size, sizeof(size));
  return out;
}

}  // namespace

Evaluate evaluate_typed_load() {
  return typed_load;
}
Evaluate evaluate_sample() {
  return sample;
}
Evaluate evaluate_dimensions() {
  return dimensions;
}

void typed_store(const Action& action, Frame& frame) {
  const Node& resource = *action.operands[0];
  const shader::Invocation& invocation = *frame.context->invocation;
  const auto descriptor = evaluate_as<Descriptor>(resource, frame);
  with_scalar(action.value->expr->type->scalar, [&](auto type) {
    using T = typename decltype(type)::type;
    if constexpr (!std::is_same_v<T, bool> && sizeof(T) <= 4) {
      const vec<T, 4> value = widen<T>(*action.value, frame);
      if (is_buffer(resource)) {
        shader::store_typed(invocation, descriptor,
                            widen<uint32_t>(*action.operands[1], frame).e[0], value);
      } else {
        shader::store_texel(invocation, descriptor,
                            coordinates(resource, *action.operands[1], 0, {}, frame), value);
      }
    }
  });
}

void* typed_place(const Action& action, Frame& frame) {
  const Node& resource = *action.operands[0];
  const shader::Invocation& invocation = *frame.context->invocation;
  const auto descriptor = evaluate_as<Descriptor>(resource, frame);
  const auto* services = invocation.dispatch->services;
  const uint32_t bytes = action.value->bytes;
  if (is_buffer(resource)) {
    const uint32_t element = widen<uint32_t>(*action.operands[1], frame).e[0];
    return services->typed_address(descriptor, element, bytes);
  }
  const auto at = coordinates(resource, *action.operands[1], 0, {}, frame);
  return services->texel_address(descriptor, at.e, bytes);
}

}  // namespace kaamos::hlsl::interpret

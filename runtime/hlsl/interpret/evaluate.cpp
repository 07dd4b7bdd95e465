// SPDX-License-Identifier: MIT
#include "runtime/hlsl/interpret/evaluate.h"

#include <kaamos/shader/checked.h>
#include <kaamos/shader/debugging.h>
#include <kaamos/shader/prelude.h>
#include <kaamos/shader/triangle_positions.h>

#include <algorithm>
#include <cstring>

#include "runtime/hlsl/ir/texture_shape.h"

namespace kaamos::hlsl::interpret {

using ir::QueryValue;
using ir::Storage;
using ir::SystemValue;

namespace {

const std::byte* data(const Node& node, Frame&) {
  return node.data;
}
const std::byte* zero(const Node&, Frame& frame) {
  return frame.context->program->zeros.data();
}

std::byte* local_place(const Node& node, Frame& frame) {
  return frame.variables + node.offset;
}
std::byte* reference_place(const Node& node, Frame& frame) {
  return read_as<std::byte*>(frame.variables + node.offset);
}
std::byte* static_place(const Node& node, Frame& frame) {
  return frame.context->statics + node.offset;
}
std::byte* shared_place(const Node& node, Frame& frame) {
  return frame.context->shared + node.offset;
}
template <Locate Place>
const std::byte* value_of(const Node& node, Frame& frame) {
  return Place(node, frame);
}

const std::byte* member(const Node& node, Frame& frame) {
  return evaluate(*node.operands[0], frame) + node.offset;
}
std::byte* member_place(const Node& node, Frame& frame) {
  const Node& base = *node.operands[0];
  std::byte* place = base.locate(base, frame);
  return place != nullptr ? place + node.offset : nullptr;
}

const std::byte* element(const Node& node, Frame& frame) {
  const auto index = evaluate_as<uint32_t>(*node.operands[1], frame);
  if (index >= node.length) {
    report(*frame.context, InterpretFinding::kIndexOutOfRange, node.expr->location);
    return frame.context->program->zeros.data();
  }
  return evaluate(*node.operands[0], frame) + size_t{index} * node.stride;
}
std::byte* element_place(const Node& node, Frame& frame) {
  const auto index = evaluate_as<uint32_t>(*node.operands[1], frame);
  if (index >= node.length) {
    report(*frame.context, InterpretFinding::kIndexOutOfRange, node.expr->location);
    return nullptr;
  }
  const Node& base = *node.operands[0];
  std::byte* place = base.locate(base, frame);
  return place != nullptr ? place + size_t{index} * node.stride : nullptr;
}

const std::byte* gather(const Node& node, Frame& frame) {
  const std::byte* from = evaluate(*node.operands[0], frame);
  std::byte* out = frame.temporaries + node.slot;
  std::byte* to = out;
  for (const uint8_t component : node.components) {
    std::memcpy(to, from + component * node.stride, node.stride);
    to += node.stride;
  }
  return out;
}

const std::byte* construct(const Node& node, Frame& frame) {
  std::byte* out = frame.temporaries + node.slot;
  for (size_t i = 0; i < node.operands.size(); ++i) {
    const Node& part = *node.operands[i];
    std::memcpy(out + node.offsets[i], evaluate(part, frame), part.bytes);
  }
  return out;
}

const std::byte* apply_kernel(const Node& node, Frame& frame) {
  const std::byte* operands[3];
  const size_t count = node.operands.size();
  for (size_t i = 0; i < count; ++i) operands[i] = evaluate(*node.operands[i], frame);
  std::byte* out = frame.temporaries + node.slot;
  node.kernel(node, out, operands);
  return out;
}

const std::byte* conditional(const Node& node, Frame& frame) {
  const bool chosen = evaluate_as<bool>(*node.operands[0], frame);
  return evaluate(*node.operands[chosen ? 1 : 2], frame);
}
const std::byte* logical_and(const Node& node, Frame& frame) {
  const std::byte* first = evaluate(*node.operands[0], frame);
  return read_as<bool>(first) ? evaluate(*node.operands[1], frame) : first;
}
const std::byte* logical_or(const Node& node, Frame& frame) {
  const std::byte* first = evaluate(*node.operands[0], frame);
  return read_as<bool>(first) ? first : evaluate(*node.operands[1], frame);
}

template <class T>
const std::byte* keep(const Node& node, Frame& frame, const T& value) {
  std::byte* out = frame.temporaries + node.slot;
  std::memcpy(out, &value, sizeof(value));
  return out;
}

// The checker rejects this in a stage without a ray; if a backend passes no ray, the value is zero.
const std::byte* ray_value(const Node& node, Frame& frame) {
  const shader::Invocation& invocation = *frame.context->invocation;
  if (invocation.ray == nullptr) {
    report(*frame.context, InterpretFinding::kNoRay, node.expr->location);
    return frame.context->program->zeros.data();
  }
  const shader::RaySystemValues& ray = *invocation.ray;
  switch (node.expr->system_value) {
    case SystemValue::kWorldRayOrigin:
      return keep(node, frame, shader::world_ray_origin(invocation));
    case SystemValue::kWorldRayDirection:
      return keep(node, frame, shader::world_ray_direction(invocation));
    case SystemValue::kRayTMin:
      return keep(node, frame, ray.ray.t_min);
    case SystemValue::kRayTCurrent:
      return keep(node, frame, ray.t_current);
    case SystemValue::kRayFlags:
      return keep(node, frame, ray.ray_flags);
    case SystemValue::kInstanceIndex:
      return keep(node, frame, ray.instance_index);
    case SystemValue::kInstanceId:
      return keep(node, frame, ray.instance_id);
    case SystemValue::kGeometryIndex:
      return keep(node, frame, ray.geometry_index);
    case SystemValue::kPrimitiveIndex:
      return keep(node, frame, ray.primitive_index);
    case SystemValue::kObjectRayOrigin:
      return keep(node, frame, shader::object_ray_origin(invocation));
    case SystemValue::kObjectRayDirection:
      return keep(node, frame, shader::object_ray_direction(invocation));
    case SystemValue::kObjectToWorld3x4:
      return keep(node, frame, shader::object_to_world_3x4(invocation));
    case SystemValue::kObjectToWorld4x3:
      return keep(node, frame, shader::object_to_world_4x3(invocation));
    case SystemValue::kWorldToObject3x4:
      return keep(node, frame, shader::world_to_object_3x4(invocation));
    case SystemValue::kWorldToObject4x3:
      return keep(node, frame, shader::world_to_object_4x3(invocation));
    case SystemValue::kHitKind:
      return keep(node, frame, ray.hit_kind);
    case SystemValue::kPositionTable:
      return keep(node, frame, shader::position_table(ray.world_to_object));
    default:
      return frame.context->program->zeros.data();
  }
}

const std::byte* system_value(const Node& node, Frame& frame) {
  switch (node.expr->system_value) {
    case SystemValue::kDispatchRaysIndex:
      return keep(node, frame, shader::dispatch_rays_index(*frame.context->invocation));
    case SystemValue::kDispatchRaysDimensions:
      return keep(node, frame, shader::dispatch_rays_dimensions(*frame.context->invocation));
    default:
      return ray_value(node, frame);
  }
}

const std::byte* query_value(const Node& node, Frame& frame) {
  const auto& query = *reinterpret_cast<const shader::RayQuery*>(
      node.operands[0]->locate(*node.operands[0], frame));
  const QueryNeed need = need_of(*node.expr);
  if (frame.context->program->checked && need.hit) {
    const auto look =
        node.expr->index == 1 ? shader::checked::committed : shader::checked::candidate;
    look(*frame.context->invocation, site_of(node.expr->location), query, need.type,
         static_cast<uint32_t>(node.expr->query_value));
  }
  const shader::RayQueryHit& hit = node.expr->index == 1 ? query.committed : query.candidate;
  const auto rows_of = [&](const float* transform) {
    return keep(node, frame, shader::load_transform(transform));
  };
  const auto columns_of = [&](const float* transform) {
    return keep(node, frame, shader::transpose(shader::load_transform(transform)));
  };
  switch (node.expr->query_value) {
    case QueryValue::kType:
      return keep(node, frame, hit.type);
    case QueryValue::kRayT:
      return keep(node, frame, hit.t);
    case QueryValue::kInstanceIndex:
      return keep(node, frame, hit.instance_index);
    case QueryValue::kInstanceId:
      return keep(node, frame, hit.instance_id);
    case QueryValue::kInstanceContribution:
      return keep(node, frame, hit.instance_contribution);
    case QueryValue::kGeometryIndex:
      return keep(node, frame, hit.geometry_index);
    case QueryValue::kPrimitiveIndex:
      return keep(node, frame, hit.primitive_index);
    case QueryValue::kObjectRayOrigin:
      return keep(node, frame, shader::query_object_origin(query, hit));
    case QueryValue::kObjectRayDirection:
      return keep(node, frame, shader::query_object_direction(query, hit));
    case QueryValue::kObjectToWorld3x4:
      return rows_of(hit.object_to_world);
    case QueryValue::kObjectToWorld4x3:
      return columns_of(hit.object_to_world);
    case QueryValue::kWorldToObject3x4:
      return rows_of(hit.world_to_object);
    case QueryValue::kWorldToObject4x3:
      return columns_of(hit.world_to_object);
    case QueryValue::kBarycentrics:
      return keep(node, frame, shader::query_barycentrics(hit));
    case QueryValue::kFrontFace:
      return keep(node, frame, hit.front_face);
    case QueryValue::kProceduralNonOpaque:
      return keep(node, frame, hit.non_opaque);
    case QueryValue::kPositionTable:
      return keep(node, frame, shader::query_position_table(hit));
    case QueryValue::kRayFlags:
      return keep(node, frame, query.ray_flags);
    case QueryValue::kRayTMin:
      return keep(node, frame, query.ray.t_min);
    case QueryValue::kWorldRayOrigin:
      return keep(node, frame, shader::query_world_origin(query));
    case QueryValue::kWorldRayDirection:
      return keep(node, frame, shader::query_world_direction(query));
  }
  return frame.context->program->zeros.data();
}

const std::byte* binding(const Node& node, Frame& frame) {
  const uint32_t index =
      node.operands.empty() ? 0 : evaluate_as<uint32_t>(*node.operands[0], frame);
  if (frame.context->program->checked) {
    return keep(node, frame,
                shader::checked::resource(*frame.context->invocation, site_of(node.expr->location),
                                          node.expr->index, index));
  }
  return keep(node, frame, shader::resource(*frame.context->invocation, node.expr->index, index));
}

const std::byte* heap_resource(const Node& node, Frame& frame) {
  const ir::ResourceKind kind = node.expr->type->resource;
  const bool sampler =
      kind == ir::ResourceKind::kSampler || kind == ir::ResourceKind::kSamplerComparison;
  const auto index = evaluate_as<uint32_t>(*node.operands[0], frame);
  const uint32_t shape = ir::texture_shape(*node.expr->type);
  if (frame.context->program->checked) {
    const ResourceClass wanted = class_of(kind);
    return keep(
        node, frame,
        shader::checked::heap_resource(*frame.context->invocation, site_of(node.expr->location),
                                       index, wanted.kind, wanted.access, shape));
  }
  if (shape != 0) {
    return keep(node, frame, shader::heap_texture(*frame.context->invocation, index, shape));
  }
  return keep(node, frame, shader::heap_resource(*frame.context->invocation, index, sampler));
}

const std::byte* print_buffer(const Node& node, Frame& frame) {
  return keep(node, frame, frame.context->invocation->dispatch->prints);
}

const std::byte* same_bytes(const Node& node, Frame& frame) {
  const std::byte* from = evaluate(*node.operands[0], frame);
  std::byte* to = frame.temporaries + node.slot;
  const uint32_t bytes = std::min(node.bytes, node.operands[0]->bytes);
  std::memcpy(to, from, bytes);
  std::memset(to + bytes, 0, node.bytes - bytes);
  return to;
}

const std::byte* record_constant(const Node& node, Frame& frame) {
  const auto hit = evaluate_as<shader::HitObject>(*node.operands[0], frame);
  const auto offset = evaluate_as<uint32_t>(*node.operands[1], frame);
  shader::Invocation& invocation = *frame.context->invocation;
  if (offset == shader::kDebuggingEnabled) {
    return keep(node, frame, shader::is_debugging_enabled(invocation));
  }
  return keep(node, frame, invocation.dispatch->services->record_constant(invocation, hit, offset));
}

const std::byte* triangle_positions(const Node& node, Frame& frame) {
  const auto table = evaluate_as<shader::uint2>(*node.operands[0], frame);
  const auto geometry = evaluate_as<uint32_t>(*node.operands[1], frame);
  const auto primitive = evaluate_as<uint32_t>(*node.operands[2], frame);
  if (frame.context->program->checked) {
    return keep(
        node, frame,
        shader::checked::triangle_positions(
            *frame.context->invocation, site_of(node.expr->location), table, geometry, primitive));
  }
  return keep(node, frame, shader::triangle_positions(table, geometry, primitive));
}

const std::byte* cluster_id(const Node& node, Frame& frame) {
  return keep(node, frame,
              shader::cluster_id(evaluate_as<shader::uint2>(*node.operands[0], frame)));
}

}  // namespace

void make_variable(Node& node, Storage storage, bool reference) {
  const auto use = [&node](Evaluate value, Locate place) {
    node.evaluate = value;
    node.locate = place;
  };
  switch (storage) {
    case Storage::kLocal:
    case Storage::kParameter:
      if (reference) {
        use(value_of<reference_place>, reference_place);
      } else {
        use(value_of<local_place>, local_place);
      }
      break;
    case Storage::kStaticGlobal:
      use(value_of<static_place>, static_place);
      break;
    case Storage::kGroupShared:
      use(value_of<shared_place>, shared_place);
      break;
    case Storage::kConstant:
      use(data, nullptr);
      break;
  }
}

Evaluate evaluate_data() {
  return data;
}
Evaluate evaluate_zero() {
  return zero;
}
Evaluate evaluate_member() {
  return member;
}
Locate locate_member() {
  return member_place;
}
Evaluate evaluate_element() {
  return element;
}
Locate locate_element() {
  return element_place;
}
Evaluate evaluate_gather() {
  return gather;
}
Evaluate evaluate_construct() {
  return construct;
}
Evaluate evaluate_kernel() {
  return apply_kernel;
}
Evaluate evaluate_conditional() {
  return conditional;
}
Evaluate evaluate_logical_and() {
  return logical_and;
}
Evaluate evaluate_logical_or() {
  return logical_or;
}
Evaluate evaluate_system_value() {
  return system_value;
}
Evaluate evaluate_query_value() {
  return query_value;
}
Evaluate evaluate_same_bytes() {
  return same_bytes;
}
Evaluate evaluate_record_constant() {
  return record_constant;
}
Evaluate evaluate_triangle_positions() {
  return triangle_positions;
}
Evaluate evaluate_cluster_id() {
  return cluster_id;
}
Evaluate evaluate_binding() {
  return binding;
}
Evaluate evaluate_heap_resource() {
  return heap_resource;
}
Evaluate evaluate_print_buffer() {
  return print_buffer;
}

}  // namespace kaamos::hlsl::interpret

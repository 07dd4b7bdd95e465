// SPDX-License-Identifier: MIT
//
// Hit objects: what a TraceRay found, and the closest-hit or miss shader that Invoke runs for it.
#include <algorithm>
#include <cstring>

#include "kaamos/shader/triangle_positions.h"
#include "runtime/backend/ray_flags.h"
#include "runtime/explain/replay_state.h"
#include "runtime/explain/values.h"

namespace kaamos::explain {

using runtime::LinkedShader;
using runtime::RecordKind;

shader::HitObject Replay::hit_object_of(const Trace& trace) const {
  shader::HitObject out;
  out.ray_flags = trace.reported_flags;
  std::memcpy(out.origin, trace.ray.origin, sizeof(out.origin));
  std::memcpy(out.direction, trace.ray.direction, sizeof(out.direction));
  out.t_min = trace.ray.t_min;
  out.is_bound = 1;
  if (!trace.search.committed) {
    out.state = shader::kHitObjectMiss;
    out.t = trace.ray.t_max;
    out.record = trace.arguments->miss_shader_index & 0xFFFFu;
    return out;
  }
  const Instance& instance = trace.scene->instances()[trace.hit.instance];
  out.state = shader::kHitObjectHit;
  out.t = trace.search.committed_t;
  out.instance_index = trace.hit.instance;
  out.instance_id = instance.id;
  out.geometry_index = trace.hit.geometry;
  out.primitive_index = trace.hit.primitive;
  out.hit_kind = trace.hit_kind;
  out.record = static_cast<uint32_t>(hit_record_index(trace, trace.hit));
  std::memcpy(out.attributes, trace.attributes, sizeof(out.attributes));
  std::memcpy(out.object_to_world, instance.object_to_world.data(), sizeof(out.object_to_world));
  std::memcpy(out.world_to_object, instance.world_to_object.rows, sizeof(out.world_to_object));
  if (out.hit_kind >= shader::kLeastTriangleHitKind) {
    shader::set_position_table(out, trace.hit.cluster != nullptr
                                        ? shader::table_of(trace.hit.cluster)
                                        : instance.world_to_object.positions);
  }
  return out;
}

Replay::Record Replay::bound_record(const shader::HitObject& hit) const {
  Record out;
  if (hit.is_bound == 0) {
    out.reason = hit.state == shader::kHitObjectNop ? "the hit object is a NOP"
                                                    : "the hit object is bound to no record";
    return out;
  }
  const bool is_hit = hit.state == shader::kHitObjectHit;
  return find_record(is_hit ? command_.desc.HitGroupTable : command_.desc.MissShaderTable,
                     is_hit ? RecordKind::kHitGroup : RecordKind::kMiss, hit.record);
}

uint32_t Replay::record_constant(const shader::HitObject& hit, uint32_t offset) const {
  const Record record = bound_record(hit);
  const auto& table = hit.state == shader::kHitObjectHit ? command_.desc.HitGroupTable
                                                         : command_.desc.MissShaderTable;
  const uint64_t slot = table.StrideInBytes == 0 ? 0 : hit.record;
  const uint64_t at = slot * table.StrideInBytes + rtapi::kShaderIdentifierSizeInBytes + offset;
  uint32_t value = 0;
  if (record.address == nullptr || at + sizeof(value) > table.SizeInBytes) return 0;
  std::memcpy(&value, record.address + rtapi::kShaderIdentifierSizeInBytes + offset, sizeof(value));
  return value;
}

void Replay::invoke(Frame& caller, const shader::HitObject& hit, void* payload,
                    uint32_t payload_bytes) {
  check_depth(caller);
  statistics_.MaxDepth = std::max(statistics_.MaxDepth, caller.depth + 1);
  const bool is_hit = hit.state == shader::kHitObjectHit;
  const Record record = bound_record(hit);
  const bool skips = is_hit && runtime::has(hit.ray_flags, rtapi::RayFlags::kSkipClosestHitShader);
  const LinkedShader* linked = record.linked == nullptr || skips ? nullptr
                               : is_hit                          ? record.linked->closest_hit
                                                                 : record.linked->shader;
  rtapi::ExplainedCall* call = add_call(caller, rtapi::ExplainedCallKind::kInvoke);
  const char* layout = payload_layout(linked, payload_bytes);
  if (call != nullptr) {
    call->Depth = caller.depth + 1;
    call->Hit = is_hit;
    call->HitT = hit.t;
    call->Before = decode_values(layout, payload, payload_bytes);
    if (linked == nullptr) {
      call->Note = std::string("nothing runs: ") +
                   (skips                      ? "the ray has RAY_FLAG_SKIP_CLOSEST_HIT_SHADER"
                    : record.linked == nullptr ? record.reason
                                               : "the hit group has no closest-hit shader");
    }
  }
  if (linked == nullptr) return;
  Frame frame;
  frame.begin(*this, *linked, record, caller.depth + 1);
  shader::InstanceTransform world_to_object;
  std::memcpy(world_to_object.rows, hit.world_to_object, sizeof(world_to_object.rows));
  world_to_object.positions = shader::position_table_of(hit);
  frame.values = {{{hit.origin[0], hit.origin[1], hit.origin[2]},
                   hit.t_min,
                   {hit.direction[0], hit.direction[1], hit.direction[2]},
                   hit.t},
                  hit.t,
                  hit.ray_flags,
                  hit.hit_kind,
                  hit.instance_index,
                  hit.instance_id,
                  hit.geometry_index,
                  hit.primitive_index,
                  hit.object_to_world,
                  world_to_object.rows};
  frame.ray = &frame.values;
  if (call != nullptr) {
    call->Shaders.push_back({linked->name, stage_of(*linked)});
    frame.node = &call->Shaders.back();
    frame.node->Record = {table_name(is_hit ? RecordKind::kHitGroup : RecordKind::kMiss),
                          hit.record, std::to_string(hit.record) + " (of the hit object)",
                          record.linked->name, record.reason};
    if (is_hit) {
      frame.node->Attributes =
          decode_values(linked->code->attribute_layout, hit.attributes,
                        std::min(linked->code->attribute_bytes, kMaxAttributeBytes));
    }
    frame.node->Before = decode_values(layout, payload, payload_bytes);
  }
  enter();
  if (is_hit) {
    entry_of<shader::ClosestHitFn> (*linked)(frame, payload, hit.attributes);
  } else {
    entry_of<shader::MissFn> (*linked)(frame, payload);
  }
  leave();
  finish_queries(frame.node);
  if (frame.node != nullptr) frame.node->After = decode_values(layout, payload, payload_bytes);
  if (call != nullptr) call->After = decode_values(layout, payload, payload_bytes);
}

}  // namespace kaamos::explain

// SPDX-License-Identifier: MIT
#include "runtime/embree/hit_object.h"

#include <cstring>

#include "kaamos/shader/debugging.h"
#include "kaamos/shader/reordering.h"
#include "kaamos/shader/triangle_positions.h"
#include "runtime/backend/debugger.h"
#include "runtime/embree/fault.h"
#include "runtime/embree/ray_state.h"
#include "runtime/embree/trace.h"

namespace kaamos::embree {
namespace {

const RecordTable& table_of(const Worker& worker, const shader::HitObject& hit) {
  return hit.state == shader::kHitObjectHit ? worker.dispatch->hit_table
                                            : worker.dispatch->miss_table;
}

shader::RaySystemValues values_of(const shader::HitObject& hit,
                                  const shader::InstanceTransform& world_to_object) {
  shader::RaySystemValues values;
  for (int i = 0; i < 3; ++i) {
    values.ray.origin[i] = hit.origin[i];
    values.ray.direction[i] = hit.direction[i];
  }
  values.ray.t_min = hit.t_min;
  values.ray.t_max = hit.t;
  values.t_current = hit.t;
  values.ray_flags = hit.ray_flags;
  values.hit_kind = hit.hit_kind;
  values.instance_index = hit.instance_index;
  values.instance_id = hit.instance_id;
  values.geometry_index = hit.geometry_index;
  values.primitive_index = hit.primitive_index;
  values.object_to_world = hit.object_to_world;
  values.world_to_object = world_to_object.rows;
  return values;
}

}  // namespace

void invoke_hit_object(shader::Invocation& caller, const shader::HitObject& hit, void* payload,
                       uint32_t) {
  Worker& worker = worker_of(caller);
  check_depth(worker, caller);
  if (hit.is_bound == 0) return;
  const bool is_hit = hit.state == shader::kHitObjectHit;
  if (is_hit && (hit.ray_flags & kRaySkipClosestHitShader) != 0) return;
  const ShaderRecord record = table_of(worker, hit).at(hit.record);
  const Shader& shader = is_hit ? record.target->closest_hit : record.target->shader;
  if (!shader.runs()) return;
  shader::InstanceTransform world_to_object;
  std::memcpy(world_to_object.rows, hit.world_to_object, sizeof(world_to_object.rows));
  world_to_object.positions = shader::position_table_of(hit);
  const shader::RaySystemValues values = values_of(hit, world_to_object);
  shader::Invocation invocation = invocation_of(caller, shader, record, values);
  const RunningShader running(worker, shader);
  if (is_hit) {
    ++worker.counters.closest_hit_calls;
    return shader.as<shader::ClosestHitFn>()(invocation, payload, hit.attributes);
  }
  ++worker.counters.miss_calls;
  shader.as<shader::MissFn>()(invocation, payload);
}

uint32_t record_constant(shader::Invocation& caller, const shader::HitObject& hit,
                         uint32_t offset) {
  if (offset == shader::kDebuggingEnabled) return runtime::is_debugger_attached() ? 1 : 0;
  if (hit.is_bound == 0) return 0;
  if (offset == shader::kReorderedRecord) table_of(worker_of(caller), hit).at(hit.record);
  return table_of(worker_of(caller), hit).argument(hit.record, offset);
}

}  // namespace kaamos::embree

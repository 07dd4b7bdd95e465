// SPDX-License-Identifier: MIT
//
// CallShader. It does not count as recursion; only the stack limits it. [DXR: Ray recursion limit]
#include "runtime/embree/fault.h"
#include "runtime/embree/ray_state.h"
#include "runtime/embree/trace.h"

namespace kaamos::embree {

void call_shader(shader::Invocation& caller, uint32_t shader_index, void* data, uint32_t) {
  Worker& worker = worker_of(caller);
  check_stack(worker);
  const ShaderRecord record = worker.dispatch->callable_table.at(shader_index);
  if (!record.target->shader.runs()) return;  // NULL: the parameters stay unchanged
  const Shader& shader = record.target->shader;
  ++worker.counters.callable_calls;
  shader::Invocation invocation;
  invocation.dispatch = caller.dispatch;
  invocation.slots = shader.slots;
  invocation.local_arguments = record.local_arguments();
  for (int i = 0; i < 3; ++i) invocation.index[i] = caller.index[i];
  invocation.depth = caller.depth;
  invocation.backend = caller.backend;
  invocation.bound = worker.bound[shader.number];
  const RunningShader running(worker, shader);
  shader.as<shader::CallableFn>()(invocation, data);
}

}  // namespace kaamos::embree

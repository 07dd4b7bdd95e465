// SPDX-License-Identifier: MIT
#include "runtime/embree/services.h"

#include <iterator>
#include <mutex>

#include "runtime/backend/backend.h"
#include "runtime/checks/code_findings.h"
#include "runtime/embree/compute.h"
#include "runtime/embree/fault.h"
#include "runtime/embree/hit_object.h"
#include "runtime/embree/inline_query.h"
#include "runtime/embree/intersection.h"
#include "runtime/embree/trace.h"
#include "runtime/shader/texture/texture_sampling.h"

namespace kaamos::embree {
namespace {

void remove(shader::Invocation& invocation, shader::RemovalReason reason) {
  remove_device(worker_of(invocation), reason);
}

void report(shader::Invocation& invocation, const shader::CheckReport& found) {
  const Worker& worker = worker_of(invocation);
  const RunningDispatch& dispatch = *worker.dispatch;
  if (dispatch.context == nullptr) return;
  checks::CodePlace place;
  if (worker.running != nullptr) place.shader = worker.running->linked;
  for (int i = 0; i < 3; ++i) {
    if (worker.index != nullptr) place.index[i] = worker.index[i];
    place.dimensions[i] = dispatch.abi.dimensions[i];
  }
  place.tables = dispatch.tables;
  checks::report_finding(*dispatch.context->reporter, *dispatch.context->addresses, place, found);
}

constexpr size_t kMostReached = 1024;

void reached(shader::Invocation& invocation, const shader::ReachedCall& call) {
  Worker& worker = worker_of(invocation);
  RunningDispatch& dispatch = *worker.dispatch;
  if (dispatch.context == nullptr || worker.running == nullptr) return;
  uint64_t hash = reinterpret_cast<uintptr_t>(worker.running->linked);
  for (const uint64_t part :
       {call.acceleration_structure, uint64_t{call.site} << 2 | static_cast<uint64_t>(call.by),
        uint64_t{call.ray_flags} << 32 | call.indices}) {
    hash = (hash ^ part) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 29;
  }
  hash |= uint64_t{1} << 63;
  uint64_t& late = worker.reached_hashes[hash % std::size(worker.reached_hashes)];
  if (late == hash) return;
  late = hash;
  const std::lock_guard lock(dispatch.mutex);
  if (dispatch.reached.size() >= kMostReached) return;
  if (!dispatch.reached_hashes.insert(hash).second) return;
  dispatch.reached.push_back({worker.running->linked, call});
}

shader::Services make_services() {
  shader::Services table = {};
  table.trace_ray = trace_ray;
  table.trace_rays = trace_rays;
  table.report_hit = report_hit;
  table.call_shader = call_shader;
  table.trace_hit_object = trace_hit_object;
  table.invoke_hit_object = invoke_hit_object;
  table.record_constant = record_constant;
  table.begin_query = begin_query;
  table.proceed = proceed;
  table.group_barrier = group_barrier;
  table.wave = wave_operation;
  table.remove_device = remove;
  table.report = report;
  table.reached = reached;
  shader::set_texture_services(table);
  return table;
}

}  // namespace

const shader::Services& services() {
  static const shader::Services table = make_services();
  return table;
}

}  // namespace kaamos::embree

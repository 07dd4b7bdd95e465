// SPDX-License-Identifier: MIT
//
// TraceRay: offers candidates front to back, then runs the closest-hit or the miss shader.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "runtime/backend/ray_flags.h"
#include "runtime/explain/guard.h"
#include "runtime/explain/replay_state.h"
#include "runtime/explain/values.h"
#include "runtime/structures/instances.h"

namespace kaamos::explain {

using rtapi::CandidateOutcome;
using rtapi::RayFlags;
using runtime::has;
using runtime::LinkedShader;
using runtime::RecordKind;
using shader::AnyHitResult;
using shader::ReportHitResult;

namespace {

void describe_ray(const shader::RayDesc& ray, rtapi::ExplainedCall& call) {
  for (int i = 0; i < 3; ++i) {
    call.Origin[i] = ray.origin[i];
    call.Direction[i] = ray.direction[i];
  }
  call.TMin = ray.t_min;
  call.TMax = ray.t_max;
}

}  // namespace

bool is_valid(const shader::RayDesc& ray) {
  for (int i = 0; i < 3; ++i) {
    if (!(std::fabs(ray.origin[i]) <= runtime::kLargestCoordinate)) return false;
    if (!(std::fabs(ray.direction[i]) <= runtime::kLargestCoordinate)) return false;
  }
  return ray.t_min <= ray.t_max && ray.t_min <= 3.402823466e+38f;
}

rtapi::ExplainedCandidate describe(const Candidate& candidate, const Instance& instance,
                                   uint32_t flags) {
  rtapi::ExplainedCandidate out;
  out.T = static_cast<float>(candidate.t);
  out.InstanceIndex = candidate.instance;
  out.InstanceID = instance.id;
  out.GeometryIndex = candidate.geometry;
  out.PrimitiveIndex = candidate.primitive;
  if (candidate.cluster != nullptr) out.ClusterID = candidate.cluster->cluster_id;
  out.Procedural = candidate.procedural;
  out.FrontFace = !candidate.procedural && is_front_face(candidate, instance);
  out.Opaque = opacity_of(candidate, instance, flags).opaque;
  out.Barycentrics[0] = candidate.barycentrics[0];
  out.Barycentrics[1] = candidate.barycentrics[1];
  return out;
}

void Replay::check_depth(const Frame& caller) const {
  // Ray generation is depth 0. [DXR: Ray recursion limit]
  if (caller.depth >= command_.linked->max_recursion_depth) {
    explain::leave("TraceRay or Invoke past the declared MaxTraceRecursionDepth");
  }
}

void Replay::trace_ray(Frame& caller, const shader::TraceRayArguments& arguments, void* payload,
                       const shader::RayDesc& ray, shader::HitObject* hit_object) {
  check_depth(caller);
  ++statistics_.TraceRayCalls;
  statistics_.MaxDepth = std::max(statistics_.MaxDepth, caller.depth + 1);
  Trace trace;
  trace.arguments = &arguments;
  trace.ray = ray;
  trace.reported_flags = arguments.ray_flags & runtime::kAllRayFlags;
  trace.caller = &caller;
  trace.payload = payload;
  trace.scene = scenes_.find(arguments.acceleration_structure);
  trace.search.flags = trace.reported_flags | runtime::ray_flags_of(command_.linked->flags);
  trace.search.inclusion_mask = arguments.instance_inclusion_mask & 0xFFu;
  trace.search.t_min = ray.t_min > 0 ? ray.t_min : 0.0f;
  trace.search.t_max = ray.t_max;
  trace.search.committed_t = ray.t_max;

  const Record miss = find_record(command_.desc.MissShaderTable, RecordKind::kMiss,
                                  arguments.miss_shader_index & 0xFFFFu);
  const char* layout = nullptr;
  if (rtapi::ExplainedCall* call = add_call(caller, rtapi::ExplainedCallKind::kTraceRay)) {
    trace.call = call;
    layout = payload_layout(miss.linked == nullptr ? nullptr : miss.linked->shader,
                            arguments.payload_bytes);
    call->Depth = caller.depth + 1;
    call->Scene = describe(arguments.acceleration_structure);
    call->Flags = static_cast<RayFlags>(trace.search.flags & runtime::kAllRayFlags);
    call->InstanceInclusionMask = trace.search.inclusion_mask;
    call->RayContributionToHitGroupIndex = arguments.ray_contribution_to_hit_group_index & 15u;
    call->MultiplierForGeometryContributionToHitGroupIndex =
        arguments.multiplier_for_geometry_contribution & 15u;
    call->MissShaderIndex = arguments.miss_shader_index & 0xFFFFu;
    describe_ray(ray, *call);
    call->Before = decode_values(layout, payload, arguments.payload_bytes);
    if (trace.scene == nullptr) {
      call->Note = arguments.acceleration_structure == 0
                       ? "the acceleration structure is null: every ray misses it"
                       : "no top level stands at that address: every ray misses it";
    } else if (!is_valid(ray)) {
      call->Note = "the ray is not finite, or TMin is beyond TMax: it misses";
    }
  }
  if (trace.scene != nullptr && is_valid(ray)) search(trace);
  if (hit_object != nullptr) {
    *hit_object = hit_object_of(trace);
    if (trace.call != nullptr) {
      trace.call->Note += trace.call->Note.empty() ? "" : "; ";
      trace.call->Note += "gives a hit object: Invoke runs the closest-hit or miss shader";
    }
  } else if (!trace.search.committed) {
    run_miss(trace);
  } else if (!has(trace.search.flags, RayFlags::kSkipClosestHitShader)) {
    run_closest_hit(trace);
  }
  if (trace.call == nullptr) return;
  trace.call->Hit = trace.search.committed;
  trace.call->HitT = trace.search.committed_t;
  trace.call->After = decode_values(layout, payload, arguments.payload_bytes);
}

void Replay::search(Trace& trace) {
  if (candidates_.size() == traces_) candidates_.emplace_back();
  std::vector<Candidate>& candidates = candidates_[traces_++];
  trace.scene->find(trace.ray, candidates);
  for (const Candidate& candidate : candidates) {
    const Instance& instance = trace.scene->instances()[candidate.instance];
    const auto refused = refusal(trace.search, candidate, instance);
    if (trace.call == nullptr) {
      if (!refused) offer(trace, candidate, nullptr);
      if (trace.search.ended) break;
      continue;
    }
    if (refused && trace.call->Candidates.size() >= max_candidates_) {
      ++trace.call->CandidatesLeftOut;
      continue;
    }
    trace.this_node = trace.call->Candidates.size();
    trace.call->Candidates.push_back(explain::describe(candidate, instance, trace.search.flags));
    rtapi::ExplainedCandidate& node = trace.call->Candidates.back();
    if (refused) {
      node.Outcome = *refused;
      node.Reason = refusal_text(*refused, trace.search, candidate, instance);
    } else {
      offer(trace, candidate, &node);
    }
  }
  --traces_;
}

void Replay::offer(Trace& trace, const Candidate& candidate, rtapi::ExplainedCandidate* node) {
  ++statistics_.Candidates;
  const Record record = hit_record(trace, candidate);
  if (node != nullptr) describe_hit_record(trace, candidate, record, node->Record);
  if (candidate.procedural) return offer_box(trace, candidate, record, node);
  offer_triangle(trace, candidate, record, node);
}

void Replay::offer_triangle(Trace& trace, const Candidate& candidate, const Record& record,
                            rtapi::ExplainedCandidate* node) {
  const Instance& instance = trace.scene->instances()[candidate.instance];
  const Opacity opacity = opacity_of(candidate, instance, trace.search.flags);
  const LinkedShader* any_hit = record.linked == nullptr ? nullptr : record.linked->any_hit;
  const uint32_t hit_kind = is_front_face(candidate, instance) ? rtapi::kHitKindTriangleFrontFace
                                                               : rtapi::kHitKindTriangleBackFace;
  const auto t = static_cast<float>(candidate.t);
  bool end_search = has(trace.search.flags, RayFlags::kAcceptFirstHitAndEndSearch);
  std::string reason;
  if (!opacity.opaque && any_hit != nullptr) {
    const AnyHitResult result =
        run_any_hit(trace, candidate, record, t, hit_kind, candidate.barycentrics,
                    node == nullptr ? nullptr : &node->Shaders);
    if (node != nullptr) {
      reason = "any-hit \"" + any_hit->name + "\" " +
               (result == AnyHitResult::kIgnore ? "ignored it" : "accepted it");
      if (result == AnyHitResult::kAcceptAndEndSearch) reason += " and ended the search";
    }
    if (result == AnyHitResult::kIgnore) {
      if (node != nullptr) node->Outcome = CandidateOutcome::kIgnored;
      if (node != nullptr) node->Reason = std::move(reason);
      return;
    }
    end_search |= result == AnyHitResult::kAcceptAndEndSearch;
  } else if (node != nullptr) {
    reason = opacity_text(opacity);
    if (!opacity.opaque) reason += ", but there is no any-hit shader";
  }
  if (node != nullptr) node->Reason = std::move(reason);
  commit(trace, candidate, record, t, hit_kind, candidate.barycentrics, end_search);
}

void Replay::offer_box(Trace& trace, const Candidate& candidate, const Record& record,
                       rtapi::ExplainedCandidate* node) {
  const LinkedShader* linked = record.linked == nullptr ? nullptr : record.linked->intersection;
  if (node != nullptr) node->Outcome = CandidateOutcome::kNotReported;
  if (linked == nullptr) {
    if (node != nullptr) node->Reason = "there is no intersection shader";
    return;
  }
  ++statistics_.IntersectionCalls;
  const Instance& instance = trace.scene->instances()[candidate.instance];
  Frame frame;
  frame.begin(*this, *linked, record, trace.caller->depth + 1);
  frame.values = {trace.ray,
                  trace.search.committed_t,
                  trace.reported_flags,
                  0,
                  candidate.instance,
                  instance.id,
                  candidate.geometry,
                  candidate.primitive,
                  instance.object_to_world.data(),
                  instance.world_to_object.rows};
  frame.ray = &frame.values;
  frame.trace = &trace;
  frame.candidate = &candidate;
  if (node != nullptr) {
    node->Shaders.push_back({linked->name, stage_of(*linked)});
    frame.node = &node->Shaders.back();
    frame.node->Record = node->Record;
  }
  enter();
  entry_of<shader::IntersectionFn> (*linked)(frame);
  leave();
  finish_queries(frame.node);
  if (node == nullptr) return;
  node->Reason = node->Outcome == CandidateOutcome::kCommitted
                     ? "intersection shader \"" + linked->name + "\" reported a hit"
                     : "intersection shader \"" + linked->name + "\" reported no hit that counts";
}

void Replay::commit(Trace& trace, const Candidate& candidate, const Record& record, float t,
                    uint32_t hit_kind, const void* attributes, bool end_search) {
  trace.search.committed = true;
  trace.search.committed_t = t;
  trace.search.ended = end_search;
  trace.hit = candidate;
  trace.hit_record = record;
  trace.hit_kind = hit_kind;
  std::memcpy(trace.attributes, attributes, candidate.procedural ? kMaxAttributeBytes : 8);
  if (trace.call == nullptr) return;
  auto& nodes = trace.call->Candidates;
  if (trace.hit_node != SIZE_MAX) nodes[trace.hit_node].Outcome = CandidateOutcome::kReplaced;
  trace.hit_node = trace.this_node;
  nodes[trace.hit_node].Outcome = CandidateOutcome::kCommitted;
}

AnyHitResult Replay::run_any_hit(Trace& trace, const Candidate& candidate, const Record& record,
                                 float t, uint32_t hit_kind, const void* attributes,
                                 std::vector<rtapi::ExplainedShader>* nodes) {
  ++statistics_.AnyHitCalls;
  const LinkedShader& linked = *record.linked->any_hit;
  const Instance& instance = trace.scene->instances()[candidate.instance];
  Frame frame;
  frame.begin(*this, linked, record, trace.caller->depth + 1);
  frame.values = {trace.ray,
                  t,
                  trace.reported_flags,
                  hit_kind,
                  candidate.instance,
                  instance.id,
                  candidate.geometry,
                  candidate.primitive,
                  instance.object_to_world.data(),
                  frame.transform(candidate, instance)};
  frame.ray = &frame.values;
  const shader::ExportDesc& code = *linked.code;
  const uint32_t payload_bytes = trace.arguments->payload_bytes;
  if (nodes != nullptr) {
    nodes->push_back({linked.name, stage_of(linked)});
    frame.node = &nodes->back();
    describe_hit_record(trace, candidate, record, frame.node->Record);
    frame.node->Attributes = decode_values(code.attribute_layout, attributes, code.attribute_bytes);
    frame.node->Before =
        decode_values(payload_layout(&linked, payload_bytes), trace.payload, payload_bytes);
  }
  enter();
  const AnyHitResult result = entry_of<shader::AnyHitFn>(linked)(frame, trace.payload, attributes);
  leave();
  finish_queries(frame.node);
  if (frame.node != nullptr) {
    frame.node->After =
        decode_values(payload_layout(&linked, payload_bytes), trace.payload, payload_bytes);
    frame.node->Result = result == AnyHitResult::kIgnore   ? "ignored"
                         : result == AnyHitResult::kAccept ? "accepted"
                                                           : "accepted, search ended";
  }
  return result;
}

ReportHitResult Replay::report_hit(Frame& frame, float t, uint32_t hit_kind, const void* attributes,
                                   uint32_t attribute_bytes) {
  Trace& trace = *frame.trace;
  rtapi::ExplainedCall* call = add_call(frame, rtapi::ExplainedCallKind::kReportHit);
  if (call != nullptr) {
    call->HitT = t;
    call->HitKind = hit_kind;
  }
  if (trace.search.ended) {
    if (call != nullptr) call->Note = "rejected: the search had ended";
    return ReportHitResult::kEndSearch;
  }
  // The interval is closed at both ends, and the test false for NaN. [DXR: Ray extents]
  if (!(t >= trace.search.t_min && t <= trace.search.committed_t)) {
    if (call != nullptr) {
      call->Note = "rejected: t is not between TMin " + number_text(trace.search.t_min) + " and " +
                   number_text(trace.search.committed_t);
    }
    return ReportHitResult::kRejected;
  }
  alignas(16) uint8_t bytes[kMaxAttributeBytes] = {};
  if (attributes != nullptr) {
    std::memcpy(bytes, attributes, std::min(attribute_bytes, kMaxAttributeBytes));
  }
  const Instance& instance = trace.scene->instances()[frame.candidate->instance];
  bool end_search = has(trace.search.flags, RayFlags::kAcceptFirstHitAndEndSearch);
  if (!opacity_of(*frame.candidate, instance, trace.search.flags).opaque &&
      frame.record.linked->any_hit != nullptr) {
    const AnyHitResult result = run_any_hit(trace, *frame.candidate, frame.record, t, hit_kind,
                                            bytes, call == nullptr ? nullptr : &call->Shaders);
    if (result == AnyHitResult::kIgnore) {
      if (call != nullptr) call->Note = "rejected: the any-hit shader ignored it";
      return ReportHitResult::kRejected;
    }
    end_search |= result == AnyHitResult::kAcceptAndEndSearch;
  }
  commit(trace, *frame.candidate, frame.record, t, hit_kind, bytes, end_search);
  frame.values.t_current = t;
  if (call != nullptr) {
    call->Hit = true;
    call->Note = end_search ? "accepted, search ended" : "accepted";
  }
  return end_search ? ReportHitResult::kEndSearch : ReportHitResult::kAccepted;
}

void Replay::run_closest_hit(Trace& trace) {
  const LinkedShader* linked =
      trace.hit_record.linked == nullptr ? nullptr : trace.hit_record.linked->closest_hit;
  if (linked == nullptr) {
    if (trace.call != nullptr) trace.call->Note = "the hit group has no closest-hit shader";
    return;
  }
  const Instance& instance = trace.scene->instances()[trace.hit.instance];
  Frame frame;
  frame.begin(*this, *linked, trace.hit_record, trace.caller->depth + 1);
  frame.values = {trace.ray,
                  trace.search.committed_t,
                  trace.reported_flags,
                  trace.hit_kind,
                  trace.hit.instance,
                  instance.id,
                  trace.hit.geometry,
                  trace.hit.primitive,
                  instance.object_to_world.data(),
                  frame.transform(trace.hit, instance)};
  frame.ray = &frame.values;
  const char* layout = payload_layout(linked, trace.arguments->payload_bytes);
  if (trace.call != nullptr) {
    trace.call->Shaders.push_back({linked->name, stage_of(*linked)});
    frame.node = &trace.call->Shaders.back();
    describe_hit_record(trace, trace.hit, trace.hit_record, frame.node->Record);
    frame.node->Attributes =
        decode_values(linked->code->attribute_layout, trace.attributes,
                      std::min(linked->code->attribute_bytes, kMaxAttributeBytes));
    frame.node->Before = decode_values(layout, trace.payload, trace.arguments->payload_bytes);
  }
  enter();
  entry_of<shader::ClosestHitFn> (*linked)(frame, trace.payload, trace.attributes);
  leave();
  finish_queries(frame.node);
  if (frame.node != nullptr) {
    frame.node->After = decode_values(layout, trace.payload, trace.arguments->payload_bytes);
  }
}

void Replay::run_miss(Trace& trace) {
  const uint32_t index = trace.arguments->miss_shader_index & 0xFFFFu;
  const Record record = find_record(command_.desc.MissShaderTable, RecordKind::kMiss, index);
  const LinkedShader* linked = record.linked == nullptr ? nullptr : record.linked->shader;
  if (linked == nullptr) {
    if (trace.call != nullptr) {
      if (!trace.call->Note.empty()) trace.call->Note += "; ";
      trace.call->Note +=
          "no miss shader runs for record " + std::to_string(index) + ": " + record.reason;
    }
    return;
  }
  Frame frame;
  frame.begin(*this, *linked, record, trace.caller->depth + 1);
  frame.values = {trace.ray, trace.ray.t_max, trace.reported_flags, 0, 0, 0, 0, 0,
                  nullptr,   nullptr};
  frame.ray = &frame.values;
  const char* layout = payload_layout(linked, trace.arguments->payload_bytes);
  if (trace.call != nullptr) {
    trace.call->Shaders.push_back({linked->name, stage_of(*linked)});
    frame.node = &trace.call->Shaders.back();
    frame.node->Record = {"miss", index, std::to_string(index) + " (miss index)",
                          record.linked->name, ""};
    frame.node->Before = decode_values(layout, trace.payload, trace.arguments->payload_bytes);
  }
  enter();
  entry_of<shader::MissFn> (*linked)(frame, trace.payload);
  leave();
  finish_queries(frame.node);
  if (frame.node != nullptr) {
    frame.node->After = decode_values(layout, trace.payload, trace.arguments->payload_bytes);
  }
}

}  // namespace kaamos::explain

// SPDX-License-Identifier: MIT
//
// RayQuery: the shader decides about every non-opaque or procedural candidate.
#include <cmath>

#include "kaamos/shader/ray_query.h"
#include "runtime/backend/ray_flags.h"
#include "runtime/explain/replay_state.h"
#include "runtime/explain/values.h"
#include "runtime/structures/instances.h"

namespace kaamos::explain {

using rtapi::CandidateOutcome;
using shader::RayQuery;
using shader::RayQueryHit;

namespace {

RayQueryHit hit_of(const Candidate& candidate, const Instance& instance, bool opaque) {
  RayQueryHit hit;
  hit.type = candidate.procedural ? shader::kQueryProcedural : shader::kQueryTriangle;
  hit.t = candidate.procedural ? 0 : static_cast<float>(candidate.t);
  hit.instance_index = candidate.instance;
  hit.instance_id = instance.id;
  hit.instance_contribution = instance.desc.InstanceContributionToHitGroupIndex;
  hit.geometry_index = candidate.geometry;
  hit.primitive_index = candidate.primitive;
  hit.barycentrics[0] = candidate.barycentrics[0];
  hit.barycentrics[1] = candidate.barycentrics[1];
  hit.front_face = !candidate.procedural && is_front_face(candidate, instance);
  hit.non_opaque = candidate.procedural && !opaque;
  hit.object_to_world = instance.object_to_world.data();
  hit.world_to_object = instance.world_to_object.rows;
  hit.cluster = candidate.cluster;
  return hit;
}

bool is_hit(const RayQueryHit& hit, const Candidate& candidate) {
  return hit.type != 0 && hit.instance_index == candidate.instance &&
         hit.geometry_index == candidate.geometry && hit.primitive_index == candidate.primitive &&
         hit.cluster == candidate.cluster;
}

}  // namespace

void Replay::begin_query(Frame& caller, RayQuery& query, const shader::RayQueryArguments& arguments,
                         const shader::RayDesc& ray) {
  ++statistics_.RayQueries;
  Query& state = queries_.emplace_back();
  state.scene = scenes_.find(arguments.acceleration_structure);
  query.ray = ray;
  query.ray_flags = arguments.ray_flags & runtime::kAllRayFlags;
  query.inclusion_mask = arguments.instance_inclusion_mask;
  query.has_candidate = false;
  query.candidate = {};
  query.committed = {};
  query.committed.t = ray.t_max;
  query.scene = &state;
  query.ended = state.scene == nullptr || !is_valid(ray);
  state.search.flags = query.ray_flags | (arguments.ray_flags & shader::kRayQueryAllowsMicromaps);
  state.search.inclusion_mask = arguments.instance_inclusion_mask & 0xFFu;
  state.search.t_min = ray.t_min > 0 ? ray.t_min : 0.0f;
  state.search.t_max = ray.t_max;
  if (!query.ended) state.scene->find(ray, state.candidates);
  state.recorded.assign(state.candidates.size(), SIZE_MAX);
  rtapi::ExplainedCall* call = add_call(caller, rtapi::ExplainedCallKind::kRayQuery);
  if (call == nullptr) return;
  state.node = caller.node;
  state.call = caller.node->Calls.size() - 1;
  call->Scene = describe(arguments.acceleration_structure);
  call->Flags = static_cast<rtapi::RayFlags>(query.ray_flags);
  call->InstanceInclusionMask = state.search.inclusion_mask;
  for (int i = 0; i < 3; ++i) {
    call->Origin[i] = ray.origin[i];
    call->Direction[i] = ray.direction[i];
  }
  call->TMin = ray.t_min;
  call->TMax = ray.t_max;
  if (query.ended) {
    call->Note = state.scene == nullptr
                     ? "no top level stands at that address: every ray misses it"
                     : "the ray is not finite, or TMin is beyond TMax: it misses";
  }
}

// Takes over what the shader has committed since the last call.
void Replay::settle(Query& state, const RayQuery& query) {
  const bool committed = query.committed.type != 0;
  state.search.committed = committed;
  state.search.committed_t = query.committed.t;
  state.search.ended = query.ended;
  const size_t offered = std::exchange(state.offered, SIZE_MAX);
  if (state.node == nullptr) return;
  rtapi::ExplainedCall& call = state.node->Calls[state.call];
  call.Hit = committed;
  call.HitT = query.committed.t;
  if (offered == SIZE_MAX || state.recorded[offered] == SIZE_MAX) return;
  rtapi::ExplainedCandidate& node = call.Candidates[state.recorded[offered]];
  if (committed && is_hit(query.committed, state.candidates[offered])) {
    if (state.committed != SIZE_MAX) {
      call.Candidates[state.committed].Outcome = CandidateOutcome::kReplaced;
    }
    state.committed = state.recorded[offered];
    node.Outcome = CandidateOutcome::kCommitted;
    node.Reason = "the shader committed it";
    if (node.Procedural) node.Reason += " at t " + number_text(query.committed.t);
  } else {
    node.Outcome = CandidateOutcome::kNotCommitted;
    node.Reason = "the shader did not commit it";
  }
}

bool Replay::proceed(RayQuery& query) {
  auto& state = *static_cast<Query*>(const_cast<void*>(query.scene));
  settle(state, query);
  while (state.next < state.candidates.size() && !query.ended) {
    const size_t position = state.next++;
    const Candidate& candidate = state.candidates[position];
    const Instance& instance = state.scene->instances()[candidate.instance];
    const auto refused = refusal(state.search, candidate, instance);
    const Opacity opacity = opacity_of(candidate, instance, state.search.flags);
    rtapi::ExplainedCandidate* node = nullptr;
    if (state.node != nullptr) {
      rtapi::ExplainedCall& call = state.node->Calls[state.call];
      if (refused && call.Candidates.size() >= max_candidates_) {
        ++call.CandidatesLeftOut;
      } else {
        state.recorded[position] = call.Candidates.size();
        call.Candidates.push_back(explain::describe(candidate, instance, state.search.flags));
        node = &call.Candidates.back();
      }
    }
    if (refused) {
      if (node != nullptr) {
        node->Outcome = *refused;
        node->Reason = refusal_text(*refused, state.search, candidate, instance);
      }
      continue;
    }
    ++statistics_.Candidates;
    if (candidate.procedural || !opacity.opaque) {
      query.candidate = hit_of(candidate, instance, opacity.opaque);
      state.offered = position;
      if (node != nullptr) {
        node->Outcome = CandidateOutcome::kOffered;
        node->Reason = "the shader decided about it, and did not call Proceed again";
      }
      return true;
    }
    query.committed = hit_of(candidate, instance, true);
    query.committed.type = shader::kCommittedTriangle;
    constexpr auto kEnd = static_cast<uint32_t>(rtapi::RayFlags::kAcceptFirstHitAndEndSearch);
    if ((query.ray_flags & kEnd) != 0) query.ended = true;
    settle(state, query);
    if (node == nullptr) continue;
    rtapi::ExplainedCall& call = state.node->Calls[state.call];
    if (state.committed != SIZE_MAX) {
      call.Candidates[state.committed].Outcome = CandidateOutcome::kReplaced;
    }
    state.committed = state.recorded[position];
    node->Outcome = CandidateOutcome::kCommitted;
    node->Reason = opacity_text(opacity);
  }
  return false;
}

// Lists the candidates that no Proceed reached, once the shader has returned. The RayQuery no
// longer exists by then.
void Replay::finish_queries(const rtapi::ExplainedShader* node) {
  if (node == nullptr) return;
  for (Query& state : queries_) {
    if (state.node != node) continue;
    rtapi::ExplainedCall& call = state.node->Calls[state.call];
    state.search.ended = true;
    for (; state.next < state.candidates.size(); ++state.next) {
      const Candidate& candidate = state.candidates[state.next];
      const Instance& instance = state.scene->instances()[candidate.instance];
      if (call.Candidates.size() >= max_candidates_) {
        ++call.CandidatesLeftOut;
        continue;
      }
      call.Candidates.push_back(explain::describe(candidate, instance, state.search.flags));
      rtapi::ExplainedCandidate& last = call.Candidates.back();
      last.Outcome = *refusal(state.search, candidate, instance);
      last.Reason = refusal_text(last.Outcome, state.search, candidate, instance);
    }
    state.node = nullptr;
  }
}

}  // namespace kaamos::explain

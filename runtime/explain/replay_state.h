// SPDX-License-Identifier: MIT
//
// The state of one shader invocation, one TraceRay and one RayQuery while they are replayed.
#pragma once

#include <vector>

#include "kaamos/shader/bound.h"
#include "runtime/explain/replay.h"
#include "runtime/explain/verdict.h"

namespace kaamos::explain {

inline constexpr uint32_t kMaxAttributeBytes = 32;

// Rays that traversals accept; every other ray, with NaN for example, misses.
bool is_valid(const shader::RayDesc& ray);

struct Replay::Record {
  const runtime::LinkedRecord* linked = nullptr;  // null: nothing runs
  const uint8_t* address = nullptr;
  const char* reason = "";  // why nothing runs
};

struct Replay::Trace {
  const shader::TraceRayArguments* arguments = nullptr;
  shader::RayDesc ray;
  uint32_t reported_flags = 0;
  const shader::Invocation* caller = nullptr;
  void* payload = nullptr;
  const TopLevel* scene = nullptr;
  Search search;
  rtapi::ExplainedCall* call = nullptr;  // null: nothing is recorded
  // The committed hit
  Candidate hit;
  Record hit_record;
  uint32_t hit_kind = 0;
  size_t hit_node = SIZE_MAX;   // in call->Candidates
  size_t this_node = SIZE_MAX;  // the candidate being offered
  alignas(16) uint8_t attributes[kMaxAttributeBytes] = {};
};

// A running shader; Invocation::backend points to it. A fault jumps over it, so it owns nothing.
struct Replay::Frame : shader::Invocation {
  Replay* replay = nullptr;
  rtapi::ExplainedShader* node = nullptr;  // null: nothing is recorded
  shader::RaySystemValues values = {};
  Trace* trace = nullptr;                // only for intersection shaders
  const Candidate* candidate = nullptr;  // only for intersection shaders
  Record record;
  shader::InstanceTransform in_cluster = {};

  // RaySystemValues::world_to_object for a triangle.
  const float* transform(const Candidate& its_candidate, const Instance& instance) {
    if (its_candidate.cluster == nullptr) return instance.world_to_object.rows;
    in_cluster = instance.world_to_object;
    in_cluster.positions = shader::table_of(its_candidate.cluster);
    return in_cluster.rows;
  }
  void begin(Replay& self, const runtime::LinkedShader& linked, const Record& its_record,
             uint32_t its_depth) {
    replay = &self;
    record = its_record;
    dispatch = &self.dispatch_;
    slots = linked.slots.data();
    local_arguments = its_record.address + rtapi::kShaderIdentifierSizeInBytes;
    for (int i = 0; i < 3; ++i) index[i] = self.index_[i];
    depth = its_depth;
    backend = this;
    if ((linked.code->flags & shader::kExportReadsBound) == 0) return;
    std::vector<shader::BoundResource>& resources = self.bound_[&linked];
    if (resources.empty()) {
      resources.resize(linked.slots.size());
      shader::bind(*this, linked.code->bindings, linked.code->binding_count, resources.data());
    }
    bound = resources.data();
  }
};

struct Replay::Query {
  const TopLevel* scene = nullptr;
  std::vector<Candidate> candidates;
  size_t next = 0;
  Search search;
  // The shader where it is recorded; null: nowhere.
  rtapi::ExplainedShader* node = nullptr;
  size_t call = 0;
  size_t offered = SIZE_MAX;     // the candidate that the shader has not answered yet
  size_t committed = SIZE_MAX;   // index of the committed one in the recorded candidates
  std::vector<size_t> recorded;  // for each candidate, its place in ExplainedCall::Candidates
};

template <class Function>
Function entry_of(const runtime::LinkedShader& linked) {
  return reinterpret_cast<Function>(linked.code->entry);
}

inline rtapi::ShaderStage stage_of(const runtime::LinkedShader& linked) {
  return static_cast<rtapi::ShaderStage>(linked.stage);
}

const char* table_name(runtime::RecordKind kind);

rtapi::ExplainedCandidate describe(const Candidate& candidate, const Instance& instance,
                                   uint32_t flags);

const shader::Services& services();
// Sets whose textures the shaders on this thread read: texture services get no invocation.
void set_environment(const Environment* environment);

}  // namespace kaamos::explain

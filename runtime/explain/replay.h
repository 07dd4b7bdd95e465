// SPDX-License-Identifier: MIT
//
// Runs the shaders of one DispatchRaysIndex at a time on the calling thread, with services of its
// own: scene.h traces the rays, and whatever happens is written down.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <rtapi/explain.h>

#include "kaamos/shader/abi.h"
#include "kaamos/shader/bound.h"
#include "kaamos/shader/texture_view.h"
#include "runtime/backend/address_map.h"
#include "runtime/backend/backend.h"
#include "runtime/backend/linked_pipeline.h"
#include "runtime/explain/scene.h"

namespace kaamos::explain {

// The parts of a device that a replay needs; all of them outlive the replay.
struct Environment {
  const runtime::BackendDevice* backend = nullptr;
  const runtime::AddressMap* addresses = nullptr;
  // Copies of textures in host memory; null reads as zeros. Writes go to the copies.
  std::function<const shader::TextureView*(const shader::Descriptor&)> texture;
  std::function<const shader::SamplerState*(const shader::Descriptor&)> sampler;
};

class Replay {
 public:
  Replay(const Environment& environment, const runtime::DispatchRaysCommand& command);
  ~Replay();
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  // Also writes to the memory that the shaders write to. `out` is null where only the counts
  // matter.
  rtapi::PixelStatistics run(const uint32_t index[3], uint32_t max_candidates,
                             rtapi::PixelExplanation* out);

 private:
  friend struct Services;
  struct Frame;
  struct Trace;
  struct Query;
  struct Record;
  struct Verdict;

  rtapi::AddressDescription describe(uint64_t address) const;
  bool recording() const { return explanation_ != nullptr; }
  void run_ray_generation();

  // Records of shader tables
  Record find_record(const rtapi::GpuVirtualAddressRangeAndStride& table, runtime::RecordKind kind,
                     uint64_t index) const;
  // The record that a hit object is bound to.
  Record bound_record(const shader::HitObject& hit) const;
  uint64_t hit_record_index(const Trace& trace, const Candidate& candidate) const;
  Record hit_record(const Trace& trace, const Candidate& candidate) const;
  void describe_hit_record(const Trace& trace, const Candidate& candidate, const Record& record,
                           rtapi::ExplainedRecord& out) const;

  // TraceRay
  // Runs no closest-hit or miss shader if there is a hit object, but fills it in.
  void trace_ray(Frame& caller, const shader::TraceRayArguments& arguments, void* payload,
                 const shader::RayDesc& ray, shader::HitObject* hit_object = nullptr);
  void invoke(Frame& caller, const shader::HitObject& hit, void* payload, uint32_t payload_bytes);
  uint32_t record_constant(const shader::HitObject& hit, uint32_t offset) const;
  void search(Trace& trace);
  void offer(Trace& trace, const Candidate& candidate, rtapi::ExplainedCandidate* node);
  void offer_triangle(Trace& trace, const Candidate& candidate, const Record& record,
                      rtapi::ExplainedCandidate* node);
  void offer_box(Trace& trace, const Candidate& candidate, const Record& record,
                 rtapi::ExplainedCandidate* node);
  void commit(Trace& trace, const Candidate& candidate, const Record& record, float t,
              uint32_t hit_kind, const void* attributes, bool end_search);
  shader::HitObject hit_object_of(const Trace& trace) const;
  void run_closest_hit(Trace& trace);
  void run_miss(Trace& trace);
  shader::AnyHitResult run_any_hit(Trace& trace, const Candidate& candidate, const Record& record,
                                   float t, uint32_t hit_kind, const void* attributes,
                                   std::vector<rtapi::ExplainedShader>* nodes);
  shader::ReportHitResult report_hit(Frame& frame, float t, uint32_t hit_kind,
                                     const void* attributes, uint32_t attribute_bytes);
  const char* payload_layout(const runtime::LinkedShader* shader, uint32_t bytes) const;

  // The rest
  void call_shader(Frame& caller, uint32_t index, void* data, uint32_t data_bytes);
  void begin_query(Frame& caller, shader::RayQuery& query,
                   const shader::RayQueryArguments& arguments, const shader::RayDesc& ray);
  bool proceed(shader::RayQuery& query);
  void settle(Query& state, const shader::RayQuery& query);
  void finish_queries(const rtapi::ExplainedShader* node);
  rtapi::ExplainedCall* add_call(Frame& caller, rtapi::ExplainedCallKind kind);
  // Ends the replay if the caller may trace no more.
  void check_depth(const Frame& caller) const;
  void enter();  // counts nested shaders, and ends the replay when there are too many
  void leave() { --nesting_; }

  const Environment& environment_;
  const runtime::DispatchRaysCommand& command_;
  shader::DispatchConstants dispatch_;
  Scenes scenes_;
  // The resources that each shader has bound, looked up when it first runs.
  std::map<const runtime::LinkedShader*, std::vector<shader::BoundResource>> bound_;

  // State of the index that is running. Whatever must survive across shader calls is kept here,
  // because a fault jumps over frames.
  rtapi::PixelExplanation* explanation_ = nullptr;
  rtapi::PixelStatistics statistics_;
  uint32_t max_candidates_ = 0;
  uint32_t index_[3] = {0, 0, 0};
  uint32_t nesting_ = 0;
  uint32_t traces_ = 0;                            // in flight
  std::deque<std::vector<Candidate>> candidates_;  // one per trace in flight, reused
  std::deque<Query> queries_;
};

}  // namespace kaamos::explain

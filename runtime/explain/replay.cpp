// SPDX-License-Identifier: MIT
#include "runtime/explain/replay.h"

#include <algorithm>
#include <cstring>

#include "runtime/explain/guard.h"
#include "runtime/explain/replay_state.h"
#include "runtime/explain/values.h"
#include "runtime/shader/float_mode.h"

namespace kaamos::explain {
namespace {

using runtime::LinkedRecord;
using runtime::LinkedShader;
using runtime::RecordKind;

// The depth to which shaders may call each other; DXR's own limits are 31 for TraceRay and the
// stack for CallShader.
constexpr uint32_t kMaxNesting = 96;

void set_range(const std::shared_ptr<runtime::BackendBuffer>& heap,
               const shader::Descriptor*& begin, const shader::Descriptor*& end) {
  if (heap == nullptr || heap->host() == nullptr) return;
  begin = reinterpret_cast<const shader::Descriptor*>(heap->host());
  end = begin + heap->size_bytes() / sizeof(shader::Descriptor);
}

}  // namespace

const char* table_name(RecordKind kind) {
  switch (kind) {
    case RecordKind::kRayGeneration:
      return "ray generation";
    case RecordKind::kMiss:
      return "miss";
    case RecordKind::kCallable:
      return "callable";
    case RecordKind::kHitGroup:
    case RecordKind::kNone:
      break;
  }
  return "hit group";
}

Replay::Replay(const Environment& environment, const runtime::DispatchRaysCommand& command)
    : environment_(environment), command_(command), scenes_(*environment.backend) {
  dispatch_.services = &services();
  dispatch_.root_arguments = command.state.root_arguments->bytes.data();
  dispatch_.dimensions[0] = command.desc.Width;
  dispatch_.dimensions[1] = command.desc.Height;
  dispatch_.dimensions[2] = command.desc.Depth;
  set_range(command.state.view_heap, dispatch_.view_heap_begin, dispatch_.view_heap_end);
  set_range(command.state.sampler_heap, dispatch_.sampler_heap_begin, dispatch_.sampler_heap_end);
}

Replay::~Replay() = default;

rtapi::AddressDescription Replay::describe(uint64_t address) const {
  rtapi::AddressDescription where;
  where.Address = address;
  if (const auto allocation = environment_.addresses->find(address)) {
    where.Live = true;
    where.Buffer = allocation->name;
    where.OffsetInBytes = address - allocation->address;
    where.SizeInBytes = allocation->size_bytes;
  }
  return where;
}

rtapi::PixelStatistics Replay::run(const uint32_t index[3], uint32_t max_candidates,
                                   rtapi::PixelExplanation* out) {
  explanation_ = out;
  statistics_ = {};
  max_candidates_ = max_candidates;
  nesting_ = 0;
  traces_ = 0;
  queries_.clear();
  for (int i = 0; i < 3; ++i) {
    index_[i] = index[i];
    if (out == nullptr) continue;
    out->Index[i] = index[i];
    out->Dimensions[i] = dispatch_.dimensions[i];
  }
  const shader::FloatMode float_mode;
  set_environment(&environment_);
  const std::string removal =
      run_guarded([](void* self) { static_cast<Replay*>(self)->run_ray_generation(); }, this);
  if (out != nullptr) out->Removal = removal;
  return statistics_;
}

void Replay::run_ray_generation() {
  const auto& range = command_.desc.RayGenerationShaderRecord;
  const Record record =
      find_record({range.StartAddress, std::max<uint64_t>(range.SizeInBytes, 32), 0},
                  RecordKind::kRayGeneration, 0);
  if (record.linked == nullptr || record.linked->shader == nullptr) return;
  const LinkedShader& linked = *record.linked->shader;
  Frame frame;
  frame.begin(*this, linked, record, 0);
  if (recording()) {
    explanation_->RayGeneration.push_back({linked.name, stage_of(linked)});
    frame.node = &explanation_->RayGeneration.back();
    frame.node->Record = {table_name(RecordKind::kRayGeneration), 0, "", record.linked->name, ""};
  }
  enter();
  entry_of<shader::RayGenerationFn>(linked)(frame);
  leave();
  finish_queries(frame.node);
}

void Replay::enter() {
  if (++nesting_ > kMaxNesting) explain::leave("shaders call each other without end");
}

Replay::Record Replay::find_record(const rtapi::GpuVirtualAddressRangeAndStride& table,
                                   RecordKind kind, uint64_t index) const {
  Record out;
  const uint64_t slot = table.StrideInBytes == 0 ? 0 : index;
  uint64_t count = 0;
  if (table.StartAddress != 0 && table.SizeInBytes >= 32) {
    count = table.StrideInBytes == 0 ? 1 : (table.SizeInBytes - 32) / table.StrideInBytes + 1;
  }
  if (slot >= count) {
    out.reason = "the index is past the table's end";
    return out;
  }
  const uint64_t address = table.StartAddress + slot * table.StrideInBytes;
  if (environment_.addresses->bytes_from(address) < 32) {
    out.reason = "the record lies outside every live buffer";
    return out;
  }
  out.address = environment_.addresses->host(address);
  if (runtime::is_null_identifier(out.address)) {
    out.reason = "the identifier is NULL";
    return out;
  }
  out.linked = command_.linked->identifiers.find(out.address);
  if (out.linked == nullptr) {
    out.reason = "its bytes are no identifier of this state object";
  } else if (out.linked->kind != kind) {
    out.linked = nullptr;
    out.reason = "its identifier belongs in another table";
  }
  return out;
}

uint64_t Replay::hit_record_index(const Trace& trace, const Candidate& candidate) const {
  const rtapi::RaytracingInstanceDesc& instance = trace.scene->instances()[candidate.instance].desc;
  return uint64_t{trace.arguments->ray_contribution_to_hit_group_index & 15u} +
         uint64_t{trace.arguments->multiplier_for_geometry_contribution & 15u} *
             candidate.geometry +
         instance.InstanceContributionToHitGroupIndex;
}

Replay::Record Replay::hit_record(const Trace& trace, const Candidate& candidate) const {
  return find_record(command_.desc.HitGroupTable, RecordKind::kHitGroup,
                     hit_record_index(trace, candidate));
}

void Replay::describe_hit_record(const Trace& trace, const Candidate& candidate,
                                 const Record& record, rtapi::ExplainedRecord& out) const {
  const rtapi::RaytracingInstanceDesc& instance = trace.scene->instances()[candidate.instance].desc;
  const uint32_t ray = trace.arguments->ray_contribution_to_hit_group_index & 15u;
  const uint32_t multiplier = trace.arguments->multiplier_for_geometry_contribution & 15u;
  out.Table = table_name(RecordKind::kHitGroup);
  out.Index = hit_record_index(trace, candidate);
  out.Arithmetic = std::to_string(ray) + " (ray) + " + std::to_string(multiplier) +
                   " (multiplier) * " + std::to_string(candidate.geometry) + " (geometry) + " +
                   std::to_string(instance.InstanceContributionToHitGroupIndex) + " (instance)";
  if (record.linked != nullptr) out.Export = record.linked->name;
  out.Reason = record.reason;
}

// The payload's fields as the miss shader declares them, or else as any shader with a payload of
// that size does.
const char* Replay::payload_layout(const LinkedShader* shader, uint32_t bytes) const {
  const auto knows = [](const shader::ExportDesc& code) {
    return code.payload_layout != nullptr && *code.payload_layout != '\0';
  };
  if (shader != nullptr && knows(*shader->code)) return shader->code->payload_layout;
  for (const auto& each : command_.linked->shaders) {
    const shader::ExportDesc& code = *each->code;
    if (knows(code) && code.payload_storage_bytes == bytes &&
        code.stage != shader::Stage::kCallable) {
      return code.payload_layout;
    }
  }
  return nullptr;
}

rtapi::ExplainedCall* Replay::add_call(Frame& caller, rtapi::ExplainedCallKind kind) {
  if (caller.node == nullptr) return nullptr;
  rtapi::ExplainedCall& call = caller.node->Calls.emplace_back();
  call.Kind = kind;
  return &call;
}

void Replay::call_shader(Frame& caller, uint32_t index, void* data, uint32_t data_bytes) {
  ++statistics_.CallableCalls;
  const Record record =
      find_record(command_.desc.CallableShaderTable, RecordKind::kCallable, index);
  const LinkedShader* linked = record.linked == nullptr ? nullptr : record.linked->shader;
  const char* layout = linked == nullptr ? nullptr : linked->code->payload_layout;
  Frame frame;
  rtapi::ExplainedCall* call = add_call(caller, rtapi::ExplainedCallKind::kCallShader);
  if (call != nullptr) {
    call->Before = decode_values(layout, data, data_bytes);
    call->Shaders.emplace_back();
    frame.node = &call->Shaders.back();
    frame.node->Stage = rtapi::ShaderStage::kCallable;
    frame.node->Record = {table_name(RecordKind::kCallable), index,
                          std::to_string(index) + " (shader index)",
                          linked == nullptr ? "" : record.linked->name, record.reason};
    if (linked == nullptr) call->Shaders.clear();
    if (linked == nullptr) call->Note = std::string("nothing runs: ") + record.reason;
  }
  if (linked == nullptr) return;
  if (frame.node != nullptr) frame.node->Name = linked->name;
  frame.begin(*this, *linked, record, caller.depth);
  enter();
  entry_of<shader::CallableFn> (*linked)(frame, data);
  leave();
  finish_queries(frame.node);
  if (call != nullptr) call->After = decode_values(layout, data, data_bytes);
}

}  // namespace kaamos::explain

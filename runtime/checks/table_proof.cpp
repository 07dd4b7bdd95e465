// SPDX-License-Identifier: MIT
#include "runtime/checks/table_proof.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>
#include <vector>

#include "runtime/backend/ray_flags.h"
#include "runtime/checks/arguments.h"
#include "runtime/checks/names.h"
#include "runtime/checks/record_advice.h"
#include "runtime/checks/traced_levels.h"

namespace kaamos::checks {
namespace {

using runtime::LinkedRecord;
using runtime::LinkedShader;
using runtime::RecordKind;
using shader::TraceCall;

// The reason why a ray gets to a record, for messages.
struct Reason {
  const TraceCall* call = nullptr;
  const LinkedShader* shader = nullptr;
  uint32_t instance = 0;
  uint32_t geometry = 0;
  uint32_t contribution = 0;  // the instance's
  bool procedural = false;
  uint32_t callable = 0;
};

// Returns whether a ray with these flags needs any shader of the record; if it needs none, the
// record is not reached. [DXR: TraceRay control flow]
bool reaches(const TraceCall& call, const TrackedInstance& instance,
             const runtime::GeometryShape& geometry, uint32_t pipeline_flags) {
  enum : uint32_t {
    kForceOpaque = 1,
    kForceNonOpaque = 2,
    kSkipClosestHit = 8,
    kCullOpaque = 0x40,
    kCullNonOpaque = 0x80,
    kSkipTriangles = 0x100,
    kSkipProcedurals = 0x200,
  };
  const uint32_t flags = call.ray_flags | pipeline_flags;
  const bool procedural = geometry.type == rtapi::RaytracingGeometryType::kProceduralPrimitiveAabbs;
  if (geometry.primitives == 0) return false;
  if (procedural ? flags & kSkipProcedurals : flags & kSkipTriangles) return false;
  // Any part of it may be opaque or not.
  if (geometry.linked && (instance.flags & 12) == 0) {
    return (flags & (kForceOpaque | kSkipClosestHit)) != (kForceOpaque | kSkipClosestHit);
  }
  bool opaque = geometry.opaque;
  if (instance.flags & 4) opaque = true;
  if (instance.flags & 8) opaque = false;
  if (flags & kForceOpaque) opaque = true;
  if (flags & kForceNonOpaque) opaque = false;
  if (opaque ? flags & kCullOpaque : flags & kCullNonOpaque) return false;
  return procedural || !opaque || (flags & kSkipClosestHit) == 0;
}

class Proof {
 public:
  Proof(const ProofInputs& inputs, const runtime::DispatchRaysCommand& command)
      : inputs_(inputs), command_(command), linked_(*command.linked) {
    const rtapi::DispatchRaysDesc& desc = command.desc;
    const auto& first = desc.RayGenerationShaderRecord;
    set(RecordKind::kRayGeneration, "ray generation record",
        {first.StartAddress, first.SizeInBytes, 0});
    set(RecordKind::kMiss, "miss table", desc.MissShaderTable);
    set(RecordKind::kCallable, "callable table", desc.CallableShaderTable);
    set(RecordKind::kHitGroup, "hit group table", desc.HitGroupTable);
  }

  ProofResults run() {
    reach(RecordKind::kRayGeneration, 0, {});
    return follow_all();
  }
  ProofResults run(std::span<const runtime::ReachedFrom> calls) {
    for (const runtime::ReachedFrom& each : calls) reach_from(each);
    return follow_all();
  }

 private:
  ProofResults follow_all() {
    while (!pending_.empty()) {
      const auto [shader, record] = pending_.back();
      pending_.pop_back();
      follow(*shader, record);
    }
    return std::move(results_);
  }

  struct Table {
    const char* name = "";
    rtapi::GpuVirtualAddressRangeAndStride range = {};
    const uint8_t* host = nullptr;
    // Records already checked; hit groups once with triangles and once with boxes.
    std::set<std::pair<uint64_t, bool>> seen = {};
    bool layout_told = false;  // a wrong stride breaks every record, so report it once
  };

  void set(RecordKind kind, const char* name, rtapi::GpuVirtualAddressRangeAndStride range) {
    Table& table = tables_[static_cast<size_t>(kind)];
    table.name = name;
    table.range = range;
    if (range.StartAddress != 0 && range.SizeInBytes != 0 &&
        inputs_.addresses.contains(range.StartAddress, range.SizeInBytes)) {
      table.host = inputs_.addresses.host(range.StartAddress);
    }
  }

  void report(Id id, const std::string& text) {
    inputs_.reporter.report(id, Reporter::key_of(text), told_++, [&] { return text; });
    results_.good = false;
  }
  // The ray generation record is always reached, so its absence is an error right away.
  void report_missing(RecordKind kind, Id id, const std::string& text) {
    if (kind == RecordKind::kRayGeneration) return report(id, text);
    results_.missing.push_back({kind, id == Id::kRecordOutOfTable, id, told_++, text});
    results_.good = false;
  }

  // "hit group table record 5".
  std::string name_of(const Table& table, RecordKind kind, uint64_t index) const {
    if (kind == RecordKind::kRayGeneration) return table.name;
    return std::string(table.name) + " record " + std::to_string(index);
  }
  std::string reason_text(RecordKind kind, const Reason& reason) const {
    if (reason.shader == nullptr) return "";
    std::string text = ", reached from " + shader_name(*reason.shader);
    if (kind == RecordKind::kCallable) {
      return text + " by CallShader(" + std::to_string(reason.callable) + ")";
    }
    text += call_place(*reason.call);
    if (kind == RecordKind::kMiss) {
      return text + " with MissShaderIndex " + std::to_string(reason.call->miss_index);
    }
    return text + " at instance " + std::to_string(reason.instance) + ", geometry " +
           std::to_string(reason.geometry) + ", ray type " +
           std::to_string(reason.call->ray_contribution) + ": instance contribution " +
           std::to_string(reason.contribution) + " + multiplier " +
           std::to_string(reason.call->multiplier) + " * geometry " +
           std::to_string(reason.geometry) + " + ray contribution " +
           std::to_string(reason.call->ray_contribution);
  }

  void reach(RecordKind kind, uint64_t index, const Reason& reason);
  const LinkedRecord* identify(RecordKind kind, Table& table, uint64_t index,
                               const std::string& where, const std::string& reason);
  bool inside(RecordKind kind, Table& table, uint64_t index, uint64_t bytes,
              const std::string& where, const std::string& reason);
  void enter(const LinkedShader* shader, const uint8_t* record, uint64_t bytes,
             const std::string& where, const std::string& reason);
  void follow(const LinkedShader& shader, const Arguments& arguments);
  void follow_ray(const LinkedShader& shader, const TraceCall& call, const Arguments& arguments);
  void reach_from(const runtime::ReachedFrom& from);
  void reach_hits(uint64_t scene, Reason reason);
  void check_permission(const TrackedInstance& instance, const TrackedStructure& level,
                        uint32_t ray_flags);

  const ProofInputs& inputs_;
  const runtime::DispatchRaysCommand& command_;
  const runtime::LinkedPipeline& linked_;
  ProofResults results_;
  bool micromaps_told_ = false;
  bool clusters_told_ = false;
  Table tables_[4];
  std::vector<std::pair<const LinkedShader*, Arguments>> pending_;
  std::set<std::pair<const LinkedShader*, const uint8_t*>> entered_;
  std::set<const LinkedShader*> other_root_signature_;
  std::set<uint64_t> structures_;  // already checked
  uint64_t told_ = 0;
};

bool Proof::inside(RecordKind kind, Table& table, uint64_t index, uint64_t bytes,
                   const std::string& where, const std::string& reason) {
  const auto& range = table.range;
  if (table.host == nullptr) {
    if (!table.layout_told) {
      report_missing(kind, Id::kRecordOutOfTable,
                     where + reason + ", but there is no such table: " +
                         (range.StartAddress == 0 || range.SizeInBytes == 0
                              ? "its StartAddress or SizeInBytes is 0"
                              : "it is " + range_name(inputs_.addresses, range.StartAddress,
                                                      range.SizeInBytes)) +
                         ". Set it in DispatchRaysDesc.");
    }
    table.layout_told = true;
    return false;
  }
  const uint64_t offset = index * range.StrideInBytes;
  if (kind == RecordKind::kRayGeneration || offset + bytes <= range.SizeInBytes) return true;
  const uint64_t count = range.SizeInBytes < 32 ? 0
                         : range.StrideInBytes == 0
                             ? 1
                             : (range.SizeInBytes - 32) / range.StrideInBytes + 1;
  report_missing(
      kind, Id::kRecordOutOfTable,
      where + reason + ": bytes " + std::to_string(offset) + ".." + std::to_string(offset + bytes) +
          " of a table of " + std::to_string(range.SizeInBytes) + " bytes (" +
          std::to_string(count) + (count == 1 ? " record" : " records") + " of stride " +
          std::to_string(range.StrideInBytes) + ", " +
          address_name(inputs_.addresses, range.StartAddress) +
          "). Add the missing records, or correct SizeInBytes, StrideInBytes or the terms of the "
          "index.");
  return false;
}

const LinkedRecord* Proof::identify(RecordKind kind, Table& table, uint64_t index,
                                    const std::string& where, const std::string& reason) {
  const uint8_t* bytes = table.host + index * table.range.StrideInBytes;
  if (runtime::is_null_identifier(bytes)) return nullptr;
  const LinkedRecord* record = linked_.identifiers.find(bytes);
  if (record == nullptr) {
    if (table.layout_told) return nullptr;
    if (const std::string name = inputs_.identifiers.find(bytes); !name.empty()) {
      report_missing(
          kind, Id::kRecordForeignIdentifier,
          where + " holds the identifier of " + in_quotes(name) +
              " from a state object other than the one that SetPipelineState1 set" + reason +
              ". Write the identifier that GetShaderIdentifier of this state object returns.");
      return nullptr;
    }
    table.layout_told = true;
    report_missing(
        kind, Id::kRecordUnknownIdentifier,
        where + " holds no shader identifier" + reason + ": bytes " +
            std::to_string(index * table.range.StrideInBytes) + ".. of the table, which is " +
            address_name(inputs_.addresses, table.range.StartAddress) + " with stride " +
            std::to_string(table.range.StrideInBytes) + ". " +
            advice_on_layout({table.host, table.range.SizeInBytes, table.range.StrideInBytes, index,
                              inputs_.addresses.bytes_from(table.range.StartAddress)},
                             linked_.identifiers, inputs_.identifiers));
    return nullptr;
  }
  if (record->kind != kind) {
    report_missing(kind, Id::kRecordWrongKind,
                   where + " holds " + in_quotes(record->name) + ", which is a " +
                       record_kind_name(record->kind) + " export" + reason +
                       ". Put it into the table of its kind.");
    return nullptr;
  }
  return record;
}

void Proof::reach(RecordKind kind, uint64_t index, const Reason& reason) {
  Table& table = tables_[static_cast<size_t>(kind)];
  if (table.host != nullptr && table.range.StrideInBytes == 0) index = 0;
  if (!table.seen.insert({index, reason.procedural}).second) return;
  const std::string where = name_of(table, kind, index);
  const std::string how = reason_text(kind, reason);
  if (!inside(kind, table, index, 32, where, how)) return;
  const LinkedRecord* record = identify(kind, table, index, where, how);
  if (record == nullptr) return;
  if (kind == RecordKind::kHitGroup) {
    const bool group_procedural =
        record->hit_group_type == rtapi::HitGroupType::kProceduralPrimitive;
    if (group_procedural != reason.procedural) {
      report(Id::kRecordWrongGroupType,
             where + " holds hit group " + in_quotes(record->name) + ", which is for " +
                 (group_procedural ? "procedural primitives" : "triangles") +
                 ", but is reached by " + (reason.procedural ? "boxes" : "triangles") + how +
                 ". AABBs need a hit group with an intersection shader, triangles one without.");
      return;
    }
  }
  const uint64_t needed = 32 + uint64_t{record->local_argument_bytes};
  const uint64_t stride = table.range.StrideInBytes;
  if (stride != 0 && stride < needed) {
    if (!table.layout_told) {
      table.layout_told = true;
      report(Id::kRecordStride,
             where + " holds " + in_quotes(record->name) + how +
                 ": its local root signature takes " +
                 std::to_string(record->local_argument_bytes) +
                 " bytes after the 32 of the "
                 "identifier, " +
                 std::to_string(needed) + " in all, but StrideInBytes is " +
                 std::to_string(stride) + ", so records overlap. Use a stride of at least " +
                 std::to_string((needed + 31) / 32 * 32) + ", and write the table with it.");
    }
    return;
  }
  const uint64_t offset = index * stride;
  const uint64_t available = table.range.SizeInBytes - std::min(offset, table.range.SizeInBytes);
  if (available < needed) {
    report(Id::kRecordTooShort,
           where + " holds " + in_quotes(record->name) + how + ", which needs " +
               std::to_string(needed) + " bytes, but the table ends after " +
               std::to_string(available) + ". Is SizeInBytes the size of all records?");
    return;
  }
  const uint8_t* bytes = table.host + offset;
  for (const LinkedShader* shader :
       {record->shader, record->any_hit, record->closest_hit, record->intersection}) {
    enter(shader, bytes, available, where, how);
  }
}

void Proof::enter(const LinkedShader* shader, const uint8_t* record, uint64_t bytes,
                  const std::string& where, const std::string& reason) {
  if (shader == nullptr || !entered_.insert({shader, record}).second) return;
  const auto& wanted = shader->global_root_signature;
  const auto& bound = command_.state.root_signature;
  if (wanted && !(bound && inputs_.same_definition(wanted, bound)) &&
      other_root_signature_.insert(shader).second) {
    report(Id::kRootSignatureReached,
           where + " runs " + shader_name(*shader) + reason +
               ", whose global root signature differs from the one that SetComputeRootSignature "
               "set. Set the shader's own, or associate it with the one that is set.");
    return;
  }
  Arguments arguments;
  arguments.global = command_.state.root_arguments->bytes.data();
  arguments.local = record + 32;
  arguments.local_bytes = bytes - 32;
  arguments.state = &command_.state;
  if (!check_arguments(inputs_, *shader, arguments, where + ", " + shader_name(*shader))) {
    results_.good = false;
  }
  collect_uses(*shader, arguments, shader_name(*shader), results_.uses);
  pending_.push_back({shader, arguments});
}

void Proof::follow(const LinkedShader& shader, const Arguments& arguments) {
  if (shader.code == nullptr || shader.library == nullptr) return;
  // A structure alone behind a binding counts as used; of an array, any element may be the one.
  for (uint32_t i = 0; i < shader.slots.size(); ++i) {
    const auto& binding = shader.library->bindings[i];
    if (binding.type != shader::BindingType::kAccelerationStructure || binding.count != 1) continue;
    for (const uint64_t address : structures_behind(shader, i, arguments)) {
      if (address == 0 || !structures_.insert(address).second) continue;
      if (!check_top_level(inputs_, address, shader_name(shader) + ", " + binding_name(binding))) {
        results_.good = false;
      }
    }
  }
  for (uint32_t i = 0; i < shader.code->trace_call_count; ++i) {
    follow_ray(shader, shader.code->trace_calls[i], arguments);
  }
  for (uint32_t i = 0; i < shader.code->callable_index_count; ++i) {
    const uint32_t index = shader.code->callable_indices[i];
    if (index == shader::kUnknownIndex) continue;
    Reason reason;
    reason.shader = &shader;
    reason.callable = index;
    reach(RecordKind::kCallable, index, reason);
  }
}

void Proof::follow_ray(const LinkedShader& shader, const TraceCall& call,
                       const Arguments& arguments) {
  Reason reason;
  reason.call = &call;
  reason.shader = &shader;
  if (call.known & shader::kKnowsMissIndex) reach(RecordKind::kMiss, call.miss_index, reason);
  constexpr uint32_t kAll = shader::kKnowsRayFlags | shader::kKnowsMask |
                            shader::kKnowsRayContribution | shader::kKnowsMultiplier;
  if ((call.known & kAll) != kAll) return;
  std::vector<uint64_t> scenes;
  for (uint32_t i = 0; i < shader.slots.size(); ++i) {
    const auto& binding = shader.library->bindings[i];
    const bool mine =
        call.binding == shader::kUnknownIndex ? binding.count == 1 : call.binding == i;
    if (!mine || binding.type != shader::BindingType::kAccelerationStructure) continue;
    for (const uint64_t address : structures_behind(shader, i, arguments)) {
      scenes.push_back(address);
    }
  }
  for (const uint64_t scene : scenes) reach_hits(scene, reason);
}

void Proof::check_permission(const TrackedInstance& instance, const TrackedStructure& level,
                             uint32_t ray_flags) {
  using Flags = rtapi::RaytracingPipelineFlags;
  const uint32_t flags = ray_flags | runtime::ray_flags_of(linked_.flags);
  if (meets_micromaps(instance, level, flags) && !micromaps_told_ &&
      !rtapi::HasAny(linked_.flags, Flags::kAllowOpacityMicromaps)) {
    micromaps_told_ = true;
    report(Id::kMicromapsNotAllowed,
           "rays reach " + linked_name(inputs_, instance, level) +
               ", which has opacity micromaps, but the pipeline does not have the flag "
               "kAllowOpacityMicromaps. They are ignored.");
  }
  if (meets_clusters(level, flags) && !clusters_told_ &&
      !rtapi::HasAny(linked_.flags, Flags::kAllowClusteredGeometry)) {
    clusters_told_ = true;
    report(Id::kClustersNotAllowed,
           "rays reach " + level_name(inputs_, instance) +
               ", which consists of clusters, but the pipeline does not have the flag "
               "kAllowClusteredGeometry. They are hit here, but need not be elsewhere.");
  }
}

// Follows a ray of `reason` to every hit record that it can reach in a top level.
void Proof::reach_hits(uint64_t scene, Reason reason) {
  const TraceCall& call = *reason.call;
  StructureState state;
  const TrackedStructure* top = inputs_.structures.find(scene, state);
  if (top == nullptr || state != StructureState::kAlive || !top->top) return;
  for (uint32_t i = 0; i < top->instances.size(); ++i) {
    const TrackedInstance& instance = top->instances[i];
    if ((instance.mask & call.mask) == 0 || instance.version == 0) continue;
    const TrackedStructure* level = inputs_.structures.find(instance.bottom_level, state);
    if (level == nullptr || level->version != instance.version || level->top) continue;
    reason.instance = i;
    reason.contribution = instance.contribution;
    check_permission(instance, *level, call.ray_flags);
    for (uint32_t g = 0; g < level->geometries.size(); ++g) {
      const runtime::GeometryShape& shape = level->geometries[g];
      if (!reaches(call, instance, shape, runtime::ray_flags_of(linked_.flags))) continue;
      reason.geometry = g;
      reason.procedural = shape.type == rtapi::RaytracingGeometryType::kProceduralPrimitiveAabbs;
      reach(RecordKind::kHitGroup,
            uint64_t{instance.contribution} + uint64_t{call.multiplier} * g + call.ray_contribution,
            reason);
    }
  }
}

void Proof::reach_from(const runtime::ReachedFrom& from) {
  const shader::ReachedCall& reached = from.call;
  Reason reason;
  reason.shader = from.shader;
  if (reached.by == shader::ReachedBy::kCallShader) {
    reason.callable = reached.indices;
    return reach(RecordKind::kCallable, reached.indices, reason);
  }
  const uint64_t scene = reached.acceleration_structure;
  if (reached.by != shader::ReachedBy::kTraceRay) {
    if (!check_inline_reached(inputs_, from)) results_.good = false;
    return;
  }
  if (scene != 0 && structures_.insert(scene).second &&
      !check_top_level(inputs_, scene, shader_name(*from.shader))) {
    results_.good = false;
  }
  const TraceCall call = call_of(from);
  reason.call = &call;
  reach(RecordKind::kMiss, call.miss_index, reason);
  reach_hits(scene, reason);
}

}  // namespace

ProofResults prove_tables(const ProofInputs& inputs, const runtime::DispatchRaysCommand& command) {
  return Proof(inputs, command).run();
}

ProofResults prove_reached(const ProofInputs& inputs, const runtime::DispatchRaysCommand& command,
                           std::span<const runtime::ReachedFrom> calls) {
  return Proof(inputs, command).run(calls);
}

}  // namespace kaamos::checks

// SPDX-License-Identifier: MIT
// The rules for declaring payload structs. [DXR: Payload access qualifiers, Syntax]
#include "runtime/hlsl/check/checker.h"
#include "runtime/hlsl/check/payload_access.h"

namespace kaamos::hlsl {
namespace {

constexpr const char* kNames[] = {"caller", "closesthit", "miss", "anyhit"};

// The stages that can run before, and those that can run after, a stage of this kind in a trace.
// Any-hit shaders run several times, and the caller gets its own values back if nothing runs.
uint8_t producers(uint8_t stage) {
  switch (stage) {
    case kPayloadCaller:
      return kPayloadCaller | kPayloadAnyHit | kPayloadClosestHit | kPayloadMiss;
    default:
      return kPayloadCaller | kPayloadAnyHit;
  }
}
uint8_t consumers(uint8_t stage) {
  switch (stage) {
    case kPayloadCaller:
    case kPayloadAnyHit:
      return kPayloadCaller | kPayloadAnyHit | kPayloadClosestHit | kPayloadMiss;
    default:
      return kPayloadCaller;
  }
}

void add_leaves(const StructInfo& structure, std::vector<uint32_t>& path,
                std::vector<PayloadLeaf>& out) {
  if (structure.base) {
    path.push_back(0);
    add_leaves(*structure.base, path, out);
    path.pop_back();
  }
  for (const FieldInfo& field : structure.fields) {
    path.push_back(field.index);
    if (field.type->is_struct() && field.type->structure->is_payload) {
      add_leaves(*field.type->structure, path, out);
    } else {
      out.push_back({path, &field, field.access, field.type->ir});
    }
    path.pop_back();
  }
}

}  // namespace

const char* payload_stage_name(uint8_t stage) {
  for (size_t i = 0; i < 4; ++i) {
    if (stage == kPayloadStages[i]) return kNames[i];
  }
  return "";
}

uint8_t payload_stage(std::string_view word) {
  for (size_t i = 0; i < 4; ++i) {
    if (word == kNames[i]) return kPayloadStages[i];
  }
  return 0;
}

uint8_t payload_stage_of(uint32_t stage) {
  switch (stage) {
    case ir::kStageClosestHit:
      return kPayloadClosestHit;
    case ir::kStageMiss:
      return kPayloadMiss;
    case ir::kStageAnyHit:
      return kPayloadAnyHit;
    default:
      return kPayloadCaller;
  }
}

std::vector<PayloadLeaf> payload_leaves(const StructInfo& structure) {
  std::vector<PayloadLeaf> out;
  std::vector<uint32_t> path;
  add_leaves(structure, path, out);
  return out;
}

bool all_access(const std::vector<PayloadLeaf>& leaves, uint8_t stage) {
  for (const PayloadLeaf& leaf : leaves) {
    if (!(leaf.access.read & leaf.access.write & stage)) return false;
  }
  return true;
}

bool Checker::has_raypayload(const StructInfo& structure) {
  if (!structure.decl) return false;
  for (const Attribute& attribute : structure.decl->attributes) {
    if (attribute.name == "raypayload") return true;
  }
  return false;
}

void Checker::check_payload_struct(StructInfo* info) {
  if (!options_->payload_qualifiers || !has_raypayload(*info)) return;
  info->is_payload = true;
  payload_structs_[info->ir] = info;
  if (info->base && !info->base->is_payload) {
    report(CheckId::kPayloadBase, info->decl->location, {info->base->name, info->name});
  }
  for (FieldInfo& field : info->fields) check_payload_field(field);
}

void Checker::check_payload_field(FieldInfo& field) {
  const std::string name(field.name);
  const auto written = field.decl->annotations.payload_access;
  if (field.type->is_struct() && field.type->structure->is_payload) {
    if (!written.empty()) report(CheckId::kPayloadNested, written[0].location, {name});
    return;
  }
  if (written.empty()) {
    report(CheckId::kPayloadFieldPlain, field.decl->location, {name});
    return;
  }
  bool found[2] = {};
  bool valid = true;
  for (const PayloadAccess& access : written) {
    const char* word = access.is_write ? "write" : "read";
    if (found[access.is_write]) {
      report(CheckId::kPayloadTwice, access.location, {name, word});
      valid = false;
      continue;
    }
    found[access.is_write] = true;
    for (const PayloadStage& stage : access.stages) {
      const uint8_t bit = payload_stage(stage.name);
      if (bit == 0) {
        report(CheckId::kPayloadStage, stage.location, {std::string(stage.name)});
        valid = false;
      }
      (access.is_write ? field.access.write : field.access.read) |= bit;
    }
  }
  if (!found[0] || !found[1]) {
    report(CheckId::kPayloadMissing, field.decl->location, {name, found[0] ? "write" : "read"});
    return;
  }
  if (!valid) return;
  for (const PayloadAccess& access : written) {
    for (const PayloadStage& stage : access.stages) {
      const uint8_t bit = payload_stage(stage.name);
      if (access.is_write && !(field.access.read & consumers(bit))) {
        report(CheckId::kPayloadConsumer, stage.location, {name, std::string(stage.name)});
      } else if (!access.is_write && !(field.access.write & producers(bit))) {
        report(CheckId::kPayloadProducer, stage.location, {name, std::string(stage.name)});
      }
    }
  }
}

// For a struct that a shader takes, or TraceRay passes, as its payload.
void Checker::check_payload_use(const Type* type, SourceLocation location) {
  const StructInfo& structure = *type->structure;
  if (!structure.decl) return;
  if (options_->payload_qualifiers) {
    if (!structure.is_payload && options_->target != "lib_6_x") {
      report(CheckId::kPayloadQualifiers, location, {to_string(type), options_->target});
    }
  } else if (has_raypayload(structure)) {
    report(CheckId::kPayloadIgnored, structure.decl->location, {to_string(type)});
  }
}

}  // namespace kaamos::hlsl

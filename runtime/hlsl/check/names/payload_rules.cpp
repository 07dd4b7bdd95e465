// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/payload_rules.h"

#include "runtime/hlsl/builder/payload_access.h"
#include "runtime/hlsl/check/names/name_parts.h"

namespace kaamos::hlsl {
namespace {

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

void add_leaves(const StructInfo& structure, std::vector<uint32_t>& path, PayloadLeaves& out) {
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
      out.push_back({path, field.name, field.access, field.type->ir});
    }
    path.pop_back();
  }
}

}  // namespace

PayloadLeaves payload_leaves(const StructInfo& structure) {
  PayloadLeaves out;
  std::vector<uint32_t> path;
  add_leaves(structure, path, out);
  return out;
}

bool PayloadRules::has_raypayload(const StructInfo& structure) {
  if (!structure.decl) return false;
  for (const Attribute& attribute : structure.decl->attributes) {
    if (attribute.name == "raypayload") return true;
  }
  return false;
}

void PayloadRules::check_payload_struct(StructInfo* info) {
  if (!program_.options->payload_qualifiers || !has_raypayload(*info)) return;
  info->is_payload = true;
  if (info->base && !info->base->is_payload) {
    report(CheckId::kPayloadBase, info->decl->location, {info->base->name, info->name});
  }
  for (FieldInfo& field : info->fields) check_payload_field(field);
  bench_.payloads.structs[info->ir] = payload_leaves(*info);
}

void PayloadRules::check_payload_field(FieldInfo& field) {
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
void PayloadRules::check_payload_use(const Type* type, SourceLocation location) {
  const StructInfo& structure = *type->structure;
  if (!structure.decl) return;
  if (program_.options->payload_qualifiers) {
    if (!structure.is_payload && program_.options->target != "lib_6_x") {
      const bool is_needed = shader_model_minor(program_.options->target) >= 9;
      report(is_needed ? CheckId::kPayloadUnqualified : CheckId::kPayloadQualifiers, location,
             {to_string(type), program_.options->target});
    }
  } else if (has_raypayload(structure)) {
    report(CheckId::kPayloadIgnored, structure.decl->location, {to_string(type)});
  }
}

}  // namespace kaamos::hlsl

// SPDX-License-Identifier: MIT
//
// Checks configs, root signatures and hit groups, whether the API or HLSL declares them.
#include "rtapi/src/device/device_level.h"
#include "rtapi/src/pipelines/root_signature_impl.h"
#include "rtapi/src/pipelines/state_object_gatherer.h"

namespace rtapi::detail {

const char* category_name(Category category) {
  static constexpr const char* kNames[] = {"shader config", "pipeline config",
                                           "global root signature", "local root signature"};
  return kNames[static_cast<size_t>(category)];
}

bool same_definition(const Definition& a, const Definition& b) {
  if (a.category != b.category) return false;
  switch (a.category) {
    case Category::kShaderConfig:
      return a.shader_config.MaxPayloadSizeInBytes == b.shader_config.MaxPayloadSizeInBytes &&
             a.shader_config.MaxAttributeSizeInBytes == b.shader_config.MaxAttributeSizeInBytes;
    case Category::kPipelineConfig:
      return a.pipeline_config.MaxTraceRecursionDepth == b.pipeline_config.MaxTraceRecursionDepth &&
             a.pipeline_config.Flags == b.pipeline_config.Flags;
    default:
      return same_definition(a.root_signature, b.root_signature);
  }
}

Status Gatherer::define_root_signature(const RootSignature& signature, bool local,
                                       const std::string& where, DefinitionPtr& out) {
  if (Status s = CheckHandle(parts_.device, signature, where + ": the root signature"); !s.ok()) {
    return s;
  }
  if (signature.is_local() != local) {
    return make_error(Id::kRootSignatureKind, where, " takes a ", local ? "local" : "global",
                      " root signature, but this one was created ", local ? "without" : "with",
                      " the flag kLocalRootSignature");
  }
  Definition d;
  d.category = local ? Category::kLocalRootSignature : Category::kGlobalRootSignature;
  d.root_signature = signature;
  d.where = where;
  out = std::make_shared<Definition>(std::move(d));
  return {};
}

Status Gatherer::define_shader_config(const RaytracingShaderConfig& config,
                                      const std::string& where, DefinitionPtr& out) {
  if (config.MaxAttributeSizeInBytes > kRaytracingMaxAttributeSizeInBytes) {
    return make_error(Id::kAttributeSizeLimit, where, ": MaxAttributeSizeInBytes is ",
                      config.MaxAttributeSizeInBytes, "; it must be 0 to 32");
  }
  Definition d;
  d.category = Category::kShaderConfig;
  d.shader_config = config;
  d.where = where;
  out = std::make_shared<Definition>(std::move(d));
  return {};
}

Status Gatherer::define_pipeline_config(const RaytracingPipelineConfig1& config, bool config1,
                                        const std::string& where, DefinitionPtr& out) {
  if (config.MaxTraceRecursionDepth > kRaytracingMaxDeclarableTraceRecursionDepth) {
    return make_error(Id::kRecursionDepth, where, ": MaxTraceRecursionDepth is ",
                      config.MaxTraceRecursionDepth, "; it must be 0 to 31");
  }
  if (config1 && parts_.device->desc.Tier < RaytracingTier::kTier1_1) {
    return make_error(Id::kPipelineConfig1Tier, where, " is a RaytracingPipelineConfig1, ",
                      but_tier(*parts_.device));
  }
  const auto skips =
      RaytracingPipelineFlags::kSkipTriangles | RaytracingPipelineFlags::kSkipProceduralPrimitives;
  const bool micromaps = parts_.device->desc.Tier >= RaytracingTier::kTier1_2;
  const bool clusters = parts_.device->desc.IndirectRtasOperations;
  auto known = micromaps ? skips | RaytracingPipelineFlags::kAllowOpacityMicromaps : skips;
  if (clusters) known = known | RaytracingPipelineFlags::kAllowClusteredGeometry;
  if ((config.Flags & ~known) != RaytracingPipelineFlags::kNone) {
    return make_error(Id::kConfigFlags, where, ": undefined pipeline flags ",
                      hex(static_cast<uint32_t>(config.Flags)), "; only 0x100",
                      micromaps ? ", 0x200 and 0x400" : " and 0x200", " are defined",
                      micromaps ? "" : ", and from tier 1.2 on 0x400",
                      clusters ? ", and 0x800" : ", and with IndirectRtasOperations 0x800");
  }
  if ((config.Flags & skips) == skips) {
    return make_error(Id::kConfigFlags, where,
                      ": kSkipTriangles and kSkipProceduralPrimitives cannot both be set");
  }
  Definition d;
  d.category = Category::kPipelineConfig;
  d.pipeline_config = config;
  d.where = where;
  out = std::make_shared<Definition>(std::move(d));
  return {};
}

Status Gatherer::add_hit_group(const HitGroupDesc& group, int scope, const std::string& where) {
  if (group.HitGroupExport.empty()) {
    return make_error(Id::kExportUnnamed, where, ": HitGroupExport is empty");
  }
  const std::string name = concat(where, ", hit group ", in_quotes(group.HitGroupExport));
  const bool has_intersection = !group.IntersectionShaderImport.empty();
  if (group.Type != HitGroupType::kTriangles && group.Type != HitGroupType::kProceduralPrimitive) {
    return make_error(Id::kHitGroupShape, name, ": type ", static_cast<uint32_t>(group.Type),
                      "; it must be kTriangles (0) or kProceduralPrimitive (1)");
  }
  if (group.Type == HitGroupType::kTriangles && has_intersection) {
    return make_error(Id::kHitGroupShape, name,
                      ": a triangle hit group cannot have an intersection shader, but this one "
                      "imports ",
                      in_quotes(group.IntersectionShaderImport));
  }
  if (group.Type == HitGroupType::kProceduralPrimitive && !has_intersection) {
    return make_error(Id::kHitGroupShape, name,
                      ": a procedural hit group needs an intersection shader");
  }
  auto subject = std::make_shared<Subject>();
  subject->name = group.HitGroupExport;
  subject->group = group;
  subject->library_scope = scope;
  parts_.subjects.push_back(std::move(subject));
  return {};
}
}  // namespace rtapi::detail

// SPDX-License-Identifier: MIT
#include "rtapi/src/device/device_level.h"

#include "rtapi/src/device/device_impl.h"
#include "rtapi/src/shaders/shader_library_impl.h"

namespace rtapi {

namespace {

struct TierRow {
  RaytracingTier tier;
  const char* name;
  ShaderModel needs;  // the shader model that came with the tier
};

constexpr TierRow kTiers[] = {{RaytracingTier::kNotSupported, "none", ShaderModel::k6_0},
                              {RaytracingTier::kTier1_0, "1.0", ShaderModel::k6_3},
                              {RaytracingTier::kTier1_1, "1.1", ShaderModel::k6_5},
                              {RaytracingTier::kTier1_2, "1.2", ShaderModel::k6_9},
                              {RaytracingTier::kTier2_0, "2.0", ShaderModel::k6_10}};

const TierRow* find_tier(RaytracingTier tier) {
  for (const TierRow& row : kTiers) {
    if (row.tier == tier) return &row;
  }
  return nullptr;
}

bool is_defined(ShaderModel model) {
  return model >= ShaderModel::k6_0 && model <= kExperimentalShaderModel;
}

// The model of "lib_6_6"; none for lib_6_x.
std::optional<ShaderModel> model_of_target(std::string_view target) {
  const size_t underscore = target.find('_');
  if (underscore == std::string_view::npos) return std::nullopt;
  std::string name(target.substr(underscore + 1));
  if (name.size() < 3) return std::nullopt;
  name[1] = '.';
  const auto model = ParseShaderModel(name);
  return model ? std::optional(*model) : std::nullopt;
}

}  // namespace

const char* GetName(RaytracingTier tier) {
  const TierRow* row = find_tier(tier);
  return row ? row->name : "unknown";
}

std::string GetName(ShaderModel model) {
  if (!is_defined(model)) return "unknown";
  return "6." + std::to_string(static_cast<uint32_t>(model) & 0xF);
}

Result<RaytracingTier> ParseRaytracingTier(std::string_view name) {
  std::string known;
  for (const TierRow& row : kTiers) {
    if (name == row.name) return row.tier;
    known += detail::concat(known.empty() ? "" : ", ", row.name);
  }
  return detail::make_error(detail::Id::kDeviceDesc, detail::in_quotes(name),
                            " is no ray tracing tier; the tiers are ", known);
}

Result<ShaderModel> ParseShaderModel(std::string_view name) {
  for (auto model = ShaderModel::k6_0; is_defined(model);
       model = static_cast<ShaderModel>(static_cast<uint32_t>(model) + 1)) {
    if (name == GetName(model)) return model;
  }
  return detail::make_error(detail::Id::kDeviceDesc, detail::in_quotes(name),
                            " is no shader model; they are 6.0 to ",
                            GetName(kExperimentalShaderModel));
}

namespace detail {

Status check_device_level(const DeviceDesc& desc) {
  const TierRow* row = find_tier(desc.Tier);
  if (!row) {
    return make_error(Id::kDeviceDesc, "Tier is ", static_cast<uint32_t>(desc.Tier),
                      "; it must be a value of RaytracingTier");
  }
  if (desc.Tier > kHighestRaytracingTier) {
    return make_error(Id::kDeviceDesc, "Tier is ", row->name, "; the highest that is offered is ",
                      GetName(kHighestRaytracingTier));
  }
  if (!is_defined(desc.ShaderModel)) {
    return make_error(Id::kDeviceDesc, "ShaderModel is ",
                      hex(static_cast<uint32_t>(desc.ShaderModel)), "; it must be 0x60 to ",
                      hex(static_cast<uint32_t>(kExperimentalShaderModel)), " (",
                      GetName(kExperimentalShaderModel), ")");
  }
  if (desc.ShaderModel < row->needs) {
    return make_error(Id::kDeviceDesc, "Tier ", row->name, " needs ShaderModel ",
                      GetName(row->needs), " or higher, but it is ", GetName(desc.ShaderModel));
  }
  if (desc.IndirectRtasOperations &&
      (desc.Tier < RaytracingTier::kTier1_1 || desc.ShaderModel < ShaderModel::k6_10)) {
    return make_error(
        Id::kDeviceDesc,
        "IndirectRtasOperations needs tier 1.1 and ShaderModel 6.10 or higher, but they "
        "are ",
        row->name, " and ", GetName(desc.ShaderModel));
  }
  return {};
}

std::string but_tier(const DeviceImpl& device) {
  return concat("but this device was created with tier ", GetName(device.desc.Tier));
}

Status check_has_raytracing(const DeviceImpl& device, std::string_view what) {
  if (device.desc.Tier != RaytracingTier::kNotSupported) return {};
  return make_error(Id::kNoRaytracing, what, " needs ray tracing, ", but_tier(device));
}

Status check_shader_model(const DeviceImpl& device, const ShaderLibrary& library) {
  const std::string& target = library.impl()->target;
  const auto model = model_of_target(target);
  if (!model || *model <= device.desc.ShaderModel) return {};
  return make_error(Id::kLibraryShaderModel, in_quotes(library.name()), " was compiled for ",
                    target, ", but this device was created with shader model ",
                    GetName(device.desc.ShaderModel));
}

Status check_shader_tier(const DeviceImpl& device, const shader::ExportDesc& code,
                         const std::string& where) {
  if (device.desc.Tier >= RaytracingTier::kTier1_1) return {};
  if ((code.flags & shader::kExportUsesRayQuery) != 0) {
    return make_error(Id::kShaderTier, where, " uses RayQuery, ", but_tier(device));
  }
  constexpr uint32_t kSkipFlags = 0x300;
  for (uint32_t i = 0; i < code.trace_call_count; ++i) {
    const shader::TraceCall& call = code.trace_calls[i];
    if ((call.known & shader::kKnowsRayFlags) == 0 || (call.ray_flags & kSkipFlags) == 0) continue;
    return make_error(Id::kShaderTier, where, " calls TraceRay with ray flags ",
                      hex(call.ray_flags), " (", call.file ? call.file : "", ":", call.line,
                      "); RAY_FLAG_SKIP_TRIANGLES and RAY_FLAG_SKIP_PROCEDURAL_PRIMITIVES "
                      "need tier 1.1, ",
                      but_tier(device));
  }
  return {};
}

}  // namespace detail

}  // namespace rtapi

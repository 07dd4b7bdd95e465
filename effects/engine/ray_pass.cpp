// SPDX-License-Identifier: MIT
#include "effects/engine/ray_pass.h"

#include <algorithm>

namespace kaamos::effects {

using namespace rtapi;

namespace {

// Name of the hit group of a ray type, for opaque or alpha-tested geometry.
std::string group_name(std::uint32_t ray_type, bool alpha_tested) {
  return std::string(ray_type == kRayTypeSurface ? "Surface" : "Visibility") +
         (alpha_tested ? "AlphaTested" : "Opaque");
}

bool has_alpha_tested(const GpuScene& scene) {
  return std::any_of(scene.geometries.begin(), scene.geometries.end(),
                     [](const GpuGeometry& geometry) { return geometry.alpha_tested; });
}

// A scene without alpha-tested geometry needs neither any-hit shaders nor hit groups that have one.
rtapi::Result<StateObject> create_pipeline(const Device& device, const Frame& frame,
                                           const GpuScene& scene, const RayPassDesc& desc) {
  const bool any_hit = has_alpha_tested(scene);
  StateObjectDesc state;
  // List the exports, because the library also exports helper functions.
  DxilLibraryDesc library;
  library.DXILLibrary = desc.library;
  library.Exports.push_back({desc.ray_generation});
  std::vector<std::string> groups;
  for (std::uint32_t type = 0; type < kRayTypeCount; ++type) {
    const HitShaders& hit = desc.hit[type];
    for (const std::string& shader :
         {desc.miss[type], any_hit ? hit.any_hit : std::string(), hit.closest_hit}) {
      if (!shader.empty()) library.Exports.push_back({shader});
    }
    for (const bool alpha_tested : {false, true}) {
      if (alpha_tested && !any_hit) continue;
      HitGroupDesc group;
      group.HitGroupExport = group_name(type, alpha_tested);
      group.ClosestHitShaderImport = hit.closest_hit;
      if (alpha_tested) group.AnyHitShaderImport = hit.any_hit;
      state.Add(group);
      groups.push_back(group.HitGroupExport);
    }
  }
  state.Add(library);
  state.Add(RaytracingShaderConfig{desc.payload_bytes, 8});
  if (scene.micromaps) {
    state.Add(RaytracingPipelineConfig1{desc.max_recursion_depth,
                                        RaytracingPipelineFlags::kAllowOpacityMicromaps});
  } else {
    state.Add(RaytracingPipelineConfig{desc.max_recursion_depth});
  }
  state.Add(GlobalRootSignature{frame.root_signature()});
  state.Associate(state.Add(LocalRootSignature{frame.local_root_signature()}), groups);
  return device.CreateStateObject(state);
}

// Every geometry has a record for either ray type, 0 and 1. The deck's slide of the table names the
// last column, geometry 1 and ray type 2, twice. [effects/SOURCES.md: E8]
rtapi::Status add_hit_records(ShaderTable& table, const GpuScene& scene) {
  for (const GpuGeometry& geometry : scene.geometries) {
    for (std::uint32_t type = 0; type < kRayTypeCount; ++type) {
      const auto added = table.AddRecord(
          group_name(type, geometry.alpha_tested),
          {LocalArgument::Address(geometry.vertices), LocalArgument::Address(geometry.indices),
           LocalArgument::Constants(geometry.constants)});
      if (!added) return added.error();
    }
  }
  return {};
}

}  // namespace

RayPassDesc key_pass(const RayPassDesc& desc) {
  RayPassDesc keys;
  keys.name = desc.name + " keys";
  keys.library = desc.library;
  keys.ray_generation = desc.key_generation;
  return keys;
}

rtapi::Result<RayPass> RayPass::create(const Device& device, const Frame& frame,
                                       const GpuScene& scene, const RayPassDesc& desc) {
  const auto pipeline = create_pipeline(device, frame, scene, desc);
  if (!pipeline) return pipeline.error();
  RayPass pass;
  pass.pipeline_ = *pipeline;
  ShaderTable ray_generation(*pipeline, desc.name + " ray generation");
  ShaderTable miss(*pipeline, desc.name + " miss");
  ShaderTable hit(*pipeline, desc.name + " hit groups");
  if (const auto added = ray_generation.AddRecord(desc.ray_generation); !added) {
    return added.error();
  }
  for (const std::string& name : desc.miss) {
    if (name.empty()) {
      miss.AddNullRecord();
    } else if (const auto added = miss.AddRecord(name); !added) {
      return added.error();
    }
  }
  if (const auto added = add_hit_records(hit, scene); !added) return added.error();
  for (ShaderTable* table : {&ray_generation, &miss, &hit}) {
    if (const auto built = table->Build(device); !built) return built.error();
  }
  pass.dispatch_.RayGenerationShaderRecord = ray_generation.GetRecord(0);
  pass.dispatch_.MissShaderTable = miss.GetTable();
  pass.dispatch_.HitGroupTable = hit.GetTable();
  pass.tables_[0] = ray_generation.buffer();
  pass.tables_[1] = miss.buffer();
  pass.tables_[2] = hit.buffer();
  return pass;
}

void RayPass::dispatch(CommandList& list, const Frame& frame, const PassConstants& constants,
                       std::uint32_t row_count, const PassArguments& arguments) const {
  const std::uint32_t columns = traced_columns(constants, frame.width());
  // A picture of one column has no second pixel in its blocks.
  if (columns == 0 || row_count == 0) return;
  dispatch_grid(list, frame, constants, columns, row_count, arguments);
}

void RayPass::dispatch_grid(CommandList& list, const Frame& frame, const PassConstants& constants,
                            std::uint32_t width, std::uint32_t height,
                            const PassArguments& arguments) const {
  frame.bind(list, constants, arguments);
  list.SetPipelineState1(pipeline_);
  DispatchRaysDesc desc = dispatch_;
  desc.Width = width;
  desc.Height = height;
  list.DispatchRays(desc);
  list.ResourceBarrier(ResourceBarrier::Uav());
}

}  // namespace kaamos::effects

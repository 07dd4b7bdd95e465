// SPDX-License-Identifier: MIT
#include "effects/geometry/structures/structures.h"

#include <rtapi/upload.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <string>

namespace kaamos::effects {

using namespace rtapi;

namespace {

using Clock = std::chrono::steady_clock;
using Flags = RaytracingAccelerationStructureBuildFlags;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

Flags build_flags(BuildClass build_class) {
  switch (build_class) {
    case BuildClass::kStatic:
      return Flags::kPreferFastTrace;
    case BuildClass::kDeformable:
      return Flags::kPreferFastBuild | Flags::kAllowUpdate;
    case BuildClass::kHero:
      return Flags::kPreferFastTrace | Flags::kAllowUpdate;
    case BuildClass::kEveryFrame:
      return Flags::kPreferFastBuild;
  }
  return Flags::kNone;
}

bool any_alpha_tested(const Mesh& mesh) {
  return std::any_of(mesh.geometries.begin(), mesh.geometries.end(),
                     [](const Geometry& g) { return g.alpha_tested; });
}

bool is_deformed(const Instance& instance) {
  return instance.motion.skin != kNoIndex || instance.motion.morph != kNoIndex;
}

std::size_t first_record(const Scene& scene, std::uint32_t mesh) {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < mesh; ++i) count += scene.meshes[i].geometries.size();
  return count;
}

}  // namespace

rtapi::Result<StructureManager> StructureManager::create(const Device& device, CommandQueue& queue,
                                                         const Scene& scene,
                                                         const StructureOptions& options) {
  const auto start = Clock::now();
  StructureManager manager;
  manager.options_ = options;
  auto uploaded = upload_scene(device, queue, scene, options.opacity_micromaps);
  if (!uploaded) return uploaded.error();
  manager.gpu_ = std::move(*uploaded);
  manager.instances_ = scene.instances;
  if (const auto s = manager.build_static(device, queue, scene); !s) return s.error();
  if (const auto s = manager.add_instances(device, scene); !s) return s.error();
  if (const auto s = manager.create_top_level(device); !s) return s.error();
  manager.statistics_.create_ms = milliseconds_since(start);
  manager.gpu_.statistics.bottom_level_ms = manager.statistics_.create_ms;
  manager.gpu_.statistics.bottom_level_bytes =
      manager.statistics_.static_bytes + manager.statistics_.skinned_bytes;
  manager.gpu_.statistics.top_level_bytes = manager.statistics_.top_level_bytes;
  return manager;
}

// All builds are in one list with one barrier at its end; scratch memory of their own lets them
// overlap.
rtapi::Status StructureManager::build_static(const Device& device, CommandQueue& queue,
                                             const Scene& scene) {
  std::vector<bool> wanted(scene.meshes.size(), false);
  for (const Instance& instance : scene.instances) {
    if (!is_deformed(instance)) wanted[instance.mesh] = true;
    for (const Level& level : instance.levels) wanted[level.mesh] = true;
  }
  gpu_.bottom_levels.resize(scene.meshes.size());
  BufferDesc sizes_desc;
  sizes_desc.SizeInBytes = std::max<std::size_t>(scene.meshes.size(), 1) * sizeof(std::uint64_t);
  sizes_desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  sizes_desc.InitialState = ResourceStates::kUnorderedAccess;
  sizes_desc.Name = "compacted sizes";
  const auto sizes = device.CreateBuffer(sizes_desc);
  if (!sizes) return sizes.error();
  auto list = device.CreateCommandList();
  if (!list) return list.error();
  std::vector<std::uint32_t> built;
  std::vector<Buffer> scratches;
  Flags flags = build_flags(BuildClass::kStatic);
  if (options_.compact) flags = flags | Flags::kAllowCompaction;
  for (std::uint32_t id = 0; id < scene.meshes.size(); ++id) {
    if (!wanted[id]) continue;
    const Mesh& mesh = scene.meshes[id];
    std::size_t record = first_record(scene, id);
    BottomLevelInputs geometries;
    for (const Geometry& geometry : mesh.geometries) {
      geometries.add(geometry, gpu_.geometries[record++]);
    }
    BuildRaytracingAccelerationStructureDesc desc;
    desc.Inputs = geometries.desc(flags);
    const auto info = device.GetRaytracingAccelerationStructurePrebuildInfo(desc.Inputs);
    if (!info) return info.error();
    auto result = create_structure_buffer(device, info->ResultDataMaxSizeInBytes,
                                          mesh.name + " bottom level");
    if (!result) return result.error();
    auto scratch =
        create_scratch_buffer(device, info->ScratchDataSizeInBytes, mesh.name + " scratch");
    if (!scratch) return scratch.error();
    desc.DestAccelerationStructureData = result->GetGPUVirtualAddress();
    desc.ScratchAccelerationStructureData = scratch->GetGPUVirtualAddress();
    RaytracingAccelerationStructurePostbuildInfoDesc size;
    size.DestBuffer = sizes->GetGPUVirtualAddress() + built.size() * sizeof(std::uint64_t);
    list->BuildRaytracingAccelerationStructure(
        desc, options_.compact ? std::span(&size, 1)
                               : std::span<RaytracingAccelerationStructurePostbuildInfoDesc>());
    statistics_.static_bytes_before_compaction += info->ResultDataMaxSizeInBytes;
    gpu_.bottom_levels[id] = *result;
    scratches.push_back(*scratch);
    built.push_back(id);
  }
  list->ResourceBarrier(ResourceBarrier::Uav());
  if (const rtapi::Status done = queue.ExecuteAndWait(*list); !done) return done;
  statistics_.static_structures = static_cast<std::uint32_t>(built.size());
  statistics_.static_bytes = statistics_.static_bytes_before_compaction;
  return options_.compact && !built.empty() ? compact(device, queue, *sizes, built)
                                            : rtapi::Status();
}

rtapi::Status StructureManager::compact(const Device& device, CommandQueue& queue,
                                        const Buffer& sizes,
                                        const std::vector<std::uint32_t>& built) {
  const auto bytes = ReadbackBuffer(device, queue, sizes);
  if (!bytes) return bytes.error();
  auto list = device.CreateCommandList();
  if (!list) return list.error();
  std::vector<Buffer> compacted;
  statistics_.static_bytes = 0;
  for (std::size_t i = 0; i < built.size(); ++i) {
    std::uint64_t size = 0;
    std::memcpy(&size, bytes->data() + i * sizeof size, sizeof size);
    const Buffer& from = gpu_.bottom_levels[built[i]];
    auto to = create_structure_buffer(device, size, from.name());
    if (!to) return to.error();
    list->CopyRaytracingAccelerationStructure(to->GetGPUVirtualAddress(),
                                              from.GetGPUVirtualAddress(),
                                              RaytracingAccelerationStructureCopyMode::kCompact);
    compacted.push_back(*to);
    statistics_.static_bytes += size;
  }
  list->ResourceBarrier(ResourceBarrier::Uav());
  if (const rtapi::Status done = queue.ExecuteAndWait(*list); !done) return done;
  for (std::size_t i = 0; i < built.size(); ++i) gpu_.bottom_levels[built[i]] = compacted[i];
  return {};
}

rtapi::Status StructureManager::add_instances(const Device& device, const Scene& scene) {
  bind_skins_.resize(scene.meshes.size());
  morphs_.resize(scene.meshes.size());
  for (std::uint32_t id = 0; id < scene.meshes.size(); ++id) {
    meshes_.push_back({first_record(scene, id), !any_alpha_tested(scene.meshes[id])});
  }
  for (const Instance& instance : scene.instances) {
    Placement placement;
    placement.transform = instance.transform;
    if (is_deformed(instance)) {
      const auto body = add_body(device, scene, instance);
      if (!body) return body.error();
      placement.body = *body;
    }
    placements_.push_back(placement);
  }
  return {};
}

// Returns the body of that pose, and creates it if there is none yet.
rtapi::Result<std::int32_t> StructureManager::add_body(const Device& device, const Scene& scene,
                                                       const Instance& instance) {
  Body body;
  body.mesh = instance.mesh;
  body.motion = instance.motion;
  body.motion.node = kNoIndex;  // moves the instance, not its shape
  if (instance.build_class != BuildClass::kStatic) body.build_class = instance.build_class;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& other = bodies_[i];
    if (other.mesh == body.mesh && other.motion == body.motion &&
        other.build_class == body.build_class) {
      return static_cast<std::int32_t>(i);
    }
    body.rank += other.build_class == body.build_class ? 1 : 0;
  }
  if (!skinning_) {
    const auto pass = SkinningPass::create(device);
    if (!pass) return pass.error();
    skinning_ = *pass;
  }
  const Mesh& mesh = scene.meshes[body.mesh];
  if (!bind_skins_[body.mesh]) {
    // What only morphs hangs on one joint that stands still.
    auto skin = CreateUploadBuffer(
        device, mesh.skin.empty() ? std::vector<SkinVertex>(mesh.vertices.size()) : mesh.skin,
        mesh.name + " joints and weights");
    if (!skin) return skin.error();
    bind_skins_[body.mesh] = *skin;
  }
  if (body.motion.skin != kNoIndex) {
    const Skin& skin = scene.skins[static_cast<std::size_t>(body.motion.skin)];
    body.joint_count = static_cast<std::uint32_t>(skin.joints.size());
  }
  const bool morphs = body.motion.morph != kNoIndex;
  if (morphs && !morphs_[body.mesh]) {
    auto moves = CreateUploadBuffer(device, mesh.morph, mesh.name + " morph targets");
    if (!moves) return moves.error();
    morphs_[body.mesh] = *moves;
  }
  auto skinned =
      SkinningPass::create_mesh(device, mesh, gpu_.vertices[body.mesh].GetGPUVirtualAddress(),
                                bind_skins_[body.mesh].GetGPUVirtualAddress(), body.joint_count,
                                morphs ? morphs_[body.mesh].GetGPUVirtualAddress() : 0);
  if (!skinned) return skinned.error();
  body.skinned = *skinned;
  // A body has records of its own: the same indices and materials, but other vertices.
  body.first_record = gpu_.geometries.size();
  const std::size_t bind_record = first_record(scene, body.mesh);
  for (std::size_t i = 0; i < mesh.geometries.size(); ++i) {
    GpuGeometry gpu = gpu_.geometries[bind_record + i];
    gpu.constants.vertex_stride = SkinningPass::stride(mesh);
    if (mesh.has_more()) gpu.constants.color_offset = kSkinnedColorOffset;
    gpu.vertices = body.skinned.vertices.GetGPUVirtualAddress() +
                   std::uint64_t{mesh.geometries[i].first_vertex} * gpu.constants.vertex_stride;
    gpu.vertex_buffer = body.skinned.vertices;
    body.geometries.add(mesh.geometries[i], gpu);
    gpu_.geometries.push_back(gpu);
  }
  const auto info = device.GetRaytracingAccelerationStructurePrebuildInfo(inputs(body));
  if (!info) return info.error();
  auto structure = create_structure_buffer(device, info->ResultDataMaxSizeInBytes,
                                           mesh.name + " skinned bottom level");
  if (!structure) return structure.error();
  body.structure = *structure;
  auto scratch = create_scratch_buffer(
      device, std::max(info->ScratchDataSizeInBytes, info->UpdateScratchDataSizeInBytes),
      mesh.name + " skinned scratch");
  if (!scratch) return scratch.error();
  body.scratch = *scratch;
  statistics_.skinned_bytes += body.structure.size();
  statistics_.scratch_bytes += body.scratch.size();
  statistics_.vertex_bytes += body.skinned.vertices.size();
  ++statistics_.skinned_structures;
  bodies_.push_back(std::move(body));
  return static_cast<std::int32_t>(bodies_.size() - 1);
}

rtapi::Status StructureManager::create_top_level(const Device& device) {
  const std::vector<RaytracingInstanceDesc> none(std::max<std::size_t>(placements_.size(), 1));
  auto instances = CreateUploadBuffer(device, none, "instances");
  if (!instances) return instances.error();
  gpu_.instances = *instances;
  if (options_.coarser_rays > 0) {
    auto drawn = CreateUploadBuffer(device, none, "drawn instances");
    if (!drawn) return drawn.error();
    gpu_.drawn_instances = *drawn;
  }
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Flags = Flags::kPreferFastTrace;
  inputs.NumDescs = static_cast<std::uint32_t>(placements_.size());
  inputs.InstanceDescs = gpu_.instances.GetGPUVirtualAddress();
  const auto info = device.GetRaytracingAccelerationStructurePrebuildInfo(inputs);
  if (!info) return info.error();
  auto top_level = create_structure_buffer(device, info->ResultDataMaxSizeInBytes, "top level");
  if (!top_level) return top_level.error();
  gpu_.top_level = *top_level;
  auto scratch = create_scratch_buffer(device, info->ScratchDataSizeInBytes, "top level scratch");
  if (!scratch) return scratch.error();
  top_scratch_ = *scratch;
  statistics_.top_level_bytes = gpu_.top_level.size();
  statistics_.scratch_bytes += top_scratch_.size();
  return {};
}

BuildRaytracingAccelerationStructureInputs StructureManager::inputs(const Body& body) const {
  return body.geometries.desc(build_flags(body.build_class));
}

Buffer StructureManager::skinned_vertices(std::uint32_t instance) const {
  const std::int32_t body = placements_[instance].body;
  return body == kNoIndex ? Buffer() : bodies_[static_cast<std::size_t>(body)].skinned.vertices;
}

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
#include "effects/engine/gpu_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <span>

#include "effects/engine/bottom_level_inputs.h"

namespace kaamos::effects {

using namespace rtapi;

rtapi::Result<Buffer> create_structure_buffer(const Device& device, std::uint64_t bytes,
                                              std::string name) {
  BufferDesc desc;
  desc.SizeInBytes = bytes;
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.InitialState = ResourceStates::kRaytracingAccelerationStructure;
  desc.Name = std::move(name);
  return device.CreateBuffer(desc);
}

rtapi::Result<Buffer> create_scratch_buffer(const Device& device, std::uint64_t bytes,
                                            std::string name) {
  BufferDesc desc;
  desc.SizeInBytes = std::max<std::uint64_t>(bytes, 1);
  desc.Flags = ResourceFlags::kAllowUnorderedAccess;
  desc.Name = std::move(name);
  return device.CreateBuffer(desc);
}

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Builds and waits; adds the size of the result to `bytes`.
rtapi::Result<Buffer> build(const Device& device, CommandQueue& queue,
                            const BuildRaytracingAccelerationStructureInputs& inputs,
                            std::string name, std::uint64_t& bytes) {
  auto result = rtapi::BuildAccelerationStructure(device, queue, inputs, std::move(name));
  if (result) bytes += result->size();
  return result;
}

// Returns, by mesh, whether it has glass in some instance.
std::vector<bool> glass_meshes(const Scene& scene) {
  std::vector<bool> glass(scene.meshes.size());
  for (const Instance& instance : scene.instances) {
    if (instance.mask & kMaskTransparent) glass[instance.mesh] = true;
  }
  return glass;
}

// The vertices of a mesh as they lie in memory: with more only where it has more.
rtapi::Result<Buffer> upload_vertices(const Device& device, const Mesh& mesh) {
  const std::string name = mesh.name + " vertices";
  if (!mesh.has_more())
    return CreateUploadBuffer(device, std::as_bytes(std::span(mesh.vertices)), name);
  std::vector<std::byte> bytes(mesh.vertices.size() * kColoredVertexStride);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    std::byte* to = bytes.data() + i * kColoredVertexStride;
    std::memcpy(to, &mesh.vertices[i], sizeof(Vertex));
    const Mesh::More more = mesh.more(i);
    static_assert(sizeof more == kColoredVertexStride - sizeof(Vertex));
    std::memcpy(to + sizeof(Vertex), &more, sizeof more);
  }
  return CreateUploadBuffer(device, std::span<const std::byte>(bytes), name);
}

// Creates the buffers of one mesh and the record arguments of its geometries.
rtapi::Status add_mesh(const Device& device, const Scene& scene, std::uint32_t mesh_id, bool glass,
                       GpuScene& out) {
  const Mesh& mesh = scene.meshes[mesh_id];
  auto vertices = upload_vertices(device, mesh);
  if (!vertices) return vertices.error();
  auto indices =
      CreateUploadBuffer(device, std::as_bytes(std::span(mesh.indices)), mesh.name + " indices");
  if (!indices) return indices.error();
  for (std::uint32_t i = 0; i < mesh.geometries.size(); ++i) {
    const Geometry& geometry = mesh.geometries[i];
    GpuGeometry gpu;
    if (mesh.has_more()) {
      gpu.constants.vertex_stride = kColoredVertexStride;
      gpu.constants.color_offset = sizeof(Vertex);
    }
    gpu.vertices = vertices->GetGPUVirtualAddress() +
                   std::uint64_t{geometry.first_vertex} * gpu.constants.vertex_stride;
    gpu.indices = indices->GetGPUVirtualAddress() + geometry.index_offset_bytes;
    gpu.vertex_buffer = *vertices;
    gpu.index_buffer = *indices;
    gpu.mesh = mesh_id;
    gpu.vertex_count = geometry.vertex_count;
    gpu.index_count = geometry.index_count;
    gpu.constants.index_size_bytes = geometry.index_size_bytes;
    gpu.constants.material_id = geometry.material;
    gpu.constants.geometry_id = i;
    gpu.alpha_tested = geometry.alpha_tested || glass;
    gpu.glass = glass;
    out.geometries.push_back(gpu);
  }
  out.vertices.push_back(*vertices);
  out.indices.push_back(*indices);
  return {};
}

// `first_record` is the index of the mesh's first geometry in out.geometries, and is advanced to
// the next mesh.
rtapi::Status add_bottom_level(const Device& device, CommandQueue& queue, const Mesh& mesh,
                               std::size_t& first_record, GpuScene& out) {
  BottomLevelInputs inputs;
  for (const Geometry& geometry : mesh.geometries) {
    inputs.add(geometry, out.geometries[first_record++]);
  }
  auto bottom_level =
      build(device, queue, inputs.desc(RaytracingAccelerationStructureBuildFlags::kPreferFastTrace),
            mesh.name + " bottom level", out.statistics.bottom_level_bytes);
  if (!bottom_level) return bottom_level.error();
  out.bottom_levels.push_back(*bottom_level);
  return {};
}

std::vector<RaytracingInstanceDesc> instance_descs(const Scene& scene, const GpuScene& gpu,
                                                   const glm::dvec3& origin) {
  std::vector<std::uint32_t> first_geometry(scene.meshes.size());
  std::vector<bool> opaque(scene.meshes.size(), true);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    first_geometry[i] = count;
    count += static_cast<std::uint32_t>(scene.meshes[i].geometries.size());
    for (const Geometry& geometry : scene.meshes[i].geometries) {
      opaque[i] = opaque[i] && !geometry.alpha_tested;
    }
  }
  std::vector<RaytracingInstanceDesc> descs;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    RaytracingInstanceDesc desc;
    const glm::mat3x4 rows = transform_3x4(instance, origin);
    std::memcpy(desc.Transform, &rows, sizeof desc.Transform);
    desc.InstanceID = i & 0xFFFFFFu;
    desc.InstanceMask = instance_mask(instance);
    desc.InstanceContributionToHitGroupIndex =
        (first_geometry[instance.mesh] * kRayTypeCount) & 0xFFFFFFu;
    // The traversal of opaque instances never looks for an any-hit shader. [Northlight deck:
    // FORCE_OPAQUE]
    desc.Flags = opaque[instance.mesh] && !(instance.mask & kMaskTransparent)
                     ? static_cast<std::uint32_t>(RaytracingInstanceFlags::kForceOpaque)
                     : 0u;
    desc.AccelerationStructure = gpu.bottom_levels[instance.mesh].GetGPUVirtualAddress();
    descs.push_back(desc);
  }
  return descs;
}

rtapi::Status add_top_level(const Device& device, CommandQueue& queue, const Scene& scene,
                            const glm::dvec3& origin, GpuScene& out) {
  const std::vector<RaytracingInstanceDesc> descs = instance_descs(scene, out, origin);
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kTopLevel;
  inputs.Flags = RaytracingAccelerationStructureBuildFlags::kPreferFastTrace;
  inputs.NumDescs = static_cast<std::uint32_t>(descs.size());
  if (!descs.empty()) {
    auto instances = CreateUploadBuffer(device, descs, "instances");
    if (!instances) return instances.error();
    out.instances = *instances;
    inputs.InstanceDescs = out.instances.GetGPUVirtualAddress();
  }
  auto top_level = build(device, queue, inputs, "top level", out.statistics.top_level_bytes);
  if (!top_level) return top_level.error();
  out.top_level = *top_level;
  return {};
}

rtapi::Status add_textures(const Device& device, CommandQueue& queue, const Scene& scene,
                           GpuScene& out) {
  for (const TextureImage& image : scene.images) {
    TextureDesc desc;
    desc.Width = image.width;
    desc.Height = image.height;
    desc.MipLevels = static_cast<std::uint16_t>(image.mips.size());
    desc.Format = image.srgb ? Format::kR8G8B8A8UnormSrgb : Format::kR8G8B8A8Unorm;
    desc.Name = image.name;
    auto texture = device.CreateTexture(desc);
    if (!texture) return texture.error();
    for (std::uint32_t mip = 0; mip < image.mips.size(); ++mip) {
      const rtapi::Status uploaded =
          UploadTexture(device, queue, *texture, mip, std::as_bytes(std::span(image.mips[mip])));
      if (!uploaded) return uploaded;
    }
    out.textures.push_back(*texture);
  }
  return {};
}

// What is unlit emits its base colour: as bright as a surface that the exposure shows with that
// colour, and it reflects nothing. [KHR_materials_unlit]
void make_unlit(const Scene& scene, MaterialConstants& m) {
  const float white = scene.exposure > 0.0f ? 1.0f / scene.exposure : 1.0f;
  m.emissive = glm::vec3(m.base_color) * white;
  m.base_color = glm::vec4(0.0f, 0.0f, 0.0f, m.base_color.a);
  m.metallic = m.roughness = 1.0f;
  m.image[kMetallicRoughnessTexture] = m.image[kNormalTexture] = kNoTexture;
  m.image[kEmissiveTexture] = m.image[kBaseColorTexture];
  m.sampler[kEmissiveTexture] = m.sampler[kBaseColorTexture];
  m.uv_matrix[kEmissiveTexture] = m.uv_matrix[kBaseColorTexture];
  m.uv_offset[kEmissiveTexture] = m.uv_offset[kBaseColorTexture];
  m.second_uv =
      (m.second_uv >> kBaseColorTexture & 1u) * (1u << kBaseColorTexture | 1u << kEmissiveTexture);
  m.image[kSpecularTexture] = m.image[kSpecularColorTexture] = kNoTexture;
}

std::vector<MaterialConstants> material_constants(const Scene& scene) {
  std::vector<MaterialConstants> out;
  for (const Material& material : scene.materials) {
    MaterialConstants& constants = out.emplace_back(material.constants);
    if (constants.flags & kMaterialUnlit) make_unlit(scene, constants);
    for (std::uint32_t slot = 0; slot < kTextureSlotCount; ++slot) {
      if (constants.image[slot] == kNoTexture) continue;
      const TextureImage& image = scene.images[static_cast<std::size_t>(constants.image[slot])];
      constants.one_texel_level[slot] =
          0.5f * std::log2(static_cast<float>(image.width) * static_cast<float>(image.height));
    }
  }
  return out;
}

}  // namespace

rtapi::Result<GpuScene> upload_scene(const Device& device, CommandQueue& queue, const Scene& scene,
                                     std::uint32_t micromap_states) {
  GpuScene out;
  out.statistics.unique_triangles = unique_triangle_count(scene);
  out.statistics.instanced_triangles = instanced_triangle_count(scene);
  const std::vector<bool> glass = glass_meshes(scene);
  for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
    if (const rtapi::Status added = add_mesh(device, scene, i, glass[i], out); !added) {
      return added.error();
    }
  }
  const std::vector<MaterialConstants> constants = material_constants(scene);
  auto materials = CreateUploadBuffer(device, constants, "materials");
  if (!materials) return materials.error();
  out.materials = *materials;
  if (const rtapi::Status added = add_textures(device, queue, scene, out); !added) {
    return added.error();
  }
  const std::vector<PreviousInstance> unmoved(std::max<std::size_t>(scene.instances.size(), 1));
  auto previous = CreateUploadBuffer(device, unmoved, "previous instances");
  if (!previous) return previous.error();
  out.previous_instances = *previous;
  if (micromap_states != 0) {
    auto micromaps = build_micromaps(device, queue, scene, micromap_states, out);
    if (!micromaps) return micromaps.error();
    out.micromaps = std::move(*micromaps);
  }
  return out;
}

static rtapi::Status add_bottom_levels(const Device& device, CommandQueue& queue,
                                       const Scene& scene, GpuScene& out) {
  std::size_t record = 0;
  for (const Mesh& mesh : scene.meshes) {
    if (const auto s = add_bottom_level(device, queue, mesh, record, out); !s) return s;
  }
  return {};
}

rtapi::Result<GpuScene> create_gpu_scene(const Device& device, CommandQueue& queue,
                                         const Scene& scene, const glm::dvec3& origin,
                                         Profile* profile, std::uint32_t micromap_states) {
  const auto step = [&](const char* name) {
    return Profile::enter(profile, ProfilePart::kStart, name);
  };
  auto uploaded = [&] {
    const auto upload = step("upload of the scene");
    return upload_scene(device, queue, scene, micromap_states);
  }();
  if (!uploaded) return uploaded.error();
  GpuScene out = std::move(*uploaded);
  {
    const auto bottom = step("bottom levels");
    const auto start = Clock::now();
    if (const auto s = add_bottom_levels(device, queue, scene, out); !s) return s.error();
    out.statistics.bottom_level_ms = milliseconds_since(start);
  }
  const auto top = step("top level");
  const auto start = Clock::now();
  if (const auto s = add_top_level(device, queue, scene, origin, out); !s) return s.error();
  out.statistics.top_level_ms = milliseconds_since(start);
  return out;
}

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
#include "effects/engine/scene_micromaps.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "effects/assets/scene/opacity_bake.h"
#include "effects/engine/gpu_scene.h"

namespace kaamos::effects {

using namespace rtapi;

namespace {

using Clock = std::chrono::steady_clock;
using Triangles = std::vector<std::array<glm::vec2, 3>>;

AlphaTest alpha_test(const Scene& scene, const MaterialConstants& material) {
  AlphaTest test;
  test.factor = material.base_color.a;
  test.cutoff = (material.flags & kMaterialAlphaTested) != 0
                    ? material.alpha_cutoff
                    : -std::numeric_limits<float>::infinity();
  const std::int32_t image = material.image[kBaseColorTexture];
  if (image == kNoTexture) return test;
  test.image = &scene.images[static_cast<std::size_t>(image)];
  test.sampler = scene.samplers[material.sampler[kBaseColorTexture]];
  test.uv_matrix = material.uv_matrix[kBaseColorTexture];
  test.uv_offset = material.uv_offset[kBaseColorTexture];
  return test;
}

Triangles texture_coordinates(const Mesh& mesh, const Geometry& geometry, bool second) {
  Triangles out(geometry.index_count / 3);
  for (std::uint32_t i = 0; i < geometry.index_count; ++i) {
    const std::size_t vertex = std::size_t{geometry.first_vertex} + mesh.index(geometry, i);
    out[i / 3][i % 3] = second ? mesh.second_uv[vertex] : mesh.vertices[vertex].uv;
  }
  return out;
}

bool has_opaque_vertices(const Mesh& mesh, const Geometry& geometry) {
  if (mesh.colors.empty()) return true;
  const auto first = mesh.colors.begin() + geometry.first_vertex;
  return std::all_of(first, first + geometry.vertex_count,
                     [](const VertexColor& color) { return color.a == kWhite.a; });
}

// All geometries' micromaps in one array.
struct Baked {
  std::vector<std::uint8_t> bits;
  std::vector<BakedMicromap> micromaps;
  std::vector<std::int32_t> indices;
  MicromapStatistics statistics;

  // Adds a geometry's micromaps.
  void add(const BakedMicromaps& of_one) {
    const auto first = static_cast<std::int32_t>(micromaps.size());
    const auto bytes_before = static_cast<std::uint32_t>(bits.size());
    for (BakedMicromap micromap : of_one.micromaps) {
      micromap.byte_offset += bytes_before;
      micromaps.push_back(micromap);
    }
    bits.insert(bits.end(), of_one.bits.begin(), of_one.bits.end());
    for (const std::int32_t index : of_one.indices) {
      indices.push_back(index < 0 ? index : first + index);
    }
    for (std::size_t i = 0; i < statistics.shares.size(); ++i) {
      statistics.shares[i] += of_one.shares[i] * static_cast<double>(of_one.indices.size());
    }
    ++statistics.geometries;
    statistics.triangles += of_one.indices.size();
  }
};

std::vector<RaytracingOpacityMicromapHistogramEntry> histogram(
    const std::vector<BakedMicromap>& micromaps) {
  std::map<std::pair<std::uint16_t, std::uint16_t>, std::uint32_t> counts;
  for (const BakedMicromap& micromap : micromaps) ++counts[{micromap.level, micromap.format}];
  std::vector<RaytracingOpacityMicromapHistogramEntry> out;
  for (const auto& [kind, count] : counts) {
    out.push_back({count, kind.first, static_cast<RaytracingOpacityMicromapFormat>(kind.second)});
  }
  return out;
}

rtapi::Result<Buffer> build_array(const Device& device, CommandQueue& queue, const Baked& baked) {
  const auto bits = CreateUploadBuffer(device, baked.bits, "micromap states");
  if (!bits) return bits.error();
  const auto descs = CreateUploadBuffer(device, baked.micromaps, "micromap descs");
  if (!descs) return descs.error();
  const auto counts = histogram(baked.micromaps);
  RaytracingOpacityMicromapArrayDesc array;
  array.NumOmmHistogramEntries = static_cast<std::uint32_t>(counts.size());
  array.pOmmHistogram = counts.data();
  array.InputBuffer = bits->GetGPUVirtualAddress();
  array.PerOmmDescs = {descs->GetGPUVirtualAddress(), sizeof(BakedMicromap)};
  BuildRaytracingAccelerationStructureInputs inputs;
  inputs.Type = RaytracingAccelerationStructureType::kOpacityMicromapArray;
  inputs.NumDescs = 1;
  inputs.pOpacityMicromapArrayDesc = &array;
  return BuildAccelerationStructure(device, queue, inputs, "opacity micromaps");
}

}  // namespace

rtapi::Result<SceneMicromaps> build_micromaps(const Device& device, CommandQueue& queue,
                                              const Scene& scene, std::uint32_t states,
                                              GpuScene& gpu) {
  const auto start = Clock::now();
  Baked baked;
  std::vector<std::pair<std::size_t, std::size_t>> linked;  // record, its first index
  for (std::size_t record = 0; record < gpu.geometries.size(); ++record) {
    const GpuGeometry& of_device = gpu.geometries[record];
    const Mesh& mesh = scene.meshes[of_device.mesh];
    const Geometry& geometry = mesh.geometries[of_device.constants.geometry_id];
    if (of_device.glass || !geometry.alpha_tested || !has_opaque_vertices(mesh, geometry)) continue;
    const MaterialConstants& material = scene.materials[geometry.material].constants;
    const bool second =
        (material.second_uv >> kBaseColorTexture & 1u) != 0 && !mesh.second_uv.empty();
    linked.emplace_back(record, baked.indices.size());
    baked.add(bake_micromaps(texture_coordinates(mesh, geometry, second),
                             alpha_test(scene, material), {.two_states = states == 2}));
  }
  SceneMicromaps out;
  if (!baked.micromaps.empty()) {
    auto array = build_array(device, queue, baked);
    if (!array) return array.error();
    out.array = *array;
  }
  if (!linked.empty()) {
    const auto indices = CreateUploadBuffer(device, baked.indices, "micromap indices");
    if (!indices) return indices.error();
    out.indices = *indices;
  }
  for (const auto& [record, first] : linked) {
    RaytracingGeometryOmmLinkageDesc linkage;
    linkage.OpacityMicromapIndexBuffer = {
        out.indices.GetGPUVirtualAddress() + first * sizeof(std::int32_t), sizeof(std::int32_t)};
    linkage.OpacityMicromapIndexFormat = Format::kR32Uint;
    if (out.array) linkage.OpacityMicromapArray = out.array.GetGPUVirtualAddress();
    gpu.geometries[record].linkage = linkage;
  }
  MicromapStatistics& statistics = out.statistics = baked.statistics;
  statistics.states = states;
  statistics.micromaps = baked.micromaps.size();
  statistics.bytes = out.array ? out.array.size() : 0;
  for (double& share : statistics.shares) {
    share /= static_cast<double>(std::max<std::uint64_t>(statistics.triangles, 1));
  }
  statistics.bake_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  return out;
}

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
//
// Kaamos' side: the lounge on a device, and DispatchRays over ray grids with bench.hlsl.
#pragma once

#include <rtapi/rtapi.h>
#include <rtapi/shader_table.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "embree_loops.h"
#include "scene_data.h"

namespace kaamos::bench {

// The lounge's buffers, textures and structures.
class DxrScene {
 public:
  // `alpha_tested`: plants are not opaque; otherwise everything is. `distance`: how far all
  // instances are moved, in metres along x and z.
  DxrScene(const SceneData& data, uint32_t threads, bool alpha_tested,
           const std::string& backend = "embree",
           rtapi::TraversalPrecision precision = rtapi::TraversalPrecision::kRobust,
           float distance = 0, bool checked = false);

  const rtapi::Device& device() const { return device_; }
  rtapi::CommandQueue& queue() { return queue_; }
  const SceneData& data() const { return data_; }

  const rtapi::Buffer& top_level() const { return top_level_; }
  const rtapi::Buffer& materials() const { return materials_; }
  const rtapi::DescriptorHeap& images() const { return heap_; }
  rtapi::GpuVirtualAddress vertices_of(const MeshData& mesh, const GeometryData& geometry) const;
  rtapi::GpuVirtualAddress indices_of(const MeshData& mesh, const GeometryData& geometry) const;

 private:
  struct MeshBuffers {
    rtapi::Buffer vertices;
    rtapi::Buffer indices;
    rtapi::Buffer structure;
  };
  void upload_images();
  void build_mesh(const MeshData& mesh, bool alpha_tested, MeshBuffers& out);
  void build_instances(float distance);
  const MeshBuffers& buffers_of(const MeshData& mesh) const;

  const SceneData& data_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  std::vector<MeshBuffers> meshes_;
  rtapi::Buffer top_level_;
  rtapi::Buffer materials_;
  rtapi::DescriptorHeap heap_;
  std::vector<rtapi::Texture> images_;
};

// Selects the shaders, and so the type of the results: ClosestResult, uint32_t or ShadedResult.
enum class Program { kClosest, kVisible, kAlphaTested, kShaded, kHitObject, kShadedHitObject };

// One DispatchRays that can be run again and again.
class DxrDispatch {
 public:
  DxrDispatch(DxrScene& scene, Program program, const RayGrid& grid);

  void run();
  // Results of the last run.
  template <typename T>
  std::vector<T> results();

 private:
  void create_pipeline();
  void create_tables();
  void record();

  DxrScene& scene_;
  Program program_;
  const RayGrid& grid_;
  rtapi::RootSignature global_;
  rtapi::RootSignature local_;
  rtapi::StateObject pipeline_;
  rtapi::Buffer rays_;
  rtapi::Buffer results_;
  std::vector<rtapi::ShaderTable> tables_;  // ray generation, miss, hit groups
  rtapi::CommandList list_;
};

template <typename T>
std::vector<T> DxrDispatch::results() {
  const auto bytes = rtapi::ReadbackBuffer(scene_.device(), scene_.queue(), results_).value();
  std::vector<T> out(bytes.size() / sizeof(T));
  std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
  return out;
}

}  // namespace kaamos::bench

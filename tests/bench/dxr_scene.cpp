// SPDX-License-Identifier: MIT
#include "dxr_scene.h"

#include <rtapi/upload.h>

#include <span>

#include "tests/common/structures.h"

namespace kaamos::bench {
namespace {

using namespace rtapi;

Device make_device(uint32_t threads, const std::string& backend, TraversalPrecision precision,
                   bool checked) {
  DeviceDesc desc;
  desc.Backend = backend;
  desc.Threads = threads;
  desc.Precision = precision;
  desc.Checked = checked;
  return CreateDevice(desc).value();
}

}  // namespace

DxrScene::DxrScene(const SceneData& data, uint32_t threads, bool alpha_tested,
                   const std::string& backend, TraversalPrecision precision, float distance,
                   bool checked)
    : data_(data),
      device_(make_device(threads, backend, precision, checked)),
      queue_(device_.CreateCommandQueue().value()) {
  meshes_.resize(data.meshes.size());
  for (size_t i = 0; i < meshes_.size(); ++i) build_mesh(data.meshes[i], alpha_tested, meshes_[i]);
  build_instances(distance);
  materials_ = CreateUploadBuffer(device_, materials_of(data.scene), "materials").value();
  upload_images();
}

void DxrScene::build_mesh(const MeshData& mesh, bool alpha_tested, MeshBuffers& out) {
  out.vertices = CreateUploadBuffer(device_, *mesh.vertices, "vertices").value();
  out.indices = CreateUploadBuffer(device_, mesh.indices, "indices").value();
  std::vector<RaytracingGeometryDesc> geometries;
  for (const GeometryData& geometry : mesh.geometries) {
    RaytracingGeometryDesc& desc = geometries.emplace_back();
    desc.Flags = alpha_tested && geometry.alpha_tested ? RaytracingGeometryFlags::kNone
                                                       : RaytracingGeometryFlags::kOpaque;
    desc.Triangles.VertexFormat = Format::kR32G32B32Float;
    desc.Triangles.IndexFormat = Format::kR32Uint;
    desc.Triangles.IndexCount = 3 * geometry.triangle_count;
    desc.Triangles.IndexBuffer =
        out.indices.GetGPUVirtualAddress() + uint64_t{geometry.first_index} * 4;
    desc.Triangles.VertexCount = geometry.vertex_count;
    desc.Triangles.VertexBuffer = {out.vertices.GetGPUVirtualAddress() +
                                       uint64_t{geometry.first_vertex} * effects::kVertexStride,
                                   effects::kVertexStride};
  }
  out.structure = kaamos::test::build_bottom_level(device_, queue_, geometries);
}

void DxrScene::build_instances(float distance) {
  std::vector<RaytracingInstanceDesc> instances;
  for (const InstanceData& instance : data_.instances) {
    RaytracingInstanceDesc& desc = instances.emplace_back();
    std::memcpy(desc.Transform, instance.transform.data(), sizeof(desc.Transform));
    for (int axis : {0, 2}) desc.Transform[axis][3] += distance;
    desc.InstanceContributionToHitGroupIndex = data_.meshes[instance.mesh].first_record;
    desc.AccelerationStructure = meshes_[instance.mesh].structure.GetGPUVirtualAddress();
  }
  top_level_ = kaamos::test::build_top_level(device_, queue_, instances);
}

void DxrScene::upload_images() {
  DescriptorHeapDesc heap;
  heap.NumDescriptors = std::max<uint32_t>(1, static_cast<uint32_t>(data_.scene.images.size()));
  heap.Flags = DescriptorHeapFlags::kShaderVisible;
  heap_ = device_.CreateDescriptorHeap(heap).value();
  for (const effects::TextureImage& image : data_.scene.images) {
    TextureDesc desc;
    desc.Width = image.width;
    desc.Height = image.height;
    desc.Format = image.srgb ? Format::kR8G8B8A8UnormSrgb : Format::kR8G8B8A8Unorm;
    desc.Name = image.name;
    images_.push_back(device_.CreateTexture(desc).value());
    UploadTexture(device_, queue_, images_.back(), 0,
                  std::as_bytes(std::span<const uint8_t>(image.mips[0])))
        .value();
    device_
        .CreateShaderResourceView(
            images_.back(), heap_.GetCPUDescriptorHandle(static_cast<uint32_t>(images_.size() - 1)))
        .value();
  }
}

const DxrScene::MeshBuffers& DxrScene::buffers_of(const MeshData& mesh) const {
  return meshes_[static_cast<size_t>(&mesh - data_.meshes.data())];
}

GpuVirtualAddress DxrScene::vertices_of(const MeshData& mesh, const GeometryData& geometry) const {
  return buffers_of(mesh).vertices.GetGPUVirtualAddress() +
         uint64_t{geometry.first_vertex} * effects::kVertexStride;
}

GpuVirtualAddress DxrScene::indices_of(const MeshData& mesh, const GeometryData& geometry) const {
  return buffers_of(mesh).indices.GetGPUVirtualAddress() + uint64_t{geometry.first_index} * 4;
}

}  // namespace kaamos::bench

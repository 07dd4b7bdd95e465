// SPDX-License-Identifier: MIT
#include "runtime/vulkan/testing/scene_harness.h"

#include <algorithm>
#include <utility>

namespace kaamos::vulkan::testing {

using Type = rtapi::RaytracingAccelerationStructureType;

GeometryInput triangle_at(float z, float x) {
  GeometryInput input;
  input.xyz = {x, 1, z, x + 1, -1, z, x - 1, -1, z};
  return input;
}

GeometryInput box_at(float z, float x) {
  GeometryInput input;
  input.boxes = {{x - 0.5f, -0.5f, z, x + 0.5f, 0.5f, z + 0.5f}};
  return input;
}

void append(GeometryInput& to, const GeometryInput& from) {
  to.xyz.insert(to.xyz.end(), from.xyz.begin(), from.xyz.end());
  to.boxes.insert(to.boxes.end(), from.boxes.begin(), from.boxes.end());
}

rtapi::RaytracingInstanceDesc instance_of(uint64_t bottom_level) {
  rtapi::RaytracingInstanceDesc desc;
  desc.AccelerationStructure = bottom_level;
  return desc;
}

SceneHarness::SceneHarness(std::shared_ptr<Gpu> gpu) : gpu_(std::move(gpu)), stream_(gpu_) {
  context_.addresses = &addresses_;
  context_.message = [this](const rtapi::Message& message) { messages.push_back(message); };
  auto made = AccelerationStructures::create(gpu_, memory_, context_);
  EXPECT_TRUE(made) << made.error().message;
  structures_ = std::move(*made);
}

SceneHarness::~SceneHarness() {
  structures_.reset();
}

std::shared_ptr<runtime::BackendBuffer> SceneHarness::buffer(uint64_t bytes) {
  rtapi::BufferDesc desc;
  desc.SizeInBytes = bytes;
  auto made = memory_->create_buffer(*gpu_, desc, memory_);
  EXPECT_TRUE(made) << made.error().message;
  runtime::Allocation allocation;
  allocation.address = (*made)->address();
  allocation.size_bytes = bytes;
  allocation.host = (*made)->host();
  addresses_.insert(allocation);
  buffers_.push_back(*made);
  return *made;
}

void SceneHarness::free(std::shared_ptr<runtime::BackendBuffer>& buffer) {
  addresses_.erase(buffer->address());
  buffers_.erase(std::find(buffers_.begin(), buffers_.end(), buffer));
  buffer.reset();
}

rtapi::RaytracingGeometryDesc SceneHarness::geometry(const GeometryInput& input) {
  rtapi::RaytracingGeometryDesc desc;
  desc.Flags = input.flags;
  if (!input.boxes.empty()) {
    desc.Type = rtapi::RaytracingGeometryType::kProceduralPrimitiveAabbs;
    desc.AABBs.AABBCount = input.boxes.size();
    desc.AABBs.AABBs = {upload(input.boxes), sizeof(rtapi::RaytracingAabb)};
    return desc;
  }
  desc.Type = rtapi::RaytracingGeometryType::kTriangles;
  desc.Triangles = {};
  desc.Triangles.VertexFormat = rtapi::Format::kR32G32B32Float;
  desc.Triangles.VertexCount = static_cast<uint32_t>(input.xyz.size() / 3);
  desc.Triangles.VertexBuffer = {upload(input.xyz), 12};
  if (!input.indices.empty()) {
    desc.Triangles.IndexFormat = rtapi::Format::kR32Uint;
    desc.Triangles.IndexCount = static_cast<uint32_t>(input.indices.size());
    desc.Triangles.IndexBuffer = upload(input.indices);
  }
  if (!input.transform.empty()) desc.Triangles.Transform3x4 = upload(input.transform);
  return desc;
}

runtime::BuildCommand SceneHarness::bottom_level_command(
    const std::vector<GeometryInput>& geometries, runtime::BuildFlags flags) {
  runtime::BuildCommand command;
  command.type = Type::kBottomLevel;
  command.flags = flags;
  for (const GeometryInput& input : geometries) command.geometries.push_back(geometry(input));
  const auto info = structures_->prebuild_info(command);
  command.dest = buffer(info.ResultDataMaxSizeInBytes)->address();
  return command;
}

runtime::BuildCommand SceneHarness::top_level_command(
    const std::vector<rtapi::RaytracingInstanceDesc>& instances) {
  runtime::BuildCommand command;
  command.type = Type::kTopLevel;
  command.instance_count = static_cast<uint32_t>(instances.size());
  command.instance_descs = upload(instances);
  const auto info = structures_->prebuild_info(command);
  command.dest = buffer(info.ResultDataMaxSizeInBytes)->address();
  return command;
}

uint64_t SceneHarness::bottom_level(const std::vector<GeometryInput>& geometries,
                                    runtime::BuildFlags flags) {
  const auto command = bottom_level_command(geometries, flags);
  const auto status = build(command);
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
  return status.ok() ? command.dest : 0;
}

uint64_t SceneHarness::top_level(const std::vector<rtapi::RaytracingInstanceDesc>& instances) {
  const auto command = top_level_command(instances);
  const auto status = build(command);
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().message);
  return status.ok() ? command.dest : 0;
}

}  // namespace kaamos::vulkan::testing

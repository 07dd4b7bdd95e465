// SPDX-License-Identifier: MIT
//
// Scenes for tests of acceleration structures and textures, without rtapi and its shaders.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "runtime/backend/backend.h"
#include "runtime/structures/structure_map.h"
#include "runtime/vulkan/structures/acceleration_structure.h"
#include "runtime/vulkan/testing/vulkan_device.h"

namespace kaamos::vulkan::testing {

struct GeometryInput {
  std::vector<float> xyz;                    // triangles
  std::vector<uint32_t> indices;             // empty: not indexed
  std::vector<rtapi::RaytracingAabb> boxes;  // procedural, unless empty
  rtapi::RaytracingGeometryFlags flags = rtapi::RaytracingGeometryFlags::kOpaque;
  std::vector<float> transform;  // 12 floats, or empty
};

// A triangle that a ray along +z hits at (x, 0, z).
GeometryInput triangle_at(float z, float x = 0);
GeometryInput box_at(float z, float x = 0);
void append(GeometryInput& to, const GeometryInput& from);
rtapi::RaytracingInstanceDesc instance_of(uint64_t bottom_level);

class SceneHarness {
 public:
  explicit SceneHarness(std::shared_ptr<Gpu> gpu);
  ~SceneHarness();

  Gpu& gpu() { return *gpu_; }
  const std::shared_ptr<Gpu>& gpu_pointer() { return gpu_; }
  CommandStream& stream() { return stream_; }
  const Memory& memory() const { return *memory_; }
  AccelerationStructures& structures() { return *structures_; }
  runtime::AddressMap& addresses() { return addresses_; }

  // Buffers live as long as the harness, or until free().
  std::shared_ptr<runtime::BackendBuffer> buffer(uint64_t bytes);
  void free(std::shared_ptr<runtime::BackendBuffer>& buffer);
  template <typename T>
  uint64_t upload(const std::vector<T>& values) {
    auto block = buffer(values.empty() ? 1 : values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(block->host(), values.data(), values.size() * sizeof(T));
    return block->address();
  }
  uint8_t* host(uint64_t address) { return addresses_.host(address); }

  rtapi::RaytracingGeometryDesc geometry(const GeometryInput& input);
  runtime::BuildCommand bottom_level_command(
      const std::vector<GeometryInput>& geometries,
      runtime::BuildFlags flags = runtime::BuildFlags::kNone);
  runtime::BuildCommand top_level_command(
      const std::vector<rtapi::RaytracingInstanceDesc>& instances);
  // These return the address; 0 and a failed expectation if the build fails.
  uint64_t bottom_level(const std::vector<GeometryInput>& geometries,
                        runtime::BuildFlags flags = runtime::BuildFlags::kNone);
  uint64_t top_level(const std::vector<rtapi::RaytracingInstanceDesc>& instances);
  rtapi::Status build(const runtime::BuildCommand& command) {
    return structures_->build(stream_, command);
  }
  rtapi::Status copy(const runtime::CopyAccelerationStructureCommand& command) {
    return structures_->copy(stream_, command);
  }

  std::vector<rtapi::Message> messages;

 private:
  std::shared_ptr<Gpu> gpu_;
  std::shared_ptr<Memory> memory_ = std::make_shared<Memory>();
  runtime::AddressMap addresses_;
  runtime::Context context_;
  std::unique_ptr<AccelerationStructures> structures_;
  CommandStream stream_;
  std::vector<std::shared_ptr<runtime::BackendBuffer>> buffers_;
};

}  // namespace kaamos::vulkan::testing

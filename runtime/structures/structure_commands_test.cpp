// SPDX-License-Identifier: MIT
//
// Runs on a device whose addresses are not host addresses: every byte must be found through the
// map.
#include "runtime/structures/structure_commands.h"

#include <gtest/gtest.h>

#include <cstring>
#include <new>

#include "runtime/structures/build_inputs.h"
#include "runtime/structures/instances.h"
#include "runtime/structures/structure_copies.h"

namespace kaamos::runtime {
namespace {

using Type = rtapi::RaytracingAccelerationStructureType;
using InfoType = rtapi::RaytracingAccelerationStructurePostbuildInfoType;

struct Level final : BottomLevelBase {
  bool empty() const override { return false; }
  Bounds object_bounds() const override { return {{-1, -1, -1}, {1, 1, 1}}; }
  std::vector<GeometryShape> geometry_shapes() const override { return {}; }
  GeometryContents geometry_contents(uint32_t) const override { return {}; }
};
struct Top final : TopLevelBase {};

class FarDevice : public ::testing::Test {
 protected:
  FarDevice() {
    context_.addresses = &addresses_;
    context_.message = [this](const rtapi::Message& message) { messages_.push_back(message); };
    Allocation allocation;
    allocation.address = kAddress;
    allocation.size_bytes = sizeof(bytes_);
    allocation.host = bytes_;
    addresses_.insert(allocation);
  }
  StructureEnvironment environment() { return {context_, map_, "Test"}; }
  rtapi::Status build(const BuildCommand& command) {
    return build_structure(environment(), command,
                           [&](const AccelerationStructure*, AccelerationStructure& result) {
                             result.compacted_bytes = 1000;
                             if (command.type == Type::kTopLevel) {
                               result.top_level = std::make_shared<Top>();
                             } else {
                               result.bottom_level = std::make_shared<Level>();
                             }
                             return rtapi::Status();
                           });
  }
  BuildCommand bottom_level(uint64_t offset) {
    BuildCommand command;
    command.type = Type::kBottomLevel;
    command.dest = kAddress + offset;
    return command;
  }

  static constexpr uint64_t kAddress = uint64_t{1} << 40;
  alignas(256) uint8_t bytes_[8192] = {};
  AddressMap addresses_;
  Context context_;
  StructureMap map_;
  std::vector<rtapi::Message> messages_;
};

TEST_F(FarDevice, HeadersAndInfosAreWrittenWhereTheHostSeesThem) {
  auto command = bottom_level(1024);
  command.postbuild_infos = {{kAddress + 512, InfoType::kCurrentSize}};
  ASSERT_TRUE(build(command));
  ASSERT_NE(map_.find(kAddress + 1024), nullptr);
  uint64_t size;
  std::memcpy(&size, bytes_ + 512, sizeof(size));
  EXPECT_EQ(size, map_.find(kAddress + 1024)->size_bytes);
  CopyAccelerationStructureCommand copy;
  copy.source = command.dest;
  copy.dest = kAddress + 2048;
  ASSERT_TRUE(copy_structure(environment(), copy, {}));
  bytes_[1024] ^= 1;  // ends the first structure, not the second
  EXPECT_EQ(map_.find(kAddress + 1024), nullptr);
  EXPECT_NE(map_.find(kAddress + 2048), nullptr);
  map_.evict(kAddress + 2048 + 100, 1);
  EXPECT_EQ(map_.find(kAddress + 2048), nullptr);
}

TEST_F(FarDevice, InstancesAreReadAsArrayAndThroughPointers) {
  ASSERT_TRUE(build(bottom_level(0)));
  rtapi::RaytracingInstanceDesc desc;
  desc.AccelerationStructure = kAddress;
  desc.InstanceID = 5;
  desc.Transform[0][3] = 10;
  std::memcpy(bytes_ + 4096, &desc, sizeof(desc));
  desc.AccelerationStructure = kAddress + 256;
  std::memcpy(bytes_ + 4096 + 64, &desc, sizeof(desc));
  BuildCommand command;
  command.instance_count = 2;
  command.instance_descs = kAddress + 4096;
  auto instances = read_instances(environment(), command);
  ASSERT_TRUE(instances);
  EXPECT_NE((*instances)[0].bottom_level, nullptr);
  EXPECT_NEAR((*instances)[0].bounds.lower[0], 9, 1e-4);
  EXPECT_EQ((*instances)[0].world_to_object[3], -10);
  EXPECT_EQ((*instances)[1].bottom_level, nullptr);
  ASSERT_EQ(messages_.size(), 1u);
  EXPECT_EQ(messages_[0].Id.text(), "KA0797");
  const uint64_t pointers[] = {kAddress + 4096 + 64, kAddress + 4096};
  std::memcpy(bytes_ + 6000, pointers, sizeof(pointers));
  command.instance_descs = kAddress + 6000;
  command.instance_layout = rtapi::ElementsLayout::kArrayOfPointers;
  instances = read_instances(environment(), command);
  ASSERT_TRUE(instances);
  EXPECT_NE((*instances)[1].bottom_level, nullptr);
  command.instance_descs = kAddress + sizeof(bytes_) - 8;
  const auto outside = read_instances(environment(), command);
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.error().id.text(), "KA0796");
}

TEST_F(FarDevice, InputsAreDecodedThroughTheHostsAddresses) {
  const float vertex[3] = {1, 2, 3};
  std::memcpy(bytes_ + 64, vertex, sizeof(vertex));
  rtapi::RaytracingGeometryDesc desc;
  desc.Triangles.VertexFormat = rtapi::Format::kR32G32B32Float;
  desc.Triangles.VertexCount = 1;
  desc.Triangles.VertexBuffer = {kAddress + 64, 12};
  ASSERT_TRUE(check_inputs(desc, 0, addresses_));
  const auto host = as_host_sees(desc, addresses_);
  EXPECT_EQ(host.Triangles.Transform3x4, 0u);
  float xyz[3];
  decode_vertices(host.Triangles, xyz);
  EXPECT_EQ(xyz[2], 3);
  const rtapi::RaytracingAabb box = {1, 2, 3, 4, 5, 6};
  std::memcpy(bytes_ + 128, &box, sizeof(box));
  desc.Type = rtapi::RaytracingGeometryType::kProceduralPrimitiveAabbs;
  desc.AABBs = {1, {kAddress + 128, 24}};
  EXPECT_EQ(aabb_at(as_host_sees(desc, addresses_).AABBs, 0).MaxZ, 6);
}

TEST_F(FarDevice, ABuildWithoutMemoryIsAnError) {
  const auto status =
      build_structure(environment(), bottom_level(0),
                      [](const AccelerationStructure*, AccelerationStructure&) -> rtapi::Status {
                        throw std::bad_alloc();
                      });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().id.text(), "KA0990");
  EXPECT_EQ(status.error().code, rtapi::ErrorCode::kOutOfMemory);
  EXPECT_EQ(map_.find(kAddress), nullptr);
}

}  // namespace
}  // namespace kaamos::runtime

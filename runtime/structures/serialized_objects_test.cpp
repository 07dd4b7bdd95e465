// SPDX-License-Identifier: MIT
#include "runtime/structures/serialized_objects.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "runtime/structures/cluster.h"
#include "runtime/structures/partitioned_instances.h"

namespace kaamos::runtime {
namespace {

using Type = rtapi::RaytracingAccelerationStructureType;

Cluster two_triangles() {
  Cluster cluster;
  cluster.id = 77;
  cluster.data_access = true;
  cluster.xyz = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  cluster.indices = {0, 1, 2, 3, 2, 1};
  cluster.geometry = {0x80000003, 16777215};
  cluster.linkage = std::make_shared<MicromapLinkage>();
  cluster.linkage->address = 0xAA00;
  cluster.linkage->indices = {-5, 9};
  return cluster;
}

AccelerationStructure cluster() {
  AccelerationStructure structure;
  structure.size_bytes = 384;
  structure.cluster = std::make_shared<const Cluster>(two_triangles());
  return structure;
}

AccelerationStructure made_template() {
  auto made = std::make_shared<ClusterTemplate>();
  made->cluster = two_triangles();
  made->cluster.xyz.clear();
  made->cluster.linkage = nullptr;
  made->vertices = 4;
  made->truncated_bits = 9;
  made->bounded = true;
  made->upper[2] = 5;
  AccelerationStructure structure;
  structure.size_bytes = 160;
  structure.cluster_template = std::move(made);
  return structure;
}

AccelerationStructure level() {
  AccelerationStructure structure;
  structure.size_bytes = 512;
  structure.of_clusters = true;
  structure.flags = BuildFlags::kPreferFastTrace | BuildFlags::kAllowDataAccess;
  structure.clusters =
      std::make_shared<const std::vector<uint64_t>>(std::vector<uint64_t>{0x100, 0x200, 0x300});
  return structure;
}

AccelerationStructure partitioned() {
  auto top = std::make_shared<PartitionedTopLevel>();
  top->inputs = {rtapi::RtasPartitionedTlasFlags::kEnablePartitionTranslation, 3, 4, 2, 5};
  top->translations = {{1, 2, 3}, {}};
  top->global_translation = {0, 0, 7};
  top->slots.resize(3);
  top->slots[1].written = true;
  top->slots[1].args.InstanceID = 0xDEADBEEF;
  top->slots[1].args.AccelerationStructure = 0x4000;
  top->slots[1].args.PartitionIndex = 1;
  top->instances.resize(3);
  AccelerationStructure structure;
  structure.size_bytes = 2048;
  structure.instance_count = 3;
  structure.partitioned = std::move(top);
  return structure;
}

std::vector<AccelerationStructure> all() {
  return {cluster(), made_template(), level(), partitioned()};
}

std::vector<uint8_t> bytes_of(const AccelerationStructure& structure) {
  std::vector<uint8_t> bytes(serialized_size(structure).bytes);
  serialize(structure, bytes);
  return bytes;
}

SerializedStructure parsed_again(const AccelerationStructure& structure) {
  return parse_serialized(bytes_of(structure)).value();
}

TEST(SerializedObjects, ClustersComeBack) {
  EXPECT_EQ(serialized_size(cluster()).pointers, 1u);
  const SerializedStructure parsed = parsed_again(cluster());
  EXPECT_EQ(parsed.type, Type::kClusterLevel);
  EXPECT_EQ(parsed.size_bytes, 384u);
  const Cluster expected = two_triangles();
  ASSERT_NE(parsed.cluster, nullptr);
  EXPECT_EQ(parsed.cluster->id, 77u);
  EXPECT_TRUE(parsed.cluster->data_access);
  EXPECT_FALSE(parsed.cluster->allows_disable_omms);
  EXPECT_EQ(parsed.cluster->xyz, expected.xyz);
  EXPECT_EQ(parsed.cluster->indices, expected.indices);
  EXPECT_EQ(parsed.cluster->geometry, expected.geometry);
  ASSERT_EQ(parsed.linkages.size(), 1u);
  EXPECT_EQ(parsed.linkages[0], parsed.cluster->linkage);
  EXPECT_EQ(parsed.linkages[0]->address, 0xAA00u);
  EXPECT_EQ(parsed.linkages[0]->indices, expected.linkage->indices);
}

TEST(SerializedObjects, TemplatesComeBack) {
  EXPECT_EQ(serialized_size(made_template()).pointers, 0u);
  const SerializedStructure parsed = parsed_again(made_template());
  EXPECT_EQ(parsed.type, Type::kClusterTemplate);
  ASSERT_NE(parsed.cluster_template, nullptr);
  EXPECT_EQ(parsed.cluster_template->vertices, 4u);
  EXPECT_EQ(parsed.cluster_template->truncated_bits, 9u);
  EXPECT_TRUE(parsed.cluster_template->bounded);
  EXPECT_EQ(parsed.cluster_template->upper[2], 5);
  EXPECT_EQ(parsed.cluster_template->cluster.indices, two_triangles().indices);
}

TEST(SerializedObjects, BottomLevelsAreTheAddressesOfTheirClusters) {
  EXPECT_EQ(serialized_size(level()).pointers, 1u);
  const SerializedStructure parsed = parsed_again(level());
  EXPECT_EQ(parsed.type, Type::kClusteredBottomLevel);
  EXPECT_EQ(parsed.clusters, *level().clusters);
  EXPECT_EQ(parsed.flags, BuildFlags::kPreferFastTrace);  // what clusters allow they say
}

TEST(SerializedObjects, PartitionedTopLevelsComeBack) {
  EXPECT_EQ(serialized_size(partitioned()).pointers, 1u);
  const SerializedStructure parsed = parsed_again(partitioned());
  EXPECT_EQ(parsed.type, Type::kPartitionedTopLevel);
  ASSERT_NE(parsed.partitioned, nullptr);
  const PartitionedTopLevel& top = *parsed.partitioned;
  EXPECT_EQ(top.inputs.MaxInstanceInGlobalPartitionCount, 5u);
  EXPECT_EQ(top.translations, partitioned().partitioned->translations);
  EXPECT_EQ(top.global_translation[2], 7);
  ASSERT_EQ(top.slots.size(), 3u);
  EXPECT_FALSE(top.slots[0].written || top.slots[2].written);
  EXPECT_TRUE(top.slots[1].written);
  EXPECT_EQ(top.slots[1].args.InstanceID, 0xDEADBEEF);
  EXPECT_EQ(top.slots[1].args.AccelerationStructure, 0x4000u);
  EXPECT_EQ(top.slots[1].args.InstanceIndex, 1u);
}

TEST(SerializedObjects, EveryCutAndEveryChangedByteIsSeen) {
  for (const auto& structure : all()) {
    const auto bytes = bytes_of(structure);
    const SerializedFrame frame = frame_of_object(structure);
    for (size_t size = 0; size < bytes.size(); ++size) {
      const auto parsed = parse_serialized(std::span(bytes).first(size));
      ASSERT_FALSE(parsed) << size;
      EXPECT_EQ(parsed.error().id.text(), "KA0789");
    }
    const size_t first = sizeof(SerializedHeader) + (frame.block ? 16 : 0);
    for (size_t i = 0; i < bytes.size(); ++i) {
      const bool patchable = i >= first && i < first + frame.pointers.size() * 8;
      // Unused bytes between the type of the block and the number of addresses.
      if (frame.block && i >= sizeof(SerializedHeader) + 4 && i < sizeof(SerializedHeader) + 8) {
        continue;
      }
      auto changed = bytes;
      changed[i] ^= 0x40;
      EXPECT_EQ(parse_serialized(changed).ok(), patchable) << i;
    }
  }
}

// What is accepted has no index past its arrays.
TEST(SerializedObjects, SealedDamageStaysInside) {
  std::mt19937 random(5);
  uint32_t accepted = 0;
  uint32_t refused = 0;
  for (const auto& structure : all()) {
    const auto bytes = bytes_of(structure);
    for (int round = 0; round < 5000; ++round) {
      auto changed = bytes;
      for (uint32_t n = 1 + random() % 4; n > 0; --n) {
        const size_t at = 32 + random() % (changed.size() - 32);
        changed[at] = round % 2 == 0 ? static_cast<uint8_t>(random())
                                     : static_cast<uint8_t>(changed[at] ^ (1u << random() % 8));
      }
      if (round % 5 == 0) changed.resize(changed.size() - random() % 60);
      seal_serialized(changed);
      const auto parsed = parse_serialized(changed);
      if (!parsed) {
        ++refused;
        EXPECT_EQ(parsed.error().id.text(), "KA0789");
        continue;
      }
      ++accepted;
      if (parsed->cluster != nullptr) {
        for (const uint16_t index : parsed->cluster->indices) {
          EXPECT_LT(3 * index, parsed->cluster->xyz.size());
        }
        EXPECT_EQ(parsed->cluster->indices.size(), 3 * parsed->cluster->geometry.size());
      }
      if (parsed->partitioned == nullptr) continue;
      const PartitionedTopLevel& top = *parsed->partitioned;
      EXPECT_EQ(top.slots.size(), top.instances.size());
      EXPECT_EQ(top.translations.size(), top.translates() ? top.inputs.PartitionCount : 0);
      for (const PartitionedInstance& slot : top.slots) {
        if (slot.written) {
          EXPECT_LE(top.place_of(slot.args.PartitionIndex), top.inputs.PartitionCount);
        }
      }
    }
  }
  EXPECT_GT(accepted, 1000u);
  EXPECT_GT(refused, 1000u);
}

TEST(DecodedObjects, ArgumentsNameTheirArrays) {
  const uint64_t address = uint64_t{1} << 40;
  const auto bytes = decoded_object(cluster(), address);
  EXPECT_EQ(decoded_size(cluster()), bytes.size());
  rtapi::RtasBuildClasFromTrianglesArgs args;
  std::memcpy(static_cast<void*>(&args), &bytes[8], sizeof(args));
  EXPECT_EQ(args.ClusterID, 77u);
  EXPECT_EQ(args.TriangleCount, 2u);
  EXPECT_EQ(args.VertexCount, 4u);
  const Cluster expected = two_triangles();
  EXPECT_EQ(std::memcmp(&bytes[args.VertexBuffer - address], expected.xyz.data(), 48), 0);
  const uint8_t indices[6] = {0, 1, 2, 3, 2, 1};
  EXPECT_EQ(std::memcmp(&bytes[args.IndexBuffer - address], indices, 6), 0);
  EXPECT_EQ(std::memcmp(&bytes[args.OpacityMicromapIndexBuffer - address],
                        expected.linkage->indices.data(), 8),
            0);
  rtapi::RtasBuildClusterTemplatesFromTrianglesArgs of_template;
  const auto decoded = decoded_object(made_template(), address);
  std::memcpy(static_cast<void*>(&of_template), &decoded[8], sizeof(of_template));
  EXPECT_EQ(of_template.InstantiationBoundingBoxLimit % 32, 0u);
  EXPECT_EQ(of_template.TrianglesArgs.VertexBuffer, 0u);
}

}  // namespace
}  // namespace kaamos::runtime

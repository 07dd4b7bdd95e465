// SPDX-License-Identifier: MIT
#include "runtime/structures/serialized_structure.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "runtime/structures/build_inputs.h"

namespace kaamos::runtime {
namespace {

using Header = rtapi::SerializedRaytracingAccelerationStructureHeader;
using GeometryType = rtapi::RaytracingGeometryType;

struct Level final : BottomLevelBase {
  std::vector<GeometryShape> shapes;
  std::vector<float> xyz = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  std::vector<uint32_t> indices = {0, 1, 2, 3, 2, 1, 0, 3, 1};
  std::vector<rtapi::RaytracingAabb> boxes = {{1, 2, 3, 4, 5, 6}, {2, 3, 4, 5, 6, 7}};

  bool empty() const override { return false; }
  Bounds object_bounds() const override { return {}; }
  std::vector<GeometryShape> geometry_shapes() const override { return shapes; }
  GeometryContents geometry_contents(uint32_t geometry) const override {
    if (shapes[geometry].primitives == 0) return {};
    return {xyz, indices, boxes};
  }
};

AccelerationStructure triangles() {
  auto level = std::make_shared<Level>();
  level->shapes.resize(3);
  for (uint32_t i = 0; i < 3; ++i) level->shapes[i].index = i;
  GeometryShape& indexed = level->shapes[0];
  indexed.vertex_format = rtapi::Format::kR16G16B16A16Float;
  indexed.index_format = rtapi::Format::kR16Uint;
  indexed.opaque = indexed.transformed = true;
  indexed.vertices = 4;
  indexed.primitives = 3;
  GeometryShape& plain = level->shapes[2];
  plain.no_duplicate_any_hit = true;
  plain.vertices = 4;
  plain.primitives = 1;
  AccelerationStructure structure;
  structure.size_bytes = 4096;
  structure.flags = BuildFlags::kAllowUpdate | BuildFlags::kPreferFastTrace;
  structure.bottom_level = std::move(level);
  return structure;
}

AccelerationStructure boxes() {
  auto level = std::make_shared<Level>();
  level->shapes.resize(1);
  level->shapes[0].type = GeometryType::kProceduralPrimitiveAabbs;
  level->shapes[0].primitives = 2;
  AccelerationStructure structure;
  structure.size_bytes = 512;
  structure.bottom_level = std::move(level);
  return structure;
}

AccelerationStructure instances() {
  std::vector<rtapi::RaytracingInstanceDesc> descs(5);
  for (uint32_t i = 0; i < 5; ++i) {
    descs[i].InstanceID = 10 + i;
    descs[i].AccelerationStructure = uint64_t{i / 2} * 0x10000;  // 0, 0, 1, 1, 2
  }
  AccelerationStructure structure;
  structure.size_bytes = 2048;
  structure.instances =
      std::make_shared<const std::vector<rtapi::RaytracingInstanceDesc>>(std::move(descs));
  return structure;
}

std::vector<uint8_t> bytes_of(const AccelerationStructure& structure) {
  std::vector<uint8_t> bytes(serialized_size(structure).bytes);
  serialize(structure, bytes);
  return bytes;
}

TEST(SerializedStructure, BottomLevelsOfTrianglesComeBack) {
  const auto structure = triangles();
  const auto bytes = bytes_of(structure);
  EXPECT_EQ(serialized_size(structure).pointers, 0u);
  const auto parsed = parse_serialized(bytes);
  ASSERT_TRUE(parsed) << parsed.error().message;
  EXPECT_EQ(parsed->type, rtapi::RaytracingAccelerationStructureType::kBottomLevel);
  EXPECT_EQ(parsed->flags, structure.flags);
  EXPECT_EQ(parsed->size_bytes, 4096u);
  ASSERT_EQ(parsed->geometries.size(), 3u);
  const GeometryShape& shape = parsed->shapes[0];
  EXPECT_EQ(shape.vertex_format, rtapi::Format::kR16G16B16A16Float);
  EXPECT_EQ(shape.index_format, rtapi::Format::kR16Uint);
  EXPECT_TRUE(shape.opaque && shape.transformed && !shape.no_duplicate_any_hit);
  const auto& level = static_cast<const Level&>(*structure.bottom_level);
  const auto& indexed = parsed->geometries[0].Triangles;
  std::vector<float> xyz(12);
  std::vector<uint32_t> indices(9);
  decode_vertices(indexed, xyz.data());
  EXPECT_EQ(decode_indices(indexed, indices.data()), 0u);
  EXPECT_EQ(xyz, level.xyz);
  EXPECT_EQ(indices, level.indices);
  EXPECT_EQ(parsed->geometries[1].Triangles.VertexCount, 0u);
  EXPECT_TRUE(parsed->shapes[2].no_duplicate_any_hit);
  const auto& plain = parsed->geometries[2].Triangles;
  EXPECT_EQ(plain.IndexFormat, rtapi::Format::kUnknown);
  decode_vertices(plain, xyz.data());
  EXPECT_EQ(xyz, level.xyz);
}

TEST(SerializedStructure, BoxesComeBack) {
  const auto bytes = bytes_of(boxes());
  const auto parsed = parse_serialized(bytes);
  ASSERT_TRUE(parsed) << parsed.error().message;
  const auto& desc = parsed->geometries.at(0);
  EXPECT_EQ(desc.Type, GeometryType::kProceduralPrimitiveAabbs);
  ASSERT_EQ(desc.AABBs.AABBCount, 2u);
  EXPECT_EQ(aabb_at(desc.AABBs, 1).MaxZ, 7);
}

// [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_SERIALIZATION_DESC]: each instance
// has an address of its own, so that two of one bottom level can become two of different ones.
TEST(SerializedStructure, InstancesComeBackWithPatchedAddresses) {
  auto bytes = bytes_of(instances());
  EXPECT_EQ(serialized_size(instances()).pointers, 5u);
  EXPECT_EQ(serialized_size(instances()).bytes, sizeof(Header) + 5 * 8 + 24 + 5 * 64);
  const uint64_t patched[5] = {0, 0xCC0000, 0xAAAA00, 0xBBBB00, 0};
  uint64_t before[5];
  std::memcpy(before, &bytes[sizeof(Header)], sizeof(before));
  for (uint64_t i = 0; i < 5; ++i) EXPECT_EQ(before[i], i / 2 * 0x10000) << i;
  std::memcpy(&bytes[sizeof(Header)], patched, sizeof(patched));
  bytes.resize(bytes.size() + 100);  // a larger buffer
  const auto parsed = parse_serialized(bytes);
  ASSERT_TRUE(parsed) << parsed.error().message;
  ASSERT_EQ(parsed->instances.size(), 5u);
  for (uint32_t i = 0; i < 5; ++i) {
    EXPECT_EQ(parsed->instances[i].InstanceID, 10 + i);
    EXPECT_EQ(parsed->instances[i].AccelerationStructure, patched[i]);
  }
}

TEST(SerializedStructure, EveryCutAndEveryChangedByteIsSeen) {
  for (const auto& structure : {triangles(), boxes(), instances()}) {
    const auto bytes = bytes_of(structure);
    const uint64_t pointers = serialized_size(structure).pointers;
    for (size_t size = 0; size < bytes.size(); ++size) {
      const std::vector<uint8_t> cut(bytes.begin(), bytes.begin() + static_cast<long>(size));
      const auto parsed = parse_serialized(cut);
      ASSERT_FALSE(parsed) << size;
      EXPECT_EQ(parsed.error().id.text(), "KA0789");
    }
    for (size_t i = 0; i < bytes.size(); ++i) {
      const bool patchable = i >= sizeof(Header) && i < sizeof(Header) + pointers * 8;
      auto changed = bytes;
      changed[i] ^= 0x40;
      EXPECT_EQ(parse_serialized(changed).ok(), patchable) << i;
    }
  }
}

TEST(SerializedStructure, MessagesSayWhatIsWrong) {
  auto bytes = bytes_of(triangles());
  const auto message = [](std::span<const uint8_t> data) {
    const auto parsed = parse_serialized(data);
    return parsed ? std::string("fine") : parsed.error().message;
  };
  EXPECT_NE(message({}).find("56 bytes"), std::string::npos);
  EXPECT_NE(message(std::span(bytes).first(100)).find("truncated"), std::string::npos);
  bytes[0] ^= 1;
  EXPECT_NE(message(bytes).find("another driver"), std::string::npos);
  bytes[0] ^= 1;
  bytes[16] ^= 2;
  EXPECT_NE(message(bytes).find("version 3"), std::string::npos);
  bytes[16] ^= 2;
  bytes.back() ^= 1;
  EXPECT_NE(message(bytes).find("checksum"), std::string::npos);
}

// Once the checksum fits, the data behind it must withstand damage on its own: whatever is accepted
// refers only to bytes of its own, which the sanitizers watch.
TEST(SerializedStructure, SealedDamageNamesNoOtherBytes) {
  std::mt19937 random(5);
  uint32_t accepted = 0;
  uint32_t refused = 0;
  for (const auto& structure : {triangles(), boxes(), instances()}) {
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
      for (const auto& desc : parsed->geometries) {
        if (desc.Type == GeometryType::kProceduralPrimitiveAabbs) {
          for (uint64_t i = 0; i < desc.AABBs.AABBCount; ++i) {
            [[maybe_unused]] volatile float z = aabb_at(desc.AABBs, i).MaxZ;
          }
          continue;
        }
        std::vector<float> xyz(3 * size_t{desc.Triangles.VertexCount});
        decode_vertices(desc.Triangles, xyz.data());
        std::vector<uint32_t> indices(3 * primitive_count(desc));
        decode_indices(desc.Triangles, indices.data());
        for (const uint32_t index : indices) EXPECT_LT(index, desc.Triangles.VertexCount);
      }
    }
  }
  EXPECT_GT(accepted, 1000u);
  EXPECT_GT(refused, 1000u);
}

// [DXR: D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE]: descs come in the original order.
TEST(DecodedStructure, DescsNameTheirArrays) {
  const auto structure = triangles();
  std::vector<uint8_t> bytes(decoded_size(structure));
  const uint64_t address = uint64_t{1} << 40;
  decode_for_tools(structure, address, bytes);
  rtapi::BuildRaytracingAccelerationStructureToolsVisualizationHeader header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  EXPECT_EQ(header.Type, rtapi::RaytracingAccelerationStructureType::kBottomLevel);
  ASSERT_EQ(header.NumDescs, 3u);
  std::vector<rtapi::RaytracingGeometryDesc> descs(3);
  std::memcpy(descs.data(), &bytes[8], 3 * sizeof(descs[0]));
  EXPECT_EQ(descs[0].Flags, rtapi::RaytracingGeometryFlags::kOpaque);
  EXPECT_EQ(descs[0].Triangles.IndexCount, 9u);
  EXPECT_EQ(descs[1].Triangles.VertexCount, 0u);
  const auto& level = static_cast<const Level&>(*structure.bottom_level);
  for (const int i : {0, 2}) {
    const auto& desc = descs[static_cast<size_t>(i)].Triangles;
    const uint64_t offset = desc.VertexBuffer.StartAddress - address;
    ASSERT_LE(offset + 48, bytes.size());
    EXPECT_EQ(std::memcmp(&bytes[offset], level.xyz.data(), 48), 0);
  }
  EXPECT_EQ(std::memcmp(&bytes[descs[0].Triangles.IndexBuffer - address], level.indices.data(), 36),
            0);
}

TEST(DecodedStructure, InstancesAreIdentical) {
  const auto structure = instances();
  std::vector<uint8_t> bytes(decoded_size(structure));
  decode_for_tools(structure, 0x1000, bytes);
  ASSERT_EQ(bytes.size(), 8u + 5 * 64);
  EXPECT_EQ(std::memcmp(&bytes[8], structure.instances->data(), size_t{5} * 64), 0);
}

}  // namespace
}  // namespace kaamos::runtime

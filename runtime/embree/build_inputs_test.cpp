// SPDX-License-Identifier: MIT
#include "runtime/structures/build_inputs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <cstring>
#include <vector>

#include "runtime/embree/testing/harness.h"

namespace kaamos::embree {
namespace {

using rtapi::Format;
using runtime::decode_indices;
using runtime::decode_vertices;
using runtime::primitive_count;
using testing::End;
using testing::Harness;

// Decodes one vertex of `bytes`.
std::vector<float> decode(Format format, std::vector<uint8_t> bytes,
                          const float* transform = nullptr) {
  alignas(16) uint8_t padded[16] = {};
  std::memcpy(padded, bytes.data(), bytes.size());
  rtapi::RaytracingGeometryTrianglesDesc desc = {};
  desc.VertexFormat = format;
  desc.VertexCount = 1;
  desc.VertexBuffer = {reinterpret_cast<uint64_t>(padded), bytes.size()};
  desc.Transform3x4 = reinterpret_cast<uint64_t>(transform);
  std::vector<float> xyz(3, -7);
  decode_vertices(desc, xyz.data());
  return xyz;
}

template <typename T>
std::vector<uint8_t> bytes_of(std::vector<T> values) {
  std::vector<uint8_t> bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

using V = std::vector<float>;

TEST(As09, EveryVertexFormat) {
  EXPECT_EQ(decode(Format::kR32G32Float, bytes_of<float>({1.5f, -2})), (V{1.5f, -2, 0}));
  EXPECT_EQ(decode(Format::kR32G32B32Float, bytes_of<float>({1, 2, 3})), (V{1, 2, 3}));
  // Halves: 1, -2, the smallest denormal, the largest number.
  EXPECT_EQ(decode(Format::kR16G16Float, bytes_of<uint16_t>({0x3C00, 0xC000})), (V{1, -2, 0}));
  EXPECT_EQ(decode(Format::kR16G16B16A16Float, bytes_of<uint16_t>({0x0001, 0x7BFF, 0x8000})),
            (V{0x1p-24f, 65504, -0.0f}));
  EXPECT_EQ(decode(Format::kR16G16Snorm, bytes_of<int16_t>({32767, -32768})), (V{1, -1, 0}));
  EXPECT_EQ(decode(Format::kR16G16B16A16Snorm, bytes_of<int16_t>({-32767, 0, 16384})),
            (V{-1, 0, 16384.0f / 32767.0f}));
  EXPECT_EQ(decode(Format::kR16G16Unorm, bytes_of<uint16_t>({65535, 0})), (V{1, 0, 0}));
  EXPECT_EQ(decode(Format::kR16G16B16A16Unorm, bytes_of<uint16_t>({0, 65535, 1})),
            (V{0, 1, 1.0f / 65535.0f}));
  EXPECT_EQ(decode(Format::kR10G10B10A2Unorm, bytes_of<uint32_t>({1023u | 0u << 10 | 512u << 20})),
            (V{1, 0, 512.0f / 1023.0f}));
  EXPECT_EQ(decode(Format::kR8G8Unorm, {255, 51}), (V{1, 0.2f, 0}));
  EXPECT_EQ(decode(Format::kR8G8B8A8Unorm, {0, 255, 51}), (V{0, 1, 0.2f}));
  EXPECT_EQ(decode(Format::kR8G8Snorm, {127, 128}), (V{1, -1, 0}));
  EXPECT_EQ(decode(Format::kR8G8B8A8Snorm, {129, 0, 127}), (V{-1, 0, 1}));
}

TEST(As10, ATwoComponentFormatIsTransformedWithZZero) {
  const float rotation[12] = {0, 0, 1, 5, 0, 1, 0, 6, -1, 0, 0, 7};
  EXPECT_EQ(decode(Format::kR32G32Float, bytes_of<float>({2, 3}), rotation), (V{5, 9, 5}));
}

TEST(As11, OnlyTheLowHalfOfTheStrideCounts) {
  const std::vector<float> vertices = {1, 2, 3, 4, 5, 6};
  rtapi::RaytracingGeometryTrianglesDesc desc = {};
  desc.VertexFormat = Format::kR32G32B32Float;
  desc.VertexCount = 2;
  desc.VertexBuffer = {reinterpret_cast<uint64_t>(vertices.data()), 0x10000000Cull};
  float xyz[6];
  decode_vertices(desc, xyz);
  EXPECT_EQ(xyz[5], 6.0f);
}

TEST(As08, ARestOfIndicesIsIgnored) {
  rtapi::RaytracingGeometryDesc desc;
  desc.Triangles.VertexCount = 8;
  EXPECT_EQ(primitive_count(desc), 2u);
  desc.Triangles.IndexFormat = Format::kR16Uint;
  desc.Triangles.IndexCount = 5;
  EXPECT_EQ(primitive_count(desc), 1u);
}

TEST(As05And06, IndicesOfBothSizes) {
  const std::vector<uint16_t> small = {0, 1, 2, 3, 2, 1};
  const std::vector<uint32_t> large = {0, 1, 2, 3, 2, 9};
  rtapi::RaytracingGeometryTrianglesDesc desc = {};
  desc.VertexCount = 4;
  desc.IndexCount = 6;
  desc.IndexFormat = Format::kR16Uint;
  desc.IndexBuffer = reinterpret_cast<uint64_t>(small.data());
  uint32_t indices[6];
  EXPECT_EQ(decode_indices(desc, indices), 0u);
  EXPECT_EQ(indices[3], 3u);
  desc.IndexFormat = Format::kR32Uint;
  desc.IndexBuffer = reinterpret_cast<uint64_t>(large.data());
  EXPECT_EQ(decode_indices(desc, indices), 1u);
  EXPECT_EQ(indices[5], 0u);
}

TEST(As07, AnIndexOutOfRangeIsAMessageAndNoHit) {
  Harness h;
  h.use_standard_pipeline();
  auto input = testing::triangle_at(3);
  input.indices = {0, 1, 99, 0, 1, 2};
  const uint64_t scene = h.scene({input});
  ASSERT_EQ(h.messages.size(), 1u);
  EXPECT_EQ(h.messages[0].Id.text(), "KA0798");
  EXPECT_EQ(h.trace(testing::ray_along_z(scene)).values.primitive_index, 1u);
}

TEST(CheckInputs, RangesOutsideTheirBuffersAreErrors) {
  Harness h;
  auto command = h.bottom_level_command({testing::triangle_at(3)});
  command.geometries[0].Triangles.VertexCount = 3000;
  auto status = h.execute(command);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0790");
  EXPECT_NE(status.error().message.find("needs 36000 bytes"), std::string::npos)
      << status.error().message;
  command.geometries[0].Triangles.VertexCount = 0xFFFFFFFF;
  command.geometries[0].Triangles.VertexBuffer.StrideInBytes = 0xFFFFFFFF;
  EXPECT_FALSE(h.execute(command).ok());
  command = h.bottom_level_command({testing::box_at(3)});
  command.geometries[0].AABBs.AABBCount = uint64_t{1} << 60;
  EXPECT_FALSE(h.execute(command).ok());
  command = h.bottom_level_command({testing::triangle_at(3)});
  command.geometries[0].Triangles.VertexFormat = Format::kR8Uint;
  status = h.execute(command);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().id.text(), "KA0791");
}

TEST(As13, AStrideOfZeroIsOneBoxForAll) {
  Harness h;
  h.use_standard_pipeline(nullptr, testing::report_all);
  testing::report_log() = {};
  testing::report_log().reports = {{500, 1, {}}};  // past TMax, so that all boxes are visited
  auto command = h.bottom_level_command({testing::box_at(3)});
  command.geometries[0].AABBs.AABBCount = 4;
  command.geometries[0].AABBs.AABBs.StrideInBytes = 0;
  command.dest = h.buffer(1 << 16)->address();
  ASSERT_TRUE(h.execute(command).ok());
  h.trace(testing::ray_along_z(h.top_level({testing::instance_of(command.dest)})));
  auto visited = testing::report_log().primitives;
  std::sort(visited.begin(), visited.end());
  EXPECT_EQ(visited, (std::vector<uint32_t>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace kaamos::embree

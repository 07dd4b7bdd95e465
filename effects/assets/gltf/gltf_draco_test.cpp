// SPDX-License-Identifier: MIT
// Meshes compressed by Draco's own encoder load as their uncompressed files do.
#ifdef KAAMOS_HAS_DRACO
#include <draco/compression/encode.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <utility>

#include "effects/assets/gltf/gltf_codecs_test_support.h"
#include "effects/assets/gltf/gltf_damage_test_support.h"

namespace kaamos::effects {
namespace {

constexpr char kName[] = "KHR_draco_mesh_compression";

struct Options {
  int method = draco::MESH_SEQUENTIAL_ENCODING;
  int position_bits = 0;  // 0: not quantized
  int normal_bits = 0;
};

draco::DataType type_of(int component_type) {
  switch (component_type) {
    case 5121:
      return draco::DT_UINT8;
    case 5123:
      return draco::DT_UINT16;
    default:
      return draco::DT_FLOAT32;
  }
}

draco::GeometryAttribute::Type kind_of(const std::string& name) {
  if (name == "POSITION") return draco::GeometryAttribute::POSITION;
  if (name == "NORMAL") return draco::GeometryAttribute::NORMAL;
  if (name.starts_with("TEXCOORD")) return draco::GeometryAttribute::TEX_COORD;
  if (name == "COLOR_0") return draco::GeometryAttribute::COLOR;
  return draco::GeometryAttribute::GENERIC;
}

std::vector<std::uint8_t> encode(const CodecModel& model, const Options& options) {
  draco::Mesh mesh;
  const auto count = static_cast<std::uint32_t>(model.kCount);
  mesh.set_num_points(count);
  for (const ModelAttribute& from : model.attributes) {
    const std::size_t stride = from.element_bytes(count);
    draco::GeometryAttribute to;
    to.Init(kind_of(from.name), nullptr, static_cast<std::int8_t>(from.components),
            type_of(from.component_type), from.normalized, static_cast<std::int64_t>(stride), 0);
    const int id = mesh.AddAttribute(to, true, count);
    for (std::uint32_t i = 0; i < count; ++i)
      mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i),
                                            from.bytes.data() + i * stride);
  }
  for (std::size_t i = 0; i < model.indices.size(); i += 3)
    mesh.AddFace({draco::PointIndex(model.indices[i]), draco::PointIndex(model.indices[i + 1]),
                  draco::PointIndex(model.indices[i + 2])});
  draco::Encoder encoder;
  encoder.SetEncodingMethod(options.method);
  if (options.position_bits > 0)
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, options.position_bits);
  if (options.normal_bits > 0)
    encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, options.normal_bits);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  return {buffer.data(), buffer.data() + buffer.size()};
}

/// What tests change of a file.
struct Parts {
  std::size_t count = CodecModel::kCount;
  std::size_t corners = 0;  // 0: as many as the model has
  std::string members;      // of the primitive
  std::string more_attributes;
};

/// Accessors without bufferViews, and the stream.
std::vector<std::uint8_t> file_of(const CodecModel& model, const std::vector<std::uint8_t>& stream,
                                  const Parts& parts = {}) {
  GltfFile file;
  file.attributes.clear();
  std::string ids;
  for (std::size_t i = 0; i < model.attributes.size(); ++i) {
    const std::string comma = i == 0 ? "\"" : ",\"";
    const ModelAttribute& from = model.attributes[i];
    file.attributes += comma + from.name + "\":" + file.accessor(from.accessor(parts.count));
    ids += comma + from.name + "\":" + std::to_string(i);
  }
  const std::size_t corners = parts.corners == 0 ? model.indices.size() : parts.corners;
  file.indices =
      file.accessor(R"("componentType":5125,"type":"SCALAR","count":)" + std::to_string(corners));
  file.primitive = parts.members + R"(,"extensions":{")" + kName + R"(":{"bufferView":)" +
                   file.add_view(stream) + R"(,"attributes":{)" + ids + parts.more_attributes +
                   "}}}";
  const std::string list = std::string("[\"") + kName + "\"]";
  file.more = R"(,"extensionsRequired":)" + list + R"(,"extensionsUsed":)" + list;
  CodecModel::finish(file);
  return file.bytes();
}

Mesh mesh_of(const Result<LoadedScene>& loaded) {
  EXPECT_TRUE(loaded.ok()) << loaded.error().message;
  return loaded.ok() ? loaded.value().scene.meshes.at(0) : Mesh();
}

TEST(GltfDraco, SequentialStreamsComeBackBitForBit) {
  const CodecModel model;
  const auto loaded = load_animated(file_of(model, encode(model, {})));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_TRUE(loaded.value().warnings.empty());
  const Mesh plain = mesh_of(load_animated(model.plain()));
  ASSERT_FALSE(plain.skin.empty());
  ASSERT_FALSE(plain.colors.empty());
  ASSERT_FALSE(plain.second_uv.empty());
  expect_same_mesh(mesh_of(loaded), plain);
  // The pose of the file takes joints and weights another way.
  expect_same_mesh(mesh_of(load(file_of(model, encode(model, {})))), mesh_of(load(model.plain())));
}

/// The vertices by the places that their positions have in the grid: the encoder reorders them.
std::map<std::pair<int, int>, Vertex> by_place(const Mesh& mesh) {
  std::map<std::pair<int, int>, Vertex> out;
  for (const Vertex& vertex : mesh.vertices)
    out[{static_cast<int>(std::lround(vertex.position.x)),
         static_cast<int>(std::lround(vertex.position.y))}] = vertex;
  return out;
}

TEST(GltfDraco, EdgebreakerStreamsHaveTheSameVerticesAndTriangles) {
  const CodecModel model;
  const Mesh plain = mesh_of(load(model.plain()));
  const Mesh read =
      mesh_of(load(file_of(model, encode(model, {.method = draco::MESH_EDGEBREAKER_ENCODING}))));
  const auto expected = by_place(plain), actual = by_place(read);
  ASSERT_EQ(actual.size(), expected.size());
  for (const auto& [place, vertex] : expected)
    EXPECT_EQ(std::memcmp(&vertex, &actual.at(place), sizeof vertex), 0) << place.first;
  // Twice the signed area over the grid tells a triangle that is missing or turned.
  const auto corners = [](const Mesh& mesh) {
    std::map<std::pair<int, int>, int> out;
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i)
      for (std::uint32_t k = 0; k < 3; ++k) {
        const glm::vec3& a = mesh.corner(mesh.geometries.at(0), i, k).position;
        const glm::vec3& b = mesh.corner(mesh.geometries.at(0), i, (k + 1) % 3).position;
        ++out[{static_cast<int>(a.x + 16 * a.y), static_cast<int>(b.x + 16 * b.y)}];
      }
    return out;
  };
  EXPECT_EQ(corners(read), corners(plain)) << "edges with their directions";
}

TEST(GltfDraco, QuantizedStreamsAreAsNearAsTheirBitsSay) {
  const CodecModel model;
  const auto expected = by_place(mesh_of(load(model.plain())));
  const Mesh read =
      mesh_of(load(file_of(model, encode(model, {.method = draco::MESH_EDGEBREAKER_ENCODING,
                                                 .position_bits = 12,
                                                 .normal_bits = 10}))));
  const auto actual = by_place(read);
  ASSERT_EQ(actual.size(), expected.size());
  // The longest side, 8, has 4,095 steps, of which half a one is the most that rounding moves.
  const float step = 8.0f / 4095.0f;
  for (const auto& [place, vertex] : expected) {
    const Vertex& other = actual.at(place);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(other.position[axis], vertex.position[axis], 0.5f * step + 1e-5f);
    // The octahedron's square has sides of 2 and 1,023 steps; its corners stretch by up to 3^1.5
    // / 2.
    EXPECT_LT(glm::distance(other.normal, vertex.normal), 2.6f * 2.0f / 1023.0f);
    EXPECT_EQ(other.uv, vertex.uv);
  }
}

TEST(GltfDraco, StripsAreStoredAsTheirTriangles) {
  const CodecModel model;
  // The strip of a row has 2 n vertices for 2 n - 2 triangles.
  const std::size_t corners = model.indices.size() / 3 + 2;
  Parts parts;
  parts.members = R"(,"mode":5)";
  parts.corners = corners;
  const Mesh plain = mesh_of(load(model.plain()));
  expect_same_mesh(mesh_of(load(file_of(model, encode(model, {}), parts))), plain);
  parts.corners = corners - 1;
  expect_error(load(file_of(model, encode(model, {}), parts)),
               "its stream has 128 triangles, its accessors have room for 127");
}

TEST(GltfDraco, APrimitiveThatAlsoHasPlainDataLoads) {
  // The extension is not required, and the accessors have bufferViews too.
  const CodecModel model;
  GltfFile file;
  file.attributes.clear();
  std::string ids;
  for (std::size_t i = 0; i < model.attributes.size(); ++i) {
    const std::string comma = i == 0 ? "\"" : ",\"";
    const ModelAttribute& from = model.attributes[i];
    file.attributes += comma + from.name + "\":" +
                       file.accessor(R"("bufferView":)" + file.add_view(from.bytes) + "," +
                                     from.accessor(model.kCount));
    ids += comma + from.name + "\":" + std::to_string(i);
  }
  file.indices = file.add(model.indices, 5125, "SCALAR", 1);
  file.primitive = R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":)" +
                   file.add_view(encode(model, {})) + R"(,"attributes":{)" + ids + "}}}";
  file.more = R"(,"extensionsUsed":["KHR_draco_mesh_compression"])";
  CodecModel::finish(file);
  const auto loaded = load(file.bytes());
  expect_same_mesh(mesh_of(loaded), mesh_of(load(model.plain())));
  EXPECT_TRUE(loaded.ok() && loaded.value().warnings.empty());
}

TEST(GltfDraco, WhatIsWrongIsNamed) {
  const CodecModel model;
  const std::vector<std::uint8_t> good = encode(model, {});
  const std::string place = "mesh 0, primitive 0, KHR_draco_mesh_compression";
  expect_error(load(file_of(model, good, {.count = 80})),
               place + ": its stream has 81 vertices, its accessors have room for 80");
  expect_error(load(file_of(model, good, {.corners = 381})),
               place + ": its stream has 128 triangles, its accessors have room for 127");
  expect_warning(load(file_of(model, good, {.count = 82})),
                 place + ": its stream has 81 vertices, its accessors have room for 82");
  expect_error(load(file_of(model, good, {.count = std::size_t{1} << 32})),
               place + ", COLOR_0: has 4294967296 elements, 134217728 are allowed");
  expect_error(load(file_of(model, good, {.members = R"(,"mode":6)"})),
               place + ": the primitive's mode");
  expect_error(load(file_of(model, good, {.more_attributes = R"(,"POSITION":99)"})),
               place + ", POSITION: names attribute 99, which the stream does not have");
  expect_error(load(file_of(model, good, {.more_attributes = R"(,"POSITION":-1)"})),
               place + ": attribute POSITION is -1, 0 to 4294967295 are allowed");
  expect_error(load(file_of(model, good, {.more_attributes = R"(,"POSITION":"x")"})),
               place + ": attribute POSITION is not a whole number");
  expect_error(load(file_of(model, good, {.more_attributes = R"(,"POSITION":3)"})),
               place + ", POSITION: has 2 components in the stream, 3 in its accessor");
  std::vector<std::uint8_t> bad = good;
  bad[0] = 'X';
  expect_error(load(file_of(model, bad)), place + ": its stream is no Draco mesh");
  bad = good;
  bad[6] = 1;  // the version, 2.1
  expect_error(load(file_of(model, bad)), place + ": its stream is of Draco's version 2.1");
  bad = good;
  bad.resize(11);
  expect_error(load(file_of(model, bad)), place + ": its stream is cut");
  bad.resize(200);  // no triangles, vertices and attributes
  expect_error(load(file_of(model, bad)),
               place + ", COLOR_0: names attribute 5, which the stream does not have");
  GltfFile file;
  file.primitive =
      R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":7,"attributes":{}}})";
  expect_error(load(file.bytes()), place + ": names bufferView 7 of 2");
  file.primitive = R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":1}})";
  expect_error(load(file.bytes()), place + ": has no attributes");
}

TEST(GltfDraco, AStreamCannotRequestAnyAmountOfMemory) {
  // Header of an edgebreaker mesh: traversal, then 3 vertices and 40,000,000 triangles as varints.
  const std::vector<std::uint8_t> stream = {'D', 'R', 'A', 'C', 'O',  2,    2,    1,   1,
                                            0,   0,   0,   3,   0x80, 0xB4, 0x89, 0x13};
  const CodecModel model;
  expect_error(load(file_of(model, stream, {.corners = 120000000})),
               "its stream has 17 bytes for 40000000 triangles");
}

TEST(GltfDraco, AFixedStreamOfOneTriangle) {
  const std::vector<std::uint8_t> stream = {
      // Header: version 2.2, a mesh, sequential, no flags; 1 triangle, 3 vertices, plain 8-bit
      // indices.
      'D', 'R', 'A', 'C', 'O', 2, 2, 1, 0, 0, 0, 1, 3, 1, 0, 1, 2,
      // One decoder of attributes, one attribute: position, float32, 3 components, not normalized,
      // id 0; its decoder is the generic one.
      1, 1, 0, 9, 3, 0, 0, 0,
      // (0, 0, 0), (1, 0, 0), (0, 2, 0).
      0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x80, 0x3F, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
      0, 0, 0x40, 0, 0, 0, 0};
  GltfFile file;
  file.attributes =
      R"("POSITION":)" + file.accessor(R"("componentType":5126,"count":3,"type":"VEC3")");
  file.indices = file.accessor(R"("componentType":5121,"count":3,"type":"SCALAR")");
  file.primitive = R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":)" +
                   file.add_view(stream) + R"(,"attributes":{"POSITION":0}}})";
  const Scene scene = scene_of(load(file.bytes()));
  const Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.triangle_count(), 1u);
  EXPECT_EQ(mesh.corner(mesh.geometries[0], 0, 0).position, glm::vec3(0, 0, 0));
  EXPECT_EQ(mesh.corner(mesh.geometries[0], 0, 1).position, glm::vec3(1, 0, 0));
  EXPECT_EQ(mesh.corner(mesh.geometries[0], 0, 2).position, glm::vec3(0, 2, 0));
}

TEST(GltfDraco, CutAndChangedStreamsNeverCrash) {
  const CodecModel model;
  const auto with = [&](const std::vector<std::uint8_t>& stream) { return file_of(model, stream); };
  const std::vector<std::uint8_t> edgebreaker = encode(
      model, {.method = draco::MESH_EDGEBREAKER_ENCODING, .position_bits = 11, .normal_bits = 8});
  EXPECT_GT(count_refused(edgebreaker, 600, with), 150);
  EXPECT_GT(count_refused(encode(model, {}), 600, with), 150);
}

}  // namespace
}  // namespace kaamos::effects
#endif

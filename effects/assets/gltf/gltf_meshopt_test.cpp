// SPDX-License-Identifier: MIT
// Buffer views compressed by meshoptimizer's own encoders load as uncompressed ones do.
#ifdef KAAMOS_HAS_MESHOPT
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "effects/assets/gltf/gltf_codecs_test_support.h"
#include "effects/assets/gltf/gltf_damage_test_support.h"

namespace kaamos::effects {
namespace {

constexpr char kName[] = "EXT_meshopt_compression";
constexpr char kUsed[] =
    R"(,"extensionsRequired":["EXT_meshopt_compression","KHR_mesh_quantization"],)"
    R"("extensionsUsed":["EXT_meshopt_compression","KHR_mesh_quantization"])";
/// A buffer that no file holds, for views to stand in.
constexpr char kFallback[] =
    R"(,{"byteLength":65536,"extensions":{"EXT_meshopt_compression":{"fallback":true}}})";

using Bytes = std::vector<std::uint8_t>;

Bytes encoded_vertices(const Bytes& values, std::size_t stride) {
  const std::size_t count = values.size() / stride;
  meshopt_encodeVertexVersion(0);  // the extension's, as that of indices is 1
  Bytes out(meshopt_encodeVertexBufferBound(count, stride));
  out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), values.data(), count, stride));
  return out;
}

Bytes encoded_triangles(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
  meshopt_encodeIndexVersion(1);
  Bytes out(meshopt_encodeIndexBufferBound(indices.size(), vertices));
  out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), indices.data(), indices.size()));
  return out;
}

Bytes encoded_sequence(const std::vector<std::uint32_t>& indices, std::size_t vertices) {
  meshopt_encodeIndexVersion(1);
  Bytes out(meshopt_encodeIndexSequenceBound(indices.size(), vertices));
  out.resize(meshopt_encodeIndexSequence(out.data(), out.size(), indices.data(), indices.size()));
  return out;
}

/// Floats as 24 bits of mantissa, of which `bits` are used, below 8 of exponent: another version of
/// the library has another encoder for them.
Bytes exponential(const std::vector<float>& values, int bits) {
  std::vector<std::uint32_t> words;
  for (const float value : values) {
    int exponent = 0;
    const float mantissa = std::ldexp(std::frexp(value, &exponent), bits - 1);
    words.push_back((static_cast<std::uint32_t>(std::lround(mantissa)) & 0xFFFFFFu) |
                    static_cast<std::uint32_t>(exponent - bits + 1) << 24);
  }
  Bytes out(words.size() * sizeof words[0]);
  std::memcpy(out.data(), words.data(), out.size());
  return out;
}

/// A view of buffer 1 whose bytes the stream holds. Returns its number as text.
std::string add_view(GltfFile& file, const Bytes& stream, std::size_t count, std::size_t stride,
                     const std::string& mode, const std::string& filter = "",
                     bool is_vertices = true) {
  const std::string size = std::to_string(stride);
  return file.view(R"("buffer":1,"byteLength":)" + std::to_string(count * stride) +
                   (is_vertices ? R"(,"byteStride":)" + size : "") + R"(,"extensions":{")" + kName +
                   R"(":{"buffer":0,"byteOffset":)" + std::to_string(file.add_bytes(stream)) +
                   R"(,"byteLength":)" + std::to_string(stream.size()) + R"(,"byteStride":)" +
                   size + R"(,"count":)" + std::to_string(count) + R"(,"mode":")" + mode + "\"" +
                   (filter.empty() ? "" : R"(,"filter":")" + filter + "\"") + "}}");
}

enum class Indices { kTriangles, kSequence };

/// The model with all its views compressed.
Bytes file_of(const CodecModel& model, Indices kind, std::size_t index_size = 4,
              const std::string& more_buffers = kFallback) {
  GltfFile file;
  file.attributes.clear();
  for (const ModelAttribute& from : model.attributes) {
    const std::size_t stride = from.element_bytes(model.kCount);
    const std::string view =
        add_view(file, encoded_vertices(from.bytes, stride), model.kCount, stride, "ATTRIBUTES");
    file.attributes += (file.attributes.empty() ? "\"" : ",\"") + from.name + "\":" +
                       file.accessor(R"("bufferView":)" + view + "," + from.accessor(model.kCount));
  }
  const std::size_t count = model.indices.size();
  const bool is_list = kind == Indices::kTriangles;
  const Bytes stream = is_list ? encoded_triangles(model.indices, model.kCount)
                               : encoded_sequence(model.indices, model.kCount);
  const std::string view =
      add_view(file, stream, count, index_size, is_list ? "TRIANGLES" : "INDICES", "", false);
  file.indices = file.accessor(R"("bufferView":)" + view + R"(,"componentType":)" +
                               (index_size == 2 ? "5123" : "5125") +
                               R"(,"type":"SCALAR","count":)" + std::to_string(count));
  file.more = kUsed;
  file.more_buffers = more_buffers;
  CodecModel::finish(file);
  return file.bytes();
}

Mesh mesh_of(const Result<LoadedScene>& loaded) {
  EXPECT_TRUE(loaded.ok()) << loaded.error().message;
  return loaded.ok() ? loaded.value().scene.meshes.at(0) : Mesh();
}

TEST(GltfMeshopt, AttributesAndIndicesComeBackBitForBit) {
  const CodecModel model;
  const auto loaded = load_animated(file_of(model, Indices::kSequence));
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  EXPECT_TRUE(loaded.value().warnings.empty());
  const Mesh plain = mesh_of(load_animated(model.plain()));
  expect_same_mesh(mesh_of(loaded), plain);
  expect_same_mesh(mesh_of(load_animated(file_of(model, Indices::kSequence, 2))), plain);
}

/// The corners of each triangle by their places in the grid, from the smallest on.
std::vector<std::array<int, 3>> triangles_of(const Mesh& mesh) {
  std::vector<std::array<int, 3>> out;
  for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
    std::array<int, 3> corners = {};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const glm::vec3& at = mesh.corner(mesh.geometries.at(0), i, k).position;
      corners[k] = static_cast<int>(std::lround(at.x) + 16 * std::lround(at.y));
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    out.push_back(corners);
  }
  return out;
}

TEST(GltfMeshopt, TrianglesMayBeginAtAnotherCorner) {
  const CodecModel model;
  const Mesh plain = mesh_of(load(model.plain()));
  for (const std::size_t size : {std::size_t{2}, std::size_t{4}}) {
    const Mesh read = mesh_of(load(file_of(model, Indices::kTriangles, size)));
    EXPECT_EQ(triangles_of(read), triangles_of(plain)) << size;
  }
}

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
  Bytes out(values.size() * sizeof(T));
  std::memcpy(out.data(), values.data(), out.size());
  return out;
}

TEST(GltfMeshopt, QuantizedAttributesAndOctahedralNormals) {
  const CodecModel model;
  const Mesh plain = mesh_of(load(model.plain()));
  const std::uint32_t count = CodecModel::kCount;
  std::vector<std::uint16_t> positions, uvs;  // the height is left out
  std::vector<float> normals;
  for (const Vertex& vertex : plain.vertices) {
    positions.insert(positions.end(),
                     {static_cast<std::uint16_t>(std::lround(vertex.position.x)),
                      static_cast<std::uint16_t>(std::lround(vertex.position.y)), 7, 0});
    uvs.insert(uvs.end(), {static_cast<std::uint16_t>(std::lround(65535 * vertex.uv.x)),
                           static_cast<std::uint16_t>(std::lround(65535 * vertex.uv.y))});
    normals.insert(normals.end(), {vertex.normal.x, vertex.normal.y, vertex.normal.z, 0.0f});
  }
  for (const bool wide : {false, true}) {
    const std::size_t stride = wide ? 8 : 4;
    const int bits = wide ? 12 : 8;
    Bytes octahedral(count * stride);
    meshopt_encodeFilterOct(octahedral.data(), count, stride, bits, normals.data());
    GltfFile file;
    const auto accessor = [&](const Bytes& values, std::size_t size, const std::string& members,
                              const std::string& filter = "") {
      return file.accessor(
          R"("bufferView":)" +
          add_view(file, encoded_vertices(values, size), count, size, "ATTRIBUTES", filter) +
          R"(,"count":)" + std::to_string(count) + "," + members);
    };
    file.attributes =
        R"("POSITION":)" +
        accessor(bytes_of(positions), 8, R"("componentType":5123,"type":"VEC3")") +
        R"(,"TEXCOORD_0":)" +
        accessor(bytes_of(uvs), 4, R"("componentType":5123,"type":"VEC2","normalized":true)") +
        R"(,"NORMAL":)" +
        accessor(octahedral, stride,
                 R"("type":"VEC3","normalized":true,"componentType":)" +
                     std::string(wide ? "5122" : "5120"),
                 "OCTAHEDRAL");
    file.indices = file.add(model.indices, 5125, "SCALAR", 1);
    file.more = kUsed;
    file.more_buffers = kFallback;
    const Mesh read = mesh_of(load(file.bytes()));
    ASSERT_EQ(read.vertices.size(), plain.vertices.size());
    // Half a step of each of two coordinates in -1..1, which the octahedron stretches by up to
    // 3^1.5 / 2, and half a step of each of three components that come out.
    const float step = 1.0f / static_cast<float>((1 << (bits - 1)) - 1);
    const float most =
        0.5f * step * std::sqrt(2.0f) * 2.6f + 0.5f * std::sqrt(3.0f) / (wide ? 32767.0f : 127.0f);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vertex &a = read.vertices[i], &b = plain.vertices[i];
      EXPECT_EQ(a.position, glm::vec3(b.position.x, b.position.y, 7.0f)) << i;
      EXPECT_NEAR(a.uv.x, b.uv.x, 0.5f / 65535.0f + 1e-7f) << i;
      EXPECT_NEAR(a.uv.y, b.uv.y, 0.5f / 65535.0f + 1e-7f) << i;
      EXPECT_LT(glm::distance(a.normal, b.normal), most) << i << ", " << bits << " bits";
    }
  }
}

TEST(GltfMeshopt, AnimationsWithQuaternionAndExponentialFilters) {
  constexpr std::uint32_t kKeys = 20;
  std::vector<float> times, turns, places;
  for (std::uint32_t i = 0; i < kKeys; ++i) {
    const auto t = static_cast<float>(i);
    const glm::vec4 q = glm::normalize(
        glm::vec4(std::sin(t), std::cos(2.0f * t), 0.3f * std::sin(3.0f * t), std::cos(t)));
    times.push_back(0.25f * t);
    turns.insert(turns.end(), {q.x, q.y, q.z, q.w});
    places.insert(places.end(), {100.0f * std::sin(t), 0.01f * t, -3.0f});
  }
  constexpr int kMantissa = 15, kQuaternionBits = 16;
  Bytes packed_turns(std::size_t{8} * kKeys);
  meshopt_encodeFilterQuat(packed_turns.data(), kKeys, 8, kQuaternionBits, turns.data());
  const Bytes packed_places = exponential(places, kMantissa);
  GltfFile file;
  const auto accessor = [&](const Bytes& values, std::size_t size, const std::string& members,
                            const std::string& filter = "") {
    return file.accessor(
        R"("bufferView":)" +
        add_view(file, encoded_vertices(values, size), kKeys, size, "ATTRIBUTES", filter, false) +
        R"(,"count":)" + std::to_string(kKeys) + "," + members);
  };
  const std::string input = accessor(bytes_of(times), 4, R"("componentType":5126,"type":"SCALAR")");
  const std::string rotation = accessor(
      packed_turns, 8, R"("componentType":5122,"type":"VEC4","normalized":true)", "QUATERNION");
  const std::string translation =
      accessor(packed_places, 12, R"("componentType":5126,"type":"VEC3")", "EXPONENTIAL");
  file.more = std::string(kUsed) + R"(,"animations":[{"channels":[)" +
              R"({"sampler":0,"target":{"node":0,"path":"rotation"}},)" +
              R"({"sampler":1,"target":{"node":0,"path":"translation"}}],"samplers":[{"input":)" +
              input + R"(,"output":)" + rotation + R"(},{"input":)" + input + R"(,"output":)" +
              translation + "}]}]";
  file.more_buffers = kFallback;
  const Scene scene = scene_of(load_animated(file.bytes()));
  const std::vector<Channel>& channels = scene.animations.at(0).channels;
  ASSERT_EQ(channels.size(), 2u);
  EXPECT_EQ(channels[0].times, times);
  for (std::uint32_t i = 0; i < kKeys; ++i) {
    const glm::vec4 expected(turns[4 * i], turns[4 * i + 1], turns[4 * i + 2], turns[4 * i + 3]);
    const glm::vec4& turn = channels[0].values.at(i);
    // Three components have 32,767 steps from 0 to sqrt(1/2), of which half a one is lost; the
    // fourth and largest one, at least 1/2, follows from them, and 16 bits hold what comes out.
    const float sign = glm::dot(turn, expected) < 0.0f ? -1.0f : 1.0f;
    EXPECT_LT(glm::length(sign * turn - expected), 1e-4f) << i;
    // A mantissa is at least half as large as 15 bits with a sign can hold, less half a step.
    const glm::vec4& at = channels[1].values.at(i);
    for (int c = 0; c < 3; ++c) {
      const float value = places[3 * i + static_cast<std::uint32_t>(c)];
      EXPECT_NEAR(at[c], value, std::abs(value) * std::ldexp(1.0f, 1 - kMantissa)) << i;
    }
  }
}

TEST(GltfMeshopt, AFallbackThatTheFileHasIsNotNeeded) {
  const CodecModel model;
  const std::string gone =
      R"(,{"byteLength":65536,"uri":"gone.bin","extensions":{"EXT_meshopt_compression":)"
      R"({"fallback":true}}})";
  expect_same_mesh(mesh_of(load_animated(file_of(model, Indices::kSequence, 4, gone))),
                   mesh_of(load_animated(model.plain())));
}

/// A quad whose indices come from a stream, with this extension object.
Bytes with_indices(const Bytes& stream, const std::string& members, std::size_t size_bytes = 12) {
  GltfFile file;
  const std::size_t at = file.add_bytes(stream);
  const std::string view =
      file.view(R"("buffer":1,"byteLength":)" + std::to_string(size_bytes) +
                R"(,"extensions":{"EXT_meshopt_compression":{"byteOffset":)" + std::to_string(at) +
                R"(,"byteLength":)" + std::to_string(stream.size()) + "," + members + "}}");
  file.indices = file.accessor(R"("bufferView":)" + view +
                               R"(,"componentType":5123,"type":"SCALAR","count":6)");
  file.more = kUsed;
  file.more_buffers = kFallback;
  return file.bytes();
}

TEST(GltfMeshopt, AFixedStreamOfIndices) {
  // Version 1 of the codec; a difference of 0, 1, 1, 0, -1, 2 as 4 times its size, plus 2 if it is
  // negative with 1 taken off before; four bytes of padding.
  const Bytes stream = {0xD1, 0, 4, 4, 0, 2, 8, 0, 0, 0, 0};
  const Scene scene = scene_of(
      load(with_indices(stream, R"("buffer":0,"byteStride":2,"count":6,"mode":"INDICES")")));
  const Mesh& mesh = scene.meshes.at(0);
  ASSERT_EQ(mesh.triangle_count(), 2u);
  const glm::vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  for (std::uint32_t i = 0; i < 6; ++i)
    EXPECT_EQ(mesh.corner(mesh.geometries[0], i / 3, i % 3).position, corners[i]) << i;
}

TEST(GltfMeshopt, WhatIsWrongIsNamed) {
  const Bytes good = encoded_sequence({0, 1, 2, 2, 1, 3}, 4);
  const std::string place = "bufferView 2, EXT_meshopt_compression: ";
  const auto refused = [&](const std::string& members, const std::string& what,
                           std::size_t size = 12) {
    expect_error(load(with_indices(good, members, size)), place + what);
  };
  ASSERT_TRUE(
      load(with_indices(good, R"("buffer":0,"byteStride":2,"count":6,"mode":"INDICES")")).ok());
  refused(R"("byteStride":2,"count":6,"mode":"INDICES")", "has no buffer, which glTF requires");
  refused(R"("buffer":5,"byteStride":2,"count":6,"mode":"INDICES")", "names buffer 5 of 2");
  refused(R"("buffer":0,"byteStride":2,"count":-6,"mode":"INDICES")", "count is -6");
  refused(R"("buffer":0,"byteStride":2,"count":4000000000,"mode":"INDICES")",
          "count is 4000000000, 0 to 134217728 are allowed");
  refused(R"("buffer":0,"byteStride":2,"count":6,"mode":"POINTS")",
          "mode is \"POINTS\", ATTRIBUTES, TRIANGLES and INDICES are allowed");
  refused(R"("buffer":0,"byteStride":3,"count":4,"mode":"INDICES")",
          "byteStride is 3, 2 and 4 are allowed");
  refused(R"("buffer":0,"byteStride":6,"count":2,"mode":"ATTRIBUTES")",
          "byteStride is 6, multiples of 4 from 4 to 256 are allowed");
  refused(R"("buffer":0,"byteStride":2,"count":5,"mode":"TRIANGLES")",
          "count is 5, multiples of 3 are allowed", 10);
  refused(R"("buffer":0,"byteStride":2,"count":6,"mode":"INDICES","filter":"EXPONENTIAL")",
          "has a filter, which only ATTRIBUTES may have");
  refused(R"("buffer":0,"byteStride":12,"count":1,"mode":"ATTRIBUTES","filter":"OCTAHEDRAL")",
          "byteStride is 12, 4 and 8 are allowed");
  refused(R"("buffer":0,"byteStride":4,"count":3,"mode":"ATTRIBUTES","filter":"QUATERNION")",
          "byteStride is 4, 8 is allowed");
  refused(R"("buffer":0,"byteStride":4,"count":3,"mode":"ATTRIBUTES","filter":"COLOR")",
          "filter is \"COLOR\", NONE, OCTAHEDRAL, QUATERNION and EXPONENTIAL are allowed");
  refused(R"("buffer":0,"byteStride":2,"count":7,"mode":"INDICES")",
          "count times byteStride are 14 bytes, the bufferView has 12");
  refused(R"("buffer":1,"byteStride":2,"count":6,"mode":"INDICES")", "spans 11 bytes");
  refused(R"("buffer":0,"byteStride":4,"count":6,"mode":"ATTRIBUTES")",
          "its stream is cut or damaged", 24);
  expect_error(
      load(with_indices({0xD1}, R"("buffer":0,"byteStride":2,"count":600,"mode":"INDICES")", 1200)),
      place + "its stream is cut: it has 1 bytes for 1200");
  // Indices that are no vertices come out of a sound stream.
  expect_error(load(with_indices(encoded_sequence({0, 1, 2, 2, 1, 9}, 10),
                                 R"("buffer":0,"byteStride":2,"count":6,"mode":"INDICES")")),
               "indices: element 5 is 9, the primitive has 4 vertices");
  GltfFile file;
  file.more = kUsed;
  file.more_buffers = kFallback;
  file.indices = file.accessor(R"("bufferView":)" + file.view(R"("buffer":1,"byteLength":6)") +
                               R"(,"componentType":5121,"type":"SCALAR","count":6)");
  expect_error(load(file.bytes()),
               "bufferView 2: has no EXT_meshopt_compression, and buffer 1 only");
}

TEST(GltfMeshopt, CutAndChangedStreamsNeverCrash) {
  const CodecModel model;
  const Bytes& positions = model.attributes[0].bytes;
  const std::uint32_t count = CodecModel::kCount;
  const auto one_stream = [&](const Bytes& stream, bool is_indices, const std::string& mode,
                              const std::string& filter) {
    GltfFile file;
    const std::size_t stride = is_indices ? 4 : 12;
    const std::size_t elements = is_indices ? model.indices.size() : count;
    const std::string view = add_view(file, stream, elements, stride, mode, filter, !is_indices);
    const std::string place = R"("bufferView":)" + view + ",";
    file.attributes = R"("POSITION":)" +
                      (is_indices ? file.add(positions, 5126, "VEC3", 12)
                                  : file.accessor(place + model.attributes[0].accessor(count)));
    file.indices = is_indices
                       ? file.accessor(place + R"("componentType":5125,"type":"SCALAR","count":)" +
                                       std::to_string(elements))
                       : file.add(model.indices, 5125, "SCALAR", 1);
    file.more = kUsed;
    file.more_buffers = kFallback;
    return file.bytes();
  };
  std::vector<float> values(positions.size() / 4);
  std::memcpy(values.data(), positions.data(), positions.size());
  const auto tried = [&](const Bytes& good, bool is_indices, const char* mode, const char* filter) {
    return count_refused(good, 600, [&](const Bytes& stream) {
      return one_stream(stream, is_indices, mode, filter);
    });
  };
  EXPECT_GE(tried(encoded_vertices(positions, 12), false, "ATTRIBUTES", ""), 150);
  EXPECT_GE(
      tried(encoded_vertices(exponential(values, 12), 12), false, "ATTRIBUTES", "EXPONENTIAL"),
      150);
  EXPECT_GE(tried(encoded_triangles(model.indices, count), true, "TRIANGLES", ""), 150);
  EXPECT_GE(tried(encoded_sequence(model.indices, count), true, "INDICES", ""), 150);
}

}  // namespace
}  // namespace kaamos::effects
#endif

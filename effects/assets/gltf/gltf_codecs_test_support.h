// SPDX-License-Identifier: MIT
// A model whose plain file and whose compressed one must load alike, for tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "effects/assets/gltf/gltf_test_support.h"

namespace kaamos::effects {

/// A vertex attribute, one element after the other.
struct ModelAttribute {
  std::string name;
  std::string type;  // of its accessor
  int component_type;
  std::uint32_t components;
  bool normalized;
  std::vector<std::uint8_t> bytes;

  std::size_t element_bytes(std::size_t count) const { return bytes.size() / count; }
  /// Members of its accessor, without a bufferView.
  std::string accessor(std::size_t count) const {
    return R"("componentType":)" + std::to_string(component_type) + R"(,"count":)" +
           std::to_string(count) + R"(,"type":")" + type + "\"" +
           (normalized ? R"(,"normalized":true)" : "");
  }
};

/// A hilly grid with every attribute that the loader reads.
struct CodecModel {
  static constexpr std::uint32_t kSide = 9;  // vertices
  static constexpr std::size_t kCount = std::size_t{kSide} * kSide;
  std::vector<ModelAttribute> attributes;
  std::vector<std::uint32_t> indices;

  CodecModel() {
    std::vector<float> positions, normals, tangents, uvs, second_uvs, weights;
    std::vector<std::uint8_t> colors;
    std::vector<std::uint16_t> joints;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const auto x = static_cast<float>(i % kSide), y = static_cast<float>(i / kSide);
      const glm::vec3 n = glm::normalize(glm::vec3(0.1f * x, 0.2f * y, 1.0f));
      const glm::vec3 t = glm::normalize(glm::cross(glm::vec3(0, 1, 0), n));
      positions.insert(positions.end(), {x, y, std::sin(0.7f * x) * std::cos(0.5f * y)});
      normals.insert(normals.end(), {n.x, n.y, n.z});
      tangents.insert(tangents.end(), {t.x, t.y, t.z, i % 2 == 0 ? 1.0f : -1.0f});
      uvs.insert(uvs.end(), {x / 8, y / 8});
      second_uvs.insert(second_uvs.end(), {y / 16, x / 16});
      colors.insert(colors.end(), {static_cast<std::uint8_t>(i), 128, 255, 200});
      joints.insert(joints.end(), {static_cast<std::uint16_t>(i % 2), 1, 0, 0});
      weights.insert(weights.end(), {0.75f, 0.25f, 0, 0});
    }
    add("POSITION", "VEC3", 5126, 3, positions);
    add("NORMAL", "VEC3", 5126, 3, normals);
    add("TANGENT", "VEC4", 5126, 4, tangents);
    add("TEXCOORD_0", "VEC2", 5126, 2, uvs);
    add("TEXCOORD_1", "VEC2", 5126, 2, second_uvs);
    add("COLOR_0", "VEC4", 5121, 4, colors, true);
    add("JOINTS_0", "VEC4", 5123, 4, joints);
    add("WEIGHTS_0", "VEC4", 5126, 4, weights);
    for (std::uint32_t y = 0; y + 1 < kSide; ++y) {
      for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
        const std::uint32_t a = y * kSide + x, b = a + kSide;
        indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
      }
    }
  }
  template <class T>
  void add(const std::string& name, const std::string& type, int component_type,
           std::uint32_t components, const std::vector<T>& values, bool normalized = false) {
    ModelAttribute& to = attributes.emplace_back(
        ModelAttribute{name, type, component_type, components, normalized, {}});
    to.bytes.resize(values.size() * sizeof(T));
    std::memcpy(to.bytes.data(), values.data(), to.bytes.size());
  }

  /// The rest of a file: a material that reads both sets of texture coordinates, and a skin.
  static void finish(GltfFile& file) {
    file.primitive += R"(,"material":0)";
    file.nodes = R"({"mesh":0,"skin":0},{},{})";
    file.more +=
        R"(,"skins":[{"joints":[1,2]}],"images":[{"uri":"data:image/png;base64,)"
        R"(iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJ)"
        R"(RU5ErkJggg=="}],"textures":[{"source":0}],"materials":[{"pbrMetallicRoughness":{)"
        R"("baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":0,"texCoord":1}}}])";
  }

  /// The uncompressed file.
  std::vector<std::uint8_t> plain() const {
    GltfFile file;
    file.attributes.clear();
    for (const ModelAttribute& from : attributes)
      file.attributes += (file.attributes.empty() ? "\"" : ",\"") + from.name + "\":" +
                         file.accessor(R"("bufferView":)" + file.add_view(from.bytes) + "," +
                                       from.accessor(kCount));
    file.indices = file.add(indices, 5125, "SCALAR", 1);
    finish(file);
    return file.bytes();
  }
};

/// The two meshes are the same, bit for bit.
inline void expect_same_mesh(const Mesh& a, const Mesh& b) {
  const auto same = [](const auto& x, const auto& y) {
    return x.size() == y.size() &&
           (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(x.front())) == 0);
  };
  EXPECT_TRUE(same(a.vertices, b.vertices));
  EXPECT_TRUE(same(a.skin, b.skin));
  EXPECT_TRUE(same(a.colors, b.colors));
  EXPECT_TRUE(same(a.second_uv, b.second_uv));
  EXPECT_TRUE(same(a.indices, b.indices));
}

}  // namespace kaamos::effects

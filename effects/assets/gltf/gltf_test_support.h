// SPDX-License-Identifier: MIT
// Small glTF files made in memory, for tests.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "effects/assets/gltf/gltf_load.h"
#include "effects/assets/image/png.h"

namespace kaamos::effects {

/// A small .glb put together by hand: `json`, with its bytes as buffer 0.
class Glb {
 public:
  /// Appends values at a multiple of 4 bytes and returns the offset.
  template <class T>
  std::size_t add(const std::vector<T>& values) {
    data_.resize((data_.size() + 3) / 4 * 4, 0);
    const std::size_t offset = data_.size();
    const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());
    data_.insert(data_.end(), first, first + values.size() * sizeof(T));
    return offset;
  }
  std::size_t size() const { return data_.size(); }

  /// `body` is the JSON object without asset, buffers and its outer braces. `more_buffers` are
  /// objects behind that of buffer 0, each preceded by a comma.
  std::vector<std::uint8_t> bytes(const std::string& body,
                                  const std::string& more_buffers = "") const {
    std::vector<std::uint8_t> data = data_;
    data.resize((data.size() + 3) / 4 * 4, 0);
    std::string json = "{\"asset\":{\"version\":\"2.0\"}," + body +
                       ",\"buffers\":[{\"byteLength\":" + std::to_string(data.size()) + "}" +
                       more_buffers + "]}";
    while (json.size() % 4 != 0) json += ' ';
    std::vector<std::uint8_t> out;
    const auto word = [&](std::uint32_t v) {
      for (int i = 0; i < 4; ++i) out.push_back(static_cast<std::uint8_t>(v >> (8 * i)));
    };
    word(0x46546C67u);
    word(2);
    word(static_cast<std::uint32_t>(28 + json.size() + data.size()));
    word(static_cast<std::uint32_t>(json.size()));
    word(0x4E4F534Au);
    out.insert(out.end(), json.begin(), json.end());
    word(static_cast<std::uint32_t>(data.size()));
    word(0x004E4942u);
    out.insert(out.end(), data.begin(), data.end());
    return out;
  }

 private:
  std::vector<std::uint8_t> data_;
};

inline Result<LoadedScene> load(const std::vector<std::uint8_t>& bytes) {
  return load_gltf_memory(bytes, "test.glb");
}

inline Result<LoadedScene> load_text(const std::string& text) {
  return load_gltf_memory(
      std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), "test.gltf");
}

inline void expect_error(const Result<LoadedScene>& result, const std::string& part) {
  ASSERT_FALSE(result.ok()) << "wanted: " << part;
  EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
  EXPECT_NE(result.error().message.find("test."), std::string::npos) << "names the file";
}

inline const std::vector<float> kQuad = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

/// One quad, with parts of its JSON that tests replace.
struct QuadFile {
  std::string positions = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";
  std::string indices = R"({"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"})";
  std::string views = R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":6})";
  std::string primitive = R"({"attributes":{"POSITION":0},"indices":1})";
  std::string nodes = R"([{"mesh":0}])";
  std::string more;  ///< further members, each preceded by a comma

  std::vector<std::uint8_t> bytes() const {
    Glb glb;
    glb.add(kQuad);
    glb.add(std::vector<std::uint8_t>{0, 1, 2, 2, 1, 3});
    return glb.bytes("\"accessors\":[" + positions + "," + indices + "],\"bufferViews\":[" + views +
                     "],\"meshes\":[{\"name\":\"quad\",\"primitives\":[" + primitive +
                     "]}],\"nodes\":" + nodes + more);
  }
};

/// A quad with a 2 x 1 texture of these RGBA texels.
inline std::vector<std::uint8_t> textured_with(const std::vector<std::uint8_t>& texels,
                                               const std::string& material,
                                               const std::string& extra = "") {
  Glb glb;
  glb.add(kQuad);
  glb.add(std::vector<std::uint8_t>{0, 1, 2, 2, 1, 3});
  ByteImage image;
  image.width = 2;
  image.height = 1;
  image.channels = 4;
  image.values = texels;
  const std::vector<std::uint8_t> png = encode_png(image).value();
  const std::size_t at = glb.add(png);
  return glb.bytes(
      "\"accessors\":[" + QuadFile{}.positions + "," + QuadFile{}.indices + "],\"bufferViews\":[" +
      QuadFile{}.views + ",{\"buffer\":0,\"byteOffset\":" + std::to_string(at) +
      ",\"byteLength\":" + std::to_string(png.size()) +
      "}],\"images\":[{\"bufferView\":2,\"mimeType\":\"image/png\"}],\"textures\":[{\"source\":0,"
      "\"sampler\":0}],\"samplers\":[{\"wrapS\":33071,\"wrapT\":33648,\"magFilter\":9728,"
      "\"minFilter\":9729}],\"materials\":[" +
      material +
      "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":"
      "0}]}],\"nodes\":[{\"mesh\":0}]" +
      extra);
}

/// The same with one opaque and one clear texel.
inline std::vector<std::uint8_t> textured(const std::string& material,
                                          const std::string& extra = "") {
  return textured_with({200, 100, 50, 255, 0, 0, 0, 0}, material, extra);
}

/// A file of accessors that lie one after the other in its buffer. Accessor 0 is the quad's
/// positions, 1 its indices.
class GltfFile {
 public:
  GltfFile() {
    add(kQuad, 5126, "VEC3", 3);
    add(std::vector<std::uint8_t>{0, 1, 2, 2, 1, 3}, 5121, "SCALAR", 1);
  }
  /// Returns the accessor's number as text.
  template <class T>
  std::string add(const std::vector<T>& values, int component_type, const std::string& type,
                  std::size_t components, bool normalized = false) {
    return accessor(R"("bufferView":)" + add_view(values) + R"(,"componentType":)" +
                    std::to_string(component_type) + R"(,"count":)" +
                    std::to_string(values.size() / components) + R"(,"type":")" + type + "\"" +
                    (normalized ? R"(,"normalized":true)" : ""));
  }
  /// Returns the number of a bufferView of these values, as text.
  template <class T>
  std::string add_view(const std::vector<T>& values) {
    return view(R"("buffer":0,"byteOffset":)" + std::to_string(add_bytes(values)) +
                R"(,"byteLength":)" + std::to_string(values.size() * sizeof(T)));
  }
  /// Returns where the values begin in buffer 0.
  template <class T>
  std::size_t add_bytes(const std::vector<T>& values) {
    return glb_.add(values);
  }
  std::string view(const std::string& members) {
    append(views_, "{" + members + "}");
    return std::to_string(count_views_++);
  }
  std::string accessor(const std::string& members) {
    append(accessors_, "{" + members + "}");
    return std::to_string(count_accessors_++);
  }
  std::string attributes = R"("POSITION":0)";
  std::string indices = "1";
  std::string primitive;  // further members of it, each preceded by a comma
  std::string mesh;       // of the mesh
  std::string nodes = R"({"mesh":0})";
  std::string more;  // of the file
  std::string more_buffers;

  std::vector<std::uint8_t> bytes() const {
    return glb_.bytes("\"accessors\":[" + accessors_ + "],\"bufferViews\":[" + views_ +
                          R"(],"meshes":[{"primitives":[{"attributes":{)" + attributes +
                          R"(},"indices":)" + indices + primitive + "}]" + mesh +
                          R"(}],"nodes":[)" + nodes + "]" + more,
                      more_buffers);
  }

 private:
  static void append(std::string& list, const std::string& item) {
    list += (list.empty() ? "" : ",") + item;
  }
  Glb glb_;
  std::string accessors_, views_;
  int count_accessors_ = 0, count_views_ = 0;
};

inline Scene scene_of(const Result<LoadedScene>& loaded) {
  EXPECT_TRUE(loaded.ok()) << loaded.error().message;
  return loaded.ok() ? loaded.value().scene : Scene{};
}

inline void expect_warning(const Result<LoadedScene>& loaded, const std::string& part) {
  ASSERT_TRUE(loaded.ok()) << loaded.error().message;
  bool found = false;
  std::string all;
  for (const std::string& warning : loaded.value().warnings) {
    found |= warning.find(part) != std::string::npos;
    all += warning + "\n";
  }
  EXPECT_TRUE(found) << "wanted: " << part << "\n" << all;
}

inline Result<LoadedScene> load_animated(const std::vector<std::uint8_t>& bytes) {
  return load_gltf_memory(bytes, "test.glb", ".", {.animated = true});
}

}  // namespace kaamos::effects

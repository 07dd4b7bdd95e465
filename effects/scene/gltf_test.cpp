// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>

#include "effects/common/file.h"
#include "effects/common/sampling.h"
#include "effects/image/png.h"
#include "effects/scene/gltf_load.h"
#include "effects/scene/gltf_write.h"
#include "effects/scene/lounge.h"

namespace kaamos::effects {
namespace {

/// A small .glb put together by hand: `json` with its bytes as buffer 0.
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

  /// `body` is the JSON object without asset, buffers and its outer braces.
  std::vector<std::uint8_t> bytes(const std::string& body) const {
    std::vector<std::uint8_t> data = data_;
    data.resize((data.size() + 3) / 4 * 4, 0);
    std::string json = "{\"asset\":{\"version\":\"2.0\"}," + body +
                       ",\"buffers\":[{\"byteLength\":" + std::to_string(data.size()) + "}]}";
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

Result<LoadedScene> load(const std::vector<std::uint8_t>& bytes) {
  return load_gltf_memory(bytes, "test.glb");
}

Result<LoadedScene> load_text(const std::string& text) {
  return load_gltf_memory(
      std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), "test.gltf");
}

void expect_error(const Result<LoadedScene>& result, const std::string& part) {
  ASSERT_FALSE(result.ok()) << "wanted: " << part;
  EXPECT_NE(result.error().find(part), std::string::npos) << result.error();
  EXPECT_NE(result.error().find("test."), std::string::npos) << "names the file";
}

const std::vector<float> kQuad = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

/// One quad; what varies are the JSON of its accessors and what stands beside them.
struct QuadFile {
  std::string positions = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"})";
  std::string indices = R"({"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"})";
  std::string views = R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":6})";
  std::string primitive = R"({"attributes":{"POSITION":0},"indices":1})";
  std::string nodes = R"([{"mesh":0}])";
  std::string more;  ///< further members, each with a comma before it

  std::vector<std::uint8_t> bytes() const {
    Glb glb;
    glb.add(kQuad);
    glb.add(std::vector<std::uint8_t>{0, 1, 2, 2, 1, 3});
    return glb.bytes("\"accessors\":[" + positions + "," + indices + "],\"bufferViews\":[" + views +
                     "],\"meshes\":[{\"name\":\"quad\",\"primitives\":[" + primitive +
                     "]}],\"nodes\":" + nodes + more);
  }
};

TEST(GltfLoad, QuadWithoutAnythingElse) {
  const auto loaded = load(QuadFile{}.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  const Scene& scene = loaded.value().scene;
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].name, "quad");
  EXPECT_EQ(scene.meshes[0].triangle_count(), 2u);
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.materials.size(), 1u) << "the default material";
  EXPECT_EQ(scene.cameras.size(), 1u) << "one that frames the scene";
  EXPECT_TRUE(scene.sun.has_value());
  EXPECT_GT(scene.sky.zenith.z, 0.0f);
  for (const Vertex& vertex : scene.meshes[0].vertices)
    EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1)) << "flat normals where the file has none";
  EXPECT_TRUE(loaded.value().warnings.empty());
}

TEST(GltfLoad, NonIndexedStripsAndFans) {
  const auto triangles = [](const std::string& primitive) {
    QuadFile file;
    file.primitive = primitive;
    const auto loaded = load(file.bytes());
    EXPECT_TRUE(loaded.ok()) << loaded.error();
    return loaded.ok() ? loaded.value().scene : Scene{};
  };
  EXPECT_EQ(unique_triangle_count(triangles(R"({"attributes":{"POSITION":0}})")), 1u)
      << "4 vertices are one triangle and a rest";
  for (const char* mode : {"5", "6"}) {
    const Scene scene =
        triangles(std::string(R"({"attributes":{"POSITION":0},"mode":)") + mode + "}");
    ASSERT_EQ(unique_triangle_count(scene), 2u);
    // The strip 0 1 2 3 of the quad turns the same way throughout; the fan's second triangle folds.
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.corner(mesh.geometries[0], 0, 0).normal.z, 1.0f);
    EXPECT_EQ(mesh.corner(mesh.geometries[0], 1, 0).normal.z, mode[0] == '5' ? 1.0f : -1.0f);
  }
}

TEST(GltfLoad, PointsAreLeftOutWithAWarning) {
  QuadFile file;
  file.primitive =
      R"({"attributes":{"POSITION":0},"mode":0},{"attributes":{"POSITION":0},"mode":4})";
  const auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  EXPECT_EQ(loaded.value().scene.meshes[0].geometries.size(), 1u);
  ASSERT_EQ(loaded.value().warnings.size(), 1u);
  EXPECT_NE(loaded.value().warnings[0].find("points or lines"), std::string::npos);
}

/// Positions given with one integer component type, normalised or not.
template <class T>
glm::vec3 largest_position(int component_type, bool normalized) {
  Glb glb;
  const T one = std::numeric_limits<T>::max();
  const std::size_t stride = (3 * sizeof(T) + 3) / 4 * 4 / sizeof(T);
  std::vector<T> values(stride * 3, T{0});
  values[0] = one;
  values[stride + 1] = one;
  values[2 * stride + 2] = one;
  glb.add(values);
  const auto loaded = load(glb.bytes(
      "\"accessors\":[{\"bufferView\":0,\"componentType\":" + std::to_string(component_type) +
      ",\"count\":3,\"type\":\"VEC3\",\"normalized\":" + (normalized ? "true" : "false") +
      "}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":" + std::to_string(glb.size()) +
      ",\"byteStride\":" + std::to_string(stride * sizeof(T)) +
      "}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":"
      "0}]"));
  EXPECT_TRUE(loaded.ok()) << loaded.error();
  if (!loaded.ok()) return glm::vec3(0.0f);
  const Bounds box = scene_bounds(loaded.value().scene);
  return glm::vec3(box.max);
}

TEST(GltfLoad, EveryComponentType) {
  EXPECT_EQ(largest_position<std::int8_t>(5120, false), glm::vec3(127));
  EXPECT_EQ(largest_position<std::uint8_t>(5121, false), glm::vec3(255));
  EXPECT_EQ(largest_position<std::int16_t>(5122, false), glm::vec3(32767));
  EXPECT_EQ(largest_position<std::uint16_t>(5123, false), glm::vec3(65535));
  EXPECT_EQ(largest_position<std::uint32_t>(5125, false), glm::vec3(4294967296.0f));
  EXPECT_EQ(largest_position<std::int8_t>(5120, true), glm::vec3(1));
  EXPECT_EQ(largest_position<std::uint8_t>(5121, true), glm::vec3(1));
  EXPECT_EQ(largest_position<std::int16_t>(5122, true), glm::vec3(1));
  EXPECT_EQ(largest_position<std::uint16_t>(5123, true), glm::vec3(1));
}

TEST(GltfLoad, SparseAccessorReplacesElements) {
  Glb glb;
  glb.add(kQuad);
  const std::size_t ids = glb.add(std::vector<std::uint16_t>{1, 3});
  const std::size_t values = glb.add(std::vector<float>{9, 0, 0, 9, 9, 0});
  const auto file = [&](const std::string& base, const std::string& count) {
    return glb.bytes(
        "\"accessors\":[{" + base +
        "\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"sparse\":{\"count\":" + count +
        ",\"indices\":{\"bufferView\":1,\"componentType\":5123},\"values\":{\"bufferView\":2}}}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},{\"buffer\":0,\"byteOffset\":" +
        std::to_string(ids) +
        ",\"byteLength\":4},{\"buffer\":0,\"byteOffset\":" + std::to_string(values) +
        ",\"byteLength\":24}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
        "\"mode\":5}]}],\"nodes\":[{\"mesh\":0}]");
  };
  const auto replaced = load(file("\"bufferView\":0,", "2"));
  ASSERT_TRUE(replaced.ok()) << replaced.error();
  EXPECT_EQ(scene_bounds(replaced.value().scene).max, glm::dvec3(9, 9, 0));
  const auto zeros = load(file("", "2"));
  ASSERT_TRUE(zeros.ok()) << zeros.error();
  EXPECT_EQ(scene_bounds(zeros.value().scene).min, glm::dvec3(0, 0, 0));
  expect_error(load(file("\"bufferView\":0,", "3")), "sparse indices: needs 6 bytes");
  expect_error(load(file("\"bufferView\":0,", "5")), "sparse: count is 5, 0..4");
}

TEST(GltfLoad, NodeTransformsMultiply) {
  QuadFile file;
  file.nodes = R"([{"children":[1],"translation":[10,0,0],"rotation":[0,0,0.70710678,0.70710678]},)"
               R"({"mesh":0,"scale":[2,-3,1],"translation":[1,0,0]},)"
               R"({"mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,1,0, 5,6,7,1]}])";
  const auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  ASSERT_EQ(loaded.value().scene.instances.size(), 2u);
  const Instance& first = loaded.value().scene.instances[0];
  // (1,1,0) -> scaled (2,-3,0) -> moved (3,-3,0) -> turned a quarter (3,3,0) -> moved (13,3,0).
  const glm::dvec4 p = first.transform * glm::dvec4(1, 1, 0, 1);
  EXPECT_NEAR(p.x, 13.0, 1e-6);
  EXPECT_NEAR(p.y, 3.0, 1e-6);
  EXPECT_TRUE(is_mirrored(first));
  EXPECT_EQ(glm::dvec3(loaded.value().scene.instances[1].transform[3]), glm::dvec3(5, 6, 7));
}

TEST(GltfLoad, SingularInstancesAreLeftOut) {
  QuadFile file;
  file.nodes = R"([{"mesh":0,"scale":[0,1,1],"name":"flat"},{"mesh":0}])";
  const auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  EXPECT_EQ(loaded.value().scene.instances.size(), 1u);
  ASSERT_EQ(loaded.value().warnings.size(), 1u);
  EXPECT_NE(loaded.value().warnings[0].find("flat"), std::string::npos);
}

/// A quad with a 2 x 1 texture of one opaque and one clear texel.
std::vector<std::uint8_t> textured(const std::string& material, const std::string& extra = "") {
  Glb glb;
  glb.add(kQuad);
  glb.add(std::vector<std::uint8_t>{0, 1, 2, 2, 1, 3});
  ByteImage image;
  image.width = 2;
  image.height = 1;
  image.channels = 4;
  image.values = {200, 100, 50, 255, 0, 0, 0, 0};
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

const MaterialConstants& material_of(const Result<LoadedScene>& loaded) {
  return loaded.value().scene.materials.at(0).constants;
}

TEST(GltfLoad, MaterialsAndTextures) {
  const auto loaded = load(textured(
      R"({"name":"m","doubleSided":true,"emissiveFactor":[0.5,1,0],"extensions":{)"
      R"("KHR_materials_emissive_strength":{"emissiveStrength":4}},"pbrMetallicRoughness":{)"
      R"("baseColorFactor":[0.1,0.2,0.3,0.4],"metallicFactor":0.5,"roughnessFactor":0.25,)"
      R"("baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{)"
      R"("offset":[0.25,0.5],"rotation":1.5707963267948966,"scale":[2,3]}}}}})"));
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  const MaterialConstants& m = material_of(loaded);
  EXPECT_EQ(m.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(m.emissive, glm::vec3(2, 4, 0));
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.roughness, 0.25f);
  EXPECT_EQ(m.flags, kMaterialDoubleSided);
  ASSERT_EQ(m.image[kBaseColorTexture], 0);
  EXPECT_EQ(m.image[kNormalTexture], kNoTexture);
  const Scene& scene = loaded.value().scene;
  EXPECT_TRUE(scene.images[0].srgb);
  EXPECT_EQ(scene.images[0].mips[0][1], 100);
  const Sampler& sampler = scene.samplers.at(m.sampler[kBaseColorTexture]);
  EXPECT_EQ(sampler.wrap_u, Wrap::kClamp);
  EXPECT_EQ(sampler.wrap_v, Wrap::kMirror);
  EXPECT_EQ(sampler.mag_filter, Filter::kNearest);
  EXPECT_FALSE(sampler.mipmapped);
  // A quarter turn maps u to -v: (1, 0) scaled to (2, 0) becomes (0, -2).
  const glm::vec4& t = m.uv_matrix[kBaseColorTexture];
  EXPECT_NEAR(t.x, 0.0f, 1e-6f);
  EXPECT_NEAR(t.z, -2.0f, 1e-6f);
  EXPECT_NEAR(t.y, 3.0f, 1e-6f);
  EXPECT_EQ(m.uv_offset[kBaseColorTexture], glm::vec2(0.25f, 0.5f));
}

TEST(GltfLoad, AlphaModes) {
  const std::string texture = R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}})";
  const auto mask = load(textured(R"({"alphaMode":"MASK","alphaCutoff":0.3,)" + texture + "}"));
  ASSERT_TRUE(mask.ok()) << mask.error();
  EXPECT_EQ(material_of(mask).flags, kMaterialMask | kMaterialAlphaTested);
  EXPECT_EQ(material_of(mask).alpha_cutoff, 0.3f);
  EXPECT_TRUE(mask.value().scene.meshes[0].geometries[0].alpha_tested);

  const auto blend = load(textured(R"({"alphaMode":"BLEND",)" + texture + "}"));
  ASSERT_TRUE(blend.ok()) << blend.error();
  EXPECT_EQ(material_of(blend).flags, kMaterialBlend | kMaterialAlphaTested);
  EXPECT_EQ(material_of(blend).alpha_cutoff, 0.5f) << "shadow rays know open or closed";
  EXPECT_EQ(blend.value().scene.instances[0].mask, kMaskOpaque);

  const auto glass = load(textured(R"({"alphaMode":"BLEND"})"));
  ASSERT_TRUE(glass.ok()) << glass.error();
  EXPECT_EQ(material_of(glass).flags, kMaterialBlend);
  EXPECT_FALSE(glass.value().scene.meshes[0].geometries[0].alpha_tested);
  EXPECT_EQ(glass.value().scene.instances[0].mask, kMaskTransparent);

  const auto opaque = load(textured("{" + texture + "}"));
  ASSERT_TRUE(opaque.ok()) << opaque.error();
  EXPECT_FALSE(opaque.value().scene.meshes[0].geometries[0].alpha_tested);
  expect_error(load(textured(R"({"alphaMode":"HOLES"})")), "OPAQUE, MASK and BLEND are allowed");
}

TEST(GltfLoad, CamerasAndLights) {
  QuadFile file;
  file.nodes =
      R"([{"mesh":0},{"camera":0,"translation":[0,2,9],"scale":[3,3,3]},)"
      R"({"extensions":{"KHR_lights_punctual":{"light":0}},"rotation":[-0.70710678,0,0,0.70710678]},)"
      R"({"extensions":{"KHR_lights_punctual":{"light":1}},"translation":[1,2,3]}])";
  file.more =
      R"(,"cameras":[{"type":"perspective","name":"c","perspective":{"yfov":0.7,"znear":0.1}}],)"
      R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[)"
      R"({"type":"directional","intensity":5,"color":[1,0.5,0.25]},)"
      R"({"type":"spot","intensity":7,"range":4,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.5}}]}})";
  const auto loaded = load(file.bytes());
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  const Scene& scene = loaded.value().scene;
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].vertical_fov, 0.7);
  EXPECT_EQ(scene.cameras[0].position(), glm::dvec3(0, 2, 9));
  EXPECT_NEAR(scene.cameras[0].forward().z, -1.0, 1e-9);
  // Light travels along -z, turned by -90 degrees about x: downwards.
  EXPECT_NEAR(scene.sun->direction_to_sun.y, 1.0f, 1e-6f);
  EXPECT_EQ(scene.sun->irradiance, glm::vec3(5, 2.5f, 1.25f));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].type, LightType::kSpot);
  EXPECT_EQ(scene.lights[0].position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.lights[0].outer_cone_angle, 0.5f);
}

TEST(GltfLoad, SkinnedMeshesStandInTheirPose) {
  Glb glb;
  glb.add(kQuad);
  // The lower two vertices go with joint 0, the upper two half with each.
  const std::size_t joints =
      glb.add(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
  const std::size_t weights =
      glb.add(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.5f, 0.5f, 0, 0});
  const auto file = [&](const std::string& skin_joints) {
    return glb.bytes(
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
        R"({"bufferView":1,"componentType":5121,"count":4,"type":"VEC4"},)"
        R"({"bufferView":2,"componentType":5126,"count":4,"type":"VEC4"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":)" +
        std::to_string(joints) + R"(,"byteLength":16},{"buffer":0,"byteOffset":)" +
        std::to_string(weights) +
        R"(,"byteLength":64}],)"
        R"("meshes":[{"primitives":[{"mode":5,"attributes":{"POSITION":0,"JOINTS_0":1,)"
        R"("WEIGHTS_0":2}}]}],"skins":[{"joints":)" +
        skin_joints +
        R"(}],"nodes":[{"mesh":0,"skin":0,"translation":[50,0,0]},{"translation":[0,0,1]},)"
        R"({"translation":[0,4,0]}])");
  };
  const auto loaded = load(file("[1,2]"));
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  const Bounds box = scene_bounds(loaded.value().scene);
  // The node's own transform does not count. Upper vertices: mean of (y+0, 1) and (y+4, 0).
  EXPECT_EQ(box.min, glm::dvec3(0, 0, 0.5));
  EXPECT_EQ(box.max, glm::dvec3(1, 3, 1));
  EXPECT_EQ(loaded.value().scene.meshes.size(), 1u) << "the bind pose is not kept";
  expect_error(load(file("[1]")), "names joint 1 of 1");
  expect_error(load(file("[1,9]")), "names joint node 9 of 3");
}

TEST(GltfBroken, SaysWhatAndWhere) {
  QuadFile file;
  file.positions = R"({"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"})";
  expect_error(load(file.bytes()),
               "mesh 0 \"quad\", primitive 0, POSITION, accessor 0: needs 60 bytes from byte 0 of "
               "bufferView 0, which has 48");
  file = {};
  file.positions = R"({"bufferView":7,"componentType":5126,"count":4,"type":"VEC3"})";
  expect_error(load(file.bytes()), "bufferView 7 of 2");
  file = {};
  file.positions = R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC4"})";
  expect_error(load(file.bytes()), "has 4 components, 3 are expected");
  file = {};
  file.positions = R"({"bufferView":0,"componentType":99,"count":4,"type":"VEC3"})";
  expect_error(load(file.bytes()), "Got 99");
  file = {};
  file.positions = R"({"componentType":5126,"count":4000000000,"type":"VEC3"})";
  expect_error(load(file.bytes()), "4000000000 elements");
  file = {};
  file.positions =
      R"({"bufferView":0,"byteOffset":18446744073709551600,"componentType":5126,"count":4,"type":"VEC3"})";
  EXPECT_FALSE(load(file.bytes()).ok()) << "the sum overflows";
  file = {};
  file.indices = R"({"bufferView":0,"componentType":5126,"count":6,"type":"SCALAR"})";
  expect_error(load(file.bytes()), "indices are 1 component of type 5121, 5123 or 5125");
  file = {};
  file.indices = R"({"bufferView":0,"componentType":5121,"count":48,"type":"SCALAR"})";
  expect_error(load(file.bytes()), "the primitive has 4 vertices");
  file = {};
  file.views = R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":9999,"byteLength":6})";
  expect_error(load(file.bytes()), "bufferView 1 spans 6 bytes from byte 9999");
  file = {};
  file.views = R"({"buffer":3,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":6})";
  expect_error(load(file.bytes()), "names buffer 3 of 1");
  file = {};
  file.primitive = R"({"attributes":{"POSITION":0,"NORMAL":9},"indices":1})";
  expect_error(load(file.bytes()), "NORMAL: names accessor 9 of 2");
  file = {};
  file.primitive = R"({"attributes":{"POSITION":0},"indices":1,"material":2})";
  expect_error(load(file.bytes()), "names material 2 of 0");
  file = {};
  file.nodes = R"([{"mesh":4}])";
  expect_error(load(file.bytes()), "mesh 4 of 1");
  file = {};
  file.nodes = R"([{"mesh":0,"children":[1]},{"children":[0]}])";
  EXPECT_FALSE(load(file.bytes()).ok()) << "a cycle without a root shows nothing";
  file.more = R"(,"scenes":[{"nodes":[0]}])";
  expect_error(load(file.bytes()), "is reached twice");
  file.more = R"(,"scene":3,"scenes":[{"nodes":[0]}])";
  expect_error(load(file.bytes()), "scene 3 of 1");
  file = {};
  file.more =
      R"(,"extensionsUsed":["KHR_draco_mesh_compression"],"extensionsRequired":["KHR_draco_mesh_compression"])";
  expect_error(load(file.bytes()), "KHR_draco_mesh_compression");
  file = {};
  file.nodes = "[{}]";
  expect_error(load(file.bytes()), "shows no triangles");
}

TEST(GltfBroken, ImagesOutsideTheirBufferOrDamaged) {
  std::vector<std::uint8_t> bytes =
      textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  const std::string good(bytes.begin(), bytes.end());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    EXPECT_EQ(from.size(), to.size());
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    return load(std::vector<std::uint8_t>(text.begin(), text.end()));
  };
  ASSERT_TRUE(load(bytes).ok());
  expect_error(with("IHDR", "JHDR"), "image 0");
  expect_error(with("\"byteOffset\":56,", "\"byteOffset\":99,"), "image 0");
  expect_error(with("\"source\":0", "\"source\":7"), "image 7 of 1");
  expect_error(with("\"sampler\":0", "\"sampler\":5"), "sampler 5 of 1");
  expect_error(with("\"index\":0", "\"index\":8"), "texture 8 of 1");
}

TEST(GltfBroken, NotAGltfFile) {
  expect_error(load_text(""), "neither");
  expect_error(load_text("hello"), "neither");
  EXPECT_FALSE(load_text("{").ok());
  EXPECT_FALSE(load_text("{}").ok());
  EXPECT_FALSE(load_text("{\"asset\":7}").ok());
  EXPECT_FALSE(load_text("{\"asset\":{\"version\":\"2.0\"},\"meshes\":{\"a\":1}}").ok());
  EXPECT_FALSE(load_text("{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":\"x\"}]}").ok());
  expect_error(load_text("{\"a\":" + std::string(100000, '[')), "nested deeper");
  const auto missing = load_gltf("no/such/scene.gltf");
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().find("no/such/scene.gltf"), std::string::npos);
  const auto buffer =
      load_text(R"({"asset":{"version":"2.0"},"buffers":[{"uri":"gone.bin","byteLength":4}]})");
  expect_error(buffer, "gone.bin");
}

TEST(GltfBroken, CutAndChangedFilesNeverCrash) {
  const std::vector<std::uint8_t> good =
      textured(R"({"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  ASSERT_TRUE(load(good).ok());
  for (std::size_t size = 0; size < good.size(); size += 3)
    EXPECT_FALSE(load({good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)}).ok())
        << size;
  int refused = 0;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    std::vector<std::uint8_t> bytes = good;
    for (std::uint32_t k = 0; k <= i % 3; ++k) {
      const std::uint32_t h = hash_combine(i, k);
      bytes[h % bytes.size()] = static_cast<std::uint8_t>(pcg_hash(h) >> 24);
    }
    const auto loaded = load(bytes);
    refused += !loaded.ok();
    if (loaded.ok()) {
      EXPECT_TRUE(validate(loaded.value().scene).ok()) << i;
    } else {
      EXPECT_FALSE(loaded.error().empty());
    }
  }
  EXPECT_GT(refused, 1000);
}

void expect_same_geometry(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t m = 0; m < a.meshes.size(); ++m) {
    ASSERT_EQ(a.meshes[m].geometries.size(), b.meshes[m].geometries.size()) << a.meshes[m].name;
    ASSERT_EQ(a.meshes[m].vertices.size(), b.meshes[m].vertices.size()) << a.meshes[m].name;
    EXPECT_EQ(a.meshes[m].indices, b.meshes[m].indices) << a.meshes[m].name;
    for (std::size_t v = 0; v < a.meshes[m].vertices.size(); ++v) {
      const Vertex& x = a.meshes[m].vertices[v];
      const Vertex& y = b.meshes[m].vertices[v];
      ASSERT_EQ(x.position, y.position);
      ASSERT_EQ(x.uv, y.uv);
      ASSERT_GT(glm::dot(x.normal, y.normal), 0.99999f);
      ASSERT_GT(glm::dot(x.tangent, y.tangent), 1.9999f);
    }
  }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].name, b.instances[i].name);
    EXPECT_EQ(a.instances[i].mesh, b.instances[i].mesh);
    EXPECT_EQ(a.instances[i].transform, b.instances[i].transform);
  }
}

TEST(GltfWrite, TheLoungeComesBack) {
  const Scene lounge = make_lounge();
  const auto bytes = encode_glb(lounge);
  ASSERT_TRUE(bytes.ok()) << bytes.error();
  const auto loaded = load(bytes.value());
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  const Scene& back = loaded.value().scene;
  EXPECT_TRUE(loaded.value().warnings.empty());
  expect_same_geometry(lounge, back);
  ASSERT_EQ(back.materials.size(), lounge.materials.size() + 1) << "and the default material";
  for (std::size_t i = 0; i < lounge.materials.size(); ++i) {
    const MaterialConstants& x = lounge.materials[i].constants;
    const MaterialConstants& y = back.materials[i].constants;
    EXPECT_EQ(lounge.materials[i].name, back.materials[i].name);
    EXPECT_EQ(x.base_color, y.base_color);
    EXPECT_EQ(x.flags, y.flags) << lounge.materials[i].name;
    EXPECT_NEAR(glm::distance(x.emissive, y.emissive), 0.0f, 1e-4f);
    for (std::uint32_t slot = 0; slot < kTextureSlotCount; ++slot) {
      ASSERT_EQ(x.image[slot] == kNoTexture, y.image[slot] == kNoTexture);
      if (x.image[slot] == kNoTexture) continue;
      EXPECT_EQ(lounge.images[static_cast<std::size_t>(x.image[slot])].mips[0],
                back.images[static_cast<std::size_t>(y.image[slot])].mips[0]);
      EXPECT_EQ(x.uv_matrix[slot], y.uv_matrix[slot]);
    }
  }
  ASSERT_EQ(back.cameras.size(), lounge.cameras.size());
  EXPECT_NEAR(glm::distance(back.cameras[0].position(), lounge.cameras[0].position()), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(back.cameras[0].forward(), lounge.cameras[0].forward()), 0.0, 1e-9);
  EXPECT_NEAR(glm::dot(back.sun->direction_to_sun, lounge.sun->direction_to_sun), 1.0f, 1e-6f);
  EXPECT_NEAR(back.sun->irradiance.x, lounge.sun->irradiance.x, 1e-4f);
  EXPECT_EQ(back.lights.size(), lounge.lights.size());
}

TEST(GltfWrite, RefusesABrokenSceneAndKeepsTheEarlierFile) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("kaamos-" + std::to_string(::getpid()) + ".glb"))
          .string();
  Scene scene = load(QuadFile{}.bytes()).value().scene;
  ASSERT_TRUE(write_glb(path, scene).ok());
  const auto before = read_file(path);
  scene.instances[0].mesh = 5;
  const Status status = write_glb(path, scene);
  EXPECT_NE(status.error().find("mesh 5 of 1"), std::string::npos) << status.error();
  EXPECT_EQ(read_file(path).value(), before.value());
  std::filesystem::remove(path);
}

/// A real file of the folder beside the repository, which the project does not need.
class RealScene : public ::testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(RealScene, LoadsWithItsTriangles) {
  const std::string path = std::string(KAAMOS_SOURCE_DIR) + "/../shared/scenes/" + GetParam().first;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const auto loaded = load_gltf(path);
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  const Scene& scene = loaded.value().scene;
  EXPECT_TRUE(validate(scene).ok());
  EXPECT_EQ(unique_triangle_count(scene), static_cast<std::uint64_t>(GetParam().second));
  const auto bytes = encode_glb(scene);
  ASSERT_TRUE(bytes.ok()) << bytes.error();
  const auto again = load(bytes.value());
  ASSERT_TRUE(again.ok()) << again.error();
  EXPECT_EQ(unique_triangle_count(again.value().scene), unique_triangle_count(scene));
}

INSTANTIATE_TEST_SUITE_P(
    Files, RealScene,
    ::testing::Values(std::pair{"reflection_scene.gltf", 55626},
                      std::pair{"samplebuilding.gltf", 11132},
                      std::pair{"samplebuilding_glass.gltf", 164},
                      std::pair{"sampleroom.gltf", 2180}, std::pair{"chinesedragon.gltf", 100960},
                      std::pair{"suzanne_lods.gltf", 21493}, std::pair{"oaktree.gltf", 5302},
                      std::pair{"plants.gltf", 8870}, std::pair{"CesiumMan.glb", 4672},
                      std::pair{"fireplace.gltf", 1142}, std::pair{"shadowscene_fire.gltf", 3104},
                      std::pair{"teapot.gltf", 9128}),
    [](const auto& test) {
      std::string name = test.param.first;
      return name.substr(0, name.find('.'));
    });

TEST(RealSceneDetails, OakLeavesAreAlphaTested) {
  const std::string path = std::string(KAAMOS_SOURCE_DIR) + "/../shared/scenes/oaktree.gltf";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const auto loaded = load_gltf(path);
  ASSERT_TRUE(loaded.ok()) << loaded.error();
  int tested = 0;
  for (const Mesh& mesh : loaded.value().scene.meshes)
    for (const Geometry& geometry : mesh.geometries) tested += geometry.alpha_tested;
  EXPECT_EQ(tested, 1);
}

}  // namespace
}  // namespace kaamos::effects

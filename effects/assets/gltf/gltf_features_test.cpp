// SPDX-License-Identifier: MIT
// Tests instances, extensions, cameras, and what is wrong with a document. Each is read with the
// right value, or named in a warning, or refused by its name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "effects/assets/common/file.h"
#include "effects/assets/gltf/gltf_test_support.h"
#include "effects/assets/gltf/gltf_write.h"
#include "effects/assets/scene/animation.h"
#include "effects/assets/scene/pieces.h"

namespace kaamos::effects {
namespace {

TEST(GltfInstancing, EachOfANodesInstancesStandsWhereItSays) {
  GltfFile file;
  const std::string places =
      file.add(std::vector<float>{-5, 0, 0, 0, 0, 0, 5, 0, 0}, 5126, "VEC3", 3);
  const std::string turns = file.add(
      std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 127, 0, 0, 0, 0, 127}, 5120, "VEC4", 4, true);
  const std::string sizes =
      file.add(std::vector<float>{1, 1, 1, 1, 1, 1, 2, 2, 2}, 5126, "VEC3", 3);
  const auto node = [&](const std::string& attributes) {
    return R"({"mesh":0,"name":"tree","translation":[0,7,0],"extensions":{)"
           R"("EXT_mesh_gpu_instancing":{"attributes":{)" +
           attributes + "}}}}";
  };
  file.nodes = node("\"TRANSLATION\":" + places + ",\"ROTATION\":" + turns + ",\"SCALE\":" + sizes +
                    ",\"_ID\":" + places);
  file.more = R"(,"extensionsUsed":["EXT_mesh_gpu_instancing"],)"
              R"("extensionsRequired":["EXT_mesh_gpu_instancing"])";
  const auto loaded = load(file.bytes());
  expect_warning(loaded, "the attribute _ID is not read");
  const Scene scene = scene_of(loaded);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.instances[2].name, "tree 2");
  const auto corner = [&](std::size_t i) {
    return glm::dvec3(scene.instances[i].transform * glm::dvec4(1, 1, 0, 1));
  };
  EXPECT_EQ(corner(0), glm::dvec3(-4, 8, 0));
  EXPECT_LT(glm::distance(corner(1), glm::dvec3(-1, 6, 0)), 1e-12) << "half a turn about z";
  EXPECT_EQ(corner(2), glm::dvec3(7, 9, 0));
  file.nodes = node("\"TRANSLATION\":" + places + ",\"SCALE\":0");
  expect_error(load(file.bytes()), "elements, another attribute has");
}

TEST(GltfInstancing, InstancesOfANodeThatMovesMoveWithIt) {
  GltfFile file;
  const std::string places = file.add(std::vector<float>{3, 0, 0, 6, 0, 0}, 5126, "VEC3", 3);
  const std::string times = file.add(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
  const std::string lifts = file.add(std::vector<float>{0, 0, 0, 0, 2, 0}, 5126, "VEC3", 3);
  file.nodes = R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{)"
               R"("TRANSLATION":)" +
               places + "}}}}";
  file.more =
      R"(,"animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],)"
      R"("samplers":[{"input":)" +
      times + R"(,"output":)" + lifts + "}]}]";
  const Scene scene = scene_of(load_animated(file.bytes()));
  const auto states = evaluate_instances(scene, 0.5);
  ASSERT_EQ(states.size(), 2u);
  EXPECT_EQ(glm::dvec3(states[0].transform[3]), glm::dvec3(3, 1, 0));
  EXPECT_EQ(glm::dvec3(states[1].transform[3]), glm::dvec3(6, 1, 0));
}

TEST(GltfExtensions, ThoseThatAreNotReadAreNamed) {
  GltfFile file;
  file.primitive = R"(,"material":0)";
  file.more = R"(,"extensionsUsed":["KHR_materials_sheen","ACME_sparkle"],)"
              R"("materials":[{"extensions":{"KHR_materials_clearcoat":{},)"
              R"("KHR_materials_emissive_strength":{"emissiveStrength":2}}}])";
  const auto loaded = load(file.bytes());
  expect_warning(loaded, "KHR_materials_sheen is not read: cloth has no sheen");
  expect_warning(loaded, "ACME_sparkle is not read: what it describes is left out");
  expect_warning(loaded, "KHR_materials_clearcoat is not read");
  EXPECT_EQ(loaded.value().warnings.size(), 3u) << "one sentence each";
}

TEST(GltfExtensions, VariantsMayBeRequired) {
  GltfFile file;
  file.more = R"(,"extensionsRequired":["KHR_materials_variants"],)"
              R"("extensionsUsed":["KHR_materials_variants"])";
  expect_warning(load(file.bytes()), "KHR_materials_variants is not read: each mesh shows its own");
}

TEST(GltfExtensions, CompressionIsRefusedByName) {
  expect_error(load_text(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":9},)"
                         R"({"byteLength":9,"extensions":{"KHR_meshopt_compression":)"
                         R"({"fallback":true}}}]})"),
               "has no uri");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":9,)"
                         R"("extensions":{"KHR_meshopt_compression":{"fallback":true}}}]})"),
               "is compressed by KHR_meshopt_compression");
}

TEST(GltfExtensions, PicturesOfOtherKindsAreNamed) {
  std::vector<std::uint8_t> bytes =
      textured(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})");
  const std::string png = "\x89PNG\r\n\x1a\n";
  const auto start =
      std::search(bytes.begin(), bytes.end(), png.begin(), png.end(),
                  [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); });
  ASSERT_NE(start, bytes.end());
  const std::string ktx2 = "\xABKTX 20\xBB";
  std::copy(ktx2.begin(), ktx2.end(), start);
  expect_error(load(bytes), "is a KTX2 picture (KHR_texture_basisu), PNG and JPEG are read");
}

TEST(GltfDocument, VersionsThatAreNotSupportedAreRefused) {
  expect_error(load_text(R"({"asset":{"version":"2.1","minVersion":"2.1"}})"),
               "needs glTF 2.1 (asset.minVersion), 2.0 is supported");
  expect_error(load_text(R"({"asset":{"version":"1.0"}})"), "is glTF 1.0, 2.0 is supported");
  expect_error(load_text(R"({"asset":{}})"), "has no asset.version");
}

TEST(GltfDocument, SaysWhatAndWhereBeforeTheParserDoes) {
  expect_error(load_text("{\"asset\":{\n  \"version\" \"2.0\"}}"), "mistake at line 2, column 17");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"nodes":[{"name":"n","mesh":"x"}]})"),
               "node 0 \"n\": mesh is not a whole number");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{}]}]})"),
               "mesh 0, primitive 0: has no attributes, which glTF requires");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"images":[{}]})"),
               "image 0: has neither uri nor bufferView");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"cameras":[{"type":"fisheye"}]})"),
               "camera 0: type is \"fisheye\"");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":9,)"
                         R"("uri":"data:application/octet-stream;base64,AAAA"}]})"),
               "buffer 0: byteLength is 9, its data has 3 bytes");
  expect_error(load_text(R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,)"
                         R"("count":1,"type":"VEC9"}]})"),
               "accessor 0: type is \"VEC9\"");
  GltfFile file;
  file.more = R"(,"animations":[{"channels":[{"sampler":0}],"samplers":[]}])";
  expect_error(load(file.bytes()), "animation 0, channel 0: has no target, which glTF requires");
}

// As the Khronos validator allows.
TEST(GltfDocument, DataMayBeLongerThanItsBufferAndOfAnyMediaType) {
  // The positions (0, 0, 0), (1, 0, 0), (0, 1, 0), and one byte more.
  const auto file = [](const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":")" + uri +
           R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
           R"("componentType":5126,"count":3,"type":"VEC3"}],"meshes":[{"primitives":[)"
           R"({"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]})";
  };
  const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  for (const char* type : {"application/octet-stream", "application/x-anything", ""}) {
    const auto loaded = load_text(file("data:" + std::string(type) + ";base64," + base64 + "BQ=="));
    EXPECT_EQ(scene_bounds(scene_of(loaded)).max, glm::dvec3(1, 1, 0)) << type;
  }
  const std::string path = testing::TempDir() + "kaamos_longer.bin";
  std::vector<std::uint8_t> bytes(40, 0);
  const float one = 1.0f;
  std::memcpy(&bytes[12], &one, 4);
  std::memcpy(&bytes[28], &one, 4);
  ASSERT_TRUE(write_file(path, bytes).ok());
  const std::string text = file("kaamos_longer.bin");
  const auto load_beside = [&] {
    return load_gltf_memory(
        std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), "test.gltf",
        testing::TempDir());
  };
  EXPECT_EQ(scene_bounds(scene_of(load_beside())).max, glm::dvec3(1, 1, 0));
  bytes.resize(30);
  ASSERT_TRUE(write_file(path, bytes).ok());
  expect_error(load_beside(), "has 30 bytes, its byteLength says another number");
  std::remove(path.c_str());
}

// A whole number may be written with a point, and an accessor without a view is all zeros or
// sparse.
TEST(GltfDocument, ReadsWhatTheParserRefuses) {
  GltfFile file;
  const std::string which = file.add(std::vector<std::uint8_t>{1, 2}, 5121, "SCALAR", 1);
  const std::string values = file.add(std::vector<std::uint16_t>{1, 2}, 5123, "SCALAR", 1);
  const std::string sparse =
      file.accessor(R"("componentType":5123,"count":3,"type":"SCALAR","sparse":{"count":2,)"
                    R"("indices":{"bufferView":)" +
                    which + R"(,"componentType":5121},"values":{"bufferView":)" + values + "}}");
  file.indices = sparse;
  EXPECT_EQ(unique_triangle_count(scene_of(load(file.bytes()))), 1u);
  file.nodes = R"({"mesh":0.0})";
  EXPECT_EQ(scene_of(load(file.bytes())).instances.size(), 1u);
}

TEST(GltfNodes, ASingularTransformIsSaidWhereNothingElseIsShown) {
  GltfFile file;
  file.nodes = R"({"mesh":0,"name":"flat","scale":[1,1,0]})";
  expect_error(load(file.bytes()), "node 0 \"flat\": its transform is singular");
}

TEST(GltfNodes, OrthographicCamerasAreReadAndWritten) {
  GltfFile file;
  file.nodes += R"(,{"camera":0,"translation":[0,0,4],"scale":[2,2,2]})";
  const auto with = [&](const std::string& ymag) {
    file.more = R"(,"cameras":[{"name":"plan","type":"orthographic","orthographic":{"xmag":2,)"
                R"("ymag":)" +
                ymag + R"(,"znear":0.25,"zfar":9}}])";
    return load(file.bytes());
  };
  const auto loaded = with("1.5");
  const Scene scene = scene_of(loaded);
  EXPECT_TRUE(loaded.value().warnings.empty());
  const Camera& camera = scene.cameras.at(0);
  EXPECT_EQ(camera.name, "plan");
  EXPECT_EQ(camera.half_height, 1.5) << "a node's scale is no part of its camera's view";
  EXPECT_EQ(camera.near_plane, 0.25);
  EXPECT_EQ(camera.position(), glm::dvec3(0, 0, 4));
  EXPECT_EQ(camera.forward(), glm::dvec3(0, 0, -1));
  const auto written = encode_glb(scene);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const Camera again = scene_of(load(written.value())).cameras.at(0);
  EXPECT_EQ(again.half_height, 1.5);
  EXPECT_EQ(again.camera_to_world, camera.camera_to_world);
  expect_warning(with("-1"), "the ymag of its orthographic camera is not above 0");
}

}  // namespace
}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
// Broken files: the error says what is wrong and where, and nothing crashes.
#include <gtest/gtest.h>

#include "effects/assets/common/sampling.h"
#include "effects/assets/gltf/gltf_test_support.h"

namespace kaamos::effects {
namespace {

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
  expect_error(load(file.bytes()), "componentType is 99, 5120 to 5123, 5125 and 5126 are allowed");
  file = {};
  file.positions = R"({"componentType":5126,"count":4200000000,"type":"VEC3"})";
  expect_error(load(file.bytes()), "4200000000 elements, 4194304 are allowed");
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
      R"(,"extensionsUsed":["KHR_texture_basisu"],"extensionsRequired":["KHR_texture_basisu"])";
  expect_error(load(file.bytes()), "KHR_texture_basisu");
  file = {};
  file.nodes = "[{}]";
  expect_error(load(file.bytes()), "shows no triangles");
}

TEST(GltfBroken, WhatTheParserWouldRefuseInItsOwnWords) {
  QuadFile file;
  file.views =
      R"({"buffer":0,"byteLength":48,"byteStride":13},{"buffer":0,"byteOffset":48,"byteLength":6})";
  expect_error(load(file.bytes()),
               "bufferView 0: byteStride is 13, multiples of 4 from 4 to 252 are allowed");
  file = {};
  file.more = R"(,"images":[{"bufferView":9,"mimeType":"image/png"}])";
  expect_error(load(file.bytes()), "image 0: names bufferView 9 of 2");
  file.more = R"(,"images":[{"uri":"data:image/png;base64,`"}])";
  expect_error(load(file.bytes()), "image 0: its data URI holds no base64");
  file.more = R"(,"samplers":[7])";
  expect_error(load(file.bytes()), "sampler 0: is not an object");
  file.more = R"(,"materials":[{},null])";
  expect_error(load(file.bytes()), "material 1: is not an object");
  file.more = R"(,"materials":[{"pbrMetallicRoughness":3}])";
  expect_error(load(file.bytes()), "material 0: pbrMetallicRoughness is not an object");
  file = {};
  file.primitive = R"({"attributes":{"POSITION":0},"indices":1,"mode":0})";
  expect_error(load(file.bytes()), "made of triangles; points and lines are not drawn");
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
  EXPECT_NE(missing.error().message.find("no/such/scene.gltf"), std::string::npos);
  const auto buffer =
      load_text(R"({"asset":{"version":"2.0"},"buffers":[{"uri":"gone.bin","byteLength":4}]})");
  expect_error(buffer, "gone.bin");
  // The size that a folder seems to have must not be allocated.
  expect_error(load_text(R"({"asset":{"version":"2.0"},"buffers":[{"uri":"/","byteLength":9}]})"),
               "cannot read");
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
      EXPECT_FALSE(loaded.error().message.empty());
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace kaamos::effects

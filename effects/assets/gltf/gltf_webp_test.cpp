// SPDX-License-Identifier: MIT
// WebP pictures, encoded by libwebp's own encoder.
#ifdef KAAMOS_HAS_WEBP
#include <gtest/gtest.h>
#include <webp/encode.h>

#include "effects/assets/gltf/gltf_damage_test_support.h"

namespace kaamos::effects {
namespace {

constexpr char kByExtension[] = R"({"extensions":{"EXT_texture_webp":{"source":0}}})";

/// A quad whose base colour is `picture`, by this texture.
std::vector<std::uint8_t> file_of(const std::vector<std::uint8_t>& picture,
                                  const std::string& texture = kByExtension,
                                  const std::string& images = "") {
  GltfFile file;
  file.add(picture, 5121, "SCALAR", 1);
  file.primitive = R"(,"material":0)";
  file.more = R"(,"extensionsRequired":["EXT_texture_webp"],"extensionsUsed":["EXT_texture_webp"],)"
              R"("images":[{"bufferView":2,"mimeType":"image/webp"})" +
              images + R"(],"textures":[)" + texture +
              R"(],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])";
  return file.bytes();
}

std::vector<std::uint8_t> noise(std::uint32_t count) {
  std::vector<std::uint8_t> texels(4 * std::size_t{count});
  for (std::uint32_t i = 0; i < texels.size(); ++i)
    texels[i] = static_cast<std::uint8_t>(pcg_hash(i) >> 24);
  return texels;
}

std::vector<std::uint8_t> taken(std::uint8_t* encoded, std::size_t size) {
  std::vector<std::uint8_t> out(encoded, encoded + size);
  WebPFree(encoded);
  return out;
}

std::vector<std::uint8_t> lossless(const std::vector<std::uint8_t>& texels, int width) {
  std::uint8_t* out = nullptr;
  const int height = static_cast<int>(texels.size()) / 4 / width;
  return taken(out, WebPEncodeLosslessRGBA(texels.data(), width, height, 4 * width, &out));
}

std::vector<std::uint8_t> lossy(const std::vector<std::uint8_t>& texels, int width) {
  std::uint8_t* out = nullptr;
  const int height = static_cast<int>(texels.size()) / 4 / width;
  return taken(out, WebPEncodeRGBA(texels.data(), width, height, 4 * width, 90.0f, &out));
}

TEST(GltfWebp, LosslessTexelsComeBackAsTheyWere) {
  const std::vector<std::uint8_t> texels = {200, 100, 50, 255, 10, 20, 30, 128};
  const auto loaded = load(file_of(lossless(texels, 2)));
  const Scene scene = scene_of(loaded);
  EXPECT_TRUE(loaded.value().warnings.empty());
  EXPECT_EQ(scene.images.at(0).width, 2u);
  EXPECT_EQ(scene.images.at(0).height, 1u);
  EXPECT_EQ(scene.images.at(0).mips.at(0), texels);
  EXPECT_EQ(scene.materials.at(0).constants.image[kBaseColorTexture], 0);
}

TEST(GltfWebp, LossyPicturesWithoutAlphaAreOpaque) {
  // One colour, which survives any quality but for the rounding of its conversion to YUV and back.
  std::vector<std::uint8_t> texels;
  for (int i = 0; i < 256; ++i) texels.insert(texels.end(), {200, 100, 50, 255});
  const Scene scene = scene_of(load(file_of(lossy(texels, 16))));
  const std::vector<std::uint8_t>& read = scene.images.at(0).mips.at(0);
  ASSERT_EQ(read.size(), texels.size());
  for (std::size_t i = 0; i < read.size(); ++i) EXPECT_NEAR(read[i], texels[i], 4) << i;
  EXPECT_EQ(read[3], 255);
}

TEST(GltfWebp, AFixedFileOfOneTexel) {
  // One pixel by VP8L: 0x2F, width - 1 and height - 1 in 14 bits each, then codes of one symbol
  // each.
  const std::vector<std::uint8_t> bytes = {
      'R', 'I', 'F', 'F',  0x1A, 0, 0, 0,    'W',  'E',  'B',  'P',  'V',  'P',  '8',  'L',  0x0D,
      0,   0,   0,   0x2F, 0,    0, 0, 0x10, 0x07, 0x10, 0x11, 0x11, 0x88, 0x88, 0xFE, 0x07, 0};
  const Scene scene = scene_of(load(file_of(bytes)));
  EXPECT_EQ(scene.images.at(0).mips.at(0), (std::vector<std::uint8_t>{0, 0, 0, 0}));
}

TEST(GltfWebp, APngThatStandsForTheSameComesFirst) {
  ByteImage image;
  image.width = image.height = 1;
  image.channels = 4;
  image.values = {1, 2, 3, 255};
  GltfFile file;
  file.add(lossless({9, 9, 9, 255}, 1), 5121, "SCALAR", 1);
  file.add(encode_png(image).value(), 5121, "SCALAR", 1);
  file.primitive = R"(,"material":0)";
  file.more =
      R"(,"extensionsUsed":["EXT_texture_webp"],"images":[{"bufferView":2,"mimeType":"image/webp"},)"
      R"({"bufferView":3,"mimeType":"image/png"}],)"
      R"("textures":[{"source":1,"extensions":{"EXT_texture_webp":{"source":0}}}],)"
      R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])";
  EXPECT_EQ(scene_of(load(file.bytes())).images.at(0).mips.at(0), image.values);
}

TEST(GltfWebp, WhatIsWrongIsNamed) {
  const std::vector<std::uint8_t> good = lossless({200, 100, 50, 255}, 1);
  expect_error(load(file_of(good, R"({"extensions":{"EXT_texture_webp":{"source":7}}})")),
               "names image 7 of 1");
  expect_error(load(file_of(good, R"({"extensions":{"EXT_texture_webp":{"source":1e300}}})")),
               "names image 1000000000 of 1");
  expect_warning(load(file_of(good, R"({"extensions":{"EXT_texture_webp":{}}})")),
                 "the texture is left out");
  expect_error(load(file_of({good.begin(), good.begin() + 14})), "image 0: is damaged (WebP)");
  // The header of an animation, which has its frames behind it.
  std::vector<std::uint8_t> animated = {'R', 'I', 'F', 'F', 0x16, 0,   0,  0, 'W', 'E',
                                        'B', 'P', 'V', 'P', '8',  'X', 10, 0, 0,   0,
                                        2,   0,   0,   0,   0,    0,   0,  0, 0,   0};
  expect_error(load(file_of(animated)), "image 0: is an animated WebP picture");
}

TEST(GltfWebp, CutAndChangedPicturesNeverCrash) {
  const auto with = [](const std::vector<std::uint8_t>& picture) { return file_of(picture); };
  EXPECT_GT(count_refused(lossless(noise(64), 8), 1000, with), 250);
  EXPECT_GT(count_refused(lossy(noise(256), 16), 1000, with), 250);
}

}  // namespace
}  // namespace kaamos::effects
#endif

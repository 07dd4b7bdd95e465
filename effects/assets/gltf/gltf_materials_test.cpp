// SPDX-License-Identifier: MIT
// Tests what materials have: textures and their coordinates, reflectance, glass, unlit colours.
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

TEST(GltfUnlit, ShowsItsBaseColorAndComesBack) {
  GltfFile file;
  file.primitive = R"(,"material":0)";
  file.more = R"(,"extensionsUsed":["KHR_materials_unlit"],"materials":[{"emissiveFactor":[1,1,1],)"
              R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1]},)"
              R"("extensions":{"KHR_materials_unlit":{}}}])";
  const auto loaded = load(file.bytes());
  const Scene scene = scene_of(loaded);
  EXPECT_TRUE(loaded.value().warnings.empty());
  const MaterialConstants& m = scene.materials.at(0).constants;
  EXPECT_EQ(m.flags, kMaterialUnlit);
  EXPECT_EQ(m.emissive, glm::vec3(0)) << "the base colour alone counts";
  EXPECT_EQ(m.base_color, glm::vec4(0.5f, 0.25f, 0.125f, 1));
  EXPECT_EQ(int{scene.instances.at(0).mask}, int{kMaskEmissiveProxy}) << "it lights nothing";
  const auto written = encode_glb(scene);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const auto back = load(written.value());
  EXPECT_EQ(scene_of(back).materials.at(0).constants.flags, kMaterialUnlit);
  EXPECT_TRUE(back.value().warnings.empty());
}

TEST(GltfTextures, EachTextureHasItsOwnCoordinates) {
  const auto material = [](const std::string& normal) {
    return R"({"normalTexture":{"index":0)" + normal +
           R"(},"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}})";
  };
  const auto both = load(textured(material(R"(,"texCoord":1)")));
  const Scene scene = scene_of(both);
  EXPECT_TRUE(both.value().warnings.empty());
  EXPECT_NE(scene.materials.at(0).constants.image[kBaseColorTexture], kNoTexture);
  EXPECT_NE(scene.materials.at(0).constants.image[kNormalTexture], kNoTexture);
  const auto mixed = load(textured(material("")));
  EXPECT_TRUE(mixed.value().warnings.empty());
  const MaterialConstants& constants = scene_of(mixed).materials.at(0).constants;
  EXPECT_NE(constants.image[kNormalTexture], kNoTexture);
  EXPECT_EQ(constants.second_uv, 1u << kBaseColorTexture) << "tangents are the normal texture's";
  const auto third =
      load(textured(R"({"normalTexture":{"index":0},"emissiveTexture":{"index":0,"texCoord":2},)"
                    R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}})"));
  expect_warning(third, "uses TEXCOORD_2, and the material's others TEXCOORD_0 and TEXCOORD_1");
}

TEST(GltfTextures, FilesKeepTheSecondCoordinates) {
  Scene scene = scene_of(
      load(textured(R"({"normalTexture":{"index":0},"pbrMetallicRoughness":{"baseColorTexture":)"
                    R"({"index":0,"texCoord":1}}})")));
  Mesh& mesh = scene.meshes.at(0);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    mesh.second_uv.emplace_back(0.25f * static_cast<float>(i), 1.0f);
  const auto written = encode_glb(scene);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const Scene again = scene_of(load(written.value()));
  EXPECT_EQ(again.meshes.at(0).second_uv, mesh.second_uv);
  EXPECT_EQ(again.materials.at(0).constants.second_uv, 1u << kBaseColorTexture);
  Scene split = scene;
  ASSERT_EQ(split_into_pieces(split, 1), 1u);
  EXPECT_EQ(split.meshes.at(0).second_uv.size(), 3u);
}

TEST(GltfMaterials, ReflectanceIsReadAndWritten) {
  const Scene scene = scene_of(load(textured(
      R"({"extensions":{"KHR_materials_ior":{"ior":1.33},"KHR_materials_specular":)"
      R"({"specularFactor":0.5,"specularColorFactor":[1,2,0.5],"specularTexture":{"index":0},)"
      R"("specularColorTexture":{"index":0,"texCoord":1,"extensions":)"
      R"({"KHR_texture_transform":{"offset":[0.5,0.25]}}}}}})")));
  const MaterialConstants& c = scene.materials.at(0).constants;
  EXPECT_NEAR(c.dielectric_f0, 0.33 * 0.33 / (2.33 * 2.33), 1e-8);
  EXPECT_EQ(c.specular, 0.5f);
  EXPECT_EQ(c.specular_color, glm::vec3(1, 2, 0.5f));
  ASSERT_NE(c.image[kSpecularTexture], kNoTexture);
  ASSERT_NE(c.image[kSpecularColorTexture], kNoTexture);
  EXPECT_TRUE(scene.images[static_cast<std::size_t>(c.image[kSpecularColorTexture])].srgb);
  EXPECT_FALSE(scene.images[static_cast<std::size_t>(c.image[kSpecularTexture])].srgb);
  EXPECT_EQ(c.uv_offset[kSpecularColorTexture], glm::vec2(0.5f, 0.25f));
  EXPECT_EQ(c.second_uv, 1u << kSpecularColorTexture);
  const auto written = encode_glb(scene);
  ASSERT_TRUE(written.ok()) << written.error().message;
  const auto back = load(written.value());
  EXPECT_TRUE(back.value().warnings.empty());
  const MaterialConstants& again = scene_of(back).materials.at(0).constants;
  EXPECT_EQ(again.dielectric_f0, c.dielectric_f0);
  EXPECT_EQ(again.specular, c.specular);
  EXPECT_EQ(again.specular_color, c.specular_color);
  EXPECT_EQ(again.uv_offset, c.uv_offset);
  EXPECT_EQ(again.second_uv, c.second_uv);
}

TEST(GltfMaterials, GlossinessBecomesRoughness) {
  const auto with = [](const std::string& texture) {
    return load(textured(
        R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0.5,0.25,1,1],)"
        R"("specularFactor":[0.1,0.2,0.3],"glossinessFactor":0.75)" +
            texture + "}}}",
        R"(,"extensionsRequired":["KHR_materials_pbrSpecularGlossiness"])"));
  };
  const auto plain = with("");
  EXPECT_TRUE(plain.value().warnings.empty());
  const MaterialConstants& c = scene_of(plain).materials.at(0).constants;
  EXPECT_EQ(c.base_color, glm::vec4(0.5f, 0.25f, 1, 1));
  EXPECT_EQ(c.metallic, 0.0f);
  EXPECT_EQ(c.roughness, 0.25f);
  EXPECT_EQ(c.dielectric_f0 * c.specular * c.specular_color, glm::vec3(0.1f, 0.2f, 0.3f));
  // Alpha 255 and 0: 1 - 0.75 and 1.
  const Scene scene = scene_of(with(R"(,"specularGlossinessTexture":{"index":0})"));
  const MaterialConstants& textured_ones = scene.materials.at(0).constants;
  EXPECT_EQ(textured_ones.roughness, 1.0f);
  ASSERT_NE(textured_ones.image[kMetallicRoughnessTexture], kNoTexture);
  ASSERT_NE(textured_ones.image[kSpecularColorTexture], kNoTexture);
  const TextureImage& rough =
      scene.images[static_cast<std::size_t>(textured_ones.image[kMetallicRoughnessTexture])];
  EXPECT_EQ(int{rough.mips[0][1]}, 64);
  EXPECT_EQ(int{rough.mips[0][5]}, 255);
}

TEST(GltfMaterials, LightPassesThroughThinGlass) {
  const auto with = [](const std::string& color, const std::string& transmission) {
    return load(textured(R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0,)"
                         R"("baseColorFactor":)" +
                         color + R"(},"extensions":{"KHR_materials_transmission":{)" +
                         transmission + "}}}"));
  };
  const auto clear = with("[1,1,1,1]", R"("transmissionFactor":0.75)");
  EXPECT_TRUE(clear.value().warnings.empty());
  const Scene scene = scene_of(clear);
  EXPECT_EQ(scene.materials.at(0).constants.base_color.a, 0.25f);
  EXPECT_EQ(int{scene.instances.at(0).mask}, int{kMaskTransparent});
  EXPECT_GT(scene_of(with("[1,1,1,1]", R"("transmissionFactor":1)"))
                .materials.at(0)
                .constants.base_color.a,
            0.0f);
  expect_warning(with("[1,0.5,0.5,1]", R"("transmissionFactor":1)"), "glass colours what it");
  const auto textured_glass = with("[1,1,1,1]", R"("transmissionFactor":1,)"
                                                R"("transmissionTexture":{"index":0})");
  expect_warning(textured_glass, "KHR_materials_transmission: its texture is not read");
  EXPECT_EQ(int{scene_of(textured_glass).instances.at(0).mask}, int{kMaskOpaque});
}

TEST(GltfBlend, ATextureThatIsNotCutOutMakesGlass) {
  const auto with_alpha = [](std::uint8_t first, std::uint8_t second, const std::string& more) {
    std::vector<std::uint8_t> values = {200, 100, 50, first, 0, 0, 0, second};
    return textured_with(values, R"({"alphaMode":"BLEND","pbrMetallicRoughness":{)" + more +
                                     R"("baseColorTexture":{"index":0}}})");
  };
  const Scene leaf = scene_of(load(with_alpha(255, 0, "")));
  EXPECT_EQ(leaf.materials.at(0).constants.flags, kMaterialBlend | kMaterialAlphaTested);
  EXPECT_EQ(int{leaf.instances.at(0).mask}, int{kMaskOpaque});
  const Scene veil = scene_of(load(with_alpha(255, 90, "")));
  EXPECT_EQ(veil.materials.at(0).constants.flags, kMaterialBlend);
  EXPECT_EQ(int{veil.instances.at(0).mask}, int{kMaskTransparent});
  const Scene faint = scene_of(load(with_alpha(255, 0, R"("baseColorFactor":[1,1,1,0.4],)")));
  EXPECT_EQ(int{faint.instances.at(0).mask}, int{kMaskTransparent}) << "no texel reaches 0.5";
}

TEST(GltfBlend, GlassInAMeshOfOtherThingsIsAnInstanceOfItsOwn) {
  GltfFile file;
  file.primitive = R"(,"material":0},{"attributes":{"POSITION":0},"indices":1,"material":1)";
  file.more = R"(,"materials":[{},{"alphaMode":"BLEND"}])";
  const Scene scene = scene_of(load(file.bytes()));
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(int{scene.instances[0].mask}, int{kMaskOpaque});
  EXPECT_EQ(int{scene.instances[1].mask}, int{kMaskTransparent});
  EXPECT_EQ(scene.meshes.at(scene.instances[1].mesh).geometries.at(0).material, 1u);
}

TEST(GltfTextures, TheVerticesHaveTheCoordinatesOfTheirMaterial) {
  GltfFile file;
  file.attributes +=
      ",\"TEXCOORD_0\":" + file.add(std::vector<float>(8, 0.0f), 5126, "VEC2", 2) +
      ",\"TEXCOORD_1\":" +
      file.add(std::vector<float>{0.5f, 0.25f, 0.5f, 0.25f, 0.5f, 0.25f, 0.5f, 0.25f}, 5126, "VEC2",
               2);
  file.primitive = R"(,"material":0)";
  file.more =
      R"(,"textures":[{}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,)"
      R"("texCoord":1}}}])";
  const auto loaded = load(file.bytes());
  expect_warning(loaded, "has no PNG or JPEG source");
  EXPECT_EQ(scene_of(loaded).meshes.at(0).vertices.at(0).uv, glm::vec2(0.5f, 0.25f));
}

}  // namespace
}  // namespace kaamos::effects

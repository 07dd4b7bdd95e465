// SPDX-License-Identifier: MIT
// A build without the optional libraries names what it cannot read, and what to install.
#include <gtest/gtest.h>

#include "effects/assets/gltf/gltf_extensions.h"
#include "effects/assets/gltf/gltf_test_support.h"

namespace kaamos::effects {
namespace {

TEST(GltfCodecsAbsent, RequiredExtensionsNameTheirPackage) {
  for (const auto& [name, package] :
       {std::pair("EXT_texture_webp", "libwebp-dev"),
        std::pair("KHR_draco_mesh_compression", "libdraco-dev"),
        std::pair("EXT_meshopt_compression", "libmeshoptimizer-dev")}) {
    EXPECT_FALSE(is_gltf_extension_read(name));
    const std::string list = std::string("[\"") + name + "\"]";
    GltfFile file;
    file.more = ",\"extensionsRequired\":" + list + ",\"extensionsUsed\":" + list;
    expect_error(load(file.bytes()), std::string("requires the extension ") + name +
                                         ", which is not supported (install " + package +
                                         " and build Kaamos again to read it)");
    file.more = ",\"extensionsUsed\":" + list;
    expect_warning(load(file.bytes()), std::string("the extension ") + name + " is not read: ");
    expect_warning(load(file.bytes()), std::string("(install ") + package);
  }
}

TEST(GltfCodecsAbsent, WebpPicturesAreRefusedByName) {
  GltfFile file;
  file.add(std::vector<std::uint8_t>{'R', 'I', 'F', 'F', 4, 0, 0, 0, 'W', 'E', 'B', 'P'}, 5121,
           "SCALAR", 1);
  file.primitive = R"(,"material":0)";
  const std::string images = R"(,"images":[{"bufferView":2,"mimeType":"image/webp"}],"textures":[)";
  const std::string materials =
      R"(],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])";
  file.more = images + R"({"source":0})" + materials;
  expect_error(load(file.bytes()),
               "image 0: is a WebP picture (EXT_texture_webp), PNG and JPEG are read (install "
               "libwebp-dev and build Kaamos again to read it)");
  file.more = images + R"({"extensions":{"EXT_texture_webp":{"source":0}}})" + materials;
  expect_warning(load(file.bytes()),
                 "has no PNG or JPEG source, only EXT_texture_webp (install libwebp-dev");
}

TEST(GltfCodecsAbsent, DracoMeshesWithAPlainCopyAreReadFromIt) {
  GltfFile file;
  file.more = R"(,"extensionsUsed":["KHR_draco_mesh_compression"])";
  file.primitive = R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0}})";
  expect_warning(load(file.bytes()), "KHR_draco_mesh_compression is not read: the uncompressed");
  EXPECT_EQ(scene_of(load(file.bytes())).meshes.at(0).triangle_count(), 2u);
  file.attributes =
      R"("POSITION":)" + file.accessor(R"("componentType":5126,"count":4,"type":"VEC3")");
  expect_error(load(file.bytes()),
               "is compressed by KHR_draco_mesh_compression, which is not supported (install "
               "libdraco-dev and build Kaamos again to read it), and has no uncompressed copy");
}

TEST(GltfCodecsAbsent, MeshoptViewsWithAPlainCopyAreReadFromIt) {
  // Buffer 1 has four indices, and the stream of its view would be in buffer 0.
  const auto with = [](const std::string& uri) {
    GltfFile file;
    file.indices = file.accessor(
        R"("bufferView":)" +
        file.view(
            R"("buffer":1,"byteLength":3,"extensions":{"EXT_meshopt_compression":{"buffer":0,)"
            R"("byteLength":9,"byteStride":2,"count":3,"mode":"INDICES"}})") +
        R"(,"componentType":5121,"type":"SCALAR","count":3)");
    file.more = R"(,"extensionsUsed":["EXT_meshopt_compression"])";
    file.more_buffers = R"(,{"byteLength":3)" + uri +
                        R"(,"extensions":{"EXT_meshopt_compression":{"fallback":true}}})";
    return file.bytes();
  };
  const auto loaded = load(with(R"(,"uri":"data:application/octet-stream;base64,AAEC")"));
  expect_warning(loaded, "EXT_meshopt_compression is not read: the uncompressed copy is read");
  EXPECT_EQ(scene_of(loaded).meshes.at(0).triangle_count(), 1u);
  expect_error(load(with("")),
               "buffer 1: is compressed by EXT_meshopt_compression, which is not "
               "supported (install libmeshoptimizer-dev");
}

}  // namespace
}  // namespace kaamos::effects

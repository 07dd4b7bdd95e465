// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_write.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <glm/gtc/constants.hpp>
#include <span>
#include <sstream>

#include "effects/assets/common/file.h"
#include "effects/assets/gltf/gltf_extras.h"
#include "effects/assets/gltf/gltf_transform.h"
#include "effects/assets/image/png.h"

namespace kaamos::effects {
namespace {

tinygltf::Value number(double value) {
  return tinygltf::Value(value);
}

tinygltf::Value pair(double a, double b) {
  return tinygltf::Value(tinygltf::Value::Array{number(a), number(b)});
}

int wrap_mode(Wrap wrap) {
  if (wrap == Wrap::kClamp) return TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  if (wrap == Wrap::kMirror) return TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
  return TINYGLTF_TEXTURE_WRAP_REPEAT;
}

int min_filter(const Sampler& sampler) {
  const bool linear = sampler.min_filter == Filter::kLinear;
  if (!sampler.mipmapped)
    return linear ? TINYGLTF_TEXTURE_FILTER_LINEAR : TINYGLTF_TEXTURE_FILTER_NEAREST;
  if (sampler.mip_filter == Filter::kLinear)
    return linear ? TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR
                  : TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR;
  return linear ? TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST
                : TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST;
}

class Writer {
 public:
  explicit Writer(const Scene& scene) : scene_(scene) {}
  Result<std::vector<std::uint8_t>> run();

 private:
  int add_view(const void* bytes, std::size_t size, int target, std::size_t stride = 0);
  int add_accessor(int view, std::size_t offset, int component_type, int type, std::size_t count);
  void add_mesh(const Mesh& mesh);
  Status add_image(const TextureImage& image);
  void add_material(const Material& material);
  int texture_of(int source, int sampler);
  template <class Info>
  void set_texture(Info& info, const MaterialConstants& constants, std::uint32_t slot);
  tinygltf::Value texture_value(const MaterialConstants& constants, std::uint32_t slot);
  void add_reflectance(const MaterialConstants& from, tinygltf::Material& to);
  void add_levels(int node, const Instance& instance);
  tinygltf::Node& add_node(const std::string& name, const glm::dmat4& transform);
  void add_instance(const Instance& instance);
  void add_camera(const Camera& camera);
  tinygltf::Node& add_light(const Light& light);
  void add_sun(const Sun& sun);
  void use_extension(const char* name);

  const Scene& scene_;
  tinygltf::Model model_;
  std::vector<unsigned char> data_;
};

int Writer::add_view(const void* bytes, std::size_t size, int target, std::size_t stride) {
  data_.resize((data_.size() + 3) / 4 * 4, 0);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data_.size();
  view.byteLength = size;
  view.byteStride = stride;
  view.target = target;
  const auto* first = static_cast<const unsigned char*>(bytes);
  data_.insert(data_.end(), first, first + size);
  model_.bufferViews.push_back(view);
  return static_cast<int>(model_.bufferViews.size()) - 1;
}

int Writer::add_accessor(int view, std::size_t offset, int component_type, int type,
                         std::size_t count) {
  tinygltf::Accessor accessor;
  accessor.bufferView = view;
  accessor.byteOffset = offset;
  accessor.componentType = component_type;
  accessor.type = type;
  accessor.count = count;
  model_.accessors.push_back(accessor);
  return static_cast<int>(model_.accessors.size()) - 1;
}

void Writer::use_extension(const char* name) {
  std::vector<std::string>& used = model_.extensionsUsed;
  if (std::find(used.begin(), used.end(), name) == used.end()) used.emplace_back(name);
}

void Writer::add_mesh(const Mesh& mesh) {
  tinygltf::Mesh out;
  out.name = mesh.name;
  constexpr int kFloat = TINYGLTF_COMPONENT_TYPE_FLOAT;
  for (const Geometry& g : mesh.geometries) {
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = static_cast<int>(g.material);
    const std::span<const Vertex> vertices =
        std::span(mesh.vertices).subspan(g.first_vertex, g.vertex_count);
    const int vertex_view = add_view(vertices.data(), vertices.size_bytes(),
                                     TINYGLTF_TARGET_ARRAY_BUFFER, sizeof(Vertex));
    const int position =
        add_accessor(vertex_view, kPositionOffset, kFloat, TINYGLTF_TYPE_VEC3, g.vertex_count);
    Bounds bounds;
    for (const Vertex& vertex : vertices) bounds.add(vertex.position);
    for (int c = 0; c < 3; ++c) {
      model_.accessors.back().minValues.push_back(bounds.min[c]);
      model_.accessors.back().maxValues.push_back(bounds.max[c]);
    }
    primitive.attributes["POSITION"] = position;
    primitive.attributes["NORMAL"] =
        add_accessor(vertex_view, kNormalOffset, kFloat, TINYGLTF_TYPE_VEC3, g.vertex_count);
    primitive.attributes["TANGENT"] =
        add_accessor(vertex_view, kTangentOffset, kFloat, TINYGLTF_TYPE_VEC4, g.vertex_count);
    primitive.attributes["TEXCOORD_0"] =
        add_accessor(vertex_view, kUvOffset, kFloat, TINYGLTF_TYPE_VEC2, g.vertex_count);
    if (!mesh.second_uv.empty()) {
      const int uv_view =
          add_view(mesh.second_uv.data() + g.first_vertex, g.vertex_count * sizeof(glm::vec2),
                   TINYGLTF_TARGET_ARRAY_BUFFER, sizeof(glm::vec2));
      primitive.attributes["TEXCOORD_1"] =
          add_accessor(uv_view, 0, kFloat, TINYGLTF_TYPE_VEC2, g.vertex_count);
    }
    if (!mesh.colors.empty()) {
      const int color_view =
          add_view(mesh.colors.data() + g.first_vertex, g.vertex_count * sizeof(VertexColor),
                   TINYGLTF_TARGET_ARRAY_BUFFER, sizeof(VertexColor));
      primitive.attributes["COLOR_0"] =
          add_accessor(color_view, 0, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                       g.vertex_count);
      model_.accessors.back().normalized = true;
    }
    const int index_view = add_view(mesh.indices.data() + g.index_offset_bytes,
                                    std::size_t{g.index_count} * g.index_size_bytes,
                                    TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    primitive.indices =
        add_accessor(index_view, 0,
                     g.index_size_bytes == 2 ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
                                             : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                     TINYGLTF_TYPE_SCALAR, g.index_count);
    out.primitives.push_back(std::move(primitive));
  }
  model_.meshes.push_back(std::move(out));
}

Status Writer::add_image(const TextureImage& image) {
  ByteImage picture;
  picture.width = image.width;
  picture.height = image.height;
  picture.channels = 4;
  picture.values = image.mips[0];
  const Result<std::vector<std::uint8_t>> png = encode_png(picture);
  if (!png.ok()) return within("image \"" + image.name + "\"", png.error(), ErrorId::kGltfWrite);
  tinygltf::Image out;
  out.name = image.name;
  out.mimeType = "image/png";
  out.bufferView = add_view(png.value().data(), png.value().size(), 0);
  model_.images.push_back(std::move(out));
  return {};
}

int Writer::texture_of(int source, int sampler) {
  for (std::size_t i = 0; i < model_.textures.size(); ++i)
    if (model_.textures[i].source == source && model_.textures[i].sampler == sampler)
      return static_cast<int>(i);
  tinygltf::Texture texture;
  texture.source = source;
  texture.sampler = sampler;
  model_.textures.push_back(texture);
  return static_cast<int>(model_.textures.size()) - 1;
}

/// glTF describes a transform by scale, rotation and offset. Any matrix without shear can be split
/// that way.
template <class Info>
void Writer::set_texture(Info& info, const MaterialConstants& constants, std::uint32_t slot) {
  if (constants.image[slot] == kNoTexture) return;
  info.index = texture_of(constants.image[slot], static_cast<int>(constants.sampler[slot]));
  info.texCoord = static_cast<int>(constants.second_uv >> slot & 1u);
  const glm::vec4& m = constants.uv_matrix[slot];
  const glm::vec2& offset = constants.uv_offset[slot];
  if (m == glm::vec4(1, 0, 0, 1) && offset == glm::vec2(0.0f)) return;
  const double rotation = std::atan2(-m.z, m.x);
  const double c = std::cos(rotation), s = std::sin(rotation);
  tinygltf::Value::Object transform;
  transform["offset"] = pair(offset.x, offset.y);
  transform["rotation"] = number(rotation);
  transform["scale"] = pair(m.x * c - m.z * s, m.y * s + m.w * c);
  use_extension("KHR_texture_transform");
  info.extensions["KHR_texture_transform"] = tinygltf::Value(transform);
}

/// A texture as a member of an extension.
tinygltf::Value Writer::texture_value(const MaterialConstants& constants, std::uint32_t slot) {
  tinygltf::TextureInfo info;
  set_texture(info, constants, slot);
  tinygltf::Value::Object out = {{"index", tinygltf::Value(info.index)},
                                 {"texCoord", tinygltf::Value(info.texCoord)}};
  if (!info.extensions.empty()) {
    tinygltf::Value::Object extensions(info.extensions.begin(), info.extensions.end());
    out["extensions"] = tinygltf::Value(extensions);
  }
  return tinygltf::Value(out);
}

void Writer::add_reflectance(const MaterialConstants& from, tinygltf::Material& to) {
  if (from.dielectric_f0 != MaterialConstants().dielectric_f0) {
    const double root = std::sqrt(static_cast<double>(from.dielectric_f0));
    use_extension("KHR_materials_ior");
    to.extensions["KHR_materials_ior"] = tinygltf::Value(
        tinygltf::Value::Object{{"ior", number(root < 1.0 ? (1.0 + root) / (1.0 - root) : 0.0)}});
  }
  const bool has_texture = from.image[kSpecularTexture] != kNoTexture,
             has_color_texture = from.image[kSpecularColorTexture] != kNoTexture;
  if (from.specular == 1.0f && from.specular_color == glm::vec3(1.0f) && !has_texture &&
      !has_color_texture)
    return;
  tinygltf::Value::Object specular = {
      {"specularFactor", number(from.specular)},
      {"specularColorFactor", tinygltf::Value(tinygltf::Value::Array{
                                  number(from.specular_color.r), number(from.specular_color.g),
                                  number(from.specular_color.b)})}};
  if (has_texture) specular["specularTexture"] = texture_value(from, kSpecularTexture);
  if (has_color_texture)
    specular["specularColorTexture"] = texture_value(from, kSpecularColorTexture);
  use_extension("KHR_materials_specular");
  to.extensions["KHR_materials_specular"] = tinygltf::Value(specular);
}

void Writer::add_material(const Material& material) {
  const MaterialConstants& from = material.constants;
  tinygltf::Material to;
  to.name = material.name;
  to.pbrMetallicRoughness.baseColorFactor = {from.base_color.r, from.base_color.g,
                                             from.base_color.b, from.base_color.a};
  to.pbrMetallicRoughness.metallicFactor = from.metallic;
  to.pbrMetallicRoughness.roughnessFactor = from.roughness;
  // glTF wants factors in 0..1; the excess goes into the strength.
  const double strength = std::max({1.0f, from.emissive.r, from.emissive.g, from.emissive.b});
  to.emissiveFactor = {from.emissive.r / strength, from.emissive.g / strength,
                       from.emissive.b / strength};
  if (strength > 1.0) {
    use_extension("KHR_materials_emissive_strength");
    to.extensions["KHR_materials_emissive_strength"] =
        tinygltf::Value(tinygltf::Value::Object{{"emissiveStrength", number(strength)}});
  }
  if (from.flags & kMaterialUnlit) {
    use_extension("KHR_materials_unlit");
    to.extensions["KHR_materials_unlit"] = tinygltf::Value(tinygltf::Value::Object{});
  }
  to.extras = material_extras(from);
  add_reflectance(from, to);
  to.normalTexture.scale = from.normal_scale;
  to.doubleSided = (from.flags & kMaterialDoubleSided) != 0;
  to.alphaMode = (from.flags & kMaterialMask)    ? "MASK"
                 : (from.flags & kMaterialBlend) ? "BLEND"
                                                 : "OPAQUE";
  to.alphaCutoff = from.alpha_cutoff;
  set_texture(to.pbrMetallicRoughness.baseColorTexture, from, kBaseColorTexture);
  set_texture(to.pbrMetallicRoughness.metallicRoughnessTexture, from, kMetallicRoughnessTexture);
  set_texture(to.normalTexture, from, kNormalTexture);
  set_texture(to.emissiveTexture, from, kEmissiveTexture);
  model_.materials.push_back(std::move(to));
}

/// The node that has the transform, the innermost one where it takes two. Valid until the next is
/// added.
tinygltf::Node& Writer::add_node(const std::string& name, const glm::dmat4& transform) {
  const std::vector<glm::dmat4> parts = without_shear(transform);
  for (const glm::dmat4& matrix : parts) {
    tinygltf::Node node;
    node.name = name;
    if (matrix != glm::dmat4(1.0))
      for (int i = 0; i < 16; ++i) node.matrix.push_back(matrix[i / 4][i % 4]);
    const int id = static_cast<int>(model_.nodes.size());
    (&matrix == parts.data() ? model_.scenes[0].nodes : model_.nodes.back().children).push_back(id);
    model_.nodes.push_back(std::move(node));
  }
  return model_.nodes.back();
}

void Writer::add_instance(const Instance& instance) {
  tinygltf::Node& node = add_node(instance.name, instance.transform);
  if (instance.levels.empty()) {
    node.mesh = static_cast<int>(instance.mesh);
    add_instance_extras(node.extras, instance);
  } else {
    add_levels(static_cast<int>(model_.nodes.size()) - 1, instance);
  }
}

void Writer::add_camera(const Camera& camera) {
  tinygltf::Camera out;
  out.type = camera.is_orthographic() ? "orthographic" : "perspective";
  out.name = camera.name;
  // Cameras here cut nothing off, and tinygltf writes zfar in any case: farther than any scene
  // reaches; of an orthographic camera, whose depths elsewhere are spread evenly, not much farther.
  if (camera.is_orthographic()) {
    out.orthographic.xmag = out.orthographic.ymag = camera.half_height;
    out.orthographic.znear = camera.near_plane;
    const Bounds bounds = scene_bounds(scene_);
    const double far = bounds.empty() ? 0.0
                                      : glm::length(bounds.center() - camera.position()) +
                                            glm::length(bounds.size());
    out.orthographic.zfar = std::max(far, 2.0 * camera.near_plane);
  } else {
    out.perspective.yfov = camera.vertical_fov;
    out.perspective.znear = camera.near_plane;
    out.perspective.zfar = 1e30;
  }
  model_.cameras.push_back(out);
  add_node(camera.name, camera.camera_to_world).camera =
      static_cast<int>(model_.cameras.size()) - 1;
}

/// Turned so that -z is the light's direction, bit for bit.
glm::dmat4 light_transform(const Light& light) {
  const glm::dvec3 direction(light.direction);
  glm::dmat4 out = look_at(glm::dvec3(0.0), direction);
  out[2] = glm::dvec4(-direction, 0.0);
  if (light.type != LightType::kDirectional) out[3] = glm::dvec4(light.position, 1.0);
  return out;
}

tinygltf::Node& Writer::add_light(const Light& light) {
  use_extension("KHR_lights_punctual");
  tinygltf::Light out;
  out.name = light.name;
  out.type = light.type == LightType::kDirectional ? "directional"
             : light.type == LightType::kSpot      ? "spot"
                                                   : "point";
  // glTF wants colours in 0..1; the excess goes into the intensity.
  const double excess = std::max({1.0f, light.color.r, light.color.g, light.color.b});
  out.color = {light.color.r / excess, light.color.g / excess, light.color.b / excess};
  out.intensity = light.intensity * excess;
  // A directional light has no range. [KHR_lights_punctual]
  out.range = light.type == LightType::kDirectional ? 0.0 : light.range;
  out.spot.outerConeAngle = std::min<double>(light.outer_cone_angle, 0.5 * glm::pi<double>());
  // Below the outer one, which glTF wants.
  out.spot.innerConeAngle =
      std::min<double>(light.inner_cone_angle, out.spot.outerConeAngle * (1.0 - 1e-7));
  model_.lights.push_back(out);
  const int slide = !light.projection ? -1
                                      : texture_of(static_cast<int>(light.projection->image),
                                                   static_cast<int>(light.projection->sampler));
  tinygltf::Node& node = add_node(light.name, light_transform(light));
  node.extensions["KHR_lights_punctual"] = tinygltf::Value(tinygltf::Value::Object{
      {"light", tinygltf::Value(static_cast<int>(model_.lights.size()) - 1)}});
  if (light.type != LightType::kDirectional) node.extras = lamp_extras(light, slide);
  return node;
}

void Writer::add_sun(const Sun& sun) {
  Light light;
  light.name = "sun";
  light.type = LightType::kDirectional;
  const glm::vec3& e = sun.irradiance;
  light.intensity = std::max({1e-20f, e.r, e.g, e.b});
  light.color = e / light.intensity;
  light.direction = -sun.direction_to_sun;
  add_light(light).extras = sun_extras(sun);
}

// Puts the finest mesh at the node itself and the others at nodes that no scene shows. [MSFT_lod]
void Writer::add_levels(int node, const Instance& instance) {
  tinygltf::Value::Array ids, coverages;
  for (const Level& level : instance.levels) {
    const bool finest = coverages.empty();
    coverages.emplace_back(static_cast<double>(level.coverage));
    if (finest) {
      model_.nodes[static_cast<std::size_t>(node)].mesh = static_cast<int>(level.mesh);
      continue;
    }
    tinygltf::Node coarse = model_.nodes[static_cast<std::size_t>(node)];
    coarse.mesh = static_cast<int>(level.mesh);
    ids.emplace_back(static_cast<int>(model_.nodes.size()));
    model_.nodes.push_back(std::move(coarse));
  }
  tinygltf::Node& written = model_.nodes[static_cast<std::size_t>(node)];
  written.extensions["MSFT_lod"] =
      tinygltf::Value(tinygltf::Value::Object{{"ids", tinygltf::Value(std::move(ids))}});
  written.extras = tinygltf::Value(
      tinygltf::Value::Object{{"MSFT_screencoverage", tinygltf::Value(std::move(coverages))}});
  add_instance_extras(written.extras, instance);
  use_extension("MSFT_lod");
}

Result<std::vector<std::uint8_t>> Writer::run() {
  model_.asset.version = "2.0";
  model_.asset.generator = "kaamos";
  model_.scenes.emplace_back();
  model_.scenes[0].name = scene_.name;
  model_.scenes[0].extras = scene_extras(scene_);
  model_.defaultScene = 0;
  for (const Sampler& sampler : scene_.samplers) {
    tinygltf::Sampler out;
    out.wrapS = wrap_mode(sampler.wrap_u);
    out.wrapT = wrap_mode(sampler.wrap_v);
    out.magFilter = sampler.mag_filter == Filter::kLinear ? TINYGLTF_TEXTURE_FILTER_LINEAR
                                                          : TINYGLTF_TEXTURE_FILTER_NEAREST;
    out.minFilter = min_filter(sampler);
    model_.samplers.push_back(out);
  }
  for (const TextureImage& image : scene_.images) {
    const Status status = add_image(image);
    if (!status.ok()) return status.error();
  }
  for (const Material& material : scene_.materials) add_material(material);
  for (const Mesh& mesh : scene_.meshes) add_mesh(mesh);
  for (const Instance& instance : scene_.instances) add_instance(instance);
  for (const Camera& camera : scene_.cameras) add_camera(camera);
  if (scene_.sun) add_sun(*scene_.sun);
  for (const Light& light : scene_.lights) add_light(light);
  if (data_.size() > 0xF0000000u)
    return make_error(ErrorId::kGltfWrite, "needs " + std::to_string(data_.size()) +
                                               " bytes, a .glb holds less than 4 GB");
  model_.buffers.emplace_back();
  model_.buffers[0].data = std::move(data_);
  std::ostringstream stream;
  tinygltf::TinyGLTF writer;
  if (!writer.WriteGltfSceneToStream(&model_, stream, false, true))
    return make_error(ErrorId::kGltfWrite, "the glTF writer failed");
  const std::string text = std::move(stream).str();
  return std::vector<std::uint8_t>(text.begin(), text.end());
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_glb(const Scene& scene) {
  const auto failed = [&](const Error& error) {
    return within("scene \"" + scene.name + "\"", error, ErrorId::kGltfWrite);
  };
  const Status status = validate(scene);
  if (!status.ok()) return failed(status.error());
  try {
    const Scene posed = posed_scene(scene, 0.0);
    Result<std::vector<std::uint8_t>> bytes = Writer(posed).run();
    if (!bytes.ok()) return failed(bytes.error());
    return bytes;
  } catch (const std::exception& error) {
    return failed(make_error(ErrorId::kGltfWrite, error.what()));
  }
}

Status write_glb(const std::string& path, const Scene& scene) {
  const Result<std::vector<std::uint8_t>> bytes = encode_glb(scene);
  if (!bytes.ok()) return bytes.error();
  return write_file(path, bytes.value());
}

}  // namespace kaamos::effects

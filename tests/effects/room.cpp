// SPDX-License-Identifier: MIT
#include "room.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "effects/assets/scene/shapes.h"

namespace kaamos::test {

using namespace effects;

namespace {

Material material(const char* name, const glm::vec4& color, float metallic, float roughness,
                  std::uint32_t flags = kMaterialDoubleSided) {
  Material out;
  out.name = name;
  out.constants.base_color = color;
  out.constants.metallic = metallic;
  out.constants.roughness = roughness;
  out.constants.flags = flags;
  return out;
}

// White, with holes: alpha is 0 in every second field.
TextureImage holes() {
  TextureImage image;
  image.name = "holes";
  image.width = image.height = 8;
  image.mips.emplace_back();
  for (std::uint32_t i = 0; i < 64; ++i) {
    const std::uint8_t alpha = (i / 8 / 2 + i % 8 / 2) % 2 == 0 ? 255 : 0;
    image.mips[0].insert(image.mips[0].end(), {255, 255, 255, alpha});
  }
  return image;
}

void place(Scene& scene, const char* name, Shape shape, std::uint32_t id, const glm::dvec3& at,
           const glm::dmat4& turn = glm::dmat4(1.0)) {
  Mesh mesh;
  mesh.name = name;
  add_shape(mesh, std::move(shape), id, id == kRoomCard);
  Instance instance;
  instance.name = name;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.transform = translate(at) * turn;
  if (id == kRoomGlass) instance.mask = kMaskTransparent;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(std::move(instance));
}

Shape ball(double radius) {
  std::vector<glm::dvec2> profile;
  for (int i = 0; i <= 12; ++i) {
    const double angle = -1.5707963267948966 + 3.141592653589793 * i / 12;
    profile.emplace_back(i == 0 || i == 12 ? 0.0 : radius * std::cos(angle),
                         radius * std::sin(angle));
  }
  return revolve(profile, 24);
}

// No roughness lies halfway between two 8-bit steps, where each backend may round its own way.
void add_materials(Scene& scene) {
  scene.materials = {
      material("wall", {0.7f, 0.6f, 0.5f, 1}, 0, 1),
      material("floor", {0.4f, 0.45f, 0.5f, 1}, 0, 0.25f),
      material("mirror", {0.9f, 0.9f, 0.9f, 1}, 1, 0),
      material("metal", {0.9f, 0.7f, 0.4f, 1}, 1, 0.4f),
      material("card", {0.2f, 0.8f, 0.3f, 1}, 0, 0.8f,
               kMaterialMask | kMaterialDoubleSided | kMaterialAlphaTested),
      material("glass", {0.2f, 0.5f, 0.7f, 0.4f}, 0, 0, kMaterialBlend | kMaterialDoubleSided),
      material("lamp", {0.1f, 0.1f, 0.1f, 1}, 0, 1)};
  scene.materials[kRoomCard].constants.image[kBaseColorTexture] = 0;
  scene.materials[kRoomLamp].constants.emissive = glm::vec3(4, 2, 1);
  scene.images.push_back(holes());
  generate_mips(scene.images.back());
  Sampler nearest;
  nearest.min_filter = nearest.mag_filter = nearest.mip_filter = Filter::kNearest;
  scene.samplers = {nearest};
}

void add_lights(Scene& scene) {
  Light bulb;
  bulb.name = "bulb";
  bulb.color = {1, 0.75f, 0.5f};
  bulb.intensity = 2;
  bulb.position = {-1.25, 2, -0.5};
  bulb.radius = 0.0625f;
  Light spot;
  spot.name = "spot";
  spot.type = LightType::kSpot;
  spot.intensity = 4;
  spot.position = {1.5, 2.25, 1};
  spot.direction = glm::normalize(glm::vec3(-1, -2, -1));
  spot.inner_cone_angle = 0.3f;
  spot.outer_cone_angle = 0.6f;
  spot.radius = 0.03125f;
  Light bare = bulb;
  bare.name = "bare";
  bare.color = {0.5f, 0.6f, 1};
  bare.intensity = 0.5f;
  bare.position = {0.5, 0.25, 0.75};
  bare.radius = 0;
  scene.lights = {bulb, spot, bare};
  // A range derived from the intensity would change the light's fall-off with it.
  for (Light& light : scene.lights) light.range = 8;
}

}  // namespace

Scene make_room() {
  Scene scene;
  scene.name = "room";
  add_materials(scene);
  place(scene, "floor", patch({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 2, 2), kRoomFloor, {0, 0, 0});
  place(scene, "back", patch({-2, 0, 0}, {4, 0, 0}, {0, 2.625, 0}, 2, 2), kRoomWall, {0, 0, -2});
  place(scene, "left", patch({0, 0, 2}, {0, 0, -4}, {0, 2.625, 0}, 2, 2), kRoomWall, {-2, 0, 0});
  place(scene, "right", patch({0, 0, -2}, {0, 0, 2.5}, {0, 2.625, 0}, 2, 2), kRoomWall, {2, 0, 0});
  place(scene, "ceiling", patch({-2, 0, -2}, {4, 0, 0}, {0, 0, 2}, 2, 2), kRoomWall, {0, 2.625, 0});
  place(scene, "mirror", box({0.5, 0.625, 0.03125}), kRoomMirror, {-0.75, 0.75, -1.5},
        rotate_y(0.35));
  place(scene, "ball", ball(0.375), kRoomMetal, {0.75, 0.375, -0.5});
  place(scene, "block", box({0.25, 0.25, 0.25}), kRoomWall, {0, 0.25, -1.25}, rotate_y(0.6));
  place(scene, "card", patch({-0.375, 0, 0}, {0.75, 0, 0}, {0, 0.75, 0}, 1, 1), kRoomCard,
        {-1, 0, 0}, rotate_y(-0.5));
  place(scene, "lamp", box({0.125, 0.0625, 0.125}), kRoomLamp, {1.25, 1.5, -1.5});
  place(scene, "pane", box({0.5, 0.5, 0.015625}), kRoomGlass, {0.375, 1, 0.25}, rotate_y(0.2));
  Camera camera;
  camera.name = "eye";
  camera.camera_to_world = look_at({0.25, 1.25, 2.5}, {0, 0.875, -0.5});
  scene.cameras.push_back(camera);
  add_lights(scene);
  Sun sun;
  sun.direction_to_sun = glm::normalize(glm::vec3(0.5f, 0.9f, 0.7f));
  sun.angular_radius = 0.03f;
  scene.sun = sun;
  scene.sky.zenith = scene.sky.horizon = scene.sky.ground = glm::vec3(0.25f, 0.375f, 0.5f);
  return scene;
}

Case scaled(Case of, double s, bool by_transforms) {
  const auto f = static_cast<float>(s);
  if (!by_transforms) {
    for (Mesh& mesh : of.scene.meshes) {
      for (Vertex& vertex : mesh.vertices) vertex.position *= f;
    }
  }
  for (Instance& instance : of.scene.instances) {
    for (int c = by_transforms ? 0 : 3; c < 4; ++c) {
      instance.transform[c] = glm::dvec4(glm::dvec3(instance.transform[c]) * s, c == 3 ? 1 : 0);
    }
  }
  for (Camera& camera : of.scene.cameras) {
    camera.camera_to_world[3] = glm::dvec4(camera.position() * s, 1);
    camera.near_plane *= s;
  }
  for (Light& light : of.scene.lights) {
    light.position *= s;
    light.radius *= f;
    light.range *= f;
    light.intensity *= f * f;
  }
  of.options.ao_radius *= f;
  of.options.contact.length *= f;
  of.options.indirect.length *= f;
  of.options.reflection.longest *= f;
  of.options.reflection.shortest *= f;
  of.options.glass.reflection_length *= f;
  of.options.glass.depth_scale /= f;
  of.options.cell *= f;
  return of;
}

Scene moved(Scene scene, const glm::dvec3& by) {
  for (Instance& instance : scene.instances) instance.transform[3] += glm::dvec4(by, 0);
  for (Camera& camera : scene.cameras) camera.camera_to_world[3] += glm::dvec4(by, 0);
  for (Light& light : scene.lights) light.position += by;
  return scene;
}

Scene turned(Scene scene, const glm::dmat3& turn) {
  const glm::mat3 single(turn);
  for (Instance& instance : scene.instances) {
    instance.transform = glm::dmat4(turn) * instance.transform;
  }
  for (Camera& camera : scene.cameras) {
    camera.camera_to_world = glm::dmat4(turn) * camera.camera_to_world;
  }
  for (Light& light : scene.lights) {
    light.position = turn * light.position;
    light.direction = single * light.direction;
  }
  if (scene.sun) scene.sun->direction_to_sun = single * scene.sun->direction_to_sun;
  return scene;
}

Scene reordered(Scene scene) {
  for (Mesh& mesh : scene.meshes) {
    Mesh out;
    out.name = mesh.name;
    for (const Geometry& geometry : mesh.geometries) {
      const std::span<const Vertex> vertices(mesh.vertices.data() + geometry.first_vertex,
                                             geometry.vertex_count);
      std::vector<std::uint32_t> indices;
      for (std::uint32_t i = geometry.index_count; i > 0; i -= 3) {
        for (const std::uint32_t corner : {i - 2, i - 1, i - 3}) {
          indices.push_back(mesh.index(geometry, corner));
        }
      }
      out.add_geometry(vertices, indices, geometry.material, geometry.alpha_tested);
    }
    mesh = std::move(out);
  }
  return scene;
}

Scene flattened(Scene scene) {
  for (Instance& instance : scene.instances) {
    Mesh mesh = scene.meshes[instance.mesh];
    const glm::dmat3 linear(instance.transform);
    const glm::dmat3 of_normals = glm::transpose(glm::inverse(linear));
    for (Vertex& v : mesh.vertices) {
      v.position = glm::vec3(instance.transform * glm::dvec4(glm::dvec3(v.position), 1));
      v.normal = glm::vec3(glm::normalize(of_normals * glm::dvec3(v.normal)));
      v.tangent = glm::vec4(glm::vec3(glm::normalize(linear * glm::dvec3(v.tangent))), v.tangent.w);
    }
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    instance.transform = glm::dmat4(1.0);
    scene.meshes.push_back(std::move(mesh));
  }
  return scene;
}

Scene stretched(Scene scene) {
  glm::dmat3 undo(0.0);
  undo[0] = {0.25, 0, 0};
  undo[1] = {4, 8, 0};
  undo[2] = {0, 0, 0.125};
  const glm::dmat3 squeeze = glm::inverse(undo);
  for (Mesh& mesh : scene.meshes) {
    for (Vertex& v : mesh.vertices) {
      v.position = glm::vec3(squeeze * glm::dvec3(v.position));
      // Not normalised: other lengths would change the directions interpolated between vertices.
      v.normal = glm::vec3(glm::transpose(undo) * glm::dvec3(v.normal));
      v.tangent = glm::vec4(glm::vec3(squeeze * glm::dvec3(v.tangent)), v.tangent.w);
    }
  }
  for (Instance& instance : scene.instances) instance.transform *= glm::dmat4(undo);
  return scene;
}

Scene mirrored(Scene scene) {
  glm::dmat4 flip(1.0);
  flip[0][0] = -1;
  for (Instance& instance : scene.instances) instance.transform = flip * instance.transform;
  for (Camera& camera : scene.cameras) {
    glm::dmat4& m = camera.camera_to_world;
    m = flip * m;
    m[0] = -m[0];  // a camera cannot mirror, so its picture is flipped instead
  }
  for (Light& light : scene.lights) {
    light.position.x = -light.position.x;
    light.direction.x = -light.direction.x;
  }
  if (scene.sun) scene.sun->direction_to_sun.x = -scene.sun->direction_to_sun.x;
  return scene;
}

Scene brightened(Scene scene, float k) {
  for (Light& light : scene.lights) light.intensity *= k;
  for (Material& material : scene.materials) material.constants.emissive *= k;
  if (scene.sun) scene.sun->irradiance *= k;
  for (glm::vec3* color : {&scene.sky.zenith, &scene.sky.horizon, &scene.sky.ground}) *color *= k;
  scene.exposure /= k;
  return scene;
}

}  // namespace kaamos::test

// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/lounge.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "effects/assets/built_in/lounge_parts.h"
#include "effects/assets/common/sampling.h"
#include "effects/assets/scene/shapes.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace lounge {
namespace {

std::uint8_t byte(double unit) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(unit, 0.0, 1.0)));
}

template <class Color>
TextureImage picture(const char* name, std::uint32_t size, bool srgb, Color color) {
  TextureImage image;
  image.name = name;
  image.width = image.height = size;
  image.srgb = srgb;
  image.mips.emplace_back(std::size_t{size} * size * 4);
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      const glm::dvec3 c = color(x, y);
      std::uint8_t* out = &image.mips[0][(std::size_t{y} * size + x) * 4];
      for (int k = 0; k < 3; ++k) out[k] = byte(c[k]);
      out[3] = 255;
    }
  return image;
}

double speckle(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
  return unit_float(hash_combine(x + 4096u * y, seed));
}

/// Joints between stone tiles, 2 x 2 in a picture that covers 1.2 m.
bool joint(std::uint32_t x, std::uint32_t y) {
  return x % 256 < 3 || y % 256 < 3;
}

TextureImage floor_color() {
  return picture("floor colour", 512, true, [](std::uint32_t x, std::uint32_t y) {
    if (joint(x, y)) return glm::dvec3(0.30, 0.28, 0.26);
    const double tile = 0.05 * speckle(x / 256, y / 256, 1);
    const double grain =
        0.07 * (speckle(x / 3, y / 3, 2) - 0.5) + (speckle(x / 2, y / 2, 3) > 0.985 ? -0.16 : 0.0);
    return glm::dvec3(0.66, 0.62, 0.57) + tile + grain;
  });
}

TextureImage floor_roughness() {
  return picture("floor roughness", 512, false, [](std::uint32_t x, std::uint32_t y) {
    const bool even = ((x / 256) + (y / 256)) % 2 == 0;
    return glm::dvec3(0.0, joint(x, y) ? 0.9 : even ? 0.15 : 0.35, 0.0);
  });
}

TextureImage weave_normal() {
  return picture("weave normal", 128, false, [](std::uint32_t x, std::uint32_t y) {
    const double sx = std::sin(x * glm::two_pi<double>() / 16.0);
    const double sy = std::sin(y * glm::two_pi<double>() / 16.0);
    const bool over = ((x / 8) + (y / 8)) % 2 == 0;
    const glm::dvec3 n =
        glm::normalize(glm::dvec3(over ? 0.35 * sx : 0.1 * sx, over ? 0.1 * sy : 0.35 * sy, 1.0));
    return 0.5 * n + 0.5;
  });
}

TextureImage cover_color() {
  return picture("magazine cover", 256, true, [](std::uint32_t x, std::uint32_t y) {
    const double u = x / 255.0, v = y / 255.0;
    if (v < 0.2 && v > 0.07 && u > 0.08 && u < 0.92)
      return (x / 18) % 4 == 3 ? glm::dvec3(0.75, 0.1, 0.08) : glm::dvec3(0.96, 0.95, 0.9);
    const double sun = std::hypot(u - 0.55, v - 0.5);
    if (sun < 0.2) return glm::dvec3(0.98, 0.78, 0.3);
    if (v > 0.6 + 0.06 * std::sin(u * 9.0)) return glm::dvec3(0.08, 0.16, 0.24);
    if (v > 0.85 && u < 0.6) return glm::dvec3(0.9, 0.9, 0.9);
    return glm::dvec3(0.75, 0.1, 0.08);
  });
}

TextureImage rug_color() {
  return picture("rug colour", 256, true, [](std::uint32_t x, std::uint32_t y) {
    const int d = std::abs(static_cast<int>(x % 64) - 32) + std::abs(static_cast<int>(y % 64) - 32);
    const double noise = 0.05 * (speckle(x, y, 9) - 0.5);
    if (d > 28 && d < 36) return glm::dvec3(0.75, 0.68, 0.55) + noise;
    return (d < 10 ? glm::dvec3(0.55, 0.25, 0.18) : glm::dvec3(0.35, 0.36, 0.40)) + noise;
  });
}

struct Look {
  const char* name;
  glm::vec3 color;
  float metallic;
  float roughness;
};

// In the order of MaterialId; colours are linear.
constexpr Look kLooks[] = {
    {"floor", {1.0f, 1.0f, 1.0f}, 1.0f, 1.0f},
    {"wall", {0.74f, 0.70f, 0.64f}, 0.0f, 0.9f},
    {"ceiling", {0.80f, 0.78f, 0.75f}, 0.0f, 0.9f},
    {"wood", {0.40f, 0.21f, 0.10f}, 0.0f, 0.4f},
    {"dark wood", {0.16f, 0.085f, 0.05f}, 0.0f, 0.35f},
    {"brass", {0.80f, 0.58f, 0.28f}, 1.0f, 0.28f},
    {"black metal", {0.05f, 0.05f, 0.055f}, 0.6f, 0.5f},
    {"rubber", {0.03f, 0.03f, 0.03f}, 0.0f, 0.8f},
    {"teal fabric", {0.055f, 0.21f, 0.23f}, 0.0f, 0.85f},
    {"red fabric", {0.46f, 0.075f, 0.05f}, 0.0f, 0.85f},
    {"sand fabric", {0.56f, 0.47f, 0.35f}, 0.0f, 0.85f},
    {"piping", {0.09f, 0.05f, 0.035f}, 0.0f, 0.5f},
    {"rug", {1.0f, 1.0f, 1.0f}, 0.0f, 1.0f},
    {"paper", {0.85f, 0.84f, 0.80f}, 0.0f, 0.7f},
    {"magazine cover", {1.0f, 1.0f, 1.0f}, 0.0f, 0.25f},
    {"porcelain", {0.83f, 0.82f, 0.80f}, 0.0f, 0.2f},
    {"soil", {0.06f, 0.04f, 0.03f}, 0.0f, 1.0f},
    {"stem", {0.10f, 0.22f, 0.06f}, 0.0f, 0.6f},
    {"leaf", {1.0f, 1.0f, 1.0f}, 0.0f, 0.5f},
    {"dome shell", {0.62f, 0.52f, 0.38f}, 0.4f, 0.5f},
    {"dome line", {0.9f, 0.8f, 0.6f}, 0.0f, 0.5f},
    {"lamp bulb", {0.9f, 0.85f, 0.75f}, 0.0f, 0.5f},
    {"terrace", {0.45f, 0.43f, 0.40f}, 0.0f, 0.9f},
};
static_assert(std::size(kLooks) == kMaterialCount);

// The places of the floor lamps, and the colour and intensity of their bulbs, in candela.
constexpr glm::dvec3 kFloorLamps[] = {{-5.1, 0, -4.3}, {1.9, 0, -4.4}};
constexpr glm::vec3 kBulbColor(1.0f, 0.78f, 0.5f);
constexpr float kBulbIntensity = 2.0f;

void use_image(Scene& scene, MaterialId material, TextureSlot slot, std::int32_t image,
               float scale = 1.0f) {
  MaterialConstants& constants = scene.materials[material].constants;
  constants.image[slot] = image;
  constants.uv_matrix[slot] = glm::vec4(scale, 0, 0, scale);
}

void add_instance(Scene& scene, const std::string& name, std::uint32_t mesh, const glm::dvec3& at,
                  double turn = 0.0) {
  Instance instance;
  instance.name = name;
  instance.mesh = mesh;
  instance.transform = translate(at) * rotate_y(turn);
  scene.instances.push_back(instance);
}

std::uint32_t add_mesh(Scene& scene, Mesh mesh) {
  scene.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

void add_things(Scene& scene) {
  add_instance(scene, "room", add_mesh(scene, room()), {0, 0, 0});
  add_instance(scene, "dome", add_mesh(scene, dome()), {0, 0, 0});
  add_instance(scene, "rug", add_mesh(scene, rug()), {0, 0, 0});
  // Round sofas on both sides of the table under the dome: one open towards the camera, one away
  // from it.
  const std::uint32_t round = add_mesh(scene, round_sofa());
  add_instance(scene, "round sofa left", round, {0, 0.012, 0}, -2.35);
  add_instance(scene, "round sofa right", round, {0, 0.012, 0}, 0.85);
  add_instance(scene, "table", add_mesh(scene, table()), {0, 0.012, 0});
  add_instance(scene, "magazine", add_mesh(scene, magazine()), {-0.22, 0.4472, 0.1}, 0.5);
  const std::uint32_t seat = add_mesh(scene, chair());
  add_instance(scene, "chair 1", seat, {-3.05, 0, 2.35}, -0.2);
  add_instance(scene, "chair 2", seat, {-1.75, 0, 3.3}, -1.2);
  add_instance(scene, "chair 3", seat, {-4.6, 0, 0.1}, 0.75);
  add_instance(scene, "chair 4", seat, {0.3, 0, 3.35}, -2.5);
  const std::uint32_t sofa = add_mesh(scene, small_sofa());
  add_instance(scene, "small sofa 1", sofa, {-3.6, 0, -4.15});
  add_instance(scene, "small sofa 2", sofa, {3.3, 0, -4.15});
  add_instance(scene, "small sofa 3", sofa, {4.6, 0, 1.6}, -1.35);
  const std::uint32_t lamp = add_mesh(scene, floor_lamp());
  const std::uint32_t glow = add_mesh(scene, bulb());
  for (std::size_t i = 0; i < std::size(kFloorLamps); ++i) {
    const std::string name = "floor lamp " + std::to_string(i + 1);
    add_instance(scene, name, lamp, kFloorLamps[i]);
    add_instance(scene, name + " bulb", glow, kFloorLamps[i]);
    scene.instances.back().mask = kMaskEmissiveProxy;
  }
  const std::uint32_t green = add_mesh(scene, plant());
  add_instance(scene, "plant 1", green, {4.9, 0, -2.2}, 0.4);
  add_instance(scene, "plant 2", green, {-3.35, 0, 0.0}, 2.6);
}

void add_lights(Scene& scene) {
  Sun sun;
  sun.direction_to_sun = glm::normalize(glm::vec3(0.60f, 0.92f, -0.30f));
  sun.irradiance = glm::vec3(6.5f, 5.9f, 5.0f);
  scene.sun = sun;
  scene.sky = default_sky();
  for (int i = 0; i < 8; ++i) {
    Light light;
    light.name = "spot " + std::to_string(i);
    light.type = LightType::kSpot;
    light.color = glm::vec3(1.0f, 0.82f, 0.6f);
    light.intensity = 3.0f;
    light.position = glm::dvec3(-4.9 + 1.4 * i, 3.95, -4.3);
    light.range = 6.0f;
    light.inner_cone_angle = 0.3f;
    light.outer_cone_angle = 0.6f;
    scene.lights.push_back(light);
  }
  for (const glm::dvec3& foot : kFloorLamps) {
    Light light;
    light.name = "lamp";
    light.color = kBulbColor;
    light.intensity = kBulbIntensity;
    light.position = foot + glm::dvec3(0, kBulbHeight, 0);
    light.range = 5.0f;
    light.radius = static_cast<float>(kBulbRadius);
    scene.lights.push_back(light);
  }
}

void add_cameras(Scene& scene) {
  const auto camera = [&](const char* name, const glm::dvec3& eye, const glm::dvec3& target,
                          double fov) {
    Camera out;
    out.name = name;
    out.camera_to_world = look_at(eye, target);
    out.vertical_fov = fov;
    scene.cameras.push_back(out);
  };
  camera("lounge", {-5.5, 1.7, 4.6}, {0.3, 1.32, -0.8}, 0.92);
  camera("table", {-0.75, 0.95, 1.15}, {0.02, 0.44, -0.02}, 0.6);
  camera("chairs", {-4.6, 1.15, 3.9}, {-2.3, 0.4, 2.1}, 0.8);
  camera("plant", {2.6, 1.3, -0.9}, {5.0, 0.95, -2.3}, 0.8);
}

}  // namespace

void add_materials(Scene& scene) {
  for (const Look& look : kLooks) {
    Material material;
    material.name = look.name;
    material.constants.base_color = glm::vec4(look.color, 1.0f);
    material.constants.metallic = look.metallic;
    material.constants.roughness = look.roughness;
    scene.materials.push_back(material);
  }
  scene.samplers.push_back(Sampler{});
  scene.images = {floor_color(), floor_roughness(), weave_normal(),
                  cover_color(), rug_color(),       leaf_texture()};
  for (std::size_t i = 0; i + 1 < scene.images.size(); ++i) generate_mips(scene.images[i]);
  generate_mips(scene.images.back(), 0.5f);
  use_image(scene, kFloor, kBaseColorTexture, 0);
  use_image(scene, kFloor, kMetallicRoughnessTexture, 1);
  for (const MaterialId fabric : {kTealFabric, kRedFabric, kSandFabric})
    use_image(scene, fabric, kNormalTexture, 2, 12.0f);
  use_image(scene, kCover, kBaseColorTexture, 3);
  use_image(scene, kRug, kBaseColorTexture, 4, 1.5f);
  use_image(scene, kLeaf, kBaseColorTexture, 5);
  scene.materials[kLeaf].constants.flags =
      kMaterialMask | kMaterialAlphaTested | kMaterialDoubleSided;
  scene.materials[kDomeLine].constants.emissive = glm::vec3(6.0f, 4.4f, 2.4f);
  // The radiance of a sphere that gives the lamp's light.
  scene.materials[kLampBulb].constants.emissive =
      kBulbColor *
      (kBulbIntensity / static_cast<float>(glm::pi<double>() * kBulbRadius * kBulbRadius));
}

}  // namespace lounge

Scene make_lounge() {
  Scene scene;
  scene.name = "lounge";
  lounge::add_materials(scene);
  lounge::add_things(scene);
  lounge::add_lights(scene);
  lounge::add_cameras(scene);
  return scene;
}

Scene make_lounge_loose_table() {
  Scene scene = make_lounge();
  scene.name = "lounge-loose-table";
  Animation slide = {.name = "slide", .channels = {}, .duration = 2 * kTableSeconds};
  for (Instance& instance : scene.instances) {
    if (instance.name != "table" && instance.name != "magazine") continue;
    instance.motion.node = static_cast<std::int32_t>(scene.nodes.size());
    instance.motion.animation = 0;
    // Nodes move what is still in the instance's own space.
    const glm::dvec3 way =
        glm::inverse(glm::dmat3(instance.transform)) * glm::dvec3(kTableSlide, 0, 0);
    Channel channel;
    channel.node = static_cast<std::uint32_t>(scene.nodes.size());
    channel.path = ChannelPath::kTranslation;
    channel.times = {0.0f, static_cast<float>(kTableSeconds),
                     static_cast<float>(2 * kTableSeconds)};
    channel.values = {glm::vec4(0), glm::vec4(glm::vec3(way), 0), glm::vec4(0)};
    slide.channels.push_back(std::move(channel));
    Node node;
    node.name = instance.name;
    scene.nodes.push_back(std::move(node));
  }
  scene.animations.push_back(std::move(slide));
  Camera& camera = scene.cameras.front();
  camera.name = "below the table";
  camera.camera_to_world = look_at(glm::dvec3(-1.3, 0.55, 1.3), glm::dvec3(0, 0.1, 0));
  camera.vertical_fov = 0.7;
  return scene;
}

}  // namespace kaamos::effects

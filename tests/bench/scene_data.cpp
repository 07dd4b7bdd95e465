// SPDX-License-Identifier: MIT
#include "scene_data.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "effects/assets/built_in/lounge.h"

namespace kaamos::bench {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Uniform in [0, 1): a hash of pixel and dimension [Jarzynski and Olano 2020, pcg].
float uniform(uint32_t pixel, uint32_t dimension) {
  uint32_t state = (pixel * 8u + dimension) * 747796405u + 2891336453u;
  state = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return static_cast<float>(((state >> 22) ^ state) >> 8) * 0x1p-24f;
}

// Transforms from a local frame whose third axis is `n`.
glm::vec3 from_local(const glm::vec3& n, const glm::vec3& local) {
  const glm::vec3 up = std::fabs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  const glm::vec3 x = glm::normalize(glm::cross(up, n));
  return x * local.x + glm::cross(n, x) * local.y + n * local.z;
}

glm::vec3 cosine_direction(const glm::vec3& n, float u, float v) {
  const float r = std::sqrt(u);
  const float phi = 2 * kPi * v;
  return from_local(n, {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)});
}

// Reflects the view about a half vector from a GGX lobe of roughness 0.3. [Walter 2007]
glm::vec3 ggx_direction(const glm::vec3& n, const glm::vec3& view, float u, float v) {
  constexpr float kAlpha = 0.3f * 0.3f;
  const float cosine = std::sqrt((1 - u) / (1 + (kAlpha * kAlpha - 1) * u));
  const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
  const float phi = 2 * kPi * v;
  const glm::vec3 half = from_local(n, {sine * std::cos(phi), sine * std::sin(phi), cosine});
  const glm::vec3 direction = glm::reflect(view, half);
  return glm::dot(direction, n) > 0 ? direction : glm::reflect(view, n);
}

glm::vec3 sun_direction(const effects::Sun& sun, float u, float v) {
  const float r = std::sin(sun.angular_radius) * std::sqrt(u);
  const float phi = 2 * kPi * v;
  return from_local(sun.direction_to_sun,
                    {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r * r)});
}

Ray make_ray(const glm::vec3& origin, const glm::vec3& direction, float t_max) {
  return {{origin.x, origin.y, origin.z}, 0, {direction.x, direction.y, direction.z}, t_max};
}

}  // namespace

SceneData make_scene_data() {
  SceneData data;
  data.scene = effects::make_lounge();
  for (const effects::Mesh& mesh : data.scene.meshes) {
    MeshData& out = data.meshes.emplace_back();
    out.vertices = &mesh.vertices;
    out.first_record = data.record_count;
    for (const effects::Geometry& geometry : mesh.geometries) {
      out.geometries.push_back({geometry.first_vertex, geometry.vertex_count,
                                static_cast<uint32_t>(out.indices.size()), geometry.index_count / 3,
                                geometry.material, geometry.alpha_tested});
      for (uint32_t i = 0; i < geometry.index_count; ++i) {
        out.indices.push_back(mesh.index(geometry, i));
      }
    }
    data.record_count += static_cast<uint32_t>(mesh.geometries.size());
  }
  for (const effects::Instance& instance : data.scene.instances) {
    InstanceData& out = data.instances.emplace_back();
    out.mesh = instance.mesh;
    const glm::mat3x4 rows = effects::transform_3x4(instance);
    std::memcpy(out.transform.data(), &rows, sizeof(out.transform));
  }
  return data;
}

std::vector<MaterialData> materials_of(const effects::Scene& scene) {
  std::vector<MaterialData> out;
  for (const effects::Material& material : scene.materials) {
    const effects::MaterialConstants& c = material.constants;
    out.push_back({{c.base_color.x, c.base_color.y, c.base_color.z, c.base_color.w},
                   c.alpha_cutoff,
                   c.image[effects::kBaseColorTexture]});
  }
  return out;
}

const char* name_of(RaySet set) {
  static constexpr const char* kNames[] = {"primary", "sun", "ao", "ggx", "diffuse"};
  return kNames[static_cast<int>(set)];
}

bool is_visibility(RaySet set) {
  return set == RaySet::kSun || set == RaySet::kAmbientOcclusion;
}

std::vector<Ray> primary_rays(const effects::Scene& scene, uint32_t width, uint32_t height) {
  const effects::Camera& camera = scene.cameras.front();
  const glm::mat3 axes(glm::dmat3(camera.camera_to_world));
  const float scale = static_cast<float>(std::tan(0.5 * camera.vertical_fov));
  std::vector<Ray> rays;
  rays.reserve(size_t{width} * height);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const float h = static_cast<float>(height);
      const float u = (2 * (static_cast<float>(x) + 0.5f) - static_cast<float>(width)) / h;
      const float v = (h - 2 * (static_cast<float>(y) + 0.5f)) / h;
      const glm::vec3 direction = glm::normalize(axes * glm::vec3(u * scale, v * scale, -1));
      rays.push_back(make_ray(glm::vec3(camera.position()), direction, kInfinity));
    }
  }
  return rays;
}

std::vector<Ray> secondary_rays(const effects::Scene& scene,
                                const std::vector<SurfacePoint>& points, RaySet set) {
  const effects::Sun sun = scene.sun.value_or(effects::Sun());
  std::vector<Ray> rays;
  rays.reserve(points.size());
  for (uint32_t i = 0; i < points.size(); ++i) {
    const SurfacePoint& point = points[i];
    const glm::vec3 position(point.position[0], point.position[1], point.position[2]);
    const glm::vec3 normal(point.normal[0], point.normal[1], point.normal[2]);
    const glm::vec3 view(point.view[0], point.view[1], point.view[2]);
    const float u = uniform(i, 0);
    const float v = uniform(i, 1);
    switch (set) {
      case RaySet::kSun: {
        // Starts on the side that faces the sun: a renderer does not trace rays for points that it
        // knows to be dark.
        const glm::vec3 direction = sun_direction(sun, u, v);
        const bool behind = glm::dot(normal, direction) < 0;
        rays.push_back(
            make_ray(behind ? position - 2e-3f * normal : position, direction, kInfinity));
        break;
      }
      case RaySet::kAmbientOcclusion:
        rays.push_back(make_ray(position, cosine_direction(normal, u, v), 4));
        break;
      case RaySet::kGgx:
        rays.push_back(make_ray(position, ggx_direction(normal, view, u, v), kInfinity));
        break;
      default:
        rays.push_back(make_ray(position, cosine_direction(normal, u, v), kInfinity));
        break;
    }
  }
  return rays;
}

}  // namespace kaamos::bench

// SPDX-License-Identifier: MIT
#include "embree_loops.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>

#include "effects/assets/image/srgb.h"
#include "effects/assets/scene/texture_image.h"
#include "tiles.h"

namespace kaamos::bench {
namespace {

namespace shim = embree::shim;

void begin_ray(const Ray& in, RTCRay& ray) {
  ray.org_x = in.origin[0];
  ray.org_y = in.origin[1];
  ray.org_z = in.origin[2];
  ray.tnear = in.t_min;
  ray.dir_x = in.direction[0];
  ray.dir_y = in.direction[1];
  ray.dir_z = in.direction[2];
  ray.time = 0;
  ray.tfar = in.t_max;
  ray.mask = 0xFFFFFFFFu;
  ray.id = 0;
  ray.flags = 0;
}

void begin_hit(RTCHit& hit) {
  hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}

struct Triangle {
  const effects::Vertex* corners[3];

  Triangle(const MeshData& mesh, const GeometryData& geometry, uint32_t primitive) {
    const uint32_t* indices = mesh.indices.data() + geometry.first_index + 3 * size_t{primitive};
    for (int i = 0; i < 3; ++i) {
      corners[i] = mesh.vertices->data() + geometry.first_vertex + indices[i];
    }
  }
  template <typename T>
  T interpolate(T effects::Vertex::*member, float u, float v) const {
    return corners[0]->*member * (1 - u - v) + corners[1]->*member * u + corners[2]->*member * v;
  }
};

// The linear values of 8-bit colours.
const std::array<float, 256>& linear_values(bool srgb) {
  static const auto table = [](bool decode) {
    std::array<float, 256> values;
    for (int i = 0; i < 256; ++i) {
      const float value = static_cast<float>(i) / 255.0f;
      values[i] = decode ? effects::linear_from_srgb(value) : value;
    }
    return values;
  };
  static const std::array<float, 256> kSrgb = table(true);
  static const std::array<float, 256> kLinear = table(false);
  return srgb ? kSrgb : kLinear;
}

// Bilinear filtering, repeat addressing, level 0.
struct Footprint {
  const uint8_t* texels[4];
  float weights[4];

  Footprint(const effects::TextureImage& image, glm::vec2 uv) {
    const int width = static_cast<int>(image.width);
    const int height = static_cast<int>(image.height);
    const float x = (uv.x - std::floor(uv.x)) * static_cast<float>(width) - 0.5f;
    const float y = (uv.y - std::floor(uv.y)) * static_cast<float>(height) - 0.5f;
    const float left = std::floor(x);
    const float top = std::floor(y);
    const float a = x - left;
    const float b = y - top;
    const int x0 = static_cast<int>(left);
    const int y0 = static_cast<int>(top);
    const int columns[2] = {x0 < 0 ? width - 1 : x0, x0 + 1 >= width ? 0 : x0 + 1};
    const int rows[2] = {y0 < 0 ? height - 1 : y0, y0 + 1 >= height ? 0 : y0 + 1};
    for (int i = 0; i < 4; ++i) {
      texels[i] = image.mips[0].data() + 4 * (size_t(rows[i / 2]) * width + columns[i % 2]);
      weights[i] = (i % 2 != 0 ? a : 1 - a) * (i / 2 != 0 ? b : 1 - b);
    }
  }
};

glm::vec3 sample_color(const effects::TextureImage& image, glm::vec2 uv) {
  const Footprint at(image, uv);
  const std::array<float, 256>& linear = linear_values(image.srgb);
  glm::vec3 sum(0);
  for (int i = 0; i < 4; ++i) {
    const uint8_t* t = at.texels[i];
    sum += at.weights[i] * glm::vec3(linear[t[0]], linear[t[1]], linear[t[2]]);
  }
  return sum;
}

float sample_alpha(const effects::TextureImage& image, glm::vec2 uv) {
  const Footprint at(image, uv);
  float sum = 0;
  for (int i = 0; i < 4; ++i) sum += at.weights[i] * static_cast<float>(at.texels[i][3]);
  return sum / 255.0f;
}

void alpha_filter(const RTCFilterFunctionNArguments* arguments) {
  const auto& use = *static_cast<const EmbreeScene::GeometryUse*>(arguments->geometryUserPtr);
  const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
  if (use.scene->is_open(use, hit.primID, hit.u, hit.v)) arguments->valid[0] = 0;
}

}  // namespace

RTCDevice new_embree_device() {
  return rtcNewDevice("frequency_level=simd256");
}

RTCGeometry new_triangles(RTCDevice device, const MeshData& mesh, const GeometryData& geometry) {
  RTCGeometry out = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      out, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, geometry.vertex_count));
  auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
      out, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, geometry.triangle_count));
  const effects::Vertex* source = mesh.vertices->data() + geometry.first_vertex;
  for (uint32_t i = 0; i < geometry.vertex_count; ++i) {
    std::memcpy(vertices + 3 * size_t{i}, &source[i].position, 12);
  }
  std::memcpy(indices, mesh.indices.data() + geometry.first_index,
              size_t{geometry.triangle_count} * 12);
  return out;
}

EmbreeScene::EmbreeScene(const SceneData& data, bool alpha_tested)
    : data_(data), materials_(materials_of(data.scene)), device_(new_embree_device()) {
  std::vector<RTCScene> meshes;
  for (const MeshData& mesh : data.meshes) meshes.push_back(build_mesh(mesh, alpha_tested));
  scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  for (size_t i = 0; i < data.instances.size(); ++i) {
    RTCGeometry instance = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, meshes[data.instances[i].mesh]);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR,
                            data.instances[i].transform.data());
    rtcSetGeometryMask(instance, 0xFFFFFFFFu);
    rtcCommitGeometry(instance);
    rtcAttachGeometryByID(scene_, instance, static_cast<uint32_t>(i));
    rtcReleaseGeometry(instance);
  }
  rtcCommitScene(scene_);
  for (RTCScene mesh : meshes) rtcReleaseScene(mesh);
}

EmbreeScene::~EmbreeScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

RTCScene EmbreeScene::build_mesh(const MeshData& mesh, bool alpha_tested) {
  RTCScene scene = rtcNewScene(device_);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  for (size_t i = 0; i < mesh.geometries.size(); ++i) {
    const GeometryData& geometry = mesh.geometries[i];
    RTCGeometry triangles = new_triangles(device_, mesh, geometry);
    if (alpha_tested && geometry.alpha_tested) {
      uses_.push_back(std::make_unique<GeometryUse>(GeometryUse{this, &mesh, &geometry}));
      rtcSetGeometryUserData(triangles, uses_.back().get());
      rtcSetGeometryIntersectFilterFunction(triangles, alpha_filter);
      rtcSetGeometryOccludedFilterFunction(triangles, alpha_filter);
    }
    rtcSetGeometryMask(triangles, 0xFFFFFFFFu);
    rtcCommitGeometry(triangles);
    rtcAttachGeometryByID(scene, triangles, static_cast<uint32_t>(i));
    rtcReleaseGeometry(triangles);
  }
  rtcCommitScene(scene);
  return scene;
}

bool EmbreeScene::is_open(const GeometryUse& use, uint32_t primitive, float u, float v) const {
  const MaterialData& material = materials_[use.geometry->material];
  float alpha = material.base_color[3];
  if (material.image >= 0) {
    const Triangle triangle(*use.mesh, *use.geometry, primitive);
    alpha *= sample_alpha(data_.scene.images[material.image],
                          triangle.interpolate(&effects::Vertex::uv, u, v));
  }
  return alpha < material.alpha_cutoff;
}

std::vector<SurfacePoint> EmbreeScene::surface_points(const RayGrid& primary) const {
  std::vector<SurfacePoint> points;
  SurfacePoint point = {{0, 1, 0}, {0, 1, 0}, {0, -1, 0}};
  shim::QueryContext query;
  shim::init(query);
  for (const Ray& ray : primary.rays) {
    RTCRayHit hit;
    begin_ray(ray, hit.ray);
    begin_hit(hit.hit);
    shim::intersect(scene_, query, &hit);
    if (hit.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
      const InstanceData& instance = data_.instances[hit.hit.instID[0]];
      const float* m = instance.transform.data();
      const glm::mat3 rows(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]);
      const glm::vec3 view(ray.direction[0], ray.direction[1], ray.direction[2]);
      glm::vec3 normal =
          glm::normalize(glm::inverse(rows) * glm::vec3(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z));
      if (glm::dot(normal, view) > 0) normal = -normal;
      const glm::vec3 position = glm::vec3(ray.origin[0], ray.origin[1], ray.origin[2]) +
                                 hit.ray.tfar * view + 1e-3f * normal;
      std::memcpy(point.position, &position, 12);
      std::memcpy(point.normal, &normal, 12);
      std::memcpy(point.view, &view, 12);
    }
    points.push_back(point);
  }
  return points;
}

void EmbreeScene::closest(tbb::task_arena& arena, const RayGrid& grid,
                          std::vector<ClosestResult>& results) const {
  for_each_cell(arena, grid.width, grid.height, [&] {
    shim::QueryContext query;
    shim::init(query);
    return [this, &grid, &results, query](uint32_t index) mutable {
      RTCRayHit hit;
      begin_ray(grid.rays[index], hit.ray);
      begin_hit(hit.hit);
      shim::intersect(scene_, query, &hit);
      const bool missed = hit.hit.geomID == RTC_INVALID_GEOMETRY_ID;
      results[index] = {missed ? -1.0f : hit.ray.tfar, missed ? ~0u : hit.hit.primID};
    };
  });
}

void EmbreeScene::visible(tbb::task_arena& arena, const RayGrid& grid,
                          std::vector<uint32_t>& results) const {
  for_each_cell(arena, grid.width, grid.height, [&] {
    shim::QueryContext query;
    shim::init(query);
    return [this, &grid, &results, query](uint32_t index) mutable {
      RTCRay ray;
      begin_ray(grid.rays[index], ray);
      shim::occluded(scene_, query, &ray);
      results[index] = ray.tfar >= 0 ? 1 : 0;
    };
  });
}

uint64_t EmbreeScene::trace(tbb::task_arena& arena, const std::vector<FrameRay>& rays) const {
  constexpr uint32_t kTask = 256;
  const auto tasks = static_cast<uint32_t>((rays.size() + kTask - 1) / kTask);
  std::atomic<uint64_t> hits = 0;
  // Uses a grid one cell high, so that a tile holds 16 tasks.
  for_each_cell(arena, tasks, 1, [&] {
    shim::QueryContext query;
    shim::init(query);
    return [this, &rays, &hits, query](uint32_t task) mutable {
      uint64_t found = 0;
      const size_t end = std::min(rays.size(), (size_t{task} + 1) * kTask);
      for (size_t i = size_t{task} * kTask; i < end; ++i) {
        RTCRayHit hit;
        begin_ray(rays[i].ray, hit.ray);
        if (rays[i].visibility) {
          shim::occluded(scene_, query, &hit.ray);
          found += hit.ray.tfar < 0 ? 1 : 0;
        } else {
          begin_hit(hit.hit);
          shim::intersect(scene_, query, &hit);
          found += hit.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
        }
      }
      hits.fetch_add(found, std::memory_order_relaxed);
    };
  });
  return hits;
}

namespace {

// A permuted congruential generator. [O'Neill 2014]
struct Random {
  uint32_t state;
  float next() {
    state = state * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return static_cast<float>(((word >> 22) ^ word) >> 8) * 0x1p-24f;
  }
};

// `local` about +z to about the unit vector n. [Duff et al. 2017]
glm::vec3 about(const glm::vec3& local, const glm::vec3& n) {
  const float sign = n.z >= 0 ? 1.0f : -1.0f;
  const float a = -1 / (sign + n.z);
  const float b = n.x * n.y * a;
  return glm::vec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x) * local.x +
         glm::vec3(b, sign + n.y * n.y * a, -n.y) * local.y + n * local.z;
}

void set_ray(RTCRay& ray, const glm::vec3& origin, const glm::vec3& direction) {
  begin_ray({{origin.x, origin.y, origin.z}, 0, {direction.x, direction.y, direction.z}, 1e30f},
            ray);
}

}  // namespace

double EmbreeScene::paths(tbb::task_arena& arena, const RayGrid& primary, uint32_t samples,
                          const PathScene& paths, double& lit) const {
  std::vector<float> light(primary.rays.size());
  std::vector<uint32_t> sunny(primary.rays.size());
  const glm::vec3 to_sun(paths.to_sun[0], paths.to_sun[1], paths.to_sun[2]);
  for_each_cell(arena, primary.width, primary.height, [&] {
    shim::QueryContext query;
    shim::init(query);
    return [&, query](uint32_t index) mutable {
      Random random{index * 9781u + 1u};
      float sum = 0;
      for (uint32_t sample = 0; sample < samples; ++sample) {
        RTCRayHit hit;
        begin_ray(primary.rays[index], hit.ray);
        float throughput = paths.albedo / 3.14159265f;
        for (uint32_t bounce = 0;; ++bounce) {
          begin_hit(hit.hit);
          shim::intersect(scene_, query, &hit);
          if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
          const InstanceData& instance = data_.instances[hit.hit.instID[0]];
          const float* m = instance.transform.data();
          const glm::mat3 rows(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]);
          const glm::vec3 direction(hit.ray.dir_x, hit.ray.dir_y, hit.ray.dir_z);
          glm::vec3 normal = glm::normalize(glm::inverse(rows) *
                                            glm::vec3(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z));
          if (glm::dot(normal, direction) > 0) normal = -normal;
          const glm::vec3 origin = glm::vec3(hit.ray.org_x, hit.ray.org_y, hit.ray.org_z) +
                                   hit.ray.tfar * direction + 1e-4f * normal;
          const float r = std::sqrt(random.next()) * paths.tan_sun_radius;
          const float turn = 6.2831853f * random.next();
          const glm::vec3 sun =
              glm::normalize(about(glm::vec3(r * std::cos(turn), r * std::sin(turn), 1), to_sun));
          const float cosine = glm::dot(sun, normal);
          if (cosine > 0) {
            RTCRay shadow;
            set_ray(shadow, origin, sun);
            shim::occluded(scene_, query, &shadow);
            if (shadow.tfar >= 0) {
              sum += throughput * cosine * paths.sun_irradiance;
              if (bounce == 0) ++sunny[index];
            }
          }
          if (bounce == paths.bounces) break;
          throughput *= paths.albedo;
          const float u = random.next();
          const float s = std::sqrt(u), phi = 6.2831853f * random.next();
          set_ray(hit.ray, origin,
                  about(glm::vec3(s * std::cos(phi), s * std::sin(phi), std::sqrt(1 - u)), normal));
        }
      }
      light[index] = sum;
    };
  });
  double total = 0, seen = 0;
  for (const float value : light) total += value;
  for (const uint32_t value : sunny) seen += value;
  const double count = static_cast<double>(light.size()) * samples;
  lit = seen / count;
  return total / count;
}

void EmbreeScene::shade(const RTCRayHit& hit, ShadedResult& result) const {
  const InstanceData& instance = data_.instances[hit.hit.instID[0]];
  const MeshData& mesh = data_.meshes[instance.mesh];
  const GeometryData& geometry = mesh.geometries[hit.hit.geomID];
  const MaterialData& material = materials_[geometry.material];
  const Triangle triangle(mesh, geometry, hit.hit.primID);
  glm::vec3 color(material.base_color[0], material.base_color[1], material.base_color[2]);
  if (material.image >= 0) {
    color *= sample_color(data_.scene.images[material.image],
                          triangle.interpolate(&effects::Vertex::uv, hit.hit.u, hit.hit.v));
  }
  const glm::vec3 local = triangle.interpolate(&effects::Vertex::normal, hit.hit.u, hit.hit.v);
  const float* m = instance.transform.data();
  const glm::vec3 normal =
      glm::normalize(glm::vec3(m[0] * local.x + m[1] * local.y + m[2] * local.z,
                               m[4] * local.x + m[5] * local.y + m[6] * local.z,
                               m[8] * local.x + m[9] * local.y + m[10] * local.z));
  result = {
      {color.x, color.y, color.z}, hit.ray.tfar, {normal.x, normal.y, normal.z}, geometry.material};
}

void EmbreeScene::shaded(tbb::task_arena& arena, const RayGrid& grid,
                         std::vector<ShadedResult>& results) const {
  for_each_cell(arena, grid.width, grid.height, [&] {
    shim::QueryContext query;
    shim::init(query);
    return [this, &grid, &results, query](uint32_t index) mutable {
      RTCRayHit hit;
      begin_ray(grid.rays[index], hit.ray);
      begin_hit(hit.hit);
      shim::intersect(scene_, query, &hit);
      if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        results[index] = {{0, 0, 0}, -1, {0, 0, 0}, ~0u};
      } else {
        shade(hit, results[index]);
      }
    };
  });
}

}  // namespace kaamos::bench

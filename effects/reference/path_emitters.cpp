// SPDX-License-Identifier: MIT
#include "effects/reference/path_emitters.h"

#include <cmath>
#include <utility>

namespace kaamos::effects {

namespace {

double luminance(const glm::dvec3& color) {
  const double sum = 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
  return std::isfinite(sum) && sum > 0 ? sum : 0.0;
}

glm::dvec3 mean_color(const TextureImage& image) {
  glm::dvec3 sum(0.0);
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) sum += glm::dvec3(texel(image, 0, x, y));
  }
  return sum / (static_cast<double>(image.width) * image.height);
}

// Mean brightness of a material's emission over its texture.
double brightness(const Scene& scene, const MaterialConstants& material) {
  glm::dvec3 color(material.emissive);
  const std::int32_t image = material.image[kEmissiveTexture];
  // A sampled point has one pair of texture coordinates. Rays still meet what is not sampled.
  const auto second = [&](std::uint32_t slot) { return (material.second_uv >> slot & 1u) != 0; };
  if (material.image[kBaseColorTexture] != kNoTexture && image != kNoTexture &&
      second(kBaseColorTexture) != second(kEmissiveTexture)) {
    return 0.0;
  }
  if (luminance(color) > 0 && image != kNoTexture) color *= mean_color(scene.images[image]);
  return luminance(color);
}

bool is_sampled(const Instance& instance, const InstanceState& state) {
  return !state.is_deformed() && (instance.mask & (kMaskEmissiveProxy | kMaskTransparent)) == 0;
}

void add_triangles(const Mesh& mesh, const Geometry& geometry, bool second_uv,
                   const glm::dmat4& transform, const glm::dvec3& origin,
                   std::vector<PathEmitter>& out) {
  for (std::uint32_t i = 0; i < geometry.index_count / 3; ++i) {
    glm::dvec3 p[3];
    glm::vec2 uv[3];
    std::uint32_t alpha[3] = {0xFFFF, 0xFFFF, 0xFFFF};
    for (std::uint32_t c = 0; c < 3; ++c) {
      const Vertex& vertex = mesh.corner(geometry, i, c);
      p[c] = glm::dvec3(transform * glm::dvec4(vertex.position, 1.0)) - origin;
      uv[c] = second_uv && !mesh.second_uv.empty()
                  ? mesh.second_uv[geometry.first_vertex + mesh.index(geometry, 3 * i + c)]
                  : vertex.uv;
      if (!mesh.colors.empty())
        alpha[c] = mesh.colors[geometry.first_vertex + mesh.index(geometry, 3 * i + c)].a;
    }
    const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    if (!(area > 0) || !std::isfinite(area)) continue;
    out.push_back({glm::vec3(p[0]), geometry.material, glm::vec3(p[1] - p[0]), 1.0f,
                   glm::vec3(p[2] - p[0]), 0, uv[0], uv[1], uv[2],
                   glm::uvec2(alpha[0] | alpha[1] << 16, alpha[2] | 0xFFFF0000u)});
  }
}

// Draws i with a chance proportional to weights[i], in constant time. [Walker 1977; Vose 1991]
void make_aliases(const std::vector<double>& weights, double total,
                  std::vector<PathEmitter>& triangles) {
  std::vector<double> share;
  std::vector<std::uint32_t> small, large;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    share.push_back(weights[i] / total * static_cast<double>(weights.size()));
    (share.back() < 1.0 ? small : large).push_back(static_cast<std::uint32_t>(i));
    triangles[i].other = static_cast<std::uint32_t>(i);
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t low = small.back(), high = large.back();
    small.pop_back();
    triangles[low].keep = static_cast<float>(share[low]);
    triangles[low].other = high;
    share[high] -= 1.0 - share[low];
    if (share[high] >= 1.0) continue;
    large.pop_back();
    small.push_back(high);
  }
}

double area_of(const PathEmitter& triangle) {
  return 0.5 * glm::length(glm::cross(glm::dvec3(triangle.edge1), glm::dvec3(triangle.edge2)));
}

}  // namespace

PathEmitters find_emitters(const Scene& scene, std::span<const InstanceState> states,
                           const glm::dvec3& origin) {
  PathEmitters out;
  std::vector<double> glow;
  for (const Material& material : scene.materials) {
    glow.push_back(brightness(scene, material.constants));
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    out.instances.push_back(is_sampled(instance, states[i]) ? 1 : 0);
    if (out.instances.back() == 0) continue;
    const std::uint32_t mesh_id =
        states[i].mesh >= 0 ? static_cast<std::uint32_t>(states[i].mesh) : instance.mesh;
    const Mesh& mesh = scene.meshes[mesh_id];
    for (const Geometry& geometry : mesh.geometries) {
      if (!(glow[geometry.material] > 0)) continue;
      const MaterialConstants& constants = scene.materials[geometry.material].constants;
      const std::uint32_t slot =
          constants.image[kEmissiveTexture] != kNoTexture ? kEmissiveTexture : kBaseColorTexture;
      add_triangles(mesh, geometry, (constants.second_uv >> slot & 1u) != 0, states[i].transform,
                    origin, out.triangles);
    }
  }
  double total = 0;
  std::vector<double> weights;
  for (const PathEmitter& triangle : out.triangles) {
    weights.push_back(area_of(triangle) * glow[triangle.material]);
    total += weights.back();
  }
  for (const double g : glow) {
    out.densities.push_back(total > 0 ? static_cast<float>(g / total) : 0.0f);
  }
  make_aliases(weights, total, out.triangles);
  return out;
}

std::vector<float> sky_bands(const Sky& sky) {
  constexpr std::uint32_t kSamples = 16;  // of a band
  std::vector<double> weights;
  double total = 0;
  for (std::uint32_t i = 0; i < kSkyBands; ++i) {
    double sum = 0;
    for (std::uint32_t k = 0; k < kSamples; ++k) {
      const double y = -1.0 + 2.0 * (i + (k + 0.5) / kSamples) / kSkyBands;
      const auto horizontal = static_cast<float>(std::sqrt(1.0 - y * y));
      sum += luminance(sky_radiance(sky, {horizontal, static_cast<float>(y), 0.0f}));
    }
    weights.push_back(sum);
    total += sum;
  }
  if (!(total > 0)) return {};
  // A tenth goes to all directions alike, so that none is forgotten.
  std::vector<float> out = {0.0f};
  double below = 0;
  for (const double weight : weights) {
    below += 0.9 * weight / total + 0.1 / kSkyBands;
    out.push_back(static_cast<float>(below));
  }
  out.back() = 1.0f;
  return out;
}

}  // namespace kaamos::effects

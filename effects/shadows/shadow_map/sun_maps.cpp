// SPDX-License-Identifier: MIT
#include "effects/shadows/shadow_map/sun_maps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kaamos::effects {
namespace {

// Right, down and along the light, so that a map is seen from the sun.
struct Axes {
  glm::dvec3 right, down, light;
};

Axes axes_of(const glm::dvec3& direction_to_sun) {
  const glm::dvec3 light = -direction_to_sun;
  const glm::dvec3 other = std::abs(light.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 right = glm::normalize(glm::cross(light, other));
  return {right, glm::cross(light, right), light};
}

glm::dvec3 in_axes(const Axes& axes, const glm::dvec3& p) {
  return {glm::dot(axes.right, p), glm::dot(axes.down, p), glm::dot(axes.light, p)};
}

glm::dvec3 corner_of(const Bounds& box, int i) {
  return {(i & 1) ? box.max.x : box.min.x, (i & 2) ? box.max.y : box.min.y,
          (i & 4) ? box.max.z : box.min.z};
}

// A square of the map's plane: what a map has to cover.
struct Square {
  glm::dvec2 corner{0.0};
  double side = 1;
};

Square square_around(const Bounds& box) {
  const double side = std::max(std::max(box.size().x, box.size().y), 1e-6);
  return {glm::dvec2(box.center()) - 0.5 * side, side};
}

Bounds seen_along(const Axes& axes, const Bounds& box, double border) {
  Bounds out;
  if (box.empty()) return out;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 at = in_axes(axes, corner_of(box, i));
    out.add(at - border);
    out.add(at + border);
  }
  return out;
}

// Two texels more than the square has: its corner goes down to a whole texel of the world.
SunMap place(const SunMapsDesc& desc, const Axes& axes, const Square& square, double begin,
             double range, const Camera& camera, bool snapped) {
  const double texel = square.side / std::max(desc.size - 2.0, 1.0);
  glm::dvec2 corner = square.corner;
  if (snapped) corner = glm::floor(corner / texel) * texel;
  const glm::dvec3 eye = in_axes(axes, camera.position());
  SunMap map;
  map.to_map[0] = glm::vec4(axes.right / texel, (eye.x - corner.x) / texel);
  map.to_map[1] = glm::vec4(axes.down / texel, (eye.y - corner.y) / texel);
  map.to_map[2] = glm::vec4(axes.light, eye.z - begin);
  map.texel = static_cast<float>(texel);
  map.range = static_cast<float>(range);
  map.end = std::numeric_limits<float>::max();
  return map;
}

// Half the picture's size at distance 1, or anywhere.
glm::dvec2 half_picture(const Camera& camera, double aspect) {
  const double up = camera.picture_half_height();
  return {up * aspect, up};
}

// Around the sphere around a slice of what the camera sees, which is as large wherever the camera
// looks.
Square sphere_square(const Axes& axes, const Camera& camera, double aspect, double z0, double z1) {
  const glm::dvec2 half = half_picture(camera, aspect);
  const double k = glm::dot(half, half);
  if (camera.is_orthographic()) {
    const double middle = 0.5 * (z0 + z1);
    const double around = std::sqrt((z1 - middle) * (z1 - middle) + k);
    const glm::dvec3 at = in_axes(axes, camera.position() + middle * camera.forward());
    return {glm::dvec2(at) - around, 2 * around};
  }
  const double center = std::min(z1, 0.5 * (z0 + z1) * (1 + k));
  const double radius = std::sqrt((z1 - center) * (z1 - center) + z1 * z1 * k);
  const glm::dvec3 at = in_axes(axes, camera.position() + center * camera.forward());
  return {glm::dvec2(at) - radius, 2 * radius};
}

Square tight_square(const Axes& axes, const Camera& camera, double aspect, double z0, double z1) {
  const glm::dvec2 half = half_picture(camera, aspect);
  Bounds box;
  for (int i = 0; i < 8; ++i) {
    const double z = (i & 4) ? z1 : z0;
    const glm::dvec2 side = camera.is_orthographic() ? half : half * z;
    const glm::dvec4 p((i & 1) ? side.x : -side.x, (i & 2) ? side.y : -side.y, -z, 1);
    box.add(in_axes(axes, glm::dvec3(camera.camera_to_world * p)));
  }
  return square_around(box);
}

}  // namespace

double cascade_split(double near, double far, double share, std::uint32_t i, std::uint32_t count) {
  const double part = static_cast<double>(i) / count;
  return share * near * std::pow(far / near, part) + (1 - share) * (near + part * (far - near));
}

std::vector<SunMap> sun_maps(const SunMapsDesc& desc, const Camera& camera) {
  const Axes axes = axes_of(desc.direction_to_sun);
  Bounds box;
  double far = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner = desc.bounds.empty() ? camera.position() : corner_of(desc.bounds, i);
    box.add(in_axes(axes, corner));
    far = std::max(far, glm::dot(corner - camera.position(), camera.forward()));
  }
  // A little in front of the first surface and behind the last one.
  const double margin = std::max(1e-3 * box.size().z, 1e-6);
  const double begin = box.min.z - margin, range = box.size().z + 2 * margin;
  if (desc.cascades == 0) {
    const Square all = square_around(box);
    std::vector<Square> squares;
    for (const Bounds& object : desc.objects) {
      const Square own = square_around(seen_along(axes, object, desc.border));
      squares.push_back(!object.empty() && own.side < all.side ? own : all);
    }
    const auto is_finer = [](const Square& a, const Square& b) { return a.side < b.side; };
    std::stable_sort(squares.begin(), squares.end(), is_finer);
    squares.push_back(all);
    std::vector<SunMap> maps;
    for (const Square& square : squares) {
      maps.push_back(place(desc, axes, square, begin, range, camera, true));
    }
    return maps;
  }
  const double near = std::max(camera.near_plane, 1e-6);
  far = std::max(desc.reach > 0 ? desc.reach : far, 2 * near);
  std::vector<SunMap> maps;
  for (std::uint32_t i = 0; i < desc.cascades; ++i) {
    // The camera sees surfaces nearer than the near plane as well.
    const double z0 = i == 0 ? 0.0 : cascade_split(near, far, desc.split_share, i, desc.cascades);
    const double z1 = cascade_split(near, far, desc.split_share, i + 1, desc.cascades);
    const auto square = desc.stable ? sphere_square : tight_square;
    maps.push_back(place(desc, axes, square(axes, camera, desc.aspect, z0, z1), begin, range,
                         camera, desc.stable));
    maps.back().end = static_cast<float>(z1);
  }
  return maps;
}

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
#include "effects/assets/scene/shapes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "effects/assets/scene/tangents.h"

namespace kaamos::effects {
namespace {

constexpr double kTwoPi = 2.0 * glm::pi<double>();

void add_vertex(Shape& shape, const glm::dvec3& position, const glm::dvec3& normal,
                const glm::dvec2& uv) {
  Vertex vertex;
  vertex.position = glm::vec3(position);
  vertex.normal = glm::vec3(glm::normalize(normal));
  vertex.uv = glm::vec2(uv);
  shape.vertices.push_back(vertex);
}

/// The two triangles of a grid cell with corners a (u,v), b (u+1,v), c (u,v+1), d (u+1,v+1). The
/// front faces cross(u, v). Triangles without area, as at poles, are left out.
void add_cell(Shape& shape, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const auto triangle = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const glm::dvec3 p(shape.vertices[i].position);
    const glm::dvec3 n = glm::cross(glm::dvec3(shape.vertices[j].position) - p,
                                    glm::dvec3(shape.vertices[k].position) - p);
    if (glm::dot(n, n) > 1e-24) shape.indices.insert(shape.indices.end(), {i, j, k});
  };
  triangle(a, b, d);
  triangle(a, d, c);
}

void add_grid_cells(Shape& shape, std::uint32_t first, int u_steps, int v_steps) {
  const std::uint32_t stride = static_cast<std::uint32_t>(u_steps) + 1;
  for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(v_steps); ++v)
    for (std::uint32_t u = 0; u < static_cast<std::uint32_t>(u_steps); ++u) {
      const std::uint32_t a = first + v * stride + u;
      add_cell(shape, a, a + 1, a + stride, a + stride + 1);
    }
}

/// Coordinates along one axis of a rounded box: fine over the rounding, coarse in between.
std::vector<double> axis_steps(double half, double radius, int round_steps, int flat_steps) {
  std::vector<double> out;
  const double inner = half - radius;
  for (int i = 0; i < round_steps; ++i) {
    const double angle = 0.25 * glm::pi<double>() * i / round_steps;
    // Points on a face of the enclosing cube that project to equal angles on the rounding.
    out.push_back(-inner - radius * std::tan(0.25 * glm::pi<double>() - angle));
  }
  for (int i = 0; i <= flat_steps; ++i) out.push_back(-inner + 2.0 * inner * i / flat_steps);
  for (int i = 1; i <= round_steps; ++i)
    out.push_back(inner + radius * std::tan(0.25 * glm::pi<double>() * i / round_steps));
  return out;
}

glm::dvec3 perpendicular(const glm::dvec3& v) {
  return glm::normalize(glm::cross(
      v, std::abs(v.y) < 0.9 * glm::length(v) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
}

glm::dvec3 direction_at(std::span<const glm::dvec3> path, std::size_t i, bool closed) {
  const std::size_t n = path.size();
  const glm::dvec3 before = i > 0 ? path[i - 1] : closed ? path[n - 2] : path[0];
  const glm::dvec3 after = i + 1 < n ? path[i + 1] : closed ? path[1] : path[n - 1];
  return glm::normalize(after - before);
}

/// Closes a ring of vertices with a fan. `out` is the direction that the cap faces.
void add_cap(Shape& shape, std::span<const glm::dvec3> ring, const glm::dvec3& out, bool reversed) {
  const std::uint32_t first = static_cast<std::uint32_t>(shape.vertices.size());
  for (const glm::dvec3& p : ring) add_vertex(shape, p, out, glm::dvec2(0.0));
  for (std::uint32_t i = 1; i + 1 < ring.size(); ++i) {
    if (reversed)
      shape.indices.insert(shape.indices.end(), {first, first + i + 1, first + i});
    else
      shape.indices.insert(shape.indices.end(), {first, first + i, first + i + 1});
  }
}

}  // namespace

void append(Shape& shape, const Shape& part, const glm::dmat4& transform) {
  const std::uint32_t first = static_cast<std::uint32_t>(shape.vertices.size());
  const glm::dmat3 linear(transform);
  const glm::dmat3 normal_matrix = glm::transpose(glm::inverse(linear));
  for (Vertex vertex : part.vertices) {
    vertex.position = glm::vec3(transform * glm::dvec4(glm::dvec3(vertex.position), 1.0));
    vertex.normal = glm::vec3(glm::normalize(normal_matrix * glm::dvec3(vertex.normal)));
    shape.vertices.push_back(vertex);
  }
  const bool mirrored = glm::determinant(linear) < 0.0;
  for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) {
    const std::uint32_t a = part.indices[i], b = part.indices[i + 1], c = part.indices[i + 2];
    shape.indices.insert(shape.indices.end(),
                         {first + a, first + (mirrored ? c : b), first + (mirrored ? b : c)});
  }
}

void deform(Shape& shape, const std::function<glm::dvec3(const glm::dvec3&)>& map) {
  constexpr double kStep = 1e-4;
  for (Vertex& vertex : shape.vertices) {
    const glm::dvec3 p(vertex.position);
    glm::dmat3 derivative;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0.0);
      step[axis] = kStep;
      derivative[axis] = (map(p + step) - map(p - step)) / (2.0 * kStep);
    }
    // Cofactors instead of the inverse, because they exist for flattening maps too.
    const glm::dvec3 n(vertex.normal);
    const glm::dvec3 moved = glm::cross(derivative[1], derivative[2]) * n.x +
                             glm::cross(derivative[2], derivative[0]) * n.y +
                             glm::cross(derivative[0], derivative[1]) * n.z;
    vertex.position = glm::vec3(map(p));
    if (glm::length(moved) > 0.0) vertex.normal = glm::vec3(glm::normalize(moved));
  }
}

Shape patch(const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v, int u_steps,
            int v_steps) {
  Shape shape;
  const glm::dvec3 normal = glm::cross(u, v);
  for (int j = 0; j <= v_steps; ++j)
    for (int i = 0; i <= u_steps; ++i) {
      const glm::dvec2 t(static_cast<double>(i) / u_steps, static_cast<double>(j) / v_steps);
      add_vertex(shape, origin + u * t.x + v * t.y, normal, t);
    }
  add_grid_cells(shape, 0, u_steps, v_steps);
  return shape;
}

Shape box(const glm::dvec3& half) {
  Shape shape;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 n(0.0), u(0.0);
      n[axis] = side;
      u[(axis + 1) % 3] = 1.0;
      const glm::dvec3 v = glm::cross(n, u);
      const glm::dvec3 corner = half * (n - u - v);
      Shape face = patch(corner, 2.0 * half * u, 2.0 * half * v, 1, 1);
      const double width = 2.0 * glm::length(half * u), height = 2.0 * glm::length(half * v);
      for (Vertex& vertex : face.vertices) vertex.uv *= glm::vec2(width, height);
      append(shape, face);
    }
  }
  return shape;
}

Shape rounded_box(const glm::dvec3& half, double radius, int round_steps,
                  const glm::ivec3& flat_steps) {
  assert(radius > 0.0 && radius <= std::min({half.x, half.y, half.z}));
  Shape shape;
  const glm::dvec3 inner = half - glm::dvec3(radius);
  for (int axis = 0; axis < 3; ++axis) {
    const int ua = (axis + 1) % 3;
    const std::vector<double> us = axis_steps(half[ua], radius, round_steps, flat_steps[ua]);
    for (const double side : {-1.0, 1.0}) {
      glm::dvec3 n(0.0), u(0.0);
      n[axis] = side;
      u[ua] = 1.0;
      const glm::dvec3 v = glm::cross(n, u);
      const int va = 3 - axis - ua;
      const std::vector<double> vs = axis_steps(half[va], radius, round_steps, flat_steps[va]);
      const std::uint32_t first = static_cast<std::uint32_t>(shape.vertices.size());
      for (const double t : vs)
        for (const double s : us) {
          const glm::dvec3 on_cube = n * half[axis] + u * s + v * t;
          const glm::dvec3 core = glm::clamp(on_cube, -inner, inner);
          const glm::dvec3 out = glm::normalize(on_cube - core);
          add_vertex(shape, core + out * radius, out, {s, t});
        }
      add_grid_cells(shape, first, static_cast<int>(us.size()) - 1,
                     static_cast<int>(vs.size()) - 1);
    }
  }
  return shape;
}

Shape revolve(std::span<const glm::dvec2> profile, int segments, double crease) {
  assert(profile.size() >= 2 && segments >= 3);
  Shape shape;
  const auto outward = [&](std::size_t i) {
    const glm::dvec2 d = glm::normalize(profile[i + 1] - profile[i]);
    return glm::dvec2(d.y, -d.x);
  };
  const auto at_joint = [&](std::size_t own, std::size_t other) {
    const glm::dvec2 a = outward(own), b = outward(other);
    return glm::dot(a, b) > std::cos(crease) ? glm::normalize(a + b) : a;
  };
  double length = 0.0;
  const bool closed = glm::distance(profile.front(), profile.back()) < 1e-9;
  const std::size_t last = profile.size() - 2;
  for (std::size_t i = 0; i <= last; ++i) {
    const double step = glm::distance(profile[i], profile[i + 1]);
    const glm::dvec2 start_normal = i > 0    ? at_joint(i, i - 1)
                                    : closed ? at_joint(i, last)
                                             : outward(i);
    const glm::dvec2 end_normal = i < last ? at_joint(i, i + 1)
                                  : closed ? at_joint(i, 0)
                                           : outward(i);
    const std::uint32_t first = static_cast<std::uint32_t>(shape.vertices.size());
    for (int end = 0; end < 2; ++end) {
      const glm::dvec2 p = profile[i + static_cast<std::size_t>(end)];
      const glm::dvec2 n = end == 0 ? start_normal : end_normal;
      for (int s = 0; s <= segments; ++s) {
        // The last column repeats the first bit for bit, so that no crack opens at the seam.
        const double angle = s == segments ? 0.0 : kTwoPi * s / segments;
        // The angle increases such that the surface with u to the right and v up faces outwards.
        const glm::dvec3 radial(std::sin(angle), 0.0, std::cos(angle));
        add_vertex(shape, radial * p.x + glm::dvec3(0, p.y, 0),
                   radial * n.x + glm::dvec3(0, n.y, 0),
                   {kTwoPi * s / segments * std::max(p.x, 0.05), length + end * step});
      }
    }
    add_grid_cells(shape, first, segments, 1);
    length += step;
  }
  return shape;
}

Shape tube(std::span<const glm::dvec3> path, const std::function<double(double)>& radius,
           int sides) {
  assert(path.size() >= 2 && sides >= 3);
  Shape shape;
  const bool closed = glm::distance(path.front(), path.back()) < 1e-9;
  std::vector<std::vector<glm::dvec3>> rings;
  glm::dvec3 side = perpendicular(direction_at(path, 0, closed));
  double length = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const glm::dvec3 along = direction_at(path, i, closed);
    side = glm::normalize(side - along * glm::dot(side, along));
    if (closed && i + 1 == path.size()) side = perpendicular(direction_at(path, 0, closed));
    const glm::dvec3 up = glm::cross(along, side);
    const double r = radius(static_cast<double>(i) / static_cast<double>(path.size() - 1));
    if (i > 0) length += glm::distance(path[i], path[i - 1]);
    rings.emplace_back();
    for (int s = 0; s <= sides; ++s) {
      const double angle = s == sides ? 0.0 : kTwoPi * s / sides;
      const glm::dvec3 out = side * std::cos(angle) + up * std::sin(angle);
      add_vertex(shape, path[i] + out * r, out, {kTwoPi * r * s / sides, length});
      if (s < sides) rings.back().push_back(path[i] + out * r);
    }
  }
  add_grid_cells(shape, 0, sides, static_cast<int>(path.size()) - 1);
  if (!closed) {
    add_cap(shape, rings.front(), -direction_at(path, 0, false), true);
    add_cap(shape, rings.back(), direction_at(path, path.size() - 1, false), false);
  }
  return shape;
}

Shape bar(std::span<const glm::dvec3> path, double width, double height,
          const std::function<glm::dvec3(std::size_t)>& normal) {
  assert(path.size() >= 2);
  Shape shape;
  std::vector<std::array<glm::dvec3, 4>> rings;
  std::vector<std::pair<glm::dvec3, glm::dvec3>> frames;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const glm::dvec3 along = direction_at(path, i, false);
    glm::dvec3 up = normal(i);
    up = glm::normalize(up - along * glm::dot(up, along));
    const glm::dvec3 side = glm::cross(up, along);
    const glm::dvec3 w = side * (0.5 * width), h = up * (0.5 * height);
    rings.push_back({path[i] - w - h, path[i] + w - h, path[i] + w + h, path[i] - w + h});
    frames.emplace_back(side, up);
  }
  for (std::size_t face = 0; face < 4; ++face) {
    const std::uint32_t first = static_cast<std::uint32_t>(shape.vertices.size());
    double length = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      if (i > 0) length += glm::distance(path[i], path[i - 1]);
      const glm::dvec3 out = face == 0   ? -frames[i].second
                             : face == 1 ? frames[i].first
                             : face == 2 ? frames[i].second
                                         : -frames[i].first;
      add_vertex(shape, rings[i][face], out, {0.0, length});
      add_vertex(shape, rings[i][(face + 1) % 4], out, {face % 2 == 0 ? width : height, length});
    }
    add_grid_cells(shape, first, 1, static_cast<int>(path.size()) - 1);
  }
  add_cap(shape, rings.front(), -direction_at(path, 0, false), true);
  add_cap(shape, rings.back(), direction_at(path, path.size() - 1, false), false);
  return shape;
}

void add_shape(Mesh& mesh, Shape shape, std::uint32_t material, bool alpha_tested) {
  make_tangents(shape.vertices, shape.indices);
  mesh.add_geometry(shape.vertices, shape.indices, material, alpha_tested);
}

glm::dmat4 translate(const glm::dvec3& offset) {
  return glm::translate(glm::dmat4(1.0), offset);
}

glm::dmat4 rotate_y(double angle) {
  return glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0, 1, 0));
}

glm::dmat4 rotate_x(double angle) {
  return glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(1, 0, 0));
}

glm::dmat4 rotate_z(double angle) {
  return glm::rotate(glm::dmat4(1.0), angle, glm::dvec3(0, 0, 1));
}

}  // namespace kaamos::effects

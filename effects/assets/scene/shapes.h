// SPDX-License-Identifier: MIT
/// @file
/// Building blocks for scenes made by code. Front faces are counter-clockwise seen from outside,
/// normals are unit vectors pointing outside, and uv are in metres along the surface unless a shape
/// says otherwise.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "effects/assets/scene/mesh.h"

namespace kaamos::effects {

/// Triangles of one material before they become a geometry.
struct Shape {
  std::vector<Vertex> vertices;        ///< object space, metres
  std::vector<std::uint32_t> indices;  ///< three for each triangle
};

/// Adds `part`, transformed. A mirroring transform turns the triangles, so fronts stay outside.
void append(Shape& shape, const Shape& part, const glm::dmat4& transform = glm::dmat4(1.0));

/// Moves every vertex through `map`; normals follow the map's derivative (central differences of
/// 0.1 mm), so smooth maps keep surfaces smooth.
void deform(Shape& shape, const std::function<glm::dvec3(const glm::dvec3&)>& map);

/// Box about the origin with flat faces.
Shape box(const glm::dvec3& half);

/// Box about the origin whose edges and corners have `radius` (at most the smallest half extent).
/// `round_steps` segments per rounding, `flat_steps` on the flat part along each axis.
Shape rounded_box(const glm::dvec3& half, double radius, int round_steps,
                  const glm::ivec3& flat_steps = glm::ivec3(1));

/// Rectangle from `origin` spanned by `u` and `v`; its front is towards cross(u, v). uv run 0..1.
Shape patch(const glm::dvec3& origin, const glm::dvec3& u, const glm::dvec3& v, int u_steps,
            int v_steps);

/// Surface of revolution about +Y. `profile` holds (radius, height); seen in the half plane with
/// the axis to the left, the outside lies to the right of the way along the profile (from bottom to
/// top for an outer wall). Corners sharper than `crease` radians stay
/// sharp. Successive points differ.
Shape revolve(std::span<const glm::dvec2> profile, int segments, double crease = 0.6);

/// Tube of round cross-section along a path; `radius(t)` for t = 0..1 along it. Ends are capped
/// unless the path is closed (first point = last point).
Shape tube(std::span<const glm::dvec3> path, const std::function<double(double)>& radius,
           int sides);

/// Bar of rectangular cross-section along an open path. `normal(i)` is the direction of the height
/// at point i, as nearly perpendicular to the path as it is given.
Shape bar(std::span<const glm::dvec3> path, double width, double height,
          const std::function<glm::dvec3(std::size_t)>& normal);

/// Makes tangents and adds the shape as a geometry.
void add_shape(Mesh& mesh, Shape shape, std::uint32_t material, bool alpha_tested = false);

/// Transforms for placing things: metres, radians.
///@{
glm::dmat4 translate(const glm::dvec3& offset);
glm::dmat4 rotate_y(double angle);
glm::dmat4 rotate_x(double angle);
glm::dmat4 rotate_z(double angle);
///@}

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
/// @file
/// Puts scenes together from shapes: what every scene made by code would else repeat.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>

#include "effects/assets/scene/scene.h"
#include "effects/assets/scene/shapes.h"

namespace kaamos::effects {

/// A scene with one sampler and nothing else.
Scene start_scene(std::string name);

/// Adds a material. Returns its place in Scene::materials.
std::uint32_t add_material(Scene& scene, std::string name, const MaterialConstants& constants);
/// Adds a material of one colour. Returns its place in Scene::materials.
std::uint32_t add_paint(Scene& scene, std::string name, const glm::vec3& color,
                        float roughness = 0.8f);

/// Adds a mesh of one geometry, without an instance. Returns its place in Scene::meshes.
std::uint32_t add_mesh(Scene& scene, std::string name, Shape shape, std::uint32_t material,
                       bool alpha_tested = false);
/// Adds an instance of a mesh. The reference is valid until the next one is added.
Instance& add_instance(Scene& scene, std::string name, std::uint32_t mesh,
                       const glm::dmat4& transform = glm::dmat4(1.0));
/// Adds a mesh of one geometry and an instance of it. The reference is valid until the next one is
/// added.
Instance& add_thing(Scene& scene, std::string name, Shape shape, std::uint32_t material,
                    const glm::dmat4& transform = glm::dmat4(1.0));
/// Adds a box between two corners, metres.
Instance& add_box(Scene& scene, std::string name, const glm::dvec3& low, const glm::dvec3& high,
                  std::uint32_t material);
/// Adds a flat rectangle that faces +y, from `low` to `high` in x and z.
Instance& add_floor(Scene& scene, std::string name, const glm::dvec2& low, const glm::dvec2& high,
                    double y, std::uint32_t material);

/// Adds a point light: candela, metres.
Light& add_lamp(Scene& scene, std::string name, const glm::dvec3& position, float intensity,
                float radius, float range = 0.0f);
/// Adds a camera; `fov` is its vertical angle, radians.
void add_view(Scene& scene, std::string name, const glm::dvec3& eye, const glm::dvec3& target,
              double fov);

/// A ball about the origin.
Shape ball(double radius, int segments, int rings);
/// An upright cylinder with its foot's centre in the origin.
Shape post(double radius, double height, int sides);

}  // namespace kaamos::effects

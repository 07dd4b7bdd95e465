// SPDX-License-Identifier: MIT
/// @file
/// The data that glTF has no place for, in `extras` under the key "kaamos": written by
/// gltf_write.cpp, read back by the loader. README.md has the table. Only gltf_*.cpp include it.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "effects/assets/scene/scene.h"

namespace kaamos::effects {

/// Sky and exposure of a scene.
struct SceneExtras {
  Sky sky;                ///< what rays see that miss
  float exposure = 1.0f;  ///< radiance times this goes to the tone curve
};

/// The extras of the node that holds the sun's directional light.
struct SunExtras {
  std::optional<glm::vec3> irradiance;       ///< none: colour times intensity of the light
  float angular_radius = kSunAngularRadius;  ///< radians
};

/// The extras of the node of a spot that throws a slide.
struct ProjectionExtras {
  int texture = -1;       ///< of the file
  glm::vec3 up{0, 1, 0};  ///< ProjectionMap::up
};

/// For a scene: everything besides meshes and lights that a picture depends on.
tinygltf::Value scene_extras(const Scene& scene);
/// For the node of the sun's light.
tinygltf::Value sun_extras(const Sun& sun);
/// For the node of any other light; `texture` has the slide of one that throws one.
tinygltf::Value lamp_extras(const Light& light, int texture);
/// For the node of an instance; what `extras` holds already is kept.
void add_instance_extras(tinygltf::Value& extras, const Instance& instance);
/// For a material; null where the unified model shows it.
tinygltf::Value material_extras(const MaterialConstants& material);

/// Each reads what the function above wrote, from the extras of the same object. Empty where there
/// is nothing of ours; values that are not usable are left out with a warning that begins with
/// `where`.
///@{
std::optional<SceneExtras> read_scene_extras(const tinygltf::Value& extras,
                                             const std::string& where,
                                             std::vector<std::string>& warnings);
std::optional<SunExtras> read_sun_extras(const tinygltf::Value& extras, const std::string& where,
                                         std::vector<std::string>& warnings);
void read_lamp_extras(const tinygltf::Value& extras, const std::string& where, Light& light,
                      std::vector<std::string>& warnings);
std::optional<ProjectionExtras> read_projection_extras(const tinygltf::Value& extras,
                                                       const std::string& where,
                                                       std::vector<std::string>& warnings);
std::optional<std::uint8_t> read_instance_mask(const tinygltf::Value& extras,
                                               const std::string& where,
                                               std::vector<std::string>& warnings);
/// The bit of MaterialFlags; 0: none.
std::uint32_t read_material_model(const tinygltf::Value& extras, const std::string& where,
                                  std::vector<std::string>& warnings);
///@}

}  // namespace kaamos::effects

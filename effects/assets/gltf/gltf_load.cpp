// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_load.h"

#include <algorithm>
#include <exception>
#include <new>
#include <optional>
#include <utility>

#include "effects/assets/common/file.h"
#include "effects/assets/gltf/gltf_parse.h"
#include "effects/assets/gltf/gltf_reader.h"
#include "effects/assets/gltf/lamp_shapes.h"
#include "effects/assets/scene/levels.h"
#include "effects/assets/scene/material_override.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

float luminance(const glm::vec3& c) {
  return glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

/// Illuminance of a directional light; 0 for all others.
float sunlight(const Light& light) {
  return light.type == LightType::kDirectional ? luminance(light.color) * light.intensity : 0.0f;
}

/// Makes the light at `place` the sun. Its colour times its intensity is the irradiance.
void take_sun(Scene& scene, std::vector<Light>::iterator place) {
  scene.sun = default_sun();
  scene.sun->direction_to_sun = -place->direction;
  scene.sun->irradiance = place->color * place->intensity;
  scene.lights.erase(place);
}

/// Sun, sky and exposure as the writer of this library left them.
void take_extras(Scene& scene, const SceneExtras& extras,
                 const std::optional<GltfReader::MarkedSun>& sun) {
  scene.sky = extras.sky;
  scene.exposure = extras.exposure;
  if (!sun) return;
  take_sun(scene, scene.lights.begin() + static_cast<std::ptrdiff_t>(sun->light));
  scene.sun->angular_radius = sun->extras.angular_radius;
  if (sun->extras.irradiance) scene.sun->irradiance = *sun->extras.irradiance;
}

/// Sun, sky and exposure for a file of any other origin. The strongest directional light is the
/// sun; the others are left out, which the warnings say.
void add_daylight(Scene& scene, std::vector<std::string>& warnings) {
  auto sun =
      std::max_element(scene.lights.begin(), scene.lights.end(),
                       [](const Light& a, const Light& b) { return sunlight(a) < sunlight(b); });
  if (sun != scene.lights.end() && !(sunlight(*sun) > 0.0f)) sun = scene.lights.end();
  for (auto light = scene.lights.begin(); light != scene.lights.end(); ++light) {
    if (light == sun || !(sunlight(*light) > 0.0f)) continue;
    warnings.push_back("directional light \"" + light->name + "\" is left out: \"" + sun->name +
                       "\" is stronger and is taken as the sun, and there is one sun");
  }
  scene.sun = default_sun();
  scene.sky = default_sky();
  if (sun == scene.lights.end()) return;
  take_sun(scene, sun);
  // Files use lux or any other unit, so the sky is scaled with the sun and the exposure takes
  // both back.
  const float scale = luminance(scene.sun->irradiance) / luminance(default_sun().irradiance);
  scene.sky.zenith *= scale;
  scene.sky.horizon *= scale;
  scene.sky.ground *= scale;
  scene.exposure = 1.0f / scale;
}

/// Adds what the file lacks of sun, sky, camera and exposure. True where it lacks none of them.
bool complete(const GltfReader& reader) {
  Scene& scene = reader.scene;
  std::optional<SceneExtras> extras;
  if (const auto& scenes = reader.model.scenes; !scenes.empty()) {
    const std::size_t id = static_cast<std::size_t>(std::max(0, reader.model.defaultScene));
    extras = read_scene_extras(scenes[id].extras, gltf_part("scene", id, scenes[id].name),
                               reader.warnings);
  }
  if (extras) {
    take_extras(scene, *extras, reader.sun);
  } else {
    add_daylight(scene, reader.warnings);
  }
  const bool has_camera = !scene.cameras.empty();
  if (!has_camera) scene.cameras.push_back(default_camera(scene));
  return extras && has_camera;
}

/// Drops meshes that no instance shows: those of other scenes in the file, and bind poses of
/// skinned meshes.
void drop_unused_meshes(Scene& scene) {
  std::vector<std::uint32_t> new_id(scene.meshes.size(), 0);
  std::vector<bool> used(scene.meshes.size(), false);
  for (const Instance& instance : scene.instances) {
    used[instance.mesh] = true;
    for (const Level& level : instance.levels) used[level.mesh] = true;
  }
  std::vector<Mesh> kept;
  for (std::size_t id = 0; id < used.size(); ++id) {
    if (!used[id]) continue;
    new_id[id] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(std::move(scene.meshes[id]));
  }
  scene.meshes = std::move(kept);
  for (Instance& instance : scene.instances) {
    instance.mesh = new_id[instance.mesh];
    for (Level& level : instance.levels) level.mesh = new_id[level.mesh];
  }
}

Result<LoadedScene> load(std::span<const std::uint8_t> bytes, const std::string& name,
                         const std::string& folder, const GltfOptions& options) {
  LoadedScene loaded;
  loaded.scene.name = name;
  tinygltf::Model model;
  std::vector<std::vector<std::uint8_t>> images;
  Status status = parse_gltf(bytes, folder, model, images, loaded.warnings);
  GltfReader reader{model, images, loaded.scene, loaded.warnings};
  reader.animated = options.animated;
  if (status.ok()) status = read_gltf_materials(reader);
  if (status.ok()) status = read_gltf_meshes(reader);
  if (status.ok()) status = read_gltf_nodes(reader);
  if (status.ok()) status = read_gltf_animations(reader);
  if (!status.ok()) return status.error();
  if (loaded.scene.instances.empty())
    return make_error(
        ErrorId::kGltf,
        reader.singular.empty()
            ? std::string("shows no triangles: no node of its scene has a mesh made "
                          "of triangles") +
                  (reader.has_points_or_lines ? "; points and lines are not drawn" : "")
            : "shows no triangles: " + reader.singular +
                  ": its transform is singular (a scale of 0, or a matrix whose "
                  "determinant is 0)");
  if (!model.animations.empty() && !options.animated)
    loaded.warnings.push_back("animations are left out");
  if (const std::size_t joined = join_levels_by_name(loaded.scene); joined > 0)
    loaded.warnings.push_back(
        "nodes named lod0, lod1, ... at one place are taken as levels of "
        "detail; of each object one level is shown, " +
        std::to_string(joined) + " nodes are not");
  loaded.complete = complete(reader);
  if (!loaded.complete) separate_glass(loaded.scene);
  const std::size_t lamps = loaded.complete ? 0 : separate_lamp_shapes(loaded.scene);
  if (lamps > 0)
    loaded.warnings.push_back(
        std::to_string(lamps) +
        " glowing shapes around lights are taken as pictures of these lamps: they light nothing "
        "themselves, and cast no shadow");
  drop_unused_meshes(loaded.scene);
  status = validate(loaded.scene);
  if (!status.ok()) return status.error();
  return loaded;
}

}  // namespace

std::string gltf_part(const char* noun, std::size_t index, const std::string& name) {
  std::string text = std::string(noun) + " " + std::to_string(index);
  if (!name.empty()) text += " \"" + name + "\"";
  return text;
}

Result<LoadedScene> load_gltf_memory(std::span<const std::uint8_t> bytes, const std::string& name,
                                     const std::string& folder, const GltfOptions& options) {
  const auto failed = [&](const Error& error) {
    return within("\"" + name + "\"", error, ErrorId::kGltf);
  };
  try {
    Result<LoadedScene> loaded = load(bytes, name, folder, options);
    if (!loaded.ok()) return failed(loaded.error());
    return loaded;
  } catch (const std::bad_alloc&) {
    return failed(make_error(ErrorId::kGltf,
                             "takes more memory than there is: its counts and sizes may be wrong"));
  } catch (const std::exception&) {
    return failed(make_error(ErrorId::kGltf, kGltfRefused));
  }
}

Result<LoadedScene> load_gltf(const std::string& path, const GltfOptions& options) {
  const Result<std::vector<std::uint8_t>> bytes = read_file(path);
  if (!bytes.ok()) return bytes.error();
  const std::size_t slash = path.find_last_of('/');
  return load_gltf_memory(bytes.value(), path,
                          slash == std::string::npos ? "." : path.substr(0, slash + 1), options);
}

}  // namespace kaamos::effects

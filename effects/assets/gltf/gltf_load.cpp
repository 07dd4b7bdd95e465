// SPDX-License-Identifier: MIT
#include "effects/assets/gltf/gltf_load.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "effects/assets/common/file.h"
#include "effects/assets/gltf/gltf_reader.h"
#include "effects/assets/gltf/lamp_shapes.h"
#include "effects/assets/scene/levels.h"
#include "effects/assets/scene/staging.h"

namespace kaamos::effects {
namespace {

constexpr std::array<std::string_view, 5> kKnownExtensions = {
    "KHR_texture_transform", "KHR_lights_punctual", "KHR_materials_emissive_strength",
    "KHR_mesh_quantization", "MSFT_lod"};

/// How deep arrays and objects may nest: far deeper than glTF needs, and shallow enough for the
/// parser, which recurses over extensions.
constexpr int kMaxJsonDepth = 128;

/// Keeps the encoded bytes of images that come by URI, and decodes nothing. It does not touch
/// images in buffer views, because their pointer is not checked against the buffer.
bool keep_encoded(tinygltf::Image* image, const int index, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int size, void* user) {
  auto& kept = *static_cast<std::vector<std::vector<std::uint8_t>>*>(user);
  if (index < 0) return false;
  if (kept.size() <= static_cast<std::size_t>(index))
    kept.resize(static_cast<std::size_t>(index) + 1);
  if (image->bufferView < 0 && size > 0)
    kept[static_cast<std::size_t>(index)].assign(bytes, bytes + size);
  return true;
}

/// Reads a file that a scene names as any other file is read: the parser's own reader asks a folder
/// for its size and then for that much memory.
bool read_named_file(std::vector<unsigned char>* out, std::string* error, const std::string& path,
                     void*) {
  Result<std::vector<std::uint8_t>> bytes = read_file(path);
  if (bytes.ok()) {
    *out = std::move(bytes.value());
  } else {
    *error += bytes.error().message;
  }
  return bytes.ok();
}

/// The parser's files, read by read_named_file. Later versions of it have one more callback.
template <class Callbacks>
Callbacks file_callbacks() {
  Callbacks files = {};
  files.FileExists = &tinygltf::FileExists;
  files.ExpandFilePath = &tinygltf::ExpandFilePath;
  files.ReadWholeFile = &read_named_file;
  files.WriteWholeFile = &tinygltf::WriteWholeFile;
  if constexpr (requires { files.GetFileSizeInBytes; }) {
    files.GetFileSizeInBytes = [](std::size_t* size, std::string* error, const std::string& path,
                                  void* user) {
      std::vector<unsigned char> bytes;
      const bool is_read = read_named_file(&bytes, error, path, user);
      *size = bytes.size();
      return is_read;
    };
  }
  return files;
}

bool is_glb(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

/// True if no array or object is nested deeper than kMaxJsonDepth.
bool shallow(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxJsonDepth) return false;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return true;
}

std::string one_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// The JSON text of a file: all of a .gltf, or the first chunk of a .glb.
Result<std::string_view> json_text(std::span<const std::uint8_t> bytes) {
  const auto view = [&](std::size_t offset, std::size_t size) {
    return std::string_view(reinterpret_cast<const char*>(bytes.data()) + offset, size);
  };
  if (!is_glb(bytes)) {
    const std::size_t first = view(0, bytes.size()).find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first == std::string_view::npos || bytes[first] != '{')
      return make_error(ErrorId::kGltf, "is neither a .gltf (JSON) nor a .glb file");
    return view(0, bytes.size());
  }
  std::uint32_t chunk = 0;
  if (bytes.size() < 20)
    return make_error(ErrorId::kGltf,
                      "is cut: " + std::to_string(bytes.size()) + " bytes, a .glb has at least 20");
  std::memcpy(&chunk, bytes.data() + 12, 4);
  if (chunk > bytes.size() - 20)
    return make_error(ErrorId::kGltf, "is cut: its JSON needs " + std::to_string(chunk) +
                                          " bytes, the file has " +
                                          std::to_string(bytes.size() - 20) + " after the header");
  return view(20, chunk);
}

Status parse(std::span<const std::uint8_t> bytes, const std::string& folder, tinygltf::Model& model,
             std::vector<std::vector<std::uint8_t>>& images, std::vector<std::string>& warnings) {
  if (bytes.size() > 0xFFFFFF00u) return make_error(ErrorId::kGltf, "is larger than 4 GB");
  const Result<std::string_view> json = json_text(bytes);
  if (!json.ok()) return json.error();
  if (!shallow(json.value()))
    return make_error(ErrorId::kGltf, "its JSON is nested deeper than " +
                                          std::to_string(kMaxJsonDepth) + " levels");
  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_encoded, &images);
  loader.SetFsCallbacks(file_callbacks<tinygltf::FsCallbacks>());
  std::string error, warning;
  bool parsed = false;
  if (is_glb(bytes)) {
    // tinygltf 2.7 forgets the 8 bytes of the chunk header when it checks the binary chunk, so it
    // reads that far past the end of a truncated file. Padding keeps the read inside.
    std::vector<std::uint8_t> padded(bytes.begin(), bytes.end());
    padded.resize(bytes.size() + 16, 0);
    parsed = loader.LoadBinaryFromMemory(&model, &error, &warning, padded.data(),
                                         static_cast<unsigned int>(bytes.size()), folder);
  } else {
    parsed = loader.LoadASCIIFromString(&model, &error, &warning, json.value().data(),
                                        static_cast<unsigned int>(json.value().size()), folder);
  }
  if (!warning.empty()) warnings.push_back(one_line(warning));
  if (!parsed)
    return make_error(ErrorId::kGltf, error.empty() ? "cannot be parsed" : one_line(error));
  images.resize(model.images.size());
  return {};
}

Status check_extensions(const tinygltf::Model& model) {
  for (const std::string& name : model.extensionsRequired)
    if (std::find(kKnownExtensions.begin(), kKnownExtensions.end(), name) == kKnownExtensions.end())
      return make_error(ErrorId::kGltf, "requires the extension " + name +
                                            ", which is not supported: export the file without it");
  return {};
}

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
  Status status = parse(bytes, folder, model, images, loaded.warnings);
  if (status.ok()) status = check_extensions(model);
  GltfReader reader{model, images, loaded.scene, loaded.warnings};
  reader.animated = options.animated;
  if (status.ok()) status = read_gltf_materials(reader);
  if (status.ok()) status = read_gltf_meshes(reader);
  if (status.ok()) status = read_gltf_nodes(reader);
  if (status.ok()) status = read_gltf_animations(reader);
  if (!status.ok()) return status.error();
  if (loaded.scene.instances.empty())
    return make_error(ErrorId::kGltf,
                      "shows no triangles: no node of its scene has a mesh made of triangles");
  if (!model.animations.empty() && !options.animated)
    loaded.warnings.push_back("animations are left out");
  if (const std::size_t joined = join_levels_by_name(loaded.scene); joined > 0)
    loaded.warnings.push_back(
        "nodes named lod0, lod1, ... at one place are taken as levels of "
        "detail; of each object one level is shown, " +
        std::to_string(joined) + " nodes are not");
  loaded.complete = complete(reader);
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
  // The parser throws if the JSON has the wrong types, and if memory runs out.
  try {
    Result<LoadedScene> loaded = load(bytes, name, folder, options);
    if (!loaded.ok()) return failed(loaded.error());
    return loaded;
  } catch (const std::bad_alloc&) {
    return failed(make_error(ErrorId::kGltf,
                             "takes more memory than there is: its counts and sizes may be wrong"));
  } catch (const std::exception& error) {
    return failed(make_error(ErrorId::kGltf, one_line(error.what())));
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

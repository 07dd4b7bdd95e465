// SPDX-License-Identifier: MIT
// Each function names every member of what it adds, so that one with a new member does not compile
// before somebody has decided about it.
#include "effects/assets/scene/scene_checksum.h"

namespace kaamos::effects {

namespace {

class SceneChecksum {
 public:
  explicit SceneChecksum(Checksum& checksum) : checksum_(checksum) {}

  void add(const Scene& scene) {
    const auto& [name, meshes, instances, materials, images, samplers, cameras, sun, lights, nodes,
                 skins, animations, sky, exposure, probes, particles] = scene;
    add_all(meshes);
    add_all(instances);
    add_all(materials);
    add_all(images);
    add_all(samplers);
    add_all(cameras);
    checksum_.add_value(sun.has_value());
    if (sun) {
      const auto& [direction_to_sun, irradiance, angular_radius] = *sun;
      checksum_.add_each(direction_to_sun, irradiance, angular_radius);
    }
    add_all(lights);
    add_all(nodes);
    add_all(skins);
    add_all(animations);
    const auto& [zenith, horizon, ground] = sky;
    checksum_.add_each(zenith, horizon, ground, exposure);
    for (const auto& [position, box_min, box_max] : probes) {
      checksum_.add_each(position, box_min, box_max);
    }
    for (const auto& [position, radius, radiance, opacity] : particles) {
      checksum_.add_each(position, radius, radiance, opacity);
    }
  }

 private:
  template <class T>
  void add_all(const std::vector<T>& parts) {
    checksum_.add_value(parts.size());
    for (const T& part : parts) add(part);
  }

  void add(const Geometry& geometry) {
    const auto& [first_vertex, vertex_count, index_offset, index_count, index_size, material,
                 alpha_tested] = geometry;
    checksum_.add_each(first_vertex, vertex_count, index_offset, index_count, index_size, material,
                       alpha_tested);
  }

  void add(const Mesh& mesh) {
    const auto& [name, vertices, skin, colors, second_uv, morph, morph_targets, indices,
                 geometries] = mesh;
    checksum_.add_values(vertices);
    checksum_.add_values(skin);
    checksum_.add_values(colors);
    checksum_.add_values(second_uv);
    checksum_.add_values(morph);
    checksum_.add_value(morph_targets);
    checksum_.add_values(indices);
    add_all(geometries);
  }

  void add(const Level& level) {
    const auto& [mesh, coverage] = level;
    checksum_.add_each(mesh, coverage);
  }

  void add(const Instance& instance) {
    const auto& [name, mesh, levels, transform, mask, motion, build_class] = instance;
    const auto& [skin, animation, start, node, morph] = motion;
    add_all(levels);
    checksum_.add_each(mesh, transform, mask, skin, animation, start, node, morph, build_class);
  }

  void add(const Material& material) {
    const auto& [name, constants] = material;
    MaterialConstants own = constants;
    own.one_texel_level = {};  // set on upload
    checksum_.add_value(own);
  }

  void add(const TextureImage& image) {
    const auto& [name, width, height, srgb, mips] = image;
    checksum_.add_each(width, height, srgb, mips.size());
    for (const auto& mip : mips) checksum_.add_values(mip);
  }

  void add(const Sampler& sampler) {
    const auto& [wrap_u, wrap_v, min_filter, mag_filter, mip_filter, mipmapped] = sampler;
    checksum_.add_each(wrap_u, wrap_v, min_filter, mag_filter, mip_filter, mipmapped);
  }

  void add(const Camera& camera) {
    const auto& [name, camera_to_world, vertical_fov, near_plane, half_height] = camera;
    checksum_.add_each(camera_to_world, vertical_fov, near_plane, half_height);
  }

  void add(const Light& light) {
    const auto& [name, type, color, intensity, position, direction, range, inner, outer, radius,
                 baked, projection] = light;
    checksum_.add_each(type, color, intensity, position, direction, range, inner, outer, radius,
                       baked, projection.has_value());
    if (!projection) return;
    const auto& [image, sampler, up] = *projection;
    checksum_.add_each(image, sampler, up);
  }

  void add(const Node& node) {
    const auto& [name, parent, translation, rotation, scale, matrix, weights] = node;
    checksum_.add_each(parent, translation, rotation, scale, matrix.has_value());
    if (matrix) checksum_.add_value(*matrix);
    checksum_.add_values(weights);
  }

  void add(const Skin& skin) {
    const auto& [name, joints, inverse_binds] = skin;
    checksum_.add_values(joints);
    checksum_.add_values(inverse_binds);
  }

  void add(const Channel& channel) {
    const auto& [node, path, interpolation, times, values, weights] = channel;
    checksum_.add_each(node, path, interpolation);
    checksum_.add_values(times);
    checksum_.add_values(values);
    checksum_.add_values(weights);
  }

  void add(const Animation& animation) {
    const auto& [name, channels, duration] = animation;
    add_all(channels);
    checksum_.add_value(duration);
  }

  Checksum& checksum_;
};

}  // namespace

void add_scene(Checksum& checksum, const Scene& scene) {
  SceneChecksum(checksum).add(scene);
}

}  // namespace kaamos::effects

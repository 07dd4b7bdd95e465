// SPDX-License-Identifier: MIT
/// @file
/// The scene that is rendered: meshes, instances, materials, pictures, lights, cameras, sky. It is
/// plain data on the host, from which acceleration structures and buffers are made. Right-handed,
/// +Y up, metres, linear colours. World positions and transforms are doubles, because they are made
/// relative to the camera before they are rounded to float.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "effects/assets/common/errors.h"
#include "effects/assets/scene/animation.h"
#include "effects/assets/scene/material.h"
#include "effects/assets/scene/mesh.h"
#include "effects/assets/scene/texture_image.h"

namespace kaamos::effects {

/// Bits of an instance's inclusion mask.
enum InstanceMask : std::uint8_t {
  kMaskOpaque = 0x01,       ///< opaque and alpha-tested
  kMaskTransparent = 0x02,  ///< see-through all over (glass)
  /// Shows a lamp of the scene, whose light is counted as the lamp's: the camera and mirrors see
  /// it, all other rays pass through it.
  kMaskEmissiveProxy = 0x10,
  /// Instances that the bake of indirect light sees. Not set by hand: instance_mask follows
  /// is_baked.
  kMaskBaked = 0x20,
};

/// The use that an acceleration structure is built for. [Northlight deck: Build Flags]
enum class BuildClass : std::uint8_t {
  kStatic,      ///< FAST_TRACE, compacted, shared by all instances of the mesh
  kDeformable,  ///< FAST_BUILD | ALLOW_UPDATE
  kHero,        ///< FAST_TRACE | ALLOW_UPDATE
  kEveryFrame,  ///< FAST_BUILD, never updated: built anew whenever it changed
};

/// A mesh that stands for an instance while that covers at least `coverage` of the picture's
/// height. [effects/assets/scene/levels.h]
struct Level {
  std::uint32_t mesh = 0;  ///< in Scene::meshes
  float coverage = 0;      ///< part of the picture's height, 0 to 1
};

/// A mesh somewhere in the scene. Its place in Scene::instances is InstanceIndex and InstanceID.
struct Instance {
  std::string name;                 ///< for people and messages
  std::uint32_t mesh = 0;           ///< in Scene::meshes
  std::vector<Level> levels = {};   ///< from fine to coarse, `mesh` one of them; empty: only `mesh`
  glm::dmat4 transform{1.0};        ///< object to world, affine
  std::uint8_t mask = kMaskOpaque;  ///< InstanceMask bits
  Motion motion = {};               ///< none by default: it stands still
  /// The class for the structure of a skinned instance; kStatic counts as kDeformable there.
  BuildClass build_class = BuildClass::kStatic;
};

/// Returns whether the bake of indirect light sees an instance: one that stands still and is
/// neither glass nor the shape of a lamp.
bool is_baked(const Instance& instance);
/// The mask of an instance in the top level: its own, and kMaskBaked where is_baked says so.
std::uint8_t instance_mask(const Instance& instance);

/// The way in which a light shines. [KHR_lights_punctual]
enum class LightType : std::uint8_t { kDirectional, kPoint, kSpot };

/// The upper three rows of the transform, as a DXR instance record and HLSL's ObjectToWorld3x4()
/// have them, relative to `origin`: subtracted in double, so that float keeps its digits for what
/// is near the camera.
glm::mat3x4 transform_3x4(const Instance& instance, const glm::dvec3& origin = glm::dvec3(0.0));

/// True where the transform mirrors. Fronts of all meshes are counter-clockwise seen from outside
/// in object space; DXR takes facing from object space too, so mirrored instances need no other
/// flag than the rest, but glTF's fronts of a mirrored node are the other side.
bool is_mirrored(const Instance& instance);

/// The picture that a spot throws on what it lights.
struct ProjectionMap {
  std::uint32_t image = 0;    ///< in Scene::images
  std::uint32_t sampler = 0;  ///< in Scene::samplers
  glm::vec3 up{0, 1, 0};      ///< where its upper edge points, as far as it is across the light
};

/// A local light, or a directional one besides the sun. [KHR_lights_punctual]
struct Light {
  std::string name;                    ///< for people
  LightType type = LightType::kPoint;  ///< which of the members count
  glm::vec3 color{1.0f};               ///< linear
  float intensity = 1.0f;              ///< lux for directional, candela for point and spot
  glm::dvec3 position{0.0};            ///< world space, metres; not of directional ones
  glm::vec3 direction{0, -1, 0};       ///< the way the light travels, unit
  float range = 0.0f;                  ///< metres; 0 = unlimited
  /// Half angles of a spot, radians: full light inside of the first, none outside of the second.
  ///@{
  float inner_cone_angle = 0.0f;
  float outer_cone_angle = 0.785398f;
  ///@}
  float radius = 0.02f;  ///< of the sphere that soft shadows sample, metres
  bool baked = true;     ///< indirect light has it; false for one that is switched or moves
  /// A spot's picture, as a slide in a projector: its colours times the light's. It fills the
  /// square around the cone.
  std::optional<ProjectionMap> projection = {};
};

/// Angular radius of the real sun as seen from the earth.
inline constexpr float kSunAngularRadius = 0.2655f * 3.14159265f / 180.0f;

/// A light infinitely far away, with an area.
struct Sun {
  glm::vec3 direction_to_sun{0, 1, 0};       ///< unit
  glm::vec3 irradiance{3.0f};                ///< on a surface that faces the sun, relative units
  float angular_radius = kSunAngularRadius;  ///< radians; 0: hard shadows
};

/// Radiance of the sky: from horizon to zenith above, ground below.
struct Sky {
  glm::vec3 zenith{0.0f};   ///< straight up
  glm::vec3 horizon{0.0f};  ///< level
  glm::vec3 ground{0.0f};   ///< everywhere below the horizon
};

/// Radiance of the sky towards a unit direction.
glm::vec3 sky_radiance(const Sky& sky, const glm::vec3& direction);

/// A camera: a perspective one, unless it has a half_height.
struct Camera {
  std::string name;                 ///< for people
  glm::dmat4 camera_to_world{1.0};  ///< rigid; looks along -Z, +Y is up in the picture
  double vertical_fov = 0.9;        ///< full angle, 0..pi exclusive
  double near_plane = 0.05;         ///< metres; scales stored depths, cuts nothing off
  /// Metres, above 0: half the height of what an orthographic camera sees; its rays are parallel
  /// and start on the plane of the camera. 0: perspective, vertical_fov counts.
  double half_height = 0.0;

  /// True where the rays are parallel.
  bool is_orthographic() const { return half_height > 0.0; }
  /// Half the picture's height, metres: of an orthographic camera anywhere, else at distance 1.
  double picture_half_height() const {
    return is_orthographic() ? half_height : std::tan(0.5 * vertical_fov);
  }

  /// Returns where it stands, in world space.
  glm::dvec3 position() const { return glm::dvec3(camera_to_world[3]); }
  /// Returns where it looks, as a unit vector.
  glm::dvec3 forward() const { return -glm::dvec3(camera_to_world[2]); }
};

/// Camera transform that stands at `eye` and looks at `target`. Any `up` is taken, also one along
/// the view.
glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target,
                   const glm::dvec3& up = glm::dvec3(0, 1, 0));

/// A round spot of light that turns towards the camera: a spark, a puff of smoke. It is drawn over
/// the finished frame: neither the G-buffer nor an acceleration structure has it, and files do not.
/// It is densest in its middle: at a share s of its radius, (1 - s^2)^2 of that.
struct Particle {
  glm::dvec3 position{0.0};  ///< of its middle, world space
  float radius = 0.01f;      ///< metres, above 0
  glm::vec3 radiance{0.0f};  ///< that it adds
  float opacity = 0.0f;      ///< part of what is behind it that it hides, 0 to 1; 0: it only adds
};

/// A point from which an environment map shows the scene, world space.
struct EnvironmentProbe {
  glm::dvec3 position{0.0};  ///< outside of everything solid
  /// The walls that its picture is taken to show: reflections are looked up where their rays meet
  /// this box. Not empty.
  ///@{
  glm::dvec3 box_min{-1.0};
  glm::dvec3 box_max{1.0};
  ///@}
};

/// Everything that is rendered. Indices between its parts are places in its vectors.
struct Scene {
  std::string name;                      ///< for people and files
  std::vector<Mesh> meshes;              ///< each becomes a bottom level
  std::vector<Instance> instances;       ///< the top level
  std::vector<Material> materials;       ///< at least one
  std::vector<TextureImage> images;      ///< of the materials
  std::vector<Sampler> samplers;         ///< at least one
  std::vector<Camera> cameras;           ///< at least one; the first is the default
  std::optional<Sun> sun;                ///< none: no sun shines
  std::vector<Light> lights;             ///< all but the sun
  std::vector<Node> nodes;               ///< parents first; only what skins and animations need
  std::vector<Skin> skins;               ///< of skinned instances
  std::vector<Animation> animations;     ///< of nodes
  Sky sky;                               ///< what rays see that miss
  float exposure = 1.0f;                 ///< radiance times this goes to the tone curve
  std::vector<EnvironmentProbe> probes;  ///< of environment maps; empty: they are found
  std::vector<Particle> particles;       ///< drawn over the frame
};

/// Triangles after instancing.
std::uint64_t instanced_triangle_count(const Scene& scene);
/// Triangles of the meshes, each counted once.
std::uint64_t unique_triangle_count(const Scene& scene);
/// World bounds of all instances, at time 0: exact to the transformed boxes of the meshes, so never
/// too small.
Bounds scene_bounds(const Scene& scene);

/// Checks the data: ids in range, index ranges inside their buffers, finite transforms, mip sizes,
/// unit directions. A valid scene can be uploaded unchecked.
/// @errors KA3022 the first broken rule, named by place and value.
Status validate(const Scene& scene);

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
#include "effects/measure/study/moving_box.h"

#include <algorithm>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "effects/assets/scene/shapes.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr double kHalf = 0.25;    // metres
constexpr double kSpeed = 1.5;    // metres a second
constexpr double kFarAway = 1e3;  // metres

// Where the box is, as keys of its animation.
struct Key {
  double seconds = 0;
  glm::dvec3 at{0.0};  // from its place in front of the camera
};

Scene with_box(Scene scene, const std::vector<Key>& keys) {
  const Camera& camera = scene.cameras.front();
  const double ahead =
      std::min(3.0, 0.3 * glm::length(glm::dvec3(scene_bounds(scene).size())) + 0.5);
  Mesh mesh;
  mesh.name = "mover";
  add_shape(mesh, box(glm::dvec3(std::min(kHalf, 0.1 * ahead))), 0);
  Node node;
  node.name = "mover";
  node.translation = camera.position() + ahead * camera.forward();
  Channel way{.node = static_cast<std::uint32_t>(scene.nodes.size()),
              .path = ChannelPath::kTranslation};
  for (const Key& key : keys) {
    way.times.push_back(static_cast<float>(key.seconds));
    way.values.push_back(glm::vec4(glm::vec3(node.translation + key.at), 0));
  }
  Instance instance;
  instance.name = "mover";
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.motion.node = static_cast<std::int32_t>(scene.nodes.size());
  instance.motion.animation = static_cast<std::int32_t>(scene.animations.size());
  scene.meshes.push_back(std::move(mesh));
  scene.nodes.push_back(node);
  scene.animations.push_back({"mover", {way}, keys.back().seconds});
  scene.instances.push_back(instance);
  return scene;
}

}  // namespace

Scene with_mover(Scene scene) {
  const glm::dvec3 side(scene.cameras.front().camera_to_world[0]);
  std::vector<Key> keys;
  for (const double seconds : {0.0, 1.0})
    keys.push_back({seconds, (seconds - 0.1) * kSpeed * side});
  return with_box(std::move(scene), keys);
}

Scene with_box_until(Scene scene, double seconds) {
  const glm::dvec3 away(0, -kFarAway, 0);
  // Animations begin anew behind their end.
  const double end = 1e4;
  return with_box(std::move(scene),
                  {{0, {}}, {seconds - 1e-3, {}}, {seconds - 5e-4, away}, {end, away}});
}

}  // namespace kaamos::measure

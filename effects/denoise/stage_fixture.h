// SPDX-License-Identifier: MIT
// A small stage with something that leaves and a light that can go out, and whole frames of it.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "effects/assets/scene/shapes.h"
#include "effects/denoise/denoise.h"
#include "effects/northlight/frame_renderer.h"
#include "tests/vulkan/support.h"

namespace kaamos::effects {

inline void add_thing(Scene& scene, const char* name, Shape shape, const glm::dvec3& at) {
  Mesh mesh;
  mesh.name = name;
  add_shape(mesh, std::move(shape), 0);
  Instance instance;
  instance.name = name;
  instance.mesh = static_cast<std::int32_t>(scene.meshes.size());
  instance.transform = translate(at);
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(instance);
}

// A floor before a wall. A board stands on the floor, and two seconds later it is gone. Indirect
// light comes from the sun and from a lamp at the wall, which no baked light knows.
inline Scene make_stage() {
  Scene scene;
  scene.name = "stage";
  Material white;
  white.constants.base_color = glm::vec4(0.8f, 0.8f, 0.8f, 1.0f);
  white.constants.flags = kMaterialDoubleSided;
  scene.materials.push_back(white);
  scene.samplers.push_back(Sampler{});
  add_thing(scene, "floor", patch({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, 1, 1), {0, 0, 0});
  add_thing(scene, "wall", patch({-3, 0, -1.5}, {6, 0, 0}, {0, 3, 0}, 1, 1), {0, 0, 0});
  add_thing(scene, "board", box({0.1, 1.0, 1.0}), {0, 0, 0});
  Node node;
  node.name = "board";
  node.translation = {0.7, 1, 0};
  scene.nodes.push_back(node);
  Channel channel;
  channel.path = ChannelPath::kTranslation;
  channel.interpolation = Interpolation::kStep;
  channel.times = {0, 2};
  channel.values = {{0.7f, 1, 0, 0}, {0, 40, 0, 0}};
  scene.animations.push_back({"leave", {channel}, 100.0});
  scene.instances[2].motion = {.animation = 0, .node = 0};
  scene.sun = Sun{glm::normalize(glm::vec3(1, 0.7f, 0.3f)), glm::vec3(3), 0.05f};
  Light lamp;
  lamp.position = {0, 1.2, -1.0};
  lamp.intensity = 30;
  lamp.baked = false;
  scene.lights.push_back(lamp);
  Camera camera;
  camera.camera_to_world = look_at(glm::dvec3(-1.5, 3, 3), glm::dvec3(0.2, 0, 0));
  scene.cameras.push_back(camera);
  return scene;
}

// Frames of the stage, thirty a second.
class Show {
 public:
  struct Options {
    DenoiseMethod method = DenoiseMethod::kSvgf;
    std::string backend = "embree";
    std::vector<std::string> effects;
    std::uint32_t width = 48, height = 36;
    std::uint32_t pixel_step = 1;
    bool rotates = false;
    std::uint32_t samples = 1;
    std::uint32_t seed = 0;
    std::function<void(FrameSettings&)> change = {};
  };
  Show(Scene& scene, const Options& options) : scene_(scene) {
    FrameSettings settings;
    settings.width = options.width;
    settings.height = options.height;
    settings.seed = options.seed;
    settings.effects = choose_effects(options.effects);
    for (auto& [name, effect] : settings.effects) {
      effect.samples = options.samples;
      effect.pixel_step = options.pixel_step;
      effect.rotates = options.rotates;
    }
    settings.whole_frame = true;
    settings.moving = true;
    settings.denoise = default_denoise(options.method);
    settings.volume = {.cell = 3.0f, .samples = 1, .bounces = 1, .lights = kBakeEmissive};
    if (options.change) options.change(settings);
    rtapi::DeviceDesc device;
    device.Backend = options.backend;
    renderer_ = FrameRenderer::create(test::device_for(device), scene, settings).value();
  }

  // `seconds`: on the scene's clock; none: it goes on.
  void render(double seconds = 0, const glm::dvec3& camera_at = glm::dvec3(0)) {
    FrameMoment moment;
    moment.index = index_;
    moment.seconds = seconds;
    moment.camera = scene_.cameras.front();
    moment.camera.camera_to_world[3] += glm::dvec4(camera_at, 0);
    moment.cut = index_++ == 0;
    renderer_->begin_frame(moment).value();
    renderer_->render().value();
  }
  FloatImage read(const std::string& layer) { return renderer_->read(layer).value(); }
  FloatImage changes(std::size_t index = 0) {
    return renderer_->read(renderer_->effects().gradients().gradients()->changes()[index]).value();
  }
  FrameRenderer& renderer() { return *renderer_; }

 private:
  Scene& scene_;
  std::unique_ptr<FrameRenderer> renderer_;
  std::uint32_t index_ = 0;
};

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
#include "effects/northlight/scene_stage.h"

#include <algorithm>
#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/assets/scene/levels.h"
#include "effects/composition/taa/taa.h"

namespace kaamos::effects {

rtapi::Status SceneStage::create() {
  const FrameSettings& settings = context_.settings;
  const Scene& scene = context_.scene;
  const Camera& camera = scene.cameras.front();
  context_.moment.camera = camera;
  const bool has_morph =
      std::any_of(scene.instances.begin(), scene.instances.end(),
                  [](const Instance& instance) { return instance.motion.morph != kNoIndex; });
  Profile* profile = context_.profile;
  if (settings.moving || settings.structures.coarser_rays > 0 || !scene.skins.empty() ||
      has_morph) {
    const auto step = Profile::enter(profile, ProfilePart::kStart, "structures");
    auto manager = StructureManager::create(context_.device, context_.runner.queue(), scene,
                                            settings.structures);
    if (!manager) return manager.error();
    structures_ = std::move(*manager);
    context_.gpu = structures_->scene();
  } else {
    auto gpu = create_gpu_scene(context_.device, context_.runner.queue(), scene, camera.position(),
                                profile, settings.structures.opacity_micromaps);
    if (!gpu) return gpu.error();
    context_.gpu = std::move(*gpu);
  }
  const auto step = Profile::enter(profile, ProfilePart::kStart, "pictures of the frame");
  FrameDesc desc;
  desc.width = settings.width;
  desc.height = settings.height;
  desc.seed = settings.seed;
  desc.ray_cones = settings.ray_cones;
  desc.sun_angular_radius = settings.sun_angular_radius;
  desc.sun_map = settings.sun_map;
  desc.max_pass_views = settings.max_pass_views;
  auto frame = Frame::create(context_.device, scene, context_.gpu, camera, desc);
  if (!frame) return frame.error();
  context_.frame = std::move(*frame);
  // What is baked later sees the scene as it is at the beginning.
  return structures_ ? begin_frame(FrameMoment(context_.moment)) : rtapi::Status{};
}

rtapi::Status SceneStage::begin_frame(const FrameMoment& moment) {
  if (!structures_ && moment.camera.position() != context_.scene.cameras.front().position()) {
    return make_error(ErrorId::kFrameRenderer,
                      "the camera moves, and the scene on the device stays where it was for the "
                      "first one: set FrameSettings::moving");
  }
  FrameTime time;
  time.index = moment.index;
  time.previous_camera = moment.index == 0 ? moment.camera : context_.moment.camera;
  time.previous_jitter = jitter_;
  jitter_ = context_.settings.taa ? taa_jitter(moment.index) : glm::vec2(0.0f);
  time.jitter = jitter_;
  context_.moment = moment;
  PassRunner& runner = context_.runner;
  runner.clear();
  const glm::dvec3 origin = moment.camera.position();
  if (structures_) {
    const auto step = Profile::enter(context_.profile, ProfilePart::kFrame, "structures");
    const double start = runner.now_ms();
    const auto done =
        structures_->execute(context_.device, runner.queue(), states_at(moment), origin);
    if (!done) return done;
    runner.add({"structures", runner.now_ms() - start, {}});
  }
  return context_.frame.set_camera(context_.device, context_.scene, moment.camera, time);
}

rtapi::Status SceneStage::set_coarser_rays(std::uint32_t levels) {
  if (!structures_ || context_.settings.structures.coarser_rays == 0) {
    return make_error(ErrorId::kFrameRenderer,
                      "rays see the levels of detail that draws show: set "
                      "StructureOptions::coarser_rays above 0");
  }
  structures_->set_coarser_rays(levels);
  const FrameMoment& moment = context_.moment;
  return structures_->execute(context_.device, context_.runner.queue(), states_at(moment),
                              moment.camera.position());
}

rtapi::Status SceneStage::set_seed(std::uint32_t seed) {
  context_.frame.set_seed(seed);
  const FrameMoment& moment = context_.moment;
  return context_.frame.set_camera(context_.device, context_.scene, moment.camera,
                                   {.index = moment.index, .previous_camera = moment.camera});
}

std::vector<InstanceState> SceneStage::states_at(const FrameMoment& moment) const {
  const Scene& scene = context_.scene;
  std::vector<InstanceState> states = evaluate_instances(scene, moment.seconds);
  std::vector<glm::dmat4> transforms;
  for (const InstanceState& state : states) transforms.push_back(state.transform);
  const std::vector<std::uint32_t> meshes = select_levels(scene, moment.camera, transforms);
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].mesh = static_cast<std::int32_t>(meshes[i]);
  }
  return states;
}

}  // namespace kaamos::effects

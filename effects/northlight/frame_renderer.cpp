// SPDX-License-Identifier: MIT
// The order of a frame; what is done stands in its stages.
#include "effects/northlight/frame_renderer.h"

#include <utility>

#include "effects/assets/common/errors.h"
#include "effects/engine/picture.h"
#include "effects/northlight/frame_layers.h"

namespace kaamos::effects {

namespace {

// A dispatch of an effect that runs alone takes no more samples.
constexpr std::uint32_t kMostSamplesPerDispatch = 1024;

// Fills in the shaders that the frame needs.
rtapi::Result<Outcome> find_libraries(FrameContext& context, bool are_given,
                                      const Progress& progress) {
  const std::vector<EffectLibrary> wanted = frame_libraries(context.settings, context.effects);
  if (!are_given) {
    const auto done = load_libraries(wanted, context.libraries, progress);
    if (!is_done(done)) return done;
  }
  for (const EffectLibrary& library : wanted) {
    if (context.libraries.count(library.file) != 0) continue;
    return make_error(ErrorId::kLibraries,
                      "the frame needs the shader library \"" + library.file +
                          "\": hand all of frame_libraries() to set_libraries");
  }
  return Outcome::kDone;
}

}  // namespace

FrameRenderer::FrameRenderer(const rtapi::Device& device, const Scene& scene,
                             const FrameSettings& settings, std::vector<Effect> effects)
    : context_{scene, settings, std::move(effects), device},
      scene_(std::make_unique<SceneStage>(context_)),
      stages_(std::make_unique<Stages>(context_)) {
  add_included(context_.settings.effects, context_.effects);
}

rtapi::Result<std::unique_ptr<FrameRenderer>> FrameRenderer::create(const rtapi::Device& device,
                                                                    const Scene& scene,
                                                                    const FrameSettings& settings,
                                                                    std::vector<Effect> effects,
                                                                    Profile* profile) {
  std::unique_ptr<FrameRenderer> out(
      new FrameRenderer(device, scene, settings, std::move(effects)));
  FrameContext& context = out->context_;
  context.profile = profile;
  if (const auto s = check_settings(context.settings, context.effects); !s) return s.error();
  if (!scene.cameras.empty()) {
    const auto s = check_camera(scene.cameras.front(), context.settings, context.effects);
    if (!s) return s.error();
  }
  auto runner = PassRunner::create(device);
  if (!runner) return runner.error();
  context.runner = std::move(*runner);
  context.runner.set_profile(profile);
  if (const auto s = out->scene_->create(); !s) return s.error();
  return out;
}

void FrameRenderer::set_libraries(ShaderLibraries libraries) {
  context_.libraries = std::move(libraries);
  has_own_libraries_ = true;
  is_prepared_ = false;
}

rtapi::Result<Outcome> FrameRenderer::prepare(const Progress& progress) {
  if (is_prepared_) return Outcome::kDone;
  stages_ = std::make_unique<Stages>(context_);
  context_.frame.release_pass_views();  // those of earlier shaders
  context_.left_out.clear();
  context_.set_up.reset();
  has_surfaces_ = has_effects_ = false;
  {
    const auto step = Profile::enter(context_.profile, ProfilePart::kStart, "shader libraries");
    const auto done = find_libraries(context_, has_own_libraries_, progress);
    if (!is_done(done)) return done;
  }
  const double start = context_.runner.now_ms();
  if (const auto done = create_stages(progress); !is_done(done)) return done;
  if (context_.settings.whole_frame) {
    context_.set_up = {"set-up and bake", context_.runner.now_ms() - start,
                       context_.device.GetStatistics()};
  }
  list_left_out(context_);
  is_prepared_ = true;
  return Outcome::kDone;
}

rtapi::Result<Outcome> FrameRenderer::create_stages(const Progress& progress) {
  auto& [surfaces, lights, effects, filters, composition] = *stages_;
  const auto run = [&](const char* name, auto create) {
    const auto step = Profile::enter(context_.profile, ProfilePart::kStart, name);
    return create();
  };
  if (const auto s = run("G-buffer", [&] { return surfaces.create(); }); !s) return s.error();
  effects.choose();
  const bool is_whole = context_.settings.whole_frame;
  if (is_whole) {
    const auto done =
        run("local lights", [&] { return lights.create(effects.light_needs(), progress); });
    if (!is_done(done)) return done;
  }
  if (const auto s = run("effects", [&] { return effects.create(); }); !s) return s.error();
  if (is_whole) {
    if (const auto s = run("denoisers", [&] { return filters.create(); }); !s) return s.error();
  }
  if (const auto s = run("composition", [&] { return composition.create(); }); !s) {
    return s.error();
  }
  if (is_whole && lights.bakes_on_demand()) {
    return run("indirect light", [&] { return bake_on_demand(progress); });
  }
  return Outcome::kDone;
}

rtapi::Result<Outcome> FrameRenderer::bake_on_demand(const Progress& progress) {
  auto& [surfaces, lights, effects, filters, composition] = *stages_;
  const auto drawn = context_.runner.execute([&](rtapi::CommandList& list) {
    surfaces.record(list);
    lights.record(list);
  });
  if (!drawn) return drawn.error();
  for (const bool is_first : {true, false}) {
    if (const auto s = effects.read_volume(progress); !is_done(s)) return s;
    if (const auto s = lights.bake_read(is_first, progress); !is_done(s)) return s;
  }
  if (const auto s = effects.remake_readers(); !s) return s.error();
  return Outcome::kDone;
}

rtapi::Result<Outcome> FrameRenderer::bake_for_frame(const Progress& progress) {
  LightStage& lights = stages_->lights;
  if (!lights.bakes_on_demand()) return Outcome::kDone;
  PassRunner& runner = context_.runner;
  context_.device.ResetStatistics();
  const double start = runner.now_ms();
  if (const auto s = lights.bake_read(false, progress); !is_done(s)) return s;
  if (lights.baked() > 0) {
    runner.add({"indirect light bake", runner.now_ms() - start, context_.device.GetStatistics()});
  }
  return Outcome::kDone;
}

rtapi::Status FrameRenderer::begin_frame(const FrameMoment& moment) {
  if (const auto s = scene_->begin_frame(moment); !s) return s;
  has_begun_ = true;
  has_surfaces_ = has_effects_ = false;
  stages_->composition.begin_frame();
  return stages_->effects.begin_frame();
}

rtapi::Result<Outcome> FrameRenderer::render(const Progress& progress) {
  if (const auto s = prepare(progress); !is_done(s)) return s;
  if (!has_begun_) context_.runner.clear();
  has_begun_ = false;
  if (const auto s = stages_->surfaces.run(progress); !is_done(s)) return s;
  if (const auto s = run_effects(progress); !is_done(s)) return s;
  has_surfaces_ = has_effects_ = true;
  if (const auto s = stages_->composition.run(); !s) return s.error();
  return Outcome::kDone;
}

rtapi::Result<Outcome> FrameRenderer::run_early_effects(const Progress& progress) {
  auto& [surfaces, lights, effects, filters, composition] = *stages_;
  if (context_.settings.whole_frame) {
    lights.begin_frame();
    filters.begin_frame();
  }
  if (const auto s = effects.begin(); !s) return s.error();
  if (context_.settings.whole_frame) {
    if (const auto s = lights.run(); !s) return s.error();
    if (const auto s = bake_for_frame(progress); !is_done(s)) return s;
  }
  if (const auto s = effects.run(false, progress); !is_done(s)) return s;
  if (const auto s = filters.run(false); !s) return s.error();
  return Outcome::kDone;
}

rtapi::Result<Outcome> FrameRenderer::run_effects(const Progress& progress) {
  if (const auto s = run_early_effects(progress); !is_done(s)) return s;
  auto& [surfaces, lights, effects, filters, composition] = *stages_;
  if (!effects.has_late()) return Outcome::kDone;
  if (const auto s = composition.run_unreflected(); !s) return s.error();
  if (const auto s = effects.run(true, progress); !is_done(s)) return s;
  if (const auto s = filters.run(true); !s) return s.error();
  return Outcome::kDone;
}

rtapi::Result<ActiveEffect*> FrameRenderer::find_runnable(const std::string& name,
                                                          const EffectSettings& settings) {
  if (const auto s = prepare(); !s) return s.error();
  PassRunner& runner = context_.runner;
  if (!has_surfaces_) {
    const auto drawn = runner.execute([&](rtapi::CommandList& list) {
      stages_->surfaces.record(list);
      if (context_.settings.whole_frame) stages_->lights.record(list);
    });
    if (!drawn) return drawn.error();
    has_surfaces_ = true;
  }
  ActiveEffect* effect = stages_->effects.find(name);
  if (effect == nullptr || !effect->has_passes()) {
    return make_error(
        ErrorId::kFrameRenderer,
        "effect \"" + name +
            "\" cannot be run: it is not chosen, has no passes, or the scene has no use for it");
  }
  if (effect->is_late()) {
    if (!has_effects_) {
      if (const auto s = run_early_effects({}); !s) return s.error();
      has_effects_ = true;
    }
    const auto done = runner.execute(
        [&](rtapi::CommandList& list) { stages_->composition.record_unreflected(list); });
    if (!done) return done.error();
  }
  if (const auto s = effect->prepare(settings); !s) return s.error();
  return effect;
}

rtapi::Result<RunStatistics> FrameRenderer::run(const std::string& effect, std::uint32_t samples) {
  const auto chosen = context_.settings.effects.find(effect);
  EffectSettings settings;
  if (chosen != context_.settings.effects.end()) settings = chosen->second;
  settings.samples = samples;
  return run(effect, settings);
}

rtapi::Result<RunStatistics> FrameRenderer::run(const std::string& name,
                                                const EffectSettings& settings,
                                                std::uint32_t first_sample) {
  const auto effect = find_runnable(name, settings);
  if (!effect) return effect.error();
  context_.device.ResetStatistics();
  const auto ms = context_.runner.execute([&](rtapi::CommandList& list) {
    (*effect)->record(
        list, settings,
        {.first_sample = first_sample, .sample_count = settings.samples, .accumulate = 0});
    (*effect)->record_compose(list, settings);
  });
  if (!ms) return ms.error();
  (*effect)->set_samples(settings.samples);
  return RunStatistics{*ms, context_.device.GetStatistics().TraceRayCalls};
}

rtapi::Result<Outcome> FrameRenderer::accumulate(const std::string& name,
                                                 const EffectSettings& settings,
                                                 const Progress& progress) {
  if (const auto s = prepare(progress); !is_done(s)) return s;
  const auto effect = find_runnable(name, settings);
  if (!effect) return effect.error();
  SampledWork work;
  work.title = name;
  work.samples = settings.samples;
  work.most_samples = kMostSamplesPerDispatch;
  work.grows = true;
  work.record = [&](rtapi::CommandList& list, const PassConstants& constants, std::uint32_t) {
    (*effect)->record(list, settings, constants);
  };
  work.done = [&](std::uint32_t samples) { (*effect)->set_samples(samples); };
  return context_.runner.run_samples(work, progress);
}

rtapi::Status FrameRenderer::set_seed(std::uint32_t seed) {
  stages_->effects.gradients().forget();  // samples of another seed cannot be compared
  has_effects_ = false;
  return scene_->set_seed(seed);
}

std::vector<std::string> FrameRenderer::parts() const {
  std::vector<std::string> out = {"gbuffer"};
  if (context_.settings.whole_frame) out.emplace_back("lights");
  for (const bool late : {false, true}) {
    for (const auto& effect : stages_->effects.active()) {
      if (effect->has_passes() && effect->is_late() == late) out.push_back(effect->row().name);
    }
  }
  return out;
}

void FrameRenderer::record(rtapi::CommandList& list, const std::string& part,
                           const PartOptions& options) {
  auto& [surfaces, lights, effects, filters, composition] = *stages_;
  if (part == "gbuffer") return surfaces.record(list);
  if (part == "lights") return lights.record(list);
  ActiveEffect* effect = effects.find(part);
  if (effect == nullptr || !effect->has_passes()) return;
  if (effect->is_late() && filters.record_early(list)) composition.record_unreflected(list);
  effects.record(list, *effect, options);
}

std::vector<std::string> FrameRenderer::layers() const {
  std::vector<std::string> out = layer_names(context_);
  out.emplace_back("radiance");
  return out;
}

rtapi::Status FrameRenderer::check_layer(const std::string& name) const {
  std::string known;
  for (const std::string& layer : layers()) {
    if (layer == name) return {};
    known += (known.empty() ? "" : ", ") + layer;
  }
  return make_error(ErrorId::kFrameRenderer,
                    "the frame has no layer \"" + name + "\" but " + known);
}

rtapi::Result<FloatImage> FrameRenderer::read(const rtapi::Texture& picture) {
  const auto step = Profile::enter(context_.profile, ProfilePart::kFiles, "read back");
  return read_picture(context_.device, context_.runner.queue(), picture);
}

rtapi::Result<FloatImage> FrameRenderer::read(const std::string& name) {
  if (name == "radiance") return read(stages_->composition.result());
  for (const FrameLayer& layer :
       find_layers(context_, stages_->lights, stages_->effects, stages_->filters)) {
    if (layer.name != name) continue;
    auto image = read(layer.picture);
    if (image) decode_layer(layer, *image);
    return image;
  }
  if (const auto s = check_layer(name); !s) return s.error();
  return make_error(ErrorId::kFrameRenderer,
                    "layer \"" + name + "\" is not there before the frame is prepared");
}

rtapi::Result<FloatImage> read_composed(FrameRenderer& renderer,
                                        const std::vector<std::string>& signals) {
  if (const auto s = renderer.composition().run_some(signals); !s) return s.error();
  return renderer.read("radiance");
}

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
// Frames: passes in their order, in bands of rows so that they can be watched and stopped.
#include "effects/northlight/frame_renderer.h"

#include <algorithm>
#include <utility>

#include "effects/assets/scene/levels.h"
#include "effects/engine/picture.h"

namespace kaamos::effects {

namespace {

// The most samples that a pixel takes in one dispatch.
constexpr std::uint32_t kSamplesPerDispatch = 64;
// A dispatch should not take longer, so that progress moves and the frame can be stopped.
constexpr double kDispatchMs = 250;
constexpr std::uint32_t kFirstRows = 32;

}  // namespace

// Every other pixel lies across, so that after two frames each pixel has one with rays beside it.
std::uint32_t rotating_offset(std::uint32_t index) {
  constexpr std::uint32_t kTurns[] = {0, 3, 1, 2};
  return kTurns[index % 4];
}

std::uint32_t pixel_offset(const EffectSettings& settings, std::uint32_t index) {
  return settings.pixel_step == 2 && settings.rotates ? rotating_offset(index) : 0;
}

std::uint32_t first_sample(const EffectSettings& settings, std::uint32_t index) {
  const bool takes_turns = settings.pixel_step == 2 && settings.rotates;
  return (takes_turns ? index / 4 : index) * settings.samples;
}

const FrameRenderer::Active* FrameRenderer::active(const std::string& effect) const {
  const auto found = std::find_if(active_.begin(), active_.end(),
                                  [&](const auto& each) { return each->row->name == effect; });
  return found == active_.end() ? nullptr : found->get();
}

bool FrameRenderer::comes_first(const Active& effect) const {
  return has_passes(*effect.row) &&
         std::all_of(effect.row->signals.begin(), effect.row->signals.end(),
                     [](const auto& signal) { return signal.picture; });
}

bool FrameRenderer::has_strongest_effect() const {
  return direct_ && std::any_of(active_.begin(), active_.end(), [](const auto& effect) {
           return effect->row->needs.strongest_lights;
         });
}

std::vector<InstanceState> FrameRenderer::states_at(const FrameMoment& moment) const {
  std::vector<InstanceState> states = evaluate_instances(scene_, moment.seconds);
  std::vector<glm::dmat4> transforms;
  for (const InstanceState& state : states) transforms.push_back(state.transform);
  const std::vector<std::uint32_t> meshes = select_levels(scene_, moment.camera, transforms);
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].mesh = static_cast<std::int32_t>(meshes[i]);
  }
  return states;
}

rtapi::Status FrameRenderer::begin_frame(const FrameMoment& moment) {
  if (!structures_ && moment.camera.position() != scene_.cameras.front().position()) {
    return make_error(ErrorId::kFrameRenderer,
                      "the camera moves, and the scene on the device stays where it was for the "
                      "first one: set FrameSettings::moving");
  }
  FrameTime time;
  time.index = moment.index;
  time.previous_camera = moment.index == 0 ? moment.camera : moment_.camera;
  time.previous_jitter = jitter_;
  jitter_ = settings_.taa ? taa_jitter(moment.index) : glm::vec2(0.0f);
  time.jitter = jitter_;
  moment_ = moment;
  statistics_.clear();
  has_begun_ = true;
  has_surfaces_ = has_effects_ = false;
  const glm::dvec3 origin = moment.camera.position();
  if (structures_) {
    const double start = clock_ms_();
    const auto done = structures_->execute(device_, queue_, states_at(moment), origin);
    if (!done) return done;
    statistics_.push_back({"structures", clock_ms_() - start, {}});
  }
  if (moment.cut && taa_) taa_->reset();
  if (const auto s = frame_.set_camera(device_, scene_, moment.camera, time); !s) return s;
  for (const auto& effect : active_) {
    if (!effect->own) continue;
    if (const auto s = effect->own->begin_frame(moment.camera); !s) return s;
    for (const auto& other : effect->others) {
      if (const auto s = other->own->begin_frame(moment.camera); !s) return s;
    }
  }
  return {};
}

rtapi::Status FrameRenderer::sort_rays(const Active& effect, const PassConstants& constants,
                                       double& ms) {
  const auto took = execute([&](rtapi::CommandList& list) {
    effect.keys->dispatch(list, frame_, constants, frame_.height(),
                          arguments(effect, effect.settings));
    sorter_->sort(list, frame_, settings_.order);
  });
  if (!took) return took.error();
  ms += *took;
  return {};
}

rtapi::Result<Outcome> FrameRenderer::run_pass(const std::string& title, const RayPass& pass,
                                               Active* effect, const Progress& progress) {
  const std::uint32_t samples = effect != nullptr ? effect->settings.samples : 1;
  const std::uint32_t step = effect != nullptr ? effect->settings.pixel_step : 1;
  const PassArguments words =
      effect != nullptr ? arguments(*effect, effect->settings) : PassArguments{};
  const bool is_sorted = effect != nullptr && effect->keys;
  const std::uint32_t first =
      effect != nullptr ? first_sample(effect->settings, moment_.index) : moment_.index;
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  double order_ms = 0;
  device_.ResetStatistics();
  const double start = clock_ms_();
  const std::uint32_t offset =
      effect != nullptr ? pixel_offset(effect->settings, moment_.index) : 0;
  const std::uint32_t height =
      traced_rows({.pixel_step = step, .pixel_offset = offset}, frame_.height());
  std::uint32_t rows = std::min(settings_.rows > 0 ? settings_.rows : kFirstRows, height);
  for (std::uint32_t sample = 0; sample < samples; sample += kSamplesPerDispatch) {
    PassConstants constants;
    constants.first_sample = first + sample;
    constants.sample_count = std::min(kSamplesPerDispatch, samples - sample);
    constants.radius = effect != nullptr ? effect->settings.radius : 0;
    constants.pixel_step = step;
    constants.pixel_offset = offset;
    constants.accumulate = sample > 0 ? 1 : 0;
    // Sorting orders all pixels, so it does not apply at half resolution.
    if (is_sorted && step == 1) {
      if (const auto s = sort_rays(*effect, constants, order_ms); !s) return s.error();
      constants.sorted = 1;
    }
    for (std::uint32_t row = 0; row < height;) {
      const std::uint32_t count = std::min(rows, height - row);
      constants.first_row = row;
      if (const auto reset = list->Reset(); !reset) return reset.error();
      pass.dispatch(*list, frame_, constants, count, words);
      const double before = clock_ms_();
      const auto done = execute_band_ ? execute_band_(queue_, *list, title, row, count)
                                      : queue_.ExecuteAndWait(*list);
      if (!done) return done.error();
      row += count;
      if (settings_.rows == 0) {
        const double ms = std::max(clock_ms_() - before, 0.1);
        const double fit = rows * std::clamp(kDispatchMs / ms, 0.5, 2.0);
        rows = static_cast<std::uint32_t>(std::clamp(fit, 1.0, static_cast<double>(height)));
      }
      const double done_rows = static_cast<double>(row) / height;
      const double part = (sample + constants.sample_count * done_rows) / samples;
      if (progress && !progress(title, part)) return Outcome::kStopped;
    }
  }
  const double ms = clock_ms_() - start;
  if (is_sorted) statistics_.push_back({title + " order", order_ms, {}});
  statistics_.push_back({title, ms - order_ms, device_.GetStatistics()});
  if (effect != nullptr) statistics_.back().bytes = bytes_of(*effect);
  return Outcome::kDone;
}

rtapi::Result<Outcome> FrameRenderer::run_own(Active& effect, const Progress& progress) {
  const EffectSettings& settings = effect.settings;
  const std::uint32_t first = first_sample(settings, moment_.index);
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  device_.ResetStatistics();
  const double start = clock_ms_();
  for (std::uint32_t sample = 0; sample < settings.samples; sample += kSamplesPerDispatch) {
    const std::uint32_t count = std::min(kSamplesPerDispatch, settings.samples - sample);
    if (const auto reset = list->Reset(); !reset) return reset.error();
    record_pass(*list, effect, settings,
                {.first_sample = first + sample,
                 .sample_count = count,
                 .accumulate = sample > 0 ? 1u : 0u});
    if (const auto done = queue_.ExecuteAndWait(*list); !done) return done.error();
    const double part = static_cast<double>(sample + count) / settings.samples;
    if (progress && !progress(effect.title, part)) return Outcome::kStopped;
  }
  statistics_.push_back(
      {effect.title, clock_ms_() - start, device_.GetStatistics(), bytes_of(effect)});
  return Outcome::kDone;
}

rtapi::Result<Outcome> FrameRenderer::run_effect(Active& effect, const Progress& progress) {
  if (effect.own) return run_own(effect, progress);
  const auto done = run_pass(effect.title, effect.pass, &effect, progress);
  if (!is_done(done)) return done;
  if (const auto s = repeat_samples(effect); !s) return s.error();
  return done;
}

std::uint64_t FrameRenderer::bytes_of(const Active& effect) const {
  std::uint64_t sum = effect.views ? effect.views->bytes() : 0;
  if (effect.own) sum += effect.own->bytes();
  for (std::size_t i = 0; i < effect.pictures.size(); ++i) {
    if (effect.row->signals[i].picture) sum += picture_bytes(effect.pictures[i]);
  }
  return sum;
}

rtapi::Result<double> FrameRenderer::execute(
    const std::function<void(rtapi::CommandList&)>& record) {
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  record(*list);
  const double start = clock_ms_();
  if (const auto done = queue_.ExecuteAndWait(*list); !done) return done.error();
  return clock_ms_() - start;
}

rtapi::Status FrameRenderer::run_compute(const std::string& name, std::uint64_t bytes,
                                         const std::function<void(rtapi::CommandList&)>& record) {
  auto list = device_.CreateCommandList();
  if (!list) return list.error();
  device_.ResetStatistics();
  const double start = clock_ms_();
  record(*list);
  if (const auto done = queue_.ExecuteAndWait(*list); !done) return done;
  statistics_.push_back({name, clock_ms_() - start, device_.GetStatistics(), bytes});
  return {};
}

void FrameRenderer::record_curvature(rtapi::CommandList& list) const {
  if (curvature_) curvature_->dispatch(list, frame_, {}, {}, frame_.width(), frame_.height());
}

void FrameRenderer::record_lights(rtapi::CommandList& list) {
  lighting_->see(moment_.camera.position());
  lighting_->update(list, frame_);
  if (direct_) direct_->dispatch(list, frame_, has_strongest_effect(), settings_.light_culling);
}

void FrameRenderer::record_strongest_lights(rtapi::CommandList& list) const {
  if (has_strongest_effect()) direct_->add_strongest(list, frame_, settings_.contact);
}

void FrameRenderer::record_compose(rtapi::CommandList& list) const {
  if (!compose_) {
    CompositeConstants weights;
    for (const auto& effect : active_) {
      for (const EffectSignal& signal : effect->row->signals) {
        if (signal.picture == kAmbientOcclusionSum) weights.ao_samples = effect->samples;
        if (signal.picture == kSunVisibilitySum) weights.sun_samples = effect->samples;
      }
    }
    composite_.dispatch(list, frame_, weights);
    return;
  }
  record_strongest_lights(list);
  compose_->dispatch(list, frame_);
  for (const auto& effect : active_) {
    if (!effect->compose) continue;
    effect->compose->dispatch(list, frame_, {}, arguments(*effect, effect->settings),
                              frame_.width(), frame_.height());
  }
  if (kept_) kept_->record(list, frame_);
}

std::uint64_t FrameRenderer::compose_bytes() const {
  std::uint64_t sum = picture_bytes(frame_.texture(kRadiance));
  if (compose_) sum += compose_->bytes();
  for (const auto& effect : active_) {
    if (compose_ && !effect->compose) continue;
    for (const rtapi::Texture& picture : effect->pictures) sum += picture_bytes(picture);
  }
  return sum;
}

rtapi::Result<Outcome> FrameRenderer::finish_whole(const Progress& progress) {
  const std::uint64_t light_bytes = direct_ ? direct_->bytes() : lighting_->bytes();
  if (const auto s =
          run_compute("local lights", light_bytes, [&](auto& list) { record_lights(list); });
      !s) {
    return s.error();
  }
  if (const auto s = run_effects(false, progress); !is_done(s)) return s;
  if (!compose_unreflected_) return Outcome::kDone;
  if (const auto s = run_compute("composite without reflections", compose_unreflected_->bytes(),
                                 [&](auto& list) { record_unreflected(list); });
      !s) {
    return s.error();
  }
  return run_effects(true, progress);
}

rtapi::Result<Outcome> FrameRenderer::run_effects(bool late, const Progress& progress) {
  for (const auto& effect : active_) {
    if (!has_passes(*effect->row) || comes_first(*effect) || is_late(*effect) != late) continue;
    const auto s = run_effect(*effect, progress);
    if (!is_done(s)) return s;
  }
  if (!late) {
    if (const auto s = finish_gradients(); !s) return s.error();
  }
  for (SignalFilters::Filter& filter : filters_.filters()) {
    if (filter.is_late != late) continue;
    const auto s = run_compute(filter.name, filter.bytes(),
                               [&](auto& list) { filters_.record(list, frame_, filter); });
    if (!s) return s.error();
  }
  return Outcome::kDone;
}

rtapi::Result<Outcome> FrameRenderer::render(const Progress& progress) {
  if (const auto s = prepare(progress); !is_done(s)) return s;
  if (!has_begun_) statistics_.clear();
  has_begun_ = false;
  if (settings_.whole_frame) {
    gpu_volume_.set_origin(moment_.camera.position());
    filters_.set_pixel_offset(rotating_offset(moment_.index));
    if (moment_.cut) filters_.reset();
    if (moment_.cut && kept_) {
      if (const auto s = forget_radiance(); !s) return s.error();
    }
  }
  for (const auto& effect : active_) set_samples(*effect, effect->settings.samples);
  if (const auto s = run_gbuffer(progress); !is_done(s)) return s;
  if (curvature_) {
    const std::uint64_t bytes = picture_bytes(frame_.texture(kShadingNormal)) +
                                picture_bytes(frame_.texture(kIds)) +
                                picture_bytes(frame_.texture(kMaterial));
    const auto s = run_compute("curvature", bytes, [&](auto& list) { record_curvature(list); });
    if (!s) return s.error();
  }
  if (const auto s = begin_gradients(); !s) return s.error();
  for (const auto& effect : active_) {
    if (!comes_first(*effect)) continue;
    const auto s = run_effect(*effect, progress);
    if (!is_done(s)) return s;
  }
  if (settings_.whole_frame) {
    if (const auto s = finish_whole(progress); !is_done(s)) return s;
  }
  has_surfaces_ = has_effects_ = true;
  if (const auto s =
          run_compute("composite", compose_bytes(), [&](auto& list) { record_compose(list); });
      !s) {
    return s.error();
  }
  if (!taa_) return Outcome::kDone;
  if (const auto s =
          run_compute("taa", taa_->bytes(), [&](auto& list) { taa_->dispatch(list, frame_); });
      !s) {
    return s.error();
  }
  return Outcome::kDone;
}

}  // namespace kaamos::effects

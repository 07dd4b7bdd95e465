// SPDX-License-Identifier: MIT
#include "effects/measure/study/sweep_lag.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "effects/measure/run/failure.h"
#include "effects/measure/study/moving_box.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr const char* kSignal = "indirect";  // of gi
constexpr std::uint32_t kLookedAt = 8;       // frames behind the change
constexpr double kMuch = 0.25;  // of the largest change: pixels that change as much are looked at

struct Subject {
  MeasuredDenoiser denoiser;
  SignalFilters filters;
  std::vector<double> ms;
  std::vector<FloatImage> shown;  // from the last frame before the change on
};

FloatImage three_channels(const FloatImage& image) {
  FloatImage out(image.width, image.height, 3);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = image.values[i / 3 * image.channels + i % 3];
  }
  return out;
}

void add_to_mean(const FloatImage& image, std::uint32_t count, FloatImage& mean) {
  if (mean.values.empty()) mean = FloatImage(image.width, image.height, image.channels);
  for (std::size_t i = 0; i < mean.values.size(); ++i) {
    mean.values[i] += image.values[i] / static_cast<float>(count);
  }
}

class LagStudy {
 public:
  LagStudy(LagCause cause, const Options& options, const Scene& scene, const Progress& progress)
      : cause_(cause), options_(options), scene_(scene), progress_(progress) {}

  rtapi::Result<Outcome> run() {
    options_.frame.moving = true;
    options_.frame.denoise = default_denoise(DenoiseMethod::kAdaptiveSvgf);  // makes gradients
    const double seconds = kFramesBefore / options_.frames_per_second;
    if (cause_ == LagCause::kMove) scene_ = with_box_until(std::move(scene_), seconds);
    const auto created = EffectRuns::create(
        options_, scene_, {"gi"}, options_.out + "/measure-cache", progress_, options_.say, runs_);
    if (!is_done(created)) return created;
    if (const auto s = create_subjects(); !s) return s.error();
    for (std::uint32_t frame = 0; frame < kFramesBefore + kFramesBehind; ++frame) {
      if (frame == kFramesBefore && cause_ == LagCause::kSwitch) switch_off();
      if (const auto s = run_frame(frame); !is_done(s)) return s;
      const double done = (frame + 1.0) / (kFramesBefore + kFramesBehind);
      if (!progress_("lag", done)) return Outcome::kStopped;
    }
    return find_mask();
  }

  rtapi::Status add_rows(MeasuredTable& table, const LookAt& look_at) const {
    for (const Subject& subject : subjects_) {
      if (const auto s = add_row(subject, table, look_at); !s) return s;
    }
    return {};
  }

 private:
  rtapi::Status create_subjects() {
    FrameRenderer& renderer = runs_->renderer();
    const auto libraries = denoise_libraries();
    if (!libraries) return libraries.error();
    for (const MeasuredDenoiser& denoiser : lagging_denoisers()) {
      Subject& subject = subjects_.emplace_back();
      subject.denoiser = denoiser;
      if (const auto s = renderer.filters().add_signal(subject.filters, kSignal); !s) return s;
      const auto made =
          subject.filters.create(renderer.device(), renderer.frame(), *libraries, denoiser.desc);
      if (!made) return made;
    }
    return {};
  }

  // The renderer looks at the lights of the scene in each frame.
  void switch_off() {
    if (scene_.sun) scene_.sun->irradiance = glm::vec3(0);
    for (Light& light : scene_.lights) light.intensity = 0;
  }

  rtapi::Result<Outcome> run_frame(std::uint32_t frame) {
    FrameRenderer& renderer = runs_->renderer();
    const auto begun = renderer.begin_frame({.index = frame,
                                             .seconds = frame / options_.frames_per_second,
                                             .camera = scene_.cameras.front(),
                                             .cut = frame == 0});
    if (!begun) return begun.error();
    if (const auto s = renderer.render(); !is_done(s)) return s;
    const auto raw = renderer.read(kSignal);
    if (!raw) return raw.error();
    const bool is_behind = frame >= kFramesBefore;
    // The half before which histories have settled and the half behind which light has.
    if (frame < kFramesBefore) add_to_mean(three_channels(*raw), kFramesBefore, before_);
    if (is_behind) add_to_mean(three_channels(*raw), kFramesBehind, behind_);
    double frame_ms = 0;
    for (const PassStatistics& pass : renderer.runner().passes()) {
      if (!pass.is_gradient) frame_ms += pass.ms;
    }
    for (Subject& subject : subjects_) {
      if (frame == 0) subject.filters.reset();
      const auto took = renderer.runner().execute(
          [&](rtapi::CommandList& list) { subject.filters.record_all(list, renderer.frame()); });
      if (!took) return took.error();
      subject.ms.push_back(frame_ms + *took);
      if (frame + 1 < kFramesBefore) continue;
      const auto shown = renderer.read(subject.filters.denoised(*subject.filters.find(kSignal)));
      if (!shown) return shown.error();
      subject.shown.push_back(three_channels(*shown));
    }
    if (frame + 1 == kFramesBefore) {
      const auto ids = renderer.read("ids");
      if (!ids) return ids.error();
      ids_before_ = *ids;
    }
    return Outcome::kDone;
  }

  // Pixels of the same surface before and behind that change much.
  rtapi::Result<Outcome> find_mask() {
    const auto ids = runs_->renderer().read("ids");
    if (!ids) return ids.error();
    const std::size_t pixels = std::size_t{ids->width} * ids->height;
    std::vector<double> changes(pixels);
    double most = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      const float id = ids->values[i * ids->channels];
      if (id == 0 || id != ids_before_.values[i * ids->channels]) continue;
      changes[i] = std::abs(luminance(before_, i) - luminance(behind_, i));
      most = std::max(most, changes[i]);
    }
    if (!(most > 0)) return failure("nothing in the picture changes");
    target_.mask.assign(pixels, 0);
    // A light that goes out changes all pixels, some of them more by chance.
    const double least = cause_ == LagCause::kSwitch ? 1e-6 * most : kMuch * most;
    for (std::size_t i = 0; i < pixels; ++i) target_.mask[i] = changes[i] >= least ? 1 : 0;
    target_.image = behind_;
    target_.exposure = scene_.exposure;
    return Outcome::kDone;
  }

  static double luminance(const FloatImage& image, std::size_t pixel) {
    const float* c = &image.values[3 * pixel];
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
  }

  // The part of the change that a picture still lacks.
  double left(const FloatImage& shown) const {
    double whole = 0, missing = 0;
    for (std::size_t i = 0; i < target_.mask.size(); ++i) {
      if (target_.mask[i] == 0) continue;
      const double sign = luminance(before_, i) < luminance(behind_, i) ? -1 : 1;
      whole += sign * (luminance(before_, i) - luminance(behind_, i));
      missing += sign * (luminance(shown, i) - luminance(behind_, i));
    }
    return missing / whole;
  }

  rtapi::Status add_row(const Subject& subject, MeasuredTable& table, const LookAt& look_at) const {
    const std::string& label = subject.denoiser.label;
    const std::size_t comma = label.find(", ");
    MeasuredRow row{comma == std::string::npos ? "filters" : label.substr(0, comma),
                    comma == std::string::npos ? label : label.substr(comma + 2), kSignal};
    row.rays = 1;
    row.traced = 1;
    row.ms = median(subject.ms);
    row.ms_min = *std::min_element(subject.ms.begin(), subject.ms.end());
    row.ms_max = *std::max_element(subject.ms.begin(), subject.ms.end());
    // shown[0] is the last frame before the change.
    std::uint32_t frames = 1;
    while (frames <= kFramesBehind && left(subject.shown[frames]) >= 0.1) ++frames;
    double settled = 0, right = 0;
    for (std::size_t i = 0; i < target_.mask.size(); ++i) {
      if (target_.mask[i] == 0) continue;
      settled += luminance(subject.shown[0], i);
      right += luminance(before_, i);
    }
    row.also = {{"energy before", settled / right},
                {"frames to 10 %", frames},
                {"left, 8 frames %", 100 * left(subject.shown[kLookedAt])},
                {"left, end %", 100 * left(subject.shown.back())}};
    Errors errors;
    if (const auto error = errors.add(subject.shown[kLookedAt], target_); !error.empty()) {
      return failure(error);
    }
    row.errors = errors.summary(target_);
    table.rows.push_back(row);
    return look_at(table.rows.size() - 1, subject.shown[kLookedAt], target_, nullptr);
  }

  LagCause cause_;
  Options options_;
  Scene scene_;
  const Progress& progress_;
  std::unique_ptr<EffectRuns> runs_;
  std::vector<Subject> subjects_;
  FloatImage before_, behind_, ids_before_;  // means over frames
  Target target_;
};

}  // namespace

std::vector<MeasuredDenoiser> lagging_denoisers() {
  std::vector<MeasuredDenoiser> out;
  for (const bool half : {false, true}) {
    for (const float weight : {1.0f, 0.5f, 0.2f, 0.1f, 0.05f, 0.02f}) {
      if (half && weight > 0.2f) continue;
      MeasuredDenoiser each{fmt::format("accumulation{}, new frames weigh {:g}",
                                        half ? " in half floats" : "", weight),
                            default_denoise(DenoiseMethod::kTemporal)};
      each.desc.constants.alpha = each.desc.constants.moments_alpha = weight;
      each.desc.constants.max_history = 255;
      each.desc.constants.clip_gamma = 0;  // weights alone
      each.desc.half_history = half ? 1 : 0;
      out.push_back(each);
    }
  }
  for (const auto& [label, method] :
       {std::pair("svgf", DenoiseMethod::kSvgf), std::pair("a-svgf", DenoiseMethod::kAdaptiveSvgf),
        std::pair("control", DenoiseMethod::kControl)}) {
    out.push_back({label, default_denoise(method)});
  }
  return out;
}

rtapi::Result<Outcome> measure_lag(LagCause cause, const Options& options, const Scene& scene,
                                   const Progress& progress, MeasuredTable& table,
                                   const LookAt& look_at) {
  LagStudy lag(cause, options, scene, progress);
  if (const auto s = lag.run(); !is_done(s)) return s;
  table.subtitle = fmt::format(
      "{}; indirect light of 1 ray; {} frames before the change, {} from "
      "it on{}",
      scene_text(options), kFramesBefore, kFramesBehind,
      options.cpu_clock ? ", CPU time over threads" : "");
  if (const auto s = lag.add_rows(table, look_at); !s) return s.error();
  return Outcome::kDone;
}

}  // namespace kaamos::measure

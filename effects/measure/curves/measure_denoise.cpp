// SPDX-License-Identifier: MIT
// northlight --measure svgf: every denoiser on every signal of the frame, with the camera at rest
// and on its path, bias and variance separated.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "effects/assets/common/sampling.h"
#include "effects/assets/image/metrics.h"
#include "effects/measure/curves/measure.h"
#include "effects/measure/errors/measure_reference.h"
#include "effects/measure/run/camera_choice.h"
#include "effects/measure/run/failure.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

// Frames of each sequence; histories need some of them to settle.
constexpr std::uint32_t kFrames = 8;

// The errors of one method at one frame of a sequence.
struct Place {
  std::vector<double> ms;
  Errors errors;
  double flicker = 0;
  std::uint32_t flicker_count = 0;
  FloatImage image;  // of the last seed
};

struct Subject {
  std::string label;
  std::unique_ptr<SignalFilters> filters;  // null: the signals as they are
  bool needs_gradients = false;
  std::map<std::string, Place> first, last;  // by signal
  std::map<std::string, FloatImage> before;  // the second last frame, by signal
};

// A signal that is compared in the frames of the sequence.
struct MeasuredSignal {
  std::string name;  // of its layer
  Setting setting;
  std::uint32_t channels = 1;
  float exposure = 0;
};

// A sequence of frames, all denoisers over it, and what each signal converges to in its first and
// in its last frame.
class Motion {
 public:
  Motion(EffectRuns& runs, const Options& options, const std::vector<MeasuredDenoiser>& denoisers,
         const CameraPath& path, bool is_still)
      : runs_(runs),
        renderer_(runs.renderer()),
        options_(options),
        denoisers_(denoisers),
        path_(path),
        is_still_(is_still) {}

  std::string name() const {
    if (is_still_) return "still";
    return path_.name == "still" ? "in motion" : path_.name;
  }
  rtapi::Result<Outcome> create(const std::vector<MeasuredSignal>& signals,
                                const Progress& progress);
  rtapi::Result<Outcome> measure(const Progress& progress);
  rtapi::Status add_rows(MeasuredTable& table, const LookAt& look_at) const;

 private:
  FrameMoment moment(std::uint32_t frame) const;
  rtapi::Result<Outcome> render(std::uint32_t frame);
  rtapi::Status create_subject(const MeasuredDenoiser& denoiser);
  rtapi::Result<FloatImage> read(const Subject& subject, const MeasuredSignal& signal);
  rtapi::Status look(Subject& subject, std::uint32_t frame, double ms);
  rtapi::Status run_frame(std::uint32_t frame);
  rtapi::Status add_row(const MeasuredSignal& signal, const Subject& subject, bool is_last,
                        MeasuredTable& table, const LookAt& look_at) const;
  void add_summary(const MeasuredSignal& signal, bool is_last, MeasuredTable& table) const;

  EffectRuns& runs_;
  FrameRenderer& renderer_;
  const Options& options_;
  const std::vector<MeasuredDenoiser>& denoisers_;
  const CameraPath& path_;
  bool is_still_;
  std::vector<MeasuredSignal> signals_;
  std::map<std::string, Target> first_targets_, last_targets_;  // by signal
  std::vector<Subject> subjects_;
};

FrameMoment Motion::moment(std::uint32_t frame) const {
  FrameMoment out;
  out.index = frame;
  out.seconds = is_still_ ? 0 : frame / options_.frames_per_second;
  out.camera = evaluate_camera(path_, renderer_.context().scene.cameras.front(), out.seconds);
  out.cut = frame == 0;
  return out;
}

rtapi::Result<Outcome> Motion::render(std::uint32_t frame) {
  if (const auto s = renderer_.begin_frame(moment(frame)); !s) return s.error();
  return renderer_.render();
}

rtapi::Result<Outcome> Motion::create(const std::vector<MeasuredSignal>& signals,
                                      const Progress& progress) {
  signals_ = signals;
  for (const bool is_last : {false, true}) {
    if (is_last && is_still_) {
      last_targets_ = first_targets_;
      continue;
    }
    if (const auto s = render(is_last ? kFrames - 1 : 0); !is_done(s)) return s;
    for (const MeasuredSignal& signal : signals_) {
      Target target;
      const auto made =
          make_reference(runs_, signal.setting, options_.measure_reference,
                         fmt::format("{}-{}-{}", signal.name, name(), is_last ? kFrames : 1),
                         options_.out + "/measure-cache", progress, target);
      if (!is_done(made)) return made;
      target.exposure = signal.exposure;
      (is_last ? last_targets_ : first_targets_)[signal.name] = std::move(target);
    }
  }
  subjects_.push_back({.label = "raw"});
  for (const MeasuredDenoiser& denoiser : denoisers_) {
    if (const auto s = create_subject(denoiser); !s) return s.error();
  }
  return Outcome::kDone;
}

rtapi::Status Motion::create_subject(const MeasuredDenoiser& denoiser) {
  Subject subject{.label = denoiser.label,
                  .filters = std::make_unique<SignalFilters>(),
                  .needs_gradients = denoiser.desc.method == DenoiseMethod::kAdaptiveSvgf};
  for (const MeasuredSignal& signal : signals_) {
    if (const auto s = renderer_.filters().add_signal(*subject.filters, signal.name); !s) return s;
  }
  const auto libraries = denoise_libraries();
  if (!libraries) return libraries.error();
  const auto created =
      subject.filters->create(renderer_.device(), renderer_.frame(), *libraries, denoiser.desc);
  if (!created) return created;
  subjects_.push_back(std::move(subject));
  return {};
}

rtapi::Result<FloatImage> Motion::read(const Subject& subject, const MeasuredSignal& signal) {
  if (!subject.filters) return runs_.read(signal.setting);
  const auto image = renderer_.read(subject.filters->denoised(*subject.filters->find(signal.name)));
  if (!image) return image.error();
  FloatImage out(image->width, image->height, signal.channels);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = image->values[i / signal.channels * image->channels + i % signal.channels];
  }
  return out;
}

// Compares what the subject shows in this frame. Frames that nobody compares are only passed by.
rtapi::Status Motion::look(Subject& subject, std::uint32_t frame, double ms) {
  const bool is_last = frame + 1 == kFrames;
  if (frame != 0 && frame + 2 < kFrames) return {};
  for (const MeasuredSignal& signal : signals_) {
    const auto image = read(subject, signal);
    if (!image) return image.error();
    if (frame + 2 == kFrames) subject.before[signal.name] = *image;
    if (frame != 0 && !is_last) continue;
    Place& place = (is_last ? subject.last : subject.first)[signal.name];
    const Target& target = (is_last ? last_targets_ : first_targets_).at(signal.name);
    place.ms.push_back(ms);
    if (const auto error = place.errors.add(*image, target); !error.empty()) return failure(error);
    place.image = *image;
    if (!is_last || !is_still_) continue;
    const auto change = flicker(subject.before[signal.name], *image, target.image, target.image);
    if (!change.ok()) return change.error();
    place.flicker += change.value();
    ++place.flicker_count;
  }
  return {};
}

rtapi::Status Motion::run_frame(std::uint32_t frame) {
  if (const auto s = render(frame); !is_done(s)) return s.error();
  double frame_ms = 0, gradients_ms = 0;
  for (const PassStatistics& pass : renderer_.runner().passes()) {
    (pass.is_gradient ? gradients_ms : frame_ms) += pass.ms;
  }
  for (Subject& subject : subjects_) {
    double ms = frame_ms + (subject.needs_gradients ? gradients_ms : 0);
    if (subject.filters) {
      if (frame == 0) subject.filters->reset();
      const auto took = renderer_.runner().execute(
          [&](rtapi::CommandList& list) { subject.filters->record_all(list, renderer_.frame()); });
      if (!took) return took.error();
      ms += *took;
    }
    if (const auto s = look(subject, frame, ms); !s) return s;
  }
  return {};
}

rtapi::Result<Outcome> Motion::measure(const Progress& progress) {
  for (std::uint32_t seed = 0; seed < options_.seeds; ++seed) {
    if (const auto s = renderer_.set_seed(pcg_hash(options_.frame.seed + seed)); !s) {
      return s.error();
    }
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
      if (const auto s = run_frame(frame); !s) return s.error();
      const double done = (seed + (frame + 1.0) / kFrames) / options_.seeds;
      if (!progress("denoising " + name(), done)) return Outcome::kStopped;
    }
  }
  return Outcome::kDone;
}

rtapi::Status Motion::add_row(const MeasuredSignal& signal, const Subject& subject, bool is_last,
                              MeasuredTable& table, const LookAt& look_at) const {
  const Place& place = (is_last ? subject.last : subject.first).at(signal.name);
  const Target& target = (is_last ? last_targets_ : first_targets_).at(signal.name);
  MeasuredRow row{fmt::format("{}, {}, frame {}", signal.name, name(), is_last ? kFrames : 1),
                  subject.label, signal.name};
  row.rays = signal.setting.settings.samples;
  row.traced = row.rays;
  row.ms = median(place.ms);
  row.ms_min = *std::min_element(place.ms.begin(), place.ms.end());
  row.ms_max = *std::max_element(place.ms.begin(), place.ms.end());
  const Place& raw = (is_last ? subjects_[0].last : subjects_[0].first).at(signal.name);
  row.filter_ms = std::max(0.0, row.ms - median(raw.ms));
  row.errors = place.errors.summary(target);
  row.reference_rmse = target.own_rmse;
  if (place.flicker_count > 0) row.flicker = place.flicker / place.flicker_count;
  row.steps = false;
  table.rows.push_back(row);
  return look_at ? look_at(table.rows.size() - 1, place.image, target, nullptr) : rtapi::Status();
}

// A line of RMSE of all methods but those of other numbers of passes.
void Motion::add_summary(const MeasuredSignal& signal, bool is_last, MeasuredTable& table) const {
  if (table.summary.empty()) {
    table.summary = fmt::format("\n{:<30}", "RMSE");
    for (std::size_t i = 0; i < subjects_.size(); ++i) {
      if (i > 0 && denoisers_[i - 1].is_step) continue;
      table.summary += fmt::format("{:>11}", subjects_[i].label);
    }
    table.summary += "\n";
  }
  table.summary += fmt::format(
      "{:<30}", fmt::format("{}, {}, frame {}", signal.name, name(), is_last ? kFrames : 1));
  for (std::size_t i = 0; i < subjects_.size(); ++i) {
    if (i > 0 && denoisers_[i - 1].is_step) continue;
    const Place& place = (is_last ? subjects_[i].last : subjects_[i].first).at(signal.name);
    const Target& target = (is_last ? last_targets_ : first_targets_).at(signal.name);
    table.summary += fmt::format("{:>11.4f}", place.errors.summary(target).rmse);
  }
  table.summary += "\n";
}

rtapi::Status Motion::add_rows(MeasuredTable& table, const LookAt& look_at) const {
  for (const MeasuredSignal& signal : signals_) {
    // The first frame of a path is as good as that of a camera at rest.
    for (const bool is_last : {false, true}) {
      if (!is_last && !is_still_) continue;
      for (const Subject& subject : subjects_) {
        if (const auto s = add_row(signal, subject, is_last, table, look_at); !s) return s;
      }
      add_summary(signal, is_last, table);
      const Target& target = (is_last ? last_targets_ : first_targets_).at(signal.name);
      if (is_last && is_still_) continue;  // it is that of the first frame
      table.about.push_back(
          fmt::format("reference {}, {}, frame {}: {} samples, its own RMSE {:.2g}", signal.name,
                      name(), is_last ? kFrames : 1, options_.measure_reference, target.own_rmse));
    }
  }
  return {};
}

// The signals of the chosen effects that a denoiser has work with.
std::vector<MeasuredSignal> measured_signals(const Options& options, const Scene& scene,
                                             const FrameRenderer& renderer) {
  std::vector<MeasuredSignal> out;
  for (const Effect& effect : renderer.context().effects) {
    if (!effect.pass || !renderer.effects().renders(effect.name)) continue;
    const EffectSignal& signal = effect.signals.front();
    if (!signal.is_sum) continue;
    EffectSettings settings = options.effects.at(effect.name);
    settings.pixel_step = 1;
    out.push_back({.name = signal.name,
                   .setting = {.effect = effect.name, .settings = settings},
                   .channels = signal.channels,
                   .exposure = signal.channels == 3 ? scene.exposure : 0.0f});
  }
  return out;
}

MeasuredDenoiser svgf_with(const char* label, std::uint32_t passes) {
  MeasuredDenoiser out{label, default_denoise(DenoiseMethod::kSvgf), true};
  out.desc.iterations = out.desc.iterations_with_history = passes;
  return out;
}

}  // namespace

std::pair<std::string, std::string> denoiser_names(const std::string& label) {
  const std::size_t comma = label.find(", ");
  if (comma == std::string::npos) return {label, "as it is by default"};
  return {label.substr(0, comma) + " by passes", label.substr(comma + 2)};
}

std::vector<MeasuredDenoiser> measured_denoisers() {
  std::vector<MeasuredDenoiser> out;
  for (const auto& [label, method] :
       {std::pair("gaussian", DenoiseMethod::kGaussian),
        std::pair("bilateral", DenoiseMethod::kBilateral),
        std::pair("temporal", DenoiseMethod::kTemporal), std::pair("svgf", DenoiseMethod::kSvgf),
        std::pair("control", DenoiseMethod::kControl),
        std::pair("a-svgf", DenoiseMethod::kAdaptiveSvgf)}) {
    out.push_back({label, default_denoise(method)});
    DenoiseDesc& desc = out.back().desc;
    desc.iterations = 5;
    desc.iterations_with_history = method == DenoiseMethod::kAdaptiveSvgf ? 5 : 3;
  }
  for (const auto& [label, passes] :
       {std::pair("svgf, 0 passes", 0u), std::pair("svgf, 1 pass", 1u),
        std::pair("svgf, 3 passes", 3u), std::pair("svgf, 5 passes", 5u)}) {
    out.push_back(svgf_with(label, passes));
  }
  return out;
}

rtapi::Result<Outcome> measure_denoisers(const Options& options, const Scene& scene,
                                         const Progress& progress, MeasuredTable& table,
                                         const LookAt& look_at,
                                         const std::vector<MeasuredDenoiser>& denoisers) {
  std::vector<std::string> effects;
  for (const auto& [name, ignored] : options.frame.effects) effects.push_back(name);
  const auto path = choose_path(options, scene);
  if (!path.ok()) return path.error();
  Options own = options;
  own.frame.moving = true;
  own.frame.denoise = default_denoise(DenoiseMethod::kAdaptiveSvgf);  // so that there are gradients
  std::unique_ptr<EffectRuns> runs;
  const auto created = EffectRuns::create(own, scene, effects, options.out + "/measure-cache",
                                          progress, options.say, runs);
  if (!is_done(created)) return created;
  const auto signals = measured_signals(options, scene, runs->renderer());
  if (signals.empty()) return failure("no chosen effect has a signal that is denoised");
  table.title = "Denoisers: error beside that of the raw signals";
  table.subtitle =
      fmt::format("{}, {} x {}, {}; {} seeds, {} frames each, path {}{}", options.scene,
                  options.frame.width, options.frame.height, options.backend, options.seeds,
                  kFrames, path.value().name, options.cpu_clock ? ", CPU time over threads" : "");
  for (const bool is_still : {true, false}) {
    Motion motion(*runs, options, denoisers, path.value(), is_still);
    if (const auto s = motion.create(signals, progress); !is_done(s)) return s;
    if (const auto s = motion.measure(progress); !is_done(s)) return s;
    if (const auto s = motion.add_rows(table, look_at); !s) return s.error();
  }
  return Outcome::kDone;
}

}  // namespace kaamos::measure

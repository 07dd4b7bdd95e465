// SPDX-License-Identifier: MIT
// northlight --measure svgf: denoisers, with bias and variance separated. [effects-spec B0.6]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "effects/common/sampling.h"
#include "effects/denoise/denoise.h"
#include "effects/frame/picture.h"
#include "effects/image/metrics.h"
#include "measure.h"
#include "measure_reference.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

// Frames of a camera at rest; the history needs some of them to settle.
constexpr std::uint32_t kFrames = 8;

rtapi::Error failure(const std::string& text) {
  return {{}, rtapi::ErrorCode::kFailed, text};
}

struct Method {
  const char* group;
  const char* label;
  DenoiseMethod method;
  std::uint32_t iterations = 5;
  std::uint32_t iterations_with_history = iterations;
};

constexpr Method kMethods[] = {{"in space", "gaussian", DenoiseMethod::kGaussian},
                               {"in space", "bilateral", DenoiseMethod::kBilateral},
                               {"svgf by iterations", "0", DenoiseMethod::kSvgf, 0},
                               {"svgf by iterations", "1", DenoiseMethod::kSvgf, 1},
                               {"svgf by iterations", "2", DenoiseMethod::kSvgf, 2},
                               {"svgf by iterations", "3", DenoiseMethod::kSvgf, 3},
                               {"svgf by iterations", "4", DenoiseMethod::kSvgf, 4},
                               {"svgf by iterations", "5", DenoiseMethod::kSvgf, 5},
                               {"svgf by iterations", "5, then 3", DenoiseMethod::kSvgf, 5, 3}};

// The errors of one method at one frame of the sequence.
struct Place {
  std::vector<double> ms;
  Errors errors;
  double flicker = 0;
  std::uint32_t flicker_count = 0;
};

struct Subject {
  const Method* method = nullptr;
  Denoiser denoiser;
  Place first, last;
  FloatImage before;  // the second last frame
};

// A signal and its denoisers, which all see the same frames.
class Signal {
 public:
  Signal(EffectRuns& runs, const Options& options)
      : runs_(runs), renderer_(runs.renderer()), options_(options) {}

  rtapi::Result<Outcome> create(const std::string& name, const Setting& setting, float exposure,
                                const Progress& progress);
  rtapi::Result<Outcome> measure(const Progress& progress);
  void add_rows(MeasuredTable& table) const;

 private:
  rtapi::Status create_subject(const Method& method, const DenoiseLibraries& libraries);
  rtapi::Result<FloatImage> read(const rtapi::Texture& picture) const;
  rtapi::Status add(const FloatImage& image, Place& place);
  rtapi::Status run_frame(std::uint32_t frame);
  rtapi::Status run_subject(Subject& subject, std::uint32_t frame, double trace_ms);
  rtapi::Status run_raw();
  void add_row(const std::string& group, const std::string& label, const Place& place,
               std::uint32_t rays, double trace_ms, MeasuredTable& table) const;

  EffectRuns& runs_;
  FrameRenderer& renderer_;
  const Options& options_;
  std::string name_;
  Setting setting_;
  Target target_;
  rtapi::Texture mean_;
  std::vector<Subject> subjects_;
  std::vector<std::pair<std::uint32_t, Place>> raw_;  // by number of rays
  std::vector<double> trace_ms_;
};

rtapi::Result<Outcome> Signal::create(const std::string& name, const Setting& setting,
                                      float exposure, const Progress& progress) {
  name_ = name;
  setting_ = setting;
  const auto made = make_reference(runs_, setting, options_.measure_reference, name,
                                   options_.out + "/measure-cache", progress, target_);
  if (!is_done(made)) return made;
  target_.exposure = exposure;
  const auto mean = renderer_.frame().create_picture(renderer_.device(), name + " mean",
                                                     rtapi::Format::kR32G32B32A32Float);
  if (!mean) return mean.error();
  mean_ = *mean;
  const auto libraries = denoise_libraries();
  if (!libraries) return libraries.error();
  for (const Method& method : kMethods) {
    if (const auto s = create_subject(method, *libraries); !s) return s.error();
  }
  for (const std::uint32_t rays : {1u, 4u, 16u, 64u}) raw_.push_back({rays, {}});
  return Outcome::kDone;
}

rtapi::Status Signal::create_subject(const Method& method, const DenoiseLibraries& libraries) {
  const rtapi::Device& device = renderer_.device();
  const Frame& frame = renderer_.frame();
  DenoiseDesc desc = default_denoise(method.method);
  desc.iterations = method.iterations;
  desc.iterations_with_history = method.iterations_with_history;
  auto denoiser =
      Denoiser::create(device, frame, libraries, name_ + " " + method.label, mean_, desc);
  if (!denoiser) return denoiser.error();
  const auto loads = denoiser->create_load(device, frame, libraries, runs_.sum(setting_));
  if (!loads) return loads;
  Subject subject;
  subject.method = &method;
  subject.denoiser = std::move(*denoiser);
  subjects_.push_back(std::move(subject));
  return {};
}

rtapi::Result<FloatImage> Signal::read(const rtapi::Texture& picture) const {
  const auto image = renderer_.read(picture);
  if (!image) return image.error();
  const std::uint32_t channels = target_.image.channels;
  FloatImage out(image->width, image->height, channels);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = image->values[i / channels * image->channels + i % channels];
  }
  return out;
}

rtapi::Status Signal::add(const FloatImage& image, Place& place) {
  const std::string error = place.errors.add(image, target_);
  if (!error.empty()) return failure(error);
  return {};
}

rtapi::Status Signal::run_subject(Subject& subject, std::uint32_t frame, double trace_ms) {
  const bool temporal = subject.method->method == DenoiseMethod::kSvgf;
  const bool looked_at = frame == 0 || frame + 2 >= kFrames;
  if (!temporal && !looked_at) return {};
  const auto loaded = renderer_.execute(
      [&](rtapi::CommandList& list) { subject.denoiser.load(list, renderer_.frame(), 1.0f); });
  if (!loaded) return loaded.error();
  const auto ms = renderer_.execute(
      [&](rtapi::CommandList& list) { subject.denoiser.dispatch(list, renderer_.frame()); });
  if (!ms) return ms.error();
  if (!looked_at) return {};
  const bool last = frame + 1 == kFrames;
  const auto image = read(subject.denoiser.result());
  if (!image) return image.error();
  if (frame + 2 == kFrames) subject.before = *image;
  if (frame == 0 || last) {
    Place& place = frame == 0 ? subject.first : subject.last;
    place.ms.push_back(trace_ms + *ms);
    if (temporal || frame == 0) {
      if (const auto s = add(*image, place); !s) return s;
    }
  }
  if (!last) return {};
  const auto change = flicker(subject.before, *image, target_.image, target_.image);
  if (!change.ok()) return failure(change.error());
  Place& place = temporal ? subject.last : subject.first;
  place.flicker += change.value();
  ++place.flicker_count;
  return {};
}

rtapi::Status Signal::run_frame(std::uint32_t frame) {
  Setting setting = setting_;
  setting.first_sample = frame;  // each frame continues its pixels' sample sequences
  const auto ran = runs_.run(setting);
  if (!ran) return ran.error();
  trace_ms_.push_back(ran->ms);
  for (Subject& subject : subjects_) {
    if (frame == 0) subject.denoiser.reset();
    if (const auto s = run_subject(subject, frame, ran->ms); !s) return s;
  }
  return {};
}

rtapi::Status Signal::run_raw() {
  for (auto& [rays, place] : raw_) {
    Setting setting = setting_;
    setting.settings.samples = rays;
    const auto ran = runs_.run(setting);
    if (!ran) return ran.error();
    const auto image = runs_.read(setting);
    if (!image) return image.error();
    place.ms.push_back(ran->ms);
    if (const auto s = add(*image, place); !s) return s;
  }
  return {};
}

rtapi::Result<Outcome> Signal::measure(const Progress& progress) {
  for (std::uint32_t seed = 0; seed < options_.seeds; ++seed) {
    if (const auto s = runs_.set_seed(pcg_hash(options_.frame.seed + seed)); !s) {
      return s.error();
    }
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
      if (const auto s = run_frame(frame); !s) return s.error();
    }
    if (const auto s = run_raw(); !s) return s.error();
    if (!progress("denoising " + name_, (seed + 1.0) / options_.seeds)) return Outcome::kStopped;
  }
  return Outcome::kDone;
}

void Signal::add_row(const std::string& group, const std::string& label, const Place& place,
                     std::uint32_t rays, double trace_ms, MeasuredTable& table) const {
  MeasuredRow row{name_ + ", " + group, label, name_};
  row.rays = rays;
  row.traced = rays;
  row.ms = median(place.ms);
  row.ms_min = *std::min_element(place.ms.begin(), place.ms.end());
  row.filter_ms = std::max(0.0, row.ms - trace_ms);
  row.errors = place.errors.summary(target_);
  row.reference_rmse = target_.own_rmse;
  if (place.flicker_count > 0) row.flicker = place.flicker / place.flicker_count;
  row.steps = group != "in space";
  table.rows.push_back(row);
}

void Signal::add_rows(MeasuredTable& table) const {
  const double trace_ms = median(trace_ms_);
  for (const auto& [rays, place] : raw_) {
    const std::string label = fmt::format("{} {}", rays, rays == 1 ? "ray" : "rays");
    add_row("raw", label, place, rays, median(place.ms), table);
  }
  for (const Subject& subject : subjects_) {
    add_row(subject.method->group, subject.method->label, subject.first, 1, trace_ms, table);
  }
  for (const Subject& subject : subjects_) {
    if (subject.method->method != DenoiseMethod::kSvgf) continue;
    add_row(fmt::format("svgf by iterations, frame {}", kFrames), subject.method->label,
            subject.last, 1, trace_ms, table);
  }
}

}  // namespace

rtapi::Result<Outcome> measure_denoisers(const Options& options, const Scene& scene,
                                         const Progress& progress, MeasuredTable& table) {
  std::unique_ptr<EffectRuns> runs;
  const auto created = EffectRuns::create(
      options, scene, {"ao", "gi"}, options.out + "/measure-cache", progress,
      [](const std::string& text) { std::fprintf(stderr, "northlight: %s\n", text.c_str()); },
      runs);
  if (!is_done(created)) return created;
  table.title = "Denoising 1 ray per pixel: time against error";
  table.subtitle =
      fmt::format("{}, {} x {}, {}; {} seeds, {} frames each{}", options.scene, options.frame.width,
                  options.frame.height, options.backend, options.seeds, kFrames,
                  options.cpu_clock ? ", CPU time over threads" : "");
  Setting occlusion = setting_of("ao");
  occlusion.settings.radius = options.effects.at("ao").radius;
  const Setting indirect = setting_of("gi");
  struct Entry {
    const char* name;
    Setting setting;
    float exposure;
  };
  for (const Entry& entry : {Entry{"ao", occlusion, 0}, Entry{"gi", indirect, scene.exposure}}) {
    Signal signal(*runs, options);
    if (const auto s = signal.create(entry.name, entry.setting, entry.exposure, progress);
        !is_done(s)) {
      return s;
    }
    if (const auto s = signal.measure(progress); !is_done(s)) return s;
    signal.add_rows(table);
    table.about.push_back(fmt::format("reference {}: {} samples, its own RMSE {:.2g}", entry.name,
                                      options.measure_reference, table.rows.back().reference_rmse));
  }
  return Outcome::kDone;
}

}  // namespace northlight

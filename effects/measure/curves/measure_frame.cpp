// SPDX-License-Identifier: MIT
// northlight --measure frame: the whole frame and its parts against the path-traced truth, raw and
// with each denoiser: the first frame, and the eighth with the camera at rest and on its path.
#include <fmt/format.h>

#include <map>
#include <memory>

#include "effects/assets/built_in/camera_paths.h"
#include "effects/assets/common/sampling.h"
#include "effects/measure/curves/measure.h"
#include "effects/measure/run/failure.h"
#include "effects/measure/run/picture_key.h"
#include "effects/measure/truth/truth.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr std::uint32_t kFrames = 8;

struct Method {
  const char* label;
  DenoiseMethod method;
};
constexpr Method kMethods[] = {{"raw", DenoiseMethod::kNone},
                               {"gaussian", DenoiseMethod::kGaussian},
                               {"bilateral", DenoiseMethod::kBilateral},
                               {"temporal", DenoiseMethod::kTemporal},
                               {"svgf", DenoiseMethod::kSvgf},
                               {"control", DenoiseMethod::kControl}};

// A part of the frame's radiance, and the layers of the truth that it stands for.
struct Part {
  const char* name;
  std::vector<std::string> signals;  // of the frame; empty: all of it
  std::vector<std::string> truth;
};

const std::vector<Part>& frame_parts() {
  static const std::vector<Part> parts = {{"direct", {"sun", "local_lights"}, {"sun", "lamps"}},
                                          {"indirect", {"indirect"}, {"indirect"}},
                                          {"reflection", {"reflection"}, {"reflection"}},
                                          {"whole", {}, {"radiance"}}};
  return parts;
}

// The frames that are compared.
enum Place : std::uint32_t { kFirst, kStill, kMoving, kPlaceCount };
constexpr const char* kPlaceNames[kPlaceCount] = {"first frame", "eighth frame, still",
                                                  "eighth frame, moving"};

struct Record {
  std::vector<double> ms;
  Errors errors;
};

class FrameMeasurement {
 public:
  FrameMeasurement(const Options& options, const Scene& scene, const Progress& progress)
      : options_(options),
        scene_(scene),
        progress_(progress),
        cache_(options.out + "/measure-cache") {}

  rtapi::Result<Outcome> run(MeasuredTable& table);

 private:
  FrameMoment moment(std::uint32_t frame, bool is_moving) const;
  rtapi::Result<Outcome> make_truth(bool is_moving);
  rtapi::Result<Outcome> run_method(std::size_t method);
  rtapi::Result<Outcome> run_sequence(std::size_t method, FrameRenderer& renderer, bool is_moving);
  rtapi::Status compare(std::size_t method, FrameRenderer& renderer, Place place);
  void add_rows(MeasuredTable& table) const;

  const Options& options_;
  const Scene& scene_;
  const Progress& progress_;
  std::string cache_;
  CameraPath path_;
  // By part; still and moving.
  std::map<std::string, Target> truths_[2];
  // By part, method and place.
  std::map<std::string, std::vector<std::vector<Record>>> records_;
};

FrameMoment FrameMeasurement::moment(std::uint32_t frame, bool is_moving) const {
  FrameMoment out;
  out.index = frame;
  out.seconds = is_moving ? frame / options_.frames_per_second : 0;
  out.camera = evaluate_camera(path_, scene_.cameras.front(), out.seconds);
  out.cut = frame == 0;
  return out;
}

rtapi::Result<Outcome> FrameMeasurement::make_truth(bool is_moving) {
  const FrameMoment at = moment(is_moving ? kFrames - 1 : 0, is_moving);
  Scene scene = scene_;
  scene.cameras.front() = at.camera;
  Options options = options_;
  options.seconds = at.seconds;
  PathSums sums;
  const auto traced = trace_truth(options, scene, cache_, progress_, sums);
  if (!is_done(traced)) return traced;
  for (const Part& part : frame_parts()) {
    Target target =
        truth_picture(sums, part.truth, 3, [](std::size_t, const auto& layers, float* out) {
          for (int c = 0; c < 3; ++c) {
            out[c] = 0;
            for (const float* layer : layers) out[c] += layer[c];
          }
          return true;
        });
    target.exposure = scene.exposure;
    truths_[is_moving ? 1 : 0].emplace(part.name, std::move(target));
  }
  return Outcome::kDone;
}

// The frame's radiance by some of its signals, without what the surfaces emit.
rtapi::Result<FloatImage> read_part(FrameRenderer& renderer, const Part& part) {
  const auto image =
      part.signals.empty() ? renderer.read("radiance") : read_composed(renderer, part.signals);
  if (!image) return image.error();
  const auto emissive = renderer.read("emissive");
  if (!emissive) return emissive.error();
  const auto ids = renderer.read("ids");
  if (!ids) return ids.error();
  FloatImage out(image->width, image->height, 3);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    const std::size_t pixel = i / 3, c = i % 3;
    const float value = image->values[pixel * image->channels + c];
    if (part.signals.empty()) {
      out.values[i] = value;
    } else if (ids->values[pixel * ids->channels] != 0) {
      out.values[i] = value - emissive->values[pixel * emissive->channels + c];
    }
  }
  return out;
}

rtapi::Status FrameMeasurement::compare(std::size_t method, FrameRenderer& renderer, Place place) {
  double ms = 0;
  for (const PassStatistics& pass : renderer.runner().passes()) ms += pass.ms;
  // The whole first: composing parts writes over it.
  for (auto part = frame_parts().rbegin(); part != frame_parts().rend(); ++part) {
    const auto image = read_part(renderer, *part);
    if (!image) return image.error();
    Record& record = records_.at(part->name)[method][place];
    record.ms.push_back(ms);
    const Target& truth = truths_[place == kMoving ? 1 : 0].at(part->name);
    if (const auto error = record.errors.add(*image, truth); !error.empty()) return failure(error);
  }
  return {};
}

rtapi::Result<Outcome> FrameMeasurement::run_sequence(std::size_t method, FrameRenderer& renderer,
                                                      bool is_moving) {
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    if (const auto s = renderer.begin_frame(moment(frame, is_moving)); !s) return s.error();
    if (const auto s = renderer.render(); !is_done(s)) return s;
    if (frame == 0 && !is_moving) {
      if (const auto s = compare(method, renderer, kFirst); !s) return s.error();
    }
    if (frame + 1 == kFrames) {
      const auto s = compare(method, renderer, is_moving ? kMoving : kStill);
      if (!s) return s.error();
    }
  }
  return Outcome::kDone;
}

rtapi::Result<Outcome> FrameMeasurement::run_method(std::size_t method) {
  Options own = options_;
  choose(own, {"all"});
  own.frame.denoise = default_denoise(kMethods[method].method);
  own.frame.moving = true;
  if (own.frame.volume.file.empty()) {
    own.frame.volume.file = cache_ + "/volume-" + volume_key(options_, scene_) + ".bin";
  }
  const auto created = create_renderer(own, scene_, [](const std::string&) {});
  if (!created) return created.error();
  FrameRenderer& renderer = **created;
  if (const auto s = renderer.prepare(progress_); !is_done(s)) return s;
  for (std::uint32_t repeat = 0; repeat < options_.repeats; ++repeat) {
    const std::uint32_t seed = pcg_hash(options_.frame.seed + repeat);
    if (const auto s = renderer.set_seed(seed); !s) return s.error();
    for (const bool is_moving : {false, true}) {
      const auto s = run_sequence(method, renderer, is_moving);
      if (!is_done(s)) return s;
    }
    const double done = (static_cast<double>(method) + (repeat + 1.0) / options_.repeats) /
                        static_cast<double>(std::size(kMethods));
    if (!progress_("measuring", done)) return Outcome::kStopped;
  }
  return Outcome::kDone;
}

void FrameMeasurement::add_rows(MeasuredTable& table) const {
  for (const Part& part : frame_parts()) {
    for (std::uint32_t place = 0; place < kPlaceCount; ++place) {
      const Target& truth = truths_[place == kMoving ? 1 : 0].at(part.name);
      for (std::size_t method = 0; method < std::size(kMethods); ++method) {
        const Record& record = records_.at(part.name)[method][place];
        MeasuredRow row{fmt::format("{}, {}", part.name, kPlaceNames[place]),
                        kMethods[method].label, part.name};
        row.ms = median(record.ms);
        row.ms_min = row.ms_max = row.ms;
        row.errors = record.errors.summary(truth);
        row.errors.bias_squared -= truth.own_rmse * truth.own_rmse;
        row.reference_rmse = truth.own_rmse;
        row.steps = false;
        table.rows.push_back(row);
      }
    }
    table.about.push_back(fmt::format("truth of {}: own RMSE {:.2g} at rest, {:.2g} in motion",
                                      part.name, truths_[0].at(part.name).own_rmse,
                                      truths_[1].at(part.name).own_rmse));
  }
}

rtapi::Result<Outcome> FrameMeasurement::run(MeasuredTable& table) {
  auto path = make_camera_path(scene_, options_.camera_path);
  if (!path) return path.error();
  path_ = std::move(*path);
  for (const bool is_moving : {false, true}) {
    if (const auto s = make_truth(is_moving); !is_done(s)) return s;
  }
  for (const Part& part : frame_parts()) {
    records_[part.name].assign(std::size(kMethods), std::vector<Record>(kPlaceCount));
  }
  for (std::size_t method = 0; method < std::size(kMethods); ++method) {
    if (const auto s = run_method(method); !is_done(s)) return s;
  }
  table.title = "The frame against the path-traced truth";
  table.subtitle =
      fmt::format("{}, {} x {}, {}; camera path {}; truth of {} samples; {} seeds", options_.scene,
                  options_.frame.width, options_.frame.height, options_.backend, path_.name,
                  options_.measure_truth, options_.repeats);
  add_rows(table);
  return Outcome::kDone;
}

}  // namespace

rtapi::Result<Outcome> measure_frame(const Options& options, const Scene& scene,
                                     const Progress& progress, MeasuredTable& table) {
  if (options.measure_truth == 0) {
    return failure("--measure frame needs a truth: give --measure-truth at least 2 samples");
  }
  return FrameMeasurement(options, scene, progress).run(table);
}

}  // namespace kaamos::measure

// SPDX-License-Identifier: MIT
#include "effects/measure/study/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "effects/assets/image/flicker.h"
#include "effects/measure/run/camera_choice.h"
#include "effects/measure/run/failure.h"
#include "effects/measure/study/moving_box.h"
#include "effects/measure/truth/measure_truth.h"
#include "effects/measure/truth/truth.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr std::uint32_t kFrames = 6;
constexpr std::uint32_t kFirstMeasured = 2;           // histories begin to tell something
constexpr std::uint32_t kSamplesOfOthers = 1u << 20;  // no setting has so many in all frames

// The measurements of one setting so far.
struct Track {
  std::vector<double> ms;
  double traced = 0;
  Errors::Summary sums;  // over the measured frames
  double mse = 0, own_mse = 0;
  TemporalChange change;
  FloatImage before;
};

void add(const Errors::Summary& one, double own_rmse, Track& track) {
  track.mse += one.rmse * one.rmse;
  track.own_mse += own_rmse * own_rmse;
  track.sums.flip += one.flip;
  track.sums.ssim += one.ssim;
  track.sums.psnr += one.psnr;
  track.sums.energy_ratio += one.energy_ratio;
  track.sums.relative_mse += one.relative_mse;
  track.sums.not_finite += one.not_finite;
}

class MotionStudy {
 public:
  MotionStudy(const MeasurePlan& plan, const Options& options, const Scene& scene,
              const Progress& progress, const LookAt& look_at)
      : plan_(plan),
        options_(options),
        scene_(scene.animations.empty() ? with_mover(scene) : scene),
        progress_(progress),
        look_at_(look_at) {}

  rtapi::Result<Outcome> run(MeasuredTable& table) {
    options_.frame.moving = true;
    if (options_.camera_path.empty()) options_.camera_path = "dolly";
    const auto path = choose_path(options_, scene_);
    if (!path.ok()) return path.error();
    const auto created =
        EffectRuns::create(options_, scene_, plan_.effects, options_.out + "/measure-cache",
                           progress_, options_.say, runs_);
    if (!is_done(created)) return created;
    tracks_.resize(plan_.settings.size());
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
      const auto done = run_frame(path.value(), frame);
      if (!is_done(done)) return done;
    }
    fill(path.value().name, table);
    return Outcome::kDone;
  }

 private:
  // The path-traced truths of a frame, by reference.
  rtapi::Result<Outcome> find_truths(const FrameMoment& moment) {
    truths_.clear();
    if (moment.index < kFirstMeasured) return Outcome::kDone;
    Options own = options_;
    own.seconds = moment.seconds;
    Scene scene = scene_;
    scene.cameras.front() = moment.camera;
    PathSums sums;
    const auto traced = trace_truth(own, scene, options_.out + "/measure-cache", progress_, sums);
    if (!is_done(traced)) return traced;
    const auto mask = runs_->mask(false);
    if (!mask) return mask.error();
    for (const auto& reference : plan_.references) {
      auto truth = truth_of(*runs_, reference.setting, sums);
      if (!truth) return truth.error();
      if (!*truth) {
        auto converged = converge(reference.setting);
        if (!converged) return converged.error();
        *truth = std::move(*converged);
      }
      for (std::size_t i = 0; i < mask->size(); ++i) {
        if ((*mask)[i] == 0) (*truth)->mask[i] = 0;
      }
      if (reference.light) (*truth)->exposure = scene_.exposure;
      truths_.emplace(reference.name, std::move(**truth));
    }
    return Outcome::kDone;
  }

  // What the effect itself comes to with many samples, none of which a measured setting has.
  rtapi::Result<Target> converge(Setting setting) {
    setting.settings.samples = options_.measure_reference;
    setting.first_sample = kSamplesOfOthers;
    if (const auto ran = runs_->run(setting); !ran) return ran.error();
    auto image = runs_->read(setting);
    if (!image) return image.error();
    Target out;
    out.image = std::move(*image);
    out.mask.assign(std::size_t{out.image.width} * out.image.height, 1);
    return out;
  }

  rtapi::Result<Outcome> run_frame(const CameraPath& path, std::uint32_t frame) {
    FrameMoment moment;
    moment.index = frame;
    moment.seconds = frame / options_.frames_per_second;
    moment.camera = evaluate_camera(path, scene_.cameras.front(), moment.seconds);
    moment.cut = frame == 0;
    FrameRenderer& renderer = runs_->renderer();
    if (const auto s = renderer.begin_frame(moment); !s) return s.error();
    // Any run draws the surfaces.
    if (const auto ran = runs_->run(plan_.settings.front().setting); !ran) return ran.error();
    const auto view_z = renderer.read(renderer.frame().texture(kViewZ));
    if (!view_z) return view_z.error();
    const auto motion = renderer.read(renderer.frame().texture(kMotion));
    if (!motion) return motion.error();
    const FrameSurfaces surfaces = {*view_z, *motion};
    if (const auto s = find_truths(moment); !is_done(s)) return s;
    for (auto& [name, truth] : truths_) {
      if (const auto s = follow(truth.image, surfaces, frame, truth_tracks_[name]); !s) {
        return s.error();
      }
    }
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (const auto s = run_setting(i, frame, surfaces); !s) return s.error();
      const double done =
          (frame + (static_cast<double>(i) + 1.0) / static_cast<double>(tracks_.size())) / kFrames;
      if (!progress_("in motion", done)) return Outcome::kStopped;
    }
    view_z_before_ = std::move(surfaces.view_z);
    return Outcome::kDone;
  }

  rtapi::Status follow(const FloatImage& image, const FrameSurfaces& surfaces, std::uint32_t frame,
                       Track& track) const {
    if (frame > kFirstMeasured) {
      const auto change = temporal_change(track.before, image, view_z_before_, surfaces);
      if (!change.ok()) return change.error();
      track.change.add(change.value());
    }
    track.before = image;
    return {};
  }

  rtapi::Status run_setting(std::size_t index, std::uint32_t frame, const FrameSurfaces& surfaces) {
    const MeasuredSetting& measured = plan_.settings[index];
    Track& track = tracks_[index];
    const Setting setting = in_frame(measured.setting, frame);
    const auto ran = runs_->run(setting);
    if (!ran) return ran.error();
    const auto image = runs_->read(setting);
    if (!image) return image.error();
    if (frame < kFirstMeasured) return {};
    const Frame& pictures = runs_->renderer().frame();
    track.ms.push_back(ran->ms);
    track.traced = static_cast<double>(ran->rays) / pictures.width() / pictures.height();
    if (const auto s = follow(*image, surfaces, frame, track); !s) return s;
    const Target& truth = truths_.at(measured.reference);
    Errors errors;
    if (const auto error = errors.add(*image, truth); !error.empty()) return failure(error);
    add(errors.summary(truth), truth.own_rmse, track);
    if (frame + 1 < kFrames || !look_at_) return {};
    return look_at_(index, *image, truth, &truth);
  }

  void fill(const std::string& path, MeasuredTable& table) const {
    constexpr double kMeasured = kFrames - kFirstMeasured;
    table.subtitle = fmt::format("{}; {}; mean of frames {} to {} at {} Hz, camera path {}{}",
                                 scene_text(options_), plan_.signal, kFirstMeasured + 1, kFrames,
                                 options_.frames_per_second, path,
                                 options_.cpu_clock ? ", CPU time over threads" : "");
    for (const auto& [name, track] : truth_tracks_) {
      table.about.push_back(
          fmt::format("truth of {}: {} samples in each frame; it flickers by {:.2g}", name,
                      truths_.at(name).own_rmse > 0
                          ? fmt::format("path-traced, {}", options_.measure_truth)
                          : fmt::format("converged rays, {}", options_.measure_reference),
                      track.change.mean()));
    }
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      const MeasuredSetting& measured = plan_.settings[i];
      const Track& track = tracks_[i];
      MeasuredRow row{measured.group, measured.label, measured.reference};
      row.rays = measured.setting.settings.samples;
      row.traced = track.traced;
      row.ms = median(track.ms);
      row.ms_min = *std::min_element(track.ms.begin(), track.ms.end());
      row.ms_max = *std::max_element(track.ms.begin(), track.ms.end());
      row.flicker = track.change.mean();
      row.errors = track.sums;
      row.errors.rmse = std::sqrt(track.mse / kMeasured);
      row.errors.flip /= kMeasured;
      row.errors.ssim /= kMeasured;
      row.errors.psnr /= kMeasured;
      row.errors.energy_ratio /= kMeasured;
      row.errors.relative_mse /= kMeasured;
      row.truth = row.errors;
      row.reference_rmse = row.truth_rmse = std::sqrt(track.own_mse / kMeasured);
      row.steps = measured.steps;
      table.rows.push_back(row);
    }
  }

  const MeasurePlan& plan_;
  Options options_;
  Scene scene_;
  const Progress& progress_;
  const LookAt& look_at_;
  std::unique_ptr<EffectRuns> runs_;
  std::map<std::string, Target> truths_;
  std::map<std::string, Track> truth_tracks_;
  std::vector<Track> tracks_;
  FloatImage view_z_before_;
};

}  // namespace

rtapi::Result<Outcome> run_motion(const MeasurePlan& plan, const Options& options,
                                  const Scene& scene, const Progress& progress,
                                  MeasuredTable& table, const LookAt& look_at) {
  return MotionStudy(plan, options, scene, progress, look_at).run(table);
}

}  // namespace kaamos::measure

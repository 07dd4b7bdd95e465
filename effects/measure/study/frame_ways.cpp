// SPDX-License-Identifier: MIT
#include "effects/measure/study/frame_ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "effects/measure/run/effect_runs.h"
#include "effects/measure/run/failure.h"
#include "effects/measure/run/picture_key.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr std::uint32_t kFrames = 16;       // of a sequence; histories have settled by the last
constexpr std::uint32_t kTimed = 8;         // of them, the last
constexpr std::uint32_t kFiner = 4;         // points along the side of a pixel, of the reference
constexpr std::uint32_t kMostSamples = 64;  // of each signal of the reference, per pixel
constexpr const char* kAntialiasing = "antialiasing";

// One of four pixels is traced by every effect that can be.
void trace_a_fourth(Options& options, bool rotates) {
  for (auto& [name, settings] : options.frame.effects) {
    const Effect* row = find_effect(northlight_effects(), name);
    if (row->samples_option.empty() || !row->signals.front().is_sum) continue;
    settings.pixel_step = 2;
    settings.rotates = rotates;
  }
}

// A frame of a quarter of the pixels, which is enlarged.
void enlarge_by_two(Options& options, EnlargeMethod method) {
  options.frame.width /= 2;
  options.frame.height /= 2;
  options.frame.enlarge = 2;
  options.frame.enlarge_constants.method = method;
}

class FrameWays {
 public:
  FrameWays(const std::string& family, const Options& options, const Scene& scene,
            const Progress& progress)
      : family_(family), options_(options), scene_(scene), progress_(progress) {
    choose(options_, {"all"});
    options_.frame.moving = true;
    options_.frame.taa = false;
    options_.frame.order = RayOrder::kPixels;
    if (options_.frame.volume.file.empty()) {
      options_.frame.volume.file =
          options.out + "/measure-cache/volume-" + volume_key(options, scene) + ".bin";
    }
  }

  rtapi::Result<Outcome> run(MeasuredTable& table, const LookAt& look_at) {
    if (const auto s = make_target(); !is_done(s)) return s;
    table.title = family_;
    table.subtitle = fmt::format("{}; frame {} of a sequence at rest{}", scene_text(options_),
                                 kFrames, options_.cpu_clock ? ", CPU time over threads" : "");
    table.about = {
        "Milliseconds are those of the whole frame of all effects by rays, one ray each, denoised",
        "RMSE is that of what is seen, behind the tone curve"};
    for (const FrameWay& way : frame_ways(family_)) {
      MeasuredRow row{way.technique, way.label, "radiance"};
      FloatImage image;
      if (const auto s = measure(way, row, image); !is_done(s)) return s;
      table.rows.push_back(row);
      if (!look_at) continue;
      if (const auto s = look_at(table.rows.size() - 1, image, target_, nullptr); !s) {
        return s.error();
      }
    }
    return Outcome::kDone;
  }

 private:
  rtapi::Result<std::unique_ptr<FrameRenderer>> create(const Options& options) {
    auto renderer = create_renderer(options, scene_, options.say);
    if (renderer && options.cpu_clock) (*renderer)->runner().set_clock(cpu_clock(options.threads));
    return renderer;
  }

  rtapi::Result<Outcome> render(FrameRenderer& renderer, std::uint32_t frame,
                                const std::string& what, double done) {
    const auto begun = renderer.begin_frame({.index = frame,
                                             .seconds = options_.seconds.value_or(0.0),
                                             .camera = scene_.cameras.front(),
                                             .cut = frame == 0});
    if (!begun) return begun.error();
    return renderer.render(
        [&](const std::string&, double) { return !progress_ || progress_(what, done); });
  }

  rtapi::Result<Outcome> make_target() {
    Options own = options_;
    const bool is_finer = family_ == kAntialiasing;
    const std::uint32_t finer = is_finer ? kFiner : 1;
    own.frame.width *= finer;
    own.frame.height *= finer;
    own.frame.denoise = default_denoise(DenoiseMethod::kNone);
    for (auto& [name, settings] : own.frame.effects) {
      const Effect* row = find_effect(northlight_effects(), name);
      if (row->samples_option.empty()) continue;
      settings.samples =
          std::max(std::min(options_.measure_reference, kMostSamples) / (finer * finer), 1u);
    }
    const auto renderer = create(own);
    if (!renderer) return renderer.error();
    if (const auto s = render(**renderer, 0, "reference", 0); !is_done(s)) return s;
    const auto image = (*renderer)->read("radiance");
    if (!image) return image.error();
    const auto ids = (*renderer)->read("ids");
    if (!ids) return ids.error();
    shrink(*image, *ids, finer);
    target_.exposure = scene_.exposure;
    return Outcome::kDone;
  }

  // Means over the points of each pixel; the sky alone is left out.
  void shrink(const FloatImage& image, const FloatImage& ids, std::uint32_t finer) {
    const std::uint32_t width = image.width / finer, height = image.height / finer;
    target_.image = FloatImage(width, height, 3);
    target_.mask.assign(std::size_t{width} * height, 0);
    const float weight = 1.0f / static_cast<float>(finer * finer);
    for (std::uint32_t y = 0; y < image.height; ++y) {
      for (std::uint32_t x = 0; x < image.width; ++x) {
        for (std::uint32_t c = 0; c < 3; ++c) {
          target_.image.at(x / finer, y / finer, c) += weight * image.at(x, y, c);
        }
        if (ids.at(x, y, 0) != 0) target_.mask[std::size_t{y / finer} * width + x / finer] = 1;
      }
    }
  }

  rtapi::Result<Outcome> measure(const FrameWay& way, MeasuredRow& row, FloatImage& image) {
    Options own = options_;
    way.change(own);
    const auto renderer = create(own);
    if (!renderer) return renderer.error();
    std::vector<double> ms;
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
      const auto done = render(**renderer, frame, way.technique, (frame + 1.0) / kFrames);
      if (!is_done(done)) return done;
      if (frame + kTimed < kFrames) continue;
      double sum = 0;
      for (const PassStatistics& pass : (*renderer)->runner().passes()) sum += pass.ms;
      ms.push_back(sum);
    }
    const auto radiance = (*renderer)->read("radiance");
    if (!radiance) return radiance.error();
    image = FloatImage(radiance->width, radiance->height, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
      image.values[i] = radiance->values[i / 3 * radiance->channels + i % 3];
    }
    Errors errors;
    if (const auto error = errors.add(image, target_); !error.empty()) return failure(error);
    row.errors = errors.summary(target_);
    // Radiance would measure lamps in mirrors alone, which are thousands of times as bright.
    row.errors.rmse = std::pow(10.0, -row.errors.psnr / 20);
    row.ms = median(ms);
    row.ms_min = *std::min_element(ms.begin(), ms.end());
    row.ms_max = *std::max_element(ms.begin(), ms.end());
    row.rays = 1;
    row.traced = 1;
    row.steps = false;
    return Outcome::kDone;
  }

  std::string family_;
  Options options_;
  const Scene& scene_;
  const Progress& progress_;
  Target target_;
};

}  // namespace

const std::vector<FrameWay>& frame_ways(const std::string& family) {
  static const std::vector<FrameWay> upscaling = {
      {"every pixel", "one ray each"},
      {"a pixel of four", "upscaled", "--half-resolution all",
       [](Options& options) { trace_a_fourth(options, false); }, false, true},
      {"a pixel of four", "in turns", "--half-resolution all --rotate-pixels",
       [](Options& options) { trace_a_fourth(options, true); }, true, true},
      {"a quarter of the pixels", "enlarged along edges", "--enlarge 2",
       [](Options& options) { enlarge_by_two(options, EnlargeMethod::kAlongEdges); }, false, true},
      {"a quarter of the pixels", "enlarged, bilinear", "--enlarge 2 --enlarge-method bilinear",
       [](Options& options) { enlarge_by_two(options, EnlargeMethod::kBilinear); }, false, true}};
  static const std::vector<FrameWay> antialiasing = {
      {"one point of a pixel", "as it is by default"},
      {"temporal antialiasing", "as it is by default", "--taa",
       [](Options& options) { options.frame.taa = true; }, true}};
  static const std::vector<FrameWay> none;
  return family == "upscaling" ? upscaling : family == kAntialiasing ? antialiasing : none;
}

rtapi::Result<Outcome> measure_frame_ways(const std::string& family, const Options& options,
                                          const Scene& scene, const Progress& progress,
                                          MeasuredTable& table, const LookAt& look_at) {
  return FrameWays(family, options, scene, progress).run(table, look_at);
}

}  // namespace kaamos::measure

// SPDX-License-Identifier: MIT
#include "path_reference.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "effects/image/exr.h"
#include "effects/image/png.h"
#include "effects/image/tonemap.h"
#include "failure.h"
#include "output.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

using Clock = std::chrono::steady_clock;

// What is done is saved so often, in case that the machine or a rank is lost.
constexpr double kSaveSeconds = 60;

std::string sums_path(const Options& options) {
  return (std::filesystem::path(options.out) / "reference.sums").string();
}

ByteImage layer_png(const PathSums::Layer& layer, const FloatImage& mean, float exposure) {
  if (layer.name == "visibility") {
    FloatImage padded(mean.width, mean.height, 3);
    for (std::size_t i = 0; i < mean.values.size() / 2; ++i) {
      for (std::size_t c = 0; c < 2; ++c) padded.values[3 * i + c] = mean.values[2 * i + c];
    }
    return to_bytes(padded);
  }
  if (layer.channels == 3) return tonemap(mean, exposure);
  FloatImage colors(mean.width, mean.height, 3);
  for (std::size_t i = 0; i < mean.values.size() / 4; ++i) {
    for (std::size_t c = 0; c < 3; ++c) colors.values[3 * i + c] = mean.values[4 * i + c];
  }
  return tonemap(colors, exposure);
}

rtapi::Status write_pictures(const Options& options, const Scene& scene,
                             const PathReference& reference) {
  const PathSums& sums = reference.sums();
  StagedFiles files(options.out);
  if (const auto error = files.create(); !error.empty()) return failure(error);
  ExrFile exr;
  exr.attributes = {{"scene", scene.name},
                    {"seed", std::to_string(options.frame.seed)},
                    {"samples", std::to_string(reference.samples())},
                    {"bounces", options.bounces ? std::to_string(*options.bounces) : "unlimited"}};
  for (const PathSums::Layer& layer : sums.layers) {
    const FloatImage mean = sums.mean(layer);
    exr.attributes["error." + layer.name] = fmt::format("{:.6g}", sums.error(layer));
    const std::string name = "reference_" + layer.name + ".png";
    if (auto error = files.add(name, layer_png(layer, mean, scene.exposure)); !error.empty()) {
      return failure(error);
    }
    exr.layers.push_back({layer.name == "radiance" ? "" : layer.name, mean, options.half, {}});
  }
  const auto written = write_exr(files.add_path("reference.exr"), exr);
  if (!written.ok()) return written.error();
  if (const auto error = files.publish(); !error.empty()) return failure(error);
  return save_path_sums(sums_path(options), sums);
}

void print(const Options& options, const PathReference& reference, double seconds) {
  const PathSums& sums = reference.sums();
  std::printf("%s\n%u samples a pixel, %.1f s, %.2f Mrays/s\n\n%-16s%12s\n",
              reference.device().GetInfo().Name.c_str(), reference.samples(), seconds,
              seconds > 0 ? static_cast<double>(reference.rays()) / seconds / 1e6 : 0.0, "layer",
              "error");
  for (const PathSums::Layer& layer : sums.layers) {
    std::printf("%-16s%12.6f\n", layer.name.c_str(), sums.error(layer));
  }
  std::printf(
      "\nerror: root mean square of the standard errors, from two independent halves\n"
      "wrote %s/reference.exr, reference.sums and a PNG for each layer\n",
      options.out.c_str());
  std::fflush(stdout);
}

}  // namespace

PathReferenceDesc describe_reference(const Options& options) {
  PathReferenceDesc desc;
  desc.width = options.frame.width;
  desc.height = options.frame.height;
  desc.seed = options.frame.seed;
  desc.paths.bounces = options.bounces.value_or(kUnlimitedBounces);
  desc.paths.occlusion_radius = options.effects.at("ao").radius;
  desc.each_lamp = options.each_lamp;
  desc.sun_angular_radius = options.frame.sun_angular_radius;
  desc.ray_cones = options.frame.ray_cones;
  desc.seconds = options.seconds;
  return desc;
}

rtapi::Result<Outcome> render_path_reference(const Options& options, const Scene& scene,
                                             const Progress& progress, const Say& message) {
  const auto device = create_device(options, message);
  if (!device) return device.error();
  auto created = PathReference::create(*device, scene, describe_reference(options));
  if (!created) return created.error();
  PathReference& reference = **created;
  if (options.resume) {
    const auto loaded = load_path_sums(sums_path(options), reference.sums());
    if (!loaded) return loaded.error();
  }
  const auto start = Clock::now();
  auto saved = start;
  rtapi::Status save_status;
  std::uint32_t samples_saved = reference.samples();
  const auto step = [&](double done) {
    const auto now = Clock::now();
    if (reference.samples() > samples_saved &&
        std::chrono::duration<double>(now - saved).count() > kSaveSeconds) {
      save_status = save_path_sums(sums_path(options), reference.sums());
      saved = now;
      samples_saved = reference.samples();
    }
    return save_status.ok() && (!progress || progress("reference", done));
  };
  const auto done = reference.accumulate(options.path_samples, step);
  if (!done) return done;
  if (!save_status) return save_status.error();
  if (reference.samples() == 0) return done;
  if (const auto written = write_pictures(options, scene, reference); !written) {
    return written.error();
  }
  print(options, reference, std::chrono::duration<double>(Clock::now() - start).count());
  if (*done == Outcome::kStopped) {
    message(fmt::format("stopped at {} of {} samples; the same command with --resume goes on",
                        reference.samples(), options.path_samples));
  }
  return done;
}

}  // namespace northlight

// SPDX-License-Identifier: MIT
#include "effects/measure/truth/path_reference.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <span>

#include "effects/assets/image/exr.h"
#include "effects/assets/image/png.h"
#include "effects/assets/image/tonemap.h"
#include "effects/measure/run/failure.h"
#include "effects/measure/run/staged_files.h"
#include "effects/shadows/glass_shadow/glass_shadow.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

using Clock = std::chrono::steady_clock;

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

// The sums of all ranks, at the first.
PathSums gather(const Ranks& ranks, const PathSums& mine) {
  PathSums whole = mine;
  for (PathSums::Layer& layer : whole.layers) {
    for (auto& half : layer.sums) ranks.sum_at_first(half);
  }
  return whole;
}

// Every rank goes on with its own bands, so that each pixel's samples are added up in one order
// whatever the number of ranks.
rtapi::Status load_for_all(const Options& options, const Ranks& ranks, PathReference& reference) {
  rtapi::Status loaded;
  PathSums& sums = reference.sums();
  if (ranks.is_first()) loaded = load_path_sums(sums_path(options), sums);
  if (ranks.any(!loaded.ok())) {
    return ranks.is_first() ? loaded : failure("the first rank has no sums to go on with");
  }
  ranks.copy_from_first(std::span<std::uint32_t>(sums.samples));
  for (PathSums::Layer& layer : sums.layers) {
    for (auto& half : layer.sums) ranks.copy_from_first(half);
  }
  reference.keep_own_bands();
  return {};
}

// Goes on batch by batch. The ranks agree between batches on whether to stop or to save.
rtapi::Result<Outcome> trace_and_save(const Options& options, const Ranks& ranks,
                                      const Progress& progress, PathReference& reference) {
  auto saved = Clock::now();
  bool wants_stop = false;
  const auto show = [&](double done) {
    wants_stop = wants_stop || (progress && !progress("reference", done));
    // Alone it stops at once; several ranks finish their batch.
    return ranks.count() > 1 || !wants_stop;
  };
  while (reference.samples() < options.path_samples) {
    const auto done = reference.trace_batch(options.path_samples, show);
    // A rank that cannot go on must not leave the others waiting.
    if (ranks.any(!done.ok())) return done.ok() ? failure("another rank failed") : done;
    if (ranks.any(wants_stop)) return Outcome::kStopped;
    const std::chrono::duration<double> since = Clock::now() - saved;
    if (!ranks.any(ranks.is_first() && since.count() > options.save_seconds)) continue;
    const PathSums whole = gather(ranks, reference.sums());
    if (ranks.is_first()) {
      if (const auto s = save_path_sums(sums_path(options), whole); !s) return s.error();
    }
    saved = Clock::now();
  }
  return Outcome::kDone;
}

rtapi::Status write_pictures(const Options& options, const Scene& scene, const PathSums& sums) {
  StagedFiles files(options.out);
  if (const auto error = files.create(); !error.empty()) return failure(error);
  ExrFile exr;
  exr.attributes = {{"scene", scene.name},
                    {"seed", std::to_string(options.frame.seed)},
                    {"samples", std::to_string(sums.samples[0] + sums.samples[1])},
                    {"seconds", options.seconds ? fmt::format("{:.9g}", *options.seconds) : "none"},
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

std::string describe(const Options& options, const PathReference& reference, const PathSums& sums,
                     std::uint32_t ranks, double seconds) {
  std::string out =
      fmt::format("{}\n{} samples a pixel, {:.2f} s, {:.2f} Mrays/s{}\n\n{:<16}{:>12}\n",
                  reference.device().GetInfo().Name, reference.samples(), seconds,
                  seconds > 0 ? static_cast<double>(reference.rays()) / seconds / 1e6 : 0.0,
                  ranks > 1 ? fmt::format(" of the first, {} ranks", ranks) : "", "layer", "error");
  for (const PathSums::Layer& layer : sums.layers) {
    out += fmt::format("{:<16}{:>12.6f}\n", layer.name, sums.error(layer));
  }
  return out + fmt::format(
                   "\nerror: root mean square of the standard errors, from two independent halves\n"
                   "wrote {}/reference.exr, reference.sums and a PNG for each layer\n",
                   options.out);
}

}  // namespace

PathReferenceDesc describe_reference(const Options& options) {
  PathReferenceDesc desc;
  desc.width = options.frame.width;
  desc.height = options.frame.height;
  desc.seed = options.frame.seed;
  desc.paths.bounces = options.bounces.value_or(kUnlimitedBounces);
  desc.paths.occlusion_radius = options.effects.at("ao").radius;
  if (options.glass_shadows) {
    desc.paths.glass_tint =
        options.effects.at("glass-shadow").get_constants<GlassShadowConstants>().tint;
  }
  desc.each_lamp = options.each_lamp;
  desc.sun_angular_radius = options.frame.sun_angular_radius;
  desc.ray_cones = options.frame.ray_cones;
  desc.seconds = options.seconds;
  return desc;
}

rtapi::Result<Outcome> render_path_reference(const Options& options, const Scene& scene,
                                             const Ranks& ranks, const Progress& progress,
                                             std::string& said) {
  const auto device = create_device(options, options.say);
  if (!device) return device.error();
  PathReferenceDesc desc = describe_reference(options);
  desc.part = ranks.rank();
  desc.parts = ranks.count();
  auto created = PathReference::create(*device, scene, desc);
  if (!created) return created.error();
  PathReference& reference = **created;
  if (options.resume) {
    if (const auto loaded = load_for_all(options, ranks, reference); !loaded) {
      return loaded.error();
    }
  }
  const auto start = Clock::now();
  const auto done = trace_and_save(options, ranks, progress, reference);
  if (!done) return done;
  const PathSums whole = gather(ranks, reference.sums());
  if (!ranks.is_first() || reference.samples() == 0) return done;
  if (const auto written = write_pictures(options, scene, whole); !written) {
    return written.error();
  }
  said = describe(options, reference, whole, ranks.count(),
                  std::chrono::duration<double>(Clock::now() - start).count());
  if (*done == Outcome::kStopped) {
    options.say(fmt::format("stopped at {} of {} samples; the same command with --resume goes on",
                            reference.samples(), options.path_samples));
  }
  return done;
}

}  // namespace kaamos::measure

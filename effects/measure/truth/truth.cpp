// SPDX-License-Identifier: MIT
#include "effects/measure/truth/truth.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "effects/measure/truth/committed_truth.h"
#include "effects/measure/truth/path_reference.h"

namespace kaamos::measure {

using namespace kaamos::effects;

rtapi::Result<Outcome> trace_truth(const Options& options, const Scene& scene,
                                   const std::string& cache, const Progress& progress,
                                   PathSums& sums) {
  if (auto kept = committed_truth(options)) {
    sums = std::move(*kept);
    return Outcome::kDone;
  }
  const auto device = create_device(options, [](const std::string&) {});
  if (!device) return device.error();
  auto created = PathReference::create(*device, scene, describe_reference(options));
  if (!created) return created.error();
  PathReference& reference = **created;
  const std::string path = fmt::format("{}/truth-{}x{}-{:016x}.sums", cache, options.frame.width,
                                       options.frame.height, reference.sums().fingerprint);
  // Sums that cannot be continued are traced again.
  if (std::filesystem::exists(path)) static_cast<void>(load_path_sums(path, reference.sums()));
  if (reference.samples() < options.measure_truth) {
    const auto done = reference.accumulate(
        options.measure_truth, [&](double part) { return progress("path-traced truth", part); });
    if (!done) return done;
    if (const auto saved = save_path_sums(path, reference.sums()); !saved) return saved.error();
    if (*done == Outcome::kStopped) return done;
  }
  sums = std::move(reference.sums());
  return Outcome::kDone;
}

Target truth_picture(const PathSums& sums, const std::vector<std::string>& layers,
                     std::uint32_t channels, const MakePixel& make) {
  Target target;
  const std::size_t pixels = static_cast<std::size_t>(sums.width) * sums.height;
  target.image = FloatImage(sums.width, sums.height, channels);
  target.mask.assign(pixels, 1);
  std::vector<FloatImage> means[3];  // of both halves together, and of each
  std::vector<std::uint32_t> widths;
  for (const std::string& name : layers) {
    const PathSums::Layer& layer = *sums.find(name);
    widths.push_back(layer.channels);
    means[0].push_back(sums.mean(layer));
    for (std::uint32_t half = 0; half < kPathHalves; ++half) {
      FloatImage image(sums.width, sums.height, layer.channels);
      for (std::size_t i = 0; i < image.values.size(); ++i) {
        image.values[i] = static_cast<float>(layer.sums[half][i] / sums.samples[half]);
      }
      means[half + 1].push_back(std::move(image));
    }
  }
  double squares = 0;
  std::size_t count = 0;
  std::vector<const float*> at(layers.size());
  std::vector<float> values[2] = {std::vector<float>(channels), std::vector<float>(channels)};
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    const auto made = [&](int which, float* out) {
      for (std::size_t i = 0; i < layers.size(); ++i) {
        at[i] = &means[which][i].values[pixel * widths[i]];
      }
      return make(pixel, at, out);
    };
    if (!made(0, &target.image.values[pixel * channels])) {
      target.mask[pixel] = 0;
      continue;
    }
    made(1, values[0].data());
    made(2, values[1].data());
    for (std::uint32_t c = 0; c < channels; ++c) {
      squares += std::pow(0.5 * (values[0][c] - values[1][c]), 2);
      ++count;
    }
  }
  target.own_rmse = count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
  return target;
}

}  // namespace kaamos::measure

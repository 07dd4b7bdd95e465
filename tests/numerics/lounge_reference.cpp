// SPDX-License-Identifier: MIT
#include "lounge_reference.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "effects/assets/built_in/lounge.h"
#include "effects/assets/image/exr.h"

namespace kaamos::test {

using namespace effects;

namespace {

const char* name_of(Effect effect) {
  return effect == Effect::kAmbientOcclusion ? "ambient_occlusion" : "sun_visibility";
}

}  // namespace

EffectRun lounge_run(Effect effect, std::uint32_t rays, std::uint32_t seed) {
  EffectRun run;
  run.effect = effect;
  run.width = kLoungeWidth;
  run.height = kLoungeHeight;
  run.samples = rays;
  run.seed = seed;
  return run;
}

Estimate estimate_lounge(const Scene& lounge, Effect effect, std::uint32_t rays,
                         std::uint32_t scrambles, std::uint32_t first_seed) {
  constexpr std::size_t kPixels = std::size_t{kLoungeWidth} * kLoungeHeight;
  std::vector<double> sum(kPixels), sum_of_squares(kPixels);
  Estimate out;
  for (std::uint32_t i = 0; i < scrambles; ++i) {
    EffectResult result = run_effect(lounge, lounge_run(effect, rays, first_seed + i));
    for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
      const double value = result.visibility.values[pixel];
      sum[pixel] += value;
      sum_of_squares[pixel] += value * value;
    }
    out.ids = std::move(result.ids);
  }
  const double n = scrambles;
  out.mean = out.error = out.deviation = FloatImage(kLoungeWidth, kLoungeHeight, 1);
  for (std::size_t pixel = 0; pixel < kPixels; ++pixel) {
    const double mean = sum[pixel] / n;
    const double variance = std::max(0.0, sum_of_squares[pixel] / n - mean * mean) * n / (n - 1);
    out.mean.values[pixel] = static_cast<float>(mean);
    out.deviation.values[pixel] = static_cast<float>(std::sqrt(variance));
    out.error.values[pixel] = static_cast<float>(std::sqrt(variance / n));
  }
  return out;
}

std::string lounge_reference_path() {
  return KAAMOS_SOURCE_DIR "/tests/numerics/reference/lounge.exr";
}

Result<LoungeReference> read_lounge_reference(Effect effect) {
  Result<ExrFile> file = read_exr(lounge_reference_path());
  if (!file.ok()) return file.error();
  LoungeReference out;
  const std::string name = name_of(effect);
  const std::pair<std::string, FloatImage*> layers[] = {{name, &out.mean},
                                                        {name + "_error", &out.error},
                                                        {name + "_deviation", &out.deviation},
                                                        {"ids", &out.ids}};
  for (const auto& [layer_name, image] : layers) {
    const ExrLayer* layer = find_layer(file.value(), layer_name);
    if (layer == nullptr) {
      return make_error(ErrorId::kPictures,
                        lounge_reference_path() + " has no layer " + layer_name);
    }
    *image = layer->image;
  }
  return out;
}

Status write_lounge_reference(const std::string& path) {
  const Scene lounge = make_lounge();
  ExrFile file;
  for (const Effect effect : {Effect::kAmbientOcclusion, Effect::kSunShadow}) {
    const std::string name = name_of(effect);
    Estimate best = estimate_lounge(lounge, effect, kLoungeRays, kLoungeScrambles, 0);
    Estimate quick = estimate_lounge(lounge, effect, kQuickRays, kLoungeScrambles, 0);
    file.layers.push_back({name, std::move(best.mean)});
    // Three digits are enough to say how large an error is.
    file.layers.push_back({name + "_error", std::move(best.error), true});
    file.layers.push_back({name + "_deviation", std::move(quick.deviation), true});
    if (effect == Effect::kAmbientOcclusion) {
      file.layers.push_back({"ids", std::move(best.ids)});
    }
  }
  file.attributes = {
      {"scene", "lounge"},
      {"backend", "embree"},
      {"seeds", "0 to " + std::to_string(kLoungeScrambles - 1)},
      {"samplesPerSeed", std::to_string(kLoungeRays)},
      {"samplesPerPixel", std::to_string(kLoungeRays * kLoungeScrambles)},
      {"ambientOcclusionRadius", std::to_string(EffectRun().radius)},
      {"layersError", "standard error of the mean, from the spread of the seeds"},
      {"layersDeviation",
       "standard deviation of one seed's " + std::to_string(kQuickRays) + " samples"},
  };
  return write_exr(path, file);
}

}  // namespace kaamos::test

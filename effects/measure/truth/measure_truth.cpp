// SPDX-License-Identifier: MIT
#include "effects/measure/truth/measure_truth.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "effects/measure/truth/truth.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

// Signals are divided by an albedo; where it is black they stand for nothing.
constexpr float kLeastAlbedo = 1e-3f;

// A lobe's light over what the lobe reflects of even light.
Target over_albedo(const PathSums& truth, const char* light, const char* albedo) {
  return truth_picture(truth, {light, albedo}, 3, [](std::size_t, const auto& layers, float* out) {
    if (std::max({layers[1][0], layers[1][1], layers[1][2]}) < kLeastAlbedo) return false;
    for (int c = 0; c < 3; ++c) out[c] = layers[0][c] / std::max(layers[1][c], kLeastAlbedo);
    return true;
  });
}

Target channel_of(const PathSums& truth, const char* layer, int channel) {
  return truth_picture(truth, {layer}, 1, [channel](std::size_t, const auto& layers, float* out) {
    *out = layers[0][channel];
    return true;
  });
}

// The truth's glass in front of what the effect's glass stands in front of.
rtapi::Result<Target> behind_glass(EffectRuns& runs, const PathSums& truth) {
  const auto background = runs.read_background();
  if (!background) return background.error();
  const float* behind = background->values.data();
  const std::size_t channels = background->channels;
  return truth_picture(truth, {"glass"}, 3, [&](std::size_t pixel, const auto& layers, float* out) {
    for (int c = 0; c < 3; ++c) {
      out[c] = behind[pixel * channels + c] * layers[0][3] + layers[0][c];
    }
    return true;
  });
}

}  // namespace

rtapi::Result<std::optional<Target>> truth_of(EffectRuns& runs, const Setting& setting,
                                              const PathSums& truth) {
  if (setting.effect == "ao") {
    // The truth has one radius.
    if (setting.settings.radius != runs.ambient_radius()) return std::optional<Target>();
    return std::optional(channel_of(truth, "visibility", 0));
  }
  if (setting.effect == "sun") return std::optional(channel_of(truth, "visibility", 1));
  if (setting.effect == "glass-shadow") {
    // Where the sun is hidden its colour does not count.
    return std::optional(truth_picture(truth, {"sun_tint", "visibility"}, 3,
                                       [](std::size_t, const auto& layers, float* out) {
                                         std::copy_n(layers[0], 3, out);
                                         return layers[1][1] > 0.0f;
                                       }));
  }
  if (setting.lit) {
    return std::optional(
        truth_picture(truth, {"lamps"}, 3, [](std::size_t, const auto& layers, float* out) {
          std::copy_n(layers[0], 3, out);
          return true;
        }));
  }
  if (setting.effect == "gi") {
    return std::optional(over_albedo(truth, "indirect", "diffuse_albedo"));
  }
  if (setting.effect == "reflections") {
    return std::optional(over_albedo(truth, "reflection", "specular_albedo"));
  }
  if (setting.effect == "transparent") {
    auto target = behind_glass(runs, truth);
    if (!target) return target.error();
    return std::optional(std::move(*target));
  }
  return std::optional<Target>();
}

}  // namespace kaamos::measure

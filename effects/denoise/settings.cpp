// SPDX-License-Identifier: MIT
#include "effects/denoise/settings.h"

#include <string>
#include <utility>
#include <vector>

namespace kaamos::effects {

namespace {

constexpr const char* kSvgf = "Schied et al. 2017";
constexpr const char* kControl = "Control";
// DenoiseMethod.
const std::vector<std::string> kMethods = {"none",     "gaussian", "bilateral", "bilateral-exact",
                                           "temporal", "svgf",     "control",   "a-svgf"};

SettingOf<DenoiseDesc> method_setting() {
  SettingOf<DenoiseDesc> out = word_setting(
      "method", &DenoiseDesc::method, kMethods,
      "the denoiser of the whole frame, with defaults of its own; a-svgf is svgf that forgets "
      "where light changes");
  out.set = [set = out.set](DenoiseDesc& desc, const SettingValue& value) {
    DenoiseDesc wanted = desc;
    set(wanted, value);
    if (wanted.method == desc.method) return;
    desc = default_denoise(wanted.method);
    desc.visibility = wanted.visibility;
  };
  return out;
}

SettingTable<DenoiseConstants> constants_settings() {
  using C = DenoiseConstants;
  return {
      number_setting("alpha", &C::alpha, {0, 1}, "", "least weight of the new frame", kSvgf),
      number_setting("moments-alpha", &C::moments_alpha, {0, 1}, "", "the same for its moments",
                     kSvgf),
      number_setting("sigma-z", &C::sigma_z, {0, 1e6}, "slopes", "of depth", kSvgf),
      number_setting("sigma-n", &C::sigma_n, {0, 65536}, "",
                     "exponent of the cosine between normals", kSvgf),
      number_setting("sigma-l", &C::sigma_l, {0, 1e6}, "deviations",
                     "of luminance; 0: no weight of the bilateral filter", kSvgf),
      number_setting("sigma-pixels", &C::sigma_pixels, {0.01, 1000}, "pixels",
                     "of the Gaussian; of a lobe's filter at most"),
      number_setting("clip-gamma", &C::clip_gamma, {0, 1e6}, "deviations",
                     "of 3 x 3 pixels that history is clipped to; 0: no clipping", kControl),
      count_setting("max-history", &C::max_history, {1, 65536}, "frames", "that history counts"),
      closed_setting(&C::history_valid),
      closed_setting(&C::step),
      count_setting("radius", &C::radius, {0, 64}, "taps", "to each side"),
      closed_setting(&C::vertical),
      closed_setting(&C::scale),
      closed_setting(&C::normal_squarings),
      closed_setting(&C::lobe_scale),  // by the signal
      number_setting("sigma-hit", &C::sigma_hit, {1e-6, 1e6}, "",
                     "of hit distances, relative to the farther one", kControl),
      number_setting("sigma-roughness", &C::sigma_roughness, {1e-6, 1e6}, "", "of roughness",
                     kControl),
      closed_setting(&C::signals),
      closed_setting(&C::lobes),
      closed_setting(&C::changes),
      closed_setting(&C::pixel_offset),
      switch_setting("keep-energy", &C::keep_energy,
                     "light of few bright samples is not lost; off: cut as in the sources"),
      number_setting("scalar-alpha", &C::scalar_alpha, {0, 1}, "",
                     "alpha of scalars such as ambient occlusion", "Falcor"),
      closed_setting(&C::scalars)};
}

}  // namespace

SettingTable<DenoiseDesc> denoise_settings() {
  return join_settings(
      join_settings({method_setting()},
                    settings_within(&DenoiseDesc::constants, constants_settings())),
      {count_setting(
           "first-passes", &DenoiseDesc::iterations, {0, 8}, "",
           "of svgf's wavelet filter, each twice as wide as the one before, in first frames",
           kSvgf),
       count_setting("passes-with-history", &DenoiseDesc::iterations_with_history, {0, 8}, "",
                     "once a sequence has four frames of history"),
       switch_setting("half-history", &DenoiseDesc::half_history,
                      "light is kept from frame to frame in half floats, which lag behind"),
       closed_setting(&DenoiseDesc::visibility)});  // visibility_settings
}

SettingTable<VisibilityConstants> visibility_settings() {
  using C = VisibilityConstants;
  return {
      number_setting("alpha", &C::alpha, {0, 1}, "", "least weight of the new frame"),
      count_setting("max-history", &C::max_history, {1, 65536}, "frames", "that history counts"),
      closed_setting(&C::history_valid),
      number_setting("reach", &C::reach, {0, 100}, "penumbras",
                     "deviation of the filter; 0: nothing is filtered in space"),
      number_setting("clip", &C::clip, {0, 1e6}, "deviations",
                     "of new samples from which on history is let go; 0: never"),
      closed_setting(&C::channels),
      closed_setting(&C::channel),
      closed_setting(&C::lights_channel),
      closed_setting(&C::step),
      closed_setting(&C::vertical),
      closed_setting(&C::changes)};
}

}  // namespace kaamos::effects

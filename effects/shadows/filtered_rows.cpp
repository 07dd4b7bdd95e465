// SPDX-License-Identifier: MIT
#include "effects/shadows/filtered_shadow_map/filtered_shadow_map.h"
#include "effects/shadows/rows.h"
#include "effects/shadows/settings.h"
#include "effects/shadows/shadow_map/shadow_map.h"

namespace kaamos::effects {

namespace {

using Constants = FilteredShadowMapConstants;

// Hardly any bias: that a surface has its own depth in the map is no more than variance.
Constants constants_of(FilteredShadowMapMethod method) {
  Constants out;
  out.map.method = method;
  out.map.constant_bias = 0.5f;
  out.map.slope_bias = 0.5f;
  return out;
}

Constants with_size(Constants constants, std::uint32_t size) {
  constants.map.size = size;
  return constants;
}

Constants with_terms(Constants constants, std::uint32_t terms) {
  constants.terms = terms;
  return constants;
}

EffectStep step(const char* label, const Constants& constants) {
  return {label, EffectSettings().set_constants(constants)};
}

std::vector<EffectStep> sizes(const Constants& constants) {
  return {step("1024 x 1024", with_size(constants, 1024)),
          step("2048 x 2048", with_size(constants, 2048)),
          step("4096 x 4096", with_size(constants, 4096))};
}

// A row whose signal is called `layer`.
Effect row_of(const char* name, const char* about, const char* layer, const Constants& constants,
              const char* misses) {
  Effect row = {.name = name, .about = about};
  row.library = {"shadows/filtered_shadow_map/filtered_shadow_map", filtered_shadow_map_library};
  row.make = make_filtered_shadow_map;
  row.more_libraries = {{"shadows/shadow_map/shadow_draws", shadow_draws_library}};
  row.signals = {
      {.name = layer, .channels = 1, .is_sum = false, .part = &FrameParts::sun_visibility}};
  set_constants(
      row, constants,
      filtered_shadow_map_settings(static_cast<FilteredShadowMapMethod>(constants.map.method)));
  row.needs.sun = true;
  row.alternative_to = "sun";
  row.steps = sizes(constants);
  row.misses = misses;
  return row;
}

Effect convolution_row() {
  const Constants constants = constants_of(kFilteredConvolution);
  Effect row =
      row_of("sun-convolution", "sun shadow by a convolution shadow map", "sun_convolution",
             constants, "contact, within the width of its step, and penumbras; it rings");
  row.steps = {step("4 terms", with_terms(constants, 4)), step("8 terms", with_terms(constants, 8)),
               step("16 terms", with_terms(constants, 16))};
  return row;
}

Constants exponential_variance() {
  Constants out = constants_of(kFilteredExponentialVariance);
  out.exponent = 40.0f;
  return out;
}

Constants pcss_variance() {
  Constants out = constants_of(kFilteredPcssVariance);
  out.map.radius = 0.5f;
  return out;
}

Effect pcss_convolution_row() {
  Constants constants = constants_of(kFilteredPcssConvolution);
  constants.map.size = 1024;
  constants.map.radius = 0.5f;
  Effect row = row_of("sun-pcss-convolution", "soft sun shadow by convolution shadow maps",
                      "sun_pcss_convolution", constants,
                      "contact, within the width of its step, and occluders at several depths");
  row.steps = {step("4 terms", with_terms(constants, 4)), step("8 terms", with_terms(constants, 8)),
               step("16 terms", with_terms(constants, 16))};
  return row;
}

}  // namespace

std::vector<Effect> filtered_shadow_rows() {
  return {
      row_of("sun-vsm", "sun shadow by a variance shadow map", "sun_vsm",
             constants_of(kFilteredVariance),
             "that two occluders may cover the sun together (light bleeding), and penumbras"),
      row_of("sun-esm", "sun shadow by an exponential shadow map", "sun_esm",
             constants_of(kFilteredExponential),
             "contact, where occluders are within 1/80 of the map's depth, and penumbras"),
      row_of("sun-evsm", "sun shadow by an exponential variance shadow map", "sun_evsm",
             exponential_variance(), "penumbras; light bleeds a little"),
      convolution_row(),
      row_of("sun-pcss-vsm", "soft sun shadow by variance shadow maps", "sun_pcss_vsm",
             pcss_variance(), "occluders at several depths, whose light bleeds"),
      pcss_convolution_row(),
  };
}

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
#include "effects/shadows/settings.h"

#include <limits>

namespace kaamos::effects {

namespace {

constexpr double kAny = 1e9;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr const char* kAdaptive = "Boksansky, Wimmer & Bittner 2019";

constexpr const char* kColored = "McGuire & Enderton 2011";
constexpr const char* kTint =
    "part of a pane's own colour that it lets through; 0: grey, as the camera sees through it";

SettingTable<ShadowMapConstants> all_of_map() {
  using C = ShadowMapConstants;
  return {
      closed_setting(&C::method),  // the technique
      closed_setting(&C::flags),   // of which these are a choice
      bits_setting("receiver-plane", &C::flags, kShadowMapReceiverPlane,
                   "taps are compared with the surface's plane; off: with the point's depth"),
      bits_setting("grid", &C::flags, kShadowMapGrid,
                   "a square of taps; off: a disk that each pixel turns"),
      bits_setting("survey-rule", &C::flags, kShadowMapSurveyRule,
                   "the comparison as the survey has it, with reversed depth: wrong",
                   "effects/SOURCES.md: E10"),
      bits_setting("tight", &C::flags, kShadowMapTight,
                   "cascades as tight as it goes; shadows' edges crawl when the camera moves"),
      bits_setting("inner-penumbra", &C::flags, kShadowMapInnerPenumbra,
                   "the penumbra lies inside the hard shadow", "Story 2015"),
      bits_setting("per-object", &C::flags, kShadowMapPerObject,
                   "cascades count objects: heroes with a map of their own", "survey 5.1.1"),
      count_setting("texels", &C::size, {4, 16384}, "texels", "along a map's side"),
      count_setting("cascades", &C::cascades, {0, 4}, "", "or objects; 0: one map over the scene",
                    "survey 5.1.2"),
      number_setting("constant-bias", &C::constant_bias, {-kAny, kAny}, "texels",
                     "that a surface is taken to be nearer to the sun"),
      number_setting("slope-bias", &C::slope_bias, {-kAny, kAny}, "texels",
                     "times the tangent between normal and sun"),
      number_setting("normal-offset", &C::normal_offset, {-kAny, kAny}, "texels",
                     "along the normal, times the sine of that angle"),
      number_setting("most-bias", &C::most_bias, {0, kAny}, "texels", "of the slope's, at most"),
      number_setting("radius", &C::radius, {0, kAny}, "m", "of the filter; of PCSS at most"),
      count_setting("taps", &C::taps, {1, 64}, "", "of the filter"),
      count_setting("blocker-taps", &C::blocker_taps, {1, 64}, "", "of the search for blockers",
                    "Fernando 2005"),
      number_setting("blend", &C::blend, {0, 1}, "",
                     "share of a cascade in which the next one comes in"),
      number_setting("split-share", &C::split_share, {0, 1}, "",
                     "of logarithmic splits of cascades; the rest is uniform", "Zhang et al. 2006"),
      number_setting("reach", &C::reach, {0, kAny}, "m", "of the cascades; 0: as far as the scene"),
      closed_setting(&C::draw),
      closed_setting(&C::map)};
}

}  // namespace

SettingTable<ShadowMapConstants> shadow_map_settings(ShadowMapMethod method) {
  SettingTable<ShadowMapConstants> table = all_of_map();
  if (method == kShadowMapHard) {
    return close_settings(
        table, {"receiver-plane", "grid", "inner-penumbra", "radius", "taps", "blocker-taps"});
  }
  if (method == kShadowMapPcss) return table;
  return close_settings(table, {"inner-penumbra", "blocker-taps"});
}

SettingTable<HybridShadowConstants> hybrid_shadow_settings() {
  using C = HybridShadowConstants;
  return join_settings(
      settings_within(&C::map, shadow_map_settings(kShadowMapPcss)),
      {number_setting("soft-from", &C::soft_from, {0, kAny}, "m",
                      "to what casts the shadow, from which the map alone says", "Story 2015")});
}

SettingTable<EdgeShadowConstants> edge_shadow_settings() {
  using C = EdgeShadowConstants;
  const SettingTable<ShadowMapConstants> map = close_settings(
      shadow_map_settings(kShadowMapPcf), {"grid", "survey-rule", "per-object", "blend"});
  return join_settings(settings_within(&C::map, map),
                       {number_setting("margin", &C::margin, {0, 64}, "texels",
                                       "that the map may be wrong; rays go to pixels so near to "
                                       "edges",
                                       "survey 4")});
}

SettingTable<GlassShadowConstants> glass_shadow_settings() {
  return {number_setting("tint", &GlassShadowConstants::tint, {0, 1}, "", kTint, kColored)};
}

SettingTable<GlassShadowMapConstants> glass_shadow_map_settings() {
  using C = GlassShadowMapConstants;
  const SettingTable<ShadowMapConstants> map = close_settings(
      shadow_map_settings(kShadowMapPcf),
      {"grid", "survey-rule", "tight", "per-object", "cascades", "blend", "split-share", "reach"});
  return join_settings(settings_within(&C::map, map),
                       {number_setting("tint", &C::tint, {0, 1}, "", kTint, kColored)});
}

SettingTable<FilteredShadowMapConstants> filtered_shadow_map_settings(
    FilteredShadowMapMethod method) {
  using C = FilteredShadowMapConstants;
  const bool is_twice = method == kFilteredExponentialVariance;
  const SettingTable<ShadowMapConstants> map = close_settings(
      all_of_map(), {"receiver-plane", "grid", "inner-penumbra", "taps", "blocker-taps"});
  SettingTable<C> table = join_settings(
      settings_within(&C::map, map),
      {number_setting("exponent", &C::exponent, {1e-3, is_twice ? 42.0 : 87.0}, "",
                      "of the exponential, or of the front moments", "Annen et al. 2008"),
       number_setting("back-exponent", &C::back_exponent, {1e-3, 42}, "", "of the back moments",
                      "Lauritzen & McCool 2008"),
       count_setting("terms", &C::terms, {1, 16}, "", "of the series", "Annen et al. 2007"),
       number_setting("damping", &C::damping, {0, 20}, "", "of its last term: times exp(-damping)",
                      "Annen et al. 2007"),
       number_setting("reduce-bleeding", &C::reduce_bleeding, {0, 0.99}, "",
                      "visibility that counts as none", "Lauritzen & McCool 2008"),
       number_setting("least-variance", &C::least_variance, {0, 1}, "",
                      "of shares of the map's depth", "Donnelly & Lauritzen 2006"),
       number_setting("offset", &C::offset, {0, 1}, "half steps", "of surfaces against the series",
                      "Annen et al. 2007"),
       closed_setting(&C::level)});
  if (!is_twice && method != kFilteredExponential) table = close_settings(table, {"exponent"});
  if (!is_twice) table = close_settings(table, {"back-exponent"});
  const bool has_series = method == kFilteredConvolution || method == kFilteredPcssConvolution;
  if (!has_series) table = close_settings(table, {"terms", "damping", "offset"});
  const bool has_moments = method != kFilteredExponential && !has_series;
  if (has_moments) return table;
  return close_settings(table, {"reduce-bleeding", "least-variance"});
}

SettingTable<ContactShadowConstants> contact_shadow_settings() {
  using C = ContactShadowConstants;
  return {
      number_setting("length", &C::length, {0, 1e6}, "m", "of the rays; 0: everything is visible"),
      switch_setting("only-where-coarse", &C::only_where_coarse,
                     "rays end where penumbras get as wide as a texel of the light's map")};
}

SettingTable<LampShadowConstants> lamp_shadow_settings(LampShadow method) {
  using C = LampShadowConstants;
  const SettingTable<C> table = {
      closed_setting(&C::light),
      closed_setting(&C::method),
      count_setting("taps", &C::taps, {1, 1024}, "", "of the filter"),
      count_setting("blocker-taps", &C::blocker_taps, {1, 1024}, "",
                    "of the search for what casts the shadow", "Fernando 2005"),
      number_setting("near-plane", &C::near_plane, {1e-6, kAny}, "m",
                     "from the lamp, where the search supposes its map", "Fernando 2005"),
      number_setting("widest", &C::widest, {0, kAny}, "m", "radius of the filter, at most"),
      number_setting("soft-from", &C::soft_from, {0, kAny}, "m",
                     "to what casts the shadow, from which the map alone says", "Story 2015")};
  if (method == LampShadow::kHybrid) return table;
  if (method == LampShadow::kMapPcss) return close_settings(table, {"soft-from"});
  return close_settings(table, {"soft-from", "blocker-taps", "near-plane"});
}

SettingTable<ScreenSpaceShadowConstants> screen_space_shadow_settings() {
  using C = ScreenSpaceShadowConstants;
  return {number_setting("length", &C::length, {0, kInfinite}, "m",
                         "of a march; 0: everything is visible"),
          number_setting("thickness", &C::thickness, {0, kInfinite}, "m",
                         "that everything is taken to reach back; 0: nothing hides"),
          number_setting("bias", &C::bias, {-1, 1}, "depths",
                         "that an occluder must stand above the receiver's plane"),
          number_setting("border", &C::border, {0, 1}, "widths",
                         "of the picture over which shadows fade"),
          count_setting("steps", &C::steps, {1, 1024}, "", "of the march with the largest ones"),
          count_setting("marches", &C::marches, {1, 4}, "",
                        "each with steps 1.618 times smaller than the one before"),
          count_setting("threshold", &C::threshold, {1, 4}, "", "marches that must hit"),
          number_setting("spread", &C::spread, {0, 16}, "pixels",
                         "to four more places beside a point of the ray; 0: only its own"),
          switch_setting(
              "noise", &C::noise,
              "points vary from pixel to pixel; off: the same everywhere, which shows bands"),
          closed_setting(&C::toward_sun)};  // a row of its own
}

SettingTable<AdaptiveShadowConstants> adaptive_shadow_settings() {
  using C = AdaptiveShadowConstants;
  return {
      number_setting("target", &C::target, {0, 1}, "",
                     "variation from which on a pixel gets one more ray", kAdaptive),
      number_setting("facing-depth", &C::facing_depth, {0, 1}, "depths",
                     "change within a surface seen from its front", kAdaptive),
      number_setting("grazing-depth", &C::grazing_depth, {0, 1}, "depths", "and along it",
                     kAdaptive),
      number_setting("filter-variation", &C::filter_variation, {0, 1}, "",
                     "from which on 9 x 9 pixels are averaged; less, fewer", kAdaptive),
      number_setting("budget", &C::budget, {0, 1}, "",
                     "mean variation from which on counts go down to 1; 0: there is no limit",
                     kAdaptive),
      closed_setting(&C::flags),  // of which these are all
      bits_setting("released-history", &C::flags, kAdaptiveReleasedHistory,
                   "variation is that of this frame and the three before it, as in the released "
                   "code",
                   kAdaptive),
      bits_setting("released-shift", &C::flags, kAdaptiveReleasedShift,
                   "the newest variation takes the place of all older ones, as in the released "
                   "code",
                   kAdaptive),
      bits_setting("released-low-pass", &C::flags, kAdaptiveReleasedLowPass,
                   "a box of 9 pixels in place of the tent of 13, as in the released code",
                   kAdaptive),
      bits_setting("uniform", &C::flags, kAdaptiveUniform, "all pixels take the most rays"),
      bits_setting("unfiltered", &C::flags, kAdaptiveUnfiltered,
                   "neighbours are not averaged, frames still are"),
      closed_setting(&C::light),  // the sun
      closed_setting(&C::frame_count)};
}

}  // namespace kaamos::effects

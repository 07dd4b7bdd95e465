// SPDX-License-Identifier: MIT
#include "effects/reflections/settings.h"

#include <string>
#include <vector>

namespace kaamos::effects {

namespace {

constexpr double kFar = 1e6;       // metres
constexpr double kEndless = 1e30;  // metres
constexpr const char* kControl = "Control, survey 6.5";
const std::vector<std::string> kSunAtHits = {"none", "ray", "map"};

template <class Constants>
SettingOf<Constants> sun_at_hits() {
  return word_setting("sun-at-hits", &Constants::sun_at_hits, kSunAtHits,
                      "the sun where rays hit: a shadow ray, a map of the whole scene, or none");
}

template <class Constants>
SettingTable<Constants> ray_lengths() {
  return {
      number_setting("longest", &Constants::longest, {0, kEndless}, "m",
                     "length of the rays of a mirror", kControl),
      number_setting("shortest", &Constants::shortest, {0, kEndless}, "m",
                     "the same at roughness 1; in between, lengths fall exponentially", kControl),
      number_setting("length-jitter", &Constants::length_jitter, {0, 1}, "lengths",
                     "that vary from ray to ray", kControl)};
}

}  // namespace

SettingTable<ReflectionConstants> reflection_settings() {
  using C = ReflectionConstants;
  return join_settings(
      ray_lengths<C>(),
      {number_setting("firefly-limit", &C::firefly_limit, {0, 1e30}, "whites",
                      "that a sample is clamped to (the talk: 10); 0: none", "GDC 2018 talk"),
       sun_at_hits<C>(),
       switch_setting("single-length", &C::single_length, "the longest at every roughness"),
       word_setting("fireflies", &C::fireflies, {"keep", "retrace", "average"},
                    "samples brighter than twice white: kept, more rays where a pilot ray is "
                    "bright (keeps the energy), or where the sample is (loses some)",
                    "GDC 2018 talk"),
       count_setting("more-rays", &C::more_rays, {1, 1024}, "",
                     "with which a bright sample is averaged", "GDC 2018 talk")});
}

SettingTable<ScreenReflectionConstants> screen_reflection_settings() {
  using C = ScreenReflectionConstants;
  return join_settings(
      ray_lengths<C>(),
      {word_setting("march", &C::march, {"metres", "pixels", "line"},
                    "where samples are: at equal distances, at pixels of the ray, or a fixed "
                    "number up to the picture's edge",
                    "survey 6.2; McGuire & Mara 2014; GDC 2018 talk"),
       count_setting("steps", &C::steps, {1, double{kMostScreenSteps}}, "", "samples of a ray"),
       count_setting("refinements", &C::refinements, {0, double{kMostScreenRefinements}}, "",
                     "halvings of the step in which a surface is crossed"),
       number_setting("stride", &C::stride, {1, 16384}, "pixels", "from sample to sample",
                      "McGuire & Mara 2014"),
       number_setting("thickness", &C::thickness, {0, kFar}, "m",
                      "that surfaces are taken to reach back"),
       number_setting("step-thickness", &C::step_thickness, {0, 1024}, "steps",
                      "depths of a step from sample to sample that they reach back besides"),
       number_setting("edge-fade", &C::edge_fade, {0, 1}, "pictures",
                      "at the edge, where hits fade to the fallback"),
       word_setting("source", &C::source, {"current-frame", "previous-frame"},
                    "whose light hits show"),
       word_setting("fallback", &C::fallback, {"none", "sky", "environment"},
                    "what rays without a hit show"),
       switch_setting("strict", &C::strict, "only hits that leave no doubt count")});
}

SettingTable<ScreenMaskConstants> screen_mask_settings() {
  using C = ScreenMaskConstants;
  return join_settings(
      settings_within(&C::screen, screen_reflection_settings()),
      {number_setting("roughest", &C::roughest, {0, 1}, "",
                      "rougher surfaces show what a miss shows"),
       switch_setting("march-blocks", &C::march_blocks,
                      "a march over blocks of 8 x 8 pixels decides too; off: roughness alone"),
       switch_setting("half-mask", &C::half_mask,
                      "marks around one pixel of four that meets something decide instead"),
       count_setting("dilation", &C::dilation, {0, 64}, "pixels",
                     "of half the resolution, that are marked to each side", "Wronski 2014")});
}

SettingTable<StochasticConstants> stochastic_settings() {
  using C = StochasticConstants;
  return join_settings(
      settings_within(&C::screen, screen_reflection_settings()),
      {choice_setting("neighbours", &C::neighbours, {"1", "4", "9"}, "rays that a pixel takes",
                      "Stachowiak 2015"),
       number_setting("tail", &C::tail, {1e-3, 1}, "lobes",
                      "that directions are drawn from; below 1 highlights lose tails",
                      "Stachowiak 2015")});
}

SettingTable<BlurredConstants> blurred_settings() {
  using C = BlurredConstants;
  return join_settings(settings_within(&C::screen, screen_reflection_settings()),
                       {number_setting("fresh", &C::fresh, {0, 1}, "",
                                       "weight of a new ray beside the frames before"),
                        number_setting("few-taps", &C::few_taps, {0, 1}, "roughness",
                                       "up to which 12 taps blur in place of mips"),
                        closed_setting(&C::has_history), closed_setting(&C::level)});
}

SettingTable<HybridConstants> hybrid_settings() {
  using C = HybridConstants;
  // Rays go on where the picture ends.
  const auto screen = close_settings(screen_reflection_settings(), {"fallback", "edge-fade"});
  return join_settings(
      settings_within(&C::screen, screen),
      {sun_at_hits<C>(), number_setting("roughest-screen", &C::roughest_screen, {0, 1}, "",
                                        "rougher surfaces are traced at once")});
}

SettingTable<TiledConstants> tiled_settings() {
  using C = TiledConstants;
  return join_settings(
      settings_within(&C::screen, close_settings(screen_reflection_settings(), {"edge-fade"})),
      {sun_at_hits<C>(),
       number_setting("roughest-screen", &C::roughest_screen, {0, 1}, "",
                      "rougher surfaces are traced at once"),
       number_setting("roughest-traced", &C::roughest_traced, {0, 1}, "",
                      "rougher surfaces show what a miss shows", "survey 6.2")});
}

SettingTable<PlanarConstants> planar_settings() {
  using C = PlanarConstants;
  SettingTable<C> out = {
      number_setting("longest", &C::longest, {0, kFar}, "m", "behind the plane that are seen",
                     kControl),
      sun_at_hits<C>(),
      word_setting("source", &C::source, {"rays", "draws"},
                   "of planes' pictures; they are the same, but for edges", "survey 6.1"),
      number_setting("roughest", &C::roughest, {0, 1}, "roughness",
                     "rougher surfaces are no planes"),
      count_setting("planes", &C::most_planes, {0, double{kMostMirrorPlanes}}, "",
                    "that are mirrored, those of most area and smoothness"),
      count_setting("taps", &C::taps, {1, 256}, "", "directions in which a rough plane looks"),
      closed_setting(&C::plane_count),
      closed_setting(&C::level),
      closed_setting(&C::draw),
      closed_setting(&C::clip_scale)};
  SettingOf<C> fallback = switch_setting(
      "environment", &C::fallback,
      "surfaces that are not flat show the environment map; off: they mirror nothing");
  constexpr std::uint32_t kEnvironment = 2;
  fallback.set = [](C& of, const SettingValue& value) {
    of.fallback = std::get<bool>(value) ? kEnvironment : 0;
  };
  out.push_back(std::move(fallback));
  out.push_back(closed_setting(&C::plane));
  for (const auto& [name, member] : {std::pair("width", &C::width), {"height", &C::height}}) {
    out.push_back(count_setting(name, member, {0, 16384}, "texels",
                                "of a plane's picture, at most the frame's; 0: the frame's"));
  }
  return out;
}

SettingTable<EnvironmentConstants> environment_settings() {
  using C = EnvironmentConstants;
  return {choice_setting("side", &C::side, {"16", "32", "64", "128", "256", "512", "1024"},
                         "texels along a face of the probe's cube"),
          count_setting("rays", &C::rays, {1, 65536}, "", "of each texel"),
          count_setting("directions", &C::directions, {1, 65536}, "",
                        "that a texel of a blurred level is the mean of"),
          count_setting("probes", &C::probes, {1, 64}, "",
                        "places that are found, at most, where the scene names none")};
}

}  // namespace kaamos::effects

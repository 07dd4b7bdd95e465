// SPDX-License-Identifier: MIT
#include "effects/occlusion/settings.h"

#include <utility>

namespace kaamos::effects {

namespace {

constexpr const char* kXeGtao = "XeGTAO 1.30, high quality";
constexpr const char* kHbao = "Bavoil, Sainz and Dimitrov 2008";
constexpr const char* kGtao = "Jimenez et al. 2016";

template <class Constants>
SettingOf<Constants> filter_passes() {
  return count_setting("filter-passes", &Constants::filter_passes, {0, 16}, "",
                       "passes that average neighbours; 0: the noise stays");
}

// Those of GTAO's paper by which pixels and frames share directions.
template <class C>
SettingTable<C> sharing_settings() {
  return {switch_setting("half-resolution", &C::half_resolution,
                         "one of each 2 x 2 pixels is looked at; each in turn where frames are "
                         "averaged",
                         kGtao),
          count_setting("rotations", &C::rotations, {0, 64}, "frames",
                        "after which the directions of 4 x 4 pixels repeat, the paper's 6; 0: not "
                        "by a tile",
                        kGtao),
          number_setting("fresh", &C::fresh, {0, 1}, "",
                         "least weight of a new frame in the mean over frames; 1: no mean", kGtao)};
}

}  // namespace

SettingTable<CrytekConstants> crytek_settings() {
  using C = CrytekConstants;
  return {filter_passes<C>(),
          count_setting("points", &C::samples, {2, 4096}, "", "in the sphere, in pairs",
                        "Mittring 2007"),
          closed_setting(&C::remap)};  // a row of its own
}

SettingTable<HemisphereConstants> hemisphere_settings() {
  using C = HemisphereConstants;
  return {
      filter_passes<C>(),
      count_setting("points", &C::samples, {1, 4096}, "", "in the hemisphere", "survey 7.1"),
      number_setting("bias", &C::bias, {0, 10}, "radii", "of depth", "survey 7.1"),
      closed_setting(&C::layers),  // a row of its own
      number_setting("separation", &C::separation, {0, 100}, "radii",
                     "of the second layer of depth from the first, at least", "Mara et al. 2016")};
}

SettingTable<HbaoConstants> hbao_settings() {
  using C = HbaoConstants;
  return join_settings(
      {filter_passes<C>(),
       count_setting("directions", &C::directions, {1, 1024}, "", "about each pixel", kHbao),
       count_setting("steps", &C::steps, {1, 1024}, "", "in each direction", kHbao),
       number_setting("angle-bias", &C::angle_bias, {0, 1.5708}, "rad",
                      "that horizons must rise above the surface", kHbao),
       number_setting("strength", &C::strength, {0, 100}, "", "factor on occlusion", kHbao),
       number_setting("most-pixels", &C::most_pixels, {1, 16384}, "pixels",
                      "that a march is long")},
      sharing_settings<C>());
}

SettingTable<GtaoConstants> gtao_settings() {
  using C = GtaoConstants;
  SettingTable<C> out = {
      filter_passes<C>(),
      count_setting("slices", &C::slices, {1, 1024}, "", "through the view ray of each pixel",
                    kXeGtao),
      count_setting("steps", &C::steps, {1, 1024}, "", "to each side of a slice", kXeGtao),
      number_setting("radius-multiplier", &C::radius_multiplier, {0, 100}, "", "on the radius",
                     kXeGtao),
      number_setting("falloff-range", &C::falloff_range, {0, 1}, "radii",
                     "last part of the radius over which occluders fade; 0: a hard end", kXeGtao),
      number_setting("sample-power", &C::sample_power, {0.01, 100}, "",
                     "above 1: more steps near the pixel", kXeGtao),
      number_setting("thin-occluder", &C::thin_occluder, {0, 0.7}, "",
                     "how much less occluders count that are deeper than wide", kXeGtao),
      number_setting("final-power", &C::final_power, {0.01, 100}, "", "on visibility", kXeGtao),
      number_setting("least", &C::least, {0, 1}, "", "visibility", kXeGtao),
      number_setting("least-pixels", &C::least_pixels, {0, 16384}, "pixels",
                     "that the first step goes", kXeGtao),
      number_setting("level-offset", &C::level_offset, {-128, 128}, "levels",
                     "larger: finer levels of the depth picture", kXeGtao),
      number_setting("normal-flattening", &C::normal_flattening, {0, 1}, "",
                     "part by which slices that the normal leaves are made up for", kXeGtao),
      switch_setting("noise", &C::noise,
                     "directions and steps vary from pixel to pixel; off: the same everywhere",
                     kXeGtao),
      number_setting("pull", &C::pull, {0, 1}, "depths", "by which a pixel moves nearer", kXeGtao)};
  return join_settings(
      join_settings(std::move(out), sharing_settings<C>()),
      {switch_setting("multibounce", &C::multibounce,
                      "occluders reflect light, as much as the surface itself", kGtao),
       switch_setting("bent-normals", &C::bent_normals, "light comes from the mean open direction",
                      kGtao)});
}

SettingTable<LineSweepSettings> line_sweep_settings() {
  return {count_setting("directions", &LineSweepSettings::directions, {1, 64}, "",
                        "of lines over the picture", "Timonen 2013")};
}

SettingTable<UniformOcclusionConstants> uniform_occlusion_settings() {
  return {switch_setting("survey-rule", &UniformOcclusionConstants::survey_rule,
                         "the survey's sum, which forgets the density of the directions",
                         "effects/SOURCES.md: E4")};
}

SettingTable<BakedAoConstants> baked_ao_settings() {
  using C = BakedAoConstants;
  return {
      number_setting("texel", &C::texel, {1e-6, 1e6}, "m",
                     "between texels along a triangle's edges"),
      count_setting("rays", &C::rays, {1, 65536}, "", "of a texel"),
      count_setting("most-texels", &C::most_texels, {1, 1 << 28}, "texels",
                    "of a scene besides one a triangle; where it had more, the texel is doubled")};
}

}  // namespace kaamos::effects

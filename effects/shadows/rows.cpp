// SPDX-License-Identifier: MIT
#include "effects/shadows/rows.h"

#include <fmt/format.h>

#include <utility>

#include "effects/shadows/adaptive_shadow/adaptive_shadow.h"
#include "effects/shadows/contact_shadow/contact_shadow.h"
#include "effects/shadows/edge_shadow/edge_shadow.h"
#include "effects/shadows/glass_shadow/glass_shadow.h"
#include "effects/shadows/glass_shadow/glass_shadow_map.h"
#include "effects/shadows/hybrid_shadow/hybrid_shadow.h"
#include "effects/shadows/lamp_shadow/lamp_shadow.h"
#include "effects/shadows/settings.h"
#include "effects/shadows/shadow_map/shadow_map.h"
#include "effects/shadows/sun_shadow/sun_shadow.h"

namespace kaamos::effects {

namespace {

// A row whose signal is called `layer`.
Effect shadow_map_row(const char* name, const char* about, const char* layer,
                      const ShadowMapConstants& constants) {
  Effect row = {.name = name, .about = about};
  row.library = {"shadows/shadow_map/shadow_map", shadow_map_library};
  row.make = make_shadow_map;
  row.more_libraries = {{"shadows/shadow_map/shadow_draws", shadow_draws_library}};
  row.signals = {
      {.name = layer, .channels = 1, .is_sum = false, .part = &FrameParts::sun_visibility}};
  set_constants(row, constants,
                shadow_map_settings(static_cast<ShadowMapMethod>(constants.method)));
  row.needs.sun = true;
  row.alternative_to = "sun";
  return row;
}

EffectStep step(const char* label, const ShadowMapConstants& constants) {
  return {label, EffectSettings().set_constants(constants)};
}

Effect sun_map_row() {
  Effect row = shadow_map_row("sun-map", "sun shadow by a depth map", "sun_map", {});
  row.steps = {step("1024 x 1024", {.size = 1024}), step("2048 x 2048", {.size = 2048}),
               step("4096 x 4096", {.size = 4096}), step("8192 x 8192", {.size = 8192})};
  row.misses = "penumbras, what is thinner than a texel, and contact, where its bias opens a gap";
  return row;
}

Effect sun_per_object_row() {
  const auto per_object = [](std::uint32_t size) {
    return ShadowMapConstants{.flags = kShadowMapPerObject, .size = size, .cascades = 1};
  };
  Effect row = shadow_map_row("sun-per-object", "sun shadow by a map, and one fitted to the hero",
                              "sun_per_object", per_object(2048));
  row.steps = {step("2 of 1024 x 1024", per_object(1024)),
               step("2 of 2048 x 2048", per_object(2048)),
               step("2 of 4096 x 4096", per_object(4096))};
  row.may_equal = "without a hero in the scene its second map is empty, and it is sun-map";
  row.misses = "what sun-map misses, beside the hero; where its map ends, shadows change at once";
  return row;
}

std::vector<EffectStep> adaptive_steps() {
  std::vector<EffectStep> out;
  for (const std::uint32_t rays : {kAdaptiveStandardSamples, kAdaptiveHighSamples, 16u}) {
    out.push_back({fmt::format("{} rays at most", rays),
                   EffectSettings{.samples = rays}.set_constants(AdaptiveShadowConstants{})});
  }
  return out;
}

constexpr std::uint32_t kPlane = kShadowMapReceiverPlane;
constexpr std::uint32_t kEdgeSamples = 16;

// Settings of maps whose lookups follow the receiver's plane.
ShadowMapConstants on_plane(std::uint32_t method, float radius, std::uint32_t taps) {
  return {.method = method,
          .flags = kPlane,
          .constant_bias = 0.5f,
          .slope_bias = 0.0f,
          .radius = radius,
          .taps = taps};
}

Effect sun_pcf_row() {
  const ShadowMapConstants defaults = on_plane(kShadowMapPcf, 0.03f, 16);
  Effect row = shadow_map_row("sun-pcf", "sun shadow by a map, filtered as wide everywhere",
                              "sun_pcf", defaults);
  ShadowMapConstants few = defaults, most = defaults;
  few.size = 1024;
  few.taps = 9;
  few.flags |= kShadowMapGrid;
  most.size = 4096;
  most.taps = 32;
  row.steps = {step("1024 x 1024, 3 x 3 taps", few), step("2048 x 2048, 16 taps", defaults),
               step("4096 x 4096, 32 taps", most)};
  row.misses = "how wide penumbras are, and thin things";
  return row;
}

Effect sun_pcss_row() {
  const ShadowMapConstants defaults = on_plane(kShadowMapPcss, 0.25f, 32);
  Effect row = shadow_map_row("sun-pcss", "sun shadow by a map, filtered as wide as the penumbra",
                              "sun_pcss", defaults);
  ShadowMapConstants few = defaults, most = defaults;
  few.size = 1024;
  few.taps = 25;
  most.size = 4096;
  most.taps = 64;
  most.blocker_taps = 36;
  row.steps = {step("1024 x 1024, 16 + 25 taps", few), step("2048 x 2048, 16 + 32 taps", defaults),
               step("4096 x 4096, 36 + 64 taps", most)};
  row.misses = "penumbras below things at several heights, and thin things";
  return row;
}

Effect sun_backprojection_row() {
  const auto backprojection = [](std::uint32_t rows) {
    return on_plane(kShadowMapBackprojection, 0.25f, rows);
  };
  Effect row =
      shadow_map_row("sun-backprojection", "sun shadow by what a map's texels hide of the sun",
                     "sun_backprojection", backprojection(16));
  row.steps = {step("8 x 8 texels", backprojection(8)), step("16 x 16 texels", backprojection(16)),
               step("32 x 32 texels", backprojection(32))};
  row.may_equal = "no penumbra here is as wide in the map as the smaller number of texels";
  row.misses = "what stands behind another thing, which the map does not have";
  return row;
}

Effect sun_cascades_row() {
  const ShadowMapConstants defaults = {.method = kShadowMapPcss,
                                       .flags = kPlane,
                                       .size = 1024,
                                       .cascades = 4,
                                       .constant_bias = 0.5f,
                                       .slope_bias = 0.0f,
                                       .radius = 0.25f,
                                       .taps = 32};
  Effect row = shadow_map_row("sun-cascades", "sun shadow by maps, finer ones near the camera",
                              "sun_cascades", defaults);
  ShadowMapConstants few = defaults, most = defaults;
  few.cascades = 2;
  few.taps = 25;
  most.size = 2048;
  most.taps = 64;
  most.blocker_taps = 36;
  row.steps = {step("2 of 1024 x 1024, 16 + 25 taps", few),
               step("4 of 1024 x 1024, 16 + 32 taps", defaults),
               step("4 of 2048 x 2048, 36 + 64 taps", most)};
  row.may_equal = "all that is seen lies in the last cascade, which is as sun-pcss's map";
  row.misses =
      "penumbras below things at several heights; seams where a cascade ends; off-screen hits";
  return row;
}

Effect sun_hybrid_row() {
  HybridShadowConstants defaults;
  defaults.map = on_plane(kShadowMapPcss, 0.25f, 32);
  Effect row =
      shadow_map_row("sun-hybrid", "sun shadow by a ray, and far from what casts it by a map",
                     "sun_hybrid", defaults.map);
  row.library = {"shadows/hybrid_shadow/hybrid_shadow", hybrid_shadow_library};
  row.make = make_hybrid_shadow;
  set_constants(row, defaults, hybrid_shadow_settings());
  HybridShadowConstants inner = defaults, most = defaults;
  inner.map.flags |= kShadowMapInnerPenumbra;
  most.map.size = 4096;
  most.map.taps = 64;
  most.map.blocker_taps = 36;
  row.steps = {{"2048 x 2048, inner penumbra", EffectSettings().set_constants(inner)},
               {"2048 x 2048, 16 + 32 taps", EffectSettings().set_constants(defaults)},
               {"4096 x 4096, 36 + 64 taps", EffectSettings().set_constants(most)}};
  row.may_equal = "far from what casts the shadows it is sun-pcss";
  row.misses = "penumbras near what casts them, and below things at several heights";
  return row;
}

Effect sun_edges_row() {
  EdgeShadowConstants defaults;
  defaults.map = on_plane(kShadowMapPcf, 0.25f, 32);
  Effect row = shadow_map_row("sun-edges", "sun shadow by rays where a map finds its edges",
                              "sun_edges", defaults.map);
  row.library = {"shadows/edge_shadow/edge_shadow", edge_shadow_library};
  row.make = make_edge_shadow;
  row.signals.push_back({.name = "sun_edges_places", .channels = 2, .output = 1, .is_sum = false});
  set_constants(row, defaults, edge_shadow_settings());
  row.defaults.samples = kEdgeSamples;
  row.samples_option = "sun-edges-samples";
  for (const std::uint32_t rays : {4u, kEdgeSamples, 64u}) {
    row.steps.push_back({fmt::format("2048 x 2048, {} rays at edges", rays),
                         EffectSettings{.samples = rays}.set_constants(defaults)});
  }
  row.misses = "what is thinner than a texel of its map, and what touches nearer than its bias";
  return row;
}

Effect glass_shadow_map_row() {
  const auto with = [](std::uint32_t size, std::uint32_t taps) {
    GlassShadowMapConstants constants;
    constants.map.size = size;
    constants.map.taps = taps;
    return EffectSettings().set_constants(constants);
  };
  Effect row = {.name = "glass-shadow-map", .about = "shadows of glass by a map of its colours"};
  row.library = {"shadows/glass_shadow/glass_shadow_map", glass_shadow_map_library};
  row.make = make_glass_shadow_map;
  row.signals = {{.name = "glass_shadow_map", .is_sum = false, .part = &FrameParts::sun_tint}};
  set_constants(row, GlassShadowMapConstants{}, glass_shadow_map_settings());
  row.needs = {.sun = true, .panes = true};
  row.alternative_to = "glass-shadow";
  row.steps = {{"512 x 512, 1 tap", with(512, 1)},
               {"1024 x 1024, 4 taps", with(1024, 4)},
               {"2048 x 2048, 16 taps", with(2048, 16)}};
  row.misses = "what stands between two panes, which gets the colour of both; wide penumbras";
  return row;
}

}  // namespace

Effect sun_shadow_row() {
  return {
      .name = "sun",
      .about = "sun shadow",
      .library = {"shadows/sun_shadow/sun_shadow", sun_shadow_library},
      .pass = sun_shadow_pass,
      .signals = {{.name = "sun",
                   .channels = 1,
                   .format = rtapi::Format::kR32Float,
                   .is_visibility = true,
                   .sharpness_output = 1,
                   .part = &FrameParts::sun_visibility}},
      .defaults = {.samples = kDefaultSunSamples},
      .needs = {.sun = true},
      .samples_option = "sun-samples",
      .is_plain = true,
      .repeats = true,
  };
}

Effect glass_shadow_row() {
  return {
      .name = "glass-shadow",
      .about = "coloured shadows of glass",
      .library = {"shadows/glass_shadow/glass_shadow", glass_shadow_library},
      .pass = glass_shadow_pass,
      .signals = {{.name = "glass_shadow", .part = &FrameParts::sun_tint}},
      .defaults =
          EffectSettings{.samples = kDefaultSunSamples}.set_constants(GlassShadowConstants{}),
      .needs = {.sun = true, .panes = true},
      .on_request = true,
      .constants = describe_constants(glass_shadow_settings()),
      .samples_option = "glass-shadow-samples",
      .misses = "penumbras of glass and of solid things that overlap: it multiplies their means",
  };
}

Effect contact_shadow_row() {
  return {
      .name = "contact",
      .about = "contact shadows of local lights",
      .library = {"shadows/contact_shadow/contact_shadow", contact_shadow_library},
      .pass = contact_shadow_pass,
      .signals = {{.name = "contact",
                   .channels = 2,
                   .output = 1,
                   .is_visibility = true,
                   .sharpness_output = 2}},
      .defaults = EffectSettings().set_constants(kContactAsNeeded),
      .needs = {.local_lights = true, .strongest_lights = true},
      .includes = "local",
      .constants = describe_constants(contact_shadow_settings()),
      .samples_option = "contact-samples",
      .repeats = true,
  };
}

Effect lamp_shadow_row() {
  return {
      .name = "lamp-shadow",
      .about = "shadow of one local light",
      .library = {"shadows/lamp_shadow/lamp_shadow", lamp_shadow_library},
      .pass = lamp_shadow_pass,
      .signals = {{.name = "lamp_shadow", .channels = 1, .output = 1, .is_sum = false}},
      .defaults = EffectSettings().set_constants(LampShadowConstants{}),
      .needs = {.local_lights = true, .lights = true},
  };
}

std::vector<Effect> shadow_alternatives() {
  std::vector<Effect> out = {
      {
          .name = "adaptive-sun",
          .about = "sun shadow with rays where it varies",
          .library = {"shadows/adaptive_shadow/adaptive_shadow", adaptive_shadow_library},
          .make = AdaptiveShadowPass::create,
          .signals = {{.name = "adaptive_sun",
                       .channels = 1,
                       .is_sum = false,
                       .part = &FrameParts::sun_visibility},
                      {.name = "adaptive_sun_rays", .output = 1, .is_sum = false}},
          .defaults = EffectSettings{.samples = kAdaptiveStandardSamples}.set_constants(
              AdaptiveShadowConstants{}),
          .needs = {.sun = true},
          .alternative_to = "sun",
          .constants = describe_constants(adaptive_shadow_settings()),
          .samples_option = "adaptive-sun-samples",
          .steps = adaptive_steps(),
          .has_history = true,
          .misses = "for up to four frames what moves, and thin shadows on calm ground",
      },
      sun_map_row(),
      sun_per_object_row(),
      sun_pcf_row(),
      sun_pcss_row(),
      sun_backprojection_row(),
      sun_cascades_row(),
      sun_hybrid_row(),
      sun_edges_row(),
      glass_shadow_map_row(),
  };
  for (const auto rows : {filtered_shadow_rows, screen_shadow_rows, lamp_shadow_rows}) {
    for (Effect& row : rows()) out.push_back(std::move(row));
  }
  return out;
}

}  // namespace kaamos::effects

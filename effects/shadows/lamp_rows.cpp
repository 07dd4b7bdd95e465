// SPDX-License-Identifier: MIT
// Shadows of each pixel's strongest lamps, whole, in place of their maps and contact shadows; and
// of all lamps.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "effects/shadows/contact_shadow/contact_shadow.h"
#include "effects/shadows/lamp_shadow/lamp_shadow.h"
#include "effects/shadows/lamp_visibility/lamp_visibility.h"
#include "effects/shadows/rows.h"
#include "effects/shadows/settings.h"

namespace kaamos::effects {

namespace {

constexpr float kToTheLamp = 1e6f;  // metres

// Makes what all rows share.
Effect row(const char* name, const char* about, const char* layer) {
  Effect out = {.name = name, .about = about};
  out.signals = {{.name = layer, .channels = 2, .output = 1}};
  out.needs = {.local_lights = true, .strongest_lights = true};
  out.alternative_to = "contact";
  out.includes = "local";
  out.shadows_alone = true;
  return out;
}

Effect map_row(const char* name, const char* about, const char* layer,
               const LampShadowConstants& constants) {
  Effect out = row(name, about, layer);
  out.library = {"shadows/lamp_shadow/lamp_shadow", lamp_shadow_library};
  out.pass = lamp_shadow_pass;
  out.signals.front().is_sum = false;
  out.needs.lights = true;
  set_constants(out, constants, lamp_shadow_settings(constants.method));
  return out;
}

// Searches of the filter's width and more and more taps of it.
void add_steps(Effect& row, const std::string& before) {
  for (const auto& [blockers, taps] : {std::pair(8u, 16u), {16u, 32u}, {36u, 64u}}) {
    auto constants = row.defaults.get_constants<LampShadowConstants>();
    constants.blocker_taps = blockers;
    constants.taps = taps;
    const bool searches = constants.method != LampShadow::kMapPcf;
    row.steps.push_back({before + (searches ? fmt::format("{} + {} taps", blockers, taps)
                                            : fmt::format("{} taps", taps)),
                         EffectSettings().set_constants(constants)});
  }
}

Effect pcf_row() {
  Effect out =
      map_row("lamp-pcf", "lamps' shadows by their maps, filtered as wide everywhere", "lamp_pcf",
              {.light = kStrongestLamps, .method = LampShadow::kMapPcf, .widest = 0.05f});
  add_steps(out, "");
  out.misses = "how wide penumbras are, contact, and what is thinner than a texel of 128 x 128";
  return out;
}

Effect pcss_row() {
  Effect out =
      map_row("lamp-pcss", "lamps' shadows by their maps, filtered as wide as the penumbra",
              "lamp_pcss", {.light = kStrongestLamps, .method = LampShadow::kMapPcss});
  add_steps(out, "");
  out.misses =
      "penumbras below things at several heights, contact, and what is thinner than a texel of "
      "128 x 128";
  return out;
}

Effect hybrid_row() {
  Effect out =
      map_row("lamp-hybrid", "lamps' shadows by a ray, and far from what casts them by a map",
              "lamp_hybrid", {.light = kStrongestLamps, .method = LampShadow::kHybrid});
  add_steps(out, "1 ray, ");
  out.misses = "penumbras near what casts them, and below things at several heights";
  return out;
}

Effect rays_row() {
  Effect out = row("lamp-rays", "lamps' shadows by rays up to them", "lamp_rays");
  out.library = {"shadows/contact_shadow/contact_shadow", contact_shadow_library};
  out.pass = contact_shadow_pass;
  out.signals.front().is_visibility = true;
  out.signals.front().sharpness_output = 2;
  out.samples_option = "lamp-rays-samples";
  set_constants(out, ContactShadowConstants{.length = kToTheLamp},
                close_settings(contact_shadow_settings(), {"length", "only-where-coarse"}));
  return out;
}

// All of them, not the strongest alone: it brings no main lighting along.
Effect visibility_row() {
  Effect out = {.name = "lamp-visibility", .about = "local lights, a hard shadow ray to each"};
  out.library = {"shadows/lamp_visibility/lamp_visibility", lamp_visibility_library};
  out.make = make_lamp_visibility;
  out.signals = {{.name = "lamp_visibility",
                  .is_sum = false,
                  .is_light = true,
                  .part = &FrameParts::local_lights}};
  out.needs = {.local_lights = true, .lights = true};
  out.alternative_to = "contact";
  out.shadows_alone = true;
  out.misses = "penumbras";
  return out;
}

}  // namespace

std::vector<Effect> lamp_shadow_rows() {
  return {pcf_row(), pcss_row(), hybrid_row(), rays_row(), visibility_row()};
}

}  // namespace kaamos::effects

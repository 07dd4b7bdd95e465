// SPDX-License-Identifier: MIT
// Chooses the settings of an effect that are measured, and the references for them.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "effects/glass/transparent/transparent.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/measure/curves/measure.h"
#include "effects/measure/curves/techniques.h"
#include "effects/reflections/traced/reflections.h"
#include "effects/shadows/contact_shadow/contact_shadow.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr float kNoEnd = 1e4f;  // metres: longer than any scene here

std::string count_label(std::uint32_t samples) {
  return fmt::format("{} {}", samples, samples == 1 ? "ray" : "rays");
}

void add_counts(MeasurePlan& plan, const std::string& group, Setting setting,
                std::initializer_list<std::uint32_t> counts, const std::string& reference) {
  for (const std::uint32_t count : counts) {
    setting.settings.samples = count;
    plan.settings.push_back({group, count_label(count), setting, reference});
  }
}

void add_single(MeasurePlan& plan, const std::string& group, const std::string& label,
                Setting setting, std::uint32_t samples, const std::string& reference) {
  setting.settings.samples = samples;
  plan.settings.push_back({group, label, setting, reference, false});
}

MeasurePlan ambient_occlusion_plan(const Options& options) {
  MeasurePlan plan{.title = "Ambient occlusion", .signal = "visibility", .effects = {"ao"}};
  Setting setting = setting_of("ao");
  setting.settings.radius = options.effects.at("ao").radius;
  plan.references = {{"ao", fmt::format("rays of {} m", setting.settings.radius), setting}};
  add_counts(plan, "rays per pixel", setting, {1, 2, 4, 8, 16, 64}, "ao");
  return plan;
}

MeasurePlan sun_plan() {
  MeasurePlan plan{.title = "Sun shadow", .signal = "visibility", .effects = {"sun"}};
  const Setting setting = setting_of("sun");
  plan.references = {{"sun", "rays to the sun's disk", setting}};
  add_counts(plan, "rays per pixel", setting, {1, 2, 4, 8, 16, 32, 64}, "sun");
  return plan;
}

MeasurePlan contact_plan(const Options& options) {
  MeasurePlan plan{.title = "Contact shadows", .signal = "visibility of the two strongest lights"};
  plan.effects = {"local", "contact"};
  // The length is exactly this one: what the maps could show besides is part of what is measured.
  const auto with_length = [](Setting of, float metres) {
    of.settings.set_constants(ContactShadowConstants{metres});
    return of;
  };
  const EffectSettings& chosen = options.effects.at("contact");
  const float length = chosen.get_constants<ContactShadowConstants>().length;
  const Setting setting = with_length({.effect = "contact", .settings = chosen}, length);
  Setting lit = setting;
  lit.lit = true;
  lit.settings.samples = 16;
  const std::string group = fmt::format("rays of {} m", length);
  plan.references = {
      {"contact", group, setting},
      {"contact-light", "the lights' radiance with rays up to them", with_length(lit, kNoEnd)}};
  plan.references.back().light = true;
  add_counts(plan, group, setting, {1, 2, 4, 8, 16, 32, 64}, "contact");
  for (const float metres : {0.0f, 0.25f, 0.5f, 1.0f, 2.0f, 4.0f}) {
    plan.settings.push_back({"light, 16 rays by length",
                             metres > 0 ? fmt::format("{} m", metres) : "shadow maps only",
                             with_length(lit, metres), "contact-light"});
  }
  return plan;
}

MeasurePlan reflections_plan(const Options& options) {
  MeasurePlan plan{.title = "Reflections", .signal = "radiance over the specular albedo"};
  plan.effects = {"reflections"};
  Setting setting = setting_of("reflections");
  setting.change<ReflectionConstants>(
      [](auto& constants) { constants.fireflies = Fireflies::kKeep; });
  Setting whole = setting;
  whole.change<ReflectionConstants>([](auto& constants) { constants.single_length = 1; });
  plan.references = {{"reflections", "rays of 200 m to 3 m by roughness", setting, true},
                     {"reflections-200m", "all rays 200 m long", whole, true}};
  add_counts(plan, "rays per pixel", setting, {1, 2, 4, 8, 16, 64}, "reflections");
  const std::string lengths = "16 rays, against 200 m";
  add_single(plan, lengths, "length by roughness", setting, 16, "reflections-200m");
  add_single(plan, lengths, "200 m", whole, 16, "reflections-200m");
  const std::string fireflies = "1 ray, fireflies";
  for (const auto& [label, choice] : {std::pair("kept", Fireflies::kKeep),
                                      std::pair("traced again by a pilot", Fireflies::kRetrace),
                                      std::pair("averaged", Fireflies::kAverage)}) {
    Setting chosen = setting;
    chosen.change<ReflectionConstants>([&](auto& constants) { constants.fireflies = choice; });
    add_single(plan, fireflies, label, chosen, 1, "reflections");
  }
  std::vector<float> limits = {2, 10, 50};
  const float wanted =
      options.effects.at("reflections").get_constants<ReflectionConstants>().firefly_limit;
  if (wanted > 0) limits = {wanted};
  for (const float limit : limits) {
    Setting chosen = setting;
    chosen.change<ReflectionConstants>([&](auto& constants) { constants.firefly_limit = limit; });
    add_single(plan, fireflies, fmt::format("clamped to {} x white", limit), chosen, 1,
               "reflections");
  }
  return plan;
}

MeasurePlan indirect_plan() {
  MeasurePlan plan{.title = "Indirect diffuse light", .signal = "irradiance over pi"};
  plan.effects = {"ao", "gi"};
  const auto with = [](IndirectMode mode, float length = IndirectConstants().length) {
    Setting setting = setting_of("gi");
    setting.change<IndirectConstants>([&](auto& constants) {
      constants.mode = mode;
      constants.length = length;
    });
    return setting;
  };
  const Setting near_field = with(IndirectMode::kNearField);
  const Setting whole = with(IndirectMode::kNearFieldGlossy, kNoEnd);
  const Setting direct = with(IndirectMode::kDirect);
  plan.references = {
      {"gi", fmt::format("near-field rays of {} m", IndirectConstants().length), near_field, true},
      {"gi-whole", "rays that end at the first hit, which is lit", whole, true}};
  add_counts(plan, "near-field, rays per pixel", near_field, {1, 2, 4, 8, 16, 64}, "gi");
  const std::string modes = "modes, against rays to the hit";
  add_single(plan, modes, "volume at the surface", direct, 1, "gi-whole");
  Setting occluded = direct;
  occluded.times_ao = 16;
  add_single(plan, modes, "the same x AO of 16 rays", occluded, 1, "gi-whole");
  add_single(plan, modes, "hit = black, 16 rays", with(IndirectMode::kHitBlack), 16, "gi-whole");
  add_single(plan, modes, "near-field, 16 rays", near_field, 16, "gi-whole");
  add_single(plan, modes, "near-field with glossy hits, 16 rays",
             with(IndirectMode::kNearFieldGlossy), 16, "gi-whole");
  add_single(plan, modes, "rays to the hit, 16", whole, 16, "gi-whole");
  return plan;
}

MeasurePlan transparent_plan() {
  MeasurePlan plan{.title = "Glass", .signal = "radiance of pixels that glass covers"};
  plan.effects = {"ao", "sun", "transparent"};
  plan.glass = true;
  const auto with = [](const TransparentConstants& constants) {
    Setting setting = setting_of("transparent");
    setting.settings.set_constants(constants);
    return setting;
  };
  plan.references = {{"glass", "every layer in its order and with its reflection",
                      with(sorted_reference()), true, true}};
  for (const std::uint32_t layers : {0u, 1u, 2u, 3u, 8u}) {
    plan.settings.push_back({"layers that reflect, the rest blended",
                             fmt::format("{} {}", layers, layers == 1 ? "layer" : "layers"),
                             with(deck_layers(layers)), "glass"});
  }
  struct Weight {
    const char* name;
    BlendWeight weight;
  };
  for (const Weight& weight : {Weight{"all alike", BlendWeight::kNone},
                               {"square", BlendWeight::kSquare},
                               {"cube", BlendWeight::kCube},
                               {"far", BlendWeight::kFar},
                               {"depth", BlendWeight::kDepth}}) {
    TransparentConstants constants = deck_layers(1);
    constants.weight = weight.weight;
    add_single(plan, "1 layer, weights of the rest", weight.name, with(constants), 1, "glass");
  }
  return plan;
}

MeasurePlan full_plan(const Options& options);

// Each setting is held against rays of its own radius.
void match_radius(MeasurePlan& plan) {
  for (MeasuredSetting& each : plan.settings) {
    each.reference = radius_reference(each.setting.settings.radius, plan);
  }
  std::erase_if(plan.references, [&](const MeasurePlan::Reference& reference) {
    return std::none_of(plan.settings.begin(), plan.settings.end(),
                        [&](const auto& each) { return each.reference == reference.name; });
  });
}

// For an effect without a plan of its own: against the rays that it is an alternative to, else
// against what its own samples converge to.
MeasurePlan technique_plan(const Options& options) {
  const Effect& row = *find_effect(northlight_effects(), options.measure);
  MeasurePlan plan;
  if (row.alternative_to.empty()) {
    const EffectSignal& signal = row.signals.front();
    plan.signal = signal.name;
    plan.references = {{row.name, row.about, setting_of(row.name), signal.is_light}};
  } else {
    Options own = options;
    own.measure = row.alternative_to;
    plan = full_plan(own);
    plan.settings.clear();
    // All light of the lamps, not the visibility of the strongest.
    if (row.signals.front().part == &FrameParts::local_lights) {
      std::erase_if(plan.references, [](const auto& each) { return !each.light; });
      plan.signal = "radiance of the lamps";
    }
    plan.references.resize(1);
  }
  plan.title = row.about;
  plan.title.front() = static_cast<char>(std::toupper(plan.title.front()));
  plan.effects.push_back(row.name);
  add_technique(row, options, plan);
  if (row.alternative_to == "ao") match_radius(plan);
  return plan;
}

MeasurePlan full_plan(const Options& options) {
  if (options.measure == "ao") return ambient_occlusion_plan(options);
  if (options.measure == "sun") return sun_plan();
  if (options.measure == "contact") return contact_plan(options);
  if (options.measure == "reflections") return reflections_plan(options);
  if (options.measure == "gi") return indirect_plan();
  if (options.measure == "transparent") return transparent_plan();
  return technique_plan(options);
}

}  // namespace

std::vector<std::string> measured_effects() {
  std::vector<std::string> out;
  for (const Effect& effect : northlight_effects()) {
    if (effect.pass || effect.make) out.push_back(effect.name);
  }
  out.push_back("frame");
  out.push_back("svgf");
  return out;
}

bool measures_glass(const std::string& name) {
  const Effect* effect = find_effect(northlight_effects(), name);
  return effect != nullptr && (effect->needs.glass || effect->needs.panes);
}

bool measures_panes(const std::string& name) {
  const Effect* effect = find_effect(northlight_effects(), name);
  return effect != nullptr && effect->needs.panes;
}

std::pair<std::uint32_t, std::uint32_t> default_measure_size(const std::string& effect) {
  if (measures_glass(effect)) return {320, 180};
  if (effect == "frame") return {160, 90};
  return {96, 54};  // all at the same size: denoisers are compared with the effects' references
}

MeasurePlan measure_plan(const Options& options) {
  MeasurePlan plan = full_plan(options);
  if (options.quick) keep_three_of_each(plan);
  return plan;
}

}  // namespace kaamos::measure

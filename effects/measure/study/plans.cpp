// SPDX-License-Identifier: MIT
#include "effects/measure/study/plans.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "effects/shadows/contact_shadow/contact_shadow.h"
#include "effects/shadows/screen_space_shadow/screen_space_shadow.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr std::size_t kQuickSteps = 3;

std::vector<EffectStep> steps_of(const Effect& row) {
  if (!row.steps.empty()) return row.steps;
  if (row.samples_option.empty()) return {{"as it is by default", row.defaults}};
  std::vector<EffectStep> out;
  for (const std::uint32_t count : {1u, 2u, 4u, 8u, 16u, 64u}) {
    EffectSettings settings = row.defaults;
    settings.samples = count;
    out.push_back({fmt::format("{} {}", count, count == 1 ? "ray" : "rays"), settings});
  }
  return out;
}

// The first, the middle and the last.
std::vector<EffectStep> three_of(const std::vector<EffectStep>& steps) {
  if (steps.size() <= kQuickSteps) return steps;
  return {steps.front(), steps[(steps.size() - 1) / 2], steps.back()};
}

// The modes of indirect light are techniques of their own.
void name_modes(MeasurePlan& plan) {
  for (MeasuredSetting& each : plan.settings) {
    if (each.steps) continue;
    each.group = each.label;
    each.label =
        fmt::format("{} rays", std::max(each.setting.settings.samples, each.setting.times_ao));
    each.steps = true;
  }
}

// Marches and rays look equally far.
void match_length(const Setting& reference, Setting& setting) {
  const auto rays = reference.settings.get_constants<ContactShadowConstants>();
  const float length = rays.length;
  if (setting.effect == reference.effect) {
    setting.change<ContactShadowConstants>([&](auto& constants) { constants = rays; });
  } else {
    setting.change<ScreenSpaceShadowConstants>([&](auto& constants) { constants.length = length; });
  }
}

// What is found in the picture has a radius of its own, within which it is best: the same settings
// over larger and smaller ones, up to that of the rays.
void sweep_radius(const Effect& row, const Options& options, bool quick, MeasurePlan& plan) {
  const float longest = plan.references.front().setting.settings.radius;
  const float own = options.effects.at(row.name).radius;
  if (row.steps.empty() || own >= longest || plan.settings.empty()) return;
  MeasuredSetting middle = plan.settings.back();
  const EffectStep& step = row.steps[(row.steps.size() - 1) / 2];
  middle.setting.settings = step.settings;
  for (const float part : quick ? std::vector{4.0f} : std::vector{0.5f, 2.0f, 4.0f, 8.0f}) {
    const float radius = part * own;
    if (radius > longest) break;
    middle.setting.settings.radius = radius;
    middle.label = fmt::format("{}, {:g} m", step.label, radius);
    plan.settings.push_back(middle);
  }
}

bool belongs_to(const Effect& row, const StudyFamily& family) {
  return row.name == family.effect || row.alternative_to == family.effect;
}

}  // namespace

const std::vector<StudyFamily>& study_families() {
  static const std::vector<StudyFamily> families = {{"shadows", "Shadows of the sun", "sun"},
                                                    {"contact", "Contact shadows", "contact"},
                                                    {"ao", "Ambient occlusion", "ao"},
                                                    {"reflections", "Reflections", "reflections"},
                                                    {"indirect", "Indirect diffuse light", "gi"},
                                                    {"denoise", "Denoising", ""}};
  return families;
}

std::vector<std::string> study_family_names() {
  std::vector<std::string> out;
  for (const StudyFamily& family : study_families()) out.push_back(family.name);
  out.push_back("claims");
  return out;
}

MeasurePlan study_plan(const StudyFamily& family, const Options& options, bool quick) {
  Options own = options;
  own.measure = family.effect;
  MeasurePlan plan = measure_plan(own);
  plan.title = family.title;
  plan.against_truth = true;
  if (family.effect == "gi") {
    name_modes(plan);
  } else {
    plan.settings.clear();
    plan.references.resize(1);
  }
  for (const Effect& row : northlight_effects()) {
    if (!belongs_to(row, family)) continue;
    if (row.name != family.effect) plan.effects.push_back(row.name);
    if (row.name == "gi") continue;
    const std::vector<EffectStep> all = steps_of(row);
    for (const EffectStep& step : quick ? three_of(all) : all) {
      MeasuredSetting setting{row.about, step.label};
      setting.setting.effect = row.name;
      setting.setting.settings = step.settings;
      setting.reference = plan.references.front().name;
      // The radius that the options want: rays and what is found in the picture have one each.
      setting.setting.settings.radius = options.effects.at(row.name).radius;
      if (family.effect == "contact")
        match_length(plan.references.front().setting, setting.setting);
      plan.settings.push_back(setting);
    }
    if (family.effect == "ao") sweep_radius(row, options, quick, plan);
  }
  if (!options.rows.empty()) {
    std::erase_if(plan.settings, [&](const MeasuredSetting& each) {
      return std::count(options.rows.begin(), options.rows.end(), row_name(each)) == 0;
    });
  }
  return plan;
}

std::string row_name(const MeasuredSetting& setting) {
  const std::string& effect = setting.setting.effect;
  const bool is_whole_row = find_effect(northlight_effects(), effect)->about == setting.group;
  return effect + "/" + (is_whole_row ? "" : setting.group + "/") + setting.label;
}

std::string what_it_misses(const std::string& group) {
  for (const Effect& row : northlight_effects()) {
    if (row.about == group) return row.misses;
  }
  return {};
}

}  // namespace kaamos::measure

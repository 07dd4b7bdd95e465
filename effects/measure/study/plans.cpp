// SPDX-License-Identifier: MIT
#include "effects/measure/study/plans.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <set>
#include <utility>

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
template <class T>
std::vector<T> three_of(const std::vector<T>& steps) {
  if (steps.size() <= kQuickSteps) return steps;
  return {steps.front(), steps[(steps.size() - 1) / 2], steps.back()};
}

// Three settings of each group.
void keep_three(MeasurePlan& plan) {
  std::map<std::string, std::vector<std::size_t>> by_group;
  for (std::size_t i = 0; i < plan.settings.size(); ++i) {
    by_group[plan.settings[i].group].push_back(i);
  }
  std::set<std::size_t> kept;
  for (const auto& [group, places] : by_group) {
    for (const std::size_t place : three_of(places)) kept.insert(place);
  }
  std::vector<MeasuredSetting> settings = std::exchange(plan.settings, {});
  for (const std::size_t place : kept) plan.settings.push_back(std::move(settings[place]));
}

// The modes of indirect light are techniques of their own; of those that are there twice the first
// stays.
void name_modes(MeasurePlan& plan) {
  for (MeasuredSetting& each : plan.settings) {
    if (each.steps) continue;
    each.group = each.label;
    each.label =
        fmt::format("{} rays", std::max(each.setting.settings.samples, each.setting.times_ao));
    each.steps = true;
  }
  std::vector<MeasuredSetting> settings = std::exchange(plan.settings, {});
  std::set<std::uint64_t> seen;
  for (MeasuredSetting& each : settings) {
    Checksum checksum;
    add_setting(checksum, each.setting);
    if (!seen.insert(checksum.value()).second) continue;
    plan.settings.push_back(std::move(each));
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

constexpr float kRadii[] = {0.25f, 0.5f, 1.0f, 2.0f, 4.0f};  // metres

std::string radius_label(float radius) {
  return fmt::format("{:g} m", radius);
}

// The reference of rays of this radius; the plan gets it where it has none.
std::string radius_reference(float radius, MeasurePlan& plan) {
  const MeasurePlan::Reference first = plan.references.front();
  if (radius == first.setting.settings.radius) return first.name;
  MeasurePlan::Reference wanted = first;
  wanted.name = fmt::format("{}-{:g}m", first.name, radius);
  wanted.about = fmt::format("rays of {}", radius_label(radius));
  wanted.setting.settings.radius = radius;
  const auto is_same = [&](const MeasurePlan::Reference& each) { return each.name == wanted.name; };
  if (std::none_of(plan.references.begin(), plan.references.end(), is_same)) {
    plan.references.push_back(wanted);
  }
  return wanted.name;
}

// Asks the question of a setting again for another radius.
void ask_within(float radius, MeasuredSetting setting, MeasurePlan& plan) {
  setting.setting.settings.radius = radius;
  setting.reference = radius_reference(radius, plan);
  setting.label += ", " + radius_label(radius);
  plan.settings.push_back(setting);
}

// What is found in the picture has a radius of its own, within which it is at its best: it is held
// against rays of that radius, and rays are measured there too. Besides, one setting of each over
// larger and smaller ones.
void sweep_radii(const Options& options, bool quick, MeasurePlan& plan) {
  const float longest = plan.references.front().setting.settings.radius;
  std::set<float> radii;
  const std::vector<MeasuredSetting> settings = std::exchange(plan.settings, {});
  for (const MeasuredSetting& each : settings) {
    const float own = options.effects.at(each.setting.effect).radius;
    if (own == longest) {
      plan.settings.push_back(each);
    } else {
      radii.insert(own);
    }
  }
  for (const float radius : radii) {
    for (const MeasuredSetting& each : settings) {
      const float own = options.effects.at(each.setting.effect).radius;
      if (own == radius || own == longest) ask_within(radius, each, plan);
    }
  }
  if (quick || radii.empty()) return;
  for (const float radius : kRadii) {
    if (radii.count(radius) != 0) continue;
    std::size_t first = 0;
    while (first < settings.size()) {
      std::size_t last = first;
      while (last < settings.size() && settings[last].group == settings[first].group) ++last;
      ask_within(radius, settings[first + (last - first - 1) / 2], plan);
      first = last;
    }
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
                                                    {"glass", "Glass", "transparent"},
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
  // These have groups of settings of their own.
  const auto has_groups = [](const std::string& effect) {
    return effect == "gi" || effect == "transparent";
  };
  if (has_groups(family.effect)) {
    if (family.effect == "gi") name_modes(plan);
    if (quick) keep_three(plan);
  } else {
    plan.settings.clear();
    plan.references.resize(1);
  }
  for (const Effect& row : northlight_effects()) {
    if (!belongs_to(row, family)) continue;
    if (row.name != family.effect) plan.effects.push_back(row.name);
    if (has_groups(row.name)) continue;
    const std::vector<EffectStep> all = steps_of(row);
    for (const EffectStep& step : quick ? three_of(all) : all) {
      MeasuredSetting setting{row.about, step.label};
      setting.setting.effect = row.name;
      setting.setting.settings = step.settings;
      setting.reference = plan.references.front().name;
      setting.setting.settings.radius = options.effects.at(row.name).radius;
      if (family.effect == "contact")
        match_length(plan.references.front().setting, setting.setting);
      plan.settings.push_back(setting);
    }
  }
  if (family.effect == "ao") sweep_radii(options, quick, plan);
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

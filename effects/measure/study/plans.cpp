// SPDX-License-Identifier: MIT
#include "effects/measure/study/plans.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "effects/measure/curves/techniques.h"
#include "effects/measure/study/sweep_plans.h"
#include "effects/shadows/contact_shadow/contact_shadow.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

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
    if (seen.insert(checksum.value()).second) plan.settings.push_back(std::move(each));
  }
}

constexpr float kRadii[] = {0.25f, 0.5f, 1.0f, 2.0f, 4.0f};  // metres

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

void keep_rows(const std::vector<std::string>& rows, MeasurePlan& plan) {
  if (rows.empty()) return;
  std::erase_if(plan.settings, [&](const MeasuredSetting& each) {
    return std::count(rows.begin(), rows.end(), row_name(each)) == 0;
  });
}

// Lamps without contact shadows.
void add_maps_alone(const Options& options, MeasurePlan& plan) {
  const Effect& row = *find_effect(northlight_effects(), "contact");
  MeasuredSetting maps{row.about, "no rays: the maps alone"};
  maps.setting = {.effect = row.name, .settings = options.effects.at(row.name), .lit = true};
  maps.setting.settings.set_constants(ContactShadowConstants{.length = 0});
  maps.reference = plan.references.front().name;
  plan.settings.push_back(std::move(maps));
}

bool belongs_to(const Effect& row, const StudyFamily& family) {
  // Short shadows are no question for what has whole ones.
  if (family.name == "contact" && row.shadows_alone) return false;
  // It dims the sky as "gtao" does; the direction that it adds is no part of what is measured here.
  if (row.name == "gtao-bent") return false;
  return row.name == family.effect || row.alternative_to == family.effect;
}

}  // namespace

const std::vector<StudyFamily>& study_families() {
  static const std::vector<StudyFamily> families = {
      {"shadows", "Shadows of the sun", "sun"},
      {"contact", "Contact shadows", "contact"},
      {"lamps", "Shadows of lamps", "contact"},
      {"ao", "Ambient occlusion", "ao"},
      {"reflections", "Reflections", "reflections"},
      {"indirect", "Indirect diffuse light", "gi"},
      {"glass", "Glass", "transparent"},
      {"glass-shadows", "Shadows of glass", "glass-shadow"},
      {"denoise", "Denoising", ""},
      {"upscaling", "Pixels that are traced", ""},
      {"antialiasing", "Antialiasing", ""}};
  return families;
}

std::vector<std::string> study_family_names() {
  std::vector<std::string> out;
  for (const StudyFamily& family : study_families()) out.push_back(family.name);
  out.push_back("figure-18");
  out.push_back("claims");
  for (const StudyFamily& sweep : study_sweeps()) out.push_back(sweep.name);
  out.push_back("sweeps");
  return out;
}

StudyPlan study_plan(const StudyFamily& family, const Options& options, bool quick) {
  if (family.is_sweep) {
    StudyPlan out = sweep_plan(family, options);
    if (quick) keep_three_of_each(out.plan);
    keep_rows(options.rows, out.plan);
    return out;
  }
  Options own = options;
  own.measure = family.effect;
  own.quick = false;  // all techniques together, further down
  MeasurePlan plan = measure_plan(own);
  plan.title = family.title;
  plan.against_truth = true;
  // These have groups of settings of their own.
  const auto has_groups = [](const std::string& effect) {
    return effect == "gi" || effect == "transparent";
  };
  if (has_groups(family.effect)) {
    if (family.effect == "gi") name_modes(plan);
  } else {
    plan.settings.clear();
    if (family.name == "lamps") {
      std::erase_if(plan.references, [](const auto& each) { return !each.light; });
      plan.signal = "radiance of the lamps";
      add_maps_alone(options, plan);
    }
    plan.references.resize(1);
  }
  for (const Effect& row : northlight_effects()) {
    if (!belongs_to(row, family)) continue;
    if (row.name != family.effect) plan.effects.push_back(row.name);
    if (!has_groups(row.name)) add_technique(row, options, plan);
  }
  if (quick) keep_three_of_each(plan);
  if (family.effect == "ao") sweep_radii(options, quick, plan);
  keep_rows(options.rows, plan);
  return {std::move(plan), {}};
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

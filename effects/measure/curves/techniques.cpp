// SPDX-License-Identifier: MIT
#include "effects/measure/curves/techniques.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "effects/shadows/contact_shadow/contact_shadow.h"
#include "effects/shadows/screen_space_shadow/screen_space_shadow.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

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

// Marches and rays look equally far.
void match_length(const Setting& reference, Setting& setting) {
  const auto rays = reference.settings.get_constants<ContactShadowConstants>();
  const float length = rays.length;
  if (find_effect(northlight_effects(), setting.effect)->shadows_alone) return;
  if (setting.effect == reference.effect) {
    setting.change<ContactShadowConstants>([&](auto& constants) { constants = rays; });
  } else {
    setting.change<ScreenSpaceShadowConstants>([&](auto& constants) { constants.length = length; });
  }
}

}  // namespace

void add_technique(const Effect& row, const Options& options, MeasurePlan& plan) {
  const MeasurePlan::Reference& reference = plan.references.front();
  for (const EffectStep& step : steps_of(row)) {
    MeasuredSetting out{row.about, step.label};
    out.setting.effect = row.name;
    out.setting.settings = step.settings;
    out.setting.settings.radius = options.effects.at(row.name).radius;
    out.reference = reference.name;
    out.setting.lit = reference.setting.lit;
    const bool is_short = reference.setting.effect == "contact" && !reference.setting.lit;
    if (is_short) match_length(reference.setting, out.setting);
    plan.settings.push_back(out);
  }
}

void keep_three_of_each(MeasurePlan& plan) {
  std::map<std::string, std::vector<std::size_t>> by_group;
  for (std::size_t i = 0; i < plan.settings.size(); ++i) {
    by_group[plan.settings[i].group].push_back(i);
  }
  std::set<std::size_t> kept;
  for (const auto& [group, places] : by_group) {
    kept.insert({places.front(), places[(places.size() - 1) / 2], places.back()});
  }
  std::vector<MeasuredSetting> settings = std::exchange(plan.settings, {});
  for (const std::size_t place : kept) plan.settings.push_back(std::move(settings[place]));
}

std::string radius_label(float radius) {
  return fmt::format("{:g} m", radius);
}

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

}  // namespace kaamos::measure

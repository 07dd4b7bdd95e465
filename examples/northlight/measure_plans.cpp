// SPDX-License-Identifier: MIT
// Which settings of an effect are measured, and against which reference. [effects-spec B8, E.3]
#include <fmt/format.h>

#include "measure.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

constexpr float kNoEnd = 1e4f;  // metres: longer than any scene here

std::string count_label(std::uint32_t samples) {
  return fmt::format("{} {}", samples, samples == 1 ? "ray" : "rays");
}

void add_counts(MeasurePlan& plan, const std::string& group, Setting setting,
                std::initializer_list<std::uint32_t> counts, const std::string& reference) {
  for (const std::uint32_t count : counts) {
    setting.samples = count;
    plan.settings.push_back({group, count_label(count), setting, reference});
  }
}

void add_single(MeasurePlan& plan, const std::string& group, const std::string& label,
                Setting setting, std::uint32_t samples, const std::string& reference) {
  setting.samples = samples;
  plan.settings.push_back({group, label, setting, reference, false});
}

MeasurePlan ambient_occlusion_plan(const Options& options) {
  MeasurePlan plan{.title = "Ambient occlusion", .signal = "visibility"};
  const Setting setting{.effect = Effect::kAo, .ao_radius = options.ao_radius};
  plan.references = {{"ao", fmt::format("rays of {} m", options.ao_radius), setting}};
  add_counts(plan, "rays per pixel", setting, {1, 2, 4, 8, 16, 64}, "ao");
  return plan;
}

MeasurePlan sun_plan() {
  MeasurePlan plan{.title = "Sun shadow", .signal = "visibility"};
  const Setting setting{.effect = Effect::kSun};
  plan.references = {{"sun", "rays to the sun's disk", setting}};
  add_counts(plan, "rays per pixel", setting, {1, 2, 4, 8, 16, 32, 64}, "sun");
  return plan;
}

MeasurePlan contact_plan(const Options& options) {
  MeasurePlan plan{.title = "Contact shadows", .signal = "visibility of the two strongest lights"};
  plan.needs.lights = true;
  Setting setting{.effect = Effect::kContact};
  setting.contact.length = options.contact_length;
  Setting lit = setting;
  lit.lit = true;
  lit.samples = 16;
  Setting whole = lit;
  whole.contact.length = kNoEnd;
  const std::string group = fmt::format("rays of {} m", options.contact_length);
  plan.references = {{"contact", group, setting},
                     {"contact-light", "the lights' radiance with rays up to them", whole}};
  plan.references.back().light = true;
  add_counts(plan, group, setting, {1, 2, 4, 8, 16, 32, 64}, "contact");
  for (const float length : {0.0f, 0.25f, 0.5f, 1.0f, 2.0f, 4.0f}) {
    lit.contact.length = length;
    plan.settings.push_back({"light, 16 rays by length",
                             length > 0 ? fmt::format("{} m", length) : "shadow maps only", lit,
                             "contact-light"});
  }
  return plan;
}

MeasurePlan reflections_plan(const Options& options) {
  MeasurePlan plan{.title = "Reflections", .signal = "radiance over the specular albedo"};
  plan.needs = {.lights = true, .volume = true};
  Setting setting{.effect = Effect::kReflections};
  Setting whole = setting;
  whole.reflection.single_length = 1;
  plan.references = {{"reflections", "rays of 200 m to 3 m by roughness", setting, true},
                     {"reflections-200m", "all rays 200 m long", whole, true}};
  add_counts(plan, "rays per pixel", setting, {1, 2, 4, 8, 16, 64}, "reflections");
  const std::string lengths = "16 rays, against 200 m";
  add_single(plan, lengths, "length by roughness", setting, 16, "reflections-200m");
  add_single(plan, lengths, "200 m", whole, 16, "reflections-200m");
  setting.samples = 4;
  std::vector<float> limits = {1, 2, 4, 8, 16, 64};
  if (options.firefly_limit > 0) limits = {options.firefly_limit};
  for (const float limit : limits) {
    setting.reflection.firefly_limit = limit;
    plan.settings.push_back(
        {"4 rays, samples clamped", fmt::format("to {}", limit), setting, "reflections"});
  }
  return plan;
}

MeasurePlan indirect_plan(const Options& options) {
  MeasurePlan plan{.title = "Indirect diffuse light", .signal = "irradiance over pi"};
  plan.needs = {.lights = true, .volume = true};
  Setting near_field{.effect = Effect::kGi};
  Setting whole = near_field;
  whole.indirect.mode = IndirectMode::kNearFieldGlossy;
  whole.indirect.length = kNoEnd;
  Setting glossy = near_field;
  glossy.indirect.mode = IndirectMode::kNearFieldGlossy;
  plan.references = {
      {"gi", fmt::format("near-field rays of {} m", near_field.indirect.length), near_field, true},
      {"gi-whole", "rays that end at the first hit, which is lit", whole, true}};
  add_counts(plan, "near-field, rays per pixel", near_field, {1, 2, 4, 8, 16, 64}, "gi");
  const std::string modes = "modes, against rays to the hit";
  Setting direct = near_field;
  direct.indirect.mode = IndirectMode::kDirect;
  Setting hit_black = near_field;
  hit_black.indirect.mode = IndirectMode::kHitBlack;
  add_single(plan, modes, "volume at the surface", direct, 1, "gi-whole");
  Setting occluded = direct;
  occluded.times_ao = 16;
  occluded.ao_radius = options.ao_radius;
  add_single(plan, modes, "the same x AO of 16 rays", occluded, 1, "gi-whole");
  add_single(plan, modes, "hit = black, 16 rays", hit_black, 16, "gi-whole");
  add_single(plan, modes, "near-field, 16 rays", near_field, 16, "gi-whole");
  add_single(plan, modes, "near-field with glossy hits, 16 rays", glossy, 16, "gi-whole");
  add_single(plan, modes, "rays to the hit, 16", whole, 16, "gi-whole");
  return plan;
}

MeasurePlan transparent_plan() {
  MeasurePlan plan{.title = "Glass", .signal = "radiance of pixels that glass covers"};
  plan.needs = {.lights = true, .volume = true, .glass = true};
  Setting setting{.effect = Effect::kTransparent};
  Setting sorted = setting;
  sorted.glass = sorted_reference();
  plan.references = {
      {"glass", "every layer in its order and with its reflection", sorted, true, true}};
  for (const std::uint32_t layers : {0u, 1u, 2u, 3u, 8u}) {
    setting.glass = deck_layers(layers);
    plan.settings.push_back({"layers that reflect, the rest blended",
                             fmt::format("{} {}", layers, layers == 1 ? "layer" : "layers"),
                             setting, "glass"});
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
    setting.glass = deck_layers(1);
    setting.glass.weight = weight.weight;
    add_single(plan, "1 layer, weights of the rest", weight.name, setting, 1, "glass");
  }
  return plan;
}

}  // namespace

const std::vector<std::string>& measured_effects() {
  static const std::vector<std::string> names = {"ao",          "sun", "contact", "reflections",
                                                 "transparent", "gi",  "svgf"};
  return names;
}

std::pair<std::uint32_t, std::uint32_t> default_measure_size(const std::string& effect) {
  if (effect == "transparent") return {320, 180};
  return {96, 54};  // all at the same size: denoisers are compared with the effects' references
}

MeasurePlan measure_plan(const Options& options) {
  if (options.measure == "ao") return ambient_occlusion_plan(options);
  if (options.measure == "sun") return sun_plan();
  if (options.measure == "contact") return contact_plan(options);
  if (options.measure == "reflections") return reflections_plan(options);
  if (options.measure == "gi") return indirect_plan(options);
  return transparent_plan();
}

}  // namespace northlight

// SPDX-License-Identifier: MIT
#include "effects/measure/study/sweep_plans.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "effects/measure/curves/techniques.h"
#include "effects/measure/study/sweep_light_plans.h"
#include "effects/measure/study/sweep_measures.h"
#include "effects/measure/study/sweep_parts.h"
#include "effects/occlusion/screen_space_ao/screen_space_ao.h"
#include "effects/shadows/shadow_map/shadow_map.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

// A map against rays to the sun's centre: what is dark and should not be, and the other way round.
StudyPlan bias_plan(const Options& options) {
  StudyPlan out;
  MeasurePlan& plan = out.plan = base_plan("sun", options);
  plan.title = "Bias of shadow maps: acne against gaps";
  plan.references.front() = {"sun-centre", "a ray to the sun's centre", setting_of("sun"), false,
                             true};
  plan.effects = {"sun", "sun-map"};
  plan.also = acne_and_gap;
  out.frames = {{[](Options& own, Scene&) { own.frame.sun_angular_radius = 0; }}};
  const Setting map = changed<ShadowMapConstants>(setting_of("sun-map"), [](auto& constants) {
    constants.constant_bias = constants.slope_bias = 0;
    constants.most_bias = 1e6f;
  });
  for (const float texels : {0.0f, 0.25f, 0.5f, 1.0f, 1.5f, 2.0f, 4.0f, 8.0f, 16.0f, 64.0f}) {
    add_to(plan, "constant bias", fmt::format("{:g} texels", texels),
           changed<ShadowMapConstants>(map, [&](auto& c) { c.constant_bias = texels; }));
  }
  for (const float texels : {0.0f, 0.5f, 1.0f, 1.5f, 2.0f, 4.0f, 8.0f}) {
    add_to(plan, "slope bias", fmt::format("{:g} texels", texels),
           changed<ShadowMapConstants>(map, [&](auto& c) { c.slope_bias = texels; }));
  }
  for (const float texels : {0.0f, 0.5f, 1.0f, 2.0f, 4.0f, 8.0f}) {
    add_to(plan, "offset along the normal", fmt::format("{:g} texels", texels),
           changed<ShadowMapConstants>(map, [&](auto& c) { c.normal_offset = texels; }));
  }
  return out;
}

StudyPlan pcss_plan(const Options& options) {
  StudyPlan out;
  MeasurePlan& plan = out.plan = base_plan("sun", options);
  plan.title = "PCSS: taps, and the size of its map";
  plan.against_truth = true;
  plan.effects.push_back("sun-pcss");
  const Setting pcss = setting_of("sun-pcss");
  for (const std::uint32_t taps : {1u, 4u, 9u, 16u, 32u, 64u}) {
    add_to(plan, "taps of the filter", counted(taps, "tap"),
           changed<ShadowMapConstants>(pcss, [&](auto& constants) { constants.taps = taps; }));
  }
  for (const std::uint32_t taps : {1u, 4u, 9u, 16u, 36u, 64u}) {
    add_to(
        plan, "taps of the search", counted(taps, "tap"),
        changed<ShadowMapConstants>(pcss, [&](auto& constants) { constants.blocker_taps = taps; }));
  }
  for (const std::uint32_t size : {256u, 512u, 1024u, 2048u, 4096u}) {
    add_to(plan, "size of the map", fmt::format("{0} x {0}", size),
           changed<ShadowMapConstants>(pcss, [&](auto& constants) { constants.size = size; }));
  }
  return out;
}

// Rays and what is found in the picture, each within its own radius against many rays of it.
StudyPlan radius_plan(const Options& options) {
  StudyPlan out;
  MeasurePlan& plan = out.plan = base_plan("ao", options);
  plan.title = "Ambient occlusion by radius";
  plan.also = means;
  for (const char* effect : {"ao", "gtao", "hbao"}) {
    if (effect != std::string("ao")) plan.effects.push_back(effect);
    for (const float radius : {0.25f, 0.5f, 1.0f, 2.0f, 4.0f, 8.0f, 16.0f, 1e4f}) {
      Setting setting = setting_of(effect);
      if (effect == std::string("ao")) setting.settings.samples = kQuietRays;
      setting.settings.radius = radius;
      add_to(plan, find_effect(northlight_effects(), effect)->about,
             radius >= 1e4f ? "no end" : radius_label(radius), setting);
      plan.settings.back().reference = radius_reference(radius, plan);
    }
  }
  return out;
}

StudyPlan hbao_plan(const Options& options) {
  StudyPlan out;
  MeasurePlan& plan = out.plan = base_plan("ao", options);
  plan.title = "HBAO by its angle bias";
  plan.also = means;
  plan.effects.push_back("hbao");
  const Setting hbao = setting_of("hbao");
  plan.references.front().setting.settings.radius = hbao.settings.radius;
  plan.references.front().about = "rays of " + radius_label(hbao.settings.radius);
  for (const int degrees : {0, 5, 10, 20, 30, 45, 60}) {
    add_to(plan, "horizon-based ambient occlusion", fmt::format("{} degrees", degrees),
           changed<HbaoConstants>(hbao, [&](auto& constants) {
             constants.angle_bias = glm::radians(static_cast<float>(degrees));
           }));
  }
  return out;
}

// Directions by the cosine and uniform ones; samples of one well spread sequence, or each drawn
// anew.
StudyPlan sampler_plan(const Options& options) {
  StudyPlan out;
  MeasurePlan& plan = out.plan = base_plan("ao", options);
  plan.title = "Ambient occlusion by its samples";
  plan.effects.push_back("ao-uniform");
  plan.references.front().setting.settings.radius = options.effects.at("ao").radius;
  for (const char* effect : {"ao", "ao-uniform"}) {
    for (const bool independent : {false, true}) {
      for (const std::uint32_t rays : {1u, 2u, 4u, 8u, 16u, 64u}) {
        Setting setting = setting_of(effect, rays);
        setting.settings.radius = options.effects.at("ao").radius;
        setting.independent = independent;
        add_to(plan,
               fmt::format("{}, {}", effect == std::string("ao") ? "cosine" : "uniform",
                           independent ? "white noise" : "Sobol over blue noise"),
               counted(rays, "ray"), setting);
      }
    }
  }
  return out;
}

// One pixel of each 2 x 2 with four times the rays, against every pixel.
StudyPlan resolution_plan(const Options& options) {
  StudyPlan out;
  MeasurePlan& plan = out.plan = base_plan("ao", options);
  plan.title = "Ambient occlusion: fewer pixels with more rays";
  const float radius = options.effects.at("ao").radius;
  plan.references.front().setting.settings.radius = radius;
  for (const std::uint32_t step : {1u, 2u}) {
    for (const std::uint32_t rays : {1u, 2u, 4u, 16u}) {
      Setting setting = setting_of("ao", rays * step * step);
      setting.settings.radius = radius;
      setting.settings.pixel_step = step;
      add_to(plan, step == 1 ? "every pixel" : "one of four pixels, upscaled",
             counted(rays * step * step, "ray"), setting);
    }
  }
  return out;
}

struct Sweep {
  StudyFamily family;
  StudyPlan (*plan)(const Options& options);  // null: it is none over single frames
};

StudyFamily sweep(const char* name, const char* title, const char* effect) {
  return {name, title, effect, true};
}

const std::vector<Sweep>& sweeps() {
  static const std::vector<Sweep> all = {
      {sweep("sweep-bias", "Sweep: bias of shadow maps", "sun"), bias_plan},
      {sweep("sweep-pcss", "Sweep: taps and size of PCSS", "sun"), pcss_plan},
      {sweep("sweep-ao-sampler", "Sweep: samples of ambient occlusion", "ao"), sampler_plan},
      {sweep("sweep-ao-radius", "Sweep: radius of ambient occlusion", "ao"), radius_plan},
      {sweep("sweep-hbao-bias", "Sweep: angle bias of HBAO", "ao"), hbao_plan},
      {sweep("sweep-resolution", "Sweep: pixels against rays", "ao"), resolution_plan},
      {sweep("sweep-ssr", "Sweep: stride and thickness of marches", "reflections"), ssr_sweep},
      {sweep("sweep-roughness", "Sweep: roughness", "reflections"), roughness_sweep},
      {sweep("sweep-voxel", "Sweep: cells of the volume", "gi"), voxel_sweep},
      {sweep("sweep-gi-length", "Sweep: length of rays of indirect light", "gi"), length_sweep},
      // Over sequences: they have no plan.
      {sweep("sweep-blend", "Sweep: weight of the new frame", ""), nullptr},
      {sweep("sweep-lag-switch", "Sweep: lag behind a light that goes out", ""), nullptr},
      {sweep("sweep-lag-move", "Sweep: lag behind a thing that goes away", ""), nullptr},
  };
  return all;
}

}  // namespace

const std::vector<StudyFamily>& study_sweeps() {
  static const std::vector<StudyFamily> families = [] {
    std::vector<StudyFamily> out;
    for (const Sweep& each : sweeps()) out.push_back(each.family);
    return out;
  }();
  return families;
}

StudyPlan sweep_plan(const StudyFamily& sweep, const Options& options) {
  const auto found = std::find_if(sweeps().begin(), sweeps().end(), [&](const Sweep& each) {
    return each.family.name == sweep.name;
  });
  return found->plan(options);
}

}  // namespace kaamos::measure

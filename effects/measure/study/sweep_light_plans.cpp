// SPDX-License-Identifier: MIT
#include "effects/measure/study/sweep_light_plans.h"

#include <fmt/format.h>

#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"
#include "effects/measure/study/sweep_measures.h"
#include "effects/measure/study/sweep_parts.h"
#include "effects/reflections/screen_space/screen_reflections.h"
#include "effects/reflections/traced/reflections.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

Setting indirect(IndirectMode mode, std::uint32_t rays) {
  return changed<IndirectConstants>(setting_of("gi", rays),
                                    [&](auto& constants) { constants.mode = mode; });
}

// Metres of a surface that has no back: behind it everything is hidden.
constexpr float kNoBack = 1e4f;

}  // namespace

StudyPlan ssr_sweep(const Options& options) {
  StudyPlan out;
  MeasurePlan& plan = out.plan = base_plan("reflections", options);
  plan.title = "Marches over the picture: stride and thickness";
  plan.against_truth = true;
  plan.effects.push_back("ssr");
  plan.also = hits_and_misses;
  for (const float stride : {1.0f, 2.0f, 4.0f, 8.0f, 16.0f}) {
    for (const float thickness : {0.02f, 0.1f, 0.25f, 1.0f, kNoBack}) {
      add_to(plan, fmt::format("stride of {:g} pixels", stride),
             thickness == kNoBack ? "no back" : fmt::format("{:g} m thick", thickness),
             changed<ScreenReflectionConstants>(setting_of("ssr"), [&](auto& constants) {
               constants.stride = stride;
               constants.thickness = thickness;
             }));
    }
  }
  return out;
}

StudyPlan roughness_sweep(const Options& options) {
  StudyPlan out;
  MeasurePlan& plan = out.plan = base_plan("reflections", options);
  plan.title = "Reflections by the roughness of all materials";
  plan.also = means;
  plan.references.clear();
  const Setting capped =
      changed<ReflectionConstants>(setting_of("reflections", 4),
                                   [](auto& constants) { constants.fireflies = Fireflies::kKeep; });
  const Setting whole =
      changed<ReflectionConstants>(capped, [](auto& constants) { constants.single_length = 1; });
  for (const float roughness : {0.0f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f}) {
    const std::string label = fmt::format("roughness {:g}", roughness);
    const std::string reference = fmt::format("reflections-roughness-{:g}", roughness);
    plan.references.push_back({reference, "all rays 200 m long, " + label, whole, true});
    for (const bool has_cap : {true, false}) {
      plan.settings.push_back({has_cap ? "rays shorter on rough surfaces" : "rays of 200 m", label,
                               has_cap ? capped : whole, reference, true, out.frames.size()});
    }
    out.frames.push_back({[roughness](Options& own, Scene& scene) {
      own.committed.clear();
      for (Material& material : scene.materials) {
        material.constants.roughness = roughness;
        material.constants.image[kMetallicRoughnessTexture] = kNoTexture;
      }
    }});
  }
  return out;
}

StudyPlan voxel_sweep(const Options& options) {
  StudyPlan out;
  MeasurePlan& plan = out.plan = base_plan("gi", options);
  plan.title = "Indirect light by the cells of its volume";
  plan.against_truth = true;
  plan.also = means;
  for (const float metres : {2.0f, 1.0f, 0.5f, 0.25f}) {
    for (const auto& [group, mode, rays] :
         {std::tuple("volume at the surface", IndirectMode::kDirect, 1u),
          std::tuple("near-field, 16 rays", IndirectMode::kNearField, kQuietRays)}) {
      add_to(plan, group, fmt::format("cells of {:g} m", metres), indirect(mode, rays));
      plan.settings.back().frame = out.frames.size();
    }
    out.frames.push_back({[metres](Options& own, Scene&) {
      own.frame.volume.cell = metres;
      own.frame.volume.file.clear();
      own.frame.volume.given.reset();
    }});
  }
  return out;
}

StudyPlan length_sweep(const Options& options) {
  StudyPlan out;
  MeasurePlan& plan = out.plan = base_plan("gi", options);
  plan.title = "Indirect light by the length of its rays";
  plan.against_truth = true;
  for (const auto& [group, mode] : {std::pair("near-field, 16 rays", IndirectMode::kNearField),
                                    std::pair("hit = black, 16 rays", IndirectMode::kHitBlack)}) {
    for (const float metres : {0.25f, 0.5f, 1.0f, 2.0f, 3.0f, 4.0f, 8.0f}) {
      add_to(plan, group, fmt::format("{:g} m", metres),
             changed<IndirectConstants>(indirect(mode, kQuietRays),
                                        [&](auto& constants) { constants.length = metres; }));
    }
  }
  return out;
}

}  // namespace kaamos::measure

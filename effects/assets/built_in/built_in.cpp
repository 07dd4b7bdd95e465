// SPDX-License-Identifier: MIT
#include "effects/assets/built_in/built_in.h"

#include "effects/assets/built_in/boulders.h"
#include "effects/assets/built_in/crown.h"
#include "effects/assets/built_in/destruction.h"
#include "effects/assets/built_in/foliage.h"
#include "effects/assets/built_in/glass_scenes.h"
#include "effects/assets/built_in/leak_scenes.h"
#include "effects/assets/built_in/light_forest.h"
#include "effects/assets/built_in/lounge.h"
#include "effects/assets/built_in/matched_scenes.h"
#include "effects/assets/built_in/mirror_hall.h"
#include "effects/assets/built_in/oracle_scenes.h"
#include "effects/assets/built_in/peter_panning.h"
#include "effects/assets/built_in/portrait.h"
#include "effects/assets/built_in/projector.h"
#include "effects/assets/built_in/runner.h"
#include "effects/assets/built_in/sparks.h"
#include "effects/assets/built_in/stress_scenes.h"
#include "effects/assets/built_in/terrain.h"

namespace kaamos::effects {
namespace {

constexpr BuiltInScene kScenes[] = {
    {"lounge", [] { return make_lounge(); }},
    {"runner", [] { return make_runner_scene(); }},
    {"glass-stack", [] { return make_glass_stack({.thick = true}); }},
    {"mirror-hall", [] { return make_mirror_hall(); }},
    {"oracle-box", [] { return make_oracle_box(); }},
    {"sealed-cells", [] { return make_sealed_cells({}); }},
    {"sealed-hall", [] { return make_sealed_hall({}); }},
    {"lit-hall", [] { return make_sealed_hall({.lit = true}); }},
    {"thin-dome", [] { return make_thin_dome({}); }},
    {"peter-panning", [] { return make_peter_panning({}); }},
    {"foliage", [] { return make_foliage({}); }},
    {"crown", [] { return make_crown(); }},
    {"light-forest", [] { return make_light_forest({}); }},
    {"projector", [] { return make_projector(); }},
    {"terrain", [] { return make_terrain({}); }},
    {"boulders", [] { return make_boulders({}); }},
    {"sparks", [] { return make_sparks({}); }},
    {"portrait", [] { return make_portrait(); }},
    {"lounge-loose-table", [] { return make_lounge_loose_table(); }},
    {"pub", [] { return make_stress_scene({StressKind::kPub}); }},
    {"resort", [] { return make_stress_scene({StressKind::kResort}); }},
    {"breakfast", [] { return make_stress_scene({StressKind::kBreakfast}); }},
    {"destruction", [] { return make_destruction(); }},
    {"matched-box", [] { return make_matched_box(); }},
    {"matched-metal", [] { return make_matched_metal(); }},
    {"matched-yard", [] { return make_matched_yard(); }},
};

// The others in other sizes and with other lights. Not listed in help.
constexpr BuiltInScene kVariants[] = {
    {"foliage-tessellated", [] { return make_foliage({.tessellated = true}); }},
    {"destruction-updated", [] { return make_destruction(BuildClass::kDeformable); }},
    {"pub-1",
     [] {
       return make_stress_scene({StressKind::kPub, 1});
     }},
    {"resort-1",
     [] {
       return make_stress_scene({StressKind::kResort, 1});
     }},
    {"breakfast-1",
     [] {
       return make_stress_scene({StressKind::kBreakfast, 1});
     }},
    {"pub-full",
     [] {
       return make_stress_scene({StressKind::kPub, 4, 1.0});
     }},
    {"resort-full",
     [] {
       return make_stress_scene({StressKind::kResort, 4, 1.0});
     }},
    {"breakfast-full",
     [] {
       return make_stress_scene({StressKind::kBreakfast, 4, 1.0});
     }},
    {"pub-full-1",
     [] {
       return make_stress_scene({StressKind::kPub, 1, 1.0});
     }},
    {"resort-full-1",
     [] {
       return make_stress_scene({StressKind::kResort, 1, 1.0});
     }},
    {"breakfast-full-1",
     [] {
       return make_stress_scene({StressKind::kBreakfast, 1, 1.0});
     }},
};

}  // namespace

std::span<const BuiltInScene> built_in_scenes() {
  return kScenes;
}

const BuiltInScene* find_built_in_scene(std::string_view name) {
  for (const auto scenes : {built_in_scenes(), scene_variants()}) {
    for (const BuiltInScene& scene : scenes) {
      if (name == scene.name) return &scene;
    }
  }
  return nullptr;
}

std::span<const BuiltInScene> scene_variants() {
  return kVariants;
}

std::string built_in_scene_names() {
  std::string names;
  for (const BuiltInScene& scene : kScenes) {
    if (!names.empty()) names += ", ";
    names += scene.name;
  }
  return names;
}

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
#include "effects/scene/built_in.h"

#include "effects/scene/glass_scenes.h"
#include "effects/scene/leak_scenes.h"
#include "effects/scene/lounge.h"
#include "effects/scene/matched_scenes.h"
#include "effects/scene/mirror_hall.h"
#include "effects/scene/oracle_scenes.h"
#include "effects/scene/peter_panning.h"
#include "effects/scene/runner.h"

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
    {"matched-box", [] { return make_matched_box(); }},
    {"matched-metal", [] { return make_matched_metal(); }},
    {"matched-yard", [] { return make_matched_yard(); }},
};

}  // namespace

std::span<const BuiltInScene> built_in_scenes() {
  return kScenes;
}

const BuiltInScene* find_built_in_scene(std::string_view name) {
  for (const BuiltInScene& scene : kScenes) {
    if (name == scene.name) return &scene;
  }
  return nullptr;
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

// SPDX-License-Identifier: MIT
//
// lights/...: main lighting with other ways to find each pixel's lights. [Northlight deck: Light
// Culling; survey 5.3.1]
#include <rtapi/upload.h>

#include <cmath>
#include <stdexcept>

#include "effects/assets/built_in/light_forest.h"
#include "effects/assets/built_in/lounge.h"
#include "effects/assets/scene/light_constants.h"
#include "effects/engine/picture.h"
#include "effects/light/direct/direct.h"
#include "effects/light/lights/lighting.h"
#include "fixtures.h"
#include "scene_stage.h"

namespace kaamos::bench {
namespace {

using namespace effects;

// A scene with its shadow maps and lists of lights.
struct LitStage : SceneStage {
  LitStage(Scene given, const Options& options)
      : SceneStage(std::move(given), options.threads, options.width, options.height) {
    const auto library = lighting_library().value();
    const auto count =
        static_cast<uint32_t>(light_constants(scene, scene.cameras.front().position()).size());
    lighting = Lighting::create(device, frame, gpu, library, count).value();
    // Maps for no light, so that an update makes nothing but lists, those of the frame's lights.
    lists = Lighting::create(device, frame, gpu, library, 0).value();
    direct = DirectLighting::create(device, frame, lighting, direct_library().value()).value();
    run([&](rtapi::CommandList& list) { lighting.update(list, frame); });
  }
  FloatImage read(const rtapi::Texture& picture) {
    return read_picture(device, queue, picture).value();
  }

  Lighting lighting, lists;
  DirectLighting direct;
};

// Lights that reach into the camera's frustum, against those of each pixel's cluster; with `lists`,
// the clusters' lists are made, too, as in each frame.
Line frustum(const std::string& name, LitStage stage, bool lists, const Measure& measure) {
  const auto shade = [&](LightCulling culling, bool make_lists) {
    stage.run([&](rtapi::CommandList& list) {
      if (make_lists) stage.lists.update(list, stage.frame);
      stage.direct.dispatch(list, stage.frame, false, culling);
    });
  };
  shade(LightCulling::kFrustum, false);
  const FloatImage culled = stage.read(stage.direct.direct());
  shade(LightCulling::kClusters, lists);
  if (stage.read(stage.direct.direct()).values != culled.values) {
    throw std::runtime_error("frustum and clusters do not give the same light");
  }
  const Pairs times = time_pairs(
      measure, [&] { shade(LightCulling::kFrustum, false); },
      [&] { shade(LightCulling::kClusters, lists); });
  return {name, times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
}

// The two strongest lights of each pixel named, left out and added later, against all lights at
// once.
Line strongest(const std::string& name, LitStage stage, const Measure& measure) {
  const rtapi::Texture contact =
      stage.frame.create_picture(stage.device, "contact", rtapi::Format::kR32G32B32A32Float)
          .value();
  const std::vector<float> lit(size_t{stage.frame.width()} * stage.frame.height() * 4, 1.0f);
  rtapi::UploadTexture(stage.device, stage.queue, contact, 0,
                       std::as_bytes(std::span<const float>(lit)))
      .value();
  stage.direct.set_contact(contact).value();
  const auto in_two_passes = [&] {
    stage.run([&](rtapi::CommandList& list) {
      stage.direct.dispatch(list, stage.frame, true);
      stage.direct.add_strongest(list, stage.frame);
    });
  };
  const auto at_once = [&] {
    stage.run([&](rtapi::CommandList& list) { stage.direct.dispatch(list, stage.frame, false); });
  };
  in_two_passes();
  const FloatImage apart = stage.read(stage.direct.total());
  at_once();
  const FloatImage together = stage.read(stage.direct.direct());
  for (size_t i = 0; i < together.values.size(); ++i) {
    if (i % 4 == 3) continue;  // total() is opaque where nothing is seen, too
    if (std::abs(apart.values[i] - together.values[i]) > 1e-4f * together.values[i] + 1e-6f) {
      throw std::runtime_error("the strongest lights, added later, do not give the same light");
    }
  }
  const Pairs times = time_pairs(measure, in_two_passes, at_once);
  return {name, times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
}

}  // namespace

std::vector<Case> light_cases() {
  struct Lit {
    const char* name;
    Scene (*make)();
  };
  constexpr Lit kLit[] = {{"lounge", [] { return make_lounge(); }},
                          {"forest-100", [] { return make_light_forest({.lights = 100}); }},
                          {"forest-400", [] { return make_light_forest({.lights = 400}); }}};
  std::vector<Case> out;
  for (const Lit& lit : kLit) {
    for (const bool lists : {false, true}) {
      const std::string name =
          std::string("lights/frustum/") + lit.name + (lists ? "/net" : "/shade");
      out.push_back({name, [=, make = lit.make](Fixtures& fixtures, const Measure& measure) {
                       return frustum(name, LitStage(make(), fixtures.options()), lists, measure);
                     }});
    }
    const std::string name = std::string("lights/strongest/") + lit.name;
    out.push_back({name, [=, make = lit.make](Fixtures& fixtures, const Measure& measure) {
                     return strongest(name, LitStage(make(), fixtures.options()), measure);
                   }});
  }
  return out;
}

}  // namespace kaamos::bench

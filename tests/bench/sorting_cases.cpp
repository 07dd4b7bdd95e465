// SPDX-License-Identifier: MIT
//
// sorting/...: an effect over the lounge with its rays sorted by direction, by origin or by
// termination, against the same rays unsorted. .../trace times the dispatch alone, .../net includes
// keys and sorting. sorting/loops: the two loops of visibility in a rasterizer's order against a
// ray tracer's. [survey 3.5; Meister et al. 2020]
#include <algorithm>
#include <stdexcept>

#include "effect_run.h"
#include "effects/assets/built_in/lounge.h"
#include "effects/engine/picture.h"
#include "effects/surfaces/ray_order/loop_order.h"
#include "scene_stage.h"

namespace kaamos::bench {
namespace {

using effects::LoopOrder;
using effects::RayOrder;

Case sorting_case(const std::string& effect, const std::string& key, RayOrder order, bool net) {
  const std::string name = "sorting/" + effect + "/" + key + (net ? "/net" : "/trace");
  return {name, [=](Fixtures& fixtures, const Measure& measure) -> Line {
            EffectRun run(effect, fixtures, order);
            const Pairs times = time_pairs(
                measure,
                [&] {
                  if (net) run.sort();
                  run.trace(true);
                },
                [&] { run.trace(false); });
            return {name, times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
          }};
}

// Every triangle against every pixel: an eighth of the width and height is enough.
Line loops(Fixtures& fixtures, const Measure& measure) {
  const Options& options = fixtures.options();
  SceneStage stage(effects::make_lounge(), options.threads, std::max(options.width / 8, 1u),
                   std::max(options.height / 8, 1u));
  const auto loops = effects::VisibilityLoops::create(stage.device, stage.frame, stage.scene,
                                                      stage.scene.cameras.front().position(),
                                                      effects::loop_order_library().value())
                         .value();
  const auto see = [&](LoopOrder order) {
    stage.run([&](rtapi::CommandList& list) { loops.dispatch(list, stage.frame, order); });
  };
  const auto seen = [&](LoopOrder order) {
    see(order);
    return effects::read_picture(stage.device, stage.queue, loops.seen()).value().values;
  };
  if (seen(LoopOrder::kRaster) != seen(LoopOrder::kRays)) {
    throw std::runtime_error("the two orders do not see the same");
  }
  const Pairs times = time_pairs(
      measure, [&] { see(LoopOrder::kRaster); }, [&] { see(LoopOrder::kRays); });
  return {"sorting/loops", times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
}

}  // namespace

std::vector<Case> sorting_cases() {
  struct Key {
    const char* name;
    RayOrder order;
  };
  constexpr Key kKeys[] = {{"direction", RayOrder::kDirection},
                           {"origin", RayOrder::kOrigin},
                           {"termination", RayOrder::kTermination}};
  std::vector<Case> out;
  for (const char* effect : {"ao", "sun", "reflections"}) {
    for (const Key& key : kKeys) {
      for (const bool net : {false, true}) {
        out.push_back(sorting_case(effect, key.name, key.order, net));
      }
    }
  }
  out.push_back({"sorting/loops", loops});
  return out;
}

}  // namespace kaamos::bench

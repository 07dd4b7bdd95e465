// SPDX-License-Identifier: MIT
#include "effects/measure/study/sweep_measures.h"

#include <algorithm>

#include "effects/reflections/screen_space/hit_comparison.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

double mean_of(const FloatImage& image, const std::vector<std::uint8_t>& mask) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    if (mask[i / image.channels] == 0) continue;
    sum += image.values[i];
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

rtapi::Result<Also> acne_and_gap(EffectRuns&, const MeasuredSetting&, const FloatImage& image,
                                 const Target& target) {
  std::size_t lit = 0, dark = 0, acne = 0, gap = 0;
  for (std::size_t i = 0; i < target.mask.size(); ++i) {
    if (target.mask[i] == 0) continue;
    const bool is_lit = target.image.values[i * target.image.channels] > 0.5f;
    const bool shows_lit = image.values[i * image.channels] > 0.5f;
    (is_lit ? lit : dark) += 1;
    if (is_lit && !shows_lit) ++acne;
    if (!is_lit && shows_lit) ++gap;
  }
  const auto share = [](std::size_t part, std::size_t of) {
    return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(of, 1));
  };
  return Also{{"acne %", share(acne, lit)}, {"gap %", share(gap, dark)}};
}

rtapi::Result<Also> hits_and_misses(EffectRuns& runs, const MeasuredSetting& measured,
                                    const FloatImage&, const Target&) {
  FrameRenderer& renderer = runs.renderer();
  const Setting& setting = measured.setting;
  const EffectSignal& hits = find_effect(northlight_effects(), setting.effect)->signals[1];
  const auto found = compare_hits(renderer.device(), renderer.queue(), renderer.frame(),
                                  renderer.context().gpu, renderer.effects().sum(hits.name),
                                  setting.settings.get_constants<ScreenReflectionConstants>(),
                                  setting.first_sample + setting.settings.samples - 1);
  if (!found) return found.error();
  const HitConfusion& confusion = found->confusion;
  const auto rays = static_cast<double>(std::max<std::uint64_t>(confusion.rays(), 1));
  const auto share = [&](std::uint64_t count) { return 100 * static_cast<double>(count) / rays; };
  return Also{{"coverage %", share(confusion.hits())},
              {"right hits %", share(confusion.correct())},
              {"false hits %", share(confusion.false_hits())},
              {"missed %", share(confusion.missed())},
              {"rightly none %", share(confusion.rays() - confusion.hits() - confusion.missed())}};
}

rtapi::Result<Also> means(EffectRuns&, const MeasuredSetting&, const FloatImage& image,
                          const Target& target) {
  return Also{{"mean", mean_of(image, target.mask)},
              {"mean of rays", mean_of(target.image, target.mask)}};
}

}  // namespace kaamos::measure

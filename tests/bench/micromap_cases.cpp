// SPDX-License-Identifier: MIT
//
// micromaps/...: rays through a hedge of leaves with a mask, whose holes opacity micromaps know,
// over the same by any-hit shaders alone. [DXR: Opacity micromaps]
#include <memory>
#include <stdexcept>

#include "effects/assets/built_in/foliage.h"
#include "effects/northlight/frame_renderer.h"
#include "fixtures.h"

namespace kaamos::bench {
namespace {

using namespace effects;

class Hedge {
 public:
  Hedge(const std::string& effect, uint32_t micromap_states, const Scene& scene,
        const Options& options)
      : effect_(effect) {
    rtapi::DeviceDesc desc;
    desc.Threads = options.threads;
    desc.Precision = options.precision;
    FrameSettings settings;
    settings.width = options.width;
    settings.height = options.height;
    settings.effects = choose_effects({effect});
    settings.whole_frame = false;
    settings.structures.opacity_micromaps = micromap_states;
    renderer_ = FrameRenderer::create(rtapi::CreateDevice(desc).value(), scene, settings).value();
    renderer_->run(effect, 1).value();  // the G-buffer is there then
    list_ = renderer_->device().CreateCommandList().value();
  }

  void trace() {
    list_.Reset().value();
    renderer_->record(list_, effect_, {.samples = 1});
    renderer_->queue().ExecuteAndWait(list_).value();
  }
  std::vector<float> picture() { return renderer_->read(effect_).value().values; }

 private:
  std::string effect_;
  std::unique_ptr<FrameRenderer> renderer_;
  rtapi::CommandList list_;
};

Line hedge(const std::string& name, const std::string& effect, uint32_t states, Fixtures& fixtures,
           const Measure& measure) {
  const Options& options = fixtures.options();
  const Scene scene = make_foliage({.twigs = options.quick ? 10u : 100u});
  Hedge ours(effect, states, scene, options);
  Hedge baseline(effect, 0, scene, options);
  if (states == 4 && ours.picture() != baseline.picture()) {
    throw std::runtime_error("four-state micromaps change the picture");
  }
  const Pairs times = time_pairs(
      measure, [&] { ours.trace(); }, [&] { baseline.trace(); });
  return {name, 1 / times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", true};
}

}  // namespace

std::vector<Case> micromap_cases() {
  std::vector<Case> out;
  for (const char* effect : {"sun", "ao"}) {
    for (const uint32_t states : {2u, 4u}) {
      const std::string name = "micromaps/" + std::string(effect) + "/" + std::to_string(states);
      out.push_back({name, [=](Fixtures& fixtures, const Measure& measure) {
                       return hedge(name, effect, states, fixtures, measure);
                     }});
    }
  }
  return out;
}

}  // namespace kaamos::bench

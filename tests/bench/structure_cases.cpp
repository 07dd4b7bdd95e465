// SPDX-License-Identifier: MIT
//
// structures/...: a wall that bursts and a curtain, whose structures are built anew in each frame
// (build class 4), against other ways to keep them. [Northlight deck: Bottom Level Build Flags]
#include "effects/geometry/structures/structures.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "effects/assets/built_in/destruction.h"
#include "effects/engine/frame.h"
#include "effects/engine/ray_pass.h"
#include "effects/surfaces/gbuffer/gbuffer.h"
#include "fixtures.h"

namespace kaamos::bench {
namespace {

using namespace effects;

constexpr double kFrameSeconds = 1.0 / 30;
// From shortly before the burst to half a second after it.
constexpr int kFirstFrame = 16, kFrames = 20;

// The scene with its structures in one class.
struct Destruction {
  Destruction(const Options& options, BuildClass build_class, uint32_t period)
      : scene(make_destruction(build_class)), height(options.height) {
    rtapi::DeviceDesc device_desc;
    device_desc.Threads = options.threads;
    device = rtapi::CreateDevice(device_desc).value();
    queue = device.CreateCommandQueue().value();
    StructureOptions structures;
    structures.deformable_period = structures.hero_period = period;
    manager = StructureManager::create(device, queue, scene, structures).value();
    const Camera& camera = scene.cameras.front();
    FrameDesc desc;
    desc.width = options.width;
    desc.height = options.height;
    frame = Frame::create(device, scene, manager.scene(), camera, desc).value();
    gbuffer =
        RayPass::create(device, frame, manager.scene(), gbuffer_pass(gbuffer_library().value()))
            .value();
    for (int i = 0; i <= kFrames; ++i) {
      states.push_back(evaluate_instances(scene, (kFirstFrame + i) * kFrameSeconds));
    }
    start();
  }

  // The frame before the first one that is timed.
  void start() { move_to(0); }
  // All frames' skinning, bottom levels and top levels.
  void move() {
    for (int i = 1; i <= kFrames; ++i) move_to(static_cast<size_t>(i));
  }
  void trace() {
    rtapi::CommandList list = device.CreateCommandList().value();
    gbuffer.dispatch(list, frame, {}, height);
    queue.ExecuteAndWait(list).value();
  }
  std::vector<float> depth() { return frame.read(device, queue, kViewZ).value().values; }

  Scene scene;
  uint32_t height;
  rtapi::Device device;
  rtapi::CommandQueue queue;
  StructureManager manager;
  Frame frame;
  RayPass gbuffer;
  std::vector<std::vector<InstanceState>> states;

 private:
  void move_to(size_t i) {
    rtapi::CommandList list = device.CreateCommandList().value();
    manager.record(list, states[i], scene.cameras.front().position()).value();
    queue.ExecuteAndWait(list).value();
  }
};

// Another way to keep the structures.
struct Other {
  const char* name;
  BuildClass build_class;
  uint32_t period;  // a build once in so many frames; 0: the first one only
};
constexpr Other kOthers[] = {{"updated", BuildClass::kDeformable, 0},
                             {"updated-8", BuildClass::kDeformable, 8},
                             {"fast-trace", BuildClass::kHero, 1}};

Line line_of(const std::string& name, const Pairs& times, double unit) {
  return {name, times.ratio, unit * times.ours, unit * times.baseline, "ms", false};
}

Line build_time(const std::string& name, const Other& other, Fixtures& fixtures,
                const Measure& measure) {
  Destruction ours(fixtures.options(), BuildClass::kEveryFrame, 0);
  Destruction baseline(fixtures.options(), other.build_class, other.period);
  // Each run begins with the wall that stands, which costs both sides one more frame.
  const auto frames = [](Destruction& d) {
    return [&d] {
      d.start();
      d.move();
    };
  };
  return line_of(name, time_pairs(measure, frames(ours), frames(baseline)), 1e3 / (kFrames + 1));
}

Line trace_time(const std::string& name, const Other& other, Fixtures& fixtures,
                const Measure& measure) {
  Destruction ours(fixtures.options(), BuildClass::kEveryFrame, 0);
  Destruction baseline(fixtures.options(), other.build_class, other.period);
  ours.move();
  baseline.move();
  const Pairs times = time_pairs(
      measure, [&] { ours.trace(); }, [&] { baseline.trace(); });
  const std::vector<float> a = ours.depth(), b = baseline.depth();
  size_t others = 0;
  for (size_t i = 0; i < a.size(); ++i) others += std::abs(a[i] - b[i]) > 1e-4f * a[i];
  if (others > a.size() / 10000) {
    throw std::runtime_error("rays hit other things in " + std::to_string(others) + " of " +
                             std::to_string(a.size()) + " pixels");
  }
  return line_of(name, times, 1e3);
}

}  // namespace

std::vector<Case> structure_cases() {
  std::vector<Case> out;
  for (const Other& other : kOthers) {
    for (const bool trace : {false, true}) {
      const std::string name =
          std::string("structures/over-") + other.name + (trace ? "/trace" : "/frame");
      out.push_back({name, [=](Fixtures& fixtures, const Measure& measure) {
                       return (trace ? trace_time : build_time)(name, other, fixtures, measure);
                     }});
    }
  }
  return out;
}

}  // namespace kaamos::bench

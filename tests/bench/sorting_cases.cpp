// SPDX-License-Identifier: MIT
//
// sorting/...: an effect over the lounge with its rays sorted by direction, over the same unsorted.
// .../trace is the dispatch alone, .../net has the keys and the sort in it. [effects-spec B1.5]
#include <optional>
#include <stdexcept>

#include "effects/ambient_occlusion/ambient_occlusion.h"
#include "effects/gbuffer/gbuffer.h"
#include "effects/indirect_diffuse/volume.h"
#include "effects/lights/lighting.h"
#include "effects/ray_order/ray_order.h"
#include "effects/reflections/reflections.h"
#include "effects/sun_shadow/sun_shadow.h"
#include "fixtures.h"

namespace kaamos::bench {
namespace {

using namespace effects;

struct Effect {
  const char* name;
  RayPassDesc (*pass)(rtapi::ShaderLibrary);
  rtapi::Result<rtapi::ShaderLibrary> (*library)();
  bool own_picture;
};
constexpr Effect kEffects[] = {
    {"ao", ambient_occlusion_pass, ambient_occlusion_library, false},
    {"sun", sun_shadow_pass, sun_shadow_library, false},
    {"reflections", reflections_pass, reflections_library, true},
};

// One effect, ready to run at one ray per pixel.
class Sorted {
 public:
  Sorted(const Effect& effect, Fixtures& fixtures) {
    rtapi::DeviceDesc device_desc;
    device_desc.Threads = fixtures.threads();
    device_ = rtapi::CreateDevice(device_desc).value();
    queue_ = device_.CreateCommandQueue().value();
    const Scene& scene = fixtures.scene().scene;
    const Camera& camera = scene.cameras.front();
    gpu_ = create_gpu_scene(device_, queue_, scene, camera.position()).value();
    FrameDesc desc;
    desc.width = fixtures.options().width;
    desc.height = fixtures.options().height;
    frame_ = Frame::create(device_, queue_, scene, gpu_, camera, desc).value();
    lighting_ = Lighting::create(device_, frame_, gpu_, lighting_library().value(), 0).value();
    volume_ = GpuVolume::create(device_, {}, camera.position()).value();
    sorter_ = RaySorter::create(device_, frame_, ray_order_library().value()).value();
    const RayPassDesc pass = effect.pass(effect.library().value());
    pass_ = RayPass::create(device_, frame_, gpu_, pass).value();
    keys_ = RayPass::create(device_, frame_, gpu_, key_pass(pass)).value();
    if (effect.own_picture) bind_picture();
    const RayPass gbuffer =
        RayPass::create(device_, frame_, gpu_, gbuffer_pass(gbuffer_library().value())).value();
    list_ = device_.CreateCommandList().value();
    gbuffer.dispatch(list_, frame_, {}, frame_.height());
    lighting_->update(list_, frame_);
    keys_.dispatch(list_, frame_, constants(false), frame_.height(), arguments_);
    sorter_.sort(list_, frame_, RayOrder::kDirection);
    queue_.ExecuteAndWait(list_).value();
  }

  void sort() {
    list_.Reset().value();
    keys_.dispatch(list_, frame_, constants(false), frame_.height(), arguments_);
    sorter_.sort(list_, frame_, RayOrder::kDirection);
    queue_.ExecuteAndWait(list_).value();
  }
  void trace(bool sorted) {
    list_.Reset().value();
    pass_.dispatch(list_, frame_, constants(sorted), frame_.height(), arguments_);
    queue_.ExecuteAndWait(list_).value();
  }

 private:
  void bind_picture() {
    picture_ = frame_.create_picture(device_, "sum", rtapi::Format::kR32G32B32A32Float).value();
    views_ = frame_.create_pass_views(device_).value();
    views_.set_unordered_access(0, picture_).value();
    lighting_->bind(views_).value();
    volume_.bind(views_).value();
    arguments_ = {views_, ReflectionConstants{}};
  }
  static PassConstants constants(bool sorted) {
    PassConstants out;
    out.sample_count = 1;
    out.radius = kDefaultAmbientOcclusionRadius;
    out.sorted = sorted ? 1 : 0;
    return out;
  }

  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  GpuScene gpu_;
  Frame frame_;
  std::optional<Lighting> lighting_;
  GpuVolume volume_;
  RaySorter sorter_;
  RayPass pass_, keys_;
  rtapi::Texture picture_;
  PassViews views_;
  PassArguments arguments_;
  rtapi::CommandList list_;
};

Case sorting_case(const Effect& effect, bool net) {
  const std::string name = std::string("sorting/") + effect.name + (net ? "/net" : "/trace");
  return {name, [=, &effect](Fixtures& fixtures, const Measure& measure) -> Line {
            Sorted sorted(effect, fixtures);
            const Pairs times = time_pairs(
                measure,
                [&] {
                  if (net) sorted.sort();
                  sorted.trace(true);
                },
                [&] { sorted.trace(false); });
            return {name, times.ratio, 1e3 * times.ours, 1e3 * times.baseline, "ms", false};
          }};
}

}  // namespace

std::vector<Case> sorting_cases() {
  std::vector<Case> out;
  for (const Effect& effect : kEffects) {
    for (const bool net : {false, true}) out.push_back(sorting_case(effect, net));
  }
  return out;
}

}  // namespace kaamos::bench

// SPDX-License-Identifier: MIT
// A frame of which single effects run again and again, with any settings and seeds, on one device:
// what measuring needs and rendering does not.
#pragma once

#include <rtapi/rtapi.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/composite/composite.h"
#include "effects/contact_shadow/contact_shadow.h"
#include "effects/denoise/denoise.h"
#include "effects/direct/direct.h"
#include "effects/frame/frame.h"
#include "effects/frame/ray_pass.h"
#include "effects/indirect_diffuse/indirect_diffuse.h"
#include "effects/lights/lighting.h"
#include "effects/reflections/reflections.h"
#include "effects/transparent/transparent.h"
#include "frame_effects.h"
#include "options.h"

namespace northlight {

enum class Effect { kAo, kSun, kContact, kReflections, kGi, kTransparent };

// One effect and all that can be chosen of it. Constants of other effects are not looked at.
struct Setting {
  Effect effect = Effect::kAo;
  // kReflections, kGi: the rays alone; nothing that they meet is shaded, what is read is no light.
  bool trace_only = false;
  std::uint32_t samples = 1;
  std::uint32_t first_sample = 0;  // of each pixel's sequence
  float ao_radius = 4;
  kaamos::effects::ContactShadowConstants contact = {};
  bool lit = false;  // kContact: read gives the local lights' radiance, with their shadow maps
  kaamos::effects::ReflectionConstants reflection = {};
  kaamos::effects::IndirectConstants indirect = {};
  std::uint32_t times_ao = 0;  // kGi: multiplied with ambient occlusion of so many rays; 0: not
  kaamos::effects::TransparentConstants glass = {};
};

// Done part of what is named, from 0 to 1.
using StageProgress = std::function<void(const std::string& what, double done)>;

class Stage {
 public:
  // Everything that this measurement may run. `cache`: a folder for the volume of indirect light.
  struct Needs {
    bool lights = false;
    bool volume = false;
    bool glass = false;
  };
  // `scene`, `libraries` and `stop` must stay. An error with an empty id: `stop` was set.
  static rtapi::Result<std::unique_ptr<Stage>> create(
      const Options& options, const kaamos::effects::Scene& scene, const ShaderLibraries& libraries,
      const Needs& needs, const std::string& cache, const StageProgress& progress,
      const std::atomic<bool>& stop, std::function<void(const std::string&)> message);

  // Random numbers of what runs from here on.
  rtapi::Status set_seed(std::uint32_t seed);

  struct Run {
    double ms = 0;
    std::uint64_t rays = 0;  // traced, with those of hit shading
  };
  // Clears the effect's sum and takes all samples in one dispatch.
  rtapi::Result<Run> run(const Setting& setting);
  // The same for many samples: in dispatches short enough that `stop` is heard.
  rtapi::Status accumulate(const Setting& setting, const std::function<void(double)>& progress);
  // The mean of the samples of the last run: 1 channel (ao, sun), 2 (contact: the strongest point
  // and spot light) or 3. `lit` shadows: the radiance of the local lights. Glass: the frame's
  // radiance behind and with it.
  rtapi::Result<kaamos::effects::FloatImage> read(const Setting& setting);
  // What a run adds to.
  rtapi::Result<rtapi::Texture> sum(const Setting& setting);

  // Pixels that show a surface, or glass where `glass` is set (after a run of it).
  rtapi::Result<std::vector<std::uint8_t>> mask(bool glass);

  const rtapi::Device& device() const { return device_; }
  rtapi::CommandQueue& queue() { return queue_; }
  const kaamos::effects::Frame& frame() const { return frame_; }
  const kaamos::effects::Scene& scene() const { return scene_; }
  const std::atomic<bool>& stop() const { return stop_; }
  // A command list, executed; its time in milliseconds, by the clock that the options choose.
  rtapi::Result<double> execute(const std::function<void(rtapi::CommandList&)>& record);

 private:
  Stage(const Options& options, const kaamos::effects::Scene& scene,
        const ShaderLibraries& libraries, const std::atomic<bool>& stop)
      : options_(options), scene_(scene), libraries_(libraries), stop_(stop) {}

  struct Pass {
    kaamos::effects::RayPass rays;
    kaamos::effects::PassViews views;
    rtapi::Texture sum;        // null: a picture of the frame
    std::uint32_t sum_at = 0;  // its register
  };
  rtapi::Status create_device(std::function<void(const std::string&)> message);
  rtapi::Status create_lights();
  // What turns sums of contact shadows into light.
  rtapi::Status create_lit(const Pass& pass);
  rtapi::Result<kaamos::effects::FloatImage> read_lit(const Setting& setting);
  rtapi::Status create_volume(const std::string& cache, const StageProgress& progress);
  rtapi::Status create_glass(Pass& pass);
  // What glass is seen before.
  rtapi::Status render_background();
  rtapi::Result<Pass*> pass(const Setting& setting);
  rtapi::Result<Pass> create_pass(const Setting& setting);
  kaamos::effects::PassArguments arguments(const Pass& pass, const Setting& setting) const;
  void clear(rtapi::CommandList& list, const Pass& pass, Effect effect) const;

  Options options_;
  const kaamos::effects::Scene& scene_;
  const ShaderLibraries& libraries_;
  const std::atomic<bool>& stop_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  rtapi::CommandList list_;
  kaamos::effects::GpuScene gpu_;
  kaamos::effects::Frame frame_;
  std::optional<kaamos::effects::Lighting> lighting_;
  std::optional<kaamos::effects::DirectLighting> direct_;
  rtapi::Texture contact_mean_;
  kaamos::effects::Denoiser contact_load_;
  kaamos::effects::GpuVolume volume_, no_volume_;
  std::map<std::pair<Effect, bool>, Pass> passes_;  // by effect, and whether it traces only
  rtapi::Texture glass_, transmittance_;
  kaamos::effects::ComputePass glass_compose_;
  std::optional<kaamos::effects::CompositePass> composite_;
};

}  // namespace northlight

// SPDX-License-Identifier: MIT
// A frame in which single effects run again and again on one device, with any settings and seeds:
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

// One effect and its settings. Constants of other effects are ignored.
struct Setting {
  Effect effect = Effect::kAo;
  // kReflections, kGi: trace rays only. Hits are not shaded, so read() gives no light.
  bool trace_only = false;
  std::uint32_t samples = 1;
  std::uint32_t first_sample = 0;  // in each pixel's sequence
  float ao_radius = 4;
  kaamos::effects::ContactShadowConstants contact = {};
  bool lit = false;  // kContact: read() gives the local lights' radiance, with their shadow maps
  kaamos::effects::ReflectionConstants reflection = {};
  kaamos::effects::IndirectConstants indirect = {};
  std::uint32_t times_ao = 0;  // kGi: multiply with ambient occlusion of this many rays; 0: do not
  kaamos::effects::TransparentConstants glass = {};
};

// How much of the named work is done, from 0 to 1.
using StageProgress = std::function<void(const std::string& what, double done)>;

class Stage {
 public:
  // Everything that a measurement may run. `cache`: a folder for the volume of indirect light.
  struct Needs {
    bool lights = false;
    bool volume = false;
    bool glass = false;
  };
  // `scene`, `libraries` and `stop` must outlive the stage. An error with an empty id means that
  // `stop` was set.
  static rtapi::Result<std::unique_ptr<Stage>> create(
      const Options& options, const kaamos::effects::Scene& scene, const ShaderLibraries& libraries,
      const Needs& needs, const std::string& cache, const StageProgress& progress,
      const std::atomic<bool>& stop, std::function<void(const std::string&)> message);

  // Sets the random numbers for what runs from here on.
  rtapi::Status set_seed(std::uint32_t seed);

  struct Run {
    double ms = 0;
    std::uint64_t rays = 0;  // traced, including those of hit shading
  };
  // Clears the effect's sum and takes all samples in one dispatch.
  rtapi::Result<Run> run(const Setting& setting);
  // The same for many samples, in dispatches short enough to react to `stop`.
  rtapi::Status accumulate(const Setting& setting, const std::function<void(double)>& progress);
  // The mean of the last run's samples: 1 channel (ao, sun), 2 (contact: the strongest point and
  // spot light) or 3. With `lit`: the radiance of the local lights. For glass: the frame's radiance
  // behind it and with it.
  rtapi::Result<kaamos::effects::FloatImage> read(const Setting& setting);
  // The picture to which a run adds.
  rtapi::Result<rtapi::Texture> sum(const Setting& setting);

  // Pixels that show a surface, or glass where `glass` is set (after a run with it).
  rtapi::Result<std::vector<std::uint8_t>> mask(bool glass);

  const rtapi::Device& device() const { return device_; }
  rtapi::CommandQueue& queue() { return queue_; }
  const kaamos::effects::Frame& frame() const { return frame_; }
  const kaamos::effects::Scene& scene() const { return scene_; }
  const std::atomic<bool>& stop() const { return stop_; }
  // Records and executes a command list; returns its milliseconds by the clock in the options.
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
  // Makes the pass that turns sums of contact shadows into light.
  rtapi::Status create_lit(const Pass& pass);
  rtapi::Result<kaamos::effects::FloatImage> read_lit(const Setting& setting);
  rtapi::Status create_volume(const std::string& cache, const StageProgress& progress);
  rtapi::Status create_glass(Pass& pass);
  // Renders what is seen behind the glass.
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
  std::map<std::pair<Effect, bool>, Pass> passes_;  // by effect, and whether it only traces
  rtapi::Texture glass_, transmittance_;
  kaamos::effects::ComputePass glass_compose_;
  std::optional<kaamos::effects::CompositePass> composite_;
};

}  // namespace northlight

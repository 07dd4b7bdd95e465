// SPDX-License-Identifier: MIT
/// @file
/// The Northlight frame of a scene: the G-buffer, the effects of a registry, denoising,
/// composition. Renders whole frames, one or a sequence of them, or runs single effects again and
/// again.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "effects/composition/composite/composite.h"
#include "effects/composition/composite/kept_radiance.h"
#include "effects/composition/taa/taa.h"
#include "effects/denoise/temporal_gradients.h"
#include "effects/engine/effect.h"
#include "effects/engine/effect_pass.h"
#include "effects/engine/frame.h"
#include "effects/engine/outcome.h"
#include "effects/engine/ray_pass.h"
#include "effects/geometry/structures/structures.h"
#include "effects/indirect/indirect_diffuse/volume.h"
#include "effects/light/direct/direct.h"
#include "effects/light/lights/lighting.h"
#include "effects/northlight/libraries.h"
#include "effects/northlight/settings.h"
#include "effects/northlight/signal_filters.h"
#include "effects/surfaces/gbuffer/primary_comparison.h"
#include "effects/surfaces/gbuffer/raster_gbuffer.h"
#include "effects/surfaces/ray_order/ray_order.h"

namespace kaamos::effects {

/// Takes what is being done and its done part, from 0 to 1; returning false stops the work at the
/// next step. Empty: nobody watches.
using Progress = std::function<bool(const std::string& what, double done)>;

/// What one pass of a frame took.
struct PassStatistics {
  std::string name;                  ///< "ambient occlusion"
  double ms = 0;                     ///< from recording to the end of execution
  rtapi::RaytracingStatistics rays;  ///< those of the pass
  std::uint64_t bytes = 0;           ///< of the pictures and buffers that it writes or alone reads
  bool is_gradient = false;          ///< A-SVGF's: only that denoiser needs it
};

/// What one run of a single effect took.
struct RunStatistics {
  double ms = 0;           ///< of execution
  std::uint64_t rays = 0;  ///< traced, those of hit shading included
};

/// A frame of a sequence.
struct FrameMoment {
  std::uint32_t index = 0;  ///< from 0 on
  double seconds = 0;       ///< on the scene's clock
  Camera camera;            ///< where it is seen from
  bool cut = false;         ///< the frame is unrelated to the previous one
};

/// Executes a band of rows of a pass; replaces CommandQueue::ExecuteAndWait, to look at it.
using BandExecutor = std::function<rtapi::Status(rtapi::CommandQueue& queue,
                                                 rtapi::CommandList& list, const std::string& pass,
                                                 std::uint32_t first_row, std::uint32_t row_count)>;

/// Executes the draws of a G-buffer; replaces CommandQueue::ExecuteAndWait, to look at them.
using DrawExecutor =
    std::function<rtapi::Status(rtapi::CommandQueue& queue, rtapi::CommandList& list)>;

/// A scene on a device with all that its frames need. Not for several threads at once.
class FrameRenderer {
 public:
  /// Uploads the scene and builds its structures. `scene` must stay for the renderer's life; only
  /// its lights, sun and sky may change between frames, and not to more lights. `effects`: the
  /// registry.
  /// @errors those of the device; KA3046 an unknown name in settings.effects; an effect with
  /// pictures of its own without settings.whole_frame.
  static rtapi::Result<std::unique_ptr<FrameRenderer>> create(
      const rtapi::Device& device, const Scene& scene, const FrameSettings& settings,
      std::vector<Effect> effects = northlight_effects());
  FrameRenderer(const FrameRenderer&) = delete;  // its passes point into it
  FrameRenderer& operator=(const FrameRenderer&) = delete;

  /// Takes these shaders from the next frame on, instead of those that are built in: all that
  /// frame_libraries names.
  void set_libraries(ShaderLibraries libraries);
  /// Executes the bands of rows of every pass by this, to look at them.
  void set_band_executor(BandExecutor executor) { execute_band_ = std::move(executor); }
  /// Executes the draws of frames that are rendered by this, to look at them.
  void set_draw_executor(DrawExecutor executor) { execute_draws_ = std::move(executor); }
  /// Milliseconds of the clock that times passes and runs; by default the time that passes.
  void set_clock(std::function<double()> milliseconds) { clock_ms_ = std::move(milliseconds); }

  /// Makes pipelines and pictures, and bakes or reads the volume of indirect light; render and run
  /// call it where it has not been done. After kStopped it can be called again.
  /// @errors those of the device; KA3041 more than 4,096 local lights; KA3045 a volume file that
  /// cannot be read or written.
  rtapi::Result<Outcome> prepare(const Progress& progress = {});
  /// Moves on to another frame of a sequence: poses, structures, camera.
  /// @errors KA3046 the camera is elsewhere than the scene's first and FrameSettings::moving is not
  /// set; others of the device.
  rtapi::Status begin_frame(const FrameMoment& moment);
  /// Where the instances are at a moment, and at which level of detail.
  std::vector<InstanceState> states_at(const FrameMoment& moment) const;
  /// Renders the frame.
  /// @errors those of prepare and of the device.
  rtapi::Result<Outcome> render(const Progress& progress = {});

  /// Runs a chosen effect alone, over the G-buffer and the lights of the frame; its sums begin
  /// anew. One dispatch.
  /// @errors those of prepare and of the device; KA3046 an effect that this frame does not have.
  rtapi::Result<RunStatistics> run(const std::string& effect, std::uint32_t samples);
  /// The same with all settings. `first_sample`: of each pixel's sequence. An effect with passes of
  /// its own gets some for each set of constants, and each number of samples where it is no sum:
  /// what they keep from frame to frame is theirs alone.
  /// @errors as above; KA3046 settings.trace_only of an effect without Effect::trace.
  rtapi::Result<RunStatistics> run(const std::string& effect, const EffectSettings& settings,
                                   std::uint32_t first_sample = 0);
  /// The same for many samples, in dispatches short enough to be stopped between them.
  /// @errors as above.
  rtapi::Result<Outcome> accumulate(const std::string& effect, const EffectSettings& settings,
                                    const Progress& progress);
  /// The samples of what runs from here on, as if the frame had had this seed.
  /// @errors those of the device.
  rtapi::Status set_seed(std::uint32_t seed);

  /// A layer by its name, as layers() lists them: sums as the mean of their samples. As many
  /// channels as its picture has.
  /// @errors those of the device; KA3046 an unknown name.
  rtapi::Result<FloatImage> read(const std::string& layer);
  /// Any picture of the frame. [read_picture]
  /// @errors those of the device.
  rtapi::Result<FloatImage> read(const rtapi::Texture& picture);
  /// The frame's radiance by these signals alone, as the composition adds them to what surfaces
  /// emit; without glass. It is written over the frame's "radiance".
  /// @errors those of the device; KA3046 a name that is no part of the composition.
  rtapi::Result<FloatImage> read_composed(const std::vector<std::string>& signals);
  /// What can be read: the G-buffer, each effect's signals, raw and denoised, and "radiance".
  std::vector<std::string> layers() const;
  /// The picture that an effect adds its samples to. Null: no such signal.
  rtapi::Texture sum(const std::string& signal) const;
  /// Adds a signal of this frame to denoisers that someone makes for themselves.
  /// @errors KA3046 no such signal; those of SignalFilters::add.
  rtapi::Status add_signal(SignalFilters& to, const std::string& signal) const;

  /// How the drawn G-buffer differs from one by rays, and what both take. The frame's pictures stay
  /// as they are.
  /// @errors those of prepare and of the device; KA3046 the G-buffer is not drawn.
  rtapi::Result<PrimaryComparison> compare_primary();
  /// Null: the G-buffer is traced.
  const RasterGBuffer* raster() const { return raster_ ? &*raster_ : nullptr; }

  /// Executes what `record` records; milliseconds.
  /// @errors those of the device.
  rtapi::Result<double> execute(const std::function<void(rtapi::CommandList&)>& record);

  // For whoever records a frame into lists of their own: prepare first.
  /// What is traced and shaded, in order: "gbuffer", "lights" and the effects' names.
  std::vector<std::string> parts() const;
  /// How record() takes a part.
  struct PartOptions {
    std::uint32_t first_sample = 0;  ///< of each pixel's sequence
    std::uint32_t samples = 0;       ///< 0: as settings() have them
    bool is_sorted = false;          ///< in the order that record_sort made
  };
  /// Records one of them over the whole picture. Sums begin anew. Drawn surfaces are those of now:
  /// what their draws read is written while they are recorded.
  void record(rtapi::CommandList& list, const std::string& part, const PartOptions& options);
  /// Records the sorting of an effect's rays by settings().order.
  void record_sort(rtapi::CommandList& list, const std::string& effect) const;
  /// Records the denoising of all signals that is not recorded with the parts already.
  void record_filters(rtapi::CommandList& list);
  /// Records what puts the frame together.
  void record_compose(rtapi::CommandList& list) const;
  /// The strongest lights, added with the visibility that was summed up last.
  void record_strongest_lights(rtapi::CommandList& list) const;

  /// The passes of the last frame, in order.
  const std::vector<PassStatistics>& passes() const { return statistics_; }
  /// What prepare() took; empty if there was nothing to bake or to load.
  const std::optional<PassStatistics>& set_up() const { return set_up_; }
  /// What baking the volume of indirect light took; empty if nothing was baked.
  const std::optional<BakeStatistics>& bake() const { return bake_; }
  /// Parts of the frame that this scene or these settings have no use for, and why.
  const std::vector<std::string>& left_out() const { return left_out_; }

  /// What create was given, with the effects that the chosen ones include.
  const FrameSettings& settings() const { return settings_; }
  /// What create was given.
  const Scene& scene() const { return scene_; }
  /// The registry.
  const std::vector<Effect>& effects() const { return effects_; }
  /// Whether an effect is rendered: chosen, and of use in this scene.
  bool renders(const std::string& effect) const;
  /// What create was given.
  const rtapi::Device& device() const { return device_; }
  /// Where everything is executed.
  rtapi::CommandQueue& queue() { return queue_; }
  /// The pictures and root table that all passes share.
  const Frame& frame() const { return frame_; }
  /// The scene's resources.
  const GpuScene& gpu_scene() const { return gpu_; }
  /// Those that prepare took.
  const ShaderLibraries& libraries() const { return libraries_; }
  /// The signals and their denoisers; none before prepare.
  const SignalFilters& filters() const { return filters_; }
  /// Null: the denoiser needs none.
  const TemporalGradients* gradients() const { return gradients_ ? &*gradients_ : nullptr; }
  /// Lists and shadow maps of local lights. Null: no whole frame, or none before prepare.
  const Lighting* lighting() const { return lighting_ ? &*lighting_ : nullptr; }
  /// Null: no effect of this frame reads it, or none before prepare.
  const GpuVolume* volume() const {
    return is_prepared_ && reads_volume() ? &gpu_volume_ : nullptr;
  }
  /// Whether an effect of this frame reads the volume of indirect light.
  bool reads_volume() const;
  /// The one that the last begin_frame began; before that the scene's camera, at 0 s.
  const FrameMoment& moment() const { return moment_; }
  /// Null: no local lights.
  const DirectLighting* main_lighting() const { return direct_ ? &*direct_ : nullptr; }
  /// Null without antialiasing over frames.
  const TemporalAntialiasing* taa() const { return taa_ ? &*taa_ : nullptr; }
  /// Null if nothing moves.
  const StructureStatistics* structures() const {
    return structures_ ? &structures_->statistics() : nullptr;
  }
  /// The pipelines of the G-buffer, unless it is drawn, and of the effects, for their shader
  /// tables. They are made without preparing anything else.
  /// @errors those of rtapi::LoadShaderLibrary and of RayPass::create.
  rtapi::Result<std::vector<std::pair<std::string, RayPass>>> ray_passes() const;

 private:
  // Passes of an effect that were made from other settings than the frame's, for run().
  struct OtherPasses {
    EffectSettings settings;
    std::optional<PassViews> views;
    std::unique_ptr<EffectPass> own;
  };

  // An effect of this frame.
  struct Active {
    const Effect* row = nullptr;
    EffectSettings settings;
    std::string title;  // of its pass
    RayPass pass, trace;
    std::unique_ptr<EffectPass> own;  // instead of `pass`
    std::vector<std::unique_ptr<OtherPasses>> others;
    std::optional<RayPass> keys;  // sorts its rays
    std::optional<PassViews> views, trace_views;
    std::optional<ComputePass> compose;
    std::vector<rtapi::Texture> pictures;        // by signal
    std::vector<rtapi::Texture> sharpness;       // by signal; empty where it is no visibility
    std::uint32_t samples = 0;                   // that the sums hold
    std::optional<PassViews> past_views;         // of samples that are taken again
    std::optional<std::uint32_t> gradient = {};  // its first signal's channel among the changes
  };

  FrameRenderer(const rtapi::Device& device, const Scene& scene, const FrameSettings& settings,
                std::vector<Effect> effects);
  // frame_renderer_prepare.cpp
  rtapi::Status create_scene();
  rtapi::Status check_settings() const;
  rtapi::Result<Outcome> prepare_whole(const Progress& progress);
  rtapi::Status create_lighting();
  rtapi::Result<Outcome> create_volume(const Progress& progress);
  rtapi::Result<Outcome> bake_indirect(IndirectVolume& volume, const Progress& progress);
  rtapi::Status create_filters();
  rtapi::Status add_signal(SignalFilters& to, const Active& effect, std::size_t index) const;
  rtapi::Status create_compose();
  const rtapi::Texture* composed(const Active& effect, std::size_t signal) const;
  rtapi::Result<FrameParts> parts_of(const std::vector<std::string>& signals) const;
  bool is_matte() const;
  void list_left_out();
  // frame_renderer_effects.cpp
  const Effect* what_replaces(const Effect& effect) const;
  bool is_of_use(const Effect& effect, const EffectSettings& settings) const;
  void find_active();
  rtapi::Status create_views(const Frame& frame, const Active& effect,
                             const std::vector<rtapi::Texture>& pictures, const GpuVolume& volume,
                             std::optional<PassViews>& views) const;
  rtapi::Status create_pictures(Active& effect) const;
  rtapi::Result<std::unique_ptr<EffectPass>> make_own(const Active& effect,
                                                      const EffectSettings& settings,
                                                      PassViews& views);
  rtapi::Status create_own(Active& effect);
  static EffectPass* own_of(const Active& effect, const EffectSettings& settings);
  rtapi::Status find_own(Active& effect, const EffectSettings& settings);
  rtapi::Status create_pass(Active& effect) const;
  rtapi::Status create_effect(Active& effect);
  // frame_renderer_gradients.cpp
  rtapi::Status create_gradients();
  rtapi::Status add_gradient(Active& effect);
  rtapi::Status begin_gradients();
  rtapi::Status repeat_samples(const Active& effect);
  rtapi::Status run_gradients(const std::string& name, std::uint64_t bytes,
                              const std::function<void(rtapi::CommandList&)>& record);
  rtapi::Status finish_gradients();
  // frame_renderer_surfaces.cpp
  rtapi::Status create_gbuffer();
  void record_draws(rtapi::CommandList& list);
  void record_gbuffer(rtapi::CommandList& list);
  rtapi::Result<Outcome> run_gbuffer(const Progress& progress);
  rtapi::Status draw_surfaces();
  // frame_renderer.cpp
  rtapi::Result<Outcome> run_pass(const std::string& title, const RayPass& pass, Active* effect,
                                  const Progress& progress);
  rtapi::Result<Outcome> run_own(Active& effect, const Progress& progress);
  rtapi::Result<Outcome> run_effect(Active& effect, const Progress& progress);
  rtapi::Status sort_rays(const Active& effect, const PassConstants& constants, double& ms);
  rtapi::Status run_compute(const std::string& name, std::uint64_t bytes,
                            const std::function<void(rtapi::CommandList&)>& record);
  rtapi::Result<Outcome> finish_whole(const Progress& progress);
  rtapi::Result<Outcome> run_effects(bool late, const Progress& progress);
  void record_curvature(rtapi::CommandList& list) const;
  void record_lights(rtapi::CommandList& list);
  std::uint64_t bytes_of(const Active& effect) const;
  std::uint64_t compose_bytes() const;
  // frame_renderer_radiance.cpp
  rtapi::Status create_radiance();
  rtapi::Status add_radiance(PassViews& views) const;
  rtapi::Status forget_radiance();
  rtapi::Status find_radiance();
  void record_unreflected(rtapi::CommandList& list) const;
  void record_early(rtapi::CommandList& list);
  // frame_renderer_run.cpp
  void set_samples(Active& effect, std::uint32_t samples);
  rtapi::Result<Active*> runnable(const std::string& effect, const EffectSettings& settings);
  PassArguments arguments(const Active& effect, const EffectSettings& settings) const;
  void record_pass(rtapi::CommandList& list, const Active& effect, const EffectSettings& settings,
                   PassConstants constants) const;
  struct Layer {
    std::string name;
    rtapi::Texture picture;
    float scale = 1;
    bool is_encoded_color = false;
  };
  std::vector<Layer> find_layers() const;

  const Active* active(const std::string& effect) const;
  // Reads the radiance that all others make.
  static bool is_late(const Active& effect) { return effect.row->needs.radiance; }
  // Main lighting is no effect with passes.
  static bool has_passes(const Effect& effect) { return effect.pass || effect.make; }
  // Effects whose sums every frame has come before local lights, the others after them.
  bool comes_first(const Active& effect) const;
  bool has_strongest_effect() const;

  FrameSettings settings_;
  const Scene& scene_;
  std::vector<Effect> effects_;
  rtapi::Device device_;
  rtapi::CommandQueue queue_;
  GpuScene gpu_;
  Frame frame_;
  std::optional<StructureManager> structures_;
  FrameMoment moment_;
  glm::vec2 jitter_{0.0f};
  BandExecutor execute_band_;
  DrawExecutor execute_draws_;
  std::function<double()> clock_ms_;
  std::vector<PassStatistics> statistics_;
  std::optional<PassStatistics> set_up_;
  std::optional<BakeStatistics> bake_;
  std::vector<std::string> left_out_;
  bool has_begun_ = false;      // begin_frame was called since the last frame
  bool has_surfaces_ = false;   // the G-buffer and the lights of this frame are there
  bool has_effects_ = false;    // and all that its radiance is put together from
  bool is_early_done_ = false;  // what late parts read is recorded
  // Made by prepare.
  bool is_prepared_ = false;
  bool has_own_libraries_ = false;
  ShaderLibraries libraries_;
  RayPass gbuffer_;
  std::optional<RasterGBuffer> raster_;  // draws it instead
  std::optional<ComputePass> curvature_;
  std::optional<RaySorter> sorter_;
  std::optional<Lighting> lighting_;
  std::optional<DirectLighting> direct_;
  GpuVolume gpu_volume_, no_volume_;
  std::vector<std::unique_ptr<Active>> active_;
  SignalFilters filters_;
  std::optional<TemporalGradients> gradients_;
  std::uint32_t past_index_ = 0;  // of the frame that they keep
  CompositePass composite_;
  std::optional<ComposePass> compose_unreflected_;  // for late effects
  std::optional<KeptRadiance> kept_;                // likewise
  std::optional<ComposePass> compose_;
  std::map<std::vector<std::string>, ComposePass> compose_some_;  // by their signals
  rtapi::Texture black_;  // stands for indirect light that is left out
  std::optional<TemporalAntialiasing> taa_;
};

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
/// @file
/// The Northlight frame of a scene: the G-buffer, the effects of a registry, denoising,
/// composition. Renders whole frames, one or a sequence of them, or runs single effects again and
/// again.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "effects/northlight/compose_stage.h"
#include "effects/northlight/effect_stage.h"
#include "effects/northlight/filter_stage.h"
#include "effects/northlight/frame_context.h"
#include "effects/northlight/light_stage.h"
#include "effects/northlight/scene_stage.h"
#include "effects/northlight/surface_stage.h"

namespace kaamos::effects {

/// The time and the rays of one run of a single effect.
struct RunStatistics {
  double ms = 0;           ///< of execution
  std::uint64_t rays = 0;  ///< traced, those of hit shading included
};

/// A scene on a device with all that its frames need: the stages of a frame, in their order. Not
/// for several threads at once.
class FrameRenderer {
 public:
  /// Uploads the scene and builds its structures. `scene` must stay for the renderer's life; only
  /// its lights, sun and sky may change between frames, and not to more lights. `effects`: the
  /// registry. `profile`, if not null, must stay, too; it gets the steps of all that the renderer
  /// does.
  /// @errors those of the device; KA3046 an unknown name in settings.effects; one that is
  /// not plain without settings.whole_frame.
  static rtapi::Result<std::unique_ptr<FrameRenderer>> create(
      const rtapi::Device& device, const Scene& scene, const FrameSettings& settings,
      std::vector<Effect> effects = northlight_effects(), Profile* profile = nullptr);
  FrameRenderer(const FrameRenderer&) = delete;  // its passes point into it
  FrameRenderer& operator=(const FrameRenderer&) = delete;

  /// Takes these shaders from the next frame on, instead of those that are built in: all that
  /// frame_libraries names.
  void set_libraries(ShaderLibraries libraries);
  /// Makes pipelines and pictures, and bakes or reads the volume of indirect light; render and run
  /// call it where it has not been done. After kStopped it can be called again.
  /// @errors those of the device; KA3041 more than 4,096 local lights; KA3045 a volume file that
  /// cannot be read or written.
  rtapi::Result<Outcome> prepare(const Progress& progress = {});
  /// Moves on to another frame of a sequence: poses, structures, camera.
  /// @errors KA3046 the camera is elsewhere than the scene's first and FrameSettings::moving is not
  /// set; others of the device.
  rtapi::Status begin_frame(const FrameMoment& moment);
  /// Renders the frame.
  /// @errors those of prepare and of the device.
  rtapi::Result<Outcome> render(const Progress& progress = {});

  /// Runs a chosen effect alone, over the G-buffer and the lights of the frame; its sums begin
  /// anew. One dispatch. What it reads of the frame's radiance [EffectNeeds] is that of all chosen
  /// effects that do not read it, denoised; they are rendered once a frame and seed.
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
  /// The layers that can be read: the G-buffer, each effect's signals, raw and denoised, and
  /// "radiance". They are known before anything is prepared.
  std::vector<std::string> layers() const;
  /// Checks whether there is a layer of this name.
  /// @errors KA3046 there is none; it names those that there are.
  rtapi::Status check_layer(const std::string& layer) const;

  // For whoever records a frame into lists of their own: prepare first. Filters and composition
  // have functions of their own.
  /// The parts that are traced and shaded, in order: "gbuffer", "lights" and the effects' names.
  std::vector<std::string> parts() const;
  /// Records one of them over the whole picture. Sums begin anew. Drawn surfaces are those of now:
  /// what their draws read is written while they are recorded.
  void record(rtapi::CommandList& list, const std::string& part, const PartOptions& options);

  /// The stages; what they made is there once prepare is done.
  ///@{
  const SceneStage& scene_stage() const { return *scene_; }
  SceneStage& scene_stage() { return *scene_; }
  SurfaceStage& surfaces() { return stages_->surfaces; }
  const LightStage& lights() const { return stages_->lights; }
  const EffectStage& effects() const { return stages_->effects; }
  FilterStage& filters() { return stages_->filters; }
  ComposeStage& composition() { return stages_->composition; }
  ///@}
  /// The context that they share.
  const FrameContext& context() const { return context_; }
  /// Executes and times the passes.
  PassRunner& runner() { return context_.runner; }
  /// Parts of the context.
  ///@{
  const rtapi::Device& device() const { return context_.device; }
  rtapi::CommandQueue& queue() { return context_.runner.queue(); }
  const Frame& frame() const { return context_.frame; }
  ///@}

 private:
  // In the order of a frame.
  struct Stages {
    explicit Stages(FrameContext& context)
        : surfaces(context),
          lights(context),
          effects(context, lights),
          filters(context, lights, effects),
          composition(context, lights, effects, filters) {}
    SurfaceStage surfaces;
    LightStage lights;
    EffectStage effects;
    FilterStage filters;
    ComposeStage composition;
  };

  FrameRenderer(const rtapi::Device& device, const Scene& scene, const FrameSettings& settings,
                std::vector<Effect> effects);
  rtapi::Result<Outcome> create_stages(const Progress& progress);
  // Bakes what the first frame reads of the volume.
  rtapi::Result<Outcome> bake_on_demand(const Progress& progress);
  // Bakes what the frame before has read of it; a pass of the frame if there is anything to bake.
  rtapi::Result<Outcome> bake_for_frame(const Progress& progress);
  rtapi::Result<Outcome> run_early_effects(const Progress& progress);
  rtapi::Result<Outcome> run_effects(const Progress& progress);
  rtapi::Result<ActiveEffect*> find_runnable(const std::string& effect,
                                             const EffectSettings& settings);

  FrameContext context_;
  std::unique_ptr<SceneStage> scene_;
  std::unique_ptr<Stages> stages_;
  bool has_begun_ = false;     // begin_frame was called since the last frame
  bool has_surfaces_ = false;  // the G-buffer and the lights of this frame are there
  bool has_effects_ = false;   // and all that its radiance without reflections is made from
  bool is_prepared_ = false;
  bool has_own_libraries_ = false;
};

/// The frame's radiance by these signals alone. [ComposeStage::run_some]
/// @errors as there, and those of FrameRenderer::read.
rtapi::Result<FloatImage> read_composed(FrameRenderer& renderer,
                                        const std::vector<std::string>& signals);

}  // namespace kaamos::effects

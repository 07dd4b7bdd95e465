// SPDX-License-Identifier: MIT
/// @file
/// An effect of a frame: its settings, its pictures and its passes.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effects/engine/compute_pass.h"
#include "effects/engine/effect.h"
#include "effects/engine/effect_pass.h"
#include "effects/engine/ray_effect.h"
#include "effects/northlight/frame_context.h"
#include "effects/northlight/light_stage.h"

namespace kaamos::effects {

/// The inputs of the passes of effects besides the G-buffer.
struct EffectInputs {
  const LightStage& lights;      ///< lists and maps of local lights, the volume of indirect light
  rtapi::Texture kept_radiance;  ///< of the frame before; null: no effect of the frame reads it
  bool is_sorted = false;        ///< rays are sorted, where a pass has keys for them
  /// What all effects of a frame share.
  std::shared_ptr<SharedParts> shared = std::make_shared<SharedParts>();
};

/// The pictures that an effect writes, by signal.
struct SignalPictures {
  std::vector<rtapi::Texture> signals;  ///< sums, or final pictures
  /// Of visibility; null where it is none, and where the denoiser does not read it.
  std::vector<rtapi::Texture> sharpness;
};

/// An effect that a frame renders. Its passes point into it.
class ActiveEffect {
 public:
  /// The row is one of the context's; both must stay.
  ActiveEffect(FrameContext& context, const Effect& row);
  ActiveEffect(const ActiveEffect&) = delete;
  ActiveEffect& operator=(const ActiveEffect&) = delete;

  /// Makes pictures and passes, unless it has none: main lighting. `inputs` must stay.
  /// @errors KA3046 it needs local lights, which are not rendered; those of the device.
  rtapi::Status create(const EffectInputs& inputs);
  /// Makes the passes again, with their pictures; those for other settings are gone.
  /// @errors as above.
  rtapi::Status remake();
  /// The host's work of a frame. [EffectPass::begin_frame]
  /// @errors those of the device.
  rtapi::Status begin_frame();
  /// Makes passes for other settings than the frame's, where these need some; they stay.
  /// @errors KA3046 settings.trace_only without Effect::trace; those of the device.
  rtapi::Status prepare(const EffectSettings& settings);

  /// Records its samples over the whole picture, by passes that prepare made for such settings.
  /// `constants` say which; what the settings have is filled in.
  void record(rtapi::CommandList& list, const EffectSettings& settings,
              PassConstants constants) const;
  /// Records what adds it to the finished radiance, if it does so itself. [Effect::compose]
  void record_compose(rtapi::CommandList& list, const EffectSettings& settings) const;
  /// The frame's samples in portions: by rows where it is one pass of rays, which `sorter` may put
  /// in order; null: in that of the pixels.
  SampledWork work(const RaySorter* sorter) const;
  /// Pictures like its own for another frame; `ending` is that of their names.
  /// @errors those of Frame::create_picture.
  rtapi::Result<SignalPictures> create_pictures(const Frame& frame,
                                                const std::string& ending) const;
  /// Views like its own for another frame, with such pictures.
  /// @errors KA3040 too many; those of the device.
  rtapi::Result<PassViews> create_views(const Frame& frame, const SignalPictures& pictures) const;

  /// The effect's row in the registry.
  const Effect& row() const { return row_; }
  /// As the frame renders it.
  const EffectSettings& settings() const { return settings_; }
  /// The title of its passes in statistics.
  const std::string& title() const { return title_; }
  /// False: main lighting.
  bool has_passes() const { return row_.pass || row_.make; }
  /// Reads the radiance that all others make.
  bool is_late() const { return row_.needs.radiance; }
  /// Returns whether it adds itself to the finished radiance.
  bool is_composed() const { return compose_.has_value(); }
  /// Its rays, as the frame traces them; null: it is more than one pass of them.
  const RayEffect* rays() const {
    return passes_.empty() ? nullptr : passes_.front()->pass->rays();
  }
  /// The strongest lights of each pixel. Precondition: it needs them [EffectNeeds].
  const rtapi::Texture* strongest() const { return &inputs_->lights.main()->strongest(); }
  /// Returns what it writes; nothing: it has no passes.
  const SignalPictures& pictures() const { return pictures_; }
  /// Samples that the sums hold.
  ///@{
  std::uint32_t samples() const { return samples_; }
  void set_samples(std::uint32_t samples) { samples_ = samples; }
  ///@}
  /// Bytes of what its passes as the frame has them write or alone read.
  std::uint64_t bytes() const;

 private:
  // The passes made from some settings. The first are the frame's.
  struct Passes {
    EffectSettings settings;
    PassViews views;
    std::unique_ptr<EffectPass> pass;
  };

  rtapi::Status create_pictures();
  rtapi::Result<PassViews> create_views(const Frame& frame, const SignalPictures& pictures,
                                        const GpuVolume& volume) const;
  rtapi::Status add_passes(const EffectSettings& settings);
  rtapi::Result<std::unique_ptr<EffectPass>> make(const EffectScope& scope);
  bool fits(const Passes& made, const EffectSettings& settings) const;
  const Passes* find(const EffectSettings& settings) const;
  PassConstants complete(PassConstants constants, const EffectSettings& settings) const;

  FrameContext& context_;
  const Effect& row_;
  EffectSettings settings_;
  const EffectInputs* inputs_ = nullptr;
  std::string title_;
  std::vector<std::unique_ptr<Passes>> passes_;
  std::optional<ComputePass> compose_;
  SignalPictures pictures_;
  rtapi::Texture no_sharpness_;  // stands where shaders would write it
  std::uint32_t samples_ = 0;
};

}  // namespace kaamos::effects

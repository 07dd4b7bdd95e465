// SPDX-License-Identifier: MIT
/// @file
/// An effect as its frame runs it: rays, draws, compute passes, pictures between them.
#pragma once

#include <rtapi/rtapi.h>

#include <any>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "effects/engine/effect.h"
#include "effects/engine/frame.h"

namespace kaamos::effects {

/// What several effects of a frame read, by a name of its own: the first that asks for it makes it.
using SharedParts = std::map<std::string, std::any>;

/// Everything that an effect is made from. All of it but `settings` stays for the pass's life, and
/// may be kept by reference.
struct EffectScope {
  const rtapi::Device& device;  ///< makes pipelines, pictures and buffers
  rtapi::CommandQueue& queue;   ///< for what is uploaded once
  const Frame& frame;           ///< its pictures and root table
  const Scene& scene;           ///< what is rendered
  const GpuScene& gpu;          ///< `scene` on the device; its instances follow the frame's poses
  /// One of the row's libraries, by EffectLibrary::file.
  std::function<const rtapi::ShaderLibrary&(const std::string& file)> library;
  /// Holds the effect's signals at their registers u, and what EffectNeeds ask for at theirs. The
  /// effect may set others.
  PassViews& views;
  const EffectSettings& settings;  ///< those of the frame; of this call only
  SharedParts& shared;             ///< of the frame's effects
};

class RayEffect;

/// The passes of one effect over one frame. Not for several threads at once.
class EffectPass {
 public:
  EffectPass() = default;
  EffectPass(const EffectPass&) = delete;
  EffectPass& operator=(const EffectPass&) = delete;
  virtual ~EffectPass() = default;

  /// The host's work of a frame, before anything is recorded: constants and matrices of the camera,
  /// what follows the instances. Everything recorded for the frame before has finished.
  /// @errors those of the device.
  virtual rtapi::Status begin_frame(const Camera& camera);
  /// Records the effect over the whole picture. A signal that is a sum gets
  /// constants.sample_count more samples; it begins anew where constants.accumulate is 0.
  virtual void record(rtapi::CommandList& list, const EffectSettings& settings,
                      const PassConstants& constants) = 0;
  /// Bytes of the pictures and buffers that stand between its passes.
  virtual std::uint64_t bytes() const = 0;
  /// The effect as one ray tracing pass. Null: it is more than that. [ray_effect.h]
  virtual const RayEffect* rays() const { return nullptr; }
};

/// For Effect::make: a pass with a constructor that takes the scope, and `Status create(scope)`.
/// @errors those of its create.
template <class Pass>
rtapi::Result<std::unique_ptr<EffectPass>> make_pass(const EffectScope& scope) {
  auto pass = std::make_unique<Pass>(scope);
  if (const auto s = pass->create(scope); !s) return s.error();
  return std::unique_ptr<EffectPass>(std::move(pass));
}

}  // namespace kaamos::effects

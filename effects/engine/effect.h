// SPDX-License-Identifier: MIT
/// @file
/// A row of the registry: what a frame has to know about an effect. A new effect is a folder of its
/// own and one row.
#pragma once

#include <rtapi/rtapi.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effects/engine/frame.h"
#include "effects/engine/frame_parts.h"
#include "effects/engine/ray_pass.h"
#include "effects/engine/setting.h"

namespace kaamos::effects {

/// The settings with which one effect is rendered. A row has the defaults.
struct EffectSettings {
  std::uint32_t samples = 1;     ///< per pixel, at least 1
  std::uint32_t pixel_step = 1;  ///< 2: only one pixel of each 2 x 2 is traced
  /// The traced pixel takes turns: four frames of a sequence trace all of them.
  bool rotates = false;
  float radius = 0;  ///< PassConstants::radius, metres
  /// b0 of space3, as the effect's header declares them.
  std::array<std::uint32_t, kPassWords> constants{};
  std::uint32_t constants_bytes = 0;  ///< of these: those that are in use
  bool keep = false;                  ///< rendered even where the scene has no use for it
  bool named = false;       ///< asked for by its name: rendered even beside what takes its place
  bool trace_only = false;  ///< FrameRenderer::run only: the rays without shading [Effect::trace]

  /// Sets `constants`.
  template <class T>
  EffectSettings& set_constants(const T& values) {
    static_assert(sizeof(T) <= sizeof(constants));
    std::memcpy(constants.data(), &values, sizeof(T));
    constants_bytes = sizeof(T);
    return *this;
  }
  /// `constants` as the type that they were set from.
  template <class T>
  T get_constants() const {
    static_assert(sizeof(T) <= sizeof(constants));
    T values;
    std::memcpy(static_cast<void*>(&values), constants.data(), sizeof(T));
    return values;
  }
};

/// The settings of an effect's constants by those of their struct.
template <class T>
SettingTable<EffectSettings> describe_constants(const SettingTable<T>& table) {
  SettingTable<EffectSettings> out;
  for (const SettingOf<T>& own : table) {
    SettingOf<EffectSettings>& setting = out.emplace_back();
    setting.text = own.text;
    setting.offset = own.offset;
    setting.size = own.size;
    if (!own.is_open()) continue;
    setting.get = [get = own.get](const EffectSettings& of) { return get(of.get_constants<T>()); };
    setting.set = [set = own.set](EffectSettings& of, const SettingValue& value) {
      T constants = of.get_constants<T>();
      set(constants, value);
      of.set_constants(constants);
    };
  }
  return out;
}

/// A shader library, by the file that it is compiled from.
struct EffectLibrary {
  std::string file;  ///< below effects/, without ".hlsl": "surfaces/gbuffer/gbuffer". Empty: none
  /// Loads the one that the program was built with.
  std::function<rtapi::Result<rtapi::ShaderLibrary>()> built_in;
};

/// A picture that an effect writes.
struct EffectSignal {
  std::string name;            ///< of the layer; NAME_denoised is what the denoiser makes of it
  std::uint32_t channels = 3;  ///< that hold light or visibility
  std::uint32_t output = 0;    ///< its register u of space3
  rtapi::Format format = rtapi::Format::kR32G32B32A32Float;  ///< of its picture; or R32_FLOAT
  /// Samples are added up, and the mean is denoised. false: the picture is final as it is written.
  bool is_sum = true;
  bool of_lobe = false;   ///< [Denoiser::Signal]
  bool is_light = false;  ///< shown with the frame's exposure and tone curve
  /// It is visibility, and the effect writes besides how sharp its shadows are
  /// (VisibilityDenoiser::Signal::sharpness, summed up in the same way), into a picture of
  /// R32G32B32A32_FLOAT of this register u of space3; only where PassConstants::sharpness is set.
  ///@{
  bool is_visibility = false;
  std::uint32_t sharpness_output = 0;
  ///@}
  /// The part of the frame that the composition takes it for; null: none.
  const rtapi::Texture* FrameParts::*part = nullptr;
};

/// Materials that are at least so rough, and no metals, show no mirror images.
inline constexpr float kMatteRoughness = 0.8f;

/// The inputs of an effect besides the G-buffer, and the things that the scene must have for it.
struct EffectNeeds {
  bool sun = false;           ///< the scene has a sun
  bool local_lights = false;  ///< the scene has local lights
  bool glass = false;         ///< the scene has glass, which the effect shows
  bool panes = false;         ///< the scene has glass, whose shadows the effect shows
  bool particles = false;     ///< the scene has particles
  bool glossy = false;        ///< a material is not matte [kMatteRoughness], or the effect is named
  bool lights = false;        ///< lists and shadow maps of local lights, u16 to u18 of space3
  bool volume = false;        ///< the volume of indirect light, t0 to t2 of space3
  /// `lights` and `volume` are read while the effect's passes are made, as by an environment map,
  /// and in no frame.
  bool lights_once = false;
  bool motion = false;       ///< only frames of a sequence have it
  bool perspective = false;  ///< the camera's rays leave one point
  /// The frame's radiance without reflections, in kRadiance; and the finished radiance of the frame
  /// before, u19 of space3 [KeptRadiance]. Such effects come behind all others and their denoising.
  bool radiance = false;
  /// The strongest point and spot light of each pixel, u0 of space3. Main lighting leaves them out,
  /// and adds them with the effect's first signal as their visibility (r, g); with that of the last
  /// row where several are chosen.
  bool strongest_lights = false;
};

/// One of an effect's settings between fast and accurate.
struct EffectStep {
  std::string label;             ///< "2048 x 2048, 16 taps"
  EffectSettings settings = {};  ///< all of them
};

class EffectPass;
struct EffectScope;

/// An effect as the frame sees it.
struct Effect {
  std::string name;            ///< in FrameSettings::effects and on command lines
  std::string about;           ///< a few words for --help
  EffectLibrary library = {};  ///< of `pass`, `trace` and `compose`
  /// One ray tracing pass. Without it and `make`: the frame's main lighting.
  std::function<RayPassDesc(rtapi::ShaderLibrary)> pass = {};
  /// Passes of its own instead of `pass`. [effect_pass.h]
  std::function<rtapi::Result<std::unique_ptr<EffectPass>>(const EffectScope&)> make = {};
  std::vector<EffectLibrary> more_libraries = {};  ///< of `make`, besides `library`
  /// The same rays with nothing shaded, for measuring. The volume is then empty. May be null.
  std::function<RayPassDesc(rtapi::ShaderLibrary)> trace = {};
  /// A compute shader of the library, [numthreads(8, 8, 1)], that adds the effect to the finished
  /// radiance; it has the pass's views and constants. Empty: none.
  std::string compose = {};
  std::vector<EffectSignal> signals = {};  ///< at least one
  EffectSettings defaults = {};            ///< what FrameSettings start from
  EffectNeeds needs = {};                  ///< what it reads, and what scenes must have
  /// Another effect beside which the composition does not read this one, so that it is left out
  /// unless it was asked for by its name. Empty: none.
  std::string replaced_by = {};
  /// Another effect that answers the same question. This one is no part of "all"; where it is
  /// chosen it takes the other's place in the composition, and the other is left out unless it was
  /// asked for by its name. Empty: none.
  std::string alternative_to = {};
  /// It is no part of "all": what it adds is no part of the committed references either.
  bool on_request = false;
  std::string includes = {};  ///< another effect that this one changes and so brings along
  /// Its visibility of the strongest lights is whole: their shadow maps do not count besides.
  /// [EffectNeeds::strongest_lights]
  bool shadows_alone = false;
  /// Describes EffectSettings::constants, all of them. [describe_constants]
  SettingTable<EffectSettings> constants = {};
  std::string samples_option = {};  ///< "ao-samples" for --ao-samples; empty: the count is fixed
  /// Settings from fast to accurate, for measuring. Empty: counts of samples, or the defaults where
  /// the count is fixed.
  std::vector<EffectStep> steps = {};
  /// The mean of its sums says enough without a denoiser: of all effects, frames that are not whole
  /// have such alone. [FrameSettings::whole_frame]
  bool is_plain = false;
  /// What its rays meet depends on a pixel's surface and place, from where it is seen, its
  /// strongest lights and the sample's number alone, so that a sample of the frame before can be
  /// taken again: its shaders heed PassConstants::again. [TemporalGradients]
  bool repeats = false;
  /// Frames before have a part in what it shows and in how long it takes, so that it is measured in
  /// a sequence of frames.
  bool has_history = false;
  /// Why some of its settings may show the very same picture as others, its own or those of a
  /// neighbour; empty: that would be a fault.
  std::string may_equal = {};
  std::string misses = {};  ///< what it cannot show, in a few words; empty: nothing but noise
};

/// Sets a row's default constants and describes them.
template <class T>
void set_constants(Effect& row, const T& defaults, const SettingTable<T>& table) {
  row.defaults.set_constants(defaults);
  row.constants = describe_constants(table);
}

/// Null: there is none of that name.
const Effect* find_effect(const std::vector<Effect>& effects, const std::string& name);
/// "ao, sun, ...".
std::string effect_names(const std::vector<Effect>& effects);

}  // namespace kaamos::effects

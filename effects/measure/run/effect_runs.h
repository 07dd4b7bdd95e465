// SPDX-License-Identifier: MIT
// Single effects, run again and again with any settings and seeds: what measuring needs.
#pragma once

#include <rtapi/rtapi.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effects/assets/common/checksum.h"
#include "effects/denoise/sum_load.h"
#include "effects/measure/run/frame_result.h"
#include "effects/measure/run/options.h"
#include "effects/northlight/frame_renderer.h"

namespace kaamos::measure {

// One effect and all that can be chosen of it.
struct Setting {
  std::string effect = "ao";
  effects::EffectSettings settings = {};
  std::uint32_t first_sample = 0;  // of each pixel's sequence
  bool lit = false;                // contact: what is read is the radiance of the local lights
  std::uint32_t times_ao = 0;      // multiplied with ambient occlusion of so many rays; 0: not
  bool independent = false;        // each sample has random numbers of its own: white noise

  // Changes the effect's constants.
  template <class T, class Change>
  void change(Change change_constants) {
    T constants = settings.get_constants<T>();
    change_constants(constants);
    settings.set_constants(constants);
  }
};

// That effect with `samples` rays a pixel, all else as its row of the registry has it.
Setting setting_of(const std::string& effect, std::uint32_t samples = 1);

// Milliseconds of processor time of this process over `threads` (0: all), for
// PassRunner::set_clock.
std::function<double()> cpu_clock(std::uint32_t threads);

// Adds all members, for keys.
void add_setting(effects::Checksum& checksum, const Setting& setting);
// The same in a frame of a sequence: each frame goes on with each pixel's sequence of samples.
Setting in_frame(Setting setting, std::uint32_t index);

class EffectRuns {
 public:
  // Whatever runs must be among `effects`; they stand in the frame that choose_in_frame makes.
  // `cache`: a folder for the volume of indirect light.
  // `scene` must stay.
  static rtapi::Result<Outcome> create(const Options& options, const effects::Scene& scene,
                                       const std::vector<std::string>& effects,
                                       const std::string& cache, const Progress& progress,
                                       const Say& message, std::unique_ptr<EffectRuns>& out);

  // All samples in one dispatch; sums begin anew. Glass is drawn over what lies behind it.
  rtapi::Result<effects::RunStatistics> run(const Setting& setting);
  // The same for many samples, so that it can be stopped.
  rtapi::Result<Outcome> accumulate(const Setting& setting, const Progress& progress);
  // The mean of the samples of the last run, without channels that say something else. Where one of
  // four pixels was traced, the others are worked out from them, and run() timed that too. `lit`
  // shadows: the radiance of the local lights. Glass: the frame's radiance behind and with it.
  rtapi::Result<effects::FloatImage> read(const Setting& setting);
  // Reads the background, which glass stands in front of.
  rtapi::Result<effects::FloatImage> read_background();
  // The picture to which a run adds.
  rtapi::Texture sum(const Setting& setting) const;
  rtapi::Status set_seed(std::uint32_t seed);
  // Moves on to a frame of a sequence at rest; the first one is a cut.
  rtapi::Status begin_frame(std::uint32_t index);

  // Pixels that show a surface, or glass where `glass` is set (after a run of it).
  rtapi::Result<std::vector<std::uint8_t>> mask(bool glass);

  // The radius of ambient occlusion that the options want, metres; that of the truth, too.
  float ambient_radius() const { return ao_radius_; }
  // Names what a setting shows in this frame, by all that it depends on. [picture_key]
  std::string key(const Setting& setting) const;
  effects::FrameRenderer& renderer() { return *renderer_; }

 private:
  bool is_glass(const Setting& setting) const;
  rtapi::Status create_background();
  rtapi::Status draw_background();
  rtapi::Result<effects::FloatImage> read_lit(const Setting& setting);
  rtapi::Result<effects::RunStatistics> run_independent(const Setting& setting);
  // The picture of a signal with all pixels, of one with a fourth of them; milliseconds.
  rtapi::Result<double> upscale(const effects::EffectSignal& signal, std::uint32_t samples);

  std::unique_ptr<effects::FrameRenderer> renderer_;
  float ao_radius_ = 0;
  std::string key_;                                   // of the frame
  double seconds_ = 0;                                // on the scene's clock
  std::optional<effects::CompositePass> background_;  // what glass is seen before
  std::uint32_t seed_ = 0;
  effects::FloatImage mean_;  // of the last independent samples
  struct Upscaled {
    rtapi::Texture picture;
    effects::SumLoad load;
  };
  std::map<std::string, Upscaled> upscaled_;  // by signal
};

}  // namespace kaamos::measure

// SPDX-License-Identifier: MIT
#include "effects/measure/comparison/split.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "effects/assets/image/png.h"
#include "effects/assets/image/tonemap.h"
#include "effects/indirect/indirect_diffuse/indirect_diffuse.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

// Rays per pixel where noise is not what is compared.
constexpr std::uint32_t kQuietSamples = 16;
// The same where all light is gathered, and denoised.
constexpr std::uint32_t kFewSamples = 4;

// One of the compared settings.
struct Part {
  std::string name;
  Options options;
  bool times_ao = false;  // multiply the indirect light with ambient occlusion
  // The effects of the frame that make up its radiance; empty: all.
  std::vector<std::string> signals = {};
};

Part make_part(const std::string& name, const Options& base,
               const std::vector<std::string>& effects) {
  Part part{name, base};
  choose(part.options, effects);
  return part;
}

void set_samples(Part& part, const std::string& effect, std::uint32_t samples) {
  part.options.frame.effects.at(effect).samples = samples;
}

std::vector<Part> ambient_occlusion_parts(const Options& options) {
  std::vector<Part> out;
  for (const std::uint32_t rays : {1u, 4u, 16u}) {
    out.push_back(make_part(fmt::format("ao {}", rays), options, {"ao"}));
    set_samples(out.back(), "ao", rays);
  }
  return out;
}

// With as many passes as the options want.
DenoiseDesc svgf_of(const Options& options) {
  DenoiseDesc desc = default_denoise(DenoiseMethod::kSvgf);
  desc.iterations = options.frame.denoise.iterations;
  desc.iterations_with_history = options.frame.denoise.iterations_with_history;
  return desc;
}

Part indirect_part(const Options& options, const std::string& name, IndirectMode mode,
                   bool times_ao = false) {
  std::vector<std::string> effects = {"gi"};
  if (times_ao) effects.push_back("ao");
  Part part = make_part("gi " + name, options, effects);
  part.times_ao = times_ao;
  for (auto& [effect, settings] : part.options.frame.effects) {
    settings.samples = std::max(settings.samples, kQuietSamples);
  }
  IndirectConstants constants;
  constants.mode = mode;
  part.options.frame.effects.at("gi").set_constants(constants);
  part.options.frame.denoise = svgf_of(options);
  return part;
}

// A screen-space or map technique, and the rays that it stands for.
std::vector<Part> technique_parts(const Options& options, const std::string& technique,
                                  const std::string& rays, const std::vector<std::string>& beside,
                                  std::uint32_t samples) {
  std::vector<Part> out;
  for (const std::string& name : {technique, rays}) {
    std::vector<std::string> effects = beside;
    effects.push_back(name);
    out.push_back(make_part(name, options, effects));
    FrameSettings& frame = out.back().options.frame;
    frame.whole_frame = true;
    frame.denoise = svgf_of(options);
    for (auto& [effect, settings] : frame.effects) {
      const bool is_sampled = !find_effect(northlight_effects(), effect)->samples_option.empty();
      if (is_sampled) settings.samples = std::max(settings.samples, samples);
    }
  }
  return out;
}

std::vector<Part> screen_space_ao_parts(const Options& options) {
  std::vector<Part> out = technique_parts(options, "gtao", "ao", {}, kQuietSamples);
  // Both reach as far as the technique does on the screen.
  const float radius = out.front().options.frame.effects.at("gtao").radius;
  out.back().options.frame.effects.at("ao").radius = radius;
  return out;
}

// A frame with 1 ray for each of these effects, as it is before it is denoised.
Part raw_part(const std::string& name, const Options& options,
              const std::vector<std::string>& effects) {
  Part part = make_part(name, options, effects);
  for (auto& [effect, settings] : part.options.frame.effects) settings.samples = 1;
  part.options.frame.whole_frame = true;
  part.options.frame.denoise = default_denoise(DenoiseMethod::kNone);
  return part;
}

Part denoised_part(const Part& raw, const Options& options) {
  Part part = raw;
  part.name = "denoised";
  part.options.frame.denoise = svgf_of(options);
  return part;
}

// The steps in which the deck shows how a frame is lit.
std::vector<Part> lighting_parts(const Options& options) {
  std::vector<std::string> effects = {"sun", "local", "contact"};
  Part direct = raw_part("direct", options, effects);
  direct.signals = {"sun", "local_lights"};
  effects.push_back("gi");
  Part indirect = raw_part("indirect", options, effects);
  indirect.signals = {"sun", "local_lights", "indirect"};
  const Part specular = raw_part("specular", options, {"all"});
  return {direct, indirect, specular, denoised_part(specular, options)};
}

std::vector<Part> parts_of(const Options& options) {
  if (options.split == "ao") return ambient_occlusion_parts(options);
  if (options.split == "ssao") return screen_space_ao_parts(options);
  if (options.split == "shadow-map")
    return technique_parts(options, "sun-map", "sun", {"ao"}, kQuietSamples);
  if (options.split == "ssr") {
    return technique_parts(options, "ssr", "reflections", {"all"}, kFewSamples);
  }
  const Part near_field = indirect_part(options, "near-field", IndirectMode::kNearField);
  if (options.split == "gi") {
    return {indirect_part(options, "direct", IndirectMode::kDirect, true), near_field};
  }
  if (options.split == "near-field") {
    return {indirect_part(options, "hit-black", IndirectMode::kHitBlack), near_field};
  }
  if (options.split == "lighting") return lighting_parts(options);
  const Part raw = raw_part("raw", options, {"all"});
  return {raw, denoised_part(raw, options)};
}

FloatImage first_three(const FloatImage& image) {
  FloatImage out(image.width, image.height, 3);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = image.values[i / 3 * image.channels + (image.channels >= 3 ? i % 3 : 0)];
  }
  return out;
}

// Returns whether whole frames are compared.
bool is_of_frames(const std::string& split) {
  return split == "lighting" || split == "denoise" || split == "shadow-map" || split == "ssr";
}

ByteImage picture_of(const Part& part, const Options& options, const FrameResult& frame,
                     float exposure) {
  if (options.split == "ao") return to_bytes(first_three(frame.layers.at("ao")));
  if (options.split == "ssao") {
    const bool by_rays = part.name == "ao";
    return to_bytes(first_three(frame.layers.at(by_rays ? "ao_denoised" : part.name)));
  }
  if (is_of_frames(options.split)) return tonemap(first_three(frame.radiance), exposure);
  FloatImage light = first_three(frame.layers.at("indirect_denoised"));
  if (part.times_ao) {
    const FloatImage open = first_three(frame.layers.at("ao_denoised"));
    for (std::size_t i = 0; i < light.values.size(); ++i) light.values[i] *= open.values[i];
  }
  // The sun's direct light, which the exposure is meant for, is missing.
  return tonemap(light, 1.5f * exposure);
}

}  // namespace

const std::vector<Split>& splits() {
  static const std::vector<Split> all = {
      {"ao",
       "ambient occlusion with 1, 4 and 16 rays",
       "how grain fades, and edges stay",
       "lounge",
       {}},
      {"ssao", "screen-space ambient occlusion (gtao), ray traced",
       "what the camera does not see, which occludes nothing on the left", "lounge", 0.5},
      {"shadow-map", "sun shadow by a depth map, ray traced",
       "edges in steps of texels, thin things, and where legs meet the floor", "lounge", 0.5},
      {"ssr", "screen-space reflections, ray traced",
       "what stands outside of the picture or behind something", "lounge", 0.5},
      {"gi",
       "the volume's light times ambient occlusion, gathered by rays",
       "light that leaks through walls thinner than a cell, and colour that bleeds nearby",
       "lounge",
       {}},
      {"near-field",
       "what rays hit taken as black, lit hits",
       "corners and the undersides of things",
       "lounge",
       {}},
      {"lighting",
       "the frame with 1 ray per pixel and effect: direct light only, with indirect light, with "
       "reflections and glass, denoised",
       "what each step adds, and the grain that the last one takes away", "lounge", 0.5},
      {"denoise",
       "the whole frame with 1 ray per pixel and effect, raw and denoised",
       "grain, and what of texture and edges is kept",
       "lounge",
       {}},
  };
  return all;
}

std::vector<std::string> split_names() {
  std::vector<std::string> names;
  for (const Split& split : splits()) names.push_back(split.name);
  return names;
}

const Split* find_split(const std::string& name) {
  for (const Split& split : splits()) {
    if (split.name == name) return &split;
  }
  return nullptr;
}

ByteImage side_by_side(const std::vector<ByteImage>& pictures, std::optional<double> middle) {
  ByteImage out = pictures.front();
  const std::size_t count = pictures.size();
  const std::size_t strip = out.width / count;
  const auto left = static_cast<std::size_t>(
      std::clamp(middle.value_or(0) * out.width - 0.5 * static_cast<double>(strip), 0.0,
                 static_cast<double>(out.width - strip)));
  const std::size_t line = std::max<std::size_t>(1, out.width / 640);
  for (std::size_t x = 0; x < out.width; ++x) {
    const std::size_t part = x * count / out.width;
    const std::size_t start = (part * out.width + count - 1) / count;
    const bool divider = part > 0 && x < start + line;
    const std::size_t from = middle ? std::min<std::size_t>(left + x - start, out.width - 1) : x;
    for (std::size_t y = 0; y < out.height; ++y) {
      for (std::size_t c = 0; c < out.channels; ++c) {
        const std::size_t i = (y * out.width + x) * out.channels + c;
        out.values[i] =
            divider ? 255 : pictures[part].values[(y * out.width + from) * out.channels + c];
      }
    }
  }
  return out;
}

rtapi::Result<Outcome> run_split(const Options& options, const Scene& scene,
                                 const Progress& progress, std::string& said) {
  std::vector<ByteImage> pictures;
  // Baked once for all parts.
  const std::string given = options.frame.volume.file;
  const std::string volume =
      given.empty() ? fmt::format("{}/split-volume.tmp", options.out) : given;
  rtapi::Result<Outcome> done = Outcome::kDone;
  for (Part& part : parts_of(options)) {
    part.options.frame.volume.file = volume;
    auto renderer = create_renderer(part.options, scene, options.say);
    if (!renderer) {
      done = renderer.error();
      break;
    }
    const auto show = [&](const std::string& pass, double at) {
      return progress(part.name + ": " + pass, at);
    };
    FrameResult frame;
    done = render_frame(**renderer, show, frame);
    if (!is_done(done)) break;
    if (!part.signals.empty()) {
      auto composed = read_composed(**renderer, part.signals);
      if (!composed) {
        done = composed.error();
        break;
      }
      frame.radiance = std::move(*composed);
    }
    pictures.push_back(picture_of(part, options, frame, scene.exposure));
  }
  std::error_code ignored;
  if (given.empty()) std::filesystem::remove(volume, ignored);
  if (!is_done(done)) return done;
  const Split& split = *find_split(options.split);
  const std::string path = fmt::format("{}/split-{}.png", options.out, options.split);
  if (const auto s = write_png(path, side_by_side(pictures, split.middle)); !s.ok())
    return s.error();
  said =
      fmt::format("wrote {}: from left to right {}; look at {}\n", path, split.about, split.look);
  return Outcome::kDone;
}

}  // namespace kaamos::measure

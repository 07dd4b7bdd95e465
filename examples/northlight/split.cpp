// SPDX-License-Identifier: MIT
#include "split.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "effects/image/png.h"
#include "effects/image/tonemap.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

// Rays per pixel where noise is not what is compared.
constexpr std::uint32_t kQuietSamples = 16;

rtapi::Error failure(const std::string& text) {
  return {"split", rtapi::ErrorCode::kFailed, text};
}

// One of the compared settings.
struct Part {
  std::string name;
  Options options;
  bool times_ao = false;  // multiply the indirect light with ambient occlusion
};

Options only(const Options& base, std::initializer_list<bool Options::*> effects) {
  Options out = base;
  out.ao = out.sun = out.local = out.contact = out.gi = out.reflections = out.transparent = false;
  for (bool Options::*effect : effects) out.*effect = true;
  return out;
}

std::vector<Part> ambient_occlusion_parts(const Options& options) {
  std::vector<Part> out;
  for (const std::uint32_t rays : {1u, 4u, 16u}) {
    Part part{fmt::format("ao {}", rays), only(options, {&Options::ao})};
    part.options.ao_samples = rays;
    out.push_back(part);
  }
  return out;
}

Part indirect_part(const Options& options, const std::string& mode) {
  Part part{"gi " + mode, only(options, {&Options::gi})};
  part.options.gi_mode = mode;
  part.options.gi_samples = std::max(options.gi_samples, kQuietSamples);
  part.options.denoise = "svgf";
  return part;
}

std::vector<Part> parts_of(const Options& options) {
  if (options.split == "ao") return ambient_occlusion_parts(options);
  if (options.split == "gi") {
    Part direct = indirect_part(options, "direct");
    direct.options.ao = direct.times_ao = true;
    direct.options.ao_samples = std::max(options.ao_samples, kQuietSamples);
    return {direct, indirect_part(options, "near-field")};
  }
  if (options.split == "near-field") {
    return {indirect_part(options, "hit-black"), indirect_part(options, "near-field")};
  }
  Part raw{"raw", only(options, {&Options::ao, &Options::sun, &Options::local, &Options::contact,
                                 &Options::gi, &Options::reflections, &Options::transparent})};
  raw.options.ao_samples = raw.options.sun_samples = raw.options.contact_samples =
      raw.options.gi_samples = raw.options.reflection_samples = 1;
  raw.options.denoise = "none";
  Part denoised = raw;
  denoised.name = "denoised";
  denoised.options.denoise = "svgf";
  return {raw, denoised};
}

FloatImage first_three(const FloatImage& image) {
  FloatImage out(image.width, image.height, 3);
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = image.values[i / 3 * image.channels + (image.channels >= 3 ? i % 3 : 0)];
  }
  return out;
}

ByteImage picture_of(const Part& part, const Options& options, const FrameResult& frame,
                     float exposure) {
  if (options.split == "ao") return to_bytes(first_three(frame.layers.at("ao")));
  if (options.split == "denoise") return tonemap(first_three(frame.radiance), exposure);
  FloatImage light = first_three(frame.layers.at("indirect_denoised"));
  if (part.times_ao) {
    const FloatImage open = first_three(frame.layers.at("ao_denoised"));
    for (std::size_t i = 0; i < light.values.size(); ++i) light.values[i] *= open.values[i];
  }
  // The sun's direct light, which the exposure is meant for, is missing.
  return tonemap(light, 1.5f * exposure);
}

}  // namespace

const std::vector<std::string>& split_names() {
  static const std::vector<std::string> names = {"ao", "gi", "near-field", "denoise"};
  return names;
}

ByteImage side_by_side(const std::vector<ByteImage>& pictures) {
  ByteImage out = pictures.front();
  const std::size_t count = pictures.size();
  const std::size_t line = std::max<std::size_t>(1, out.width / 640);
  for (std::size_t x = 0; x < out.width; ++x) {
    const std::size_t part = x * count / out.width;
    const std::size_t start = (part * out.width + count - 1) / count;
    const bool divider = part > 0 && x < start + line;
    for (std::size_t y = 0; y < out.height; ++y) {
      for (std::size_t c = 0; c < out.channels; ++c) {
        const std::size_t i = (y * out.width + x) * out.channels + c;
        out.values[i] = divider ? 255 : pictures[part].values[i];
      }
    }
  }
  return out;
}

rtapi::Status run_split(const Options& options, const Scene& scene,
                        const ShaderLibraries& libraries, const Progress& progress,
                        const std::atomic<bool>& stop,
                        const std::function<void(const std::string&)>& message) {
  std::vector<ByteImage> pictures;
  // Baked once for all parts.
  const std::string volume = options.gi_volume.empty()
                                 ? fmt::format("{}/split-volume.tmp", options.out)
                                 : options.gi_volume;
  rtapi::Status done;
  for (Part& part : parts_of(options)) {
    part.options.gi_volume = volume;
    auto renderer = Renderer::create(part.options, scene, message);
    if (!renderer) {
      done = renderer.error();
      break;
    }
    const auto show = [&](const std::string& pass, double at) {
      progress(part.name + ": " + pass, at);
    };
    const auto frame = (*renderer)->render(libraries, show, stop);
    if (!frame) {
      done = frame.error();
      break;
    }
    pictures.push_back(picture_of(part, options, *frame, scene.exposure));
  }
  std::error_code ignored;
  if (options.gi_volume.empty()) std::filesystem::remove(volume, ignored);
  if (!done) return done;
  const std::string path = fmt::format("{}/split-{}.png", options.out, options.split);
  if (const auto s = write_png(path, side_by_side(pictures)); !s.ok()) return failure(s.error());
  std::printf("wrote %s\n", path.c_str());
  std::fflush(stdout);
  return {};
}

}  // namespace northlight

// SPDX-License-Identifier: MIT
#include "effects/views/views.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "effects/assets/image/heat_map.h"
#include "effects/assets/image/tonemap.h"
#include "effects/views/view_passes.h"

namespace kaamos::effects {

namespace {

using Color = std::array<float, 3>;  // 0..255

constexpr Color kNothingHit = {24, 32, 72};
constexpr Color kRed = {255, 40, 30};
constexpr Color kMagenta = {255, 0, 255};

// Sets every pixel to color(x, y).
template <class ColorAt>
ByteImage picture_of(const FloatImage& numbers, ColorAt color) {
  ByteImage out{numbers.width, numbers.height, 3, {}};
  out.values.reserve(std::size_t{3} * numbers.width * numbers.height);
  for (std::uint32_t y = 0; y < numbers.height; ++y) {
    for (std::uint32_t x = 0; x < numbers.width; ++x) {
      for (const float value : Color(color(x, y))) {
        out.values.push_back(static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f));
      }
    }
  }
  return out;
}

Color color_at(const ByteImage& image, std::uint32_t x, std::uint32_t y) {
  const std::uint8_t* p = &image.values[(std::size_t{y} * image.width + x) * image.channels];
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

Color scaled(Color color, float factor) {
  for (float& value : color) value *= factor;
  return color;
}

// The frame in grey, from 0.4 to 1: colours stay readable, and shapes show through them.
float shape_of(const ByteImage& frame, std::uint32_t x, std::uint32_t y) {
  const Color c = color_at(frame, x, y);
  return 0.4f + 0.6f * (0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]) / 255;
}

Color heat_color(float heat) {
  std::uint8_t bytes[3];
  put_heat(std::isfinite(heat) ? heat : 0.0f, bytes);
  return {static_cast<float>(bytes[0]), static_cast<float>(bytes[1]), static_cast<float>(bytes[2])};
}

// Different numbers get different colours.
Color color_of(float number) {
  Color out;
  for (int c = 0; c < 3; ++c) {
    out[c] =
        255 * (0.55f + 0.45f * std::cos(number * 2.399963f + 2.0943951f * static_cast<float>(c)));
  }
  return out;
}

// The number that all but one in a thousand stay below; at least `least`.
float nearly_most(const FloatImage& numbers, std::uint32_t channel, float least) {
  std::vector<float> sorted;
  for (std::size_t i = channel; i < numbers.values.size(); i += numbers.channels) {
    sorted.push_back(std::isfinite(numbers.values[i]) ? numbers.values[i] : 0.0f);
  }
  if (sorted.empty()) return least;
  std::sort(sorted.begin(), sorted.end());
  return std::max(sorted[sorted.size() - 1 - sorted.size() / 1000], least);
}

// Colours of hits by `hit`; what has no hit is told apart.
template <class ColorAt>
ByteImage hits_of(const FloatImage& numbers, ColorAt hit) {
  return picture_of(numbers, [&](std::uint32_t x, std::uint32_t y) {
    const float distance = numbers.at(x, y, 3);
    return distance > 0 ? hit(x, y) : distance < 0 ? kNothingHit : Color{};
  });
}

const std::string kWithoutHits = "; dark blue: the ray hits nothing, black: no ray";

ViewPicture show_hit_uv(const FloatImage& numbers, const ByteImage&, float) {
  const auto part = [](float value) { return 255 * (value - std::floor(value)); };
  return {hits_of(numbers,
                  [&](std::uint32_t x, std::uint32_t y) {
                    return Color{part(numbers.at(x, y, 0)), part(numbers.at(x, y, 1)), 0};
                  }),
          "red is u, green is v, each from 0 to 1 and again" + kWithoutHits};
}

ByteImage bytes_of(const FloatImage& numbers, float exposure) {
  FloatImage color(numbers.width, numbers.height, 3);
  for (std::size_t i = 0; i < color.values.size(); ++i) {
    color.values[i] = numbers.values[i / 3 * numbers.channels + i % 3];
  }
  return exposure > 0 ? tonemap(color, exposure) : to_bytes(color, 1, 0, true);
}

ViewPicture show_hit_albedo(const FloatImage& numbers, const ByteImage&, float) {
  const ByteImage colors = bytes_of(numbers, 0);
  return {hits_of(numbers, [&](auto x, auto y) { return color_at(colors, x, y); }),
          "base colour of what is hit" + kWithoutHits};
}

ViewPicture show_hit_lighting(const FloatImage& numbers, const ByteImage&, float exposure) {
  const ByteImage colors = bytes_of(numbers, exposure);
  return {
      hits_of(numbers, [&](auto x, auto y) { return color_at(colors, x, y); }),
      "what a white matte surface would reflect there, with the frame's exposure" + kWithoutHits};
}

ViewPicture show_bottom_levels(const FloatImage& numbers, const ByteImage& frame, float) {
  const float count = nearly_most(numbers, 0, 0);
  return {
      picture_of(numbers,
                 [&](std::uint32_t x, std::uint32_t y) {
                   if (numbers.at(x, y, 3) > 0) return kRed;
                   const float level = numbers.at(x, y, 0);
                   const Color shown = color_at(frame, x, y);
                   if (level == 0) return scaled(shown, 0.5f);
                   const Color own = scaled(color_of(level), shape_of(frame, x, y));
                   Color out;
                   for (int c = 0; c < 3; ++c) out[c] = 0.45f * shown[c] + 0.4f * own[c];
                   return out;
                 }),
      fmt::format("each bottom level has a colour of its own, up to number {:.0f} in this picture; "
                  "red: edges of the instances' boxes, where no surface hides them",
                  count)};
}

ViewPicture show_light_clusters(const FloatImage& numbers, const ByteImage& frame, float) {
  float most = 1;
  for (std::size_t i = 0; i < numbers.values.size(); i += 4) {
    most = std::max(most, numbers.values[i]);
  }
  const auto is_border = [&](std::uint32_t x, std::uint32_t y) {
    const float own = numbers.at(x, y, 1);
    return (x + 1 < numbers.width && numbers.at(x + 1, y, 1) != own) ||
           (y + 1 < numbers.height && numbers.at(x, y + 1, 1) != own);
  };
  return {picture_of(numbers,
                     [&](std::uint32_t x, std::uint32_t y) {
                       const Color heat = numbers.at(x, y, 2) > 0
                                              ? kMagenta
                                              : heat_color(numbers.at(x, y, 0) / most);
                       const float line = is_border(x, y) ? 0.5f : 1.0f;
                       return scaled(heat, line * shape_of(frame, x, y));
                     }),
          fmt::format(
              "lights of the pixel's cluster: black 0, then blue, red, yellow, and white {:.0f}; "
              "dark lines part clusters; magenta: more lights than a list holds",
              most)};
}

ViewPicture show_variance(const FloatImage& numbers, const ByteImage&, float) {
  const float white = nearly_most(numbers, 1, 1e-6f);
  return {
      picture_of(numbers, [&](auto x, auto y) { return heat_color(numbers.at(x, y, 1) / white); }),
      fmt::format(
          "standard deviation of the luminance of a frame: black 0, then blue, red, yellow, "
          "and white {:.3g} or more",
          white)};
}

ViewPicture show_history_length(const FloatImage& numbers, const ByteImage&, float) {
  float most = 1;
  for (std::size_t i = 0; i < numbers.values.size(); i += 4) {
    most = std::max(most, numbers.values[i]);
  }
  return {
      picture_of(numbers, [&](auto x, auto y) { return heat_color(numbers.at(x, y, 0) / most); }),
      most > 1
          ? fmt::format("frames that stand behind the pixel: black none, then blue, red, yellow, "
                        "and white {:.0f}",
                        most)
          : "white: one frame stands behind the pixel, as in every still; a sequence "
            "(--frames) gathers more"};
}

ViewPicture show_volume_cells(const FloatImage& numbers, const ByteImage& frame, float) {
  constexpr Color kLevels[] = {
      {120, 220, 120}, {110, 150, 255}, {235, 190, 90}, {200, 120, 235}, {230, 230, 230}};
  float smallest = 0;
  for (std::size_t i = 0; i < numbers.values.size(); i += 4) {
    const float cell = numbers.values[i] == 0 ? numbers.values[i + 2] : 0.0f;
    smallest = std::max(smallest, cell);
  }
  return {picture_of(numbers,
                     [&](std::uint32_t x, std::uint32_t y) {
                       const float level = numbers.at(x, y, 0);
                       if (level < 0) return Color{};
                       // Neighbouring cells differ in brightness.
                       const float mixed = numbers.at(x, y, 1) * 0.618034f;
                       const float shade = 0.55f + 0.45f * (mixed - std::floor(mixed));
                       const Color own = numbers.at(x, y, 3) > 0
                                             ? kRed
                                             : kLevels[std::min(static_cast<int>(level), 4)];
                       return scaled(own, shade * shape_of(frame, x, y));
                     }),
          fmt::format(
              "cells in which surfaces read the volume, each in its own brightness: green level "
              "0 ({:.3g} m), blue level 1 (twice as large), then yellow, violet, white; red: in a "
              "solid, read around; black: nothing is stored",
              smallest)};
}

// A view that does not look at a signal.
auto of_frame(rtapi::Result<FloatImage> (*numbers)(FrameRenderer&)) {
  return [numbers](FrameRenderer& renderer, const std::string&) { return numbers(renderer); };
}

std::vector<View> make_views() {
  const ViewNeeds lit = {.whole_frame = true};
  const ViewNeeds indirect = {.whole_frame = true, .volume = true};
  const ViewNeeds memory = {.whole_frame = true, .memory = true};
  return {
      {.name = "hit-uv",
       .about = "texture coordinates where reflection rays hit",
       .channels = {"U", "V", "Z", "Distance"},
       .numbers = of_frame(view_hit_uv),
       .show = show_hit_uv},
      {.name = "hit-albedo",
       .about = "base colours of what reflection rays hit",
       .channels = {"R", "G", "B", "Distance"},
       .numbers = of_frame(view_hit_albedo),
       .show = show_hit_albedo},
      {.name = "hit-lighting",
       .about = "light on what reflection rays hit",
       .channels = {"R", "G", "B", "Distance"},
       .effects = {"reflections"},
       .needs = indirect,
       .numbers = of_frame(view_hit_lighting),
       .show = show_hit_lighting},
      {.name = "bottom-levels",
       .about = "boxes of the bottom levels' instances",
       .channels = {"Level", "Instance", "Primitive", "Edge"},
       .numbers = of_frame(view_bottom_levels),
       .show = show_bottom_levels},
      {.name = "light-clusters",
       .about = "how many lights each pixel's cluster has",
       .channels = {"Lights", "Cluster", "Overflow", "Z"},
       .effects = {"sun", "local"},
       .needs = lit,
       .numbers = of_frame(view_light_clusters),
       .show = show_light_clusters},
      {.name = "variance",
       .about = "variance of a signal, as its denoiser sees it",
       .channels = {"Variance", "Deviation", "Mean", "Frames"},
       .effects = {"gi"},
       .needs = memory,
       .numbers = view_variance,
       .show = show_variance},
      {.name = "history-length",
       .about = "frames that the denoiser has gathered",
       .channels = {"Frames", "Y", "Z", "W"},
       .effects = {"gi"},
       .needs = memory,
       .numbers = view_history_length,
       .show = show_history_length},
      {.name = "volume-cells",
       .about = "cells of the volume of indirect light",
       .channels = {"Level", "Cell", "Size", "Solid"},
       .effects = {"gi"},
       .needs = indirect,
       .numbers = of_frame(view_volume_cells),
       .show = show_volume_cells},
  };
}

std::string join_names(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

}  // namespace

const std::vector<View>& views() {
  static const std::vector<View> all = make_views();
  return all;
}

std::string view_names() {
  std::vector<std::string> names;
  for (const View& view : views()) names.push_back(view.name);
  return join_names(names);
}

Result<const View*> find_view(const std::string& name) {
  for (const View& view : views()) {
    if (view.name == name) return &view;
  }
  return make_error(ErrorId::kViewName, "\"" + name + "\": there are " + view_names());
}

std::vector<std::string> remembered_signals(const FrameRenderer& renderer) {
  std::vector<std::string> out;
  const FrameSettings& settings = renderer.context().settings;
  const DenoiseMethod method = settings.denoise.method;
  const bool remembers = method == DenoiseMethod::kTemporal || method == DenoiseMethod::kSvgf ||
                         method == DenoiseMethod::kControl ||
                         method == DenoiseMethod::kAdaptiveSvgf;
  if (!settings.whole_frame || !remembers) return out;
  for (const Effect& effect : renderer.context().effects) {
    if (!renderer.effects().renders(effect.name) || !(effect.pass || effect.make)) continue;
    for (const EffectSignal& signal : effect.signals) {
      if (signal.is_sum) out.push_back(signal.name);
    }
  }
  return out;
}

Status check_view(const View& view, const FrameRenderer& renderer, const std::string& signal) {
  const auto missing = [&](const std::string& what) {
    return make_error(ErrorId::kViewMissing, view.name + ": " + what);
  };
  const std::string these = "add effects, such as " + join_names(view.effects);
  if (view.needs.whole_frame && !renderer.context().settings.whole_frame) {
    return missing(
        "effects that are rendered alone have no lights, no indirect light and no "
        "denoiser; " +
        these);
  }
  if (view.needs.volume && !renderer.lights().reads_volume()) {
    return missing("no effect of the frame reads the volume of indirect light, so there is none; " +
                   these);
  }
  if (!view.needs.memory) return {};
  const std::vector<std::string> kept = remembered_signals(renderer);
  if (kept.empty()) {
    return missing("no signal of the frame is denoised over time; " + these +
                   ", and a denoiser such as svgf");
  }
  if (!signal.empty() && std::find(kept.begin(), kept.end(), signal) == kept.end()) {
    return make_error(ErrorId::kViewSignal, view.name + " of \"" + signal +
                                                "\": the frame's denoiser has " + join_names(kept));
  }
  return {};
}

rtapi::Result<FloatImage> look_at(const View& view, FrameRenderer& renderer,
                                  const std::string& signal) {
  if (const auto s = check_view(view, renderer, signal); !s.ok()) return s.error();
  const bool first = view.needs.memory && signal.empty();
  return view.numbers(renderer, first ? remembered_signals(renderer).front() : signal);
}

}  // namespace kaamos::effects

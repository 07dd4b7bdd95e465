// SPDX-License-Identifier: MIT
#include "effects/measure/claims/left_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "effects/shadows/contact_shadow/contact_shadow.h"

namespace kaamos::measure {

using namespace kaamos::effects;

namespace {

constexpr int kRounds = 5;

// A part that a scene may not need, and the scene or the options that bring it back.
struct Part {
  std::string name;
  Scene scene;
  Options options;
};

bool has_alpha_test(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    for (const Geometry& geometry : mesh.geometries) {
      if (geometry.alpha_tested) return true;
    }
  }
  return false;
}

std::vector<Part> parts_left_out(const Options& options, const Scene& scene) {
  std::vector<Part> out;
  {
    // The cost without FORCE_OPAQUE and opaque geometries: any-hit shaders run for everything.
    Part part{
        has_alpha_test(scene) ? "any-hit shaders of what is not alpha-tested" : "any-hit shaders",
        scene, options};
    for (Mesh& mesh : part.scene.meshes) {
      for (Geometry& geometry : mesh.geometries) geometry.alpha_tested = true;
    }
    out.push_back(std::move(part));
  }
  if (const auto contact = options.frame.effects.find("contact");
      contact != options.frame.effects.end() && scene_offers(scene, {.local_lights = true})) {
    Part part{"contact shadows where maps are fine enough", scene, options};
    auto constants = contact->second.get_constants<ContactShadowConstants>();
    constants.only_where_coarse = 0;
    part.options.frame.effects.at("contact").set_constants(constants);
    out.push_back(std::move(part));
  }
  for (const Effect& effect : northlight_effects()) {
    const bool is_chosen = options.frame.effects.count(effect.name) != 0;
    const bool is_replaced = is_chosen && !options.frame.effects.at(effect.name).named &&
                             options.frame.effects.count(effect.replaced_by) != 0;
    if (!is_chosen || !effect.includes.empty() ||
        (scene_offers(scene, effect.needs) && !is_replaced)) {
      continue;
    }
    out.push_back({effect.about, scene, options});
    for (auto& [name, settings] : out.back().options.frame.effects) {
      const Effect& other = *find_effect(northlight_effects(), name);
      if (&other != &effect && other.includes != effect.name) continue;
      settings.keep = true;
      if (&other != &effect) out.back().name += " and " + other.about;
    }
  }
  return out;
}

// One scene on a device of its own that can be rendered again and again.
struct Run {
  std::unique_ptr<FrameRenderer> renderer;
  std::vector<double> ms;

  rtapi::Result<Outcome> create(const Options& options, const Scene& scene,
                                const Progress& progress) {
    auto created = create_renderer(options, scene, [](const std::string&) {});
    if (!created) return created.error();
    renderer = std::move(*created);
    return renderer->prepare(progress);
  }
  rtapi::Result<Outcome> render(const Progress& progress) {
    if (const auto s = renderer->render(progress); !is_done(s)) return s;
    double sum = 0;
    for (const PassStatistics& pass : renderer->runner().passes()) sum += pass.ms;
    ms.push_back(sum);
    return Outcome::kDone;
  }
  // The last frame's radiance.
  rtapi::Result<FloatImage> picture() { return renderer->read("radiance"); }
  double median() {
    std::sort(ms.begin(), ms.end());
    return ms[ms.size() / 2];
  }
};

// RMS over all pixels and colours, in parts of the mean of `full`.
double difference(const FloatImage& plain, const FloatImage& full) {
  double squares = 0, sum = 0;
  for (std::size_t i = 0; i < full.values.size(); ++i) {
    if (i % full.channels == 3) continue;
    const double d = double{plain.values[i]} - double{full.values[i]};
    squares += d * d;
    sum += double{full.values[i]};
  }
  const auto count =
      static_cast<double>(full.values.size()) * std::min(full.channels, 3u) / full.channels;
  return sum > 0 ? std::sqrt(squares / count) / (sum / count) : 0;
}

}  // namespace

rtapi::Result<Outcome> measure_left_out(const Options& options, const Scene& scene,
                                        const Progress& progress, std::string& table) {
  table = fmt::format("{:<46}{:>12}{:>12}{:>12}{:>13}\n", "left out", "ms without", "ms with",
                      "saved ms", "difference");
  for (const Part& part : parts_left_out(options, scene)) {
    Run without, with;
    if (const auto s = without.create(options, scene, progress); !is_done(s)) return s;
    if (const auto s = with.create(part.options, part.scene, progress); !is_done(s)) return s;
    for (int round = 0; round < kRounds; ++round) {
      const auto show = [&](const std::string&, double) {
        return progress(part.name, static_cast<double>(round) / kRounds);
      };
      for (Run* run : {&without, &with}) {
        if (const auto s = run->render(show); !is_done(s)) return s;
      }
      if (!progress(part.name, (round + 1.0) / kRounds)) return Outcome::kStopped;
    }
    const double less = without.median();
    const double more = with.median();
    const auto plain = without.picture(), full = with.picture();
    if (!plain) return plain.error();
    if (!full) return full.error();
    table += fmt::format("{:<46}{:>12.1f}{:>12.1f}{:>12.1f}{:>11.2f} %\n", part.name, less, more,
                         more - less, 100 * difference(*plain, *full));
  }
  table += fmt::format(
      "medians of {} frames each, in turn, at {}x{}; difference: RMS of the last frames' radiance "
      "without and with, over the mean with\n",
      kRounds, options.frame.width, options.frame.height);
  return Outcome::kDone;
}

}  // namespace kaamos::measure

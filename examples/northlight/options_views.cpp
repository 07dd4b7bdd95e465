// SPDX-License-Identifier: MIT
#include "options_views.h"

#include <algorithm>

#include "effects/views/views.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

// Empty: no effect has such a signal.
std::string effect_of(const std::string& signal) {
  for (const Effect& effect : northlight_effects()) {
    for (const EffectSignal& own : effect.signals) {
      if (own.name == signal) return effect.name;
    }
  }
  return {};
}

}  // namespace

void add_views(CLI::App& app, Options& options) {
  std::string all;
  for (const View& view : views()) {
    all += (all.empty() ? "" : ", ") + view.name + " (" + view.about + ")";
  }
  auto* views_option =
      app.add_option("--view", options.views,
                     "write view-NAME.png and a layer of frame.exr; comma-separated: " + all)
          ->delimiter(',')
          ->check(CLI::Validator(
              [](std::string& name) {
                const auto found = find_view(name);
                return found.ok() ? std::string() : found.error().message;
              },
              ""));
  app.add_option("--view-signal", options.view_signal,
                 "whose variance and history-length: indirect, reflection, sun, ao, ...; default: "
                 "the first that is denoised over time")
      ->needs(views_option);
}

void choose_for_views(const Options& options, std::vector<std::string>& effects) {
  std::vector<std::string> wanted;
  for (const std::string& name : options.views) {
    const View& view = *find_view(name).value();
    const std::string owner = view.needs.memory ? effect_of(options.view_signal) : "";
    if (!owner.empty()) {
      add_once(wanted, owner);
    } else {
      for (const std::string& effect : view.effects) add_once(wanted, effect);
    }
  }
  if (!wanted.empty()) effects = wanted;
}

void show_views(Options& options) {
  for (const std::string& name : options.views) {
    if (find_view(name).value()->needs.whole_frame) options.frame.whole_frame = true;
  }
}

}  // namespace northlight

// SPDX-License-Identifier: MIT
#include "options_help.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "effects/northlight/described_settings.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

using Names = std::vector<std::string>;

// What most people need; the others have topics of their own.
const Names kCommon = {kSceneGroup,    kPictureGroup, kSettingsGroup,
                       kSequenceGroup, kDeviceGroup,  kResultsGroup};
const std::vector<std::pair<const char*, const char*>> kMoreGroups = {
    {kShorthandGroup, "short options for several settings at once"},
    {kInsideGroup, "what a frame is made from, and why"},
    {kReferenceGroup, "path-traced references"},
    {kMeasuringGroup, "time against error"}};

constexpr const char* kEffects = "effects";  // a topic of its own

bool holds(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Prints some groups of options.
class SomeGroups : public CLI::Formatter {
 public:
  explicit SomeGroups(Names groups) : groups_(std::move(groups)) {}
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override {
    std::string out = make_description(app) + make_usage(app, std::move(name));
    for (const std::string& group : groups_) {
      const auto options =
          app->get_options([&](const CLI::Option* option) { return option->get_group() == group; });
      if (!options.empty()) out += make_group(group, false, options);
    }
    return out;
  }

 private:
  Names groups_;
};

Names group_names() {
  Names out = kCommon;
  for (const auto& group : kMoreGroups) out.emplace_back(group.first);
  return out;
}

bool is_effect(const std::string& topic) {
  return find_effect(northlight_effects(), topic) != nullptr;
}

std::string line(const std::string& name, const std::string& about) {
  return fmt::format("  {:<27} {}\n", name, about);
}

std::string list_topics() {
  std::string out = "\n--help=TOPIC tells the rest:\n";
  for (const auto& [name, about] : kMoreGroups) out += line(name, about);
  out += line(kEffects, "every technique");
  out += line("all", "every option and setting");
  out += "\nEvery number and switch of a technique is a setting, --TOPIC-NAME VALUE:\n";
  for (const SettingTopic& topic : setting_topics()) {
    if (!is_effect(topic.name)) out += line(topic.name, topic.about);
  }
  out += line("TECHNIQUE", "gtao, sun-pcss and the like, as --help=effects lists them");
  return out;
}

std::string list_effects() {
  std::string out = "\neffects:\n";
  for (const Effect& effect : northlight_effects()) {
    const std::string instead =
        effect.alternative_to.empty() ? "" : " (in the place of " + effect.alternative_to + ")";
    out += line(effect.name, effect.about + instead);
  }
  return out;
}

std::string describe(const DescribedSetting& setting) {
  const SettingText& text = setting.text;
  return fmt::format("  --{} ({})\n{:30}{}: {}{}\n", setting.full_name(),
                     value_text(setting.default_value()), "", allowed_text(text), text.about,
                     text.source.empty() ? "" : " [" + text.source + "]");
}

std::string describe_topic(const SettingTopic& topic) {
  std::string out = fmt::format("\n{} ({}):\n", topic.name, topic.about);
  for (const DescribedSetting& setting : describe_settings()) {
    if (setting.topic == topic.name) out += describe(setting);
  }
  return out;
}

// The denoiser, and the rays of what stands for no other effect.
std::string describe_quality() {
  std::string out = "\nquality:\n";
  for (const DescribedSetting& setting : describe_settings()) {
    const Effect* effect = find_effect(northlight_effects(), setting.topic);
    const bool is_first = effect != nullptr && effect->alternative_to.empty();
    if ((is_first && setting.text.name == "samples") || setting.path() == "denoise.method") {
      out += describe(setting);
    }
  }
  return out;
}

std::string groups_text(CLI::App& app, const Names& groups) {
  app.formatter(std::make_shared<SomeGroups>(groups));
  return app.help();
}

}  // namespace

std::optional<std::string> asked_topic(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.starts_with("--help=")) return word.substr(word.find('=') + 1);
    if (word != "--help" && word != "-h") continue;
    const bool has_next = i + 1 < argc && argv[i + 1][0] != '-';
    return has_next ? argv[i + 1] : "";
  }
  return std::nullopt;
}

std::string help_text(CLI::App& app, const std::string& topic, std::string& error) {
  if (topic == "page") return settings_page();
  if (topic.empty()) return groups_text(app, kCommon) + describe_quality() + list_topics();
  const std::vector<SettingTopic> topics = setting_topics();
  if (topic == kEffects) return list_effects();
  if (topic == "all") {
    std::string out = groups_text(app, group_names());
    for (const SettingTopic& each : topics) out += describe_topic(each);
    return out;
  }
  Names names = group_names();
  names.emplace_back(kEffects);
  std::string out = holds(names, topic) ? groups_text(app, {topic}) : "";
  for (const SettingTopic& each : topics) {
    names.push_back(each.name);
    if (each.name == topic) out += describe_topic(each);
  }
  if (!out.empty()) return out;
  const std::string nearest = nearest_name(names, topic);
  error = "there is no topic \"" + topic + "\"" +
          (nearest.empty() ? "" : "; the nearest is \"" + nearest + "\"") + ": --help lists them";
  return {};
}

}  // namespace northlight

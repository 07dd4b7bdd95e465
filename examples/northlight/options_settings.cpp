// SPDX-License-Identifier: MIT
#include "options_settings.h"

#include <algorithm>
#include <map>

#include "effects/assets/common/file.h"
#include "effects/northlight/settings_file.h"

namespace northlight {

using namespace kaamos::effects;

namespace {

const std::vector<DescribedSetting>& all_settings() {
  static const std::vector<DescribedSetting> settings = describe_settings();
  return settings;
}

const DescribedSetting* find_setting(const std::string& name) {
  for (const DescribedSetting& setting : all_settings()) {
    if (setting.full_name() == name) return &setting;
  }
  return nullptr;
}

// Short names of what is chosen most.
std::map<std::string, std::string> make_short_names() {
  std::map<std::string, std::string> out = {{"contact-combine", "lights-contact-combination"},
                                            {"denoise", "denoise-method"},
                                            {"firefly-limit", "reflections-firefly-limit"},
                                            {"fireflies", "reflections-fireflies"},
                                            {"gi-bake-error", "volume-error"},
                                            {"gi-bake-samples", "volume-samples"},
                                            {"gi-cell", "volume-cell"},
                                            {"light-culling", "lights-culling"},
                                            {"light-maps", "lights-maps"},
                                            {"primary", "surfaces-primary"},
                                            {"reflection-length", "reflections-longest"},
                                            {"reflection-length-rough", "reflections-shortest"},
                                            {"sort-rays", "surfaces-order"},
                                            {"sun-map-size", "lights-sun-map"}};
  for (const Effect& effect : northlight_effects()) {
    const std::string full_name = effect.name + "-samples";
    if (effect.samples_option.empty() || effect.samples_option == full_name) continue;
    out[effect.samples_option] = full_name;
  }
  return out;
}

std::string full_name(const std::string& option) {
  static const std::map<std::string, std::string> short_names = make_short_names();
  const auto found = short_names.find(option);
  return found == short_names.end() ? option : found->second;
}

std::string load(const std::string& path, Options& options) {
  const auto bytes = read_file(path);
  if (!bytes.ok()) return bytes.error().message;
  const std::string text(bytes.value().begin(), bytes.value().end());
  const auto s = read_settings(text, path, options.frame, options.effects);
  return s ? std::string() : s.error().message;
}

}  // namespace

void add_settings(CLI::App& app, SettingWords& words) {
  app.add_option("--settings", words.files,
                 "a JSON file of settings, as --print-settings prints it, or some of them; may be "
                 "repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_flag("--print-settings", words.print,
               "print every setting of every technique with its value, and exit");
  app.add_option("--set", words.assigned,
                 "NAME=VALUE: one setting, the same as --NAME VALUE, as in gtao-slices=3; may be "
                 "repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

std::vector<char*> take_settings(int argc, char** argv, const CLI::App& app, SettingWords& words,
                                 std::string& error) {
  std::vector<char*> rest = {argv[0]};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t equals = word.find('=');
    const std::string option = word.substr(0, equals);
    const bool is_own = app.get_option_no_throw(option) != nullptr;
    const DescribedSetting* setting =
        option.starts_with("--") && !is_own ? find_setting(full_name(option.substr(2))) : nullptr;
    if (setting == nullptr) {
      rest.push_back(argv[i]);
      continue;
    }
    const bool has_next = i + 1 < argc && !std::string(argv[i + 1]).starts_with("--");
    if (equals != std::string::npos) {
      words.chosen.emplace_back(setting->full_name(), word.substr(equals + 1));
    } else if (has_next) {
      words.chosen.emplace_back(setting->full_name(), argv[++i]);
    } else if (setting->text.type == SettingType::kSwitch) {
      words.chosen.emplace_back(setting->full_name(), "on");
    } else {
      error = option + " has no value; choose " + allowed_text(setting->text);
    }
  }
  return rest;
}

std::string read_setting_files(const SettingWords& words, Options& options) {
  for (const std::string& file : words.files) {
    if (std::string error = load(file, options); !error.empty()) return error;
  }
  return {};
}

std::string list_settings(const SettingWords& words, Options& options) {
  auto& chosen = options.settings;
  for (const std::string& text : words.assigned) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      return "--set " + text + " has no value: give NAME=VALUE, as in gtao-slices=3";
    }
    chosen.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  chosen.insert(chosen.end(), words.chosen.begin(), words.chosen.end());
  // A method comes before the numbers that it brings along.
  std::stable_partition(chosen.begin(), chosen.end(),
                        [](const auto& each) { return each.first == "denoise-method"; });
  return {};
}

std::string apply_settings(Options& options) {
  for (const auto& [name, value] : options.settings) {
    const auto s = set_setting(all_settings(), name, value, options.frame, options.effects);
    if (!s) return s.error().message;
  }
  for (auto& [name, settings] : options.frame.effects) {
    const bool named = settings.named;
    settings = options.effects.at(name);
    settings.named = named;
  }
  return {};
}

bool is_chosen(const SettingWords& words, const std::string& name) {
  const auto assigns = [&](const std::string& text) { return text.starts_with(name + "="); };
  return std::any_of(words.chosen.begin(), words.chosen.end(),
                     [&](const auto& each) { return each.first == name; }) ||
         std::any_of(words.assigned.begin(), words.assigned.end(), assigns);
}

std::string nearest_option(const CLI::App& app, const std::string& mistyped) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (const DescribedSetting& setting : all_settings()) {
    names.push_back("--" + setting.full_name());
  }
  return nearest_name(names, mistyped.substr(0, mistyped.find('=')));
}

}  // namespace northlight

// SPDX-License-Identifier: MIT
#include "effects/northlight/settings_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "effects/assets/common/errors.h"

namespace kaamos::effects {

namespace {

using nlohmann::ordered_json;

ordered_json as_json(const SettingValue& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    return std::isinf(*number) ? ordered_json(value_text(value)) : ordered_json(*number);
  }
  return std::visit([](const auto& held) { return ordered_json(held); }, value);
}

// Nothing: a value that no setting has.
std::optional<SettingValue> from_json(const ordered_json& value) {
  if (value.is_boolean()) return SettingValue(value.get<bool>());
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > 0x7FFFFFFFFFFFFFFFu) {
    return SettingValue(value.get<double>());
  }
  if (value.is_number_integer()) return SettingValue(value.get<std::int64_t>());
  if (value.is_number()) return SettingValue(value.get<double>());
  if (value.is_string()) return SettingValue(value.get<std::string>());
  return std::nullopt;
}

rtapi::Error wrong(const std::string& text) {
  return make_error(ErrorId::kSetting, text);
}

// `known` names, of which "the nearest" is one.
rtapi::Error unknown(const std::string& what, const std::string& name,
                     const std::vector<std::string>& known) {
  const std::string nearest = nearest_name(known, name);
  return wrong("there is no " + what + " \"" + name + "\"" +
               (nearest.empty() ? std::string() : "; the nearest is \"" + nearest + "\""));
}

rtapi::Status check_names(const ordered_json& in, const std::vector<DescribedSetting>& settings) {
  for (const auto& [topic, members] : in.items()) {
    std::vector<std::string> topics, paths;
    for (const DescribedSetting& setting : settings) {
      if (topics.empty() || topics.back() != setting.topic) topics.push_back(setting.topic);
      if (setting.topic == topic) paths.push_back(setting.path());
    }
    if (paths.empty()) return unknown("topic", topic, topics);
    if (!members.is_object()) {
      return wrong(topic + " is " + members.dump() + "; it has to be an object of settings");
    }
    for (const auto& [name, value] : members.items()) {
      const std::string path = topic + "." + name;
      if (std::find(paths.begin(), paths.end(), path) == paths.end()) {
        return unknown("setting", path, paths);
      }
      if (!from_json(value)) {
        return wrong(path + " is " + value.dump() +
                     "; it has to be a number, true, false or a "
                     "string");
      }
    }
  }
  return {};
}

}  // namespace

std::string write_settings(const FrameSettings& frame, const SettingsOfEffects& chosen,
                           const std::vector<Effect>& effects) {
  ordered_json out = ordered_json::object();
  for (const DescribedSetting& setting : describe_settings(effects)) {
    out[setting.topic][setting.text.name] = as_json(setting.get(frame, chosen));
  }
  return out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

rtapi::Status read_settings(const std::string& text, const std::string& where, FrameSettings& frame,
                            SettingsOfEffects& chosen, const std::vector<Effect>& effects) {
  const auto fail = [&](const rtapi::Error& error) -> rtapi::Status {
    return within(where, error, ErrorId::kSetting);
  };
  ordered_json in;
  try {
    in = ordered_json::parse(text);
  } catch (const ordered_json::exception& problem) {
    return fail(wrong(std::string("no JSON: ") + problem.what()));
  }
  if (!in.is_object()) return fail(wrong("it has to be an object with one for each topic"));
  const std::vector<DescribedSetting> settings = describe_settings(effects);
  if (const auto s = check_names(in, settings); !s) return fail(s.error());
  FrameSettings changed = frame;
  SettingsOfEffects changed_effects = chosen;
  // In the order of the list: a method comes before the numbers that it brings along.
  for (const DescribedSetting& setting : settings) {
    if (!in.contains(setting.topic) || !in[setting.topic].contains(setting.text.name)) continue;
    SettingText named = setting.text;
    named.name = setting.path();
    const auto value = check_value(named, *from_json(in[setting.topic][setting.text.name]));
    if (!value) return fail(value.error());
    setting.set(changed, changed_effects, *value);
  }
  frame = std::move(changed);
  chosen = std::move(changed_effects);
  return {};
}

rtapi::Status set_setting(const std::vector<DescribedSetting>& settings, const std::string& name,
                          const std::string& value, FrameSettings& frame,
                          SettingsOfEffects& chosen) {
  std::vector<std::string> names;
  for (const DescribedSetting& setting : settings) {
    names.push_back(setting.full_name());
    if (names.back() != name) continue;
    SettingText named = setting.text;
    named.name = name;
    const auto parsed = parse_value(named, value);
    if (!parsed) return parsed.error();
    setting.set(frame, chosen, *parsed);
    return {};
  }
  return unknown("setting", name, names);
}

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
/// @file
/// Every setting of a frame and of the registry's effects, described: command lines, files and
/// tables of settings follow from this list.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "effects/northlight/settings.h"

namespace kaamos::effects {

/// Settings of effects by name. Where one is missing its row's defaults count.
using SettingsOfEffects = std::map<std::string, EffectSettings>;

/// A setting that can be chosen for a frame.
struct DescribedSetting {
  std::string topic;  ///< the effect's name, or "denoise" and the like
  SettingText text;   ///< what it is, and which values are allowed
  /// Reads it.
  std::function<SettingValue(const FrameSettings&, const SettingsOfEffects&)> get;
  /// Takes a value that check_value allows.
  std::function<void(FrameSettings&, SettingsOfEffects&, const SettingValue&)> set;

  std::string full_name() const { return topic + "-" + text.name; }  ///< "gtao-slices"
  std::string path() const { return topic + "." + text.name; }       ///< "gtao.slices", in files
  SettingValue default_value() const { return get({}, {}); }         ///< what frames start from
};

/// A group of settings.
struct SettingTopic {
  std::string name;   ///< DescribedSetting::topic
  std::string about;  ///< a few words
};

/// The topics in their order: the frame's, then those effects that have settings.
std::vector<SettingTopic> setting_topics(const std::vector<Effect>& effects = northlight_effects());
/// All settings, topic by topic. Not among them are those that are no part of a technique: the
/// frame's size, seed and effects, and how many views its passes get.
std::vector<DescribedSetting> describe_settings(
    const std::vector<Effect>& effects = northlight_effects());

/// The table of all settings as a page in Markdown.
std::string settings_page(const std::vector<Effect>& effects = northlight_effects());

}  // namespace kaamos::effects

// SPDX-License-Identifier: MIT
// --help and --help=TOPIC: groups of options, and every described setting.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace northlight {

// The groups of options, as CLI::Option::group has them.
inline constexpr const char* kSceneGroup = "scene";
inline constexpr const char* kPictureGroup = "picture";
inline constexpr const char* kSettingsGroup = "settings";
inline constexpr const char* kSequenceGroup = "sequence";
inline constexpr const char* kDeviceGroup = "device";
inline constexpr const char* kResultsGroup = "results";
inline constexpr const char* kShorthandGroup = "shorthands";
inline constexpr const char* kInsideGroup = "inside";
inline constexpr const char* kReferenceGroup = "reference";
inline constexpr const char* kMeasuringGroup = "measuring";

// The topic that a command line asks for: --help, -h (""), --help=TOPIC or --help TOPIC. Nothing:
// it asks for no help.
std::optional<std::string> asked_topic(int argc, char** argv);
// Empty: there is no such topic, and `error` says what there is.
std::string help_text(CLI::App& app, const std::string& topic, std::string& error);

}  // namespace northlight

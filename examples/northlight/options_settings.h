// SPDX-License-Identifier: MIT
// The options that follow from the described settings: --TOPIC-NAME VALUE, --set, --settings.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "options.h"

namespace northlight {

// What a command line says of described settings.
struct SettingWords {
  std::vector<std::string> files;                           // in their order
  std::vector<std::pair<std::string, std::string>> chosen;  // full names and values, likewise
  std::vector<std::string> assigned;                        // of --set: NAME=VALUE
  bool print = false;
};

void add_settings(CLI::App& app, SettingWords& words);

// Takes the options of described settings out of a command line; what is left is for `app`, whose
// own options come first. Sets `error` where a value is missing.
std::vector<char*> take_settings(int argc, char** argv, const CLI::App& app, SettingWords& words,
                                 std::string& error);

// Reads the files into the options; returns an error, or nothing.
std::string read_setting_files(const SettingWords& words, Options& options);
// What was chosen by name, in the order in which it is set; an error, or nothing.
std::string list_settings(const SettingWords& words, Options& options);
// Sets options.settings in all effects and in those of the frame; returns an error, or nothing.
std::string apply_settings(Options& options);
// Returns whether a setting of this full name was chosen.
bool is_chosen(const SettingWords& words, const std::string& name);

// The option or setting that a mistyped word is closest to; empty: none is close.
std::string nearest_option(const CLI::App& app, const std::string& mistyped);

}  // namespace northlight

// SPDX-License-Identifier: MIT
// northlight's options that measure instead of rendering a frame, and those of path-traced
// references.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "options.h"
#include "options_settings.h"

namespace northlight {

// The values of options that are words, kept until all options have been read.
struct MeasureWords {
  std::string clock = "wall";
  std::string study;
};

// What was typed, but for --families, --rows and --out.
std::string typed_command(int argc, char** argv);

// "a, b, c".
std::string join(const std::vector<std::string>& names);

void add_path_reference(CLI::App& app, Options& options);
void add_measuring(CLI::App& app, Options& options, MeasureWords& words);
// The sizes and counts that were not given, by what is measured.
void apply_measuring(const CLI::App& app, const MeasureWords& words, const SettingWords& settings,
                     Options& options);

}  // namespace northlight

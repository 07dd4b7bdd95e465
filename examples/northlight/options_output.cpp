// SPDX-License-Identifier: MIT
#include "options_output.h"

#include "layers.h"

namespace northlight {

void add_output(CLI::App& app, Options& options) {
  app.add_option("--layers", options.layers,
                 "layers written beside the finished frame, comma-separated: names such as normal, "
                 "ao or indirect_denoised, all, none; default: the signals of effects that are "
                 "named")
      ->delimiter(',')
      ->check(CLI::Validator([](std::string& name) { return check_layer_name(name); }, ""));
  app.add_flag("--profile", options.shows_profile,
               "print how long each step of the run takes: start-up, passes, files");
}

}  // namespace northlight

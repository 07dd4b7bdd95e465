// SPDX-License-Identifier: MIT
//
// kaamos-errors --markdown: prints rtapi/ERRORS.md; --header: prints <rtapi/error_ids.h>.
#include <cstdio>
#include <string_view>

#include "tests/errors/tables.h"

int main(int argc, char** argv) {
  using namespace kaamos::errors;
  const std::string_view option = argc == 2 ? argv[1] : "";
  if (option != "--markdown" && option != "--header") {
    std::fputs(
        "kaamos-errors --markdown|--header: prints every error id as rtapi/ERRORS.md or as\n"
        "rtapi/include/rtapi/error_ids.h\n",
        stderr);
    return 2;
  }
  const std::string text = option == "--header" ? header(all_layers()) : markdown(all_layers());
  std::fputs(text.c_str(), stdout);
  for (const std::string& fault : faults_of(all_layers())) {
    std::fprintf(stderr, "kaamos-errors: %s\n", fault.c_str());
  }
  return faults_of(all_layers()).empty() ? 0 : 1;
}

// SPDX-License-Identifier: MIT
//
// kaamos-errors --markdown: prints rtapi/ERRORS.md.
#include <cstdio>
#include <string_view>

#include "tests/errors/tables.h"

int main(int argc, char** argv) {
  using namespace kaamos::errors;
  if (argc != 2 || std::string_view(argv[1]) != "--markdown") {
    std::fputs("kaamos-errors --markdown: prints every error id as rtapi/ERRORS.md\n", stderr);
    return 2;
  }
  std::fputs(markdown(all_layers()).c_str(), stdout);
  for (const std::string& fault : faults_of(all_layers())) {
    std::fprintf(stderr, "kaamos-errors: %s\n", fault.c_str());
  }
  return faults_of(all_layers()).empty() ? 0 : 1;
}

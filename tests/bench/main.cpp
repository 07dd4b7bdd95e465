// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <iostream>

#include "suite.h"

int main(int argc, char** argv) {
  return kaamos::bench::run_program({argv + 1, argv + argc}, std::cout, std::cerr,
                                    isatty(STDERR_FILENO) != 0);
}

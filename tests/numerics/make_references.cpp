// SPDX-License-Identifier: MIT
//
// kaamos-references FILE.exr: renders the lounge's reference (tests/numerics/README.md).
#include <rtapi/rtapi.h>

#include <cstdio>

#include "lounge_reference.h"

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fputs("usage: kaamos-references FILE.exr\n", stderr);
    return 2;
  }
  const kaamos::effects::Status status = kaamos::test::write_lounge_reference(argv[1]);
  if (!status.ok()) {
    std::fprintf(stderr, "kaamos-references: %s\n", status.error().message.c_str());
    return 1;
  }
  return 0;
} catch (const rtapi::ResultError& error) {
  std::fprintf(stderr, "kaamos-references: %s\n", error.what());
  return 1;
}

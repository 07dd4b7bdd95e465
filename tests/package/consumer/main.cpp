// SPDX-License-Identifier: MIT
// Names the shader interface version that the installed headers describe.
#include <cstdio>

#include <kaamos/shader/abi.h>

int main() {
  std::printf("shader ABI %u\n", static_cast<unsigned>(kaamos::shader::kAbiVersion));
  return 0;
}

// SPDX-License-Identifier: MIT
struct Guard {
  int depth;
};
bool run_guarded(void* argument);

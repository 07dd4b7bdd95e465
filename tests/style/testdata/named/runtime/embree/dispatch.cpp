// SPDX-License-Identifier: MIT
// run_row() was here.
void run_tile(void* argument) {
  run_guarded(argument);
}

// SPDX-License-Identifier: MIT
// The console's calls of MSVC's C library; no key is ever pressed. [MSVC: conio.h]
#pragma once

#include <kaamos_crt.h>

inline int _kbhit() {
  return 0;
}
/// What comes from the standard input stream, or EOF.
inline int _getch() {
  return getchar();
}

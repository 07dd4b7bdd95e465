// SPDX-License-Identifier: MIT
// Folders. [MSVC: direct.h]
#pragma once

#include <sys/stat.h>
#include <unistd.h>

inline char* _getcwd(char* path, int size) {
  return getcwd(path, (size_t)size);
}
extern "C" int _mkdir(const char* path);
extern "C" int _chdir(const char* path);

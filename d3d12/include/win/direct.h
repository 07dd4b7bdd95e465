// SPDX-License-Identifier: MIT
// Folders. [MSVC: direct.h]
#pragma once

#include <sys/stat.h>
#include <unistd.h>

inline char* _getcwd(char* path, int size) {
  return getcwd(path, (size_t)size);
}
inline int _mkdir(const char* path) {
  return mkdir(path, 0777);
}
inline int _chdir(const char* path) {
  return chdir(path);
}

// SPDX-License-Identifier: MIT
//
// Coverage of shaders: which lines and arms of branches ran. A library that was compiled for it has
// a table of its points beside its LibraryDesc; others have none.
#pragma once

#include <cstdint>

namespace kaamos::shader {

// A place in the source that runs or does not.
struct CoveragePoint {
  uint32_t file;    // index into CoverageDesc::files
  uint32_t line;    // from 1
  uint32_t column;  // of the branch, from 1; 0: the point is the line itself
  uint32_t arm;     // of the branch. if: 0 then, 1 else; loops: 0 another turn, 1 the end;
                    // switch: the sections in their order, and the missing default
};

struct CoverageDesc {
  const char* const* files;
  uint32_t file_count;
  const CoveragePoint* points;
  uint32_t point_count;
  uint8_t* ran;  // a byte for each point: 1 once it ran. Read and written atomically
};

// Many threads come to the same point, most of them after the first.
inline void cover(uint8_t& ran) {
  if (__atomic_load_n(&ran, __ATOMIC_RELAXED) == 0) __atomic_store_n(&ran, 1, __ATOMIC_RELAXED);
}

// A library that is compiled at run time has a second symbol if it collects coverage.
inline constexpr char kCoverageEntryPoint[] = "kaamos_shader_library_coverage";
using CoverageEntryPointFn = const CoverageDesc* (*)();

}  // namespace kaamos::shader

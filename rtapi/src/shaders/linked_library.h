// SPDX-License-Identifier: MIT
//
// Libraries that call each other's functions, compiled together for a state object.
#pragma once

#include <string>
#include <vector>

#include <rtapi/shader_library.h>

#include "rtapi/src/shaders/module_library.h"

namespace rtapi::detail {

// The definition that an import means: exports and imports by index, libraries by their place in
// LinkPlan::libraries.
struct LinkedImport {
  uint32_t library = 0;
  uint32_t import = 0;  // of LibraryDesc::imports
  uint32_t from = 0;
  uint32_t definition = 0;  // of LibraryDesc::exports
};

struct LinkPlan {
  std::vector<ShaderLibrary> libraries;  // the first has the entry points
  std::vector<uint32_t> entries;         // exports of the first library
  std::vector<LinkedImport> imports;
};

// Keeps what it makes, because programs make the same state objects again and again.
ModuleLibrary linked_library(const LinkPlan& plan, bool spirv);

}  // namespace rtapi::detail

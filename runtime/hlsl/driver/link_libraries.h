// SPDX-License-Identifier: MIT
//
// Libraries that call each other's functions, compiled as one module from the sources that they
// carry. The checker joins them, so that every executor runs the result like a library of one file.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/check.h"
#include "runtime/hlsl/ir/ir.h"
#include "runtime/hlsl/ir/result.h"

namespace kaamos::hlsl {

struct LibrarySource {
  std::string_view text;  // made by embed_source
  std::vector<LinkedUnit::Register> registers;
};

struct LinkRequest {
  std::vector<LibrarySource> libraries;
  std::vector<std::string> entries;  // as Link::entries
  std::vector<Link::Definition> definitions;
  bool check_access = false;
  bool coverage = false;
};

// The entry points of the first library.
Result<std::unique_ptr<ir::Module>> link_libraries(const LinkRequest& request);

}  // namespace kaamos::hlsl

// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <kaamos/shader/abi.h>
#include <kaamos/shader/coverage.h>
#include <rtapi/result.h>
#include <rtapi/shader_library.h>

namespace rtapi::detail {

struct ShaderLibraryImpl {
  const kaamos::shader::LibraryDesc* desc = nullptr;
  std::shared_ptr<const void> owner;  // keeps desc and the code alive; empty for built-in libraries
  std::string name;
  std::string target;
  std::vector<ShaderExportInfo> exports;  // same order as desc->exports
};

// LoadShaderLibrary for one whose coverage is collected unless it is null.
Result<ShaderLibrary> load_library(const kaamos::shader::LibraryDesc* desc,
                                   const kaamos::shader::CoverageDesc* coverage,
                                   std::shared_ptr<const void> owner, const std::string& where);

}  // namespace rtapi::detail

// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <kaamos/shader/abi.h>
#include <rtapi/shader_library.h>

namespace rtapi::detail {

struct ShaderLibraryImpl {
  const kaamos::shader::LibraryDesc* desc = nullptr;
  std::shared_ptr<const void> owner;  // keeps desc and the code alive; empty for built-in libraries
  std::string name;
  std::string target;
  std::vector<ShaderExportInfo> exports;  // same order as desc->exports
};

}  // namespace rtapi::detail

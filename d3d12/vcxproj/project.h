// SPDX-License-Identifier: MIT
//
// What a D3D12 program is made of, as kaamos_add_d3d12_program and kaamos_add_d3d12_shader take it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "d3d12/vcxproj/notes.h"
#include "d3d12/vcxproj/text.h"

namespace kaamos::vcxproj {

// One call of the shader compiler.
struct Shader {
  std::filesystem::path source;
  std::string profile;                // such as ps_6_0
  std::string entry;                  // "" for libraries, and for main
  std::string object;                 // below the program's folder
  std::filesystem::path header_path;  // where the project writes the header; empty without one
  std::string header;                 // as sources include it
  std::string variable;               // of that header
  std::vector<std::filesystem::path> includes;
  std::vector<std::string> options;  // of kaamos-dxc, besides
};

// A file that the program reads, and where it is expected, below the program's folder.
struct Content {
  std::filesystem::path source;
  std::string destination;
};

struct Project {
  std::string name;
  std::string type;  // ConfigurationType, such as Application
  std::string configuration;
  std::filesystem::path file;
  std::vector<std::filesystem::path> sources;
  std::vector<std::filesystem::path> headers;
  std::vector<std::filesystem::path> includes;
  std::vector<std::string> defines;
  std::vector<std::string> forced_includes;
  std::vector<std::string> options;  // of clang
  std::vector<Shader> shaders;
  std::vector<Content> contents;
};

// Imports `file`, an absolute path, and the static libraries that it refers to, whose sources
// become the program's. Without a value `notes` has errors.
std::optional<Project> import_project(const std::filesystem::path& file, const NameMap& fixed,
                                      Notes& notes);

}  // namespace kaamos::vcxproj

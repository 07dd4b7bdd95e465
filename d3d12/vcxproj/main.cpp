// SPDX-License-Identifier: MIT
//
// kaamos-import-vcxproj: writes a CMakeLists.txt for a D3D12 program of Visual Studio.
#include <CLI/CLI.hpp>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

#include <rtapi/version.h>

#include "d3d12/vcxproj/cmake_lists.h"
#include "d3d12/vcxproj/paths.h"
#include "d3d12/vcxproj/project.h"
#include "runtime/files/write_file.h"

namespace {

namespace fs = std::filesystem;
using namespace kaamos::vcxproj;

struct Options {
  std::string project;
  std::string configuration = "Release";
  std::string platform = "x64";
  std::vector<std::string> properties;
  std::vector<std::string> includes;
  std::string out;
  bool force = false;
};

std::string version() {
  return std::to_string(rtapi::kVersionMajor) + "." + std::to_string(rtapi::kVersionMinor) + "." +
         std::to_string(rtapi::kVersionPatch);
}

int fail(const std::string& text) {
  std::cerr << "kaamos-import-vcxproj: " << text << "\n";
  return 1;
}

int import(const Options& options) {
  NameMap fixed = {{"Configuration", options.configuration}, {"Platform", options.platform}};
  for (const std::string& property : options.properties) {
    const size_t equals = property.find('=');
    if (equals == std::string::npos || equals == 0) {
      return fail("--property " + property + ": give NAME=VALUE, such as SolutionDir=../");
    }
    fixed[property.substr(0, equals)] = property.substr(equals + 1);
  }
  const fs::path file = absolute_path(fs::current_path(), options.project);
  const fs::path out = options.out.empty() ? file.parent_path() / "CMakeLists.txt"
                                           : (fs::current_path() / options.out).lexically_normal();
  std::error_code error;
  if (!options.force && fs::is_regular_file(out, error)) {
    return fail(out.string() +
                " exists. Write elsewhere with --out FILE, or over it with --force.");
  }
  Notes notes;
  std::optional<Project> project = import_project(file, fixed, notes);
  if (!project) {
    for (const std::string& text : notes.errors()) fail(text);
    return 1;
  }
  for (const std::string& include : options.includes) {
    project->includes.push_back(absolute_path(fs::current_path(), include));
  }
  std::cerr << notes.text();
  if (!same(project->type, "Application")) {
    return fail(file.string() + ": ConfigurationType is " + project->type +
                ", and programs are imported (Application). Import the program that refers to it: "
                "sources of the static libraries among its references become the program's.");
  }
  if (project->sources.empty()) {
    return fail(file.string() + ": no source that exists for " + options.configuration + "|" +
                options.platform + ". Name another with --configuration and --platform.");
  }
  const std::string text = cmake_lists(*project, out.parent_path(), version());
  if (const int status = kaamos::files::write_file(out.string(), text); status != 0) {
    return fail("cannot write " + out.string() + ": " + std::strerror(status));
  }
  std::cout << out.string() << ": " << project->sources.size() << " sources, "
            << project->shaders.size() << " shaders, " << project->contents.size()
            << " files beside the program\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Writes a CMakeLists.txt that builds a D3D12 program of Visual Studio with Kaamos.");
  app.set_version_flag("--version", "kaamos-import-vcxproj " + version());
  app.add_option("PROJECT", options.project, "the .vcxproj file")->required();
  app.add_option("--configuration", options.configuration, "configuration of the project")
      ->capture_default_str();
  app.add_option("--platform", options.platform, "platform of the project")->capture_default_str();
  app.add_option("--property", options.properties,
                 "NAME=VALUE: a macro that the project cannot change, such as SolutionDir=../")
      ->allow_extra_args(false);
  app.add_option("--include", options.includes,
                 "one more include folder, such as that of DirectXMath.h")
      ->allow_extra_args(false)
      ->check(CLI::ExistingDirectory);
  app.add_option("--out", options.out, "file to write; default: CMakeLists.txt beside the project");
  app.add_flag("--force", options.force, "write over a file that exists");
  CLI11_PARSE(app, argc, argv);
  return import(options);
}

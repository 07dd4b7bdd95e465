// SPDX-License-Identifier: MIT
//
// For tests: projects written into a folder that goes with the test.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "d3d12/vcxproj/cmake_lists.h"
#include "d3d12/vcxproj/evaluation.h"
#include "d3d12/vcxproj/project.h"

namespace kaamos::vcxproj {

class ProjectFiles : public testing::Test {
 protected:
  ProjectFiles() {
    std::string pattern = (std::filesystem::temp_directory_path() / "vcxproj_XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }
  ~ProjectFiles() override {
    std::error_code error;
    std::filesystem::remove_all(folder, error);
  }

  void write(const std::string& name, const std::string& text = "\n") const {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  }

  // A project with these elements.
  void write_project(const std::string& elements, const std::string& name = "app.vcxproj") const {
    write(name,
          "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Project>" + elements + "</Project>\n");
  }

  std::optional<Evaluation> evaluated(const std::string& name = "app.vcxproj") {
    return evaluate(folder / name, fixed, notes);
  }
  std::optional<Project> imported(const std::string& name = "app.vcxproj") {
    return import_project(folder / name, fixed, notes);
  }
  std::string written(const std::string& name = "app.vcxproj") {
    const std::optional<Project> project = imported(name);
    return project ? cmake_lists(*project, folder, "0.0.0") : "";
  }

  std::filesystem::path folder;
  NameMap fixed = {{"Configuration", "Release"}, {"Platform", "x64"}};
  Notes notes;
};

}  // namespace kaamos::vcxproj

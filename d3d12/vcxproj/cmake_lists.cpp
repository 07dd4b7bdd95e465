// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/cmake_lists.h"

#include <cctype>
#include <string_view>

namespace kaamos::vcxproj {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPlain = "_./+=:,@%~-";

bool is_plain(const std::string& text) {
  for (const char c : text) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && kPlain.find(c) == std::string_view::npos) {
      return false;
    }
  }
  return !text.empty();
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\' || c == '"' || c == '$') out += '\\';
    out += c;
  }
  return out;
}

// Names of targets: what every generator takes.
std::string target_name(const std::string& name) {
  std::string out;
  for (const char c : name) {
    out +=
        std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.' ? c : '_';
  }
  return out.empty() ? "program" : out;
}

class Writer {
 public:
  Writer(const Project& project, const fs::path& folder)
      : project_(project), folder_(folder), target_(target_name(project.name)) {}

  std::string text(const std::string& version) {
    const bool debug = lower(project_.configuration).find("debug") != std::string::npos;
    out_ = "# Made by kaamos-import-vcxproj " + version + " from " +
           project_.file.filename().string() + ", configuration " + project_.configuration +
           ".\n"
           "cmake_minimum_required(VERSION 3.25)\n"
           "project(" +
           target_ +
           " LANGUAGES CXX)\n"
           "find_package(kaamos REQUIRED)\n"
           "if(NOT CMAKE_BUILD_TYPE)\n"
           "  set(CMAKE_BUILD_TYPE " +
           (debug ? "Debug" : "Release") +
           ")\n"
           "endif()\n"
           "# The program, with its shaders and files beside it.\n"
           "set(CMAKE_RUNTIME_OUTPUT_DIRECTORY \"${CMAKE_CURRENT_BINARY_DIR}/bin\")\n";
    if (!project_.shaders.empty()) out_ += "\nset(shaders)\n";
    for (const Shader& shader : project_.shaders) add_shader(shader);
    add_program();
    add_contents();
    return out_;
  }

 private:
  // Relative where there is more in common than the root.
  std::string path(const fs::path& file) const {
    const fs::path relative = file.lexically_relative(folder_);
    size_t up = 0;
    for (const fs::path& part : relative) up += part == ".." ? 1 : 0;
    const auto depth = static_cast<size_t>(
        std::distance(folder_.relative_path().begin(), folder_.relative_path().end()));
    return relative.empty() || (up >= depth && up > 0) ? file.generic_string()
                                                       : relative.generic_string();
  }

  std::string absolute(const fs::path& folder) const {
    const std::string relative = path(folder);
    if (relative.starts_with('/')) return cmake_argument(relative);
    if (relative == ".") return "\"${CMAKE_CURRENT_SOURCE_DIR}\"";
    return "\"${CMAKE_CURRENT_SOURCE_DIR}/" + escaped(relative) + "\"";
  }

  void add_shader(const Shader& shader) {
    out_ += "kaamos_add_d3d12_shader(" + cmake_argument(path(shader.source)) + " shaders PROFILE " +
            shader.profile;
    if (!shader.entry.empty()) out_ += " ENTRY " + cmake_argument(shader.entry);
    out_ += "\n  OBJECT " + cmake_argument(shader.object);
    if (!shader.header.empty()) {
      out_ += "\n  HEADER " + cmake_argument(shader.header);
      if (!shader.variable.empty()) out_ += " VARIABLE " + cmake_argument(shader.variable);
    }
    if (!shader.options.empty() || !shader.includes.empty()) {
      out_ += "\n  OPTIONS";
      for (const std::string& option : shader.options) out_ += " " + cmake_argument(option);
      for (const fs::path& include : shader.includes) out_ += " -I " + absolute(include);
    }
    out_ += ")\n";
  }

  void add_list(const char* keyword, const std::vector<std::string>& arguments) {
    if (arguments.empty()) return;
    out_ += std::string("\n  ") + keyword;
    for (const std::string& argument : arguments) out_ += "\n    " + argument;
  }

  void add_program() {
    std::vector<std::string> sources, includes, defines, options;
    for (const fs::path& source : project_.sources) sources.push_back(cmake_argument(path(source)));
    for (const fs::path& include : project_.includes) {
      includes.push_back(cmake_argument(path(include)));
    }
    for (const std::string& define : project_.defines) defines.push_back(cmake_argument(define));
    for (const std::string& file : project_.forced_includes) {
      options.push_back("-include " + cmake_argument(file));
    }
    for (const std::string& option : project_.options) options.push_back(cmake_argument(option));
    out_ += "\nkaamos_add_d3d12_program(" + target_;
    add_list("SOURCES", sources);
    if (!project_.shaders.empty()) out_ += "\n  SHADERS ${shaders}";
    add_list("INCLUDES", includes);
    add_list("DEFINES", defines);
    add_list("OPTIONS", options);
    out_ += ")\n";
  }

  void add_contents() {
    if (project_.contents.empty()) return;
    out_ +=
        "\n# Files that the program reads.\n"
        "set(content)\n"
        "function(add_content source destination)\n"
        "  set(copy \"${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/${destination}\")\n"
        "  get_filename_component(source \"${source}\" ABSOLUTE)\n"
        "  add_custom_command(OUTPUT \"${copy}\" DEPENDS \"${source}\"\n"
        "    COMMAND ${CMAKE_COMMAND} -E copy \"${source}\" \"${copy}\" VERBATIM)\n"
        "  set(content ${content} \"${copy}\" PARENT_SCOPE)\n"
        "endfunction()\n";
    for (const Content& content : project_.contents) {
      out_ += "add_content(" + cmake_argument(path(content.source)) + " " +
              cmake_argument(content.destination) + ")\n";
    }
    out_ += "add_custom_target(" + target_ +
            "-content ALL DEPENDS ${content})\n"
            "if(TARGET " +
            target_ +
            ")\n"
            "  add_dependencies(" +
            target_ + " " + target_ +
            "-content)\n"
            "endif()\n";
  }

  const Project& project_;
  fs::path folder_;
  std::string target_;
  std::string out_;
};

}  // namespace

std::string cmake_argument(const std::string& text) {
  return is_plain(text) ? text : "\"" + escaped(text) + "\"";
}

std::string cmake_lists(const Project& project, const fs::path& folder,
                        const std::string& version) {
  return Writer(project, folder).text(version);
}

}  // namespace kaamos::vcxproj

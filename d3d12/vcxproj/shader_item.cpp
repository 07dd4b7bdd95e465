// SPDX-License-Identifier: MIT
#include "d3d12/vcxproj/shader_item.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "d3d12/vcxproj/content.h"
#include "d3d12/vcxproj/host_options.h"
#include "d3d12/vcxproj/paths.h"

namespace kaamos::vcxproj {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kStages = {{
    {"Vertex", "vs"},
    {"Pixel", "ps"},
    {"Compute", "cs"},
    {"Library", "lib"},
    {"Geometry", "gs"},
    {"Hull", "hs"},
    {"Domain", "ds"},
    {"Mesh", "ms"},
    {"Amplification", "as"},
    {"RootSignature", "rootsig"},
}};

constexpr std::array<std::string_view, 5> kCompiled = {"vs", "gs", "ps", "cs", "lib"};

// The profile of a stage and a shader model such as 5.0, 6_3 or 4.0_level_9_3. Nothing, with a
// note, where kaamos-dxc has no such profile.
std::optional<std::string> profile_of(const std::string& file, const std::string& stage,
                                      const std::string& model, Notes& notes) {
  if (std::find(kCompiled.begin(), kCompiled.end(), stage) == kCompiled.end()) {
    notes.add(Topic::kShaders, file + ": Kaamos compiles no shaders of " +
                                   (stage.empty() ? "unknown type" : "profile " + stage) +
                                   ", left out");
    return std::nullopt;
  }
  const size_t separator = model.find_first_of("._");
  const int major = std::atoi(model.c_str());
  const int minor = separator == std::string::npos ? 0 : std::atoi(model.c_str() + separator + 1);
  const int lowest = stage == "lib" ? 3 : 0;
  if (major > 6 || (major == 6 && minor >= lowest)) {
    return stage + "_" + std::to_string(major) + "_" + std::to_string(minor);
  }
  const std::string profile = stage + "_6_" + std::to_string(lowest);
  if (!model.empty()) {
    notes.add(Topic::kShaders, file + ": shader model " + model + " becomes " + profile);
  }
  return profile;
}

// Of "-Txx", "/Txx" and the like: "Txx"; "" for what is no option. A path of this machine begins as
// an option of fxc does: it has a second slash, unless the option's value has it.
std::string option_of(const std::string& word) {
  if (word.size() < 2) return {};
  const std::string option = word.substr(1);
  if (word[0] == '-') return option;
  std::error_code error;
  if (word[0] != '/' || fs::exists(word, error)) return {};
  const bool with_path = option.starts_with("F") || option.starts_with("I");
  return with_path || option.find('/') == std::string::npos ? option : std::string();
}

// Reads options of dxc and fxc into a shader.
class ShaderOptions {
 public:
  ShaderOptions(const Evaluation& evaluation, const Item& item, Shader& shader, Notes& notes)
      : evaluation_(evaluation), item_(item), shader_(shader), notes_(notes) {}

  void read(const std::vector<std::string>& words) {
    for (size_t i = 0; i < words.size(); ++i) {
      const std::string option = option_of(words[i]);
      if (option.empty()) {
        add_operand(words[i]);
        continue;
      }
      const std::string_view name = joined_name(option);
      if (name.empty()) {
        if (!is_of_debuggers(option)) shader_.options.push_back("-" + option);
        continue;
      }
      std::string value = option.substr(name.size());
      if (value.empty() && i + 1 < words.size()) value = words[++i];
      set(name, value);
    }
  }

  std::string target;  // of -T

 private:
  // The option's name where it has a value, joined to it or in the next word.
  static std::string_view joined_name(const std::string& option) {
    for (const std::string_view name :
         {"Fo", "Fh", "Vn", "Fd", "Fc", "Fe", "Fre", "Frs", "Fsh", "Fx", "HV", "T", "D", "I"}) {
      if (option.starts_with(name)) return name;
    }
    return option == "E" || (option.starts_with("E") && !option.starts_with("Ex"))
               ? std::string_view("E")
               : std::string_view();
  }

  static bool is_of_debuggers(const std::string& option) {
    return option == "Zi" || option == "Zs" || option == "Zss" || option == "Zsb" ||
           option == "nologo" || option.starts_with("Qembed") || option.starts_with("Qstrip");
  }

  void set(std::string_view name, const std::string& value) {
    if (name == "T") {
      target = value;
    } else if (name == "E") {
      shader_.entry = value;
    } else if (name == "Fo") {
      shader_.object = below_output(evaluation_, value);
    } else if (name == "Fh") {
      shader_.header_path = absolute_path(item_.folder, value);
    } else if (name == "Vn") {
      shader_.variable = value;
    } else if (name == "I") {
      for (const fs::path& folder : include_folders(evaluation_, value, notes_)) {
        shader_.includes.push_back(folder);
      }
    } else if (name == "D") {
      shader_.options.push_back("-D" + value);
    } else if (name == "HV") {
      shader_.options.push_back("-HV");
      shader_.options.push_back(value);
    }
    // What else is written serves debuggers.
  }

  void add_operand(const std::string& word) {
    const std::optional<fs::path> file = find_path(item_.folder, word);
    std::error_code error;
    if (file && fs::is_regular_file(*file, error) && shader_.source.empty()) {
      shader_.source = *file;
    } else {
      shader_.options.push_back(word);  // an option's value
    }
  }

  const Evaluation& evaluation_;
  const Item& item_;
  Shader& shader_;
  Notes& notes_;
};

// What both ways of compiling leave open.
void complete(Shader& shader) {
  if (shader.profile.starts_with("lib")) shader.entry.clear();
  if (shader.object.empty()) shader.object = shader.source.stem().string() + ".cso";
}

}  // namespace

std::optional<Shader> shader_of_item(const Evaluation& evaluation, const Item& item,
                                     const fs::path& file, Notes& notes) {
  Shader shader;
  shader.source = file;
  std::string stage;
  for (const auto& [type, prefix] : kStages) {
    if (same(trim(item.value("ShaderType")), type)) stage = prefix;
  }
  const auto profile = profile_of(item.include, stage, trim(item.value("ShaderModel")), notes);
  if (!profile) return std::nullopt;
  shader.profile = *profile;
  shader.entry = trim(item.value("EntryPointName"));
  shader.variable = trim(item.value("VariableName"));
  const std::string header = trim(item.value("HeaderFileOutput"));
  if (!header.empty()) shader.header_path = absolute_path(item.folder, header);
  const std::string object = trim(item.value("ObjectFileOutput"));
  if (!object.empty()) shader.object = below_output(evaluation, object);
  for (const std::string& define : split_list(item.value("PreprocessorDefinitions"))) {
    shader.options.push_back("-D" + define);
  }
  shader.includes = include_folders(evaluation, item.value("AdditionalIncludeDirectories"), notes);
  if (item.is("DisableOptimizations")) shader.options.push_back("-Od");
  if (item.is("AllResourcesBound")) shader.options.push_back("-all_resources_bound");
  if (item.is("TreatWarningAsError")) shader.options.push_back("-WX");
  ShaderOptions(evaluation, item, shader, notes).read(split_words(item.value("AdditionalOptions")));
  complete(shader);
  return shader;
}

std::optional<Shader> shader_of_command(const Evaluation& evaluation, const Item& item,
                                        const Command& command, Notes& notes) {
  Shader shader;
  ShaderOptions options(evaluation, item, shader, notes);
  options.read(command.arguments);
  if (shader.source.empty()) {
    notes.add(Topic::kCommands, command.text + ": names no file that exists");
    return std::nullopt;
  }
  const size_t separator = options.target.find('_');
  const auto profile =
      profile_of(shader.source.filename().string(), options.target.substr(0, separator),
                 separator == std::string::npos ? "" : options.target.substr(separator + 1), notes);
  if (!profile) return std::nullopt;
  shader.profile = *profile;
  complete(shader);
  return shader;
}

}  // namespace kaamos::vcxproj

// SPDX-License-Identifier: MIT
#include "d3d12/compiler/arguments.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "d3d12/com/errors.h"
#include "d3d12/com/text.h"

namespace kaamos::d3d12 {

namespace {

enum class Form : uint8_t { kFlag, kValue, kJoined, kPrefix };
enum class Use : uint8_t { kTaken, kIgnored, kRefused };

struct DxcOption {
  std::string_view name;
  Form form;
  Use use;
  const char* text;
};

constexpr DxcOption kOptions[] = {
#define KAAMOS_DXC_OPTION(name, form, use, text) {name, Form::form, Use::use, text},
#include "d3d12/compiler/arguments.inc"
#undef KAAMOS_DXC_OPTION
};

// The whole word's option, else the one with the longest name that the word begins with.
const DxcOption* find_option(std::string_view word) {
  for (const DxcOption& option : kOptions) {
    if (word == option.name) return &option;
  }
  const DxcOption* best = nullptr;
  for (const DxcOption& option : kOptions) {
    if (option.form != Form::kJoined && option.form != Form::kPrefix) continue;
    if (word.starts_with(option.name) &&
        (best == nullptr || option.name.size() > best->name.size())) {
      best = &option;
    }
  }
  return best;
}

// Returns whether a word with a slash in front is a path and no option: "/shaders/a.hlsl", not
// "/Fo/out/a.cso".
bool is_path(const std::string& word) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(word, ignored)) return true;
  if (word.find('/', 1) == std::string::npos) return false;
  const std::string name = "-" + word.substr(1);
  const DxcOption* option = find_option(name);
  const bool is_capital = std::isupper(static_cast<unsigned char>(name[1])) != 0;
  return option == nullptr || (name != option->name && !is_capital);
}

rtapi::Error refuse(const std::string& word, const std::string& why) {
  return make_error(ErrorId::kCompiler,
                    "argument \"" + word + "\": " + why + ". -help lists the options.");
}

class ArgumentParser {
 public:
  rtapi::Result<DxcArguments> parse(const std::vector<std::string>& words);

 private:
  // Applies an option; returns an error text, or an empty one.
  std::string apply(std::string_view name, const std::string& value);
  std::string set_profile(const std::string& value);
  std::string set_version(const std::string& value);
  std::string add_exports(const std::string& value);
  std::string set_denormals(const std::string& value);
  void finish();

  DxcArguments out_;
  bool debug_info_ = false;
  bool optimises_ = false;
  bool writes_dependencies_ = false;
};

std::string ArgumentParser::set_profile(const std::string& value) {
  out_.options.Target = value;
  // As for devices: programs of others cannot ask for it. [objects/create_device.cpp]
  const char* model = std::getenv("KAAMOS_SHADER_MODEL");
  out_.options.Experimental = model != nullptr && std::string_view(model) == "6.10";
  const size_t major = value.find('_');
  if (major == std::string::npos) return {};  // the compiler refuses it
  if (value.find("_4_") == major || value.find("_5_") == major) {
    out_.options.Target = value.substr(0, major) + "_6_0";
    out_.notes.push_back("warning: promoting older shader model profile to " + out_.options.Target);
  }
  return {};
}

std::string ArgumentParser::set_version(const std::string& value) {
  const bool is_old = value == "2016" || value == "2017" || value == "2018";
  out_.options.HlslVersion = is_old ? "2018" : "2021";
  return is_old || value == "2021" || value == "202x" ? ""
                                                      : "it must be 2016 to 2018, 2021 or 202x";
}

std::string ArgumentParser::add_exports(const std::string& value) {
  for (size_t start = 0; start <= value.size();) {
    const size_t end = std::min(value.find(';', start), value.size());
    if (end > start) out_.options.Exports.push_back(value.substr(start, end - start));
    start = end + 1;
  }
  return {};
}

std::string ArgumentParser::set_denormals(const std::string& value) {
  if (value == "preserve") {
    out_.notes.push_back("warning: -denorm preserve has no effect: denormals are flushed to zero");
  }
  return value == "any" || value == "ftz" || value == "preserve"
             ? ""
             : "it must be any, ftz or preserve";
}

std::string ArgumentParser::apply(std::string_view name, const std::string& value) {
  rtapi::ShaderCompileOptions& options = out_.options;
  if (name == "-T") return set_profile(value);
  if (name == "-HV") return set_version(value);
  if (name == "-exports") return add_exports(value);
  if (name == "-denorm") return set_denormals(value);
  if (name == "-E") {
    options.EntryPoint = value;
  } else if (name == "-D") {
    const size_t equals = value.find('=');
    const bool has_value = equals != std::string::npos;
    options.Defines.push_back(
        {value.substr(0, equals), has_value ? value.substr(equals + 1) : "1"});
  } else if (name == "-I") {
    options.IncludeDirectories.push_back(to_path(value));
  } else if (name == "-auto-binding-space") {
    uint32_t space = 0;
    const char* last = value.data() + value.size();
    const auto [end, failed] = std::from_chars(value.data(), last, space);
    if (failed != std::errc() || end != last) return "it must be a whole number";
    options.AutoBindingSpace = space;
  } else if (name == "-default-linkage") {
    options.ExternalLinkage = value == "external";
    if (value != "external" && value != "internal") return "it must be external or internal";
  } else if (name == "-Zpr" || name == "-Zpc") {
    options.RowMajorMatrices = name == "-Zpr";
  } else if (name == "-flegacy-resource-reservation") {
    options.ReserveUnusedRegisters = true;
  } else if (name == "-enable-16bit-types") {
    options.Native16BitTypes = true;
  } else if (name == "-enable-payload-qualifiers") {
    options.PayloadQualifiers = options.PayloadQualifiers.value_or(true);
  } else if (name == "-disable-payload-qualifiers") {
    options.PayloadQualifiers = false;
  } else if (name == "--strict") {
    options.Strict = true;
  } else if (name == "-no-warnings") {
    options.NoWarnings = true;
  } else if (name == "-no-legacy-cbuf-layout" || name == "-not_use_legacy_cbuf_load") {
    out_.notes.push_back("warning: " + std::string(name) +
                         " has no effect: constant buffers have rows of 16 bytes, as in DXC");
  } else if (name == "-WX") {
    out_.warnings_as_errors = true;
  } else if (name == "-Zi" || name == "-Zs") {
    debug_info_ = true;
  } else if (name == "-Od" || name == "-O0") {
    options.Debug = true;
  } else if (name.starts_with("-O")) {
    optimises_ = true;
  } else if (name == "-Fo") {
    out_.object = value;
  } else if (name == "-Fh") {
    out_.header = value;
  } else if (name == "-Vn") {
    out_.variable = value;
  } else if (name == "-Fd") {
    out_.debug_file = value;
  } else if (name == "-Fe") {
    out_.errors = value;
  } else if (name == "-Fc") {
    out_.listing = value;
  } else if (name == "-Fsh") {
    out_.hash = value;
  } else if (name == "-Fi") {
    out_.preprocessed = value;
  } else if (name == "-P") {
    out_.preprocess = true;
  } else if (name == "-M") {
    out_.dependencies = true;
  } else if (name == "-MD") {
    writes_dependencies_ = true;
  } else if (name == "-MF") {
    out_.dependency_file = value;
  } else if (name == "--version") {
    out_.version = true;
  } else {  // -help, -h, --help, -?
    out_.help = true;
  }
  return {};
}

void ArgumentParser::finish() {
  rtapi::ShaderCompileOptions& options = out_.options;
  options.Debug = options.Debug || (debug_info_ && !optimises_);
  out_.debug_info = debug_info_;
  out_.absolute_paths = debug_info_ || options.Debug;
  if (writes_dependencies_ && out_.dependency_file.empty() && !options.File.empty()) {
    out_.dependency_file =
        std::filesystem::path(options.File).replace_extension(".d").generic_string();
  }
}

rtapi::Result<DxcArguments> ArgumentParser::parse(const std::vector<std::string>& words) {
  out_.options.Target.clear();
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    std::string name = word;
    const bool is_slash = word.starts_with('/');
    if (is_slash && !is_path(word)) name[0] = '-';
    const bool is_option = name.size() > 1 && name[0] == '-';
    const DxcOption* option = is_option ? find_option(name) : nullptr;
    if (option == nullptr) {
      // As in DXC, a word with / that is no option is a path.
      if (is_option && !is_slash) return refuse(word, "it is unknown");
      if (!out_.options.File.empty()) {
        return refuse(word,
                      "there is another source file, \"" + out_.options.File + "\"; give one");
      }
      out_.options.File = to_path(word);
      continue;
    }
    std::string value;
    if (option->form == Form::kPrefix || option->form == Form::kJoined) {
      value = name.substr(option->name.size());
    }
    if (option->use == Use::kRefused) return refuse(word, option->text);
    if (value.empty() && (option->form == Form::kValue || option->form == Form::kJoined)) {
      if (++i == words.size()) return refuse(word, "a value must follow");
      value = words[i];
    }
    if (option->use == Use::kIgnored) continue;
    const std::string problem = apply(option->name, value);
    if (!problem.empty()) return refuse(word + " " + value, problem);
  }
  finish();
  return std::move(out_);
}

}  // namespace

rtapi::Result<DxcArguments> parse_dxc_arguments(const std::vector<std::string>& words) {
  return ArgumentParser().parse(words);
}

std::string dxc_help() {
  std::string out =
      "kaamos-dxc [options] FILE.hlsl: compiles HLSL to containers for Kaamos' D3D12. It takes "
      "DXC's\n"
      "command line: -X value, -Xvalue and /X.\n\n";
  const auto add = [&out](Use use) {
    for (const DxcOption& option : kOptions) {
      if (option.use != use || *option.text == '\0') continue;
      std::string name = "  " + std::string(option.name);
      name.resize(std::max<size_t>(name.size() + 1, 30), ' ');
      out += name + option.text + "\n";
    }
  };
  add(Use::kTaken);
  out += "\nAccepted without an effect:\n";
  add(Use::kIgnored);
  out += "\nRefused:\n";
  add(Use::kRefused);
  return out;
}

}  // namespace kaamos::d3d12

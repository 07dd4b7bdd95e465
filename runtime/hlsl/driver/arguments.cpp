// SPDX-License-Identifier: MIT
#include "runtime/hlsl/driver/arguments.h"

#include <charconv>
#include <functional>

namespace kaamos::hlsl {
namespace {

struct Option {
  const char* name;  // as written, or as the start of "-Ifolder"
  bool takes_value;
  std::function<bool(Arguments&, const std::string&)> apply;  // false: the value is not allowed
  const char* allowed;                                        // values, for the error
};

bool parse_number(const std::string& text, uint32_t& out) {
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), out);
  return failed == std::errc() && end == text.data() + text.size();
}

bool parse_emit(Arguments& a, const std::string& value) {
  if (value == "cpp") {
    a.emit = Emit::kCpp;
    a.spirv = false;  // it takes many times longer than the C++
  } else if (value == "source") {
    a.emit = Emit::kSource;
  } else if (value == "ir") {
    a.emit = Emit::kIr;
  } else if (value == "reflection") {
    a.emit = Emit::kReflection;
  } else if (value == "object") {
    a.emit = Emit::kObject;
  } else if (value == "glsl") {
    a.emit = Emit::kGlsl;
  } else if (value == "spirv") {
    a.emit = Emit::kSpirv;
  } else {
    return false;
  }
  return true;
}

bool is_c_identifier(const std::string& text) {
  for (const char c : text) {
    if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_')) {
      return false;
    }
  }
  return !text.empty() && !(text[0] >= '0' && text[0] <= '9');
}

const std::vector<Option>& options() {
  const auto flag = [](bool Arguments::*member) {
    return [member](Arguments& a, const std::string&) { return a.*member = true; };
  };
  const auto text = [](std::string Arguments::*member) {
    return [member](Arguments& a, const std::string& value) {
      a.*member = value;
      return true;
    };
  };
  static const std::vector<Option> table = {
      {"-T", true, text(&Arguments::target), ""},
      {"-E", true, text(&Arguments::entry_point), ""},
      {"-D", true,
       [](Arguments& a, const std::string& v) {
         a.defines.push_back(v);
         return true;
       },
       ""},
      {"-I", true,
       [](Arguments& a, const std::string& v) {
         a.include_folders.push_back(v);
         return true;
       },
       ""},
      {"-HV", true,
       [](Arguments& a, const std::string& v) {
         return parse_number(v, a.hlsl_version) &&
                (a.hlsl_version == 2018 || a.hlsl_version == 2021);
       },
       "2018 or 2021"},
      {"-exports", true, text(&Arguments::exports), ""},
      {"-default-linkage", true,
       [](Arguments& a, const std::string& v) {
         a.external_linkage = v == "external";
         return v == "external" || v == "internal";
       },
       "external or internal"},
      {"-auto-binding-space", true,
       [](Arguments& a, const std::string& v) { return parse_number(v, a.automatic_space); },
       "a whole number"},
      {"-enable-16bit-types", false, flag(&Arguments::native_16bit), ""},
      {"-enable-experimental", false, flag(&Arguments::experimental), ""},
      {"-enable-payload-qualifiers", false,
       [](Arguments& a, const std::string&) {
         // -disable-payload-qualifiers wins, wherever it appears.
         a.payload_qualifiers = a.payload_qualifiers.value_or(true);
         return true;
       },
       ""},
      {"-disable-payload-qualifiers", false,
       [](Arguments& a, const std::string&) {
         a.payload_qualifiers = false;
         return true;
       },
       ""},
      {"-flegacy-resource-reservation", false, flag(&Arguments::reserve_unused), ""},
      {"-Zpr", false, flag(&Arguments::row_major), ""},
      {"-Zpc", false,
       [](Arguments& a, const std::string&) {
         a.row_major = false;
         return true;
       },
       ""},
      {"--strict", false, flag(&Arguments::strict), ""},
      {"-WX", false, flag(&Arguments::warnings_as_errors), ""},
      {"-no-warnings", false, flag(&Arguments::no_warnings), ""},
      {"-Zi", false, flag(&Arguments::debug), ""},
      {"-spirv", false,
       [](Arguments& a, const std::string&) {
         a.spirv_wanted = true;
         return true;
       },
       ""},
      {"-no-spirv", false,
       [](Arguments& a, const std::string&) {
         a.spirv_wanted = false;
         return true;
       },
       ""},
      {"-no-source", false, flag(&Arguments::no_source), ""},
      {"-no-wide", false, flag(&Arguments::no_wide), ""},
      {"-check-access", false, flag(&Arguments::check_access), ""},
      {"-check", false, flag(&Arguments::check_only), ""},
      {"-emit", true, parse_emit, "cpp, source, ir, reflection, object, glsl or spirv"},
      {"-Fo", true, text(&Arguments::output), ""},
      {"-o", true, text(&Arguments::output), ""},
      {"-MF", true, text(&Arguments::dependency_file), ""},
      {"--entry-function", true,
       [](Arguments& a, const std::string& v) {
         a.entry_function = v;
         return is_c_identifier(v);
       },
       "a C identifier"},
      {"-help", false, flag(&Arguments::help), ""},
      {"--help", false, flag(&Arguments::help), ""},
      {"-h", false, flag(&Arguments::help), ""},
      {"--version", false, flag(&Arguments::version), ""},
  };
  return table;
}

// The option for a word; "-Ifolder" and "-DNAME" have their value attached.
const Option* find_option(const std::string& word, std::string& attached) {
  for (const Option& option : options()) {
    if (word == option.name) return &option;
  }
  for (const Option& option : options()) {
    const std::string name = option.name;
    if ((name == "-I" || name == "-D" || name == "-T" || name == "-E") && word.starts_with(name)) {
      attached = word.substr(name.size());
      return &option;
    }
  }
  return nullptr;
}

}  // namespace

Result<Arguments> parse_arguments(const std::vector<std::string>& words) {
  Arguments out;
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word.empty() || word[0] != '-') {
      if (!out.source.empty()) {
        return Failure{"two source files, \"" + out.source + "\" and \"" + word + "\": give one"};
      }
      out.source = word;
      continue;
    }
    std::string value;
    const Option* option = find_option(word, value);
    if (option == nullptr) {
      return Failure{"unknown option \"" + word + "\"; -help lists the options"};
    }
    if (option->takes_value && value.empty()) {
      if (++i == words.size()) {
        return Failure{std::string(option->name) +
                       " needs a value after it; -help lists the options"};
      }
      value = words[i];
    }
    if (!option->apply(out, value)) {
      return Failure{std::string(option->name) + " " + value + ": the value must be " +
                     option->allowed};
    }
  }
  out.spirv = out.spirv_wanted.value_or(out.spirv);
  if (out.help || out.version) return out;
  if (out.source.empty()) {
    return Failure{"no source file given; -help lists the options"};
  }
  if (out.emit == Emit::kObject && out.output.empty() && !out.check_only) {
    return Failure{"-emit object needs a file name: give it with -Fo"};
  }
  if (out.emit == Emit::kSource) {
    const std::pair<bool, const char*> of_code[] = {{out.no_source, "-no-source"},
                                                    {out.check_access, "-check-access"},
                                                    {out.debug, "-Zi"},
                                                    {out.no_wide, "-no-wide"},
                                                    {out.spirv_wanted == true, "-spirv"},
                                                    {out.spirv_wanted == false, "-no-spirv"}};
    for (const auto& [given, name] : of_code) {
      if (!given) continue;
      return Failure{std::string("-emit source writes no code, and does not go with ") + name +
                     ": leave one of them out"};
    }
  }
  if (!out.dependency_file.empty() && out.output.empty()) {
    return Failure{"-MF needs the name of the output: give it with -Fo"};
  }
  return out;
}

const char* help_text() {
  return R"(kaamos-hlsl [options] FILE.hlsl: compiles HLSL shader libraries for Kaamos

As in DXC:
  -T PROFILE                lib_6_3 to lib_6_9 (default lib_6_6), or cs_6_0 to cs_6_9, vs, gs, ps
  -E NAME                   entry point of a cs, vs, gs or ps profile
  -D NAME[=VALUE]           defines a macro
  -I FOLDER                 where to look for #include files
  -HV 2018|2021             version of the language (default 2021)
  -exports A;B=C            what the library exports, and under which name
  -default-linkage external every non-static function is an export
  -auto-binding-space N     space of resources without a register
  -flegacy-resource-reservation
                            resources that nothing reads keep their registers, as before 5.1
  -enable-payload-qualifiers, -disable-payload-qualifiers
                            payload access qualifiers take effect (default from lib_6_7 on)
  -enable-16bit-types       half, int16_t and uint16_t are 16 bits wide
  -Zpr, -Zpc                matrices are row- or column-major (default) in memory
  -WX, -no-warnings         warnings are errors, or are not shown
  -Zi                       with -emit object: for a debugger
  -Fo FILE, -o FILE         where to write (default: standard output)
  -help, --version          prints this text, or which Kaamos this is
Of its own:
  -check                    only checks the source, writes nothing
  -emit cpp|source|ir|reflection|object|glsl|spirv
                            what to write: the C++ alone, C++ that holds the HLSL for
                            LoadShaderLibrary to compile, the typed intermediate form, the exports
                            and bindings as JSON, a shared object for LoadShaderLibraryFromFile,
                            the GLSL of every export, or the SPIR-V of the only one; without
                            -emit: C++ that holds the SPIR-V too
  -spirv, -no-spirv         C++ and objects with SPIR-V (default, except with -emit cpp), or
                            without: they only run on the CPU
  -check-access             code that checks for what DXR leaves undefined and reports it to the
                            device: accesses outside root descriptors, wrong descriptors, NaN rays;
                            slower
  -no-source                leaves out the source, from which a checked device compiles that code
                            for a library that was compiled without -check-access, and a state
                            object links the library with others that it calls
  -enable-experimental      allows profiles of 6.10, whose specification still moves
  -no-wide                  compute, ray generation, vertex and pixel shaders run thread by
                            thread, never 8 threads at once
  --strict                  refuses what DXC refuses, even if Kaamos could accept it
  --entry-function NAME     name of the C function that returns the library's table
  -MF FILE                  writes a make rule with the files that were read
)";
}

}  // namespace kaamos::hlsl

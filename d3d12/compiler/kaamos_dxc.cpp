// SPDX-License-Identifier: MIT
//
// kaamos-dxc: the compiler as a program, with DXC's command line and exit codes.
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include <rtapi/version.h>

#include "d3d12/compiler/arguments.h"
#include "d3d12/compiler/compile.h"
#include "runtime/files/write_file.h"

namespace {

using namespace kaamos::d3d12;

int fail(const std::string& text) {
  std::fprintf(stderr, "kaamos-dxc: %s\n", text.c_str());
  return 1;
}

// Returns the exit status.
int write_file(const std::string& path, std::string_view bytes) {
  if (path.empty()) return 0;
  const int error = kaamos::files::write_file(path, bytes);
  return error == 0 ? 0 : fail("cannot write " + path + ": " + std::strerror(error));
}

std::string_view text_of(const void* bytes, size_t size) {
  return {static_cast<const char*>(bytes), size};
}

// A header of C and C++ as DXC writes it.
std::string header_text(const DxcArguments& arguments, const CompiledSource& compiled) {
  const std::string& entry = arguments.options.EntryPoint;
  const std::string name =
      arguments.variable.empty() ? "g_" + (entry.empty() ? "main" : entry) : arguments.variable;
  std::string out = "#if 0\n" + list_reflection(compiled.reflection, arguments.options.Target) +
                    "#endif\n\nconst unsigned char " + name + "[] = {";
  for (size_t i = 0; i < compiled.container.size(); ++i) {
    char byte[8];
    std::snprintf(byte, sizeof(byte), "0x%02x", static_cast<unsigned>(compiled.container[i]));
    out += i == 0 ? "\n  " : i % 12 == 0 ? ",\n  " : ", ";
    out += byte;
  }
  return out + "\n};\n";
}

// A file's name as make and ninja expect it in a rule.
std::string escape(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (c == ' ' || c == '#') out += '\\';
    if (c == '$') out += '$';
    out += c;
  }
  return out;
}

// "output: source header ..."
std::string make_rule(const std::string& output, const std::vector<std::string>& inputs) {
  std::string rule = escape(output) + ":";
  for (const std::string& input : inputs) rule += " \\\n  " + escape(input);
  return rule + "\n";
}

int write_outputs(const DxcArguments& arguments, const CompiledSource& compiled) {
  const std::string listing = list_reflection(compiled.reflection, arguments.options.Target);
  const std::string rule = make_rule(
      arguments.object.empty() ? arguments.options.File : arguments.object, compiled.dependencies);
  if (arguments.dependencies) {
    std::fputs(rule.c_str(), stdout);
    return 0;
  }
  int status = write_file(arguments.dependency_file, rule);
  if (status == 0) {
    status =
        write_file(arguments.object, text_of(compiled.container.data(), compiled.container.size()));
  }
  if (status == 0 && !arguments.header.empty()) {
    status = write_file(arguments.header, header_text(arguments, compiled));
  }
  if (status == 0) status = write_file(arguments.listing, listing);
  if (status == 0) {
    status = write_file(arguments.hash, text_of(&compiled.hash, sizeof(compiled.hash)));
  }
  // DXC prints its assembly where no file is asked for.
  if (arguments.object.empty() && arguments.header.empty() && arguments.listing.empty() &&
      arguments.hash.empty()) {
    std::fputs(listing.c_str(), stdout);
  }
  return status;
}

int preprocess(const DxcArguments& arguments) {
  const PreprocessedSource text = preprocess_source(arguments);
  std::fputs(text.messages.c_str(), stderr);
  if (!text.ok) return 1;
  if (!arguments.preprocessed.empty()) return write_file(arguments.preprocessed, text.text);
  std::fputs(text.text.c_str(), stdout);
  return 0;
}

int compile(const DxcArguments& arguments) {
  if (arguments.options.File.empty()) return fail("no source file given; -help lists the options");
  if (arguments.preprocess) return preprocess(arguments);
  if (arguments.options.Target.empty()) {
    return fail("no profile given: name one with -T, such as -T lib_6_3");
  }
  const CompiledSource compiled = compile_source(arguments);
  std::fputs(compiled.messages.c_str(), stderr);
  const int status = write_file(arguments.errors, compiled.messages);
  if (!compiled.ok) return 1;
  return status != 0 ? status : write_outputs(arguments, compiled);
}

}  // namespace

int main(int argc, char** argv) {
  const auto arguments = parse_dxc_arguments({argv + 1, argv + argc});
  if (!arguments) return fail(arguments.error().message);
  if (arguments->help || argc == 1) {
    std::fputs(dxc_help().c_str(), stdout);
    return argc == 1 ? 1 : 0;
  }
  if (arguments->version) {
    std::printf("kaamos-dxc %s\n", rtapi::GetVersion());
    return 0;
  }
  return compile(*arguments);
}

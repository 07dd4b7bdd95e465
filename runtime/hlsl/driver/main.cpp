// SPDX-License-Identifier: MIT
//
// kaamos-hlsl: the compiler as a program.
#include <cstdio>
#include <cstring>
#include <iostream>
#include <memory>

#include "kaamos/shader/spirv_interface.h"
#include "runtime/files/write_file.h"
#include "runtime/hlsl/cpp/emit_cpp.h"
#include "runtime/hlsl/driver/arguments.h"
#include "runtime/hlsl/driver/build_library.h"
#include "runtime/hlsl/driver/files.h"
#include "runtime/hlsl/driver/frontend.h"
#include "runtime/hlsl/driver/host_compiler.h"
#include "runtime/hlsl/driver/reflect.h"
#include "runtime/hlsl/front/file_loader.h"
#include "runtime/hlsl/glsl/emit_glsl.h"
#include "runtime/hlsl/glsl/spirv.h"
#include "runtime/hlsl/ir/dump.h"

namespace {

using namespace kaamos::hlsl;
namespace files = kaamos::files;

constexpr int kBadUsage = 2;

int fail(const std::string& text, int code = 1) {
  std::fprintf(stderr, "kaamos-hlsl: %s\n", text.c_str());
  return code;
}

FrontendOptions frontend_options(const Arguments& arguments) {
  FrontendOptions options;
  options.path = arguments.source;
  options.include_folders = arguments.include_folders;
  options.defines = arguments.defines;
  options.target = arguments.target;
  if (!arguments.entry_point.empty()) options.entry_point = arguments.entry_point;
  options.exports = arguments.exports;
  options.external_linkage = arguments.external_linkage;
  options.automatic_space = arguments.automatic_space;
  options.hlsl_version = arguments.hlsl_version;
  options.native_16bit = arguments.native_16bit;
  options.experimental = arguments.experimental;
  options.row_major = arguments.row_major;
  options.reserve_unused = arguments.reserve_unused;
  options.payload_qualifiers = arguments.payload_qualifiers;
  options.strict = arguments.strict;
  options.check_access = arguments.check_access;
  options.embed_source = !arguments.no_source;
  return options;
}

// Returns the exit status.
int write_file(const std::string& path, std::string_view bytes) {
  const int error = files::write_file(path, bytes);
  return error == 0 ? 0 : fail("cannot write " + path + ": " + std::strerror(error));
}

// "output: source header ..." with spaces escaped the way make and ninja expect.
std::string make_rule(const std::string& output, const std::vector<std::string>& inputs) {
  std::string rule = output + ":";
  for (const std::string& input : inputs) {
    rule += " \\\n  ";
    for (const char c : input) {
      if (c == ' ' || c == '#') rule += '\\';
      if (c == '$') rule += '$';
      rule += c;
    }
  }
  return rule + "\n";
}

int write_object(const Arguments& arguments, const ir::Module& module) {
  const auto compiler = find_host_compiler();
  if (!compiler) return fail(compiler.error());
  const SharedObject object =
      build_library(*compiler, module,
                    {.optimisation = arguments.debug ? Optimisation::kDebug : Optimisation::kFull,
                     .spirv = arguments.spirv,
                     .wide = !arguments.no_wide});
  if (object.error) return fail(object.error.message());
  return write_file(arguments.output, read_file(object.path));
}

// Writes to the requested file, or to standard output.
int write_output(const Arguments& arguments, const std::string& text) {
  if (arguments.output.empty()) {
    std::cout << text << std::flush;
    return std::cout ? 0 : fail("cannot write to standard output");
  }
  return write_file(arguments.output, text);
}

int write_cpp(const Arguments& arguments, const ir::Module& module) {
  SpirvLibrary library;
  if (arguments.spirv) library = compile_spirv(module);
  if (library.error) return fail(library.error.message());
  return write_output(arguments,
                      emit_cpp(module, {.entry_point = arguments.entry_function,
                                        .spirv = library.modules,
                                        .wide = arguments.no_wide ? WideThreads::kNever
                                                                  : WideThreads::kWhereFaster}));
}

int write_text(const Arguments& arguments, const ir::Module& module) {
  std::string text;
  switch (arguments.emit) {
    case Emit::kCpp:
      return write_cpp(arguments, module);
    case Emit::kSource:
      text = emit_source(module, arguments.entry_function);
      break;
    case Emit::kIr:
      text = dump(module);
      break;
    case Emit::kGlsl:
      for (const ir::EntryPoint& entry : module.entry_points) {
        if (module.entry_points.size() > 1) text += "// ---- " + entry.name + "\n";
        text += emit_glsl(module, entry).text;
        if (!has_twin(module, entry)) continue;
        text += "// ---- " + entry.name + ", as a callable shader for dx::HitObject\n";
        text += emit_glsl_twin(module, entry).text;
      }
      break;
    case Emit::kSpirv: {
      if (module.entry_points.size() != 1) {
        return fail("-emit spirv writes one entry point, and " + arguments.source + " has " +
                    std::to_string(module.entry_points.size()) + ": name one with -exports");
      }
      const SpirvLibrary library = compile_spirv(module);
      if (library.error) return fail(library.error.message());
      const auto& all = library.modules[0];
      const auto words =
          kaamos::shader::spirv::spirv_pair(all.data(), static_cast<uint32_t>(all.size()));
      text.assign(reinterpret_cast<const char*>(words.words), words.count * sizeof(uint32_t));
      break;
    }
    default:
      text = reflect_json(module);
      break;
  }
  return write_output(arguments, text);
}

// DXC has no warning about unreached bodies and vk attributes, so what passes with its -WX must
// pass here too.
bool has_warning_for_wx(const DiagnosticEngine& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics.diagnostics()) {
    const bool is_own = diagnostic.id == DiagnosticId::kSkipped ||
                        diagnostic.id == DiagnosticId::kVkAttributeIgnored;
    if (diagnostic.severity == Severity::kWarning && !is_own) return true;
  }
  return false;
}

int compile(const Arguments& arguments) {
  DiskFileLoader loader;
  SourceManager sources(loader);
  DiagnosticEngine diagnostics({.strict = arguments.strict});
  const auto module = compile_to_ir(frontend_options(arguments), sources, diagnostics);
  if (diagnostics.has_errors() || !arguments.no_warnings) {
    std::fputs(render_all(diagnostics, sources).c_str(), stderr);
  }
  if (!module) return 1;
  if (arguments.warnings_as_errors && has_warning_for_wx(diagnostics)) {
    return fail("warnings are errors [-WX]");
  }
  if (arguments.check_only) return 0;
  if (!arguments.dependency_file.empty()) {
    const std::string rule = make_rule(arguments.output, sources.loaded_paths());
    if (const int status = write_file(arguments.dependency_file, rule)) return status;
  }
  return arguments.emit == Emit::kObject ? write_object(arguments, *module)
                                         : write_text(arguments, *module);
}

}  // namespace

int main(int argc, char** argv) {
  const auto arguments = parse_arguments({argv + 1, argv + argc});
  if (!arguments) return fail(arguments.error(), kBadUsage);
  if (arguments->help) {
    std::fputs(help_text(), stdout);
    return 0;
  }
  if (arguments->version) {
    std::puts("kaamos-hlsl " KAAMOS_VERSION);
    return 0;
  }
  return compile(*arguments);
}

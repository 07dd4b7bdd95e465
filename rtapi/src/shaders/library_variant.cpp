// SPDX-License-Identifier: MIT
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <tuple>
#include <utility>

#include "rtapi/src/errors/error_table.h"
#include "rtapi/src/shaders/library_variant.h"
#include "rtapi/src/shaders/module_library.h"
#include "rtapi/src/shaders/native_library.h"
#include "rtapi/src/shaders/shader_library_impl.h"
#include "runtime/coverage/collector.h"
#include "runtime/hlsl/driver/embedded_source.h"
#include "runtime/hlsl/ir/result.h"

namespace rtapi::detail {
namespace {

namespace hlsl = kaamos::hlsl;
namespace shader = kaamos::shader;

using VariantModule = hlsl::Result<std::shared_ptr<const hlsl::ir::Module>>;

// The IR of the library's source.
VariantModule module_of(const shader::LibraryDesc& library, VariantParts parts) {
  if (library.source == nullptr) return hlsl::Failure{"it carries no source (-no-source)"};
  auto source = hlsl::read_embedded_source({library.source, library.source_bytes});
  if (!source) {
    return hlsl::Failure{
        "its source cannot be read; was it made by another version of kaamos-hlsl?"};
  }
  source->options.check_access = parts.checks;
  source->options.coverage = parts.coverage;
  hlsl::SourceManager sources(source->files);
  hlsl::DiagnosticEngine diagnostics({.strict = source->options.strict});
  std::shared_ptr<const hlsl::ir::Module> module =
      hlsl::compile_to_ir(source->options, sources, diagnostics);
  if (module) return module;
  return hlsl::Failure{"its source does not compile:\n" + render_all(diagnostics, sources)};
}

LibraryVariant make(const ShaderLibrary& library, VariantParts parts, bool spirv) {
  const shader::LibraryDesc& desc = *library.impl()->desc;
  const VariantModule module = module_of(desc, parts);
  if (!module) return {library, module.error(), {}};
  ModuleLibrary built = library_of(*module, desc.flags, spirv);
  if (!built.library) return {library, std::move(built.error), {}};
  return {std::move(built.library), {}, std::move(built.slow)};
}

// Programs load the same library again and again, and each time it would have to be compiled up to
// the point where the disk cache's key is known. That many variants are kept even when unused.
constexpr size_t kMostKept = 32;

struct Known {
  std::weak_ptr<const ShaderLibraryImpl> variant;
  std::string slow;
};
struct KnownVariants {
  std::mutex mutex;
  std::map<std::tuple<size_t, size_t, uint32_t, VariantParts, bool>, Known> by_source;
  std::deque<ShaderLibrary> kept;
};

// Libraries that were compiled for tables with kLibrarySource. Each is compiled by the first thread
// that wants it; threads that want others do not wait.
struct SourceLibrary {
  std::mutex mutex;
  ShaderLibrary library;
};
struct SourceLibraries {
  std::mutex mutex;
  std::map<std::pair<size_t, uint64_t>, SourceLibrary> by_source;
};

#ifdef KAAMOS_HAVE_VULKAN
constexpr bool kWithSpirv = true;
#else
constexpr bool kWithSpirv = false;
#endif

}  // namespace

Result<ShaderLibrary> load_source_library(const shader::LibraryDesc& desc) {
  const std::string file = desc.name == nullptr ? "built-in library" : desc.name;
  // Never destroyed: at exit, other threads may still be running what it holds.
  static SourceLibraries& all = *new SourceLibraries;
  if (desc.source == nullptr) {
    return make_error(Id::kShaderLibrary, in_quotes(file), ": its source is missing");
  }
  std::unique_lock lock(all.mutex);
  const std::string_view source(desc.source, desc.source_bytes);
  SourceLibrary& entry = all.by_source[{std::hash<std::string_view>()(source), source.size()}];
  lock.unlock();
  const std::lock_guard compiling(entry.mutex);
  if (entry.library) return entry.library;
  const VariantModule module = module_of(desc, {.coverage = kaamos::coverage::is_asked()});
  if (!module) return make_error(Id::kShaderLibrary, in_quotes(file), ": ", module.error());
  const auto built = build_native(file, {}, **module, {.spirv = kWithSpirv});
  if (!built) return built.error();
  return entry.library = built->library;
}

LibraryVariant variant_of(const ShaderLibrary& library, VariantParts parts, bool spirv) {
  const shader::LibraryDesc& desc = *library.impl()->desc;
  const bool has_checks = (desc.flags & shader::kLibraryChecked) != 0;
  const bool has_coverage = kaamos::coverage::table_of(desc) != nullptr;
  if (has_checks >= parts.checks && has_coverage >= parts.coverage) return {library, {}, {}};
  parts.checks = parts.checks || has_checks;
  parts.coverage = parts.coverage || has_coverage;
  static KnownVariants& known = *new KnownVariants;  // never destroyed, as above
  const std::lock_guard lock(known.mutex);
  const std::string_view source(reinterpret_cast<const char*>(desc.source),
                                desc.source == nullptr ? 0 : desc.source_bytes);
  Known& entry = known.by_source[{std::hash<std::string_view>()(source), source.size(), desc.flags,
                                  parts, spirv}];
  if (auto variant = entry.variant.lock()) {
    return {ShaderLibrary(std::move(variant)), {}, entry.slow};
  }
  LibraryVariant out = make(library, parts, spirv);
  if (!out.missing.empty()) return out;
  entry = {out.library.impl(), out.slow};
  known.kept.push_back(out.library);
  if (known.kept.size() > kMostKept) known.kept.pop_front();
  return out;
}

}  // namespace rtapi::detail

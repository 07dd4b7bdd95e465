// SPDX-License-Identifier: MIT
#include <rtapi/shader_library.h>

#include <dlfcn.h>

#include "rtapi/src/errors/error_table.h"
#include "rtapi/src/shaders/file_kind.h"
#include "rtapi/src/shaders/library_variant.h"
#include "rtapi/src/shaders/shader_library_impl.h"
#include "runtime/coverage/collector.h"

namespace rtapi {

using namespace detail;
namespace shader = kaamos::shader;

namespace {

const std::string kEmptyString;
const std::vector<ShaderExportInfo> kNoExports;

bool is_stage(shader::Stage stage) {
  const auto s = static_cast<uint32_t>(stage);
  return s <= 2 || (s >= 5 && s <= 12);
}

// A foreign library's tables are trusted no further than their version. Every index is checked
// here, once, so that linking need not.
Status check_table(const shader::LibraryDesc& desc, const std::string& name) {
  auto broken = [&name](const auto&... parts) {
    return make_error(Id::kShaderLibrary, in_quotes(name), ": ", parts...);
  };
  if (desc.export_count && !desc.exports) return broken("its table of exports is missing");
  if (desc.binding_count && !desc.bindings) return broken("its table of bindings is missing");
  if (desc.subobject_count && !desc.subobjects) {
    return broken("its table of subobjects is missing");
  }
  if (desc.import_count && !desc.imports) return broken("its table of imports is missing");
  for (uint32_t i = 0; i < desc.import_count; ++i) {
    const auto& import = desc.imports[i];
    if (!import.name || !import.mangled_name || !import.signature) {
      return broken("import ", i, " has no name or signature");
    }
  }
  for (uint32_t i = 0; i < desc.binding_count; ++i) {
    const auto& binding = desc.bindings[i];
    if (!binding.name || binding.count == 0 || static_cast<uint32_t>(binding.register_class) > 3 ||
        binding.type > shader::BindingType::kAccelerationStructure) {
      return broken("binding ", i, " has no name or count, or an invalid register class or type");
    }
  }
  for (uint32_t i = 0; i < desc.export_count; ++i) {
    const auto& e = desc.exports[i];
    if (!e.name || !*e.name || !is_stage(e.stage)) {
      return broken("export ", i, " has no name or an invalid stage");
    }
    const bool draws = e.stage == shader::Stage::kVertex || e.stage == shader::Stage::kGeometry ||
                       e.stage == shader::Stage::kPixel;
    // Linking gives code to an export that calls other libraries.
    const bool needs_entry = e.import_count == 0 && e.stage != shader::Stage::kLibrary &&
                             e.stage != shader::Stage::kCompute && !draws;
    if (needs_entry && !e.entry) return broken("export ", in_quotes(e.name), " has no code");
    if (e.stage == shader::Stage::kCompute && e.import_count == 0 &&
        (!e.compute || (!e.compute->group && !e.compute->thread && !e.compute->lanes))) {
      return broken("compute export ", in_quotes(e.name), " has no code");
    }
    const shader::GraphicsDesc* graphics = draws ? e.graphics : nullptr;
    if (draws && (!graphics || (e.stage == shader::Stage::kVertex ? !graphics->vertex
                                : e.stage == shader::Stage::kGeometry
                                    ? !graphics->geometry
                                    : !graphics->pixel && !graphics->pixel_thread))) {
      return broken("export ", in_quotes(e.name), " has no code");
    }
    if (e.binding_count && !e.bindings) {
      return broken("export ", in_quotes(e.name), " has no list of its bindings");
    }
    if (e.import_count && !e.imports) {
      return broken("export ", in_quotes(e.name), " has no list of its imports");
    }
    for (uint32_t k = 0; k < e.import_count; ++k) {
      if (e.imports[k] >= desc.import_count) {
        return broken("export ", in_quotes(e.name), " uses import ", e.imports[k],
                      ", but the library has only ", desc.import_count);
      }
    }
    for (uint32_t b = 0; b < e.binding_count; ++b) {
      if (e.bindings[b] >= desc.binding_count) {
        return broken("export ", in_quotes(e.name), " uses binding ", e.bindings[b],
                      ", but the library has only ", desc.binding_count);
      }
    }
  }
  return {};
}

ShaderExportInfo make_info(const shader::LibraryDesc& desc, const shader::ExportDesc& e) {
  ShaderExportInfo info;
  info.Name = e.name;
  info.MangledName = e.mangled_name ? e.mangled_name : e.name;
  info.Stage = static_cast<ShaderStage>(e.stage);
  info.PayloadSizeInBytes =
      e.stage == shader::Stage::kCallable ? e.callable_data_bytes : e.payload_bytes;
  info.AttributeSizeInBytes = e.attribute_bytes;
  if (e.compute) {
    for (int i = 0; i < 3; ++i) info.ThreadGroup[i] = e.compute->thread_group[i];
  }
  for (uint32_t b = 0; b < e.binding_count; ++b) {
    info.Resources.emplace_back(desc.bindings[e.bindings[b]].name);
  }
  return info;
}

}  // namespace

const std::string& ShaderLibrary::name() const {
  return impl_ ? impl_->name : kEmptyString;
}
const std::string& ShaderLibrary::target() const {
  return impl_ ? impl_->target : kEmptyString;
}
const std::vector<ShaderExportInfo>& ShaderLibrary::GetExports() const {
  return impl_ ? impl_->exports : kNoExports;
}

const ShaderExportInfo* ShaderLibrary::FindExport(const std::string& name) const {
  const ShaderExportInfo* found = nullptr;
  for (const ShaderExportInfo& e : GetExports()) {
    if (e.MangledName == name) return &e;
    if (e.Name != name) continue;
    if (found) return nullptr;
    found = &e;
  }
  return found;
}

Result<ShaderLibrary> detail::load_library(const shader::LibraryDesc* desc,
                                           const shader::CoverageDesc* coverage,
                                           std::shared_ptr<const void> owner,
                                           const std::string& where) {
  if (!desc) return make_error(Id::kShaderLibrary, where, ": the library table is null");
  if (desc->abi_version != shader::kAbiVersion ||
      desc->struct_bytes != sizeof(shader::LibraryDesc)) {
    return make_error(Id::kShaderLibrary, where, " was compiled for ABI version ",
                      desc->abi_version, " (", desc->struct_bytes,
                      " bytes), but this program has version ", shader::kAbiVersion, " (",
                      sizeof(shader::LibraryDesc), " bytes); recompile the shaders");
  }
  if (desc->flags & shader::kLibrarySource) return load_source_library(*desc);
  auto impl = std::make_shared<ShaderLibraryImpl>();
  impl->name = desc->name ? desc->name : where;
  impl->target = desc->target ? desc->target : "";
  if (Status s = check_table(*desc, impl->name); !s.ok()) return s.error();
  impl->desc = desc;
  impl->owner = coverage == nullptr ? std::move(owner)
                                    : kaamos::coverage::collect(*desc, *coverage, std::move(owner));
  for (uint32_t i = 0; i < desc->export_count; ++i) {
    impl->exports.push_back(make_info(*desc, desc->exports[i]));
  }
  return ShaderLibrary(std::move(impl));
}

Result<ShaderLibrary> LoadShaderLibrary(const shader::LibraryDesc* desc,
                                        std::shared_ptr<const void> owner) {
  return load_library(desc, nullptr, std::move(owner), "built-in library");
}

Result<ShaderLibrary> LoadShaderLibraryFromFile(const std::string& path) {
  // dlopen would look for a name without a slash in the system's library folders.
  const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) {
    const char* reason = dlerror();
    return make_error(Id::kShaderLibrary, in_quotes(path), " is ", detail::describe_file(file),
                      " and cannot be loaded: ", reason ? reason : "unknown reason");
  }
  std::shared_ptr<void> owner(handle, [](void* h) { dlclose(h); });
  auto entry =
      reinterpret_cast<shader::LibraryEntryPointFn>(dlsym(handle, shader::kLibraryEntryPoint));
  if (!entry) {
    return make_error(Id::kShaderLibrary, in_quotes(path), " is ", detail::describe_file(file),
                      " without the symbol ", shader::kLibraryEntryPoint,
                      ", so it is not a shader library made by kaamos-hlsl");
  }
  const auto coverage =
      reinterpret_cast<shader::CoverageEntryPointFn>(dlsym(handle, shader::kCoverageEntryPoint));
  return load_library(entry(), coverage == nullptr ? nullptr : coverage(), std::move(owner), path);
}

}  // namespace rtapi

// SPDX-License-Identifier: MIT
//
// Takes from a shader library what a state object needs: exports, and subobjects declared in HLSL.
// [DXR: Subobjects in DXIL libraries]
#include <algorithm>
#include <cstdio>

#include "rtapi/src/device/device_level.h"
#include "rtapi/src/pipelines/root_signature_impl.h"
#include "rtapi/src/pipelines/state_object_gatherer.h"
#include "rtapi/src/shaders/shader_library_impl.h"

namespace rtapi::detail {

namespace {

std::vector<std::string> split_names(const char* list) {
  std::vector<std::string> names;
  std::string current;
  for (const char* c = list ? list : "";; ++c) {
    if (*c == ';' || *c == '\0') {
      if (!current.empty()) names.push_back(current);
      current.clear();
      if (*c == '\0') return names;
    } else if (*c != ' ') {
      current += *c;
    }
  }
}

}  // namespace

Status Gatherer::gather(const DxilLibraryDesc& sub, size_t i) {
  const std::string where = where_of(i);
  if (!sub.DXILLibrary) {
    return make_error(Id::kNullHandle, where, ": DXILLibrary is an empty handle");
  }
  const std::string& target = sub.DXILLibrary.target();
  unsigned major = 0, minor = 0;
  const bool lib = std::sscanf(target.c_str(), "lib_%u_%u", &major, &minor) == 2;
  if (!lib || major < 6 || (major == 6 && minor < 3)) {
    return make_error(Id::kLibraryTarget, where, ": ", in_quotes(sub.DXILLibrary.name()),
                      " was compiled for ", in_quotes(target), "; it must be lib_6_3 or later");
  }
  if (Status s = check_shader_model(*parts_.device, sub.DXILLibrary); !s.ok()) return s;
  const int scope = static_cast<int>(parts_.libraries.size());
  parts_.libraries.push_back(sub.DXILLibrary);
  parts_.library_scopes.emplace_back();
  library_definitions_.emplace_back();
  if (Status s = gather_exports(sub, scope, where); !s.ok()) return s;
  return gather_library_subobjects(sub, scope);
}

bool Gatherer::is_listed(const DxilLibraryDesc& sub, const char* name) {
  if (sub.Exports.empty()) return true;
  return name && std::any_of(sub.Exports.begin(), sub.Exports.end(), [&](const ExportDesc& e) {
           return e.Name == name || e.ExportToRename == name;
         });
}

void Gatherer::add_shader(const shader::ExportDesc& code, const ShaderLibrary& library, int scope,
                          const std::string& renamed) {
  // A state object has no use for these.
  if (code.stage == shader::Stage::kCompute || code.stage == shader::Stage::kVertex ||
      code.stage == shader::Stage::kGeometry || code.stage == shader::Stage::kPixel) {
    return;
  }
  auto subject = std::make_shared<Subject>();
  subject->name = renamed.empty() ? code.name : renamed;
  if (renamed.empty() && code.mangled_name) subject->mangled = code.mangled_name;
  subject->code = &code;
  subject->library = library;
  subject->library_scope = scope;
  parts_.subjects.push_back(std::move(subject));
}

Status Gatherer::gather_exports(const DxilLibraryDesc& sub, int scope, const std::string& where) {
  const auto& table = *sub.DXILLibrary.impl()->desc;
  if (sub.Exports.empty()) {
    for (uint32_t i = 0; i < table.export_count; ++i) {
      add_shader(table.exports[i], sub.DXILLibrary, scope, {});
    }
    return {};
  }
  for (const ExportDesc& wanted : sub.Exports) {
    if (wanted.Name.empty()) {
      return make_error(Id::kExportUnnamed, where, ": an ExportDesc has an empty Name");
    }
    const std::string& source = wanted.ExportToRename.empty() ? wanted.Name : wanted.ExportToRename;
    std::vector<const shader::ExportDesc*> found;
    for (uint32_t i = 0; i < table.export_count; ++i) {
      const auto& e = table.exports[i];
      if (e.mangled_name && source == e.mangled_name) {
        found = {&e};
        break;
      }
      if (source == e.name) found.push_back(&e);
    }
    const bool renames = !wanted.ExportToRename.empty() && wanted.ExportToRename != wanted.Name;
    if (found.size() > 1 && renames) {
      return make_error(Id::kExportAmbiguous, where, ": ", in_quotes(source), " of ",
                        in_quotes(sub.DXILLibrary.name()), " has ", found.size(),
                        " overloads; use the mangled name to rename one");
    }
    if (found.empty() && !is_subobject(table, source)) {
      return make_error(Id::kExportNotFound, where, ": ", in_quotes(sub.DXILLibrary.name()),
                        " has no export ", in_quotes(source), "; it has ", list_exports(table));
    }
    for (const auto* e : found) {
      add_shader(*e, sub.DXILLibrary, scope, renames ? wanted.Name : std::string());
    }
  }
  return {};
}

bool Gatherer::is_subobject(const shader::LibraryDesc& table, const std::string& name) {
  for (uint32_t i = 0; i < table.subobject_count; ++i) {
    if (table.subobjects[i].name && name == table.subobjects[i].name) return true;
  }
  return false;
}

std::string Gatherer::list_exports(const shader::LibraryDesc& table) {
  std::string list;
  for (uint32_t i = 0; i < table.export_count && i < 12; ++i) {
    list += concat(i ? ", " : "", in_quotes(table.exports[i].name));
  }
  if (table.export_count > 12) list += ", ...";
  return list.empty() ? "none" : list;
}

Status Gatherer::gather_library_subobjects(const DxilLibraryDesc& sub, int scope) {
  const auto& table = *sub.DXILLibrary.impl()->desc;
  for (uint32_t i = 0; i < table.subobject_count; ++i) {
    const auto& s = table.subobjects[i];
    if (!is_listed(sub, s.name)) continue;
    const std::string name = s.name ? s.name : "";
    const std::string where = concat(in_quotes(name), " of ", in_quotes(sub.DXILLibrary.name()));
    DefinitionPtr definition;
    Status status;
    switch (static_cast<StateSubobjectType>(s.type)) {
      case StateSubobjectType::kGlobalRootSignature:
        status = define_from_text(s.strings[0], false, where, definition);
        break;
      case StateSubobjectType::kLocalRootSignature:
        status = define_from_text(s.strings[0], true, where, definition);
        break;
      case StateSubobjectType::kRaytracingShaderConfig:
        status = define_shader_config({s.values[0], s.values[1]}, where, definition);
        break;
      case StateSubobjectType::kRaytracingPipelineConfig:
        status = define_pipeline_config({s.values[0], RaytracingPipelineFlags::kNone}, false, where,
                                        definition);
        break;
      case StateSubobjectType::kRaytracingPipelineConfig1:
        status =
            define_pipeline_config({s.values[0], static_cast<RaytracingPipelineFlags>(s.values[1])},
                                   true, where, definition);
        break;
      case StateSubobjectType::kHitGroup: {
        auto text = [&s](int k) { return std::string(s.strings[k] ? s.strings[k] : ""); };
        status =
            add_hit_group({name, static_cast<HitGroupType>(s.values[0]), text(0), text(1), text(2)},
                          scope, where);
        break;
      }
      case StateSubobjectType::kStateObjectConfig:
        break;
      case StateSubobjectType::kSubobjectToExportsAssociation:
      case StateSubobjectType::kDxilSubobjectToExportsAssociation:
        library_associations_.push_back(
            {scope, s.strings[0] ? s.strings[0] : "", split_names(s.strings[1]), where});
        break;
      default:
        status = make_error(Id::kLibrarySubobject, where, ": type ", s.type,
                            " cannot be declared in HLSL");
    }
    if (!status.ok()) return status;
    if (definition) library_definitions_[static_cast<size_t>(scope)][name] = definition;
  }
  return {};
}

Status Gatherer::define_from_text(const char* text, bool local, const std::string& where,
                                  DefinitionPtr& out) {
  auto desc = ParseRootSignature(text ? text : "");
  if (!desc.ok()) return make_error(Id::kLibrarySubobject, where, ": ", desc.error().message);
  // Like DXC, set the flag for LocalRootSignature subobjects, whatever the string says.
  if (local) desc->Flags |= RootSignatureFlags::kLocalRootSignature;
  auto signature = make_root_signature(parts_.device, *desc);
  if (!signature.ok()) {
    return make_error(Id::kLibrarySubobject, where, ": ", signature.error().message);
  }
  return define_root_signature(*signature, local, where, out);
}
}  // namespace rtapi::detail

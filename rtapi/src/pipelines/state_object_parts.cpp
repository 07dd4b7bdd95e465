// SPDX-License-Identifier: MIT
//
// Checks the description as a whole: flags, associations, defaults, clashing names.
#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "rtapi/src/pipelines/state_object_gatherer.h"
#include "rtapi/src/shaders/shader_library_impl.h"

namespace rtapi {

// Inline, these would make every file that includes the header instantiate a vector of variants.
uint32_t StateObjectDesc::Add(StateSubobject subobject) {
  Subobjects.push_back(std::move(subobject));
  return static_cast<uint32_t>(Subobjects.size() - 1);
}

void StateObjectDesc::Associate(uint32_t subobject, std::vector<std::string> exports) {
  Subobjects.push_back(SubobjectToExportsAssociation{subobject, std::move(exports)});
}

ExistingCollectionDesc ExistingCollectionDesc::Of(const StateObject& collection,
                                                  std::vector<ExportDesc> exports) {
  return {std::make_shared<StateObject>(collection), std::move(exports)};
}

StateSubobjectType GetSubobjectType(const StateSubobject& subobject) {
  static constexpr StateSubobjectType kTypes[] = {
      StateSubobjectType::kStateObjectConfig,
      StateSubobjectType::kGlobalRootSignature,
      StateSubobjectType::kLocalRootSignature,
      StateSubobjectType::kNodeMask,
      StateSubobjectType::kDxilLibrary,
      StateSubobjectType::kExistingCollection,
      StateSubobjectType::kSubobjectToExportsAssociation,
      StateSubobjectType::kDxilSubobjectToExportsAssociation,
      StateSubobjectType::kRaytracingShaderConfig,
      StateSubobjectType::kRaytracingPipelineConfig,
      StateSubobjectType::kHitGroup,
      StateSubobjectType::kRaytracingPipelineConfig1,
  };
  static_assert(std::variant_size_v<StateSubobject> == std::size(kTypes));
  return kTypes[subobject.index()];
}

namespace detail {

namespace {

constexpr auto kDefinedObjectFlags =
    StateObjectFlags::kAllowLocalDependenciesOnExternalDefinitions |
    StateObjectFlags::kAllowExternalDependenciesOnLocalDefinitions |
    StateObjectFlags::kAllowStateObjectAdditions;

}  // namespace

Gatherer::Gatherer(const std::shared_ptr<DeviceImpl>& device, const StateObjectDesc& desc)
    : desc_(desc) {
  parts_.device = device;
  parts_.type = desc.Type;
}

Result<Parts> Gatherer::run() {
  if (desc_.Type != StateObjectType::kCollection &&
      desc_.Type != StateObjectType::kRaytracingPipeline) {
    return make_error(Id::kStateObjectInvalidSubobject, "state object type ",
                      static_cast<uint32_t>(desc_.Type),
                      "; it must be kCollection (0) or kRaytracingPipeline (3)");
  }
  definitions_.resize(desc_.Subobjects.size());
  // Read the flags first: they decide whether a collection may be included.
  if (Status s = gather_configs(); !s.ok()) return s.error();
  for (size_t i = 0; i < desc_.Subobjects.size(); ++i) {
    Status s = std::visit([&](const auto& sub) { return gather(sub, i); }, desc_.Subobjects[i]);
    if (!s.ok()) return s.error();
  }
  for (size_t i = 0; i < desc_.Subobjects.size(); ++i) {
    Status s = gather_association(desc_.Subobjects[i], i);
    if (!s.ok()) return s.error();
  }
  gather_defaults();
  if (Status s = check_names(); !s.ok()) return s.error();
  return std::move(parts_);
}

Status Gatherer::gather_configs() {
  std::optional<StateObjectFlags> flags;
  for (size_t i = 0; i < desc_.Subobjects.size(); ++i) {
    const auto* config = std::get_if<StateObjectConfig>(&desc_.Subobjects[i]);
    if (!config) continue;
    if (Status s = take_flags(config->Flags, where_of(i), flags); !s.ok()) return s;
  }
  const bool declared_here = flags.has_value();  // overrides the libraries' flags
  for (const StateSubobject& sub : desc_.Subobjects) {
    const auto* library = std::get_if<DxilLibraryDesc>(&sub);
    if (!library || !library->DXILLibrary || declared_here) continue;
    const auto& table = *library->DXILLibrary.impl()->desc;
    for (uint32_t i = 0; i < table.subobject_count; ++i) {
      const auto& s = table.subobjects[i];
      if (s.type != 0 || !is_listed(*library, s.name)) continue;
      if (Status st = take_flags(static_cast<StateObjectFlags>(s.values[0]),
                                 concat(in_quotes(s.name ? s.name : ""), " of ",
                                        in_quotes(library->DXILLibrary.name())),
                                 flags);
          !st.ok()) {
        return st;
      }
    }
  }
  parts_.flags = flags.value_or(StateObjectFlags::kNone);
  return {};
}

Status Gatherer::take_flags(StateObjectFlags value, const std::string& where,
                            std::optional<StateObjectFlags>& flags) {
  if ((value & ~kDefinedObjectFlags) != StateObjectFlags::kNone) {
    return make_error(Id::kConfigFlags, where, ": undefined state object flags ",
                      hex(static_cast<uint32_t>(value)), "; only 0x1, 0x2 and 0x4 are defined");
  }
  if (flags && *flags != value) {
    return make_error(Id::kAssociationConflict, where, ": a second state object config has flags ",
                      hex(static_cast<uint32_t>(value)), ", but the first has ",
                      hex(static_cast<uint32_t>(*flags)));
  }
  flags = value;
  return {};
}

Status Gatherer::gather(const NodeMask& mask, size_t i) {
  if (mask.Mask <= 1) return {};
  return make_error(Id::kStateObjectInvalidSubobject, where_of(i), ": node mask ", hex(mask.Mask),
                    "; there is a single node, so it must be 0 or 1");
}

Status Gatherer::gather(const GlobalRootSignature& sub, size_t i) {
  return define_root_signature(sub.pGlobalRootSignature, false, where_of(i), definitions_[i]);
}

Status Gatherer::gather(const LocalRootSignature& sub, size_t i) {
  return define_root_signature(sub.pLocalRootSignature, true, where_of(i), definitions_[i]);
}

Status Gatherer::gather(const RaytracingShaderConfig& sub, size_t i) {
  return define_shader_config(sub, where_of(i), definitions_[i]);
}

Status Gatherer::gather(const RaytracingPipelineConfig& sub, size_t i) {
  return define_pipeline_config({sub.MaxTraceRecursionDepth, RaytracingPipelineFlags::kNone}, false,
                                where_of(i), definitions_[i]);
}

Status Gatherer::gather(const RaytracingPipelineConfig1& sub, size_t i) {
  return define_pipeline_config(sub, true, where_of(i), definitions_[i]);
}

Status Gatherer::check_names() {
  // Overloads share a plain name, so shaders clash only if their mangled names do, where they have
  // one.
  std::map<std::string, const Subject*> seen;
  for (const SubjectPtr& s : parts_.subjects) {
    if (s->hidden) continue;
    const std::string key = s->mangled.empty() ? s->name : s->mangled;
    auto [it, is_new] = seen.emplace(key, s.get());
    if (!is_new) {
      return make_error(Id::kExportDuplicate, in_quotes(s->name), " is exported twice",
                        origin(*it->second), origin(*s),
                        "; rename one of them in its export list, or leave it out");
    }
  }
  // A hit group and a shader must not share a name: nothing could tell them apart.
  std::map<std::string_view, const Subject*> shaders;
  for (const SubjectPtr& s : parts_.subjects) {
    if (!s->hidden && !s->is_group()) shaders.emplace(s->name, s.get());
  }
  for (const SubjectPtr& s : parts_.subjects) {
    if (s->hidden || !s->is_group()) continue;
    if (auto it = shaders.find(s->name); it != shaders.end()) {
      return make_error(Id::kExportDuplicate, "hit group ", in_quotes(s->name),
                        " has the same name as a shader", origin(*it->second));
    }
  }
  return {};
}

std::string Gatherer::origin(const Subject& s) const {
  if (s.collection_scope >= 0) return concat(", from collection ", s.collection_scope);
  if (s.library_scope < 0) return {};
  return concat(", from ",
                in_quotes(parts_.libraries[static_cast<size_t>(s.library_scope)].name()));
}
Status Gatherer::gather_association(const StateSubobject& sub, size_t i) {
  if (const auto* a = std::get_if<SubobjectToExportsAssociation>(&sub)) {
    if (a->SubobjectToAssociate >= desc_.Subobjects.size()) {
      return make_error(Id::kAssociationBadSubobject, where_of(i), " associates subobject ",
                        a->SubobjectToAssociate, ", but there are only ", desc_.Subobjects.size());
    }
    const auto type = GetSubobjectType(desc_.Subobjects[a->SubobjectToAssociate]);
    if (type == StateSubobjectType::kNodeMask || type == StateSubobjectType::kStateObjectConfig) {
      return {};
    }
    const DefinitionPtr& definition = definitions_[a->SubobjectToAssociate];
    if (!definition) {
      return make_error(Id::kAssociationBadSubobject, where_of(i), " associates subobject ",
                        a->SubobjectToAssociate, " of type ", static_cast<uint32_t>(type),
                        "; only configs and root signatures can be associated with exports");
    }
    associate(definition, a->Exports, -1, where_of(i));
  } else if (const auto* d = std::get_if<DxilSubobjectToExportsAssociation>(&sub)) {
    const DefinitionPtr definition = find_in_libraries(d->SubobjectToAssociate);
    if (!definition && !parts_.is_collection()) {
      return make_error(Id::kAssociationBadSubobject, where_of(i), " associates ",
                        in_quotes(d->SubobjectToAssociate),
                        ", which no included library declares as a config or root signature");
    }
    if (definition) associate(definition, d->Exports, -1, where_of(i));
  }
  return {};
}

DefinitionPtr Gatherer::find_in_libraries(const std::string& name) const {
  for (const auto& definitions : library_definitions_) {
    if (auto it = definitions.find(name); it != definitions.end()) return it->second;
  }
  return nullptr;
}

void Gatherer::associate(const DefinitionPtr& definition, const std::vector<std::string>& exports,
                         int scope, const std::string& where) {
  associated_.insert(definition.get());
  if (exports.empty()) {
    scope_at(scope).by_empty.push_back(definition);
  } else {
    parts_.explicit_associations.push_back({definition, exports, scope, where});
  }
}

DefaultScope& Gatherer::scope_at(int scope) {
  return scope < 0 ? parts_.own_scope : parts_.library_scopes[static_cast<size_t>(scope)];
}

void Gatherer::gather_defaults() {
  for (const LibraryAssociation& a : library_associations_) {
    const auto& own = library_definitions_[static_cast<size_t>(a.scope)];
    auto it = own.find(a.subobject);
    const DefinitionPtr definition = it != own.end() ? it->second : find_in_libraries(a.subobject);
    if (definition) associate(definition, a.exports, a.scope, a.where);
  }
  for (const DefinitionPtr& d : definitions_) {
    if (d && !associated_.count(d.get())) parts_.own_scope.implicit.push_back(d);
  }
  for (size_t scope = 0; scope < library_definitions_.size(); ++scope) {
    for (const auto& [name, d] : library_definitions_[scope]) {
      if (!associated_.count(d.get())) parts_.library_scopes[scope].implicit.push_back(d);
    }
  }
}
Result<Parts> gather_parts(const std::shared_ptr<DeviceImpl>& device, const StateObjectDesc& desc) {
  if (!device->runs_variants()) return Gatherer(device, desc).run();
  StateObjectDesc variants = desc;
  bool all = true;
  for (StateSubobject& sub : variants.Subobjects) {
    auto* library = std::get_if<DxilLibraryDesc>(&sub);
    if (!library || !library->DXILLibrary) continue;
    library->DXILLibrary = device->library_to_run(library->DXILLibrary);
    all &= (library->DXILLibrary.impl()->desc->flags & kaamos::shader::kLibraryChecked) != 0;
  }
  // In SPIR-V the checked mode's payload header is part of the payload's type, so checked and
  // unchecked shaders cannot exchange payloads.
  const bool mixed_is_safe = device->desc.Backend != "vulkan" || !device->desc.Checked;
  return Gatherer(device, all || mixed_is_safe ? variants : desc).run();
}

}  // namespace detail
}  // namespace rtapi

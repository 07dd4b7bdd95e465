// SPDX-License-Identifier: MIT
//
// First stage of making a state object: every subobject is checked by itself and sorted into Parts.
#include <algorithm>
#include <set>

#include "rtapi/src/root_signature_impl.h"
#include "rtapi/src/shader_library_impl.h"
#include "rtapi/src/state_object_impl.h"

namespace rtapi {

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

const char* CategoryName(Category category) {
  static constexpr const char* kNames[] = {"shader config", "pipeline config",
                                           "global root signature", "local root signature"};
  return kNames[static_cast<size_t>(category)];
}

bool SameDefinition(const Definition& a, const Definition& b) {
  if (a.category != b.category) return false;
  switch (a.category) {
    case Category::kShaderConfig:
      return a.shader_config.MaxPayloadSizeInBytes == b.shader_config.MaxPayloadSizeInBytes &&
             a.shader_config.MaxAttributeSizeInBytes == b.shader_config.MaxAttributeSizeInBytes;
    case Category::kPipelineConfig:
      return a.pipeline_config.MaxTraceRecursionDepth == b.pipeline_config.MaxTraceRecursionDepth &&
             a.pipeline_config.Flags == b.pipeline_config.Flags;
    default:
      return SameDefinition(a.root_signature, b.root_signature);
  }
}

namespace {

constexpr auto kDefinedObjectFlags =
    StateObjectFlags::kAllowLocalDependenciesOnExternalDefinitions |
    StateObjectFlags::kAllowExternalDependenciesOnLocalDefinitions |
    StateObjectFlags::kAllowStateObjectAdditions;

std::vector<std::string> SplitNames(const char* list) {
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

class Gatherer {
 public:
  Gatherer(const std::shared_ptr<DeviceImpl>& device, const StateObjectDesc& desc) : desc_(desc) {
    parts_.device = device;
    parts_.type = desc.Type;
  }

  Result<Parts> Run() {
    if (desc_.Type != StateObjectType::kCollection &&
        desc_.Type != StateObjectType::kRaytracingPipeline) {
      return MakeError(Id::kStateObjectInvalidSubobject, "state object type ",
                       static_cast<uint32_t>(desc_.Type),
                       "; allowed are kCollection (0) and "
                       "kRaytracingPipeline (3)");
    }
    definitions_.resize(desc_.Subobjects.size());
    // Flags first: whether a collection may be included depends on them.
    if (Status s = GatherConfigs(); !s.ok()) return s.error();
    for (size_t i = 0; i < desc_.Subobjects.size(); ++i) {
      Status s = std::visit([&](const auto& sub) { return Gather(sub, i); }, desc_.Subobjects[i]);
      if (!s.ok()) return s.error();
    }
    for (size_t i = 0; i < desc_.Subobjects.size(); ++i) {
      Status s = GatherAssociation(desc_.Subobjects[i], i);
      if (!s.ok()) return s.error();
    }
    GatherDefaults();
    if (Status s = CheckNames(); !s.ok()) return s.error();
    return std::move(parts_);
  }

 private:
  static std::string Where(size_t index) { return Text("subobject ", index); }

  Status GatherConfigs() {
    std::optional<StateObjectFlags> flags;
    for (size_t i = 0; i < desc_.Subobjects.size(); ++i) {
      const auto* config = std::get_if<StateObjectConfig>(&desc_.Subobjects[i]);
      if (!config) continue;
      if (Status s = TakeFlags(config->Flags, Where(i), flags); !s.ok()) return s;
    }
    for (const StateSubobject& sub : desc_.Subobjects) {  // API ones override those in libraries
      const auto* library = std::get_if<DxilLibraryDesc>(&sub);
      if (!library || !library->DXILLibrary || own_flags_) continue;
      const auto& table = *library->DXILLibrary.impl()->desc;
      for (uint32_t i = 0; i < table.subobject_count; ++i) {
        const auto& s = table.subobjects[i];
        if (s.type != 0 || !IsListed(*library, s.name)) continue;
        if (Status st = TakeFlags(
                static_cast<StateObjectFlags>(s.values[0]),
                Text(Quoted(s.name ? s.name : ""), " of ", Quoted(library->DXILLibrary.name())),
                flags);
            !st.ok()) {
          return st;
        }
      }
    }
    parts_.flags = flags.value_or(StateObjectFlags::kNone);
    return {};
  }

  Status TakeFlags(StateObjectFlags value, const std::string& where,
                   std::optional<StateObjectFlags>& flags) {
    if ((value & ~kDefinedObjectFlags) != StateObjectFlags::kNone) {
      return MakeError(Id::kConfigFlags, where, ": state object flags ",
                       Hex(static_cast<uint32_t>(value)), "; defined are 0x1, 0x2 and 0x4");
    }
    if (flags && *flags != value) {
      return MakeError(Id::kAssociationConflict, where, ": a second state object config has flags ",
                       Hex(static_cast<uint32_t>(value)), ", the first ",
                       Hex(static_cast<uint32_t>(*flags)));
    }
    flags = value;
    return {};
  }

  // --- subobjects of the description ---

  Status Gather(const StateObjectConfig&, size_t) {
    own_flags_ = true;
    return {};
  }
  Status Gather(const NodeMask& mask, size_t i) {
    if (mask.Mask <= 1) return {};
    return MakeError(Id::kStateObjectInvalidSubobject, Where(i), ": node mask ", Hex(mask.Mask),
                     "; there is one node, allowed is 0 or 1");
  }
  Status Gather(const GlobalRootSignature& sub, size_t i) {
    return DefineRootSignature(sub.pGlobalRootSignature, false, Where(i), definitions_[i]);
  }
  Status Gather(const LocalRootSignature& sub, size_t i) {
    return DefineRootSignature(sub.pLocalRootSignature, true, Where(i), definitions_[i]);
  }
  Status Gather(const RaytracingShaderConfig& sub, size_t i) {
    return DefineShaderConfig(sub, Where(i), definitions_[i]);
  }
  Status Gather(const RaytracingPipelineConfig& sub, size_t i) {
    return DefinePipelineConfig({sub.MaxTraceRecursionDepth, RaytracingPipelineFlags::kNone}, false,
                                Where(i), definitions_[i]);
  }
  Status Gather(const RaytracingPipelineConfig1& sub, size_t i) {
    return DefinePipelineConfig(sub, true, Where(i), definitions_[i]);
  }
  Status Gather(const HitGroupDesc& sub, size_t i) { return AddHitGroup(sub, -1, Where(i)); }
  Status Gather(const SubobjectToExportsAssociation&, size_t) { return {}; }
  Status Gather(const DxilSubobjectToExportsAssociation&, size_t) { return {}; }

  Status Gather(const ExistingCollectionDesc& sub, size_t i) {
    const std::string where = Where(i);
    if (parts_.is_collection()) {
      return MakeError(Id::kCollectionNested, where,
                       " is an existing collection; only pipelines may hold collections");
    }
    if (!sub.pExistingCollection) {
      return MakeError(Id::kNullHandle, where, ": pExistingCollection is empty");
    }
    if (Status s = CheckHandle(parts_.device, *sub.pExistingCollection, where); !s.ok()) return s;
    const StateObjectImpl& collection = *sub.pExistingCollection->impl();
    if (collection.type != StateObjectType::kCollection) {
      return MakeError(Id::kCollectionNested, where,
                       " is a pipeline; only collections can be "
                       "included. Use AddToStateObject to extend a pipeline");
    }
    const auto additions = StateObjectFlags::kAllowStateObjectAdditions;
    if (HasAny(parts_.flags, additions) && !HasAny(collection.flags, additions)) {
      return MakeError(Id::kCollectionWithoutAdditions, where,
                       ": the pipeline has flag 0x4 "
                       "(kAllowStateObjectAdditions), so the collection needs it too");
    }
    return ImportCollection(collection, sub.Exports, where);
  }

  Status Gather(const DxilLibraryDesc& sub, size_t i) {
    const std::string where = Where(i);
    if (!sub.DXILLibrary) {
      return MakeError(Id::kNullHandle, where, ": DXILLibrary is an empty handle");
    }
    const std::string& target = sub.DXILLibrary.target();
    unsigned major = 0, minor = 0;
    const bool lib = std::sscanf(target.c_str(), "lib_%u_%u", &major, &minor) == 2;
    if (!lib || major < 6 || (major == 6 && minor < 3)) {
      return MakeError(Id::kLibraryTarget, where, ": ", Quoted(sub.DXILLibrary.name()),
                       " was compiled for ", Quoted(target), "; allowed is lib_6_3 and later");
    }
    const int scope = static_cast<int>(parts_.libraries.size());
    parts_.libraries.push_back(sub.DXILLibrary);
    parts_.library_scopes.emplace_back();
    library_definitions_.emplace_back();
    if (Status s = GatherExports(sub, scope, where); !s.ok()) return s;
    return GatherLibrarySubobjects(sub, scope);
  }

  // --- definitions ---

  Status DefineRootSignature(const RootSignature& signature, bool local, const std::string& where,
                             DefinitionPtr& out) {
    if (Status s = CheckHandle(parts_.device, signature, where + ": the root signature"); !s.ok()) {
      return s;
    }
    if (signature.is_local() != local) {
      return MakeError(Id::kRootSignatureKind, where, " takes a ", local ? "local" : "global",
                       " root signature; this one was created ", local ? "without" : "with",
                       " the flag kLocalRootSignature");
    }
    Definition d;
    d.category = local ? Category::kLocalRootSignature : Category::kGlobalRootSignature;
    d.root_signature = signature;
    d.where = where;
    out = std::make_shared<Definition>(std::move(d));
    return {};
  }

  Status DefineShaderConfig(const RaytracingShaderConfig& config, const std::string& where,
                            DefinitionPtr& out) {
    if (config.MaxAttributeSizeInBytes > kRaytracingMaxAttributeSizeInBytes) {
      return MakeError(Id::kAttributeSizeLimit, where, ": MaxAttributeSizeInBytes is ",
                       config.MaxAttributeSizeInBytes, "; allowed is 0 to 32");
    }
    Definition d;
    d.category = Category::kShaderConfig;
    d.shader_config = config;
    d.where = where;
    out = std::make_shared<Definition>(std::move(d));
    return {};
  }

  Status DefinePipelineConfig(const RaytracingPipelineConfig1& config, bool config1,
                              const std::string& where, DefinitionPtr& out) {
    if (config.MaxTraceRecursionDepth > kRaytracingMaxDeclarableTraceRecursionDepth) {
      return MakeError(Id::kRecursionDepth, where, ": MaxTraceRecursionDepth is ",
                       config.MaxTraceRecursionDepth, "; allowed is 0 to 31");
    }
    if (config1 && parts_.device->desc.Tier < RaytracingTier::kTier1_1) {
      return MakeError(Id::kPipelineConfig1Tier, where,
                       " is a RaytracingPipelineConfig1; this device was created with tier 1.0");
    }
    const auto known = RaytracingPipelineFlags::kSkipTriangles |
                       RaytracingPipelineFlags::kSkipProceduralPrimitives;
    if ((config.Flags & ~known) != RaytracingPipelineFlags::kNone) {
      return MakeError(Id::kConfigFlags, where, ": pipeline flags ",
                       Hex(static_cast<uint32_t>(config.Flags)), "; defined are 0x100 and 0x200");
    }
    if (config.Flags == known) {
      return MakeError(Id::kConfigFlags, where,
                       ": kSkipTriangles and kSkipProceduralPrimitives exclude each other");
    }
    Definition d;
    d.category = Category::kPipelineConfig;
    d.pipeline_config = config;
    d.where = where;
    out = std::make_shared<Definition>(std::move(d));
    return {};
  }

  // --- libraries ---

  static bool IsListed(const DxilLibraryDesc& sub, const char* name) {
    if (sub.Exports.empty()) return true;
    return name && std::any_of(sub.Exports.begin(), sub.Exports.end(), [&](const ExportDesc& e) {
             return e.Name == name || e.ExportToRename == name;
           });
  }

  void AddShader(const shader::ExportDesc& code, const ShaderLibrary& library, int scope,
                 const std::string& renamed) {
    if (code.stage == shader::Stage::kCompute) return;
    auto subject = std::make_shared<Subject>();
    subject->name = renamed.empty() ? code.name : renamed;
    if (renamed.empty() && code.mangled_name) subject->mangled = code.mangled_name;
    subject->code = &code;
    subject->library = library;
    subject->library_scope = scope;
    parts_.subjects.push_back(std::move(subject));
  }

  Status GatherExports(const DxilLibraryDesc& sub, int scope, const std::string& where) {
    const auto& table = *sub.DXILLibrary.impl()->desc;
    if (sub.Exports.empty()) {
      for (uint32_t i = 0; i < table.export_count; ++i) {
        AddShader(table.exports[i], sub.DXILLibrary, scope, {});
      }
      return {};
    }
    for (const ExportDesc& wanted : sub.Exports) {
      if (wanted.Name.empty()) {
        return MakeError(Id::kExportUnnamed, where, ": an ExportDesc has an empty Name");
      }
      const std::string& source =
          wanted.ExportToRename.empty() ? wanted.Name : wanted.ExportToRename;
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
        return MakeError(Id::kExportAmbiguous, where, ": ", Quoted(source), " of ",
                         Quoted(sub.DXILLibrary.name()), " has ", found.size(),
                         " overloads; rename by the mangled name");
      }
      if (found.empty() && !IsSubobject(table, source)) {
        return MakeError(Id::kExportNotFound, where, ": ", Quoted(sub.DXILLibrary.name()),
                         " has no export ", Quoted(source), "; it has ", ListExports(table));
      }
      for (const auto* e : found) {
        AddShader(*e, sub.DXILLibrary, scope, renames ? wanted.Name : std::string());
      }
    }
    return {};
  }

  static bool IsSubobject(const shader::LibraryDesc& table, const std::string& name) {
    for (uint32_t i = 0; i < table.subobject_count; ++i) {
      if (table.subobjects[i].name && name == table.subobjects[i].name) return true;
    }
    return false;
  }

  static std::string ListExports(const shader::LibraryDesc& table) {
    std::string list;
    for (uint32_t i = 0; i < table.export_count && i < 12; ++i) {
      list += Text(i ? ", " : "", Quoted(table.exports[i].name));
    }
    if (table.export_count > 12) list += ", ...";
    return list.empty() ? "none" : list;
  }

  Status GatherLibrarySubobjects(const DxilLibraryDesc& sub, int scope) {
    const auto& table = *sub.DXILLibrary.impl()->desc;
    for (uint32_t i = 0; i < table.subobject_count; ++i) {
      const auto& s = table.subobjects[i];
      if (!IsListed(sub, s.name)) continue;
      const std::string name = s.name ? s.name : "";
      const std::string where = Text(Quoted(name), " of ", Quoted(sub.DXILLibrary.name()));
      DefinitionPtr definition;
      Status status;
      switch (static_cast<StateSubobjectType>(s.type)) {
        case StateSubobjectType::kGlobalRootSignature:
          status = DefineFromText(s.strings[0], false, where, definition);
          break;
        case StateSubobjectType::kLocalRootSignature:
          status = DefineFromText(s.strings[0], true, where, definition);
          break;
        case StateSubobjectType::kRaytracingShaderConfig:
          status = DefineShaderConfig({s.values[0], s.values[1]}, where, definition);
          break;
        case StateSubobjectType::kRaytracingPipelineConfig:
          status = DefinePipelineConfig({s.values[0], RaytracingPipelineFlags::kNone}, false, where,
                                        definition);
          break;
        case StateSubobjectType::kRaytracingPipelineConfig1:
          status =
              DefinePipelineConfig({s.values[0], static_cast<RaytracingPipelineFlags>(s.values[1])},
                                   true, where, definition);
          break;
        case StateSubobjectType::kHitGroup: {
          auto text = [&s](int k) { return std::string(s.strings[k] ? s.strings[k] : ""); };
          status =
              AddHitGroup({name, static_cast<HitGroupType>(s.values[0]), text(0), text(1), text(2)},
                          scope, where);
          break;
        }
        case StateSubobjectType::kStateObjectConfig:
          break;
        case StateSubobjectType::kSubobjectToExportsAssociation:
        case StateSubobjectType::kDxilSubobjectToExportsAssociation:
          library_associations_.push_back(
              {scope, s.strings[0] ? s.strings[0] : "", SplitNames(s.strings[1]), where});
          break;
        default:
          status = MakeError(Id::kLibrarySubobject, where, ": type ", s.type,
                             " cannot be declared in HLSL");
      }
      if (!status.ok()) return status;
      if (definition) library_definitions_[static_cast<size_t>(scope)][name] = definition;
    }
    return {};
  }

  Status DefineFromText(const char* text, bool local, const std::string& where,
                        DefinitionPtr& out) {
    auto desc = ParseRootSignature(text ? text : "");
    if (!desc.ok()) return MakeError(Id::kLibrarySubobject, where, ": ", desc.error().message);
    // DXC sets the flag for LocalRootSignature subobjects, whatever the string says.
    if (local) desc->Flags |= RootSignatureFlags::kLocalRootSignature;
    auto signature = MakeRootSignature(parts_.device, *desc);
    if (!signature.ok()) {
      return MakeError(Id::kLibrarySubobject, where, ": ", signature.error().message);
    }
    return DefineRootSignature(*signature, local, where, out);
  }

  Status AddHitGroup(const HitGroupDesc& group, int scope, const std::string& where) {
    if (group.HitGroupExport.empty()) {
      return MakeError(Id::kExportUnnamed, where, ": HitGroupExport is empty");
    }
    const std::string name = Text(where, ", hit group ", Quoted(group.HitGroupExport));
    const bool has_intersection = !group.IntersectionShaderImport.empty();
    if (group.Type != HitGroupType::kTriangles &&
        group.Type != HitGroupType::kProceduralPrimitive) {
      return MakeError(Id::kHitGroupShape, name, ": type ", static_cast<uint32_t>(group.Type),
                       "; allowed are kTriangles (0) and kProceduralPrimitive (1)");
    }
    if (group.Type == HitGroupType::kTriangles && has_intersection) {
      return MakeError(Id::kHitGroupShape, name,
                       ": a triangle hit group has no intersection "
                       "shader, this one imports ",
                       Quoted(group.IntersectionShaderImport));
    }
    if (group.Type == HitGroupType::kProceduralPrimitive && !has_intersection) {
      return MakeError(Id::kHitGroupShape, name,
                       ": a procedural hit group needs an intersection shader");
    }
    auto subject = std::make_shared<Subject>();
    subject->name = group.HitGroupExport;
    subject->group = group;
    subject->library_scope = scope;
    parts_.subjects.push_back(std::move(subject));
    return {};
  }

  // --- collections ---

  Status ImportCollection(const StateObjectImpl& collection, const std::vector<ExportDesc>& exports,
                          const std::string& where) {
    const int scope = parts_.collection_count++;
    const bool referable =
        HasAny(collection.flags, StateObjectFlags::kAllowExternalDependenciesOnLocalDefinitions);
    std::map<const Subject*, SubjectPtr> copies;
    for (const SubjectPtr& original : collection.subjects) {
      auto copy = std::make_shared<Subject>(*original);
      copy->collection_scope = scope;
      copy->library_scope = -1;
      copy->referable = referable;
      copy->hidden = original->hidden || !exports.empty();
      copies[original.get()] = copy;
      parts_.subjects.push_back(copy);
    }
    for (auto& [original, copy] : copies) {
      for (SubjectPtr& member : copy->members) {
        if (member) member = copies[member.get()];
      }
    }
    if (Status s = ListCollectionExports(collection, copies, exports, where); !s.ok()) return s;
    if (!referable) return {};
    for (const ExplicitAssociation& a : collection.outward_associations) {
      parts_.explicit_associations.push_back(a);
      parts_.explicit_associations.back().library_scope = -1;
    }
    return {};
  }

  // An export list makes what it names visible, under a new name where it gives one.
  Status ListCollectionExports(const StateObjectImpl& collection,
                               std::map<const Subject*, SubjectPtr>& copies,
                               const std::vector<ExportDesc>& exports, const std::string& where) {
    for (const ExportDesc& wanted : exports) {
      const std::string& source =
          wanted.ExportToRename.empty() ? wanted.Name : wanted.ExportToRename;
      bool found = false;
      for (const SubjectPtr& original : collection.subjects) {
        if (original->hidden || !original->answers_to(source)) continue;
        found = true;
        SubjectPtr& copy = copies[original.get()];
        if (copy->hidden) {
          copy->hidden = false;
          if (wanted.Name != source) {
            copy->name = wanted.Name;
            copy->mangled.clear();
          }
        } else {  // exported twice, under two names
          auto again = std::make_shared<Subject>(*copy);
          again->name = wanted.Name;
          again->mangled.clear();
          parts_.subjects.push_back(std::move(again));
        }
      }
      if (!found) {
        return MakeError(Id::kExportNotFound, where, ": the collection has no export ",
                         Quoted(source));
      }
    }
    return {};
  }

  // --- associations ---

  Status GatherAssociation(const StateSubobject& sub, size_t i) {
    if (const auto* a = std::get_if<SubobjectToExportsAssociation>(&sub)) {
      if (a->SubobjectToAssociate >= desc_.Subobjects.size()) {
        return MakeError(Id::kAssociationBadSubobject, Where(i), " associates subobject ",
                         a->SubobjectToAssociate, " of ", desc_.Subobjects.size());
      }
      const auto type = GetSubobjectType(desc_.Subobjects[a->SubobjectToAssociate]);
      if (type == StateSubobjectType::kNodeMask || type == StateSubobjectType::kStateObjectConfig) {
        return {};
      }
      const DefinitionPtr& definition = definitions_[a->SubobjectToAssociate];
      if (!definition) {
        return MakeError(Id::kAssociationBadSubobject, Where(i), " associates subobject ",
                         a->SubobjectToAssociate, " of type ", static_cast<uint32_t>(type),
                         "; only configs and root signatures can be associated with exports");
      }
      Associate(definition, a->Exports, -1, Where(i));
    } else if (const auto* d = std::get_if<DxilSubobjectToExportsAssociation>(&sub)) {
      const DefinitionPtr definition = FindInLibraries(d->SubobjectToAssociate);
      if (!definition && !parts_.is_collection()) {
        return MakeError(Id::kAssociationBadSubobject, Where(i), " associates ",
                         Quoted(d->SubobjectToAssociate),
                         ", which no included library declares as a config or root signature");
      }
      if (definition) Associate(definition, d->Exports, -1, Where(i));
    }
    return {};
  }

  DefinitionPtr FindInLibraries(const std::string& name) const {
    for (const auto& definitions : library_definitions_) {
      if (auto it = definitions.find(name); it != definitions.end()) return it->second;
    }
    return nullptr;
  }

  void Associate(const DefinitionPtr& definition, const std::vector<std::string>& exports,
                 int scope, const std::string& where) {
    associated_.insert(definition.get());
    if (exports.empty()) {
      ScopeAt(scope).by_empty.push_back(definition);
    } else {
      parts_.explicit_associations.push_back({definition, exports, scope, where});
    }
  }

  DefaultScope& ScopeAt(int scope) {
    return scope < 0 ? parts_.own_scope : parts_.library_scopes[static_cast<size_t>(scope)];
  }

  void GatherDefaults() {
    for (const LibraryAssociation& a : library_associations_) {
      const auto& own = library_definitions_[static_cast<size_t>(a.scope)];
      auto it = own.find(a.subobject);
      const DefinitionPtr definition = it != own.end() ? it->second : FindInLibraries(a.subobject);
      if (definition) Associate(definition, a.exports, a.scope, a.where);
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

  // --- names ---

  Status CheckNames() {
    // Overloads share a plain name, so that shaders clash by mangled name where they have one.
    std::map<std::string, const Subject*> seen;
    for (const SubjectPtr& s : parts_.subjects) {
      if (s->hidden) continue;
      const std::string key = s->mangled.empty() ? s->name : s->mangled;
      auto [it, is_new] = seen.emplace(key, s.get());
      if (!is_new) {
        return MakeError(Id::kExportDuplicate, Quoted(s->name), " is exported twice",
                         Origin(*it->second), Origin(*s),
                         "; rename one of them in its export list, or leave it out");
      }
    }
    // A hit group and a shader of one name cannot be told apart.
    for (const SubjectPtr& s : parts_.subjects) {
      if (s->hidden || !s->is_group()) continue;
      for (const SubjectPtr& other : parts_.subjects) {
        if (!other->hidden && !other->is_group() && other->name == s->name) {
          return MakeError(Id::kExportDuplicate, "hit group ", Quoted(s->name),
                           " has the name of a shader", Origin(*other));
        }
      }
    }
    return {};
  }

  std::string Origin(const Subject& s) const {
    if (s.collection_scope >= 0) return Text(", from collection ", s.collection_scope);
    if (s.library_scope < 0) return {};
    return Text(", from ", Quoted(parts_.libraries[static_cast<size_t>(s.library_scope)].name()));
  }

  struct LibraryAssociation {
    int scope;
    std::string subobject;
    std::vector<std::string> exports;
    std::string where;
  };

  const StateObjectDesc& desc_;
  Parts parts_;
  bool own_flags_ = false;
  std::vector<DefinitionPtr> definitions_;  // by subobject index
  std::vector<std::map<std::string, DefinitionPtr>> library_definitions_;
  std::vector<LibraryAssociation> library_associations_;
  std::set<const Definition*> associated_;
};

}  // namespace

Result<Parts> GatherParts(const std::shared_ptr<DeviceImpl>& device, const StateObjectDesc& desc) {
  return Gatherer(device, desc).Run();
}

}  // namespace detail
}  // namespace rtapi

// SPDX-License-Identifier: MIT
//
// Third stage of making a state object: hit groups find their shaders, shaders find their bindings,
// and everything that has a shader identifier becomes a record.
#include <algorithm>
#include <set>

#include "rtapi/src/device/device_level.h"
#include "rtapi/src/pipelines/bindings.h"
#include "rtapi/src/pipelines/hit_attributes.h"
#include "rtapi/src/pipelines/root_signature_impl.h"
#include "rtapi/src/pipelines/state_object_impl.h"
#include "rtapi/src/shaders/shader_library_impl.h"

namespace rtapi::detail {

namespace {

using runtime::LinkedRecord;
using runtime::LinkedShader;
using runtime::RecordKind;
using shader::Stage;

constexpr uint32_t kMaxStaticSamplers = 2032;  // [D3D12: root signature limits]

bool is_entry(const Subject& s) {
  return s.code && (s.code->stage == Stage::kRayGeneration || s.code->stage == Stage::kMiss ||
                    s.code->stage == Stage::kCallable);
}

// The definitions that apply to one shader or hit group, after the rules for hit groups.
using Effective = std::array<DefinitionPtr, kCategories>;

RootSignature signature_of(const Effective& e, Category category) {
  const DefinitionPtr& d = e[static_cast<size_t>(category)];
  return d ? d->root_signature : RootSignature();
}

class Linker {
 public:
  explicit Linker(Parts&& parts)
      : parts_(std::move(parts)), linked_(std::make_shared<runtime::LinkedPipeline>()) {}

  Result<std::shared_ptr<StateObjectImpl>> run(bool for_backend) {
    out_ = std::make_shared<StateObjectImpl>();
    out_->device = parts_.device;
    out_->type = parts_.type;
    out_->flags = parts_.flags;
    for (const SubjectPtr& s : parts_.subjects) {
      if (!s->is_group()) continue;
      if (Status st = resolve_members(*s); !st.ok() && !tolerates(st.error())) return st.error();
    }
    if (Status s = check_configs(); !s.ok()) return s.error();
    for (const SubjectPtr& s : parts_.subjects) {
      if (s->hidden || !(s->is_group() || is_entry(*s))) continue;
      if (Status st = add_record(*s); !st.ok() && !tolerates(st.error())) return st.error();
    }
    if (Status s = check_static_samplers(); !s.ok()) return s.error();
    return finish(for_backend);
  }

 private:
  // Errors that a collection may leave to the pipeline that includes it.
  bool tolerates(const Error& error) const {
    if (!parts_.may_stay_unresolved()) return false;
    for (Id id : {Id::kHitGroupUnresolved, Id::kShaderConfigMissing, Id::kPipelineConfigMissing,
                  Id::kBindingMissing, Id::kDefaultAmbiguous, Id::kFunctionUnresolved}) {
      if (error.id == public_id(id)) return true;
    }
    return false;
  }

  // --- hit groups ---

  Status resolve_members(Subject& group) {
    const std::string* names[3] = {&group.group.AnyHitShaderImport,
                                   &group.group.ClosestHitShaderImport,
                                   &group.group.IntersectionShaderImport};
    static constexpr Stage kStages[3] = {Stage::kAnyHit, Stage::kClosestHit, Stage::kIntersection};
    for (size_t i = 0; i < 3; ++i) {
      if (names[i]->empty() || group.members[i]) continue;
      auto found = find_shader(*names[i], group);
      if (!found.ok()) return found.error();
      if ((*found)->code->stage != kStages[i]) {
        return make_error(Id::kHitGroupStage, describe(group), " imports ", in_quotes(*names[i]),
                          " as its ", stage_name(kStages[i]), " shader, but it is a ",
                          stage_name((*found)->code->stage), " shader");
      }
      group.members[i] = *found;
    }
    return check_attributes(*parts_.device, group);
  }

  Result<SubjectPtr> find_shader(const std::string& name, const Subject& group) {
    SubjectPtr found;
    for (const SubjectPtr& s : parts_.subjects) {
      const bool visible = !s->hidden || s->collection_scope == group.collection_scope;
      if (s->is_group() || !visible || !s->answers_to(name)) continue;
      if (s->mangled == name) {
        found = s;
        break;
      }
      if (found) {
        return make_error(Id::kExportAmbiguous, describe(group), " imports ", in_quotes(name),
                          ", which has several overloads; use the mangled name");
      }
      found = s;
    }
    if (!found) {
      return make_error(Id::kHitGroupUnresolved, describe(group), " imports ", in_quotes(name),
                        ", which this state object does not export");
    }
    if (!found->referable && found->collection_scope != group.collection_scope) {
      return make_error(Id::kCollectionNotReferable, describe(group), " imports ", in_quotes(name),
                        " from a collection that lacks flag 0x2 "
                        "(kAllowExternalDependenciesOnLocalDefinitions)");
    }
    return found;
  }

  // [DXR: Subobject associations for hit groups] Associations that name the group or one of its
  // shaders must agree, and they override defaults. Without any, the defaults of the shaders must
  // agree.
  Result<DefinitionPtr> effective_of_group(const Subject& group, size_t category) const {
    std::vector<std::pair<const Subject*, Associated>> all;
    all.emplace_back(&group, group.associations[category]);
    for (const SubjectPtr& m : group.members) {
      if (m) all.emplace_back(m.get(), m->associations[category]);
    }
    const bool group_explicit = all[0].second.strength == Strength::kExplicit;
    const bool any_explicit = std::any_of(all.begin(), all.end(), [](const auto& p) {
      return p.second.strength == Strength::kExplicit;
    });
    const Subject* first = nullptr;
    DefinitionPtr result;
    for (const auto& [subject, associated] : all) {
      if (!associated.definition) continue;
      // If the group is named, the defaults of its shaders give way. If only a shader is named,
      // only the group's own default gives way.
      if (any_explicit && associated.strength != Strength::kExplicit &&
          (group_explicit || subject == &group)) {
        continue;
      }
      if (result && !same_definition(*result, *associated.definition)) {
        return make_error(Id::kHitGroupAssociationMismatch, describe(group), ": ", describe(*first),
                          " has ", category_name(static_cast<Category>(category)), " ",
                          result->where, ", but ", describe(*subject), " has ",
                          associated.definition->where,
                          "; a hit group and its shaders must have the same");
      }
      if (!result) {
        result = associated.definition;
        first = subject;
      }
    }
    return result;
  }

  Result<Effective> get_effective(const Subject& s) const {
    Effective effective;
    for (size_t c = 0; c < kCategories; ++c) {
      if (!s.is_group()) {
        effective[c] = s.associations[c].definition;
        continue;
      }
      auto d = effective_of_group(s, c);
      if (!d.ok()) return d.error();
      effective[c] = *d;
    }
    return effective;
  }

  // --- configs ---

  Status check_configs() {
    for (const SubjectPtr& s : parts_.subjects) {
      if (s->code && s->code->stage == Stage::kLibrary) continue;
      auto effective = get_effective(*s);
      if (!effective.ok()) return effective.error();
      for (Category c : {Category::kShaderConfig, Category::kPipelineConfig}) {
        const DefinitionPtr& d = (*effective)[static_cast<size_t>(c)];
        const bool required = !s->hidden && (s->is_group() || is_entry(*s));
        if (!d && required) {
          Status missing = missing_config(*s, c);
          if (!tolerates(missing.error())) return missing;
        }
        if (!d) continue;
        DefinitionPtr& common = common_[static_cast<size_t>(c)];
        if (common && !same_definition(*common, *d)) return different_configs(*s, c, *common, *d);
        common = d;
      }
    }
    return {};
  }

  Status missing_config(const Subject& s, Category c) const {
    const auto is_category = [c](const DefinitionPtr& d) { return d->category == c; };
    std::vector<DefinitionPtr> candidates;
    for (const auto* list : {&parts_.own_scope.by_empty, &parts_.own_scope.implicit}) {
      std::copy_if(list->begin(), list->end(), std::back_inserter(candidates), is_category);
    }
    if (candidates.size() > 1) {
      return make_error(Id::kDefaultAmbiguous, describe(s), " has no ", category_name(c), ": ",
                        candidates[0]->where, " and ", candidates[1]->where,
                        " differ, so neither is the default; associate one of them explicitly");
    }
    return make_error(
        c == Category::kShaderConfig ? Id::kShaderConfigMissing : Id::kPipelineConfigMissing,
        describe(s), " has no ", category_name(c), " associated with it, explicitly or by default");
  }

  Status different_configs(const Subject& s, Category c, const Definition& a,
                           const Definition& b) const {
    if (c == Category::kShaderConfig) {
      return make_error(Id::kShaderConfigsDiffer, describe(s), " has a payload of ",
                        b.shader_config.MaxPayloadSizeInBytes, " and attributes of ",
                        b.shader_config.MaxAttributeSizeInBytes, " bytes (", b.where,
                        "), but another export has ", a.shader_config.MaxPayloadSizeInBytes,
                        " and ", a.shader_config.MaxAttributeSizeInBytes, " (", a.where,
                        "); all exports must have the same");
    }
    return make_error(Id::kPipelineConfigsDiffer, describe(s), " has recursion depth ",
                      b.pipeline_config.MaxTraceRecursionDepth, ", flags ",
                      hex(static_cast<uint32_t>(b.pipeline_config.Flags)), " (", b.where,
                      "), but another export has ", a.pipeline_config.MaxTraceRecursionDepth, ", ",
                      hex(static_cast<uint32_t>(a.pipeline_config.Flags)), " (", a.where,
                      "); all exports must have the same");
  }

  // --- records ---

  Status add_record(Subject& s) {
    auto effective = get_effective(s);
    if (!effective.ok()) return effective.error();
    // A record without a config is unresolved and has no identifier. [DXR: GetShaderIdentifier]
    for (Category c : {Category::kShaderConfig, Category::kPipelineConfig}) {
      if (!(*effective)[static_cast<size_t>(c)]) return missing_config(s, c);
    }
    auto record = std::make_unique<LinkedRecord>();
    record->name = s.name;
    if (s.is_group()) {
      record->kind = RecordKind::kHitGroup;
      record->hit_group_type = s.group.Type;
      if (Status st = link_members(s, *effective, *record); !st.ok()) return st;
    } else {
      record->kind = s.code->stage == Stage::kRayGeneration ? RecordKind::kRayGeneration
                     : s.code->stage == Stage::kMiss        ? RecordKind::kMiss
                                                            : RecordKind::kCallable;
      auto linked = link_shader(s, *effective, describe(s));
      if (!linked.ok()) return linked.error();
      record->shader = *linked;
    }
    record->local_root_signature = signature_of(*effective, Category::kLocalRootSignature);
    record->local_argument_bytes = record->local_root_signature.GetArgumentBytes();
    if (!s.identifier) s.identifier = parts_.device->make_identifier(s.name);
    record->identifier = *s.identifier;
    if (record->kind == RecordKind::kRayGeneration) {
      out_->global_root_signatures.push_back(
          signature_of(*effective, Category::kGlobalRootSignature));
    }
    add_names(s, record.get());
    linked_->identifiers.insert(record.get());
    linked_->records.push_back(std::move(record));
    return {};
  }

  void add_names(const Subject& s, const LinkedRecord* record) {
    auto add = [&](const std::string& name) {
      auto [it, is_new] = out_->records_by_name.emplace(name, record);
      if (!is_new) it->second = nullptr;
    };
    add(s.name);
    if (!s.mangled.empty() && s.mangled != s.name) add(s.mangled);
  }

  Status link_members(const Subject& group, const Effective& effective, LinkedRecord& record) {
    const LinkedShader** slots[3] = {&record.any_hit, &record.closest_hit, &record.intersection};
    const std::string* names[3] = {&group.group.AnyHitShaderImport,
                                   &group.group.ClosestHitShaderImport,
                                   &group.group.IntersectionShaderImport};
    for (size_t i = 0; i < 3; ++i) {
      if (!group.members[i]) {
        if (names[i]->empty()) continue;
        return make_error(Id::kHitGroupUnresolved, describe(group), " imports ",
                          in_quotes(*names[i]), ", which this state object does not export");
      }
      const Subject& member = *group.members[i];
      auto linked =
          link_shader(member, effective, concat(describe(member), " in ", describe(group)));
      if (!linked.ok()) return linked.error();
      *slots[i] = *linked;
    }
    return {};
  }

  Status check_sizes(const Subject& s, const Effective& effective, const std::string& where) const {
    const DefinitionPtr& d = effective[static_cast<size_t>(Category::kShaderConfig)];
    if (!d) return {};
    const RaytracingShaderConfig& config = d->shader_config;
    // [DXR: Payload access qualifiers, Payload size]
    const bool bounded = !(s.code->flags & shader::kExportQualifiedPayload);
    if (bounded && s.code->payload_bytes > config.MaxPayloadSizeInBytes) {
      return make_error(Id::kPayloadTooLarge, where, " has a payload of ", s.code->payload_bytes,
                        " bytes, but MaxPayloadSizeInBytes of ", d->where, " is ",
                        config.MaxPayloadSizeInBytes);
    }
    if (s.code->attribute_bytes > config.MaxAttributeSizeInBytes) {
      return make_error(Id::kAttributesTooLarge, where, " has attributes of ",
                        s.code->attribute_bytes, " bytes, but MaxAttributeSizeInBytes of ",
                        d->where, " is ", config.MaxAttributeSizeInBytes);
    }
    return {};
  }

  // [DXR: D3D12_LOCAL_ROOT_SIGNATURE] A library function may not have another root signature than
  // the shaders that call it. Defaults do not apply to functions.
  Status check_call_graph(const Subject& s, const Effective& effective,
                          const std::string& where) const {
    const shader::LibraryDesc* library = (s.written ? s.written_library : s.library).impl()->desc;
    const auto index = static_cast<uint32_t>((s.written ? s.written : s.code) - library->exports);
    const auto calls = [&](const SubjectPtr& f) {
      if (f->is_group() || f->code->stage != Stage::kLibrary) return false;
      const auto& linked = s.linked_functions;
      const bool is_linked = std::any_of(linked.begin(), linked.end(), [&](const SubjectPtr& one) {
        return one->code == f->code && one->name == f->name;
      });
      if (is_linked || f->library.impl()->desc != library) return is_linked;
      const uint32_t* callers = f->code->callable_indices;
      const uint32_t* end = callers + f->code->callable_index_count;
      return std::find(callers, end, index) != end;
    };
    for (const SubjectPtr& f : parts_.subjects) {
      if (!calls(f)) continue;
      for (Category c : {Category::kLocalRootSignature, Category::kGlobalRootSignature}) {
        const Associated& own = f->associations[static_cast<size_t>(c)];
        if (own.strength != Strength::kExplicit || !own.definition) continue;
        const DefinitionPtr& callers_own = effective[static_cast<size_t>(c)];
        if (callers_own && same_definition(*callers_own, *own.definition)) continue;
        return make_error(Id::kCallGraphSignatures, "function ", in_quotes(f->name), " has ",
                          category_name(c), " ", own.definition->where, ", but its caller ", where,
                          " has ", callers_own ? callers_own->where : "none",
                          "; a function must have the same as its callers, or none of its own");
      }
    }
    return {};
  }

  Result<const LinkedShader*> link_shader(const Subject& s, const Effective& effective,
                                          const std::string& where) {
    if (s.code->import_count != 0) {
      return make_error(Id::kFunctionUnresolved, where, " calls ",
                        in_quotes(s.library.impl()->desc->imports[s.code->imports[0]].signature),
                        ", which has no body");
    }
    if (Status st = check_sizes(s, effective, where); !st.ok()) return st.error();
    if (Status st = check_call_graph(s, effective, where); !st.ok()) return st.error();
    const RootSignature global = signature_of(effective, Category::kGlobalRootSignature);
    const RootSignature local = signature_of(effective, Category::kLocalRootSignature);
    const auto key = std::make_tuple(s.code, global.impl().get(), local.impl().get());
    if (auto it = cache_.find(key); it != cache_.end()) return it->second;
    if (Status st = check_root_signatures_disjoint(global, local, where); !st.ok())
      return st.error();
    if (Status st = check_shader_tier(*parts_.device, *s.code, where); !st.ok()) return st.error();
    const auto& library = *s.library.impl()->desc;
    auto slots = resolve_bindings(library, *s.code, global, local, where);
    if (!slots.ok()) return slots.error();
    auto linked = std::make_unique<LinkedShader>();
    linked->name = s.name;
    linked->stage = s.code->stage;
    linked->code = s.code;
    linked->library = &library;
    linked->slots = std::move(*slots);
    linked->local_argument_bytes = local.GetArgumentBytes();
    linked->stack_bytes = s.code->stack_bytes;
    linked->library_owner = s.library;
    linked->global_root_signature = global;
    linked->local_root_signature = local;
    const LinkedShader* raw = linked.get();
    linked_->shaders.push_back(std::move(linked));
    cache_[key] = raw;
    return raw;
  }

  // [DXR: Local root signatures vs global root signatures]
  Status check_static_samplers() const {
    std::map<std::pair<uint32_t, uint32_t>, const StaticSamplerDesc*> local_samplers;
    std::vector<const StaticSamplerDesc*> unique;
    std::set<const void*> seen;
    for (const auto& s : linked_->shaders) {
      for (const RootSignature* signature : {&s->local_root_signature, &s->global_root_signature}) {
        if (!*signature || !seen.insert(signature->impl().get()).second) continue;
        for (const StaticSamplerDesc& sampler : signature->GetDesc().StaticSamplers) {
          if (signature->is_local()) {
            auto [it, is_new] = local_samplers.emplace(
                std::pair(sampler.RegisterSpace, sampler.ShaderRegister), &sampler);
            if (!is_new && !same_sampler(*it->second, sampler)) {
              return make_error(
                  Id::kStaticSamplerConflict, "two local root signatures define static sampler ",
                  register_text(shader::RegisterClass::kSampler, sampler.ShaderRegister,
                                sampler.RegisterSpace),
                  " differently (one is for ", in_quotes(s->name), "); they must agree");
            }
          }
          const bool known = std::any_of(unique.begin(), unique.end(),
                                         [&](const auto* u) { return same_sampler(*u, sampler); });
          if (!known) unique.push_back(&sampler);
        }
      }
    }
    if (unique.size() <= kMaxStaticSamplers) return {};
    return make_error(Id::kStaticSamplerCount, "the state object has ", unique.size(),
                      " static samplers; at most ", kMaxStaticSamplers, " are allowed");
  }

  // --- the result ---

  Result<std::shared_ptr<StateObjectImpl>> finish(bool for_backend) {
    if (const auto& d = common_[static_cast<size_t>(Category::kShaderConfig)]) {
      linked_->max_payload_bytes = d->shader_config.MaxPayloadSizeInBytes;
      linked_->max_attribute_bytes = d->shader_config.MaxAttributeSizeInBytes;
    }
    if (const auto& d = common_[static_cast<size_t>(Category::kPipelineConfig)]) {
      linked_->max_recursion_depth = d->pipeline_config.MaxTraceRecursionDepth;
      linked_->flags = d->pipeline_config.Flags;
    }
    out_->linked = linked_;
    if (!parts_.is_collection()) out_->stack_bytes = default_stack_bytes(*linked_);
    if (for_backend && !parts_.is_collection()) {
      const auto printing = runtime::printing_libraries(*linked_);
      if (Status s = parts_.device->provide_prints(printing); !s.ok()) return s.error();
      auto pipeline = parts_.device->backend->create_raytracing_pipeline(out_->linked);
      if (!pipeline.ok()) return pipeline.error();
      out_->pipeline = std::move(*pipeline);
      if (parts_.device->checks) parts_.device->checks->created(*linked_);
    }
    for (const ExplicitAssociation& a : parts_.explicit_associations) {
      if (parts_.is_collection()) out_->outward_associations.push_back(a);
    }
    out_->subjects = std::move(parts_.subjects);
    return out_;
  }

  Parts parts_;
  std::shared_ptr<runtime::LinkedPipeline> linked_;
  std::shared_ptr<StateObjectImpl> out_;
  Effective common_;  // configs
  std::map<std::tuple<const void*, const void*, const void*>, const LinkedShader*> cache_;
};

}  // namespace

uint64_t default_stack_bytes(const runtime::LinkedPipeline& pipeline) {
  uint64_t raygen = 0, closest = 0, miss = 0, intersection = 0, any = 0, callable = 0;
  for (const auto& s : pipeline.shaders) {
    uint64_t* largest = nullptr;
    switch (s->stage) {
      case Stage::kRayGeneration:
        largest = &raygen;
        break;
      case Stage::kClosestHit:
        largest = &closest;
        break;
      case Stage::kMiss:
        largest = &miss;
        break;
      case Stage::kIntersection:
        largest = &intersection;
        break;
      case Stage::kAnyHit:
        largest = &any;
        break;
      case Stage::kCallable:
        largest = &callable;
        break;
      default:
        continue;
    }
    *largest = std::max(*largest, s->stack_bytes);
  }
  const uint64_t depth = pipeline.max_recursion_depth;
  return raygen + std::max({closest, miss, intersection + any}) * std::min<uint64_t>(1, depth) +
         std::max(closest, miss) * (depth > 0 ? depth - 1 : 0) + 2 * callable;
}

Result<std::shared_ptr<StateObjectImpl>> link_state_object(Parts&& parts, bool for_backend) {
  return Linker(std::move(parts)).run(for_backend);
}

}  // namespace rtapi::detail

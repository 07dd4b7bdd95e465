// SPDX-License-Identifier: MIT
//
// State objects while they are linked, and what is kept of them.
//
// Stages: state_object_parts.cpp gathers a description into Parts; link_functions.cpp links the
// libraries that call each other; associations.cpp gives every
// Subject its configs and root signatures; state_object_link.cpp resolves hit groups and bindings
// and makes records.
#pragma once

#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <rtapi/state_object.h>

#include "rtapi/src/device/device_impl.h"
#include "runtime/backend/linked_pipeline.h"

namespace rtapi::detail {

// The kinds of subobjects that can be associated with exports and have an effect; node masks and
// state object configs do not.
enum class Category : uint8_t {
  kShaderConfig,
  kPipelineConfig,
  kGlobalRootSignature,
  kLocalRootSignature,
};
inline constexpr size_t kCategories = 4;
const char* category_name(Category category);

// One config or root signature, as declared.
struct Definition {
  Category category = Category::kShaderConfig;
  RaytracingShaderConfig shader_config;
  RaytracingPipelineConfig1 pipeline_config;
  RootSignature root_signature;
  std::string where;  // for messages
};
using DefinitionPtr = std::shared_ptr<const Definition>;
bool same_definition(const Definition& a, const Definition& b);

enum class Strength : uint8_t { kNone, kDefault, kExplicit };
struct Associated {
  DefinitionPtr definition;
  Strength strength = Strength::kNone;
};
using Associations = std::array<Associated, kCategories>;

// An exported shader or a hit group.
struct Subject {
  std::string name;
  std::string mangled;                       // the other name of a shader that is not renamed
  const shader::ExportDesc* code = nullptr;  // null for a hit group
  ShaderLibrary library;
  int library_scope = -1;     // index into Parts::library_scopes
  int collection_scope = -1;  // where it comes from; -1: this state object
  bool hidden = false;        // in a collection that does not export it
  bool referable = true;      // hit groups outside its collection may import it
  Associations associations;
  // The library's own view of a shader whose code comes from several libraries, and the functions
  // of others that it can reach.
  const shader::ExportDesc* written = nullptr;
  ShaderLibrary written_library;
  std::vector<std::shared_ptr<Subject>> linked_functions;
  // Set by the collection or parent that resolved it already.
  std::optional<ShaderIdentifier> identifier;

  HitGroupDesc group;                               // for hit groups only
  std::array<std::shared_ptr<Subject>, 3> members;  // any-hit, closest-hit, intersection

  bool is_group() const { return code == nullptr; }
  bool answers_to(std::string_view wanted) const {
    return name == wanted || (!mangled.empty() && mangled == wanted);
  }
};
using SubjectPtr = std::shared_ptr<Subject>;

struct ExplicitAssociation {
  DefinitionPtr definition;
  std::vector<std::string> exports;
  int library_scope = -1;  // where it is declared; -1: in the state object itself
  std::string where;
};

// Candidates for the default associations of one scope. [DXR: Declaring a default association]
struct DefaultScope {
  std::vector<DefinitionPtr> implicit;  // in no association at all
  std::vector<DefinitionPtr> by_empty;  // associated with an empty export list
};

struct Parts {
  std::shared_ptr<DeviceImpl> device;
  StateObjectType type = StateObjectType::kRaytracingPipeline;
  StateObjectFlags flags = StateObjectFlags::kNone;
  std::vector<SubjectPtr> subjects;
  std::vector<ExplicitAssociation> explicit_associations;
  DefaultScope own_scope;
  std::vector<DefaultScope> library_scopes;
  std::vector<ShaderLibrary> libraries;  // one per library scope
  int collection_count = 0;

  bool is_collection() const { return type == StateObjectType::kCollection; }
  bool may_stay_unresolved() const {
    return is_collection() &&
           HasAny(flags, StateObjectFlags::kAllowLocalDependenciesOnExternalDefinitions);
  }
};

struct StateObjectImpl {
  std::shared_ptr<DeviceImpl> device;
  StateObjectType type = StateObjectType::kRaytracingPipeline;
  StateObjectFlags flags = StateObjectFlags::kNone;
  std::vector<SubjectPtr> subjects;
  // Explicit associations with exports outside the collection. They apply where the collection is
  // used.
  std::vector<ExplicitAssociation> outward_associations;
  std::shared_ptr<const runtime::LinkedPipeline> linked;  // in collections, what is resolved
  // The links of the parents that AddToStateObject extended to this state object: the identifiers
  // that they gave out point into them.
  std::vector<std::shared_ptr<const runtime::LinkedPipeline>> ancestors;
  std::shared_ptr<runtime::BackendPipeline> pipeline;  // pipelines only
  std::vector<RootSignature> global_root_signatures;   // of ray generation shaders
  std::atomic<uint64_t> stack_bytes{0};
  // Records by plain and mangled name; null where overloads share a plain name.
  std::map<std::string, const runtime::LinkedRecord*, std::less<>> records_by_name;

  const runtime::LinkedRecord* find_record(std::string_view name) const {
    auto it = records_by_name.find(name);
    return it == records_by_name.end() ? nullptr : it->second;
  }
};

Result<Parts> gather_parts(const std::shared_ptr<DeviceImpl>& device, const StateObjectDesc& desc);
// Finds the functions that shaders call in other libraries.
Status link_functions(Parts& parts);
Status associate_all(Parts& parts);
// Without `for_backend` nothing goes to the backend, as for collections and checks of additions.
Result<std::shared_ptr<StateObjectImpl>> link_state_object(Parts&& parts, bool for_backend);
// [DXR: Default pipeline stack size]
uint64_t default_stack_bytes(const runtime::LinkedPipeline& pipeline);

}  // namespace rtapi::detail

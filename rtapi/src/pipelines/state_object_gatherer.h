// SPDX-License-Identifier: MIT
//
// First stage of making a state object: checks each subobject by itself and sorts it into Parts.
// state_object_parts.cpp goes through the description; definitions.cpp checks configs, root
// signatures and hit groups; library_parts.cpp and collection_parts.cpp read libraries and
// collections.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "rtapi/src/pipelines/state_object_impl.h"

namespace rtapi::detail {

class Gatherer {
 public:
  Gatherer(const std::shared_ptr<DeviceImpl>& device, const StateObjectDesc& desc);
  Result<Parts> run();

 private:
  static std::string where_of(size_t index) { return concat("subobject ", index); }
  Status gather_configs();
  Status take_flags(StateObjectFlags value, const std::string& where,
                    std::optional<StateObjectFlags>& flags);

  // --- subobjects of the description ---

  Status gather(const StateObjectConfig&, size_t) { return {}; }  // see gather_configs
  Status gather(const NodeMask& mask, size_t i);
  Status gather(const GlobalRootSignature& sub, size_t i);
  Status gather(const LocalRootSignature& sub, size_t i);
  Status gather(const RaytracingShaderConfig& sub, size_t i);
  Status gather(const RaytracingPipelineConfig& sub, size_t i);
  Status gather(const RaytracingPipelineConfig1& sub, size_t i);
  Status gather(const HitGroupDesc& sub, size_t i) { return add_hit_group(sub, -1, where_of(i)); }
  Status gather(const SubobjectToExportsAssociation&, size_t) { return {}; }
  Status gather(const DxilSubobjectToExportsAssociation&, size_t) { return {}; }
  Status gather(const ExistingCollectionDesc& sub, size_t i);
  Status gather(const DxilLibraryDesc& sub, size_t i);

  // --- definitions ---

  Status define_root_signature(const RootSignature& signature, bool local, const std::string& where,
                               DefinitionPtr& out);
  Status define_shader_config(const RaytracingShaderConfig& config, const std::string& where,
                              DefinitionPtr& out);
  Status define_pipeline_config(const RaytracingPipelineConfig1& config, bool config1,
                                const std::string& where, DefinitionPtr& out);

  // --- libraries ---

  static bool is_listed(const DxilLibraryDesc& sub, const char* name);
  void add_shader(const shader::ExportDesc& code, const ShaderLibrary& library, int scope,
                  const std::string& renamed);
  Status gather_exports(const DxilLibraryDesc& sub, int scope, const std::string& where);
  static bool is_subobject(const shader::LibraryDesc& table, const std::string& name);
  static std::string list_exports(const shader::LibraryDesc& table);
  Status gather_library_subobjects(const DxilLibraryDesc& sub, int scope);
  Status define_from_text(const char* text, bool local, const std::string& where,
                          DefinitionPtr& out);
  Status add_hit_group(const HitGroupDesc& group, int scope, const std::string& where);

  // --- collections ---

  Status import_collection(const StateObjectImpl& collection,
                           const std::vector<ExportDesc>& exports, const std::string& where);
  // An export list makes the listed exports visible, under a new name where it gives one.
  Status list_collection_exports(const StateObjectImpl& collection,
                                 std::map<const Subject*, SubjectPtr>& copies,
                                 const std::vector<ExportDesc>& exports, const std::string& where);

  // --- associations ---

  Status gather_association(const StateSubobject& sub, size_t i);
  DefinitionPtr find_in_libraries(const std::string& name) const;
  void associate(const DefinitionPtr& definition, const std::vector<std::string>& exports,
                 int scope, const std::string& where);
  DefaultScope& scope_at(int scope);
  void gather_defaults();

  // --- names ---

  Status check_names();
  std::string origin(const Subject& s) const;

  struct LibraryAssociation {
    int scope;
    std::string subobject;
    std::vector<std::string> exports;
    std::string where;
  };

  const StateObjectDesc& desc_;
  Parts parts_;
  std::vector<DefinitionPtr> definitions_;  // by subobject index
  std::vector<std::map<std::string, DefinitionPtr>> library_definitions_;
  std::vector<LibraryAssociation> library_associations_;
  std::set<const Definition*> associated_;
};

}  // namespace rtapi::detail

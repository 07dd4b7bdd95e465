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
  Result<Parts> Run();

 private:
  static std::string Where(size_t index) { return Text("subobject ", index); }
  Status GatherConfigs();
  Status TakeFlags(StateObjectFlags value, const std::string& where,
                   std::optional<StateObjectFlags>& flags);

  // --- subobjects of the description ---

  Status Gather(const StateObjectConfig&, size_t) { return {}; }  // see GatherConfigs
  Status Gather(const NodeMask& mask, size_t i);
  Status Gather(const GlobalRootSignature& sub, size_t i);
  Status Gather(const LocalRootSignature& sub, size_t i);
  Status Gather(const RaytracingShaderConfig& sub, size_t i);
  Status Gather(const RaytracingPipelineConfig& sub, size_t i);
  Status Gather(const RaytracingPipelineConfig1& sub, size_t i);
  Status Gather(const HitGroupDesc& sub, size_t i) { return AddHitGroup(sub, -1, Where(i)); }
  Status Gather(const SubobjectToExportsAssociation&, size_t) { return {}; }
  Status Gather(const DxilSubobjectToExportsAssociation&, size_t) { return {}; }
  Status Gather(const ExistingCollectionDesc& sub, size_t i);
  Status Gather(const DxilLibraryDesc& sub, size_t i);

  // --- definitions ---

  Status DefineRootSignature(const RootSignature& signature, bool local, const std::string& where,
                             DefinitionPtr& out);
  Status DefineShaderConfig(const RaytracingShaderConfig& config, const std::string& where,
                            DefinitionPtr& out);
  Status DefinePipelineConfig(const RaytracingPipelineConfig1& config, bool config1,
                              const std::string& where, DefinitionPtr& out);

  // --- libraries ---

  static bool IsListed(const DxilLibraryDesc& sub, const char* name);
  void AddShader(const shader::ExportDesc& code, const ShaderLibrary& library, int scope,
                 const std::string& renamed);
  Status GatherExports(const DxilLibraryDesc& sub, int scope, const std::string& where);
  static bool IsSubobject(const shader::LibraryDesc& table, const std::string& name);
  static std::string ListExports(const shader::LibraryDesc& table);
  Status GatherLibrarySubobjects(const DxilLibraryDesc& sub, int scope);
  Status DefineFromText(const char* text, bool local, const std::string& where, DefinitionPtr& out);
  Status AddHitGroup(const HitGroupDesc& group, int scope, const std::string& where);

  // --- collections ---

  Status ImportCollection(const StateObjectImpl& collection, const std::vector<ExportDesc>& exports,
                          const std::string& where);
  // An export list makes the listed exports visible, under a new name where it gives one.
  Status ListCollectionExports(const StateObjectImpl& collection,
                               std::map<const Subject*, SubjectPtr>& copies,
                               const std::vector<ExportDesc>& exports, const std::string& where);

  // --- associations ---

  Status GatherAssociation(const StateSubobject& sub, size_t i);
  DefinitionPtr FindInLibraries(const std::string& name) const;
  void Associate(const DefinitionPtr& definition, const std::vector<std::string>& exports,
                 int scope, const std::string& where);
  DefaultScope& ScopeAt(int scope);
  void GatherDefaults();

  // --- names ---

  Status CheckNames();
  std::string Origin(const Subject& s) const;

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

// SPDX-License-Identifier: MIT
//
// Ray tracing state objects: collections and pipelines made of subobjects.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <rtapi/result.h>
#include <rtapi/root_signature.h>
#include <rtapi/shader_library.h>
#include <rtapi/types.h>

namespace rtapi {

namespace detail {
struct StateObjectImpl;
}

class StateObject;

enum class StateObjectType : uint32_t { kCollection = 0, kRaytracingPipeline = 3 };

enum class StateSubobjectType : uint32_t {
  kStateObjectConfig = 0,
  kGlobalRootSignature = 1,
  kLocalRootSignature = 2,
  kNodeMask = 3,
  kDxilLibrary = 5,
  kExistingCollection = 6,
  kSubobjectToExportsAssociation = 7,
  kDxilSubobjectToExportsAssociation = 8,
  kRaytracingShaderConfig = 9,
  kRaytracingPipelineConfig = 10,
  kHitGroup = 11,
  kRaytracingPipelineConfig1 = 12,
};

enum class StateObjectFlags : uint32_t {
  kNone = 0,
  kAllowLocalDependenciesOnExternalDefinitions = 0x1,
  kAllowExternalDependenciesOnLocalDefinitions = 0x2,
  kAllowStateObjectAdditions = 0x4,
};
template <>
inline constexpr bool kIsFlags<StateObjectFlags> = true;

enum class HitGroupType : uint32_t { kTriangles = 0, kProceduralPrimitive = 1 };

enum class RaytracingPipelineFlags : uint32_t {
  kNone = 0,
  kSkipTriangles = 0x100,
  kSkipProceduralPrimitives = 0x200,
};
template <>
inline constexpr bool kIsFlags<RaytracingPipelineFlags> = true;

// ---------------------------------------------------------------------------------------------
// Subobjects

struct StateObjectConfig {
  StateObjectFlags Flags = StateObjectFlags::kNone;
};
struct GlobalRootSignature {
  RootSignature pGlobalRootSignature = {};
};
struct LocalRootSignature {
  RootSignature pLocalRootSignature = {};
};
struct NodeMask {
  uint32_t Mask = 1;  // accepted; there is one node
};

struct ExportDesc {
  std::string Name = {};            // what the state object calls it
  std::string ExportToRename = {};  // the library's (plain or mangled) name; empty: Name
};
struct DxilLibraryDesc {
  ShaderLibrary DXILLibrary = {};
  std::vector<ExportDesc> Exports = {};  // empty: everything
};
struct ExistingCollectionDesc {
  std::shared_ptr<StateObject> pExistingCollection = {};
  std::vector<ExportDesc> Exports = {};  // empty: everything
  // The usual way to write one.
  static ExistingCollectionDesc Of(const StateObject& collection,
                                   std::vector<ExportDesc> exports = {});
};

struct SubobjectToExportsAssociation {
  uint32_t SubobjectToAssociate = 0;      // index into StateObjectDesc::Subobjects
  std::vector<std::string> Exports = {};  // empty: a default association
};
struct DxilSubobjectToExportsAssociation {
  std::string SubobjectToAssociate = {};  // its name in a library
  std::vector<std::string> Exports = {};
};

struct RaytracingShaderConfig {
  uint32_t MaxPayloadSizeInBytes = 0;    // each scalar counts 4 bytes
  uint32_t MaxAttributeSizeInBytes = 8;  // at most 32
};
struct RaytracingPipelineConfig {
  uint32_t MaxTraceRecursionDepth = 1;  // 0 .. 31
};
struct RaytracingPipelineConfig1 {
  uint32_t MaxTraceRecursionDepth = 1;
  RaytracingPipelineFlags Flags = RaytracingPipelineFlags::kNone;
};

struct HitGroupDesc {
  std::string HitGroupExport = {};
  HitGroupType Type = HitGroupType::kTriangles;
  std::string AnyHitShaderImport = {};        // empty: none
  std::string ClosestHitShaderImport = {};    // empty: none
  std::string IntersectionShaderImport = {};  // procedural groups: required
};

using StateSubobject =
    std::variant<StateObjectConfig, GlobalRootSignature, LocalRootSignature, NodeMask,
                 DxilLibraryDesc, ExistingCollectionDesc, SubobjectToExportsAssociation,
                 DxilSubobjectToExportsAssociation, RaytracingShaderConfig,
                 RaytracingPipelineConfig, HitGroupDesc, RaytracingPipelineConfig1>;

StateSubobjectType GetSubobjectType(const StateSubobject& subobject);

struct StateObjectDesc {
  StateObjectType Type = StateObjectType::kRaytracingPipeline;
  std::vector<StateSubobject> Subobjects = {};

  // Appends and returns the index, for associations.
  uint32_t Add(StateSubobject subobject) {
    Subobjects.push_back(std::move(subobject));
    return static_cast<uint32_t>(Subobjects.size() - 1);
  }
  void Associate(uint32_t subobject, std::vector<std::string> exports) {
    Subobjects.push_back(SubobjectToExportsAssociation{subobject, std::move(exports)});
  }
};

// ---------------------------------------------------------------------------------------------
// State objects

using ShaderIdentifier = std::array<uint8_t, kShaderIdentifierSizeInBytes>;

// What GetShaderStackSize returns for a name it does not know. [DXR: GetShaderStackSize]
inline constexpr uint64_t kNoShaderStackSize = 0xFFFFFFFFu;

// With ID3D12StateObjectProperties' methods.
class StateObject {
 public:
  StateObject() = default;
  explicit StateObject(std::shared_ptr<detail::StateObjectImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const StateObject&) const = default;

  StateObjectType GetType() const;

  // Ray generation, miss, callable shaders and hit groups; null for every other name. Lives as long
  // as the state object. [DXR: GetShaderIdentifier]
  const ShaderIdentifier* GetShaderIdentifier(std::string_view export_name) const;

  // Bytes. Inside a hit group: "group::intersection", "group::anyhit", "group::closesthit".
  uint64_t GetShaderStackSize(std::string_view export_name) const;
  uint64_t GetPipelineStackSize() const;  // collections: 0
  // 0xFFFFFFFF and above, and any call on a collection, is an error and changes nothing.
  Status SetPipelineStackSize(uint64_t stack_size_bytes);

  // Local root signature of what an identifier names (hit groups: of its shaders); empty if none.
  RootSignature GetLocalRootSignature(std::string_view export_name) const;
  // Every name that GetShaderIdentifier knows.
  std::vector<std::string> GetIdentifiableExports() const;

  const std::shared_ptr<detail::StateObjectImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::StateObjectImpl> impl_;
};

inline ExistingCollectionDesc ExistingCollectionDesc::Of(const StateObject& collection,
                                                         std::vector<ExportDesc> exports) {
  return {std::make_shared<StateObject>(collection), std::move(exports)};
}

}  // namespace rtapi

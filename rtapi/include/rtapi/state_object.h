// SPDX-License-Identifier: MIT
/// @file
/// Ray tracing state objects: collections and pipelines made of subobjects.
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

/// A part of pipelines, or a pipeline. [DXR: State object types]
enum class StateObjectType : uint32_t { kCollection = 0, kRaytracingPipeline = 3 };

/// The kind of a subobject, see GetSubobjectType. [D3D12: D3D12_STATE_SUBOBJECT_TYPE]
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

/// Flags that say what state objects may have to do with each other. Undefined bits: KA0539.
/// [DXR: D3D12_STATE_OBJECT_FLAGS]
enum class StateObjectFlags : uint32_t {
  kNone = 0,
  /// A collection may leave references open until a pipeline includes it. Ignored in pipelines.
  kAllowLocalDependenciesOnExternalDefinitions = 0x1,
  /// Others may refer to a collection's functions (KA0525), and its associations reach outside.
  /// Ignored in pipelines.
  kAllowExternalDependenciesOnLocalDefinitions = 0x2,
  /// A pipeline may be the parent of AddToStateObject; such a pipeline includes only collections
  /// that have the flag too (KA0526).
  kAllowStateObjectAdditions = 0x4,
};
template <>
inline constexpr bool kIsFlags<StateObjectFlags> = true;

/// The kind of geometry that a hit group is for; it must go with the geometry that reaches its
/// record (checked mode: KA0434). [DXR: D3D12_HIT_GROUP_TYPE]
enum class HitGroupType : uint32_t { kTriangles = 0, kProceduralPrimitive = 1 };

/// Ray flags that are added to those of every TraceRay of a pipeline, at most one of the two
/// (KA0539): RayFlags() does not show them, and RayQuery does not have them. And what its rays may
/// meet.
/// [DXR: D3D12_RAYTRACING_PIPELINE_FLAGS]
enum class RaytracingPipelineFlags : uint32_t {
  kNone = 0,
  kSkipTriangles = 0x100,
  kSkipProceduralPrimitives = 0x200,
  kAllowOpacityMicromaps = 0x400,  ///< rays use opacity micromaps; tier 1.2 (KA0539)
  /// EXPERIMENTAL: rays may meet clusters; where DeviceDesc::IndirectRtasOperations asks for them
  /// (KA0539).
  kAllowClusteredGeometry = 0x800,
};
template <>
inline constexpr bool kIsFlags<RaytracingPipelineFlags> = true;

// ---------------------------------------------------------------------------------------------
// Subobjects

/// Flags of the state object; several that are not equal: KA0509. [DXR: D3D12_STATE_OBJECT_CONFIG]
struct StateObjectConfig {
  StateObjectFlags Flags = StateObjectFlags::kNone;  ///< of this state object only
};
/// The root arguments of the command list that shaders use. [DXR: D3D12_GLOBAL_ROOT_SIGNATURE]
struct GlobalRootSignature {
  RootSignature pGlobalRootSignature = {};  ///< created without kLocalRootSignature (KA0536)
};
/// The arguments in shader records that shaders use. No register of a shader's local signature may
/// be in its global one (KA0527). [DXR: D3D12_LOCAL_ROOT_SIGNATURE]
struct LocalRootSignature {
  RootSignature pLocalRootSignature = {};  ///< created with kLocalRootSignature (KA0536)
};
/// Tells which of several nodes a state object is for. [DXR: D3D12_NODE_MASK]
struct NodeMask {
  uint32_t Mask = 1;  ///< 0 or 1: there is one node (KA0500)
};

/// An export that is taken, under its own or another name. [DXR: D3D12_EXPORT_DESC]
struct ExportDesc {
  std::string Name = {};            ///< what the state object calls it; not empty (KA0506)
  std::string ExportToRename = {};  ///< the library's plain or mangled name; empty: Name
};
/// Shaders and subobjects of a library that was compiled for lib_6_3 or later (KA0502).
/// [DXR: D3D12_DXIL_LIBRARY_DESC]
struct DxilLibraryDesc {
  ShaderLibrary DXILLibrary = {};        ///< kept alive by the state object
  std::vector<ExportDesc> Exports = {};  ///< empty: everything, subobjects written in HLSL too
};
/// Exports of a collection; for pipelines only (KA0501). [DXR: D3D12_EXISTING_COLLECTION_DESC]
struct ExistingCollectionDesc {
  std::shared_ptr<StateObject> pExistingCollection = {};  ///< of the same device
  std::vector<ExportDesc> Exports = {};                   ///< empty: everything
  /// The usual way to write one. The collection's handle is copied.
  static ExistingCollectionDesc Of(const StateObject& collection,
                                   std::vector<ExportDesc> exports = {});
};

/// Gives exports a config or root signature. One by name beats a default; two that differ for one
/// export: KA0509. [DXR: D3D12_SUBOBJECT_TO_EXPORTS_ASSOCIATION; Subobject association behavior]
struct SubobjectToExportsAssociation {
  /// Index in StateObjectDesc::Subobjects of a config or root signature (KA0508).
  uint32_t SubobjectToAssociate = 0;
  /// Names of exports, in pipelines existing ones (KA0507); empty: the default for all of them.
  std::vector<std::string> Exports = {};
};
/// The same for a subobject written in HLSL.
/// [DXR: D3D12_DXIL_SUBOBJECT_TO_EXPORTS_ASSOCIATION]
struct DxilSubobjectToExportsAssociation {
  std::string SubobjectToAssociate = {};  ///< its name in an included library (KA0508)
  std::vector<std::string> Exports = {};  ///< as in SubobjectToExportsAssociation
};

/// Sizes of what rays carry. Required, and the same for all exports of a state object (KA0511,
/// KA0513). [DXR: D3D12_RAYTRACING_SHADER_CONFIG]
struct RaytracingShaderConfig {
  /// At least that of every payload, where each scalar counts as 4 bytes (KA0522). Payloads with
  /// access qualifiers do not count from lib_6_7 on; callable data never does.
  uint32_t MaxPayloadSizeInBytes = 0;
  /// At least those of every shader (KA0523), at most 32 (KA0521). Triangles have 8.
  uint32_t MaxAttributeSizeInBytes = 8;
};
/// Limits how deep rays nest. Required, and the same for all exports of a state object (KA0512,
/// KA0514). [DXR: D3D12_RAYTRACING_PIPELINE_CONFIG]
struct RaytracingPipelineConfig {
  /// 0 to 31 (KA0519). 1: only ray generation shaders trace; 0: nobody does. A deeper TraceRay
  /// removes the device (KA0890). [DXR: Ray recursion limit]
  uint32_t MaxTraceRecursionDepth = 1;
};
/// The same with flags; needs tier 1.1 (KA0520). [DXR: D3D12_RAYTRACING_PIPELINE_CONFIG1]
struct RaytracingPipelineConfig1 {
  uint32_t MaxTraceRecursionDepth = 1;  ///< as in RaytracingPipelineConfig
  RaytracingPipelineFlags Flags = RaytracingPipelineFlags::kNone;  ///< for every TraceRay
};

/// Shaders that share one record and its local arguments. A triangle group has no intersection
/// shader, a procedural one needs it (KA0516); any-hit and closest-hit shaders may be missing.
/// [DXR: D3D12_HIT_GROUP_DESC]
struct HitGroupDesc {
  std::string HitGroupExport = {};               ///< the group's name; not empty (KA0506)
  HitGroupType Type = HitGroupType::kTriangles;  ///< which geometry it is for
  std::string AnyHitShaderImport = {};           ///< an export (KA0517, KA0518); empty: none
  std::string ClosestHitShaderImport = {};       ///< an export (KA0517, KA0518); empty: none
  std::string IntersectionShaderImport = {};     ///< an export (KA0517, KA0518); empty: none
};

/// Any of the subobjects above. [D3D12: D3D12_STATE_SUBOBJECT]
using StateSubobject =
    std::variant<StateObjectConfig, GlobalRootSignature, LocalRootSignature, NodeMask,
                 DxilLibraryDesc, ExistingCollectionDesc, SubobjectToExportsAssociation,
                 DxilSubobjectToExportsAssociation, RaytracingShaderConfig,
                 RaytracingPipelineConfig, HitGroupDesc, RaytracingPipelineConfig1>;

/// D3D12's number for the kind of a subobject.
StateSubobjectType GetSubobjectType(const StateSubobject& subobject);

/// Describes what a state object is made of. [D3D12: D3D12_STATE_OBJECT_DESC]
struct StateObjectDesc {
  StateObjectType Type = StateObjectType::kRaytracingPipeline;  ///< collection or pipeline
  /// In any order. A config or root signature that no association names is the default for all
  /// exports. [DXR: Declaring a default association]
  std::vector<StateSubobject> Subobjects = {};

  /// Appends a subobject and returns its index, for associations.
  uint32_t Add(StateSubobject subobject);
  /// Appends an association of the subobject with this index and the exports of these names; none:
  /// it becomes the default.
  void Associate(uint32_t subobject, std::vector<std::string> exports);
};

// ---------------------------------------------------------------------------------------------
// State objects

/// The start of a shader record: 32 opaque bytes. All zero is NULL: nothing runs.
/// [DXR: Shader identifier]
using ShaderIdentifier = std::array<uint8_t, kShaderIdentifierSizeInBytes>;

/// The value that GetShaderStackSize returns for a name it does not know. [DXR: GetShaderStackSize]
inline constexpr uint64_t kNoShaderStackSize = 0xFFFFFFFFu;

/// A collection or a ray tracing pipeline, with ID3D12StateObjectProperties' methods. A copyable
/// handle, thread-safe; it keeps its libraries and root signatures alive, and lists keep it alive
/// until they are reset. [D3D12: ID3D12StateObject, ID3D12StateObjectProperties]
class StateObject {
 public:
  /// An empty handle, or one that the library makes. A handle is false when it is empty, and two
  /// are equal if they name the same object.
  ///@{
  StateObject() = default;
  explicit StateObject(std::shared_ptr<detail::StateObjectImpl> impl) : impl_(std::move(impl)) {}
  explicit operator bool() const { return impl_ != nullptr; }
  bool operator==(const StateObject&) const = default;
  ///@}

  /// Collection or pipeline; an empty handle says pipeline.
  StateObjectType GetType() const;

  /// The identifier of a ray generation, miss or callable shader or of a hit group, by its plain or
  /// mangled name; null for every other name, for exports that are not resolved yet, and for a
  /// plain name that several exports have. The pointer is valid as long as the state object, or one
  /// that AddToStateObject has made from it; the bytes may be copied into any number of records. A
  /// collection's export has the same identifier in every pipeline that includes it. [DXR:
  /// GetShaderIdentifier]
  const ShaderIdentifier* GetShaderIdentifier(std::string_view export_name) const;

  /// Stack of one invocation of a shader, in bytes. Inside a hit group: "group::intersection",
  /// "group::anyhit", "group::closesthit", case-sensitive. kNoShaderStackSize for any other name.
  /// [DXR: GetShaderStackSize]
  uint64_t GetShaderStackSize(std::string_view export_name) const;
  /// Stack of one thread of a dispatch, in bytes: what SetPipelineStackSize set last, else what
  /// DXR's formula gives of the shaders' sizes and the recursion depth. 0 for a collection.
  /// [DXR: GetPipelineStackSize; Default pipeline stack size]
  uint64_t GetPipelineStackSize() const;
  /// Sets the stack of one thread for dispatches that are recorded from now on. Needed where
  /// callables nest more than two deep; a thread that needs more removes the device (KA0891).
  /// Vulkan devices enforce only the ray generation shader's share. [DXR: SetPipelineStackSize]
  /// @errors KA0904 empty handle; KA0532 0xFFFFFFFF bytes or more, or a collection. Nothing changes
  /// then.
  Status SetPipelineStackSize(uint64_t stack_size_bytes);

  /// The local root signature of what an identifier names (of a hit group: of its shaders), by
  /// which its record is laid out; empty if it has none, and for unknown names.
  RootSignature GetLocalRootSignature(std::string_view export_name) const;
  /// Every name that GetShaderIdentifier knows, without mangled ones.
  std::vector<std::string> GetIdentifiableExports() const;

  /// For the library itself.
  const std::shared_ptr<detail::StateObjectImpl>& impl() const { return impl_; }

 private:
  std::shared_ptr<detail::StateObjectImpl> impl_;
};

}  // namespace rtapi

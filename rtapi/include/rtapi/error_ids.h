// SPDX-License-Identifier: MIT
/// @file
/// The ids of rtapi/ERRORS.md by name, for programs that look for one:
/// `status.error().id == rtapi::error_ids::backend::kOutOfMemory`. `kaamos-errors --header`
/// (tests/errors) makes this header from the tables that the sources are compiled from.
#pragma once

#include <rtapi/result.h>

/// A name for each id, a namespace for each part of the library.
namespace rtapi::error_ids {

// clang-format off

/// Section "Checked mode" of rtapi/ERRORS.md.
namespace checked {
inline constexpr ErrorId kMoreFindings{400};  ///< more findings
inline constexpr ErrorId kRayNotANumber{401};  ///< NaN in a ray
inline constexpr ErrorId kRayInterval{402};  ///< ray with TMin \< 0 or TMin > TMax
inline constexpr ErrorId kRayFlags{403};  ///< illegal ray flags
inline constexpr ErrorId kQueryFlags{404};  ///< illegal ray flags of a RayQuery
inline constexpr ErrorId kRecursionDepth{405};  ///< TraceRay exceeds the declared recursion depth
inline constexpr ErrorId kHitKind{406};  ///< hit kind out of range
inline constexpr ErrorId kPayloadMismatch{407};  ///< payload type mismatch
inline constexpr ErrorId kCallableMismatch{408};  ///< callable data type mismatch
inline constexpr ErrorId kQueryNoCandidate{409};  ///< RayQuery has no such candidate
inline constexpr ErrorId kQueryNoHit{410};  ///< hit data read without a hit
inline constexpr ErrorId kCommitOutOfRange{411};  ///< procedural hit committed out of range
inline constexpr ErrorId kAttributeMismatch{412};  ///< attribute type mismatch
inline constexpr ErrorId kNoTriangle{413};  ///< positions of what is no triangle
inline constexpr ErrorId kNoDataAccess{414};  ///< positions of a bottom level that does not allow it
inline constexpr ErrorId kDebugBreak{415};  ///< DebugBreak without a debugger
inline constexpr ErrorId kRootAccessOutOfBounds{417};  ///< root descriptor out of bounds
inline constexpr ErrorId kMisalignedAccess{418};  ///< misaligned access
inline constexpr ErrorId kRootAddress{419};  ///< root descriptor does not point to a buffer
inline constexpr ErrorId kOutsideBinding{420};  ///< index past the end of a binding
inline constexpr ErrorId kOutsideHeap{421};  ///< descriptor outside the heap
inline constexpr ErrorId kWrongDescriptor{422};  ///< descriptor of the wrong kind
inline constexpr ErrorId kCodeNotChecked{423};  ///< shader code is not checked
inline constexpr ErrorId kCodeInterpreted{424};  ///< shader code is interpreted
inline constexpr ErrorId kStaleView{425};  ///< descriptor of a freed resource
inline constexpr ErrorId kRecordOutOfTable{430};  ///< record outside its shader table
inline constexpr ErrorId kRecordUnknownIdentifier{431};  ///< record holds no shader identifier
inline constexpr ErrorId kRecordForeignIdentifier{432};  ///< identifier of another state object
inline constexpr ErrorId kRecordWrongKind{433};  ///< wrong kind of shader in a shader table
inline constexpr ErrorId kRecordWrongGroupType{434};  ///< hit group for the wrong geometry type
inline constexpr ErrorId kRecordStride{435};  ///< stride too small for the records
inline constexpr ErrorId kRecordNeverWritten{436};  ///< local root arguments never written
inline constexpr ErrorId kRecordArgument{437};  ///< invalid local root argument
inline constexpr ErrorId kRecordArgumentKind{438};  ///< local root argument of the wrong kind
inline constexpr ErrorId kRootSignatureReached{439};  ///< shader with another global root signature
inline constexpr ErrorId kRecordTooShort{440};  ///< shader table ends inside a record
inline constexpr ErrorId kTableWritten{441};  ///< shader table changed while it was used
inline constexpr ErrorId kRecordNotReached{442};  ///< missing records that were not reached
inline constexpr ErrorId kTargetFormat{443};  ///< target of another format than the pipeline's
inline constexpr ErrorId kDepthNotBound{444};  ///< depth test without a depth buffer
inline constexpr ErrorId kReadOnlyDepth{445};  ///< depth writes through a read-only view
inline constexpr ErrorId kTargetSizes{446};  ///< targets of different sizes
inline constexpr ErrorId kDrawRectangles{447};  ///< viewport or scissor rectangle shows nothing
inline constexpr ErrorId kVertexOutOfBounds{448};  ///< vertex outside its buffer
inline constexpr ErrorId kIndexOutOfBounds{449};  ///< index outside the index buffer
inline constexpr ErrorId kUavBarrierMissing{450};  ///< UAV barrier missing
inline constexpr ErrorId kResourceState{451};  ///< resource in the wrong state
inline constexpr ErrorId kTransitionBefore{452};  ///< wrong StateBefore in a barrier
inline constexpr ErrorId kVertexSlotUnbound{453};  ///< vertex buffer not set
inline constexpr ErrorId kVertexLayout{454};  ///< vertex data misaligned
inline constexpr ErrorId kStripCut{455};  ///< strip cut that does not fit
inline constexpr ErrorId kPositionNotFinite{456};  ///< NaN or infinity in SV_Position
inline constexpr ErrorId kPositionFarAway{457};  ///< position too far away
inline constexpr ErrorId kNothingDrawn{458};  ///< draw of which nothing arrives
inline constexpr ErrorId kClearDepth{459};  ///< depth cleared to what nothing passes
inline constexpr ErrorId kStructureMissing{460};  ///< no acceleration structure at this address
inline constexpr ErrorId kStructureOverwritten{461};  ///< acceleration structure overwritten
inline constexpr ErrorId kStructureFreed{462};  ///< acceleration structure freed
inline constexpr ErrorId kStructureStale{463};  ///< top level is stale
inline constexpr ErrorId kStructureLevel{464};  ///< acceleration structure of the wrong level
inline constexpr ErrorId kStructureBytesCopied{465};  ///< acceleration structure copied as bytes
inline constexpr ErrorId kUpdateChanges{470};  ///< update changes more than allowed
inline constexpr ErrorId kMemoryOverlap{471};  ///< memory ranges overlap
inline constexpr ErrorId kIndexOutOfRange{472};  ///< index past the vertices
inline constexpr ErrorId kVertexNotANumber{473};  ///< NaN in a vertex or box
inline constexpr ErrorId kInstanceFlags{474};  ///< contradictory instance flags
inline constexpr ErrorId kInstanceStructure{476};  ///< instance does not point to a bottom level
inline constexpr ErrorId kClearValueDiffers{477};  ///< clear with another value than the optimized one
inline constexpr ErrorId kDivergentDerivative{478};  ///< derivative where pixels of a quad differ
inline constexpr ErrorId kOutputNotANumber{479};  ///< NaN or infinity from a pixel shader
inline constexpr ErrorId kEarlyDepth{482};  ///< [earlydepthstencil] ignores a part of the shader
inline constexpr ErrorId kRootArgumentUnset{483};  ///< root argument of a draw not set
inline constexpr ErrorId kTargetNeverWritten{484};  ///< target read before it was written
inline constexpr ErrorId kIndirectCount{485};  ///< more indirect commands than MaxCommandCount
inline constexpr ErrorId kIndirectArguments{486};  ///< absurd arguments of an indirect draw
inline constexpr ErrorId kTargetStateChanged{487};  ///< bound target changed its state
inline constexpr ErrorId kUploadOverwritten{488};  ///< upload buffer overwritten too early
inline constexpr ErrorId kTargetRead{489};  ///< target read by the draw that writes it
inline constexpr ErrorId kNothingVisible{490};  ///< draw that cannot be seen
inline constexpr ErrorId kVertexStride{491};  ///< stride 0 for several vertices
inline constexpr ErrorId kStructureAliased{492};  ///< acceleration structures over other resources
inline constexpr ErrorId kMicromapsNotAllowed{493};  ///< opacity micromaps without permission
inline constexpr ErrorId kMicromapsDisabled{494};  ///< DISABLE_OMMS of a bottom level that does not allow it
inline constexpr ErrorId kMicromapsReplaced{495};  ///< opacity micromap array is not what was linked
inline constexpr ErrorId kClustersNotAllowed{496};  ///< clusters without permission
}  // namespace checked

/// Section "API" of rtapi/ERRORS.md.
namespace api {
inline constexpr ErrorId kStateObjectInvalidSubobject{500};  ///< invalid subobject
inline constexpr ErrorId kCollectionNested{501};  ///< collection inside a collection
inline constexpr ErrorId kLibraryTarget{502};  ///< shader library target cannot be used
inline constexpr ErrorId kExportNotFound{503};  ///< export not found
inline constexpr ErrorId kExportDuplicate{504};  ///< duplicate export
inline constexpr ErrorId kExportAmbiguous{505};  ///< ambiguous export name
inline constexpr ErrorId kExportUnnamed{506};  ///< export without a name
inline constexpr ErrorId kAssociationUnknownExport{507};  ///< association with an unknown export
inline constexpr ErrorId kAssociationBadSubobject{508};  ///< subobject cannot be associated
inline constexpr ErrorId kAssociationConflict{509};  ///< conflicting associations
inline constexpr ErrorId kHitGroupAssociationMismatch{510};  ///< hit group associations disagree
inline constexpr ErrorId kShaderConfigMissing{511};  ///< no ray tracing shader config
inline constexpr ErrorId kPipelineConfigMissing{512};  ///< no ray tracing pipeline config
inline constexpr ErrorId kShaderConfigsDiffer{513};  ///< different shader configs
inline constexpr ErrorId kPipelineConfigsDiffer{514};  ///< different pipeline configs
inline constexpr ErrorId kDefaultAmbiguous{515};  ///< default association is ambiguous
inline constexpr ErrorId kHitGroupShape{516};  ///< hit group has the wrong kind of shaders
inline constexpr ErrorId kHitGroupStage{517};  ///< hit group imports a shader of another stage
inline constexpr ErrorId kHitGroupUnresolved{518};  ///< hit group import not found
inline constexpr ErrorId kRecursionDepth{519};  ///< MaxTraceRecursionDepth out of range
inline constexpr ErrorId kPipelineConfig1Tier{520};  ///< pipeline config 1 needs tier 1.1
inline constexpr ErrorId kAttributeSizeLimit{521};  ///< MaxAttributeSizeInBytes out of range
inline constexpr ErrorId kPayloadTooLarge{522};  ///< payload larger than the shader config allows
inline constexpr ErrorId kAttributesTooLarge{523};  ///< attributes larger than the shader config allows
inline constexpr ErrorId kAttributesDisagree{524};  ///< attribute sizes disagree
inline constexpr ErrorId kCollectionNotReferable{525};  ///< collection does not allow outside dependencies
inline constexpr ErrorId kCollectionWithoutAdditions{526};  ///< collection does not allow additions
inline constexpr ErrorId kRootSignaturesOverlap{527};  ///< local and global root signature overlap
inline constexpr ErrorId kBindingMissing{528};  ///< resource is in no root signature
inline constexpr ErrorId kBindingMismatch{529};  ///< root parameter cannot feed the resource
inline constexpr ErrorId kStaticSamplerConflict{530};  ///< static samplers disagree
inline constexpr ErrorId kStaticSamplerCount{531};  ///< too many static samplers
inline constexpr ErrorId kPipelineStackSize{532};  ///< invalid pipeline stack size
inline constexpr ErrorId kAdditionNotAllowed{533};  ///< addition to a state object not allowed
inline constexpr ErrorId kAdditionConfigsDiffer{534};  ///< addition and parent have different configs
inline constexpr ErrorId kAdditionDuplicate{535};  ///< addition exports a name that its parent exports already
inline constexpr ErrorId kRootSignatureKind{536};  ///< root signature of the wrong kind
inline constexpr ErrorId kComputeEntryPoint{537};  ///< no such compute shader
inline constexpr ErrorId kLibrarySubobject{538};  ///< invalid subobject in HLSL
inline constexpr ErrorId kConfigFlags{539};  ///< invalid flags
inline constexpr ErrorId kCommandSignature{540};  ///< invalid command signature
inline constexpr ErrorId kCommandSignatureTier{541};  ///< indirect DispatchRays needs tier 1.1
inline constexpr ErrorId kShaderTier{542};  ///< shader needs tier 1.1
inline constexpr ErrorId kCallGraphSignatures{543};  ///< functions of a call graph have different root signatures
inline constexpr ErrorId kLibraryShaderModel{544};  ///< shader needs a higher shader model
inline constexpr ErrorId kNoRaytracing{545};  ///< device without ray tracing
inline constexpr ErrorId kMicromapTier{546};  ///< opacity micromaps need tier 1.2
inline constexpr ErrorId kNoMicromaps{547};  ///< backend has no opacity micromaps
inline constexpr ErrorId kDataAccess{548};  ///< data access is experimental
inline constexpr ErrorId kNoRtasOperations{549};  ///< device without indirect acceleration structure operations
inline constexpr ErrorId kAttributesUnread{553};  ///< attributes declared of another size and not read
inline constexpr ErrorId kFunctionUnresolved{560};  ///< function without a body
inline constexpr ErrorId kFunctionDiffers{561};  ///< function declared with another signature
inline constexpr ErrorId kFunctionNotReferable{562};  ///< function of a collection that does not allow outside dependencies
inline constexpr ErrorId kFunctionNoSource{563};  ///< library without source cannot be linked
inline constexpr ErrorId kFunctionLink{564};  ///< libraries cannot be linked
inline constexpr ErrorId kFunctionInterpreted{565};  ///< linked shader is interpreted
inline constexpr ErrorId kComputeUnlinked{566};  ///< compute shader calls another library
inline constexpr ErrorId kBlockAccess{570};  ///< unordered access to a block-compressed texture
inline constexpr ErrorId kBlockDimension{571};  ///< block-compressed texture of one dimension
inline constexpr ErrorId kCopyBlocks{572};  ///< copy of parts of blocks
inline constexpr ErrorId kSampleCount{573};  ///< sample count that a texture or pipeline cannot have
inline constexpr ErrorId kSampleMismatch{574};  ///< sample counts that differ
inline constexpr ErrorId kResolve{575};  ///< resolve of what cannot be resolved
inline constexpr ErrorId kPlacement{576};  ///< heap, or a place in one, that cannot be
inline constexpr ErrorId kRootSignatureTooLarge{600};  ///< root signature too large
inline constexpr ErrorId kLocalRootSignatureTooLarge{601};  ///< local root signature too large
inline constexpr ErrorId kLocalRootSignatureFlags{602};  ///< invalid root signature flags
inline constexpr ErrorId kRootSignatureVisibility{603};  ///< invalid shader visibility
inline constexpr ErrorId kRootSignatureOverlap{604};  ///< register bound twice
inline constexpr ErrorId kRootParameterInvalid{605};  ///< invalid root parameter
inline constexpr ErrorId kTableMixesSamplers{606};  ///< descriptor table mixes samplers and views
inline constexpr ErrorId kRangeInvalid{607};  ///< invalid descriptor range
inline constexpr ErrorId kRootSignatureSyntax{608};  ///< root signature syntax error
inline constexpr ErrorId kRootConstantsCount{609};  ///< root constants need at least one value
inline constexpr ErrorId kStaticSamplerInvalid{610};  ///< invalid static sampler
inline constexpr ErrorId kHeapSize{620};  ///< invalid descriptor heap size
inline constexpr ErrorId kHeapType{621};  ///< invalid descriptor heap type or flags
inline constexpr ErrorId kDescriptorHandle{622};  ///< descriptor handle is not in a live heap
inline constexpr ErrorId kViewResource{623};  ///< view does not fit the resource
inline constexpr ErrorId kViewRange{624};  ///< view reaches outside the buffer
inline constexpr ErrorId kViewStride{625};  ///< invalid structure stride or offset
inline constexpr ErrorId kViewFormat{626};  ///< invalid view format
inline constexpr ErrorId kViewAccess{627};  ///< resource does not allow unordered access
inline constexpr ErrorId kConstantBufferView{628};  ///< invalid constant buffer view
inline constexpr ErrorId kAccelerationStructureView{629};  ///< invalid acceleration structure view
inline constexpr ErrorId kViewSubresources{630};  ///< view reaches outside the texture
inline constexpr ErrorId kSamplerInvalid{631};  ///< invalid sampler
inline constexpr ErrorId kDescriptorCopy{632};  ///< invalid descriptor copy
inline constexpr ErrorId kLibraryRootSignature{633};  ///< root signature of a library cannot be used
inline constexpr ErrorId kViewCounter{634};  ///< invalid counter of a view
inline constexpr ErrorId kBuildInputs{700};  ///< invalid build inputs
inline constexpr ErrorId kBuildFlagsExclusive{701};  ///< build flags are mutually exclusive
inline constexpr ErrorId kGeometryMixed{702};  ///< bottom level mixes geometry types
inline constexpr ErrorId kVertexFormat{703};  ///< unsupported vertex format
inline constexpr ErrorId kIndexBuffer{704};  ///< invalid index buffer
inline constexpr ErrorId kVertexBufferAlignment{705};  ///< misaligned vertex buffer address or stride
inline constexpr ErrorId kTransformAlignment{707};  ///< misaligned Transform3x4
inline constexpr ErrorId kAabbAlignment{708};  ///< misaligned AABB address or stride
inline constexpr ErrorId kGeometryLimits{709};  ///< acceleration structure limits exceeded
inline constexpr ErrorId kGeometryDescsNull{710};  ///< geometry descs missing
inline constexpr ErrorId kAccelerationStructureAlignment{711};  ///< misaligned acceleration structure address
inline constexpr ErrorId kBuildAddress{712};  ///< address is in no live buffer
inline constexpr ErrorId kAccelerationStructureMemory{713};  ///< wrong kind of buffer
inline constexpr ErrorId kBuildUpdate{714};  ///< invalid update arguments
inline constexpr ErrorId kPostbuildInfo{715};  ///< invalid postbuild info
inline constexpr ErrorId kAccelerationStructureCopy{716};  ///< invalid acceleration structure copy
inline constexpr ErrorId kInstanceDescs{717};  ///< misaligned instance descs
inline constexpr ErrorId kBuildMemoryTooSmall{719};  ///< buffer too small
inline constexpr ErrorId kGraphicsDesc{720};  ///< invalid graphics pipeline description
inline constexpr ErrorId kGraphicsUnsupported{721};  ///< graphics feature is not supported
inline constexpr ErrorId kGraphicsShader{722};  ///< no such vertex or pixel shader
inline constexpr ErrorId kInputLayout{723};  ///< input layout does not fit the vertex shader
inline constexpr ErrorId kStageLinkage{724};  ///< a shader does not fit the one before it
inline constexpr ErrorId kTargetOutput{725};  ///< pixel shader does not fit the render targets
inline constexpr ErrorId kTargetFormat{726};  ///< format cannot be drawn to
inline constexpr ErrorId kStageRootAccess{727};  ///< root signature does not allow this stage
inline constexpr ErrorId kGraphicsWarning{728};  ///< graphics pipeline may not do what is meant
inline constexpr ErrorId kTargetView{730};  ///< invalid render target or depth-stencil view
inline constexpr ErrorId kTargetHandle{731};  ///< not a render target or depth-stencil descriptor
inline constexpr ErrorId kDrawState{740};  ///< nothing can be drawn
inline constexpr ErrorId kDrawBuffers{741};  ///< invalid vertex or index buffer view
inline constexpr ErrorId kDrawRectangles{742};  ///< invalid viewports, rectangles or targets
inline constexpr ErrorId kClearTarget{743};  ///< target cannot be cleared like this
inline constexpr ErrorId kQueryHeap{744};  ///< invalid query heap
inline constexpr ErrorId kQuery{745};  ///< invalid query
inline constexpr ErrorId kMicromapArray{746};  ///< invalid opacity micromap array
inline constexpr ErrorId kMicromapLinkage{747};  ///< invalid opacity micromap linkage
inline constexpr ErrorId kRtasInputs{748};  ///< invalid inputs of an acceleration structure operation
inline constexpr ErrorId kRtasData{749};  ///< invalid memory of an acceleration structure operation
inline constexpr ErrorId kListNotOpen{800};  ///< command list is not open
inline constexpr ErrorId kBarrier{802};  ///< invalid resource barrier
inline constexpr ErrorId kAccelerationStructureTransition{803};  ///< transition of an acceleration structure buffer
inline constexpr ErrorId kSetHeaps{804};  ///< descriptor heaps cannot be set
inline constexpr ErrorId kRootSignatureNotSet{805};  ///< no root signature
inline constexpr ErrorId kFenceWait{806};  ///< fence wait timed out
inline constexpr ErrorId kRootParameterMismatch{807};  ///< root parameter does not match the call
inline constexpr ErrorId kRootConstantsRange{808};  ///< root constants out of range
inline constexpr ErrorId kRootDescriptorAddress{809};  ///< invalid root descriptor address
inline constexpr ErrorId kDescriptorTableHandle{810};  ///< descriptor table handle is not in a heap that is set
inline constexpr ErrorId kPipelineNotSet{811};  ///< no pipeline of this kind is set
inline constexpr ErrorId kPipelineRootSignature{812};  ///< root signature does not match the pipeline
inline constexpr ErrorId kShaderTableLayout{813};  ///< misaligned shader table address or stride
inline constexpr ErrorId kDispatchTooLarge{814};  ///< dispatch too large
inline constexpr ErrorId kShaderTableMemory{815};  ///< shader table is not in live memory
inline constexpr ErrorId kIndirectArguments{816};  ///< invalid ExecuteIndirect arguments
inline constexpr ErrorId kCopyRange{817};  ///< copy out of range
inline constexpr ErrorId kCopyOverlap{818};  ///< copy overlaps itself
inline constexpr ErrorId kCopyFormat{819};  ///< copy between incompatible resources
inline constexpr ErrorId kCopyFootprint{820};  ///< invalid copy footprint
inline constexpr ErrorId kCopyHeap{821};  ///< heap type does not allow this copy
inline constexpr ErrorId kClearView{822};  ///< unordered access view cannot be cleared
inline constexpr ErrorId kListNotExecutable{823};  ///< command list cannot be executed
inline constexpr ErrorId kEvents{824};  ///< unbalanced BeginEvent and EndEvent
inline constexpr ErrorId kWriteImmediate{825};  ///< values cannot be written
inline constexpr ErrorId kViewAdjusted{826};  ///< view is not as described
inline constexpr ErrorId kPredication{829};  ///< invalid predication
inline constexpr ErrorId kTableUnknownExport{840};  ///< shader table: unknown export
inline constexpr ErrorId kTableArgumentCount{841};  ///< shader table: wrong number of local arguments
inline constexpr ErrorId kTableArgumentKind{842};  ///< shader table: wrong kind of local argument
inline constexpr ErrorId kTableArgumentSize{843};  ///< shader table: wrong size of local argument
inline constexpr ErrorId kMemoryFreed{856};  ///< command list refers to freed memory
inline constexpr ErrorId kEnhancedBarrier{858};  ///< invalid enhanced barrier
inline constexpr ErrorId kNoBackend{900};  ///< no backend
inline constexpr ErrorId kUnknownBackend{901};  ///< unknown backend
inline constexpr ErrorId kForeignObject{903};  ///< object belongs to another device
inline constexpr ErrorId kNullHandle{904};  ///< empty handle
inline constexpr ErrorId kBufferSize{905};  ///< invalid buffer size
inline constexpr ErrorId kBufferHeap{906};  ///< invalid buffer heap, flags or state
inline constexpr ErrorId kAccelerationStructureBuffer{907};  ///< invalid acceleration structure buffer
inline constexpr ErrorId kTextureSize{908};  ///< invalid texture size
inline constexpr ErrorId kTextureFormat{909};  ///< unsupported texture format
inline constexpr ErrorId kShaderLibrary{910};  ///< shader library cannot be used
inline constexpr ErrorId kMapDefaultHeap{911};  ///< default heap cannot be mapped
inline constexpr ErrorId kDeviceDesc{914};  ///< invalid device description
inline constexpr ErrorId kTableDescription{915};  ///< shader tables cannot be described
inline constexpr ErrorId kExplain{916};  ///< cannot explain the pixel
inline constexpr ErrorId kRemovedByCall{917};  ///< the device was removed
}  // namespace api

/// Section "Backends" of rtapi/ERRORS.md.
namespace backend {
inline constexpr ErrorId kWaveSize{550};  ///< no waves of that size
inline constexpr ErrorId kNoSubgroups{551};  ///< device lacks subgroup operations for waves
inline constexpr ErrorId kGroupsharedMemory{552};  ///< too much groupshared memory for the device
inline constexpr ErrorId kOperationArgument{788};  ///< argument of an acceleration structure operation breaks a rule
inline constexpr ErrorId kSerializedData{789};  ///< serialized acceleration structure cannot be read
inline constexpr ErrorId kInputOutOfBounds{790};  ///< build input outside its buffer
inline constexpr ErrorId kInputFormat{791};  ///< format not allowed in a build
inline constexpr ErrorId kBuildFailed{792};  ///< acceleration structure could not be built
inline constexpr ErrorId kUpdate{793};  ///< acceleration structure cannot be updated
inline constexpr ErrorId kTooManyElements{794};  ///< too many elements in acceleration structures
inline constexpr ErrorId kResultTooSmall{795};  ///< result does not fit its buffer
inline constexpr ErrorId kStructureSource{796};  ///< source of a build or copy cannot be used
inline constexpr ErrorId kInstanceInactive{797};  ///< instance can never be hit
inline constexpr ErrorId kIndexOutOfRange{798};  ///< index past VertexCount
inline constexpr ErrorId kMicromapUnusable{799};  ///< opacity micromap that cannot be used
inline constexpr ErrorId kMultisampled{844};  ///< a shader uses a writable multisampled texture
inline constexpr ErrorId kShaderPrint{845};  ///< printf
inline constexpr ErrorId kShaderError{846};  ///< errorf
inline constexpr ErrorId kPrintsLost{847};  ///< printf without room
inline constexpr ErrorId kRayOutOfRange{888};  ///< rays beyond the range of the traversal
inline constexpr ErrorId kRecursionLimit{890};  ///< TraceRay past the recursion limit
inline constexpr ErrorId kShaderStack{891};  ///< the shader stack is used up
inline constexpr ErrorId kShaderFault{892};  ///< shader code failed
inline constexpr ErrorId kShaderRemoval{893};  ///< a shader asked for the device's removal
inline constexpr ErrorId kNoTopLevel{894};  ///< rays were traced against an address without a top level
inline constexpr ErrorId kRecordOutOfBounds{895};  ///< shader record past the end of its table
inline constexpr ErrorId kRecordUnknown{896};  ///< shader record without a valid identifier
inline constexpr ErrorId kStepLimit{897};  ///< an interpreted shader used up its limit of steps
inline constexpr ErrorId kIndirectArguments{898};  ///< indirect arguments cannot be used
inline constexpr ErrorId kQueryNotWritten{899};  ///< a query was resolved that no EndQuery had written
inline constexpr ErrorId kNoVulkanDevice{950};  ///< no Vulkan device with ray tracing pipelines
inline constexpr ErrorId kNoValidationLayer{951};  ///< Vulkan's validation layer is not installed
inline constexpr ErrorId kVulkanFailed{952};  ///< a Vulkan call failed
inline constexpr ErrorId kNoSuchVulkanDevice{953};  ///< no Vulkan device of that name
inline constexpr ErrorId kNoSpirv{954};  ///< shader has no code for Vulkan
inline constexpr ErrorId kVulkanDeviceLost{955};  ///< the Vulkan device was lost
inline constexpr ErrorId kVulkanLimit{956};  ///< a limit of the Vulkan device is exceeded
inline constexpr ErrorId kUnknownWorkaround{957};  ///< unknown workaround
inline constexpr ErrorId kNoQueries{958};  ///< the Vulkan device has no such queries
inline constexpr ErrorId kValidationFinding{959};  ///< Vulkan's validation layers found a fault of the Vulkan backend
inline constexpr ErrorId kTextureUnsupported{960};  ///< texture not supported by the Vulkan device
inline constexpr ErrorId kViewUnsupported{961};  ///< view not supported by the Vulkan device
inline constexpr ErrorId kSamplerUnsupported{962};  ///< sampler not supported by the Vulkan device
inline constexpr ErrorId kNoRayQuery{963};  ///< the Vulkan device has no RayQuery
inline constexpr ErrorId kVulkanTableLimit{964};  ///< shader table too large for the Vulkan device
inline constexpr ErrorId kNoGraphics{965};  ///< the Vulkan device has no graphics pipelines
inline constexpr ErrorId kVertexFormatUnsupported{966};  ///< vertex format not supported by the Vulkan device
inline constexpr ErrorId kNoBarycentrics{967};  ///< the Vulkan device has no barycentrics
inline constexpr ErrorId kNoHitObject{968};  ///< shader that hit objects cannot run on Vulkan
inline constexpr ErrorId kOutOfMemory{990};  ///< out of memory
inline constexpr ErrorId kPrecisionUnsupported{991};  ///< traversal precision not available
inline constexpr ErrorId kEmbreeUnusable{992};  ///< Embree cannot be used
}  // namespace backend

/// Section "HLSL compiler" of rtapi/ERRORS.md.
namespace compiler {
inline constexpr ErrorId kTooManyErrors{2000};  ///< too many errors; further errors are not shown
inline constexpr ErrorId kMainFileNotFound{2001};  ///< cannot open '{0}': {1}
inline constexpr ErrorId kIncludeNotFound{2002};  ///< include file '{0}' not found; searched: {1}
inline constexpr ErrorId kIncludeUnreadable{2003};  ///< cannot read include file '{0}': {1}
inline constexpr ErrorId kIncludeExpectsName{2004};  ///< \#include expects "FILENAME" or \<FILENAME>, found {0}
inline constexpr ErrorId kIncludeTooDeep{2005};  ///< \#include nested {0} deep; at most {1} are allowed. Does '{2}' include itself? \#pragma once prevents it
inline constexpr ErrorId kTooMuchSource{2006};  ///< {0}; does a file include itself more than once? \#pragma once prevents it
inline constexpr ErrorId kIncludeInArguments{2007};  ///< #{0} inside the arguments of macro '{1}' is not supported
inline constexpr ErrorId kUnknownDirective{2008};  ///< unknown preprocessor directive '#{0}'
inline constexpr ErrorId kExtraTokens{2009};  ///< extra text after #{0} is ignored: {1}
inline constexpr ErrorId kMacroNameExpected{2010};  ///< #{0} expects the name of a macro, found {1}
inline constexpr ErrorId kMacroNameDefined{2011};  ///< 'defined' cannot be the name of a macro
inline constexpr ErrorId kMacroRedefined{2012};  ///< macro '{0}' is redefined differently
inline constexpr ErrorId kBuiltinMacroChanged{2013};  ///< #{0} changes the predefined macro '{1}'
inline constexpr ErrorId kMacroParameterExpected{2014};  ///< expected a parameter name, '...' or ')' in the parameter list of macro '{0}', found {1}
inline constexpr ErrorId kMacroParameterTwice{2015};  ///< macro '{0}' has two parameters named '{1}'
inline constexpr ErrorId kMacroParametersUnclosed{2016};  ///< expected ',' or ')' in the parameter list of macro '{0}', found {1}
inline constexpr ErrorId kVaArgsOutsideVariadic{2017};  ///< '{0}' is only allowed in the body of a macro with '...'
inline constexpr ErrorId kStringizeNeedsParameter{2018};  ///< '#' must be followed by a parameter of macro '{0}', found {1}
inline constexpr ErrorId kPasteAtEdge{2019};  ///< '##' cannot be at the {0} of a macro's body
inline constexpr ErrorId kPasteInvalid{2020};  ///< pasting '{1}' and '{2}' with '##' forms '{0}', which is not a single token
inline constexpr ErrorId kTooFewArguments{2021};  ///< macro '{0}' takes {1} argument(s); {2} given
inline constexpr ErrorId kTooManyArguments{2022};  ///< macro '{0}' takes {1} argument(s); {2} given
inline constexpr ErrorId kUnterminatedArguments{2023};  ///< missing ')' after the arguments of macro '{0}'
inline constexpr ErrorId kExpansionTooLarge{2024};  ///< macro expansion produces more than {0} tokens; the last macro was '{1}'
inline constexpr ErrorId kExpansionTooDeep{2025};  ///< arguments of macro '{0}' are nested more than {1} deep
inline constexpr ErrorId kVaOptMalformed{2026};  ///< \_\_VA_OPT\_\_ must be followed by a balanced '(...)'
inline constexpr ErrorId kVaOptNested{2027};  ///< \_\_VA_OPT\_\_ cannot be nested inside \_\_VA_OPT\_\_
inline constexpr ErrorId kUnterminatedConditional{2030};  ///< #{0} without \#endif
inline constexpr ErrorId kConditionalWithoutIf{2031};  ///< #{0} without \#if
inline constexpr ErrorId kElseAfterElse{2032};  ///< #{0} after \#else
inline constexpr ErrorId kConditionExpected{2033};  ///< #{0} expects an expression
inline constexpr ErrorId kConditionOperandExpected{2034};  ///< expected a value in the expression of #{0}, found {1}
inline constexpr ErrorId kConditionTokenExpected{2035};  ///< expected {0}, found {1}
inline constexpr ErrorId kConditionTrailing{2036};  ///< expected an operator or the end of the #{0} expression, found {1}
inline constexpr ErrorId kConditionDivisionByZero{2037};  ///< division by zero in #{0}
inline constexpr ErrorId kConditionFloat{2038};  ///< floating-point number '{0}' in #{1}; only integers are allowed
inline constexpr ErrorId kConditionTooDeep{2039};  ///< expression of #{0} is nested more than {1} deep
inline constexpr ErrorId kErrorDirective{2040};  ///< \#error {0}
inline constexpr ErrorId kWarningDirective{2041};  ///< \#warning {0}
inline constexpr ErrorId kLineNumberExpected{2042};  ///< \#line expects a line number from 0 to 2147483647, found {0}
inline constexpr ErrorId kLineNameExpected{2043};  ///< \#line expects a file name in quotes, found {0}
inline constexpr ErrorId kUnknownPragma{2044};  ///< unknown \#pragma {0} is ignored
inline constexpr ErrorId kPackMatrixMalformed{2045};  ///< \#pragma pack_matrix expects (row_major) or (column_major), found {0}; ignored
inline constexpr ErrorId kPragmaOnceInMainFile{2046};  ///< \#pragma once in the main file
inline constexpr ErrorId kDefineOptionMalformed{2047};  ///< option -D expects NAME or NAME=VALUE, found '{0}'
inline constexpr ErrorId kUnexpectedCharacter{2100};  ///< unexpected character {0}
inline constexpr ErrorId kUnterminatedComment{2101};  ///< unterminated /\* comment
inline constexpr ErrorId kUnterminatedString{2102};  ///< missing terminating '"' of a string
inline constexpr ErrorId kUnterminatedCharacter{2103};  ///< missing terminating "'" of a character literal
inline constexpr ErrorId kEmptyCharacter{2104};  ///< empty character literal
inline constexpr ErrorId kUnknownEscape{2105};  ///< unknown escape sequence '{0}'
inline constexpr ErrorId kEscapeOutOfRange{2106};  ///< escape sequence '{0}' does not fit in one byte; the largest is {1}
inline constexpr ErrorId kHexEscapeEmpty{2107};  ///< '\\x' has no hexadecimal digits
inline constexpr ErrorId kIntegerTooLarge{2110};  ///< integer '{0}' is too large; at most 18446744073709551615 is allowed
inline constexpr ErrorId kInvalidDigit{2111};  ///< invalid digit '{0}' in {1} number '{2}'
inline constexpr ErrorId kDigitsExpected{2112};  ///< {0} number '{1}' has no digits
inline constexpr ErrorId kInvalidIntegerSuffix{2113};  ///< invalid suffix '{0}' on integer '{1}'; allowed are u, l, ul, ll, ull (a floating-point number needs a '.' or an exponent)
inline constexpr ErrorId kInvalidFloatSuffix{2114};  ///< invalid suffix '{0}' on floating-point number '{1}'; allowed are f, h, l
inline constexpr ErrorId kExponentEmpty{2115};  ///< exponent of '{0}' has no digits
inline constexpr ErrorId kFloatTooLarge{2117};  ///< floating-point number '{0}' is too large; at most 1.79769e+308 is allowed
inline constexpr ErrorId kFloatBecomesInfinite{2118};  ///< '{0}' is larger than any {1} ({2}) and becomes infinite
inline constexpr ErrorId kExpectedToken{2200};  ///< expected {0}, found {1}
inline constexpr ErrorId kExpectedSemicolon{2201};  ///< expected ';' after {0}, found {1}
inline constexpr ErrorId kExpectedClosing{2202};  ///< expected {0} after {1}, found {2}
inline constexpr ErrorId kExpectedDeclaration{2203};  ///< expected a declaration, found {0}
inline constexpr ErrorId kExpectedExpression{2204};  ///< expected an expression, found {0}
inline constexpr ErrorId kExpectedName{2205};  ///< expected the name of {0}, found {1}
inline constexpr ErrorId kExpectedType{2206};  ///< expected a type, found {0}
inline constexpr ErrorId kUnknownTypeName{2207};  ///< unknown type name '{0}'
inline constexpr ErrorId kTypeInExpression{2208};  ///< expected an expression, found type '{0}'; to make a value, write '{0}(...)'
inline constexpr ErrorId kNestedTooDeep{2209};  ///< nested more than {0} deep
inline constexpr ErrorId kExpressionTooDeep{2210};  ///< expression has more than {0} levels; split it into several statements
inline constexpr ErrorId kUnmatchedClosing{2211};  ///< {0} has no matching '{1}'
inline constexpr ErrorId kElseWithoutIf{2212};  ///< 'else' without 'if'
inline constexpr ErrorId kLabelOutsideSwitch{2213};  ///< '{0}' outside of a switch
inline constexpr ErrorId kStatementBeforeLabel{2214};  ///< expected 'case' or 'default' as the first statement of a switch, found {0}
inline constexpr ErrorId kFunctionInsideFunction{2215};  ///< function '{0}' is defined inside another function; is a '}' missing before it?
inline constexpr ErrorId kBuiltinTypeAsName{2216};  ///< built-in type '{0}' cannot be used as the name of {1}
inline constexpr ErrorId kKeywordAsName{2217};  ///< keyword '{0}' cannot be used as the name of {1}
inline constexpr ErrorId kInitListNotHere{2218};  ///< an initializer list is only allowed after '=', after 'return' or in another initializer list
inline constexpr ErrorId kDeclarationNotHere{2219};  ///< {0} can only be declared {1}
inline constexpr ErrorId kNoPointers{2220};  ///< HLSL has no pointers; use an 'inout' or 'out' parameter
inline constexpr ErrorId kNoReferences{2221};  ///< HLSL has no references; use an 'inout' or 'out' parameter
inline constexpr ErrorId kNoArrow{2222};  ///< HLSL has no '->'; use '.'
inline constexpr ErrorId kNoAddress{2223};  ///< HLSL has no pointers, so there is no unary '{0}'
inline constexpr ErrorId kNoGoto{2224};  ///< HLSL has no 'goto'
inline constexpr ErrorId kNoExceptions{2225};  ///< HLSL has no exceptions ('{0}')
inline constexpr ErrorId kNoDynamicMemory{2226};  ///< HLSL has no dynamic memory ('{0}')
inline constexpr ErrorId kNoVirtual{2227};  ///< HLSL has no virtual functions
inline constexpr ErrorId kNoLambda{2228};  ///< HLSL has no lambda expressions
inline constexpr ErrorId kNoUnion{2230};  ///< HLSL has no unions; use asuint(), asfloat()
inline constexpr ErrorId kReservedWord{2232};  ///< '{0}' is reserved and has no meaning in HLSL
inline constexpr ErrorId kNoSuchScalar{2233};  ///< HLSL has no type '{0}'; use {1}
inline constexpr ErrorId kNoCppCast{2234};  ///< HLSL has no '{0}'; write '(Type)value'
inline constexpr ErrorId kNoConstructor{2235};  ///< HLSL has no {0}; write a function that returns a '{1}'
inline constexpr ErrorId kNoConstructorCall{2236};  ///< HLSL has no '{0} {1}(...)'; write '{0} {1} = {0}(...)'
inline constexpr ErrorId kNoVariadic{2237};  ///< HLSL does not support a variable number of {0}
inline constexpr ErrorId kArrayBoundsBeforeName{2238};  ///< array bounds go after the name: 'float a[3]'
inline constexpr ErrorId kNoBraceConstruction{2239};  ///< HLSL has no '{0}{...}'; write '{0}(...)'
inline constexpr ErrorId kAccessSpecifier{2241};  ///< access specifier '{0}' is ignored: all members are public
inline constexpr ErrorId kNoLabels{2242};  ///< HLSL has no labels
inline constexpr ErrorId kUnknownAttribute{2250};  ///< unknown attribute '{0}' is ignored
inline constexpr ErrorId kAttributeOnNothing{2251};  ///< attribute '{0}' must come before {1}, found {2}
inline constexpr ErrorId kStateBlockIgnored{2252};  ///< {0} is ignored; the host or the root signature sets the state
inline constexpr ErrorId kModifierConflict{2253};  ///< '{0}' cannot be combined with '{1}'
inline constexpr ErrorId kModifierTwice{2254};  ///< '{0}' is specified twice
inline constexpr ErrorId kDeclaresNothing{2255};  ///< the declaration declares nothing
inline constexpr ErrorId kRegisterExpected{2260};  ///< expected a register such as t0, u1, b2, s3 or a space such as space1, found {0}
inline constexpr ErrorId kRegisterSpaceExpected{2261};  ///< expected a space such as space1, found {0}
inline constexpr ErrorId kRegisterTooLarge{2262};  ///< the number in '{0}' is too large; at most 4294967295 is allowed
inline constexpr ErrorId kPackOffsetExpected{2263};  ///< expected a constant register such as c0 or c3.y, found {0}
inline constexpr ErrorId kAnnotationTwice{2264};  ///< {0} is specified twice
inline constexpr ErrorId kTemplateParameterExpected{2270};  ///< expected a template parameter such as 'typename T' or 'int N', found {0}
inline constexpr ErrorId kTemplateOfWhat{2271};  ///< expected a function, a struct or 'using NAME =' after 'template\<...>', found {0}
inline constexpr ErrorId kNotOverloadable{2273};  ///< operator {0} cannot be overloaded
inline constexpr ErrorId kNoConversionOperator{2274};  ///< HLSL does not allow conversion operators; write a method
inline constexpr ErrorId kSubobjectInitializer{2280};  ///< expected '= { ... }' after subobject '{0}', found {1}
inline constexpr ErrorId kCharacterNotSingle{2281};  ///< character literal {0} has {1} bytes; exactly 1 is allowed
inline constexpr ErrorId kHexExponentMissing{2282};  ///< hexadecimal floating-point number '{0}' has no exponent
inline constexpr ErrorId kBitFieldPlace{2283};  ///< a bit field must be a plain field of a struct: not static, no array, without a semantic or another annotation
inline constexpr ErrorId kSpecializationArguments{2284};  ///< explicit specialization of '{0}' names no arguments
inline constexpr ErrorId kSpecializationHeader{2285};  ///< '{0}' has template arguments, which only an explicit specialization has
inline constexpr ErrorId kBitFieldName{2286};  ///< '{0}' behind ':' is a semantic, not the beginning of a width; put the width of bit field '{1}' in parentheses
inline constexpr ErrorId kSemanticIgnored{2287};  ///< semantic '{0}' is ignored: the first one, '{1}', counts
inline constexpr ErrorId kKeywordInExpression{2300};  ///< keyword '{0}' cannot be used as a value
inline constexpr ErrorId kModifierPlace{2301};  ///< '{0}' cannot be used on {1}; it is for {2}
inline constexpr ErrorId kNeedsShaderModel{2302};  ///< '{0}' needs Shader Model {1}
inline constexpr ErrorId kInterfaceMember{2303};  ///< an interface can only hold methods without a body, not {0}
inline constexpr ErrorId kInterfaceBase{2304};  ///< interface '{0}' cannot inherit from another type
inline constexpr ErrorId kVkAttributeIgnored{2340};  ///< [[vk::{0}]] is ignored: {1}
inline constexpr ErrorId kInstantiationBody{2360};  ///< an explicit instantiation of '{0}' cannot have a body
inline constexpr ErrorId kUndeclared{2400};  ///< '{0}' is not declared{1}
inline constexpr ErrorId kNotAScope{2401};  ///< '{0}' is not a namespace, struct or enum, so '::' cannot follow it
inline constexpr ErrorId kNotAType{2402};  ///< '{0}' is not a type
inline constexpr ErrorId kNotANamespace{2403};  ///< '{0}' is not a namespace
inline constexpr ErrorId kNotAValue{2404};  ///< '{0}' is a type or a namespace, not a value
inline constexpr ErrorId kRedefinition{2405};  ///< redefinition of '{0}'
inline constexpr ErrorId kFunctionValue{2406};  ///< function '{0}' is used without being called
inline constexpr ErrorId kFieldOutside{2407};  ///< field '{0}' needs an object, because this is not a method
inline constexpr ErrorId kThisOutside{2408};  ///< 'this' can only be used inside a method
inline constexpr ErrorId kMethodWithoutObject{2409};  ///< method '{0}' is called without an object
inline constexpr ErrorId kUnsupported{2410};  ///< {0} is not supported yet
inline constexpr ErrorId kStaticAssert{2411};  ///< static assertion failed: {0}
inline constexpr ErrorId kConstArgument{2412};  ///< {0} is a constant variable, which the function changes, as in DXC
inline constexpr ErrorId kVoidVariable{2420};  ///< {0} is not allowed
inline constexpr ErrorId kIncomplete{2421};  ///< '{0}' is declared but not yet defined
inline constexpr ErrorId kNeeds16Bit{2422};  ///< '{0}' needs the option -enable-16bit-types; half and min16 types do not
inline constexpr ErrorId kArraySize{2423};  ///< an array cannot have {0} elements; all dimensions together must have 1 to {1}
inline constexpr ErrorId kInnerUnbounded{2424};  ///< only the outermost dimension of an array can be unbounded
inline constexpr ErrorId kUnboundedVariable{2425};  ///< array '{0}' needs a size; only arrays of resources can be unbounded
inline constexpr ErrorId kVectorElement{2426};  ///< vectors and matrices can only hold scalars, not '{0}'
inline constexpr ErrorId kVectorSize{2427};  ///< a vector or matrix can have 1 to {0} components per dimension here, not {1}
inline constexpr ErrorId kMissingElement{2428};  ///< '{0}' needs an element type: {0}\<float4>
inline constexpr ErrorId kElementType{2429};  ///< '{0}' takes {1}, not '{2}'
inline constexpr ErrorId kNotAnInteger{2430};  ///< {0} must be an integer, not '{1}'
inline constexpr ErrorId kNotConstant{2431};  ///< {0} must be a compile-time constant
inline constexpr ErrorId kEnumBase{2432};  ///< the underlying type of an enum must be an integer type, not '{0}'
inline constexpr ErrorId kBadBase{2433};  ///< '{0}' cannot be a base, which must be another, completely defined struct
inline constexpr ErrorId kMemberInitialiser{2434};  ///< member '{0}' cannot have an initialiser in HLSL; set it where the struct is created
inline constexpr ErrorId kConstWithoutStatic{2435};  ///< '{0}' is const but not static: DXC makes it a constant buffer member and ignores the initialiser; write 'static const'
inline constexpr ErrorId kUniformInitialiser{2436};  ///< the initialiser of '{0}' is ignored: a global that is not static is a constant buffer member; write 'static'
inline constexpr ErrorId kGroupsharedInitialiser{2437};  ///< groupshared variable '{0}' cannot have an initialiser
inline constexpr ErrorId kLocalGroupshared{2438};  ///< groupshared variable '{0}' must be declared outside of functions
inline constexpr ErrorId kConstWithoutValue{2439};  ///< constant '{0}' has no initialiser and is zero
inline constexpr ErrorId kSelfInitialised{2440};  ///< the initialiser of '{0}' depends on its own value
inline constexpr ErrorId kStaticUsesLocal{2441};  ///< the initialiser of static '{0}' uses a local variable
inline constexpr ErrorId kReturnsArray{2442};  ///< function '{0}' cannot return an array without a size or of resources
inline constexpr ErrorId kReturnTypeDiffers{2444};  ///< this function differs from '{0}' only in its return type
inline constexpr ErrorId kFunctionRedefined{2445};  ///< '{0}' already has a body
inline constexpr ErrorId kSizeof{2446};  ///< '{0}' has no size
inline constexpr ErrorId kUnsignedBase{2447};  ///< 'unsigned {0}' is no type: only signed integers have a twin
inline constexpr ErrorId kNormType{2448};  ///< '{0}' has no effect on '{1}': it is for floating-point numbers
inline constexpr ErrorId kCoherentType{2449};  ///< '{0}' of type '{1}' cannot be {2}, which is for resources that are written
inline constexpr ErrorId kNotATemplate{2450};  ///< '{0}' takes no template arguments
inline constexpr ErrorId kTemplateCount{2451};  ///< '{0}' takes at most {1} template arguments; {2} given
inline constexpr ErrorId kTemplateArguments{2452};  ///< the template arguments do not match the parameters of '{0}'
inline constexpr ErrorId kTypeArgument{2453};  ///< expected a type as the template argument
inline constexpr ErrorId kValueArgument{2454};  ///< expected a constant as the template argument
inline constexpr ErrorId kTemplateDepth{2455};  ///< recursive instantiation of template '{0}' goes more than {1} levels deep
inline constexpr ErrorId kConversion{2460};  ///< cannot convert '{0}' to '{1}'
inline constexpr ErrorId kCast{2461};  ///< cannot cast '{0}' to '{1}'
inline constexpr ErrorId kTruncation{2462};  ///< implicit truncation of '{0}' to '{1}'
inline constexpr ErrorId kVoidValue{2463};  ///< a call that returns void has no value
inline constexpr ErrorId kNoCommonType{2464};  ///< '{0}' and '{1}' have no common type
inline constexpr ErrorId kOperand{2465};  ///< {0} cannot be applied to '{1}'
inline constexpr ErrorId kOperands{2466};  ///< '{0}' cannot be applied to '{1}' and '{2}'
inline constexpr ErrorId kIntegersOnly{2467};  ///< '{0}' can only be applied to integers, not to '{1}' and '{2}'
inline constexpr ErrorId kDivisionByZero{2468};  ///< division by zero in a constant
inline constexpr ErrorId kVectorLogic{2469};  ///< HLSL 2021 does not allow '{0}' on vectors; here it works component by component, without short-circuiting: write '{1}'
inline constexpr ErrorId kConditionType{2470};  ///< a condition must be a scalar, not '{0}'; reduce it with any() or all()
inline constexpr ErrorId kNotAPlace{2471};  ///< {0} must be assignable
inline constexpr ErrorId kConstPlace{2472};  ///< {0} is constant and cannot be modified
inline constexpr ErrorId kSwizzle{2473};  ///< '{0}' is not a component of '{1}'
inline constexpr ErrorId kSwizzleRange{2474};  ///< component '{0}' is out of bounds: the size of '{1}' is {2}
inline constexpr ErrorId kNoMembers{2475};  ///< there is no member '{1}', because '{0}' has no members
inline constexpr ErrorId kNoSuchMember{2476};  ///< '{0}' has no member '{1}'
inline constexpr ErrorId kNotIndexable{2477};  ///< '{0}' cannot be indexed
inline constexpr ErrorId kIndexType{2478};  ///< an index must be an integer, not '{0}'
inline constexpr ErrorId kIndexRange{2479};  ///< index {0} is out of bounds; there are {1} elements
inline constexpr ErrorId kInitialiserCount{2480};  ///< '{0}' takes {1} values; the initialiser has {2}
inline constexpr ErrorId kInitListUse{2481};  ///< an initialiser list is not allowed here
inline constexpr ErrorId kConstructorCount{2482};  ///< '{0}' needs {1} components; {2} given
inline constexpr ErrorId kConstructorArgument{2483};  ///< '{0}' cannot be constructed from '{1}'
inline constexpr ErrorId kNotConstructible{2484};  ///< '{0}' has no constructor; use an initialiser list or a cast
inline constexpr ErrorId kStringUse{2485};  ///< a string is only allowed in attributes and subobjects
inline constexpr ErrorId kHeapType{2486};  ///< an element of {0} cannot be a '{1}'
inline constexpr ErrorId kHeapUntyped{2487};  ///< give the element of a descriptor heap a type first: Texture2D t = ResourceDescriptorHeap[i];
inline constexpr ErrorId kMipsUse{2488};  ///< '{0}' needs a {1} and a location: texture.{0}[{1}][location]
inline constexpr ErrorId kTooDeep{2489};  ///< nested more than {0} deep
inline constexpr ErrorId kShiftByFloat{2490};  ///< '{0}' by a value of type '{1}', which is converted to an integer
inline constexpr ErrorId kMixedShapes{2491};  ///< '{0}' of '{1}' and '{2}': of a vector and a matrix, DXC makes no common type
inline constexpr ErrorId kTexelOffset{2492};  ///< texel offset {0} is outside of -8 to 7
inline constexpr ErrorId kScalarArgument{2493};  ///< argument {0} of '{1}' must be a scalar, not '{2}', of which the first component is used
inline constexpr ErrorId kTextureIndex{2494};  ///< the index of a '{0}' has {1} components, of which it takes {2}
inline constexpr ErrorId kConstantDivision{2495};  ///< division by a constant 0
inline constexpr ErrorId kNotCallable{2500};  ///< the called expression is not a function
inline constexpr ErrorId kNoOverload{2501};  ///< no matching function for the call to '{0}' with {1}
inline constexpr ErrorId kAmbiguousCall{2502};  ///< the call to '{0}' with {1} is ambiguous
inline constexpr ErrorId kNoSuchMethod{2503};  ///< '{0}' has no method '{1}'
inline constexpr ErrorId kNoBody{2504};  ///< '{0}' is called but has no body
inline constexpr ErrorId kRecursion{2505};  ///< '{0}' calls itself; HLSL does not allow recursive functions
inline constexpr ErrorId kCallDepth{2506};  ///< calls are nested too deep at '{0}'; the limit is {1}
inline constexpr ErrorId kArgumentCount{2507};  ///< '{0}' takes {1} arguments; {2} given
inline constexpr ErrorId kIntrinsicArgument{2508};  ///< argument {0} of '{1}' must be {2}, not '{3}'
inline constexpr ErrorId kMulShape{2509};  ///< mul('{0}', '{1}'): inner dimensions differ; {2} are used
inline constexpr ErrorId kAtomicType{2510};  ///< '{0}' needs a scalar of 32 or 64 bits, not '{1}'
inline constexpr ErrorId kAtomicTarget{2511};  ///< the target of '{0}' must be groupshared or in a writable resource
inline constexpr ErrorId kImplicitLevel{2512};  ///< '{0}' needs derivatives, which this stage does not have; mip level 0 is used: write SampleLevel
inline constexpr ErrorId kUserStruct{2513};  ///< {0} must be a struct without resources, not '{1}'
inline constexpr ErrorId kAmbiguousStrict{2514};  ///< the call to '{0}' with {1} takes the function, which DXC calls ambiguous with a template's instance
inline constexpr ErrorId kGeometryShader{2515};  ///< geometry shader '{0}' {1}
inline constexpr ErrorId kStrayJump{2520};  ///< '{0}' must be inside {1}
inline constexpr ErrorId kSwitchType{2521};  ///< switch needs an integer, not '{0}'
inline constexpr ErrorId kDuplicateCase{2522};  ///< duplicate case label '{0}'
inline constexpr ErrorId kReturnsValue{2523};  ///< a void function cannot return a value
inline constexpr ErrorId kReturnsNothing{2524};  ///< this function must return a value of type '{0}'
inline constexpr ErrorId kMissingReturn{2525};  ///< '{0}' can reach its end without a return; it then returns zero
inline constexpr ErrorId kLoopAttributes{2526};  ///< [{0}] and [{1}] exclude each other
inline constexpr ErrorId kEmptySwitch{2527};  ///< the switch has no case
inline constexpr ErrorId kEndlessLoop{2528};  ///< nothing ends this loop
inline constexpr ErrorId kUnrollCount{2529};  ///< [unroll] cannot tell how often the loop runs
inline constexpr ErrorId kReturnsThis{2530};  ///< DXC cannot return 'this' as a whole
inline constexpr ErrorId kNeverReturns{2531};  ///< '{0}' has no return; it returns zero
inline constexpr ErrorId kBarrierFlags{2532};  ///< Barrier's {0} are {1}; {2}
inline constexpr ErrorId kRegisterClass{2540};  ///< register '{0}' cannot be used for '{2}'; a '{1}' register is needed
inline constexpr ErrorId kTwoRegisters{2541};  ///< '{0}' already has a register
inline constexpr ErrorId kRegisterRange{2542};  ///< the registers of '{0}' extend past 4294967295
inline constexpr ErrorId kNoRegister{2543};  ///< no registers are left for '{0}'; give it a space of its own
inline constexpr ErrorId kOverlap{2544};  ///< '{0}' and '{1}' share register {2} in space{3}, and shader '{4}' uses both
inline constexpr ErrorId kPackOffset{2545};  ///< packoffset of '{0}' does not work for a '{1}': it would straddle a 16-byte row or be past 64 KiB
inline constexpr ErrorId kBufferSize{2546};  ///< constant buffer '{0}' has {1} bytes; the limit is 65536
inline constexpr ErrorId kPackOverlap{2547};  ///< packoffset of '{0}' overlaps '{1}'
inline constexpr ErrorId kPackOffsetPlace{2548};  ///< packoffset of '{0}' is ignored: it is for members of a constant buffer
inline constexpr ErrorId kElementSize{2549};  ///< an element of '{0}' has {1} bytes; D3D12 allows 2048
inline constexpr ErrorId kGroupsharedSize{2550};  ///< the groupshared variables of '{0}' take {1} bytes; allowed are {2}
inline constexpr ErrorId kConstantSpace{2551};  ///< '{0}' is in the constant buffer of globals, whose members have no register space
inline constexpr ErrorId kGroupsharedLimit{2552};  ///< [GroupSharedLimit] cannot be {0} bytes
inline constexpr ErrorId kShaderAttribute{2560};  ///< [shader()] takes "raygeneration", "intersection", "anyhit", "closesthit", "miss", "callable", "compute", "vertex" or "pixel", not {0}
inline constexpr ErrorId kSkippedStage{2561};  ///< '{0}' is skipped: {1} shaders are not supported yet
inline constexpr ErrorId kNoEntryPoint{2562};  ///< entry point '{0}' not found
inline constexpr ErrorId kDuplicateExport{2563};  ///< two entry points are exported as '{0}'
inline constexpr ErrorId kEntryIsMethod{2564};  ///< a method cannot be an entry point: '{0}'
inline constexpr ErrorId kEntryResult{2565};  ///< {0} shader '{1}' must return void, not '{2}'
inline constexpr ErrorId kEntryParameters{2566};  ///< {0} takes {1} parameter(s) ({2}); it has {3}
inline constexpr ErrorId kEntryStruct{2567};  ///< the {0} of {1} must be a struct without resources, not '{2}'
inline constexpr ErrorId kEntryModifier{2568};  ///< the {0} of {1} must be '{2}'
inline constexpr ErrorId kAttributeSize{2569};  ///< attributes '{0}' have {1} bytes; the limit is 32
inline constexpr ErrorId kPayloadQualifiers{2570};  ///< payload '{0}' lacks [raypayload] and access qualifiers, which DXC requires in {1}
inline constexpr ErrorId kNoThreadGroup{2571};  ///< compute shader '{0}' needs [numthreads(X, Y, Z)]
inline constexpr ErrorId kThreadGroup{2572};  ///< {0} of numthreads is {1}; it must be 1 to {2}
inline constexpr ErrorId kMissingSemantic{2573};  ///< parameter '{0}' of compute shader '{1}' needs a semantic such as SV_DispatchThreadID
inline constexpr ErrorId kUnknownSemantic{2574};  ///< '{0}' is not an input of compute shader '{1}'; the inputs are SV_DispatchThreadID, SV_GroupID, SV_GroupThreadID and SV_GroupIndex
inline constexpr ErrorId kSemanticType{2575};  ///< {0} has type '{1}', which does not match '{2}'
inline constexpr ErrorId kStage{2576};  ///< '{0}' is only available in {1}, but {2} shader '{3}' reaches it
inline constexpr ErrorId kExportNotFound{2577};  ///< cannot export '{0}': there is no such function
inline constexpr ErrorId kSkipped{2578};  ///< {0} function(s) are not checked, because no entry point reaches them: {1}
inline constexpr ErrorId kHitObjectPlace{2579};  ///< 'dx::HitObject' is not allowed in {0}
inline constexpr ErrorId kRayQueryFlags{2580};  ///< {0} is not a valid set of ray flags; a RayQuery takes 0 to {1}
inline constexpr ErrorId kRayQueryCopy{2581};  ///< a {0} cannot be copied; call its methods, pass the variable to a function, or declare a second name that is initialised with it
inline constexpr ErrorId kRayQueryPlace{2582};  ///< a {0} cannot be {1}; make it a local variable, or a parameter of a function
inline constexpr ErrorId kUnassignedResource{2583};  ///< static '{0}' is used, and nothing assigns a resource to it
inline constexpr ErrorId kIgnoredInStage{2584};  ///< [{0}] has no effect on a {1} shader
inline constexpr ErrorId kStageStrict{2585};  ///< DXC allows '{0}' only in {1}, but {2} shader '{3}' reaches it
inline constexpr ErrorId kUninitialised{2586};  ///< variable '{0}' is read, and nothing writes it: it is zero
inline constexpr ErrorId kOutUnwritten{2587};  ///< out parameter '{0}' is never written: it is zero
inline constexpr ErrorId kNeedsModel{2588};  ///< '{0}' needs Shader Model {1}, and the target is {2}
inline constexpr ErrorId kUndefinedStored{2589};  ///< variable '{0}' is stored, and nothing writes it: it is zero
inline constexpr ErrorId kSubobjectCount{2590};  ///< '{0}' takes {1} arguments; {2} given
inline constexpr ErrorId kSubobjectString{2591};  ///< argument {0} of '{1}' must be a string
inline constexpr ErrorId kSubobjectRange{2592};  ///< the value {0} is out of range
inline constexpr ErrorId kRootSignatureStage{2593};  ///< DXC does not allow [RootSignature] on a {0} shader
inline constexpr ErrorId kAttributeTwice{2594};  ///< [{0}] is written twice; the first one counts
inline constexpr ErrorId kExportedResource{2596};  ///< DXC does not export '{0}', because a parameter or its result holds resources
inline constexpr ErrorId kUnknownTarget{2600};  ///< unknown target '{0}'; the targets are lib_6_3 to lib_6_10, lib_6_x, and cs_6_0 to cs_6_10, vs and ps too
inline constexpr ErrorId kExportSyntax{2601};  ///< '{0}' is not a list of exports; write "A;B1,B2=C"
inline constexpr ErrorId kExperimentalTarget{2602};  ///< the target '{0}' is experimental: the specification of Shader Model 6.10 still moves
inline constexpr ErrorId kPayloadTarget{2610};  ///< -enable-payload-qualifiers needs lib_6_6 or higher; the target is {0}
inline constexpr ErrorId kPayloadIgnored{2611};  ///< the access qualifiers of payload '{0}' are ignored: they take effect from lib_6_7 on, and in lib_6_6 with -enable-payload-qualifiers
inline constexpr ErrorId kPayloadFieldPlain{2612};  ///< payload field '{0}' has no access qualifiers; write ': read(..) : write(..)'
inline constexpr ErrorId kPayloadNested{2613};  ///< payload field '{0}' is a payload struct, whose fields have their own access qualifiers; remove these
inline constexpr ErrorId kPayloadTwice{2614};  ///< payload field '{0}' has a second {1}(..)
inline constexpr ErrorId kPayloadStage{2615};  ///< '{0}' is not a payload stage; the stages are caller, anyhit, closesthit and miss
inline constexpr ErrorId kPayloadMissing{2616};  ///< payload field '{0}' has no {1}(..); write ': {1}()' if no stage does
inline constexpr ErrorId kPayloadProducer{2617};  ///< payload field '{0}' is read in stage '{1}', but no stage before it writes it
inline constexpr ErrorId kPayloadConsumer{2618};  ///< payload field '{0}' is written in stage '{1}', but no stage after it reads it
inline constexpr ErrorId kPayloadBase{2619};  ///< base '{0}' of payload struct '{1}' must be a [raypayload] struct too
inline constexpr ErrorId kPayloadUndefined{2620};  ///< reading an undefined value: payload field '{0}' has no read({1})
inline constexpr ErrorId kPayloadDropped{2621};  ///< the write is dropped: payload field '{0}' has no write({1})
inline constexpr ErrorId kPayloadNotReturned{2622};  ///< reading an undefined value: TraceRay does not return payload field '{0}', which has no read(caller)
inline constexpr ErrorId kPayloadNotPassed{2623};  ///< TraceRay does not pass on payload field '{0}', which was written but has no write(caller)
inline constexpr ErrorId kPayloadDataLoss{2624};  ///< payload field '{0}' may lose its value: stage '{1}' may write but not read it, and does not write it on every path
inline constexpr ErrorId kSelectOfStructs{2625};  ///< select() of '{0}' is refused by DXC, which takes numbers, vectors, matrices and samplers
inline constexpr ErrorId kSplitIndex{2626};  ///< the index of '{0}' must be a constant, because each of its structs holds resources with registers of their own
inline constexpr ErrorId kSplitRegister{2627};  ///< '{0}' holds no resource that takes a register of class '{1}'
inline constexpr ErrorId kSplitSize{2628};  ///< global variable of type '{0}', which holds resources, has too many parts; at most {1} fields and elements are allowed
inline constexpr ErrorId kBitFieldWidth{2629};  ///< bit field '{0}' has {1} bits; 1 to {2} are allowed, which is the size of '{3}'
inline constexpr ErrorId kBitFieldType{2630};  ///< bit field '{0}' has type '{1}'; an integer, bool or an enum is needed
inline constexpr ErrorId kBitFieldVersion{2631};  ///< bit field '{0}' needs HLSL 2021, and this is compiled with -HV {1}
inline constexpr ErrorId kBitFieldUse{2632};  ///< {0} cannot be {1}, because it has no address of its own
inline constexpr ErrorId kSpecializesNothing{2633};  ///< '{0}' specializes no template that is declared in this scope
inline constexpr ErrorId kSpecializedLate{2634};  ///< '{0}' is already in use or defined, so it cannot be defined here
inline constexpr ErrorId kAmbiguousPartial{2635};  ///< several partial specializations fit '{0}' equally well
inline constexpr ErrorId kNoSuchStatic{2636};  ///< '{0}' has no static member '{1}'
inline constexpr ErrorId kPrint{2637};  ///< {0}: {1}
inline constexpr ErrorId kRayQuerySecondFlags{2640};  ///< {0} is not a valid set of RAYQUERY_FLAGs; the second argument of RayQuery is 0, from 6.9 on also 1, from 6.10 on 0 to 3
inline constexpr ErrorId kAutoWithoutValue{2641};  ///< 'auto' needs an initialiser with a type, so '{0}' cannot have it here
inline constexpr ErrorId kLoopVariableAgain{2642};  ///< '{0}' hides the variable of a loop before it, which outlives the loop before HLSL 2021
inline constexpr ErrorId kInterfaceObject{2643};  ///< '{0}' is an interface, so there can be no variable of it; use a struct that implements it
inline constexpr ErrorId kInterfaceMethod{2644};  ///< '{0}' does not implement '{1}' of interface '{2}'
inline constexpr ErrorId kRayQueryMicromaps{2645};  ///< RAY_FLAG_FORCE_OMM_2_STATE needs RAYQUERY_FLAG_ALLOW_OPACITY_MICROMAPS as the second argument of RayQuery
inline constexpr ErrorId kGraphicsSemantic{2646};  ///< {0} of {1} shader '{2}' needs a semantic
inline constexpr ErrorId kPixelOutput{2647};  ///< '{0}' is not an output of pixel shader '{1}'; the outputs are SV_Target0 to SV_Target7 and SV_Depth
inline constexpr ErrorId kLongSwizzle{2650};  ///< '{1}' has no swizzle '{0}': vectors of over 4 components have none
inline constexpr ErrorId kLongVectorPlace{2651};  ///< vectors of over 4 components are not supported in {0}, and '{1}' is or has one
inline constexpr ErrorId kLongVectorArgument{2652};  ///< argument {0} of '{1}' is a '{2}'; it takes vectors of up to 4 components
inline constexpr ErrorId kPayloadUnqualified{2653};  ///< payload '{0}' needs [raypayload] and access qualifiers in {1}
inline constexpr ErrorId kTexelIndex{2665};  ///< '{0}' is indexed with a vector of {1} integers, not with '{2}'
inline constexpr ErrorId kVkIgnored{2666};  ///< '{0}' is ignored: {1}
inline constexpr ErrorId kRootSignatureAttribute{2667};  ///< [RootSignature] takes one string, not {0}
inline constexpr ErrorId kSampledPairs{2668};  ///< '{0}' has no {1}: components of 64 bits cannot be filtered or compared
inline constexpr ErrorId kCounterBothWays{2669};  ///< the counter of '{0}' goes up and down; a buffer's counter may do only one of the two
inline constexpr ErrorId kVertexAttribute{2684};  ///< {0} takes {1} here
inline constexpr ErrorId kWaveShaderModel{2685};  ///< '{0}' needs Shader Model {1}, and the target is {2}
inline constexpr ErrorId kWaveSize{2686};  ///< a wave cannot have {0} lanes; [WaveSize] takes 4, 8, 16, 32, 64 or 128
inline constexpr ErrorId kWaveSizeRange{2687};  ///< [WaveSize] has {0}; it takes a number of lanes or, from Shader Model 6.8 on, the least, the most and the preferred one, in range
inline constexpr ErrorId kSemanticNotThere{2688};  ///< '{0}' is not {1} of {2}
inline constexpr ErrorId kSystemValueType{2689};  ///< {0} must have type {1}, not '{2}'
inline constexpr ErrorId kSemanticTwice{2690};  ///< two {0} of {1} have the semantic {2}
inline constexpr ErrorId kSignatureType{2691};  ///< '{0}' of type '{1}' cannot be an input or output of {2}: only scalars, vectors and matrices of up to 32 bits, and arrays and structs of those, can
inline constexpr ErrorId kInterpolatedInteger{2692};  ///< '{0}' of type '{1}' is interpolated, but integer inputs of {2} can only be nointerpolation
inline constexpr ErrorId kClipDistances{2693};  ///< SV_ClipDistance and SV_CullDistance of {0} have {1} floats in {2} vectors; together at most 8 in 2 vectors are possible
inline constexpr ErrorId kSignatureVectors{2694};  ///< the {0} of {1} fill {2} vectors of four; the limit is {3}
inline constexpr ErrorId kOwnInitialiser{2695};  ///< variable '{0}' is used in its own initialiser, where it is zero
inline constexpr ErrorId kTargetNumber{2696};  ///< there is no SV_Target{0}: a pixel shader has {1} targets
inline constexpr ErrorId kSemanticNotOffered{2697};  ///< '{0}' of {1} is not offered here
inline constexpr ErrorId kSemanticIsValue{2698};  ///< '{0}' behind ':' is a semantic, so '{1}' is no bit field and has all bits of '{2}'; the width would be '({0})'
inline constexpr ErrorId kNoQuads{2699};  ///< '{0}' needs quads of threads, and compute shader '{1}' has [numthreads({2})]
inline constexpr ErrorId kInitialiserImport{2700};  ///< the initialiser of static '{0}' calls '{1}', which has no body in this library
inline constexpr ErrorId kImportParameter{2701};  ///< '{0}' has no body in this library, so parameter '{1}' cannot be an unbounded array
inline constexpr ErrorId kImportPayload{2702};  ///< a payload with access qualifiers is passed to '{0}', whose definition in another library may have other qualifiers
inline constexpr ErrorId kLinkedTypes{2703};  ///< '{0}' of {1} and its definition '{2}' in {3} do not fit: {4}
}  // namespace compiler

/// Section "Shaders compiled at run time" of rtapi/ERRORS.md.
namespace compiler {
inline constexpr ErrorId kNoCompiler{2750};  ///< no C++ compiler for shaders
inline constexpr ErrorId kCompilerFailed{2751};  ///< shader could not be built
inline constexpr ErrorId kShaderErrors{2752};  ///< shader does not compile
inline constexpr ErrorId kInterpreterFailed{2753};  ///< shader cannot be interpreted
inline constexpr ErrorId kNoCoverage{2754};  ///< library without coverage
inline constexpr ErrorId kCoverageFile{2755};  ///< coverage cannot be written
inline constexpr ErrorId kCoverageInterpreted{2756};  ///< code with coverage is interpreted
inline constexpr ErrorId kSpirvFailed{2760};  ///< SPIR-V could not be made
inline constexpr ErrorId kSpirvBindings{2761};  ///< too many bindings for SPIR-V
}  // namespace compiler

// clang-format on

}  // namespace rtapi::error_ids

// SPDX-License-Identifier: MIT
//
// A recorded command list: plain structures in order. Whatever the host passed was checked and
// copied when it was recorded; whatever is in GPU memory (tables, instance records, build inputs,
// descriptors) is read when the command executes. References to objects keep them alive until then.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <kaamos/shader/abi.h>
#include <rtapi/raytracing.h>
#include <rtapi/resource.h>
#include <rtapi/root_signature.h>
#include <rtapi/rtas_operations.h>

#include "runtime/backend/draw_commands.h"
#include "runtime/backend/planes.h"
#include "runtime/backend/queries.h"
#include "runtime/backend/root_bindings.h"

namespace kaamos::runtime {

class BackendBuffer;
class BackendTexture;
class BackendPipeline;
struct LinkedPipeline;
struct LinkedCompute;

struct DispatchRaysCommand {
  std::shared_ptr<BackendPipeline> pipeline;
  RootBindings state;
  rtapi::DispatchRaysDesc desc;
  uint64_t pipeline_stack_bytes = 0;  // as it was at record time [DXR: SetPipelineStackSize]
  std::shared_ptr<const LinkedPipeline> linked = nullptr;  // what `pipeline` was made from
};

struct DispatchCommand {
  std::shared_ptr<BackendPipeline> pipeline;
  RootBindings state;
  uint32_t groups[3] = {0, 0, 0};
  std::shared_ptr<const LinkedCompute> linked = nullptr;
};

// The source and destination of a command signature's arguments: byte offsets in a command of the
// argument buffer, and in RootArguments.
struct IndirectArgument {
  uint32_t source_offset = 0;
  uint32_t dest_offset = 0;
  uint32_t size_bytes = 0;
  uint32_t root_parameter = 0;  // for messages
  uint32_t view_alignment = 0;  // for addresses; 0: constants
};
// A VertexBufferView or IndexBufferView among the arguments.
struct IndirectBufferView {
  uint32_t source_offset = 0;
  bool of_indices = false;
  uint32_t slot = 0;  // of vertices
};
enum class IndirectWork : uint8_t { kDispatch, kDispatchRays, kDraw, kDrawIndexed };
struct IndirectLayout {
  std::vector<IndirectArgument> root_arguments;
  std::vector<IndirectBufferView> buffer_views;  // draws
  IndirectWork work = IndirectWork::kDispatch;
  uint32_t work_offset = 0;   // of the dispatch's or draw's own arguments in a command
  uint32_t packed_bytes = 0;  // all arguments of a command together
  uint32_t stride_bytes = 0;
};

// Dispatches or draws whose arguments are read when the command executes;
// runtime/backend/indirect.h turns it into plain ones. `arguments` has room for max_count commands,
// and `count` for a count.
struct ExecuteIndirectCommand {
  std::shared_ptr<const IndirectLayout> layout;
  uint32_t max_count = 0;
  std::shared_ptr<BackendBuffer> arguments;
  uint64_t arguments_offset = 0;
  std::shared_ptr<BackendBuffer> count;  // null: exactly max_count
  uint64_t count_offset = 0;
  std::shared_ptr<BackendPipeline> pipeline;
  RootBindings state;
  uint64_t pipeline_stack_bytes = 0;                                // for ray tracing pipelines
  std::shared_ptr<const LinkedPipeline> linked = nullptr;           // for ray tracing pipelines
  std::shared_ptr<const LinkedCompute> linked_compute = nullptr;    // for compute pipelines
  std::shared_ptr<const LinkedGraphics> linked_graphics = nullptr;  // for graphics pipelines
  std::shared_ptr<const DrawState> draw_state = nullptr;            // for graphics pipelines
};

// The inputs of an opacity micromap array.
struct MicromapInputs {
  std::vector<rtapi::RaytracingOpacityMicromapHistogramEntry> histogram;
  uint64_t input_buffer = 0;
  rtapi::GpuVirtualAddressAndStride descs = {};
};

struct BuildCommand {
  uint64_t dest = 0;
  uint64_t source = 0;  // 0 unless flags contain kPerformUpdate
  uint64_t scratch = 0;
  rtapi::RaytracingAccelerationStructureType type =
      rtapi::RaytracingAccelerationStructureType::kTopLevel;
  rtapi::RaytracingAccelerationStructureBuildFlags flags =
      rtapi::RaytracingAccelerationStructureBuildFlags::kNone;
  // Bottom level; all of one type, kTriangles also where micromaps are linked to them.
  std::vector<rtapi::RaytracingGeometryDesc> geometries;
  // The linkage of each geometry, if it has one; empty if none has.
  std::vector<std::optional<rtapi::RaytracingGeometryOmmLinkageDesc>> linkages;
  MicromapInputs micromaps;     // micromap array
  uint32_t instance_count = 0;  // top level
  rtapi::ElementsLayout instance_layout = rtapi::ElementsLayout::kArray;
  uint64_t instance_descs = 0;
  std::vector<rtapi::RaytracingAccelerationStructurePostbuildInfoDesc> postbuild_infos;
};

struct EmitPostbuildInfoCommand {
  rtapi::RaytracingAccelerationStructurePostbuildInfoDesc desc;
  std::vector<uint64_t> sources;
};

struct CopyAccelerationStructureCommand {
  uint64_t dest = 0;
  uint64_t source = 0;
  rtapi::RaytracingAccelerationStructureCopyMode mode =
      rtapi::RaytracingAccelerationStructureCopyMode::kClone;
};

// The desc that the inputs of an operation pointed to.
using RtasInputs =
    std::variant<rtapi::RtasPartitionedTlasInputsDesc, rtapi::RtasClusterTrianglesInputsDesc,
                 rtapi::RtasClasInputsDesc, rtapi::RtasClusterTemplateTrianglesInputsDesc,
                 rtapi::RtasInstantiateClusterTemplateInputsDesc, rtapi::RtasClusterMovesDesc>;

// An operation of ExecuteIndirectRTASOperations.
struct RtasOperation {
  RtasInputs inputs;
  rtapi::RtasPartitionedTlasOperationData partitioned = {};  // partitioned top levels
  rtapi::RtasBatchedOperationData batch = {};                // all others
};

// An instance of a partitioned top level.
struct RtasInstance {
  uint64_t bottom_level = 0;  // 0: inactive
  uint32_t contribution = 0;
  uint32_t mask = 0;
  uint32_t flags = 0;
};

// What an operation placed.
struct RtasResult {
  uint64_t address = 0;
  uint64_t size_bytes = 0;
  uint64_t source = 0;        // moves and partitioned top levels: its address
  bool bottom_level = false;  // of clusters
  rtapi::RaytracingAccelerationStructureBuildFlags flags = {};
  std::vector<uint64_t> clusters = {};   // the addresses of a new bottom level's clusters
  std::vector<uint64_t> micromaps = {};  // a cluster's or template's array
  // A partitioned top level. In checked mode only: its instances by InstanceIndex, and the indices
  // of those that were written or updated.
  bool top_level = false;
  std::vector<RtasInstance> instances = {};
  std::vector<uint32_t> written = {};
};

// Memory that an operation of a call read or wrote; `what` has static storage.
struct RtasAccess {
  uint64_t address = 0;
  uint64_t size_bytes = 0;
  uint32_t operation = 0;  // its number in the call
  bool written = false;
  const char* what = "";  // "cluster"
};

// What the last execution of a call did.
struct RtasResults {
  std::vector<RtasResult> placed;
  std::vector<RtasAccess> accesses;  // only in checked mode
};

// EXPERIMENTAL. Operations whose arguments are in GPU memory; runtime/operations reads them when
// the command executes.
struct RtasOperationsCommand {
  std::vector<RtasOperation> operations;
  std::shared_ptr<RtasResults> results = std::make_shared<RtasResults>();
};

struct CopyBufferCommand {
  std::shared_ptr<BackendBuffer> dest;
  uint64_t dest_offset = 0;
  std::shared_ptr<BackendBuffer> source;
  uint64_t source_offset = 0;
  uint64_t size_bytes = 0;
  bool immediate = false;  // of WriteBufferImmediate, which no predicate leaves out
};

// Exactly one of texture and buffer is set.
struct TextureCopyPlace {
  std::shared_ptr<BackendTexture> texture;
  uint32_t mip = 0;
  uint32_t array_element = 0;
  uint32_t plane = 0;  // Plane
  std::shared_ptr<BackendBuffer> buffer;
  uint64_t offset = 0;             // bytes up to texel (0,0,0) of the footprint
  uint32_t row_pitch = 0;          // bytes
  uint64_t slice_pitch = 0;        // bytes
  uint32_t origin[3] = {0, 0, 0};  // in elements: where the copy begins
};

// Copies `extent` elements from one place to another; at most one of them is a buffer. An element
// is a texel, or a block of a block-compressed texture. Checked: the copy is inside both, and the
// formats have elements of equal size.
struct CopyTextureCommand {
  TextureCopyPlace dest;
  TextureCopyPlace source;
  uint32_t extent[3] = {0, 0, 0};
  bool any_state = false;  // from a helper that takes resources in any state
};

// Reduces the samples of pixels of one texture to another's texels. Checked: the pixels are inside
// both, and both can be seen as `format`.
struct ResolveCommand {
  TextureCopyPlace dest;    // textures, of which only x and y of the origin count
  TextureCopyPlace source;  // the multisampled one
  uint32_t extent[2] = {0, 0};
  rtapi::Format format = rtapi::Format::kUnknown;
  rtapi::ResolveMode mode = rtapi::ResolveMode::kAverage;
};

// Writes every element of an unordered access view: a typed, raw or structured buffer, or a
// texture. Values are converted to the format as in HLSL's typed stores; raw and structured buffers
// take the DWORD values[0].
struct ClearUavCommand {
  shader::Descriptor view;
  bool whole = true;               // else `rects`: texels, or elements of a buffer's one row
  std::vector<rtapi::Rect> rects;  // not cut to the view; none of them is empty
  bool is_float = false;
  uint32_t values[4] = {0, 0, 0, 0};     // float: bit patterns
  std::shared_ptr<const void> resource;  // keeps it alive
};

// Orders everything before it against everything after it. A backend that runs commands one after
// another need not do anything.
struct BarrierCommand {
  enum class Kind : uint8_t { kUav, kTransition, kAccess } kind = Kind::kUav;
  std::shared_ptr<BackendBuffer> buffer;  // both null: all resources
  std::shared_ptr<BackendTexture> texture;
  rtapi::ResourceStates before = rtapi::ResourceStates::kCommon;
  rtapi::ResourceStates after = rtapi::ResourceStates::kCommon;
  uint32_t subresource = rtapi::kResourceBarrierAllSubresources;  // of the texture
  // kAccess: `after` has what the memory may be used for, kCommon: everything. Of textures,
  // `before` and `after` are the states of the layouts, unless any was there before.
  bool any_before = false;
  uint32_t mip_count = 0;  // 0: `subresource` counts; else a range from mip `subresource` on
  uint32_t first_layer = 0;
  uint32_t layer_count = 1;
  uint32_t first_plane = 0;
  uint32_t plane_count = 1;
};

struct EventCommand {
  bool begin = true;
  std::string name;
};

using Command =
    std::variant<DispatchRaysCommand, DispatchCommand, ExecuteIndirectCommand, BuildCommand,
                 EmitPostbuildInfoCommand, CopyAccelerationStructureCommand, RtasOperationsCommand,
                 CopyBufferCommand, CopyTextureCommand, ResolveCommand, ClearUavCommand,
                 BarrierCommand, EventCommand, DrawCommand, ClearTargetCommand, BeginQueryCommand,
                 EndQueryCommand, TimestampCommand, ResolveQueriesCommand, PredicationCommand>;

// Names the application's call, for messages: "DispatchRays".
const char* command_name(const Command& command);

}  // namespace kaamos::runtime

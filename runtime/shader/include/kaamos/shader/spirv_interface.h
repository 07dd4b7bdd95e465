// SPDX-License-Identifier: MIT
//
// The binary interface between the SPIR-V of a shader library and a Vulkan backend: what abi.h is
// for native code. One module per export, entry point "main", Vulkan 1.3. A module works with every
// root signature: specialization constants say which root argument feeds which register.
//
// Buffers, descriptor heaps, root arguments, shader records and acceleration structures are
// accessed by address (buffer_reference); only textures and samplers need Vulkan descriptors. Every
// struct here has the same layout in GLSL's `scalar` layout. Addresses are 0 or aligned to what
// they point to.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kaamos/shader/abi.h"

namespace kaamos::shader::spirv {

// ---------------------------------------------------------------------------------------------
// Descriptor set 0: unbounded arrays, partially bound, updated after bind. Shader variables of all
// image types alias the binding; Descriptor::address is the index into it.

inline constexpr uint32_t kSampledImageBinding = 0;  // Descriptors of kShaderResource access
inline constexpr uint32_t kStorageImageBinding = 1;  // kUnorderedAccess; no format qualifier but
                                                     // r32ui, r32i and r32f for atomics
inline constexpr uint32_t kSamplerBinding = 2;       // kSampler

// ---------------------------------------------------------------------------------------------
// Specialization constants, all uint32_t with default 0.

// Four for each binding of the library (LibraryDesc::bindings), whether or not the export reaches
// it: constant_id = binding * kConstantsPerBinding + one of these.
inline constexpr uint32_t kConstantsPerBinding = 4;
enum BindingConstant : uint32_t {
  // SlotSource | local << 8 | DescriptorKind << 16 | DescriptorAccess << 24. 0: unbound, which
  // reads as the null descriptor.
  kBindingSource = 0,
  kBindingOffset = 1,  // BindingSlot::argument_offset; kStaticSampler: the sampler's index
  kBindingIndex = 2,   // BindingSlot::descriptor_index
  // kDescriptorTable: descriptor_count; kRootConstants: size_bytes; kRootDescriptor: stride_bytes.
  kBindingCount = 3,
};
// Bits of Workaround.
inline constexpr uint32_t kWorkaroundsConstant = 0xFFFF0000u;
inline constexpr uint32_t kMaxTraceDepthConstant = 0xFFFF0001u;     // how deep traces may nest
inline constexpr uint32_t kMaxCallableDepthConstant = 0xFFFF0002u;  // callable calls, likewise
// If not 0, shaders count in DispatchFeedback::counts.
inline constexpr uint32_t kCountConstant = 0xFFFF0003u;
// Checked libraries: CheckEntry::shader.
inline constexpr uint32_t kShaderConstant = 0xFFFF0004u;
// How many words of payload the data of twins has (TwinData); at least 1.
inline constexpr uint32_t kTwinPayloadConstant = 0xFFFF0005u;
// If not 0, the pipeline allows opacity micromaps.
inline constexpr uint32_t kAllowMicromapsConstant = 0xFFFF0006u;
// Libraries with coverage (coverage.h): the low and the high half of the address of uint32_t[], one
// for each point, which shaders set to 1. 0: nobody listens.
inline constexpr uint32_t kCoverageLowConstant = 0xFFFF0007u;
inline constexpr uint32_t kCoverageHighConstant = 0xFFFF0008u;
// Pixel shaders: kTargetConstant + n for SV_Target n, how the driver converts to the target's
// format differently than D3D does. Four bytes, for the components from the lowest byte on; 0: it
// does not. The bits of an integer component, to whose range values are clamped; of a UNORM
// component, to whose steps values are rounded; kLimitedSnorm: values are limited to -1 to 1, and
// NaN is 0.
inline constexpr uint32_t kTargetConstant = 0xFFFF0010u;
inline constexpr uint32_t kLimitedSnorm = 128;
// Pixel shaders: samples of the targets; 0 stands for 1.
inline constexpr uint32_t kSampleCountConstant = 0xFFFF0018u;

// Driver faults that generated code works around; each is off unless its bit is set. The ids are
// those of the list in runtime/vulkan/README.md.
enum Workaround : uint32_t {
  // B1: a rejected ReportHit overwrites the committed hit's attributes: write them back.
  kRestoreAttributes = 1,
  // B3: a nested trace overwrites the hit builtins: copy them when the shader starts.
  kCopyHitBuiltins = 2,
  // B7: an accepted report does not update gl_RayTmaxEXT in an intersection shader: track it.
  kTrackReportedT = 4,
  // B11: a dispatch is cut into contiguous halves: let neighbouring launch rows alternate between
  // the halves of the image.
  kInterleaveRows = 8,
};

// ---------------------------------------------------------------------------------------------
// Memory

// The push constant block of every stage is a uint64_t, the address of this. Constant during the
// dispatch.
struct DispatchBlock {
  // [begin, end) of the current shader-visible heaps, arrays of Descriptor.
  uint64_t view_heap_begin = 0;
  uint64_t view_heap_end = 0;
  uint64_t sampler_heap_begin = 0;
  uint64_t sampler_heap_end = 0;
  uint64_t instances = 0;        // InstanceEntry[], indexed by gl_InstanceCustomIndexEXT
  uint64_t top_levels = 0;       // TopLevelEntry[top_level_mask + 1]
  uint64_t empty_top_level = 0;  // Vulkan's address of a top level that every ray misses
  uint64_t status = 0;           // DispatchFeedback
  uint32_t top_level_mask = 0;
  // The number of records in each of the bound tables. Larger indices become index `count`, a null
  // record that the backend puts after the last one.
  uint32_t miss_count = 0;
  uint32_t callable_count = 0;
  uint32_t hit_group_count = 0;
  // DispatchRaysDimensions, or the number of thread groups, of the whole dispatch. Large dispatches
  // run in parts: DispatchRaysIndex = base + the launch id.
  uint32_t dimensions[3] = {0, 0, 0};
  uint32_t base[3] = {0, 0, 0};
  uint32_t rows = 0;      // height of this part, for kInterleaveRows
  uint32_t reserved = 0;  // makes root_arguments a multiple of 16
  uint8_t root_arguments[512] = {};
  uint64_t twin_tables = 0;  // TwinTables, if a shader of the pipeline uses hit objects
  // uint64_t[], indexed by gl_InstanceCustomIndexEXT: the position table of each instance.
  uint64_t position_tables = 0;
  uint64_t prints = 0;       // the print buffer (printing.h); 0: there is none
  uint64_t print_bytes = 0;  // of all of it
};
static_assert(offsetof(DispatchBlock, root_arguments) == 112);
static_assert(offsetof(DispatchBlock, twin_tables) == 624);
static_assert(offsetof(DispatchBlock, position_tables) == 632);
static_assert(offsetof(DispatchBlock, prints) == 640);
static_assert(sizeof(DispatchBlock) == 656);

// Maps the HLSL value of an acceleration structure to Vulkan's. A hash table with open addressing:
// look at slot hash(address) & top_level_mask and at the following slots until you find `address`,
// or 0. With 0 the ray is traced against the empty top level, so that no byte at a wild address is
// read.
//   hash(address) = uint32_t(address >> 8) * 0x9E3779B1u >> 7
struct TopLevelEntry {
  uint64_t address = 0;  // as rtapi knows it
  uint64_t vulkan = 0;   // for accelerationStructureEXT(), of rays without opacity micromaps
  // The same for rays that use them; 0: there are none. Shaders decide the opacity of candidates,
  // so instances with micromaps have nothing that is opaque for the driver,
  uint64_t with_micromaps = 0;
  uint64_t all_candidates = 0;  // and no instance has, for rays with flags that depend on opacity
};
static_assert(sizeof(TopLevelEntry) == 32);
constexpr uint32_t top_level_hash(uint64_t address) {
  return (static_cast<uint32_t>(address >> 8) * 0x9E3779B1u) >> 7;
}

// InstanceIndex and InstanceID come from here. The driver may get the instances, and the primitives
// of a bottom level, in another order than the application gave them:
//   words = uint32_t[] at primitive_remap;
//   PrimitiveIndex = primitive_remap != 0 ? words[words[GeometryIndex] + gl_PrimitiveID]
//                                         : gl_PrimitiveID
struct InstanceEntry {
  uint64_t primitive_remap = 0;
  uint32_t instance_id = 0;
  uint32_t instance_index = 0;
  // GeometryMicromaps[] of the bottom level; 0 in top levels without opacity micromaps. Otherwise
  // shaders decide the opacity of every candidate.
  uint64_t micromaps = 0;
  uint32_t flags = 0;  // of the instance, as the application gave them
  uint32_t reserved = 0;
};
static_assert(sizeof(InstanceEntry) == 32);

// The opacity of a geometry's triangles or boxes.
struct GeometryMicromaps {
  uint64_t indices = 0;  // int32_t[] by PrimitiveIndex: a micromap, or a special index; 0: none
  // uint32_t count, 0; MicromapEntry[count]; the states, from multiples of 4 on. 0: there is none.
  uint64_t array = 0;
  uint32_t opaque = 0;  // the geometry's flag
  uint32_t reserved = 0;
};
static_assert(sizeof(GeometryMicromaps) == 24);
struct MicromapEntry {
  uint32_t offset_bytes = 0;  // of its states, from the array's start
  uint16_t level = 0;
  uint16_t format = 0;  // runtime::MicromapFormat
};
static_assert(sizeof(MicromapEntry) == 8);

// The position table of an instance whose bottom level was built with ALLOW_DATA_ACCESS is the
// address of uint32_t words:
//   p0, p1 and p2 of a triangle = the 9 floats from words[words[GeometryIndex] + 9 *
//   PrimitiveIndex]
// with the application's numbers. 0: its primitives are no triangles.
inline constexpr uint64_t kPositionsNotKept = 1;  // it was built without ALLOW_DATA_ACCESS

// The position table of an instance whose bottom level was built from clusters is the address of
// words, plus kClusterTable, and plus kPositionsNotKept without ALLOW_DATA_ACCESS. With the
// driver's numbers,
//   words[words[gl_GeometryIndexEXT] + n * gl_PrimitiveID]
// is the ID of the triangle's cluster, before its 9 floats unless they are not kept (n: 10 or 2).
// All of these are at multiples of 8 bytes, which leaves room for the marks.
// A hit's table is the address of the ID plus kClusterHit, and plus kPositionsNotKept likewise.
inline constexpr uint64_t kClusterTable = 6;
inline constexpr uint64_t kClusterHit = 2;
inline constexpr uint64_t kClusterMask = 6;  // the bits that tell the two from other tables

// The shader record as the driver sees it: this and nothing else, after the driver's handle. So the
// application's record can stay where it is, and the driver is free in its sizes and alignments.
//   layout(shaderRecordEXT, scalar) buffer Record { uint64_t local_arguments; };
// local_arguments: the address of byte 32 of the application's record; 0 in a null record.
struct RecordData {
  uint64_t local_arguments = 0;
};

// Shaders count TraceRay calls, those that only ask whether there is a hit, and invocations.
enum Count : uint32_t {
  kTraceRayCalls,
  kVisibilityRays,
  kAnyHitInvocations,
  kIntersectionInvocations,
  kClosestHitInvocations,
  kMissInvocations,
  kCallableInvocations,
  kCountCount
};

// Written by shaders, read after the dispatch.
struct DispatchFeedback {
  uint32_t removal_reason = 0;  // 0, or 1 + RemovalReason: the device is removed
  // 0, or 1 + (record << 1 | 1 if of the miss table): MaybeReorderThread got an object whose table
  // does not have its record.
  uint32_t reordered = 0;
  uint32_t counts[kCountCount][2] = {};  // low and high half; additions carry
  uint64_t unknown_structure = 0;        // one that rays were traced against in vain
  uint64_t checks = 0;                   // CheckState of a checked device; 0: nobody listens
};
static_assert(offsetof(DispatchFeedback, checks) == 72);

// The memory that shaders of checked libraries read, and where they write what they found.
struct CheckState {
  uint64_t ranges = 0;   // AddressRange[range_count], sorted by address
  uint64_t entries = 0;  // CheckEntry[kCheckEntries], a hash table, all zeros at first
  uint32_t range_count = 0;
  uint32_t max_recursion_depth = 0;
  uint64_t reached = 0;      // ReachedEntry[kReachedEntries], likewise
  uint32_t ran_nothing = 0;  // bits below; only rays without RAY_FLAG_SKIP_CLOSEST_HIT_SHADER
};
inline constexpr uint32_t kRayRanNothing = 1;
inline constexpr uint32_t kCallRanNothing = 2;
static_assert(offsetof(CheckState, ran_nothing) == 32);
inline constexpr uint32_t kCheckEntries = 256;
struct CheckEntry {
  uint32_t key = 0;  // 0: free
  uint32_t count = 0;
  CheckReport report;  // from one of `count` invocations
  uint32_t index[3] = {0, 0, 0};
  uint32_t shader = 0;  // kShaderConstant
  uint64_t reserved = 0;
};
static_assert(sizeof(CheckEntry) == 96);
static_assert(offsetof(CheckEntry, index) == 72);
inline constexpr uint32_t kReachedEntries = 1024;
struct ReachedEntry {
  uint32_t key = 0;     // 0: free
  uint32_t shader = 0;  // kShaderConstant
  ReachedCall call;
};
static_assert(sizeof(ReachedEntry) == 32);

// ---------------------------------------------------------------------------------------------
// Payloads, callable data and attributes
//
// Payloads and callable data are passed between stages as
//   struct { uint trace_depth_and_callable_depth; T data; }
// with the trace depth in the low and the callable depth in the high 16 bits: those of the shader
// that gets it, where ray generation has 0 and 0. A trace or call that would nest deeper than the
// constants above allow writes DispatchFeedback and does nothing.
//
// Attributes: vec2 if the HLSL type holds two 32-bit floats, otherwise uint[words].

// ---------------------------------------------------------------------------------------------
// Hit objects
//
// Vulkan has none, so HitObject::TraceRay is a ray query. What it calls while it traverses, and
// what HitObject::Invoke calls, are twins: a library of Shader Model 6.9 has each of its any-hit,
// intersection, closest-hit and miss shaders a second time, as a callable shader. ExportDesc::spirv
// is then followed by the module of the twin, the number of its words, and kTwinMark, all of which
// spirv_words counts.
inline constexpr uint32_t kTwinMark = 0x4E495754u;  // no module ends with it

struct SpirvPair {
  const uint32_t* words = nullptr;
  uint32_t count = 0;
  const uint32_t* twin = nullptr;  // null: there is none
  uint32_t twin_count = 0;
};
inline SpirvPair spirv_pair(const uint32_t* words, uint32_t count) {
  SpirvPair out = {words, count};
  if (words == nullptr || count < 3 || words[count - 1] != kTwinMark) return out;
  out.twin_count = words[count - 2];
  out.count = count - 2 - out.twin_count;
  out.twin = words + out.count;
  return out;
}
inline SpirvPair spirv_pair(const ExportDesc& code) {
  return spirv_pair(code.spirv, code.spirv_words);
}

// The data of a twin is
//   struct { uint depths; uint control; uint type; uint bytes; HitObject hit;
//            uint payload[kTwinPayloadConstant]; }
// with the depths of payloads below, a word for each scalar of the payload (two for 64 bits), and
// type and bytes of the payload in checked libraries.
enum TwinControl : uint32_t {
  kTwinIgnored = 1,   // by an any-hit shader
  kTwinEnded = 2,     // the search ends
  kTwinAccepted = 4,  // by an intersection shader: the hit it leaves in the data
  kTwinOpaque = 8,    // for an intersection shader: its hits run no any-hit shader
};

// Where the twins of records are in the driver's callable table, in which they follow the
// callables: three for each record of the hit group table (any-hit, intersection, closest-hit),
// then one for each record of the miss table. Also the application's two tables themselves, hit
// groups first.
struct TwinTables {
  uint32_t first = 0;
  uint32_t last_hit = 0;   // larger indices become this one, a null record
  uint32_t last_miss = 0;  // likewise
  uint32_t ray_flags = 0;  // of the pipeline, for every ray
  uint64_t address[2] = {0, 0};
  uint64_t size_bytes[2] = {0, 0};
  uint64_t stride_bytes[2] = {0, 0};
};
static_assert(sizeof(TwinTables) == 64);

// ---------------------------------------------------------------------------------------------
// Vertex and pixel shaders
//
// Input i of a vertex shader (GraphicsDesc::inputs) is at location i, but SV_VertexID and
// SV_InstanceID, which are built in. Output i of a vertex shader is at location i, but SV_Position.
// SV_RenderTargetArrayIndex, SV_ViewportArrayIndex, SV_ClipDistance and SV_CullDistance are built
// in too: those at their locations are for the pixel shader, as they were written. gl_Layer is 0
// for an index that is not below DispatchBlock::dimensions[0], the slices of the targets.
//
// Input i of a pixel shader is at location i, but SV_Position, SV_PrimitiveID and SV_IsFrontFace.
// The two were compiled alone: relocate_inputs() (spirv_locations.h) gives a pixel shader's inputs
// the locations of the vertex shader's outputs with the same semantics. SV_Barycentrics is a
// location like any other, which the backend has to feed.
//
// Output SV_Target n is at location n, prepared as kTargetConstant + n says. An SV_Depth that is
// not a number becomes the float whose bits are DispatchBlock::base[0], the lower end of the
// viewport's range; all others leave as they are.
//
// Device features: shaderDrawParameters (base vertex and instance); by use shaderClipDistance,
// shaderCullDistance, shaderOutputLayer, shaderOutputViewportIndex, geometryShader
// (SV_PrimitiveID), shaderDemoteToHelperInvocation, vertexPipelineStoresAndAtomics,
// fragmentStoresAndAtomics.

}  // namespace kaamos::shader::spirv

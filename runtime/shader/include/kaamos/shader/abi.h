// SPDX-License-Identifier: MIT
//
// The binary interface between compiled shader code and a backend that runs native code.
//
// A shader library becomes one object with one table (LibraryDesc). A backend calls its entry
// points with an Invocation; the shader calls back through the function pointers in Services.
// Nothing here depends on a compiler's library, so a library compiled at run time needs no symbol
// from its host.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kaamos/shader/graphics.h"
#include "kaamos/shader/printing.h"

namespace kaamos::shader {

// Must change whenever a struct below changes. Loading refuses a library of another version.
inline constexpr uint32_t kAbiVersion = 19;

inline constexpr uint32_t kUnbounded = 0xFFFFFFFFu;

// ---------------------------------------------------------------------------------------------
// Descriptors

enum class DescriptorKind : uint16_t {
  kNull = 0,  // reads give 0, writes are dropped, rays against it as an acceleration structure miss
  kConstantBuffer = 1,
  kRawBuffer = 2,         // (RW)ByteAddressBuffer
  kStructuredBuffer = 3,  // stride_bytes comes from the view
  kTypedBuffer = 4,       // (RW)Buffer<T>, TextureBuffer<T>: format is a DXGI_FORMAT
  kTexture = 5,           // address: the backend's view object
  kSampler = 6,           // address: the backend's sampler object
  kAccelerationStructure = 7,
};

enum class DescriptorAccess : uint16_t { kShaderResource = 0, kUnorderedAccess = 1, kOther = 2 };

// One slot of a descriptor heap: plain bytes that may be copied freely. An HLSL resource variable
// holds one, too. A GPU descriptor handle is the address of such a slot.
struct alignas(8) Descriptor {
  DescriptorKind kind = DescriptorKind::kNull;
  DescriptorAccess access = DescriptorAccess::kShaderResource;
  uint32_t stride_bytes = 0;  // structured buffers; for textures: texture_shape() of the view
  uint64_t address = 0;       // GPU virtual address, or the backend's object
  uint64_t size_bytes = 0;    // buffers: reads and writes at or past it are out of bounds
  uint32_t format = 0;        // DXGI_FORMAT of typed buffers and textures; or counter_address()
  // 0 in a heap. In a shader of a checked library: 1 + the library's binding that it came from,
  // plus kFromRoot for a root descriptor, whose size_bytes extends to the end of its allocation.
  uint32_t origin = 0;
};
static_assert(sizeof(Descriptor) == 32);

// The shape that a view and an HLSL declaration must have in common: D3D12_SRV_DIMENSION, and the
// type of numbers, 0 float (also normalized ones), 1 signed, 2 unsigned.
constexpr uint32_t texture_shape(uint32_t dimension, uint32_t number_class) {
  return dimension | number_class << 8;
}
// Returns whether a texture declared as `declared`, 0 if that is unknown, can read a view. An array
// and a single one fit each other: the declaration without an element reads the view's first, and a
// view without elements has one.
constexpr bool fits_shape(uint32_t view, uint32_t declared) {
  if (view == declared || declared == 0) return true;
  const uint32_t low = view < declared ? view : declared;
  const uint32_t single = low & 0xFF;
  return view + declared == 2 * low + 1 &&
         (single == 2 || single == 4 || single == 6 || single == 9);
}
// The unordered access view of a structured buffer may have a counter of 4 bytes. `format` has bits
// 2 to 33 of its address, and `access` the others above its own two bits; 0: there is none.
constexpr DescriptorAccess view_access(const Descriptor& descriptor) {
  return static_cast<DescriptorAccess>(static_cast<uint16_t>(descriptor.access) & 3u);
}
constexpr uint64_t counter_address(const Descriptor& descriptor) {
  if (descriptor.kind != DescriptorKind::kStructuredBuffer) return 0;
  const uint64_t upper = static_cast<uint16_t>(descriptor.access) >> 2;
  return (upper << 32 | descriptor.format) << 2;
}
constexpr void set_counter(Descriptor& descriptor, uint64_t address) {
  descriptor.format = static_cast<uint32_t>(address >> 2);
  descriptor.access = static_cast<DescriptorAccess>(static_cast<uint16_t>(view_access(descriptor)) |
                                                    static_cast<uint16_t>(address >> 34 << 2));
}

inline constexpr uint32_t kFromRoot = 0x80000000u;

// ---------------------------------------------------------------------------------------------
// Bindings: which root argument feeds which HLSL register. Fixed when a state object is created.

enum class SlotSource : uint8_t {
  kUnbound = 0,      // this export does not use the binding, so it is never read
  kRootConstants,    // the arguments themselves: size_bytes bytes at argument_offset
  kRootDescriptor,   // an 8-byte GPU virtual address at argument_offset; no bounds [D3D12]
  kDescriptorTable,  // an 8-byte GPU descriptor handle at argument_offset
  kStaticSampler,    // static_sampler
};

struct BindingSlot {
  SlotSource source = SlotSource::kUnbound;
  bool local = false;  // arguments are in the shader record; otherwise in the dispatch
  DescriptorKind kind = DescriptorKind::kNull;  // root descriptors: as the HLSL declares it
  DescriptorAccess access = DescriptorAccess::kShaderResource;
  uint32_t argument_offset = 0;  // bytes; local ones count from byte 32 of the record
  uint32_t descriptor_index =
      0;  // first descriptor of the binding, counted from the table's handle
  uint32_t descriptor_count = 0;  // how many descriptors it has in its range; or kUnbounded
  uint32_t size_bytes = 0;        // kRootConstants
  // Structured buffers: the HLSL element's size; textures: texture_shape() of the declaration.
  uint32_t stride_bytes = 0;
  const Descriptor* static_sampler = nullptr;
};

// ---------------------------------------------------------------------------------------------
// Dispatches and invocations

struct Services;

// In AddressRange an allocation is its memory, and a view of a live texture is one byte at its
// view_key().
constexpr uint64_t view_key(uint64_t address, bool unordered_access) {
  return address | (unordered_access ? uint64_t{1} << 62 : 0);
}
struct AddressRange {
  uint64_t address = 0;
  uint64_t size_bytes = 0;
};

// One per DispatchRays or Dispatch, shared by all its threads and constant while it runs.
struct DispatchConstants {
  const Services* services = nullptr;
  const uint8_t* root_arguments = nullptr;  // laid out by the global root signature
  uint32_t dimensions[3] = {0, 0, 0};       // DispatchRaysDimensions; thread groups for compute
  // [begin, end) of the current shader-visible heaps: a descriptor outside them reads as null.
  const Descriptor* view_heap_begin = nullptr;
  const Descriptor* view_heap_end = nullptr;
  const Descriptor* sampler_heap_begin = nullptr;
  const Descriptor* sampler_heap_end = nullptr;
  void* backend = nullptr;  // the backend's own dispatch state
  // For checked libraries: every allocation and every view of a texture, sorted by address. Both
  // null: root descriptors have no bounds.
  const AddressRange* ranges_begin = nullptr;
  const AddressRange* ranges_end = nullptr;
  uint32_t max_recursion_depth = 0xFFFFFFFFu;  // for checked libraries
  // A raw buffer for unordered access (printing.h); null: printf prints nothing.
  Descriptor prints;
  // True if shaders may read and write texels directly through a descriptor's TextureView;
  // otherwise only the services know what a texture's address stands for.
  bool direct_texels = false;
};

// HLSL's RayDesc. [DXR: RayDesc structure]
struct RayDesc {
  float origin[3];
  float t_min;
  float direction[3];
  float t_max;
};
static_assert(sizeof(RayDesc) == 32);

// The values that the system-value intrinsics return in one ray shader invocation. A miss shader
// may use only the first three. Without initialisers, because TraceRay makes one for each ray.
struct RaySystemValues {
  RayDesc ray;      // WorldRayOrigin, WorldRayDirection, RayTMin; t_max is RayDesc.TMax
  float t_current;  // RayTCurrent, by stage [DXR: RayTCurrent]
  uint32_t ray_flags;
  uint32_t hit_kind;
  uint32_t instance_index;
  uint32_t instance_id;
  uint32_t geometry_index;
  uint32_t primitive_index;
  const float* object_to_world;  // 3x4, row-major
  const float* world_to_object;  // 3x4, row-major
};

struct BoundResource;

// One shader invocation. Lives on the backend's stack during the call.
struct Invocation {
  const DispatchConstants* dispatch = nullptr;
  const BindingSlot* slots = nullptr;  // this export's, indexed by the library's binding index
  const uint8_t* local_arguments = nullptr;  // byte 32 of the shader record
  const RaySystemValues* ray = nullptr;      // null in ray generation, callable and compute
  uint32_t index[3] = {0, 0, 0};             // DispatchRaysIndex
  uint32_t depth = 0;                        // ray generation is 0 [DXR: Ray recursion limit]
  void* backend = nullptr;                   // the backend's state of this call chain
  // Indexed like `slots`, filled by bind() (bound.h); required by kExportReadsBound.
  const BoundResource* bound = nullptr;
};

struct WaveCall;  // wave_op.h

// One thread group of a compute dispatch.
struct ComputeGroup {
  uint32_t group_id[3] = {0, 0, 0};
  uint32_t wave_lanes = 8;
  void* shared = nullptr;  // groupshared memory, ComputeDesc::shared_bytes, zeroed by the backend
  void* backend = nullptr;
  uint32_t threads = 1;  // of the group
};

enum class AnyHitResult : uint32_t { kAccept = 0, kIgnore = 1, kAcceptAndEndSearch = 2 };
enum class ReportHitResult : uint32_t { kRejected = 0, kAccepted = 1, kEndSearch = 2 };

using RayGenerationFn = void (*)(Invocation&);
// Runs `count` invocations, along x from Invocation::index on. May leave any index behind.
using RayGenerationRowFn = void (*)(Invocation&, uint32_t count);
using MissFn = void (*)(Invocation&, void* payload);
using ClosestHitFn = void (*)(Invocation&, void* payload, const void* attributes);
using AnyHitFn = AnyHitResult (*)(Invocation&, void* payload, const void* attributes);
using IntersectionFn = void (*)(Invocation&);
using CallableFn = void (*)(Invocation&, void* data);
// Runs a whole group: for kernels without barriers, and for those split at their barriers.
using ComputeGroupFn = void (*)(Invocation&, ComputeGroup&);
// Runs one thread of a group on its own fiber; barriers go through Services::group_barrier.
using ComputeThreadFn = void (*)(Invocation&, ComputeGroup&, const uint32_t thread_id[3]);
// Runs threads [first, first + kLanes) of a group at once, for kernels with wave operations; if a
// wave has more lanes, on their own fiber.
using ComputeLanesFn = void (*)(Invocation&, ComputeGroup&, uint32_t first);
using AnyFn = void (*)();

// ---------------------------------------------------------------------------------------------
// Calls from a shader to its backend

struct TraceRayArguments {
  uint64_t acceleration_structure;  // GPU virtual address; every ray misses 0
  uint32_t ray_flags;
  uint32_t instance_inclusion_mask;               // only the low 8 bits count
  uint32_t ray_contribution_to_hit_group_index;   // only the low 4 bits count
  uint32_t multiplier_for_geometry_contribution;  // only the low 4 bits count
  uint32_t miss_shader_index;                     // only the low 16 bits count
  uint32_t payload_bytes;                         // storage size, sizeof in the emitted code
};

// Half a RayDesc: origin and t_min, or direction and t_max. TraceRay takes them in registers:
// through memory, one side would wait for the other's stores with every ray.
using RayLanes [[gnu::vector_size(16)]] = float;
inline RayLanes origin_t_min(const RayDesc& ray) {
  return RayLanes{ray.origin[0], ray.origin[1], ray.origin[2], ray.t_min};
}
inline RayLanes direction_t_max(const RayDesc& ray) {
  return RayLanes{ray.direction[0], ray.direction[1], ray.direction[2], ray.t_max};
}

// Invocations of a row that run at once [wide.h]: lane i is i further along x than lane 0.
inline constexpr int kLanes = 8;
static_assert(kLanes == kGraphicsLanes);

// Their rays, side by side.
struct LaneRays {
  float origin[3][kLanes];
  float t_min[kLanes];
  float direction[3][kLanes];
  float t_max[kLanes];
};
inline RayLanes origin_t_min(const LaneRays& rays, int lane) {
  return RayLanes{rays.origin[0][lane], rays.origin[1][lane], rays.origin[2][lane],
                  rays.t_min[lane]};
}
inline RayLanes direction_t_max(const LaneRays& rays, int lane) {
  return RayLanes{rays.direction[0][lane], rays.direction[1][lane], rays.direction[2][lane],
                  rays.t_max[lane]};
}

// Texel data is four 32-bit values: float, int32_t or uint32_t, by the view's format class.
struct Texel {
  uint32_t bits[4];
};

struct SampleArguments {
  const Descriptor* texture;
  const Descriptor* sampler;
  float coordinates[4];  // as in HLSL's location argument; unused ones are 0
  int32_t offset[3];     // texel offset
  float lod;             // SampleLevel; does not include the sampler's mip bias
  float ddx[3];          // SampleGrad
  float ddy[3];
  float min_lod;       // clamp argument; 0 if there is none
  float comparison;    // SampleCmp*, GatherCmp*
  uint32_t component;  // Gather: 0 red .. 3 alpha
};

struct TextureDimensions {
  uint32_t width;
  uint32_t height;
  uint32_t depth_or_elements;
  uint32_t mip_count;
};

enum class RemovalReason : uint32_t {
  kRecursionDepth,
  kStackOverflow,
  kFault,
  kOther,
  kStepLimit,  // interpreted shaders only
  kMultisampled,
};

// ---------------------------------------------------------------------------------------------
// Inline ray tracing [DXR: RayQuery]. Plain bytes, because a shader may be left by a jump and the
// object may be moved between two calls.

struct ClusterTriangle;  // triangle_positions.h

// The state of a candidate or of the committed hit.
struct RayQueryHit {
  uint32_t type = 0;  // CANDIDATE_TYPE, COMMITTED_STATUS
  float t = 0;        // committed: RayDesc.TMax as long as nothing is committed
  uint32_t instance_index = 0;
  uint32_t instance_id = 0;
  uint32_t instance_contribution = 0;
  uint32_t geometry_index = 0;
  uint32_t primitive_index = 0;
  float barycentrics[2] = {0, 0};
  bool front_face = false;
  bool non_opaque = false;                 // procedural candidates
  const float* object_to_world = nullptr;  // 3x4, row-major
  const float* world_to_object = nullptr;
  const ClusterTriangle* cluster = nullptr;  // of a triangle in a cluster; null: it is in none
};

// A candidate that the backend has found but the shader has not seen yet. Geometry and primitive
// are the backend's numbers, which differ from the application's in clusters.
struct RayQueryFound {
  float t;  // boxes: none of their hits can be nearer
  uint32_t instance;
  uint32_t geometry;
  uint32_t primitive;
  float barycentrics[2];
  bool procedural;
  bool non_opaque;
  bool front_face;
};

struct RayQuery {
  static constexpr uint32_t kChunk = 8;

  RayQuery() {}  // does not clear `found`: only found[next..count) is ever read

  RayDesc ray = {};
  uint32_t ray_flags = 0;  // including the template's
  uint32_t inclusion_mask = 0;
  bool has_candidate = false;  // the last Proceed returned true
  bool ended = true;           // the next Proceed returns false
  RayQueryHit candidate;
  RayQueryHit committed;
  // For the backend.
  const void* scene = nullptr;
  bool searched = false;  // the first search has run
  uint32_t next = 0;
  uint32_t count = 0;
  float next_left_out = 0;  // t of the nearest candidate that found no room; infinity: none
  RayQueryFound found[kChunk];
};

struct RayQueryArguments {
  uint64_t acceleration_structure;  // GPU virtual address; every ray misses 0
  uint32_t ray_flags;
  uint32_t instance_inclusion_mask;  // only the low 8 bits count
};

// ---------------------------------------------------------------------------------------------
// Hit objects [DXR: HitObject]. Plain words without padding, as the compiler lays out its struct
// dx::HitObject: a value that shaders copy.

enum HitObjectState : uint32_t { kHitObjectNop = 0, kHitObjectHit = 1, kHitObjectMiss = 2 };

inline constexpr uint32_t kHitAttributeWords = 8;  // D3D12_RAYTRACING_MAX_ATTRIBUTE_SIZE_IN_BYTES

struct HitObject {
  uint32_t state = kHitObjectNop;
  uint32_t ray_flags = 0;  // as given to TraceRay
  float origin[3] = {0, 0, 0};
  float t_min = 0;
  float direction[3] = {0, 0, 0};
  float t = 0;  // a miss: RayDesc.TMax
  uint32_t instance_index = 0;
  uint32_t instance_id = 0;
  uint32_t geometry_index = 0;
  uint32_t primitive_index = 0;
  uint32_t hit_kind = 0;
  uint32_t is_bound = 0;  // to a record
  uint32_t record = 0;    // its index in the hit group table or the miss table
  uint32_t attributes[kHitAttributeWords] = {};
  float object_to_world[12] = {};  // 3x4, row-major; of a hit only, as the next
  float world_to_object[12] = {};
};
static_assert(sizeof(HitObject) == 196);

// ---------------------------------------------------------------------------------------------
// Checked libraries look for what DXR leaves undefined, at each instruction, and report it.

enum class Finding : uint32_t {
  kNone = 0,
  // Buffers. Values: address of the view, offset, bytes accessed, bytes available.
  kOutOfBounds,   // for a root descriptor
  kNotAllocated,  // a root descriptor's address is in no buffer
  kMisaligned,    // value 3: the required alignment
  // Descriptors. Values: index, limit.
  kOutsideBinding,   // an index past the end of the binding
  kOutsideHeap,      // a handle, or an index into the heap; values: address or index, descriptors
  kWrongDescriptor,  // values: kind and access found, kind and access declared
  // Rays. Values: bits of origin, TMin, direction, TMax, two to a value.
  kRayNotANumber,
  kRayInterval,      // TMin < 0, or TMin > TMax
  kRayFlags,         // values: the flags
  kQueryFlags,       // the same for a RayQuery, which must not skip closest-hit shaders either
  kRecursion,        // values: depth of the caller, depth declared
  kHitKind,          // values: as given to ReportHit
  kPayloadMismatch,  // values: bytes the caller passed, bytes the shader expects, 1: callable data
  // RayQuery. Values: QueryValue or QueryOp of the IR, CANDIDATE_TYPE or COMMITTED_STATUS
  kNoCandidate,       // a missing candidate, or one of another type, was read or committed
  kNoCommittedHit,    // hit data were read without a hit
  kCommitOutOfRange,  // values: bits of t, of TMin and of the committed t
  kStaleView,         // a descriptor in an array whose resource is gone; values: address, kind
  kCount
};

struct CheckReport {
  Finding finding = Finding::kNone;
  uint32_t site = 0;             // index into LibraryDesc::files << 20 | line; line 0: unknown
  uint32_t binding = 0;          // 1 + index into LibraryDesc::bindings; 0: none
  uint32_t write = 0;            // 1: a write, 2: an atomic
  uint64_t local_arguments = 0;  // those of the shader's record; 0: none
  uint64_t values[5] = {};
};
static_assert(sizeof(CheckReport) == 64);
constexpr uint32_t make_site(uint32_t file, uint32_t line) {
  return (file < 0xFFFu ? file : 0xFFFu) << 20 | (line < 0xFFFFFu ? line : 0);
}

// A call whose arguments are not all constants in the shader, so that only now it is known what it
// reaches; or a TraceRayInline that lacks a permission for what it may reach.
enum class ReachedBy : uint32_t {
  kTraceRay,
  kTraceRayInline,
  kCallShader,
  kTraceRayInlineKnown,  // the structure was known
};
struct ReachedCall {
  uint64_t acceleration_structure = 0;
  ReachedBy by = ReachedBy::kTraceRay;
  uint32_t site = 0;       // as in CheckReport
  uint32_t ray_flags = 0;  // TraceRayInline: with the RayQuery's permissions
  // TraceRay: mask | contribution << 8 | multiplier << 12 | miss index << 16; CallShader: the
  // index.
  uint32_t indices = 0;

  bool operator==(const ReachedCall&) const = default;
};
static_assert(sizeof(ReachedCall) == 24);

struct Services {
  void (*trace_ray)(Invocation&, const TraceRayArguments&, void* payload, RayLanes origin_t_min,
                    RayLanes direction_t_max);
  // The same for the lanes whose bits are set, in order. Invocation::index must be that of lane 0
  // and is undefined afterwards. `payloads`: kLanes times TraceRayArguments::payload_bytes.
  void (*trace_rays)(Invocation&, const TraceRayArguments&, void* payloads, const LaneRays&,
                     uint32_t lanes);
  ReportHitResult (*report_hit)(Invocation&, float t, uint32_t hit_kind, const void* attributes,
                                uint32_t attribute_bytes);
  void (*call_shader)(Invocation&, uint32_t shader_index, void* data, uint32_t data_bytes);

  // TraceRay without the closest-hit and miss shaders: `hit` is what they would have run for.
  void (*trace_hit_object)(Invocation&, const TraceRayArguments&, void* payload,
                           RayLanes origin_t_min, RayLanes direction_t_max, HitObject& hit);
  // Runs the closest-hit or miss shader of the record that the object is bound to.
  void (*invoke_hit_object)(Invocation&, const HitObject&, void* payload, uint32_t payload_bytes);
  // The DWORD at `offset` of the local root arguments of the object's record; 0 if it has none.
  uint32_t (*record_constant)(Invocation&, const HitObject&, uint32_t offset);

  // TraceRayInline and Proceed; everything else works without the backend (ray_query.h).
  void (*begin_query)(Invocation&, RayQuery&, const RayQueryArguments&, const RayDesc&);
  bool (*proceed)(Invocation&, RayQuery&);

  Texel (*sample_level)(const SampleArguments&);
  Texel (*sample_gradient)(const SampleArguments&);
  float (*sample_compare_level)(const SampleArguments&);
  // The level that sample_gradient takes, before the sampler's bias and clamps.
  float (*level_of_detail)(const SampleArguments&);
  Texel (*gather)(const SampleArguments&);
  Texel (*gather_compare)(const SampleArguments&);
  // coordinates: x, y, z or array element, mip level. Out of bounds, loads give 0 and stores do
  // nothing. [D3D11.3 7.18]
  Texel (*load_texel)(const Descriptor& texture, const int32_t coordinates[4]);
  void (*store_texel)(const Descriptor& texture, const int32_t coordinates[4], const Texel& value);
  Texel (*load_typed)(const Descriptor& buffer, uint32_t element);
  void (*store_typed)(const Descriptor& buffer, uint32_t element, const Texel& value);
  // For atomics on `bytes`: 4 in R32 formats, 8 in R32G32_UINT and R32G32_SINT. Null in another
  // format, and out of bounds.
  void* (*texel_address)(const Descriptor& texture, const int32_t coordinates[4], uint32_t bytes);
  void* (*typed_address)(const Descriptor& buffer, uint32_t element, uint32_t bytes);
  TextureDimensions (*texture_dimensions)(const Descriptor& texture, uint32_t mip);

  void (*group_barrier)(ComputeGroup&);  // only used with fibers
  // Returns once the lanes that take part have come to the operation. Only used with fibers, or if
  // the operation waits for no other thread.
  void (*wave)(ComputeGroup&, const WaveCall&);
  void (*remove_device)(Invocation&, RemovalReason);
  void (*report)(Invocation&, const CheckReport&);   // null: nobody listens
  void (*reached)(Invocation&, const ReachedCall&);  // null: nobody listens
};

// ---------------------------------------------------------------------------------------------
// A library

// The values of D3D12_SHADER_VERSION_TYPE.
enum class Stage : uint32_t {
  kPixel = 0,
  kVertex = 1,
  kGeometry = 2,
  kCompute = 5,
  kLibrary = 6,  // an exported function that is not an entry point
  kRayGeneration = 7,
  kIntersection = 8,
  kAnyHit = 9,
  kClosestHit = 10,
  kMiss = 11,
  kCallable = 12,
};

enum class RegisterClass : uint32_t {
  kShaderResource = 0,
  kUnorderedAccess = 1,
  kConstantBuffer = 2,
  kSampler = 3
};

enum class BindingType : uint32_t {
  kConstantBuffer,
  kRawBuffer,
  kStructuredBuffer,
  kTypedBuffer,
  kTexture,
  kSampler,
  kComparisonSampler,
  kAccelerationStructure,
};

struct BindingDesc {
  const char* name;
  RegisterClass register_class;
  BindingType type;
  uint32_t register_index;
  uint32_t space;
  uint32_t count;  // 1, the array's size, or kUnbounded
  // Constant buffers: bytes; structured buffers: element stride; textures: texture_shape().
  uint32_t size_bytes;
  bool automatic;  // the compiler assigned the register; the source does not
};

enum ExportFlags : uint32_t {
  kExportTraces = 1,               // can reach TraceRay
  kExportCalls = 2,                // can reach CallShader
  kExportUsesViewHeap = 4,         // ResourceDescriptorHeap[]
  kExportUsesSamplerHeap = 8,      // SamplerDescriptorHeap[]
  kExportUsesRayQuery = 32,        // TraceRayInline
  kExportQualifiedPayload = 64,    // shader model 6.7+: not limited by MaxPayloadSizeInBytes
  kExportReadsHitKind = 16,        // HitKind; without it a closest-hit shader may see any value
  kExportReadsBound = 128,         // Invocation::bound must have the bindings of the export
  kExportUsesHitObject = 512,      // dx::HitObject
  kExportIgnoresAttributes = 256,  // a hit shader that declares attributes and reads none of them
};

struct ComputeDesc {
  uint32_t thread_group[3];
  uint32_t shared_bytes;
  ComputeGroupFn group;    // null if barriers could not be split; then thread is run on fibers
  ComputeThreadFn thread;  // null if group or lanes is set
  ComputeLanesFn lanes = nullptr;
  bool has_waves = false;  // then group is null
  // Lanes that a wave must have, and may have; 0: any.
  uint32_t least_wave_lanes = 0;
  uint32_t most_wave_lanes = 0;
};

inline constexpr uint32_t kUnknownIndex = 0xFFFFFFFFu;

// One TraceRay that an export can reach, with those of its arguments that are constants; the others
// are 0.
enum TraceCallBits : uint32_t {
  kKnowsRayFlags = 1,
  kKnowsMask = 2,
  kKnowsRayContribution = 4,
  kKnowsMultiplier = 8,
  kKnowsMissIndex = 16,
};
struct TraceCall {
  uint32_t known;    // TraceCallBits
  uint32_t binding;  // for the acceleration structure, or kUnknownIndex
  uint32_t ray_flags;
  uint32_t mask;
  uint32_t ray_contribution;
  uint32_t multiplier;
  uint32_t miss_index;
  uint32_t line;  // its line in the HLSL source
  const char* file;
};

struct ExportDesc {
  const char* name;          // as written
  const char* mangled_name;  // as DXC would mangle it
  Stage stage;
  AnyFn entry;                 // has the stage's function type; null for kLibrary and kCompute
  const ComputeDesc* compute;  // null unless kCompute
  uint32_t
      payload_bytes;  // each scalar as 4 bytes [DXR: D3D12_RAYTRACING_SHADER_CONFIG]; callables: 0
  uint32_t payload_storage_bytes;
  uint32_t attribute_bytes;
  uint32_t callable_data_bytes;  // callables: size of their parameter
  uint32_t stack_bytes;          // what GetShaderStackSize reports
  uint32_t flags;                // ExportFlags
  const uint32_t* bindings;      // indices into LibraryDesc::bindings that the export can reach
  uint32_t binding_count;
  // The same shader for Vulkan (spirv_interface.h); null if the library was built without it.
  const uint32_t* spirv = nullptr;
  uint32_t spirv_words = 0;
  // For checked mode.
  const TraceCall* trace_calls = nullptr;
  uint32_t trace_call_count = 0;
  const uint32_t* callable_indices = nullptr;  // or kUnknownIndex; kLibrary: callers
  uint32_t callable_index_count = 0;
  // The memory layout of the payload (or callable data) and of the attributes: "float3 color 0;uint
  // depth 12;", type, name and byte offset of each scalar, vector and matrix, bool in 1 byte,
  // matrices row by row. Null: unknown. For people to read; nothing depends on it.
  const char* payload_layout = nullptr;
  const char* attribute_layout = nullptr;
  // Hash of the attributes' scalars in order: those that ReportHit passes or that the parameter
  // has. 0: none, or unknown; 1: several types are reported.
  uint32_t attribute_type = 0;
  RayGenerationRowFn row = nullptr;        // ray generation; null: only `entry` runs it
  const char* root_signature = nullptr;    // text of [RootSignature]; null: the export has none
  const GraphicsDesc* graphics = nullptr;  // null unless kVertex or kPixel
  // Functions of other libraries that the export can reach: indices into LibraryDesc::imports. Such
  // an export has no code; a state object compiles it together with those libraries.
  const uint32_t* imports = nullptr;
  uint32_t import_count = 0;
  const char* signature = nullptr;  // kLibrary: "float f(inout Payload)"; null: unknown
};

// A function that the library declares and calls, and that another library defines.
struct ImportDesc {
  const char* name;          // as written
  const char* mangled_name;  // as DXC would mangle it
  const char* signature;     // as in ExportDesc
};

// Subobjects defined in HLSL. Which members are used depends on type (values of
// D3D12_STATE_SUBOBJECT_TYPE).
struct SubobjectDesc {
  const char* name;
  uint32_t type;
  // GLOBAL/LOCAL_ROOT_SIGNATURE: {root signature string}; association: {subobject,
  // "export;export"}; HIT_GROUP: {any-hit, closest-hit, intersection}.
  const char* strings[3];
  // SHADER_CONFIG: {payload, attribute}; PIPELINE_CONFIG: {depth}; CONFIG1: {depth, flags};
  // STATE_OBJECT_CONFIG: {flags}; HIT_GROUP: {D3D12_HIT_GROUP_TYPE}.
  uint32_t values[2];
};

enum LibraryFlags : uint32_t {
  kLibraryChecked = 1,  // built with -check-access
  kLibraryInterpreted = 2,
  kLibraryDebug = 4,   // built with -Od -Zi
  kLibrarySource = 8,  // nothing but `source`, which LoadShaderLibrary compiles
};

struct LibraryDesc {
  uint32_t abi_version;
  uint32_t struct_bytes;  // sizeof(LibraryDesc): a second check against a mismatch
  const char* name;       // the main source file, as it was given
  const char* target;     // "lib_6_6"
  const ExportDesc* exports;
  uint32_t export_count;
  const BindingDesc* bindings;
  uint32_t binding_count;
  const SubobjectDesc* subobjects;
  uint32_t subobject_count;
  uint32_t flags = 0;                  // LibraryFlags
  const char* const* files = nullptr;  // source files, for CheckReport::site
  uint32_t file_count = 0;
  // Every source file and the options, for building the library's other variant; null: unknown.
  // [runtime/hlsl/driver/embedded_source.h]
  const char* source = nullptr;
  uint64_t source_bytes = 0;
  const ImportDesc* imports = nullptr;
  uint32_t import_count = 0;
  const PrintDesc* prints = nullptr;  // every printf and errorf, once
  uint32_t print_count = 0;
};

// The only symbol of a library that is compiled at run time.
inline constexpr char kLibraryEntryPoint[] = "kaamos_shader_library";
using LibraryEntryPointFn = const LibraryDesc* (*)();

}  // namespace kaamos::shader

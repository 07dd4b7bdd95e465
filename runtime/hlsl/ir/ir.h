// SPDX-License-Identifier: MIT
//
// The typed intermediate representation between the checker and everything that comes after it (C++
// emitter, GLSL emitter, interpreter, reflection).
//
// Its rules make the emitters plain printers:
// - Expressions are pure trees: no side effects, no traps, operands of equal and final type. They
//   may be evaluated in any order and any number of times between two statements.
// - Everything with an effect is a statement: assignments, memory stores, atomics, calls of user
//   functions, TraceRay. The checker hoists them out of expressions in HLSL's evaluation order and
//   saves earlier operands to temporaries where a later effect could change them.
// - Every conversion, splat, truncation, swizzle and copy-in/copy-out is spelled out.
// - An HLSL resource is a value (a descriptor); memory is reached by byte offsets.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kaamos/shader/graphics.h"
#include "kaamos/shader/wave_op.h"
#include "runtime/hlsl/ir/intrinsics.h"
#include "runtime/hlsl/ir/scalar.h"

namespace kaamos::hlsl::ir {

// Resolved early, so that no later stage needs the source manager. line 0: no location.
struct Location {
  uint32_t file = 0;  // index into Module::files
  uint32_t line = 0;
  uint32_t column = 0;
};

// ---------------------------------------------------------------------------------------------
// Types: interned in the Module, compared by address.

enum class TypeKind : uint8_t { kVoid, kScalar, kVector, kMatrix, kArray, kStruct, kResource };

enum class ResourceKind : uint8_t {
  kConstantBuffer,  // cbuffer blocks and ConstantBuffer<T>; element is the struct
  kTextureBuffer,   // the same for tbuffer: its bytes are those of a typed buffer
  kByteAddressBuffer,
  kRWByteAddressBuffer,
  kStructuredBuffer,
  kRWStructuredBuffer,
  kBuffer,
  kRWBuffer,
  kTexture1D,
  kTexture1DArray,
  kTexture2D,
  kTexture2DArray,
  kTexture3D,
  kTextureCube,
  kTextureCubeArray,
  kRWTexture1D,
  kRWTexture1DArray,
  kRWTexture2D,
  kRWTexture2DArray,
  kRWTexture3D,
  kSampler,
  kSamplerComparison,
  kAccelerationStructure,
  kRayQuery,
  kTexture2DMS,  // kTypedLoad: the sample is where others have the mip; kDimensions: the samples
  kTexture2DMSArray,
  kRWTexture2DMS,  // nothing reads these two: a use is a kRemoveDevice
  kRWTexture2DMSArray,
  kAppendStructuredBuffer,  // only before the IR, where both are kRWStructuredBuffer
  kConsumeStructuredBuffer,
};

struct Struct;

struct Type {
  TypeKind kind = TypeKind::kVoid;
  Scalar scalar = Scalar::kFloat32;  // scalar, vector, matrix; plain
  uint8_t rows = 1;                  // matrix
  uint16_t columns = 1;              // vector: its size; matrix
  const Type* element = nullptr;     // array; resource: element type T where there is one
  uint32_t count = 0;                // array; 0: unbounded (bindings only)
  const Struct* structure = nullptr;
  ResourceKind resource = ResourceKind::kByteAddressBuffer;
  uint32_t ray_query_flags = 0;

  // Only while a module is made: finish/long_vectors.h makes arrays of them.
  bool is_long_vector() const { return kind == TypeKind::kVector && columns > 4; }
  // A RayQuery is not a value: it can only be a local variable, or a parameter that stands for one.
  bool is_query() const {
    return kind == TypeKind::kResource && resource == ResourceKind::kRayQuery;
  }
};

struct Field {
  std::string name;
  const Type* type = nullptr;
  bool row_major = false;   // for a matrix, or an array of them, in memory
  int32_t packoffset = -1;  // cbuffer members: byte offset given by packoffset; -1: none
};

// A base class is the first field, named "base".
struct Struct {
  std::string name;  // qualified as in the source: "Scene::Vertex"; unique in the module
  std::vector<Field> fields;
  Location location;
};

// The layout of a type in memory. [HLSL: Packing rules for constant variables]
enum class Layout : uint8_t {
  kConstantBuffer,  // 16-byte rows; members do not straddle them; tails are reused
  kStructured,      // natural alignment of components, no padding to rows
};

// ---------------------------------------------------------------------------------------------
// Variables and functions

enum class Storage : uint8_t {
  kLocal,
  kParameter,
  kStaticGlobal,  // one per shader invocation, initialised when the shader starts
  kConstant,      // static const with an initialiser of constants: shared
  kGroupShared,
};

enum class ParameterMode : uint8_t {
  kIn,     // by value
  kInOut,  // by reference to a variable that nothing else refers to (the caller copies in and out);
           // a RayQuery: to the caller's own, which several parameters may refer to
  kOut,    // the same; the callee sees zeros
};

struct Expr;
struct Function;

struct Variable {
  std::string name;  // as written; temporaries have an empty name
  const Type* type = nullptr;
  Storage storage = Storage::kLocal;
  ParameterMode mode = ParameterMode::kIn;
  bool is_const = false;              // a local that nothing writes after its declaration
  const Expr* initialiser = nullptr;  // kStaticGlobal, kConstant; null: zero
  Location location;
  uint32_t id = 0;  // unique in the module
};

// ---------------------------------------------------------------------------------------------
// Expressions

enum class ExprKind : uint8_t {
  kLiteral,   // scalar or vector: literal[0..columns)
  kZero,      // all bits zero, any type
  kVariable,  // variable
  kField,     // operands[0].fields[index]; of struct type
  kElement,   // operands[0][operands[1]]: array, vector component, matrix row; index is int32 or
              // uint32; out of range must not crash: reads zero, writes nothing
  kSwizzle,   // operands[0] (scalar or vector) . components
  kMatrixSwizzle,  // operands[0] . components: each row * 4 + column
  kConvert,        // same shape, other scalar kind
  kSplat,          // scalar to vector or matrix
  kTruncate,       // leading components, or upper left of a matrix
  kConstruct,      // vector, matrix: scalar or vector parts that fill it in row-major order;
                   // array, struct: one operand for each element or field
  kUnary,
  kBinary,
  kSelect,       // operands: condition (bool, or vector of the result's size), then, else
  kConditional,  // operands: bool, then, else; only the chosen one is evaluated
  kLogicalAnd,   // scalar bool; the second only if the first is true
  kLogicalOr,
  kIntrinsic,  // intrinsic(operands...)
  kSystemValue,
  kBinding,  // resource value of binding `index`; operands[0]: array index (uint32), if an array
  kHeapResource,  // ResourceDescriptorHeap[operands[0]] or SamplerDescriptorHeap[..] by type
  // Memory. Offsets are uint32 bytes. Out of bounds reads zero.
  kLoad,         // operands: resource, byte offset. raw, constant and texture buffers
  kLoadElement,  // operands: resource, element index, byte offset in it. structured buffers
  kTypedLoad,    // operands: Buffer/RWBuffer/texture, coordinates (int or uint scalar/vector),
                 // [mip level (textures that have them)], [offset: int vector]
  kSample,       // sampling below; operands by SampleKind
  kQueryValue,  // operands: the kVariable of a RayQuery; query_value, index 1: of what is committed
  kDimensions,  // operands: resource, [mip level]. uint4: textures {width, height,
                // depth or elements, mips}; buffers {elements or bytes, stride, 0, 0}
  kSameBytes,   // operands: a value whose bytes in memory are read as another type; without
                // resources, zero beyond its bytes. The attributes of a hit object
  kRecordConstant,     // operands: a hit object, byte offset (uint32). uint32
  kTrianglePositions,  // operands: position table (uint2), geometry, primitive. float3x3, a row for
                       // each vertex [kaamos/shader/triangle_positions.h]
  kClusterId,          // operand: position table (uint2). uint32
  kPrintBuffer,        // the device's RWByteAddressBuffer for printf [kaamos/shader/printing.h]
  kQuad,  // only while a module is made (quad_functions.h): operands[0] combined over the quad
          // of a pixel shader, by `wave`
};

enum class UnaryOp : uint8_t { kNegate, kNot, kBitNot };

// Component-wise on operands of one type. Shifts mask their count, integer division by zero and
// INT_MIN / -1 do not trap, float % is a truncated remainder.
enum class BinaryOp : uint8_t {
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kModulo,
  kBitAnd,  // integers; bool: logical and without short circuit
  kBitOr,
  kBitXor,
  kShiftLeft,
  kShiftRight,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual,
  kEqual,
  kNotEqual,
};

// Operands after {texture, sampler, location}: what is listed, then an optional offset (int
// vector).
enum class SampleKind : uint8_t {
  kLevel,          // lod
  kGradient,       // ddx, ddy
  kCompareLevel,   // comparison value, lod (float)
  kGather,         // `index` is the component 0..3
  kGatherCompare,  // comparison value
  kLevelOfDetail,  // ddx, ddy; never an offset. The level before any bias and clamp (float)
};

enum class SystemValue : uint8_t {
  kDispatchRaysIndex,
  kDispatchRaysDimensions,
  kWorldRayOrigin,
  kWorldRayDirection,
  kRayTMin,
  kRayTCurrent,
  kRayFlags,
  kInstanceIndex,
  kInstanceId,
  kGeometryIndex,
  kPrimitiveIndex,
  kObjectRayOrigin,
  kObjectRayDirection,
  kObjectToWorld3x4,
  kObjectToWorld4x3,
  kWorldToObject3x4,
  kWorldToObject4x3,
  kHitKind,
  kPositionTable,  // of the hit, for kTrianglePositions and kClusterId
};

// The values that can be read from a RayQuery: about the candidate, or about the committed hit if
// Expr::index is 1.
enum class QueryValue : uint8_t {
  kType,  // CANDIDATE_TYPE or COMMITTED_STATUS
  kRayT,
  kInstanceIndex,
  kInstanceId,
  kInstanceContribution,
  kGeometryIndex,
  kPrimitiveIndex,
  kObjectRayOrigin,
  kObjectRayDirection,
  kObjectToWorld3x4,
  kObjectToWorld4x3,
  kWorldToObject3x4,
  kWorldToObject4x3,
  kBarycentrics,
  kFrontFace,
  kProceduralNonOpaque,  // for the candidate only
  kPositionTable,
  kRayFlags,  // from here on: about the ray
  kRayTMin,
  kWorldRayOrigin,
  kWorldRayDirection,
};

struct Expr {
  ExprKind kind = ExprKind::kZero;
  const Type* type = nullptr;
  Location location;
  std::vector<const Expr*> operands;
  const Variable* variable = nullptr;
  // kLiteral: one per component. Integers and bools are sign- or zero-extended, floats are the bits
  // of a double.
  std::vector<uint64_t> literal;
  std::vector<uint8_t> components;  // swizzles
  uint32_t index = 0;               // field, binding, gather component
  UnaryOp unary = UnaryOp::kNegate;
  BinaryOp binary = BinaryOp::kAdd;
  Intrinsic intrinsic = {};
  SystemValue system_value = {};
  SampleKind sample = {};
  QueryValue query_value = {};
  Layout layout = Layout::kStructured;  // kLoad, kLoadElement
  bool row_major = false;               // kLoad, kLoadElement of a matrix or an array of them
  shader::WaveOp wave = {};             // kQuad
  // Only while a module is made: a kSample whose level of detail comes from the quad. kLevel: the
  // lod is a bias; kLevelOfDetail: without its derivatives.
  bool implicit_level = false;
  bool clamps_level = false;  // then the last operand is the least level
};

// ---------------------------------------------------------------------------------------------
// Statements

enum class StmtKind : uint8_t {
  kBlock,         // body
  kDeclare,       // variable [= value]; zero without a value
  kAssign,        // place = value. place: kVariable, kField, kElement, kSwizzle (no repeats),
                  // kMatrixSwizzle
  kStore,         // operands: resource, byte offset; value. Out of bounds writes nothing
  kStoreElement,  // operands: resource, element index, byte offset; value
  kTypedStore,    // operands: RWBuffer/RWTexture, coordinates; value (as many components as T has)
  kAtomic,      // target by operands (memory: as the stores; typed: resource, coordinates) or place
                // (groupshared); value, compare; result or null
  kCall,        // function, arguments; result or null
  kTraceRay,    // operands: acceleration structure, flags, mask, ray contribution, multiplier, miss
                // index (uint32), RayDesc; place: the payload variable. result: a hit object, of
                // which neither closest-hit nor miss shaders run; or null
  kInvoke,      // operands: a hit object; place: the payload variable
  kReportHit,   // operands: t, hit kind, attributes; result (bool). May end the shader
  kCallShader,  // operands: index; place: the data variable
  kIgnoreHit,   // ends the shader
  kAcceptHitAndEndSearch,  // ends the shader
  kIf,                     // value, body, orelse
  kLoop,
  kSwitch,
  kBreak,  // of the innermost loop or switch
  kContinue,
  kReturn,  // value or null
  kBarrier,
  kQuery,         // place: the kVariable of a RayQuery, query: what it does. operands: kTrace:
                  // acceleration structure, flags (with the type's), mask (uint32), RayDesc;
                  // kCommitProcedural: t; result of kProceed (bool) or null
  kWave,          // wave: what the active lanes of a wave do together. operands: those of
                  // shader::WaveOp, scalars or vectors; result. In a ray shader a wave has one lane
  kRemoveDevice,  // removal: why. What follows may or may not run
  kDebugBreak,    // a debugger that is attached stops here
  kDiscard,     // the pixel writes nothing from here on, and goes on for the derivatives of others.
                // Does nothing where the assignment before it (quad_functions.h) is enough
  kEmitVertex,  // operands: the outputs of the geometry shaders that reach it, in their order
  kCutStrip,    // what a geometry shader emits next begins a strip
  kCover,       // point: it ran
};

enum class QueryOp : uint8_t { kTrace, kProceed, kAbort, kCommitTriangle, kCommitProcedural };

enum class AtomicOp : uint8_t {
  kAdd,
  kAnd,
  kOr,
  kXor,
  kMin,
  kMax,
  kExchange,
  kCompareExchange,
  kCompareStore,  // no result
};

// Values of shader::RemovalReason.
enum class Removal : uint8_t { kMultisampled = 5 };

enum BarrierFlags : uint32_t { kGroupMemory = 1, kDeviceMemory = 2, kGroupSync = 4 };

struct Stmt;
using Block = std::vector<const Stmt*>;

struct SwitchCase {
  std::vector<int64_t> labels;
  bool is_default = false;
  Block body;  // runs on into the next case unless it breaks
};

// The target of kAtomic if it is not a groupshared place.
// kCounter: that of the structured buffer operands[0].
enum class AtomicTarget : uint8_t { kPlace, kMemory, kElement, kTyped, kCounter };

struct Stmt {
  StmtKind kind = StmtKind::kBlock;
  Location location;
  const Variable* variable = nullptr;  // kDeclare
  const Expr* place = nullptr;
  const Expr* value = nullptr;  // also: condition of kIf and kLoop, selector of kSwitch
  const Expr* compare = nullptr;
  std::vector<const Expr*> operands;
  // kCall: a kIn parameter takes any expression. Any other takes a kVariable expression whose
  // variable appears only once among the arguments and is not otherwise used by them.
  std::vector<const Expr*> arguments;
  const Function* function = nullptr;
  const Variable* result = nullptr;  // declared earlier by a kDeclare
  // kLoop repeats { prelude; if (!value) break; body; step }, and `continue` goes to step. With
  // test_at_end it repeats { body; step; prelude; if (!value) break }. A null value loops forever.
  Block prelude;
  Block body;
  Block orelse;
  Block step;
  bool test_at_end = false;
  uint32_t unroll = 0;  // how often [unroll] asks to repeat the body; 0: it does not
  std::vector<SwitchCase> cases;
  AtomicOp atomic = AtomicOp::kAdd;
  AtomicTarget target = AtomicTarget::kPlace;
  QueryOp query = {};
  shader::WaveOp wave = {};
  Removal removal = Removal::kMultisampled;
  bool outlives_end = false;  // kCall: what follows runs even if the callee ended the shader
  Layout layout = Layout::kStructured;
  bool row_major = false;
  uint32_t barrier = 0;  // BarrierFlags
  uint32_t point = 0;    // index into Module::coverage
};

// ---------------------------------------------------------------------------------------------
// Functions and the module

enum StageBits : uint32_t {
  kStageRayGeneration = 1,
  kStageIntersection = 2,
  kStageAnyHit = 4,
  kStageClosestHit = 8,
  kStageMiss = 16,
  kStageCallable = 32,
  kStageCompute = 64,
  kStageVertex = 128,
  kStagePixel = 256,
  kStageGeometry = 512,
};

struct Function {
  std::string name;     // qualified as in the source: "Material::evaluate", "lerp3<float>"
  std::string mangled;  // as DXC mangles it ("\01?Hit@@YAXUPayload@@@Z"); unique in the module
  const Type* result = nullptr;
  std::vector<Variable*> parameters;  // a method's object is the first, named "this"
  Block body;
  Location location;
  Location end_location;         // of the closing brace
  uint32_t stages = 0;           // StageBits: which stages' entry points reach it
  bool may_trace = false;        // can reach TraceRay or HitObject::Invoke
  bool uses_query = false;       // can reach TraceRayInline
  bool uses_hit_object = false;  // can reach functions of HitObject
  bool may_call = false;         // can reach CallShader
  bool may_end_shader = false;   // can reach IgnoreHit, AcceptHitAndEndSearch or ReportHit: after a
                                 // call, the caller must return at once if the shader has ended
  bool has_barrier = false;      // can reach a group barrier
  bool has_waves = false;        // can reach kWave
};

// The source of the value of an entry point's parameter.
enum class EntryParameter : uint8_t {
  kPayload,
  kAttributes,
  kCallableData,
  kDispatchThreadId,
  kGroupId,
  kGroupThreadId,
  kGroupIndex,
  kInput,      // of a vertex, geometry or pixel shader, and kOutput: as many as `inputs` and
  kOutput,     // `outputs`, in their order, each a scalar or vector of 32-bit numbers. Geometry
               // shaders have arrays of them, one for each corner, and no kOutput
  kIsLive,     // bool: whether the pixel is covered; helpers are not
  kStaysLive,  // bool, out: whether it was not discarded either
};

// An input or output of a vertex, geometry or pixel shader. [kaamos/shader/graphics.h:
// SignatureElement]
struct SignatureElement {
  std::string semantic;
  uint32_t semantic_index = 0;
  shader::SystemValue system_value = {};
  shader::ColumnType type = {};
  shader::Interpolation interpolation = {};
  uint8_t components = 1;
  uint32_t first_column = 0;
  Location location;
  bool is_implied = false;  // not declared: what the shader reads besides
};

struct EntryPoint {
  std::string name;  // the export's name
  const Function* function = nullptr;
  uint32_t stage = 0;  // one StageBits
  std::vector<EntryParameter> parameters;
  const Type* payload = nullptr;  // payload, or callable data
  const Type* attributes = nullptr;
  // True if it has access qualifiers, in shader model 6.7 or higher, where MaxPayloadSizeInBytes is
  // not a limit.
  bool unbounded_payload = false;
  std::optional<std::string> root_signature;  // [RootSignature("...")]
  uint32_t payload_bytes = 0;                 // each scalar counted as 4 bytes (8 for 64-bit ones)
  uint32_t attribute_bytes = 0;  // of an intersection shader: the largest that it reports
  uint32_t attribute_type = 0;   // shader::ExportDesc::attribute_type
  uint32_t thread_group[3] = {1, 1, 1};
  uint32_t groupshared_limit = 32768;  // bytes; [GroupSharedLimit]
  // [WaveSize]: lanes that a wave must have, and may have; 0: any
  uint32_t least_wave_lanes = 0;
  uint32_t most_wave_lanes = 0;
  std::vector<uint32_t> bindings;  // indices into Module::bindings that it can reach
  bool uses_view_heap = false;
  bool uses_sampler_heap = false;
  std::vector<SignatureElement> inputs;
  std::vector<SignatureElement> outputs;
  uint32_t graphics_flags = 0;     // shader::GraphicsFlags
  shader::GeometryShape geometry;  // of a geometry shader
  std::vector<uint32_t> imports;   // indices into Module::imports that it can reach

  bool is_graphics() const { return (stage & (kStageVertex | kStageGeometry | kStagePixel)) != 0; }
};

// A function without a body, which another library defines.
struct Import {
  std::string name;       // qualified as in the source
  std::string mangled;    // as DXC mangles it
  std::string signature;  // as in messages: "float f(inout Payload)"
};

// An exported function that is not an entry point. [-default-linkage external, -exports, `export`]
struct LibraryFunction {
  std::string name;
  std::string mangled;
  std::string signature;          // as Import::signature
  std::vector<uint32_t> callers;  // entry points that can reach it; after them, the unlinked ones
  std::vector<uint32_t> imports;  // as EntryPoint::imports
};

struct Binding {
  std::string name;
  const Type* type = nullptr;  // resource; arrays are given by count
  uint8_t register_class = 0;  // 0 t, 1 u, 2 b, 3 s
  uint32_t register_index = 0;
  uint32_t space = 0;
  uint32_t count = 1;  // 0xFFFFFFFF unbounded; a multi-dimensional array is flattened
  bool is_array = false;
  bool automatic = false;   // assigned by the compiler
  uint32_t size_bytes = 0;  // constant buffers: bytes; structured buffers: element stride
  bool is_ordered = false;  // a RasterizerOrdered view
  Location location;
};

struct Subobject {
  std::string name;
  uint32_t type = 0;  // numbers of D3D12_STATE_SUBOBJECT_TYPE
  std::vector<std::string> strings;
  std::vector<uint32_t> values;
  Location location;
};

// One printf or errorf. [shader::PrintDesc]
struct Print {
  uint64_t id = 0;
  std::string format;
  std::string arguments;
  bool is_error = false;
};

// A line, or an arm of a branch. [shader::CoveragePoint]
struct CoveragePoint {
  Location location;
  bool is_arm = false;
  uint32_t arm = 0;
};

struct Module {
  std::string name;    // main source file as given
  std::string target;  // "lib_6_6"
  std::vector<std::string> files;
  std::vector<EntryPoint> entry_points;
  // Entry points that reach imports: they run only once they are linked, in another module. Their
  // functions are not among `functions`.
  std::vector<EntryPoint> unlinked_entry_points;
  std::vector<LibraryFunction> library_functions;
  std::vector<Import> imports;
  std::vector<Function*> functions;    // reachable ones, callees before callers
  std::vector<Variable*> globals;      // reachable kStaticGlobal, kConstant, kGroupShared
  std::vector<const Struct*> structs;  // used ones, members before users
  std::vector<Binding> bindings;       // reachable ones
  std::vector<Subobject> subobjects;
  std::vector<Print> prints;            // by the order of the source, equal ones once
  std::vector<CoveragePoint> coverage;  // empty unless it was asked for
  // Emitters add checks for what DXR leaves undefined. [-check-access]
  bool check_access = false;
  std::string source;  // all source files and options (embedded_source.h); empty: unknown
  const Struct* ray_desc = nullptr;  // the built-in RayDesc {Origin, TMin, Direction, TMax}
  // The built-in dx::HitObject, with the members of shader::HitObject; null before Shader
  // Model 6.9.
  const Struct* hit_object = nullptr;

  // Owners of the nodes; addresses stay valid as long as the module lives.
  std::deque<Type> type_pool;
  std::deque<Struct> struct_pool;
  std::deque<Variable> variable_pool;
  std::deque<Function> function_pool;
  std::deque<Expr> expr_pool;
  std::deque<Stmt> stmt_pool;
};

}  // namespace kaamos::hlsl::ir

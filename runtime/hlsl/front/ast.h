// SPDX-License-Identifier: MIT
// The syntax tree of one HLSL translation unit, as written: names are not resolved and types are
// not computed. Nodes are plain structs that live in an AstArena and are immutable once parsed;
// text (std::string_view) points into the sources or the arena and lives as long as both do.
//
// `location` is the token that a diagnostic about the node should point at: the operator of a
// binary expression, the member's name of a member access, the name of a declaration.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "runtime/hlsl/front/ast_arena.h"
#include "runtime/hlsl/front/literal.h"
#include "runtime/hlsl/front/source.h"

namespace kaamos::hlsl {

struct Expr;
struct Stmt;
struct Decl;
struct BlockStmt;
struct TypeSyntax;
struct VariableDecl;

// ---- Names, modifiers, annotations --------------------------------------------------------------

// Keywords in front of a declaration or a type, as a bit set. const, volatile, row_major,
// column_major, snorm and unorm are kept on TypeSyntax::modifiers; all others on Decl::modifiers.
using Modifiers = uint32_t;
enum Modifier : Modifiers {
  kModConst = 1u << 0,
  kModVolatile = 1u << 1,
  kModRowMajor = 1u << 2,  // Also set where `#pragma pack_matrix` says so.
  kModColumnMajor = 1u << 3,
  kModSnorm = 1u << 4,
  kModUnorm = 1u << 5,
  kModStatic = 1u << 6,
  kModExtern = 1u << 7,
  kModUniform = 1u << 8,
  kModGroupshared = 1u << 9,
  kModPrecise = 1u << 10,
  kModGloballyCoherent = 1u << 11,
  kModInline = 1u << 12,
  kModExport = 1u << 13,
  kModIn = 1u << 14,  // `inout` and `in out` set both kModIn and kModOut.
  kModOut = 1u << 15,
  kModNoInterpolation = 1u << 16,
  kModLinear = 1u << 17,
  kModCentroid = 1u << 18,
  kModNoPerspective = 1u << 19,
  kModSample = 1u << 20,
  kModShared = 1u << 21,
  kModCenter = 1u << 22,
  kModReorderCoherent = 1u << 23,
  kModMesh = 1u << 24,  // indices, vertices, primitives, payload.
  kModPoint = 1u << 25,
  kModLine = 1u << 26,
  kModLineAdj = 1u << 27,
  kModTriangle = 1u << 28,
  kModTriangleAdj = 1u << 29,
};
inline constexpr size_t kModifierCount = 30;
inline constexpr Modifiers kModPrimitive =
    kModPoint | kModLine | kModLineAdj | kModTriangle | kModTriangleAdj;
inline constexpr Modifiers kTypeModifiers =
    kModConst | kModVolatile | kModRowMajor | kModColumnMajor | kModSnorm | kModUnorm;

// Exactly one of `type` and `value` is set. A name that the parser knows as a type (or a template
// type parameter) becomes `type`; any other name becomes `value`.
struct TemplateArgument {
  SourceLocation location;
  const TypeSyntax* type = nullptr;
  const Expr* value = nullptr;
};

// One component of a name: `Load` or `Load<float4>`.
struct NamePart {
  SourceLocation location;
  std::string_view identifier;
  bool has_template_arguments = false;  // True for `Foo<>` as well.
  std::span<const TemplateArgument> template_arguments;
};

// `a`, `::a`, `ns::Type<float>::member`. Always has at least one part.
struct QualifiedName {
  SourceLocation location;  // The last part's location.
  bool is_global = false;   // Starts with `::`.
  std::span<const NamePart> parts;

  const NamePart& last() const { return parts.back(); }
  bool is_simple() const { return !is_global && parts.size() == 1; }
};

// [shader("miss")], [numthreads(8,8,1)], [[vk::binding(0, 1)]].
struct Attribute {
  SourceLocation location;  // The name's location.
  std::string_view scope;   // "vk" of [[vk::binding]]; empty otherwise.
  std::string_view name;    // As written; attribute names are case-insensitive in HLSL.
  bool is_double_bracket = false;
  std::span<const Expr* const> arguments;
};

// `: SV_Target3`; semantics are case-insensitive.
struct Semantic {
  SourceLocation location;
  std::string_view text;  // "SV_Target3".
  std::string_view base;  // "SV_Target".
  uint32_t index = 0;     // 3; 0 if none is written.
};

// `: register(t3, space1)`, `: register(space1)`.
struct RegisterBinding {
  SourceLocation location;
  char register_class = 0;  // Lower case 't', 'u', 'b', 's', 'c', 'i'; 0 if only a space is given.
  uint32_t number = 0;
  uint32_t space = 0;
  bool has_space = false;
};

// `: packoffset(c3.y)`: register_index 3, component 1.
struct PackOffset {
  SourceLocation location;
  uint32_t register_index = 0;
  uint32_t component = 0;
};

struct PayloadStage {
  SourceLocation location;
  std::string_view name;  // caller, closesthit, miss, anyhit; the checker validates it.
};

// `: read(caller, anyhit)`, `: write(closesthit)`. [DXR: Payload access qualifiers]
struct PayloadAccess {
  SourceLocation location;
  bool is_write = false;
  std::span<const PayloadStage> stages;
};

// Everything that follows a colon after a declarator, a parameter list or the name of a buffer
// block.
struct Annotations {
  const Semantic* semantic = nullptr;
  std::span<const RegisterBinding> registers;  // More than one only if they are profile-specific.
  const PackOffset* pack_offset = nullptr;
  std::span<const PayloadAccess> payload_access;
};

// ---- Types --------------------------------------------------------------------------------------

enum class ScalarKind : uint8_t {
  kBool,
  kInt,
  kUint,
  kHalf,
  kFloat,
  kDouble,
  kInt16,
  kUint16,
  kFloat16,
  kInt64,
  kUint64,
  kMin10Float,
  kMin16Float,
  kMin12Int,
  kMin16Int,
  kMin16Uint,
};

enum class TypeSyntaxKind : uint8_t {
  kError,  // Already diagnosed; treat it as "any type" and report nothing more.
  kVoid,
  kNumeric,  // scalar, rows, columns.
  kNamed,    // name: user types, resources, `vector<T,N>`, `matrix`, `string`, template parameters.
  kDefinition,  // definition: `struct S { .. } s;`, `enum { A } e;`.
  kArray,       // element, array_size.
  kAuto,        // `auto`: the initializer's type.
};

// A type as written. Spellings are normalised: `dword`, `unsigned int` and `uint32_t` are kUint;
// `float32_t3` is three kFloat.
struct TypeSyntax {
  TypeSyntaxKind kind = TypeSyntaxKind::kError;
  ScalarKind scalar = ScalarKind::kFloat;
  // kNumeric: 0 x 0 is a scalar, 0 x N a vector of N (`float1` is 0 x 1), R x C a matrix.
  uint8_t rows = 0;
  uint8_t columns = 0;
  SourceLocation location;
  Modifiers modifiers = 0;
  bool is_unsigned = false;  // kNamed: `unsigned Index`
  // kNamed: kModRowMajor or kModColumnMajor by `#pragma pack_matrix`, for a name that turns out to
  // mean a matrix without an order of its own.
  Modifiers pack_matrix = 0;
  const QualifiedName* name = nullptr;
  const Decl* definition = nullptr;  // StructDecl or EnumDecl; also in the enclosing list of decls.
  // kArray. `float a[2][3]` is an array of 2 (arrays of 3 floats). Size null: unbounded, `a[]`.
  const TypeSyntax* element = nullptr;
  const Expr* array_size = nullptr;

  bool is_scalar() const { return kind == TypeSyntaxKind::kNumeric && columns == 0; }
  bool is_vector() const { return kind == TypeSyntaxKind::kNumeric && columns > 0 && rows == 0; }
  bool is_matrix() const { return kind == TypeSyntaxKind::kNumeric && rows > 0; }
};

// ---- Expressions --------------------------------------------------------------------------------

enum class ExprKind : uint8_t {
  kError,  // Already diagnosed; report nothing more.
  kIntLiteral,
  kFloatLiteral,
  kBoolLiteral,
  kStringLiteral,
  kName,
  kThis,
  kMember,
  kIndex,
  kCall,
  kConstruct,
  kCast,
  kInitList,
  kUnary,
  kBinary,
  kAssign,
  kConditional,
  kSizeof,
};

struct Expr {
  ExprKind kind;
  bool is_parenthesized = false;
  uint16_t height = 0;  // Levels of expressions below; bounded, so a recursive walk is safe.
  SourceLocation location;
};

struct ErrorExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kError;
};

struct IntLiteralExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kIntLiteral;
  uint64_t value = 0;
  LiteralSuffix suffix = LiteralSuffix::kNone;  // kNone, kU, kL (also `ll`), kUL (also `ull`).
  bool is_decimal = true;                       // False for 0x.. and 0.. (octal).
};

struct FloatLiteralExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kFloatLiteral;
  double value = 0;
  LiteralSuffix suffix = LiteralSuffix::kNone;  // kNone, kF, kH, kL.
};

struct BoolLiteralExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kBoolLiteral;
  bool value = false;
};

struct StringLiteralExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kStringLiteral;
  std::string_view value;  // Without quotes, escapes resolved, adjacent literals joined.
};

struct NameExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kName;
  const QualifiedName* name = nullptr;
};

struct ThisExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kThis;
};

// base.member, base.xyz, base._m00_m11, base.Load<float4>, base.Outer::member.
struct MemberExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kMember;
  const Expr* base = nullptr;
  const QualifiedName* name = nullptr;
};

struct IndexExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kIndex;
  const Expr* base = nullptr;
  const Expr* index = nullptr;
};

// callee is a NameExpr (function, or an implicit-this method) or a MemberExpr (method).
struct CallExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kCall;
  const Expr* callee = nullptr;
  std::span<const Expr* const> arguments;
};

// float3(1, x.xy), T(0), S(..).
struct ConstructExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kConstruct;
  const TypeSyntax* type = nullptr;
  std::span<const Expr* const> arguments;
};

// (float3)x, (S)0.
struct CastExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kCast;
  const TypeSyntax* type = nullptr;
  const Expr* operand = nullptr;
};

struct InitListExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kInitList;
  std::span<const Expr* const> elements;
};

enum class UnaryOp : uint8_t {
  kPlus,
  kMinus,
  kNot,         // !
  kComplement,  // ~
  kPreIncrement,
  kPreDecrement,
  kPostIncrement,
  kPostDecrement,
};

struct UnaryExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kUnary;
  UnaryOp op = UnaryOp::kPlus;
  const Expr* operand = nullptr;
};

enum class BinaryOp : uint8_t {
  kMul,
  kDiv,
  kRem,
  kAdd,
  kSub,
  kShl,
  kShr,
  kLess,
  kGreater,
  kLessEqual,
  kGreaterEqual,
  kEqual,
  kNotEqual,
  kBitAnd,
  kBitXor,
  kBitOr,
  kLogicalAnd,
  kLogicalOr,
  kComma,
};

struct BinaryExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kBinary;
  BinaryOp op = BinaryOp::kAdd;
  const Expr* left = nullptr;
  const Expr* right = nullptr;
};

struct AssignExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kAssign;
  std::optional<BinaryOp> op;  // kAdd for `+=`; empty for `=`.
  const Expr* target = nullptr;
  const Expr* value = nullptr;
};

struct ConditionalExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kConditional;
  const Expr* condition = nullptr;
  const Expr* if_true = nullptr;
  const Expr* if_false = nullptr;
};

// Exactly one of type and operand is set.
struct SizeofExpr : Expr {
  static constexpr ExprKind kKind = ExprKind::kSizeof;
  const TypeSyntax* type = nullptr;
  const Expr* operand = nullptr;
};

// ---- Statements ---------------------------------------------------------------------------------

enum class StmtKind : uint8_t {
  kError,
  kEmpty,
  kBlock,
  kDecl,
  kExpr,
  kIf,
  kFor,
  kWhile,
  kDo,
  kSwitch,
  kBreak,
  kContinue,
  kReturn,
  kDiscard,
};

struct Stmt {
  StmtKind kind;
  SourceLocation location;
  std::span<const Attribute> attributes;  // [unroll], [branch], ...
};

struct ErrorStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kError;
};
struct EmptyStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kEmpty;
};
struct BreakStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kBreak;
};
struct ContinueStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kContinue;
};
struct DiscardStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kDiscard;
};

struct BlockStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kBlock;
  std::span<const Stmt* const> statements;
  SourceLocation end;  // The closing brace.
};

// A declaration statement. Several declarators become several VariableDecls; it can also hold
// StructDecl, TypeAliasDecl, EnumDecl, UsingNamespaceDecl and UsingDecl.
struct DeclStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kDecl;
  std::span<const Decl* const> declarations;
};

struct ExprStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kExpr;
  const Expr* expression = nullptr;
};

struct IfStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kIf;
  const Expr* condition = nullptr;
  const Stmt* then_branch = nullptr;
  const Stmt* else_branch = nullptr;  // Null: none.
};

struct ForStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kFor;
  const Stmt* init = nullptr;       // DeclStmt, ExprStmt or null.
  const Expr* condition = nullptr;  // Null: true.
  const Expr* step = nullptr;       // Null: none.
  const Stmt* body = nullptr;
};

struct WhileStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kWhile;
  const Expr* condition = nullptr;
  const Stmt* body = nullptr;
};

struct DoStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kDo;
  const Stmt* body = nullptr;
  const Expr* condition = nullptr;
};

struct CaseLabel {
  SourceLocation location;
  const Expr* value = nullptr;  // Null: default.
};

// A run of labels and the statements up to the next label. Execution falls through into the next
// section if the end is reachable. All sections share one scope.
struct SwitchSection {
  std::span<const CaseLabel> labels;
  std::span<const Stmt* const> statements;
};

struct SwitchStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kSwitch;
  const Expr* condition = nullptr;
  std::span<const SwitchSection> sections;
};

struct ReturnStmt : Stmt {
  static constexpr StmtKind kKind = StmtKind::kReturn;
  const Expr* value = nullptr;  // Null: none.
};

// ---- Declarations -------------------------------------------------------------------------------

enum class DeclKind : uint8_t {
  kVariable,
  kParameter,
  kFunction,
  kStruct,
  kEnum,
  kBuffer,
  kNamespace,
  kTypeAlias,
  kUsingNamespace,
  kUsing,
  kSubobject,
  kStaticAssert,
};

struct Decl {
  DeclKind kind;
  Modifiers modifiers = 0;
  SourceLocation location;  // The name, or the keyword if there is no name.
  std::string_view name;    // Empty: anonymous.
  std::span<const Attribute> attributes;
};

struct TemplateParameter {
  SourceLocation location;
  std::string_view name;                     // May be empty.
  const TypeSyntax* value_type = nullptr;    // `int N`; null: a type parameter (`typename T`).
  const TypeSyntax* default_type = nullptr;  // `typename T = float`.
  const Expr* default_value = nullptr;       // `int N = 3`.
};

// Globals, locals, struct fields (bit fields included) and fields of buffer blocks.
struct VariableDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kVariable;
  const TypeSyntax* type = nullptr;  // With the declarator's array bounds applied.
  Annotations annotations;
  // `int S::count = 3;`: S. The parameters are those of `template<typename T> int S<T>::count =
  // 3;`.
  const QualifiedName* qualifier = nullptr;
  std::span<const TemplateParameter> template_parameters = {};
  const Expr* bit_width = nullptr;  // `uint a : 4`; without a name it is padding.
  const Expr* initializer = nullptr;
};

struct ParameterDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kParameter;
  const TypeSyntax* type = nullptr;
  Annotations annotations;
  const Expr* default_value = nullptr;
};

struct FunctionDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kFunction;
  // `void ns::S::f() {}` has the qualifier `ns::S`; null means none. An overloaded operator is
  // named "operator+", "operator[]", "operator()".
  const QualifiedName* qualifier = nullptr;
  std::span<const TemplateParameter> template_parameters;
  // The first of two lists: `template<typename T> template<typename U> U S<T>::f(U u)`.
  std::span<const TemplateParameter> outer_parameters = {};
  bool is_template = false;
  bool is_specialization = false;  // `template<> void f<int>(int i)`
  bool is_instantiation = false;   // `template void f<int>(int i);`; is_specialization is set too
  std::span<const TemplateArgument> specialized = {};
  bool is_const_method = false;
  const TypeSyntax* return_type = nullptr;
  std::span<const ParameterDecl* const> parameters;
  Annotations annotations;          // The return value's semantic.
  const BlockStmt* body = nullptr;  // Null: a declaration only.
};

// struct and class, which mean the same in HLSL.
struct StructDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kStruct;
  bool is_class = false;
  bool is_interface = false;
  bool is_definition = false;  // False for a forward declaration.
  bool is_template = false;
  std::span<const TemplateParameter> template_parameters;
  // `template<> struct S<int>`, and with parameters `template<typename T> struct S<T, 0>`.
  bool is_specialization = false;
  bool is_instantiation = false;  // `template struct S<int>;`
  std::span<const TemplateArgument> specialized = {};
  std::span<const TypeSyntax* const> bases;
  // In source order: VariableDecl (fields; static members carry kModStatic), FunctionDecl,
  // StructDecl, EnumDecl, TypeAliasDecl.
  std::span<const Decl* const> members;
};

struct Enumerator {
  SourceLocation location;
  std::string_view name;
  const Expr* value = nullptr;  // Null: the previous one plus 1.
};

struct EnumDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kEnum;
  bool is_class = false;
  const TypeSyntax* underlying = nullptr;  // Null: int.
  std::span<const Enumerator> enumerators;
};

// cbuffer and tbuffer. Members are visible in the enclosing scope.
struct BufferDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kBuffer;
  bool is_texture_buffer = false;
  Annotations annotations;
  // Mostly VariableDecl, but StructDecl, FunctionDecl and others are allowed too.
  std::span<const Decl* const> members;
};

struct NamespaceDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kNamespace;
  std::span<const Decl* const> declarations;  // `namespace a::b {}` is two nested NamespaceDecls.
};

// typedef and `using A = T`.
struct TypeAliasDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kTypeAlias;
  bool is_template = false;
  std::span<const TemplateParameter> template_parameters;
  const TypeSyntax* type = nullptr;
};

struct UsingNamespaceDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kUsingNamespace;
  const QualifiedName* target = nullptr;
};

// `using ns::thing;`
struct UsingDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kUsing;
  const QualifiedName* target = nullptr;
};

enum class SubobjectKind : uint8_t {
  kStateObjectConfig,
  kGlobalRootSignature,
  kLocalRootSignature,
  kSubobjectToExportsAssociation,
  kRaytracingShaderConfig,
  kRaytracingPipelineConfig,
  kRaytracingPipelineConfig1,
  kTriangleHitGroup,
  kProceduralPrimitiveHitGroup,
};

// `_Static_assert(condition, "text");`
struct StaticAssertDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kStaticAssert;
  const Expr* condition = nullptr;
  std::string_view text;
};

// `TriangleHitGroup MyHitGroup = { "MyAnyHit", "MyClosestHit" };` The checker validates the
// arguments. [DXR: Subobjects in HLSL]
struct SubobjectDecl : Decl {
  static constexpr DeclKind kKind = DeclKind::kSubobject;
  SubobjectKind subobject_kind = SubobjectKind::kStateObjectConfig;
  std::span<const Expr* const> arguments;
};

struct TranslationUnit {
  std::span<const Decl* const> declarations;
};

// ---- Access -------------------------------------------------------------------------------------

// The node as a T, or null if it is of another kind: `if (auto* call = as<CallExpr>(expr))`.
template <class T, class Base>
const T* as(const Base* node) {
  return node != nullptr && node->kind == T::kKind ? static_cast<const T*>(node) : nullptr;
}

}  // namespace kaamos::hlsl

// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/stages/graphics_signature.h"

#include <algorithm>
#include <utility>

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/builtin_functions.h"

namespace kaamos::hlsl {
namespace {

using shader::ColumnType;
using shader::Interpolation;
using shader::SystemValue;

constexpr uint32_t kMostVectors = 32;
constexpr uint32_t kMostTargets = 8;
constexpr Modifiers kInterpolationModifiers =
    kModNoInterpolation | kModLinear | kModCentroid | kModNoPerspective | kModSample | kModCenter;

bool is_generated(SystemValue value) {
  return value == SystemValue::kPrimitiveId || value == SystemValue::kIsFrontFace ||
         value == SystemValue::kBarycentrics || value == SystemValue::kCoverage ||
         value == SystemValue::kSampleIndex || value == SystemValue::kSampleCount ||
         value == SystemValue::kGeometryInstance;
}

// Returns how many vectors of four components the elements fill: each goes to the first one of its
// kind that has room.
uint32_t count_vectors(const std::vector<ir::SignatureElement>& elements, bool shares) {
  struct Vector {
    const ir::SignatureElement* first;
    uint32_t used;
  };
  std::vector<Vector> vectors;
  for (const ir::SignatureElement& element : elements) {
    if (is_generated(element.system_value)) continue;
    const auto fits = [&](const Vector& vector) {
      const bool mixes = element.system_value == vector.first->system_value ||
                         (element.system_value == SystemValue::kClipDistance &&
                          vector.first->system_value == SystemValue::kCullDistance) ||
                         (element.system_value == SystemValue::kCullDistance &&
                          vector.first->system_value == SystemValue::kClipDistance);
      return shares && mixes && vector.used + element.components <= 4 &&
             element.interpolation == vector.first->interpolation;
    };
    const auto found = std::find_if(vectors.begin(), vectors.end(), fits);
    if (found == vectors.end()) {
      vectors.push_back({&element, element.components});
    } else {
      found->used += element.components;
    }
  }
  return static_cast<uint32_t>(vectors.size());
}

}  // namespace

const ir::Expr* GraphicsSignature::read(const Type* type, Name& name, const Source& source,
                                        size_t parameter) {
  parameter_ = parameter;
  return walk(type, name, source, nullptr);
}

const ir::Expr* GraphicsSignature::read_corners(const Type* type, const Name& name,
                                                const Source& source, size_t parameter) {
  parameter_ = parameter;
  corners_ = type->count;
  std::vector<const ir::Expr*> parts;
  const size_t first = elements.size();
  for (corner_ = 0; corner_ < corners_ && !failed; ++corner_) {
    next_element_ = first;
    Name own = name;
    parts.push_back(walk(type->element, own, source, nullptr));
  }
  corners_ = corner_ = 0;
  return failed ? nullptr : build_.construct(type->ir, std::move(parts));
}

void GraphicsSignature::describe_vertex(const Type* type, const Source& source) {
  Name name;
  walk(type, name, source, build_.zero(type->ir));
}

void GraphicsSignature::write(const Type* type, Name& name, const Source& source,
                              const ir::Expr* value) {
  walk(type, name, source, value);
}

void GraphicsSignature::read_inputs(const FunctionInfo& function) {
  for (const InputRead& read : function.input_reads) {
    const auto leaf = std::find_if(leaves.begin(), leaves.end(), [&](const Leaf& one) {
      return function.ir->parameters[one.parameter] == read.parameter && one.path == read.path;
    });
    const bool of_vertices = read.of_vertices;
    if (leaf == leaves.end() || leaf->element >= elements.size() ||
        (of_vertices && elements[leaf->element].interpolation != Interpolation::kNoInterpolation) ||
        elements[leaf->element].system_value != SystemValue::kNone) {
      fail(CheckId::kVertexAttribute, read.location,
           {of_vertices ? "GetAttributeAtVertex" : "EvaluateAttribute",
            of_vertices ? "an input that is nointerpolation"
                        : "an input that the vertex shader writes"});
      return;
    }
    at(read.location);
    const auto fill = [&](InputFact fact, const auto& value) {
      const VariableInfo* info = read.facts[static_cast<size_t>(fact)];
      if (info) lower_.body.assign(info->variable, value());
    };
    using I = Interpolation;
    fill(InputFact::kSecondVertex, [&] { return place_of(*leaf, I::kSecondVertex); });
    fill(InputFact::kThirdVertex, [&] { return place_of(*leaf, I::kThirdVertex); });
    if (of_vertices) continue;
    const Interpolation own = elements[leaf->element].interpolation;
    const bool flat = own == I::kNoInterpolation;
    const bool straight = flat || shader::is_no_perspective(own);
    fill(InputFact::kCentroid, [&] {
      return place_of(*leaf, flat ? own : straight ? I::kCentroidNoPerspective : I::kCentroid);
    });
    const auto middle = [&] {
      return place_of(*leaf, flat ? own : straight ? I::kNoPerspective : I::kLinear);
    };
    fill(InputFact::kMiddle, middle);
    const ir::Type* real = build_.scalar_type(Scalar::kFloat32);
    const auto inverse_w = [&] {
      const ir::Expr* one = build_.convert(build_.uint32(1), Scalar::kFloat32);
      return straight ? one
                      : build_.binary(ir::BinaryOp::kDivide, one, build_.swizzle(position(4), {3}));
    };
    const auto slope = [&](shader::WaveOp op, const ir::Expr* of) -> const ir::Expr* {
      ir::Expr* node = build_.expr(ir::ExprKind::kQuad, of->type, {of});
      node->wave = op;
      return node;
    };
    const auto product = [&] {
      const ir::Expr* value = middle();
      const ir::Expr* w = inverse_w();
      return build_.binary(ir::BinaryOp::kMultiply, value,
                           value->type == real ? w : build_.splat(w, value->type));
    };
    fill(InputFact::kSlopeX, [&] { return slope(shader::WaveOp::kDdxFine, product()); });
    fill(InputFact::kSlopeY, [&] { return slope(shader::WaveOp::kDdyFine, product()); });
    fill(InputFact::kInverseW, [&] {
      const ir::Expr* w = inverse_w();
      return build_.construct(
          build_.vector_type(Scalar::kFloat32, 3),
          {w, slope(shader::WaveOp::kDdxFine, w), slope(shader::WaveOp::kDdyFine, w)});
    });
  }
}

const ir::Expr* GraphicsSignature::place_of(const Leaf& leaf, Interpolation interpolation) {
  const ir::Variable* variable = wrapper_.parameters[leaf.element];
  if (elements[leaf.element].interpolation != interpolation) {
    ir::SignatureElement element = elements[leaf.element];
    element.interpolation = interpolation;
    variable = imply(std::move(element), "at_place", variable->type);
  }
  return build_.convert(build_.read(variable), plain_scalar(leaf.type->scalar));
}

void GraphicsSignature::check_limits(SourceLocation location) {
  std::vector<ir::SignatureElement> distances;
  uint32_t floats = 0;
  for (const ir::SignatureElement& element : elements) {
    if (element.system_value == SystemValue::kClipDistance ||
        element.system_value == SystemValue::kCullDistance) {
      distances.push_back(element);
      floats += element.components;
    }
  }
  const uint32_t rows = count_vectors(distances, true);
  if (floats > 8 || rows > 2) {
    fail(CheckId::kClipDistances, location,
         {shader(), std::to_string(floats), std::to_string(rows)});
  }
  if (point_ == SignaturePoint::kPixelOut) return;
  const uint32_t vectors = count_vectors(elements, point_ != SignaturePoint::kVertexIn);
  if (vectors > kMostVectors) {
    fail(CheckId::kSignatureVectors, location,
         {is_output_ ? "outputs" : "inputs", shader(), std::to_string(vectors),
          std::to_string(kMostVectors)});
  }
}

const ir::Expr* GraphicsSignature::thread(const ir::Type* type) {
  const ir::Expr* zero = build_.uint32(0);
  if (point_ == SignaturePoint::kPixelIn) {
    const ir::Expr* pixel = build_.convert(build_.swizzle(position(2), {0, 1}), Scalar::kUint32);
    return build_.construct(type, {pixel, zero});
  }
  if (point_ == SignaturePoint::kGeometryIn) {
    const ir::Expr* primitive = number("SV_PrimitiveID", SystemValue::kPrimitiveId);
    return build_.construct(
        type, {primitive, number("SV_GSInstanceID", SystemValue::kGeometryInstance), zero});
  }
  const ir::Expr* vertex = number("SV_VertexID", SystemValue::kVertexId);
  const ir::Expr* instance = number("SV_InstanceID", SystemValue::kInstanceId);
  return build_.construct(type, {vertex, instance, zero});
}

SignaturePoint GraphicsSignature::point_of(uint32_t stage, bool is_output) {
  switch (stage) {
    case ir::kStageVertex:
      return is_output ? SignaturePoint::kVertexOut : SignaturePoint::kVertexIn;
    case ir::kStageGeometry:
      return is_output ? SignaturePoint::kGeometryOut : SignaturePoint::kGeometryIn;
    default:
      return is_output ? SignaturePoint::kPixelOut : SignaturePoint::kPixelIn;
  }
}

std::string GraphicsSignature::shader() const {
  return std::string(stage_name(entry_.stage)) + " shader '" + entry_.name + "'";
}

void GraphicsSignature::fail(CheckId id, SourceLocation location,
                             std::initializer_list<std::string> arguments) {
  report(id, location, arguments);
  failed = true;
}

const ir::Expr* GraphicsSignature::walk(const Type* type, Name& name, const Source& source,
                                        const ir::Expr* value) {
  if (failed) return nullptr;
  if (type->is_struct()) return walk_struct(type, name, source, value);
  if (!name.semantic) {
    fail(CheckId::kGraphicsSemantic, source.location,
         {std::string(source.name), std::string(stage_name(entry_.stage)), entry_.name});
    return nullptr;
  }
  if (type->is_array() && type->count != 0) return walk_array(type, name, source, value);
  if (type->is_long_vector()) {
    fail(CheckId::kLongVectorPlace, source.location,
         {is_output_ ? "the outputs of an entry point" : "the parameters of an entry point",
          to_string(type)});
    return nullptr;
  }
  const bool fits = type->is_numeric() && !has_paired_texel(type);
  if (!fits) {
    fail(CheckId::kSignatureType, source.location,
         {std::string(source.name), to_string(type), shader()});
    return nullptr;
  }
  if (type->is_matrix()) return walk_matrix(type, name, source, value);
  leaves.push_back({parameter_, path_, elements.size(), type});
  return walk_vector(type, name, source, value);
}

const ir::Expr* GraphicsSignature::walk_struct(const Type* type, Name& outer, const Source& source,
                                               const ir::Expr* value) {
  const StructInfo& info = *type->structure;
  std::vector<const ir::Expr*> parts;
  if (info.base) {
    path_.push_back(0);
    parts.push_back(walk(info.base->type, outer, source, value ? build_.field(value, 0) : nullptr));
    path_.pop_back();
  }
  for (const FieldInfo& field : info.fields) {
    if (field.type->is_error() || field.unit) {
      fail(CheckId::kSignatureType, source.location,
           {std::string(source.name), to_string(type), shader()});
      return nullptr;
    }
    if (!field.decl) {  // of RayDesc: named by what holds it
      parts.push_back(
          walk(field.type, outer, source, value ? build_.field(value, field.index) : nullptr));
      continue;
    }
    const Modifiers own = field.decl->modifiers & kInterpolationModifiers;
    Name inner = {field.decl->annotations.semantic, 0};
    if (inner.semantic) inner.next = inner.semantic->index;
    const Source place = {field.decl->location, field.name,
                          own ? own : source.modifiers & kInterpolationModifiers};
    path_.push_back(field.index);
    parts.push_back(walk(field.type, outer.semantic ? outer : inner, place,
                         value ? build_.field(value, field.index) : nullptr));
    path_.pop_back();
  }
  if (failed || value) return nullptr;
  return build_.construct(type->ir, std::move(parts));
}

const ir::Expr* GraphicsSignature::walk_array(const Type* type, Name& name, const Source& source,
                                              const ir::Expr* value) {
  std::vector<const ir::Expr*> parts;
  for (uint32_t i = 0; i < type->count && !failed; ++i) {
    if (elements.size() > 4 * kMostVectors) break;  // reported by check_limits()
    const ir::Expr* part = value ? build_.element(value, build_.uint32(i)) : nullptr;
    path_.push_back(i);
    parts.push_back(walk(type->element, name, source, part));
    path_.pop_back();
  }
  if (failed || value) return nullptr;
  parts.resize(type->count, build_.zero(type->element->ir));
  return build_.construct(type->ir, std::move(parts));
}

const ir::Expr* GraphicsSignature::walk_matrix(const Type* type, Name& name, const Source& source,
                                               const ir::Expr* value) {
  const auto columns = static_cast<uint8_t>(type->columns);
  const uint8_t lines = type->row_major ? type->rows : columns;
  const uint8_t size = type->row_major ? columns : type->rows;
  const Type* line_type = types_.vector(type->scalar, size);
  std::vector<const ir::Expr*> components(size_t{type->rows} * type->columns);
  for (uint8_t line = 0; line < lines && !failed; ++line) {
    std::vector<uint8_t> places;
    for (uint8_t i = 0; i < size; ++i) {
      places.push_back(static_cast<uint8_t>(type->row_major ? line * 4 + i : i * 4 + line));
    }
    path_.push_back(line);
    leaves.push_back({parameter_, path_, elements.size(), line_type});
    path_.pop_back();
    const ir::Expr* part = walk_vector(line_type, name, source,
                                       value ? build_.matrix_swizzle(value, places) : nullptr);
    for (uint8_t i = 0; i < size && part; ++i) {
      const size_t at = size_t{places[i]} / 4 * type->columns + places[i] % 4;
      components[at] = size == 1 ? part : build_.swizzle(part, {i});
    }
  }
  if (failed || value) return nullptr;
  return build_.construct(type->ir, std::move(components));
}

const ir::Expr* GraphicsSignature::walk_vector(const Type* type, Name& name, const Source& source,
                                               const ir::Expr* value) {
  ir::SignatureElement element;
  element.semantic = std::string(name.semantic->base);
  element.semantic_index = name.next++;
  element.location = locate(source.location);
  if (find_semantic(element.semantic, point_).meaning == SemanticMeaning::kZero) {
    return zero_input(type, *name.semantic, source);
  }
  if (corner_ > 0) return read_element(next_element_++, type);
  if (!describe(element, type, *name.semantic, source)) return nullptr;
  const Scalar scalar = element.type == ColumnType::kFloat ? Scalar::kFloat32
                        : element.type == ColumnType::kInt ? Scalar::kInt32
                                                           : Scalar::kUint32;
  const Type* own = types_.numeric(scalar, 0, type->components());
  at(source.location);
  if (!elements.empty()) {
    element.first_column = elements.back().first_column + elements.back().components;
  }
  elements.push_back(std::move(element));
  if (point_ == SignaturePoint::kGeometryOut) return nullptr;
  ir::Variable* variable = build_.variable(
      std::string(source.name), corners_ != 0 ? types_.array(own, corners_)->ir : own->ir,
      ir::Storage::kParameter);
  variable->mode = is_output_ ? ir::ParameterMode::kOut : ir::ParameterMode::kIn;
  wrapper_.parameters.push_back(variable);
  if (!value) return read_element(elements.size() - 1, type);
  ir::Stmt* statement = build_.stmt(ir::StmtKind::kAssign);
  statement->place = build_.read(variable);
  statement->value = bounded(*name.semantic, build_.convert(value, plain_scalar(scalar)));
  lower_.body.emit(statement);
  return nullptr;
}

const ir::Expr* GraphicsSignature::read_element(size_t element, const Type* type) {
  const ir::Expr* value = build_.read(wrapper_.parameters[element]);
  if (corners_ != 0) value = build_.element(value, build_.uint32(corner_));
  return build_.convert(value, plain_scalar(type->scalar));
}

const ir::Expr* GraphicsSignature::bounded(const Semantic& semantic, const ir::Expr* value) {
  const bool rises = same_letters(semantic.base, "SV_DepthGreaterEqual");
  if (!rises && !same_letters(semantic.base, "SV_DepthLessEqual")) return value;
  return build_.intrinsic(rises ? Intrinsic::max : Intrinsic::min, value->type,
                          {value, inputs->depth_of_pixel()});
}

const ir::Expr* GraphicsSignature::position(uint8_t least_components) {
  for (size_t i = 0; i < elements.size(); ++i) {
    if (elements[i].system_value == SystemValue::kPosition &&
        elements[i].components >= least_components) {
      return build_.read(wrapper_.parameters[i]);
    }
  }
  ir::SignatureElement element;
  element.semantic = "SV_Position";
  element.system_value = SystemValue::kPosition;
  element.components = 4;
  const ir::Type* type = build_.vector_type(Scalar::kFloat32, 4);
  return build_.read(imply(std::move(element), "position", type));
}

const ir::Expr* GraphicsSignature::number(const char* semantic, SystemValue value) {
  for (size_t i = 0; i < elements.size(); ++i) {
    if (elements[i].system_value != value) continue;
    return build_.convert(build_.read(wrapper_.parameters[i]), Scalar::kUint32);
  }
  ir::SignatureElement element;
  element.semantic = semantic;
  element.system_value = value;
  element.type = ColumnType::kUint;
  element.interpolation = Interpolation::kNoInterpolation;
  element.components = 1;
  const ir::Type* type = build_.scalar_type(Scalar::kUint32);
  return build_.read(imply(std::move(element), "number", type));
}

const ir::Variable* GraphicsSignature::imply(ir::SignatureElement element, const char* name,
                                             const ir::Type* type) {
  element.is_implied = true;
  if (!elements.empty()) {
    element.first_column = elements.back().first_column + elements.back().components;
  }
  ir::Variable* variable = build_.variable(name, type, ir::Storage::kParameter);
  variable->mode = ir::ParameterMode::kIn;
  wrapper_.parameters.insert(
      wrapper_.parameters.begin() + static_cast<std::ptrdiff_t>(elements.size()), variable);
  elements.push_back(std::move(element));
  return variable;
}

const ir::Expr* GraphicsSignature::zero_input(const Type* type, const Semantic& semantic,
                                              const Source& source) {
  if (type->is_scalar() && is_integer(type->scalar)) return build_.zero(type->ir);
  fail(CheckId::kSystemValueType, source.location,
       {std::string(semantic.text), "uint", to_string(type)});
  return nullptr;
}

bool GraphicsSignature::describe(ir::SignatureElement& element, const Type* type,
                                 const Semantic& semantic, const Source& source) {
  const SemanticRule rule = find_semantic(semantic.base, point_);
  if (rule.meaning == SemanticMeaning::kNotOffered) {
    fail(CheckId::kSemanticNotOffered, semantic.location, {std::string(semantic.text), shader()});
    return false;
  }
  const bool of_primitive =
      rule.value == SystemValue::kPrimitiveId || rule.value == SystemValue::kGeometryInstance;
  const bool misplaced = point_ == SignaturePoint::kGeometryIn && of_primitive != (corners_ == 0);
  if (rule.meaning == SemanticMeaning::kNotThere || misplaced) {
    if (point_ == SignaturePoint::kPixelOut) {
      fail(CheckId::kPixelOutput, semantic.location, {std::string(semantic.text), entry_.name});
    } else {
      fail(CheckId::kSemanticNotThere, semantic.location,
           {std::string(semantic.text),
            is_output_      ? "an output"
            : !misplaced    ? "an input"
            : corners_ == 0 ? "an input of the whole primitive"
                            : "an input of a corner",
            shader()});
    }
    return false;
  }
  std::string_view wanted;
  if (!fits_system_value(rule.value, type, wanted)) {
    fail(CheckId::kSystemValueType, source.location,
         {std::string(semantic.text), std::string(wanted), to_string(type)});
    return false;
  }
  if (rule.value == SystemValue::kTarget && element.semantic_index >= kMostTargets) {
    fail(CheckId::kTargetNumber, semantic.location,
         {std::to_string(element.semantic_index), std::to_string(kMostTargets)});
    return false;
  }
  for (const ir::SignatureElement& other : elements) {
    const bool two_depths =
        rule.value == SystemValue::kDepth && other.system_value == SystemValue::kDepth;
    if (two_depths || (other.semantic_index == element.semantic_index &&
                       same_letters(other.semantic, element.semantic))) {
      fail(CheckId::kSemanticTwice, source.location,
           {is_output_ ? "outputs" : "inputs", shader(),
            element.semantic + std::to_string(element.semantic_index)});
      return false;
    }
  }
  element.system_value = rule.value;
  element.components = static_cast<uint8_t>(type->components());
  element.type = is_floating(type->scalar)         ? ColumnType::kFloat
                 : is_signed_integer(type->scalar) ? ColumnType::kInt
                                                   : ColumnType::kUint;
  return interpolate(element, type, source);
}

bool GraphicsSignature::interpolate(ir::SignatureElement& element, const Type* type,
                                    const Source& source) {
  element.interpolation = Interpolation::kLinear;
  if (point_ == SignaturePoint::kVertexIn || point_ == SignaturePoint::kPixelOut ||
      point_ == SignaturePoint::kGeometryIn) {
    return true;
  }
  const Modifiers modifiers = source.modifiers & kInterpolationModifiers;
  const bool straight = (modifiers & kModNoPerspective) != 0;
  if (modifiers & kModNoInterpolation) {
    element.interpolation = Interpolation::kNoInterpolation;
  } else if (modifiers & kModSample) {
    element.interpolation = straight ? Interpolation::kSampleNoPerspective : Interpolation::kSample;
  } else if (modifiers & kModCentroid) {
    element.interpolation =
        straight ? Interpolation::kCentroidNoPerspective : Interpolation::kCentroid;
  } else if (straight) {
    element.interpolation = Interpolation::kNoPerspective;
  }
  if (element.type == ColumnType::kFloat) return true;
  const bool varies = modifiers != 0 && !(modifiers & kModNoInterpolation);
  if (varies && point_ == SignaturePoint::kPixelIn) {
    fail(CheckId::kInterpolatedInteger, source.location,
         {std::string(source.name), to_string(type), shader()});
    return false;
  }
  // Pixels of one triangle differ in their coverage.
  if (element.system_value == SystemValue::kCoverage) return true;
  element.interpolation = Interpolation::kNoInterpolation;
  return true;
}

}  // namespace kaamos::hlsl

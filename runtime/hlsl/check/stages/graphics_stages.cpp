// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/stages/graphics_stages.h"

#include <algorithm>
#include <utility>

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/attributes.h"
#include "runtime/hlsl/check/stages/system_values.h"
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

// Builds one of the two signatures of an entry point.
class GraphicsSignature : StagePart {
 public:
  // A semantic that covers several elements gives them numbers that go up.
  struct Name {
    const Semantic* semantic = nullptr;
    uint32_t next = 0;
  };
  // The place of a value in the source.
  struct Source {
    SourceLocation location;
    std::string_view name;
    Modifiers modifiers = 0;
  };

  // `live`: of a pixel shader.
  GraphicsSignature(Program& program, Lowerer& lowerer, const ir::EntryPoint& entry, bool is_output,
                    ir::Function& wrapper, const ir::Variable* live)
      : StagePart(program, lowerer),
        entry_(entry),
        is_output_(is_output),
        wrapper_(wrapper),
        point_(point_of(entry.stage, is_output)),
        live_(live) {}

  // A scalar or vector of an input: which parameter, which part of it, which element.
  struct Leaf {
    size_t parameter;
    std::vector<uint32_t> path;
    size_t element;
    const Type* type;
  };

  std::vector<ir::SignatureElement> elements;
  std::vector<Leaf> leaves;
  bool failed = false;
  GraphicsSignature* inputs = nullptr;  // of the outputs of a pixel shader

  // An input's value, made of parameters of the wrapper; null after an error.
  const ir::Expr* read(const Type* type, Name& name, const Source& source, size_t parameter) {
    parameter_ = parameter;
    return walk(type, name, source, nullptr);
  }
  // The same of an array with an element for each corner of a primitive.
  const ir::Expr* read_corners(const Type* type, const Name& name, const Source& source,
                               size_t parameter) {
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
  // The elements of a stream's vertex; emitting assigns them. [lower/streams.h]
  void describe_vertex(const Type* type, const Source& source) {
    Name name;
    walk(type, name, source, build_.zero(type->ir));
  }
  // Assigns the value to parameters of the wrapper.
  void write(const Type* type, Name& name, const Source& source, const ir::Expr* value) {
    walk(type, name, source, value);
  }

  // Fills the static variables of GetAttributeAtVertex and EvaluateAttribute*.
  void read_inputs(const FunctionInfo& function) {
    for (const InputRead& read : function.input_reads) {
      const auto leaf = std::find_if(leaves.begin(), leaves.end(), [&](const Leaf& one) {
        return function.ir->parameters[one.parameter] == read.parameter && one.path == read.path;
      });
      const bool of_vertices = read.of_vertices;
      if (leaf == leaves.end() || leaf->element >= elements.size() ||
          (of_vertices &&
           elements[leaf->element].interpolation != Interpolation::kNoInterpolation) ||
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
        return straight
                   ? one
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

  // The input at another place: itself, or one that is added.
  const ir::Expr* place_of(const Leaf& leaf, Interpolation interpolation) {
    const ir::Variable* variable = wrapper_.parameters[leaf.element];
    if (elements[leaf.element].interpolation != interpolation) {
      ir::SignatureElement element = elements[leaf.element];
      element.interpolation = interpolation;
      variable = imply(std::move(element), "at_place", variable->type);
    }
    return build_.convert(build_.read(variable), plain_scalar(leaf.type->scalar));
  }

  void check_limits(SourceLocation location) {
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

  const ir::Expr* sample_count() { return number("SV_SampleCount", SystemValue::kSampleCount); }

  // The thread that printf names.
  const ir::Expr* thread(const ir::Type* type) {
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

 private:
  static SignaturePoint point_of(uint32_t stage, bool is_output) {
    switch (stage) {
      case ir::kStageVertex:
        return is_output ? SignaturePoint::kVertexOut : SignaturePoint::kVertexIn;
      case ir::kStageGeometry:
        return is_output ? SignaturePoint::kGeometryOut : SignaturePoint::kGeometryIn;
      default:
        return is_output ? SignaturePoint::kPixelOut : SignaturePoint::kPixelIn;
    }
  }
  std::string shader() const {
    return std::string(stage_name(entry_.stage)) + " shader '" + entry_.name + "'";
  }
  void fail(CheckId id, SourceLocation location, std::initializer_list<std::string> arguments) {
    report(id, location, arguments);
    failed = true;
  }

  const ir::Expr* walk(const Type* type, Name& name, const Source& source, const ir::Expr* value) {
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

  const ir::Expr* walk_struct(const Type* type, Name& outer, const Source& source,
                              const ir::Expr* value) {
    const StructInfo& info = *type->structure;
    std::vector<const ir::Expr*> parts;
    if (info.base) {
      path_.push_back(0);
      parts.push_back(
          walk(info.base->type, outer, source, value ? build_.field(value, 0) : nullptr));
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

  const ir::Expr* walk_array(const Type* type, Name& name, const Source& source,
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

  // A matrix that is not row_major is passed by columns, as DXC does.
  const ir::Expr* walk_matrix(const Type* type, Name& name, const Source& source,
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

  const ir::Expr* walk_vector(const Type* type, Name& name, const Source& source,
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

  const ir::Expr* read_element(size_t element, const Type* type) {
    const ir::Expr* value = build_.read(wrapper_.parameters[element]);
    if (corners_ != 0) value = build_.element(value, build_.uint32(corner_));
    return build_.convert(value, plain_scalar(type->scalar));
  }

  // SV_DepthGreaterEqual never lowers the pixel's depth, SV_DepthLessEqual never raises it.
  const ir::Expr* bounded(const Semantic& semantic, const ir::Expr* value) {
    const bool rises = same_letters(semantic.base, "SV_DepthGreaterEqual");
    if (!rises && !same_letters(semantic.base, "SV_DepthLessEqual")) return value;
    return build_.intrinsic(rises ? Intrinsic::max : Intrinsic::min, value->type,
                            {value, inputs->depth_of_pixel()});
  }

  const ir::Expr* depth_of_pixel() { return build_.swizzle(position(3), {2}); }

  // SV_Position of a pixel shader, which becomes the last input if it is none yet.
  const ir::Expr* position(uint8_t least_components) {
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

  // The same for a uint that the input assembler makes.
  const ir::Expr* number(const char* semantic, SystemValue value) {
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

  // Adds an input behind the others.
  const ir::Variable* imply(ir::SignatureElement element, const char* name, const ir::Type* type) {
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

  const ir::Expr* zero_input(const Type* type, const Semantic& semantic, const Source& source) {
    if (type->is_scalar() && is_integer(type->scalar)) return build_.zero(type->ir);
    fail(CheckId::kSystemValueType, source.location,
         {std::string(semantic.text), "uint", to_string(type)});
    return nullptr;
  }

  bool describe(ir::SignatureElement& element, const Type* type, const Semantic& semantic,
                const Source& source) {
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

  bool interpolate(ir::SignatureElement& element, const Type* type, const Source& source) {
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
      element.interpolation =
          straight ? Interpolation::kSampleNoPerspective : Interpolation::kSample;
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

  const ir::EntryPoint& entry_;
  const bool is_output_;
  ir::Function& wrapper_;
  const SignaturePoint point_;
  const ir::Variable* const live_;
  size_t parameter_ = 0;  // the function's that is being read
  uint32_t corners_ = 0;  // of the primitive whose corners are being read
  uint32_t corner_ = 0;
  size_t next_element_ = 0;  // of the corner
  std::vector<uint32_t> path_;
};

}  // namespace

bool GraphicsStages::check_graphics_signature(FunctionInfo* function, ir::EntryPoint& entry) {
  if (!function->ir) return false;
  const SourceLocation location = function->definition->location;
  ir::Function* wrapper = make_wrapper(bench_.module, build_, *function->ir);
  // The export keeps the name that DXC gives it.
  std::string& mangled = function->ir->mangled;
  if (mangled.ends_with("#body")) mangled.resize(mangled.size() - 5);
  wrapper->mangled = mangled;
  mangled += "#body";
  BodyScope body(lower_, nullptr, &wrapper->body, function->scope);
  at(location);
  const bool is_pixel = entry.stage == ir::kStagePixel;
  const bool is_geometry = entry.stage == ir::kStageGeometry;
  if (is_geometry && !geometry_.read_attributes(*function, entry)) return false;
  const ir::Type* flag = build_.scalar_type(Scalar::kBool);
  const auto flag_parameter = [&](const char* name, ir::ParameterMode mode) {
    ir::Variable* variable = build_.variable(name, flag, ir::Storage::kParameter);
    variable->mode = mode;
    return variable;
  };
  ir::Variable* is_live = is_pixel ? flag_parameter("is_live", ir::ParameterMode::kIn) : nullptr;
  const ir::Variable* live = is_pixel ? live_variable() : nullptr;
  if (is_pixel) lower_.body.assign(live, build_.read(is_live));
  if (!read_waves_of_helpers(*function, entry)) return false;
  GraphicsSignature inputs(program_, lower_, entry, false, *wrapper, live);
  GraphicsSignature outputs(program_, lower_, entry, true, *wrapper, live);
  outputs.inputs = &inputs;
  const auto name_of_value = [](const Semantic* semantic) {
    return GraphicsSignature::Name{semantic, semantic ? semantic->index : 0};
  };

  ir::Stmt* call = build_.stmt(ir::StmtKind::kCall);
  call->function = function->ir;
  struct Output {
    const Type* type;
    GraphicsSignature::Name name;
    GraphicsSignature::Source source;
    const ir::Variable* variable;
  };
  std::vector<Output> results;
  if (!function->result->is_void()) {
    const Semantic* semantic = function->definition->annotations.semantic;
    if (!semantic) semantic = function->decl->annotations.semantic;
    ir::Variable* result = lower_.body.empty_temporary(function->result->ir);
    call->result = result;
    results.push_back({function->result, name_of_value(semantic), {location, "result"}, result});
  }
  for (const ParameterInfo& parameter : function->parameters) {
    if (!parameter.decl) continue;
    const Modifiers modifiers = parameter.decl->modifiers;
    const GraphicsSignature::Source source = {parameter.decl->location, parameter.name, modifiers};
    const Semantic* semantic = parameter.decl->annotations.semantic;
    if (modifiers & kModUniform) {
      report(CheckId::kUnsupported, source.location,
             {"'" + std::string(parameter.name) + "' (a uniform parameter of an entry point)"});
      return false;
    }
    if (is_geometry && parameter.type->is_stream()) {
      if (!geometry_.take_stream(parameter, entry)) return false;
      outputs.describe_vertex(parameter.type->structure->stream_vertex, source);
      call->arguments.push_back(build_.read(lower_.body.empty_temporary(parameter.type->ir)));
      continue;
    }
    if (is_geometry && (modifiers & kModPrimitive) != 0) {
      if (!geometry_.take_primitive(parameter, entry)) return false;
      call->arguments.push_back(inputs.read_corners(parameter.type, name_of_value(semantic), source,
                                                    call->arguments.size()));
      continue;
    }
    const ir::Expr* value = nullptr;
    if (parameter.is_in) {
      GraphicsSignature::Name name = name_of_value(semantic);
      value = inputs.read(parameter.type, name, source, call->arguments.size());
    }
    if (parameter.is_out) {
      ir::Variable* variable = lower_.body.empty_temporary(parameter.type->ir);
      if (value) lower_.body.assign(variable, value);
      value = build_.read(variable);
      results.push_back({parameter.type, name_of_value(semantic), source, variable});
    }
    call->arguments.push_back(value);
  }
  if (is_geometry && !inputs.failed && !outputs.failed &&
      !geometry_.check_shape(*function, outputs.elements, entry)) {
    return false;
  }
  if (!inputs.failed) inputs.check_limits(location);
  if (is_pixel && !inputs.failed) inputs.read_inputs(*function);
  if (is_pixel && bench_.sample_count && !inputs.failed) {
    function->globals.push_back(bench_.sample_count);
    lower_.body.assign(bench_.sample_count->variable, inputs.sample_count());
  }
  if (const ir::Variable* thread = lower_.printing.thread(); thread && !inputs.failed) {
    lower_.printing.use_thread(*function);
    lower_.body.assign(thread, inputs.thread(thread->type));
  }
  function->is_pixel_entry = function->is_pixel_entry || is_pixel;
  lower_.body.emit(call);
  for (Output& output : results) {
    outputs.write(output.type, output.name, output.source, build_.read(output.variable));
  }
  if (!outputs.failed) outputs.check_limits(location);
  entry.parameters.assign(inputs.elements.size(), ir::EntryParameter::kInput);
  if (!is_geometry) {
    entry.parameters.resize(entry.parameters.size() + outputs.elements.size(),
                            ir::EntryParameter::kOutput);
  }
  if (is_pixel) {
    wrapper->parameters.push_back(is_live);
    ir::Variable* stays = flag_parameter("stays_live", ir::ParameterMode::kOut);
    wrapper->parameters.push_back(stays);
    lower_.body.assign(stays, build_.read(live));
    entry.parameters.push_back(ir::EntryParameter::kIsLive);
    entry.parameters.push_back(ir::EntryParameter::kStaysLive);
  }
  entry.inputs = std::move(inputs.elements);
  entry.outputs = std::move(outputs.elements);
  if (inputs.failed || outputs.failed) return false;
  if (find_attribute(*function, "earlydepthstencil")) {
    entry.graphics_flags |= shader::kGraphicsEarlyDepthStencil;
  }
  program_.facts.wrappers.push_back({wrapper, function, entry.stage});
  entry.function = wrapper;
  return true;
}

// [WaveOpsIncludeHelperLanes]
bool GraphicsStages::read_waves_of_helpers(const FunctionInfo& function,
                                           const ir::EntryPoint& entry) {
  const Attribute* attribute = find_attribute(function, "WaveOpsIncludeHelperLanes");
  if (!attribute || entry.stage != ir::kStagePixel) return true;
  if (shader_model_minor(program_.options->target) < 7) {
    report(CheckId::kWaveShaderModel, attribute->location,
           {"[WaveOpsIncludeHelperLanes]", "6.7", program_.options->target});
    return false;
  }
  ir::Variable*& variable = program_.facts.waves_of_helpers;
  if (!variable) {
    variable = build_.variable("waves_of_helpers", build_.scalar_type(Scalar::kBool),
                               ir::Storage::kStaticGlobal);
  }
  lower_.body.assign(variable, build_.boolean(true));
  return true;
}

const ir::Variable* GraphicsStages::live_variable() {
  if (!program_.facts.live) {
    program_.facts.live =
        build_.variable("live", build_.scalar_type(Scalar::kBool), ir::Storage::kStaticGlobal);
  }
  return program_.facts.live;
}

}  // namespace kaamos::hlsl

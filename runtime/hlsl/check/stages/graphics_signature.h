// SPDX-License-Identifier: MIT
//
// One of the two signatures of a vertex, geometry or pixel shader: parameters, fields, elements and
// rows become scalars and vectors with semantics, and parameters of the entry point's wrapper.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/hlsl/check/stages/stage_part.h"
#include "runtime/hlsl/check/stages/system_values.h"

namespace kaamos::hlsl {

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
  const ir::Expr* read(const Type* type, Name& name, const Source& source, size_t parameter);
  // The same of an array with an element for each corner of a primitive.
  const ir::Expr* read_corners(const Type* type, const Name& name, const Source& source,
                               size_t parameter);
  // The elements of a stream's vertex; emitting assigns them. [lower/streams.h]
  void describe_vertex(const Type* type, const Source& source);
  // Assigns the value to parameters of the wrapper.
  void write(const Type* type, Name& name, const Source& source, const ir::Expr* value);

  // Fills the static variables of GetAttributeAtVertex and EvaluateAttribute*.
  void read_inputs(const FunctionInfo& function);

  // The input at another place: itself, or one that is added.
  const ir::Expr* place_of(const Leaf& leaf, shader::Interpolation interpolation);

  void check_limits(SourceLocation location);

  const ir::Expr* sample_count() {
    return number("SV_SampleCount", shader::SystemValue::kSampleCount);
  }

  // The thread that printf names.
  const ir::Expr* thread(const ir::Type* type);

 private:
  static SignaturePoint point_of(uint32_t stage, bool is_output);
  std::string shader() const;
  void fail(CheckId id, SourceLocation location, std::initializer_list<std::string> arguments);

  const ir::Expr* walk(const Type* type, Name& name, const Source& source, const ir::Expr* value);

  const ir::Expr* walk_struct(const Type* type, Name& outer, const Source& source,
                              const ir::Expr* value);

  const ir::Expr* walk_array(const Type* type, Name& name, const Source& source,
                             const ir::Expr* value);

  // A matrix that is not row_major is passed by columns, as DXC does.
  const ir::Expr* walk_matrix(const Type* type, Name& name, const Source& source,
                              const ir::Expr* value);

  const ir::Expr* walk_vector(const Type* type, Name& name, const Source& source,
                              const ir::Expr* value);

  const ir::Expr* read_element(size_t element, const Type* type);

  // SV_DepthGreaterEqual never lowers the pixel's depth, SV_DepthLessEqual never raises it.
  const ir::Expr* bounded(const Semantic& semantic, const ir::Expr* value);

  const ir::Expr* depth_of_pixel() { return build_.swizzle(position(3), {2}); }

  // SV_Position of a pixel shader, which becomes the last input if it is none yet.
  const ir::Expr* position(uint8_t least_components);

  // The same for a uint that the input assembler makes.
  const ir::Expr* number(const char* semantic, shader::SystemValue value);

  // Adds an input behind the others.
  const ir::Variable* imply(ir::SignatureElement element, const char* name, const ir::Type* type);

  const ir::Expr* zero_input(const Type* type, const Semantic& semantic, const Source& source);

  bool describe(ir::SignatureElement& element, const Type* type, const Semantic& semantic,
                const Source& source);

  bool interpolate(ir::SignatureElement& element, const Type* type, const Source& source);

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

}  // namespace kaamos::hlsl

// SPDX-License-Identifier: MIT
//
// What a geometry shader says of the primitives that it takes and makes. [HLSL: Geometry-Shader
// Object; D3D11.3: 13]
#pragma once

#include <vector>

#include "runtime/hlsl/check/stages/stage_part.h"

namespace kaamos::hlsl {

class GeometryShapes : StagePart {
 public:
  using StagePart::StagePart;

  // [maxvertexcount] and [instance].
  bool read_attributes(const FunctionInfo& function, ir::EntryPoint& entry);
  // `triangle V input[3]`
  bool take_primitive(const ParameterInfo& parameter, ir::EntryPoint& entry);
  // `inout TriangleStream<V> output`
  bool take_stream(const ParameterInfo& parameter, ir::EntryPoint& entry);
  bool check_shape(const FunctionInfo& function, const std::vector<ir::SignatureElement>& outputs,
                   const ir::EntryPoint& entry);

 private:
  bool refuse(SourceLocation location, const ir::EntryPoint& entry, const std::string& what);
  bool read_number(const FunctionInfo& function, const char* name, uint32_t most,
                   const ir::EntryPoint& entry, uint32_t& number);
};

}  // namespace kaamos::hlsl

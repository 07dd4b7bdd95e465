// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/stages/geometry_shape.h"

#include <string>

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/check/names/attributes.h"

namespace kaamos::hlsl {
namespace {

constexpr uint32_t kMostVertices = 1024;
constexpr uint32_t kMostInstances = 32;
constexpr uint32_t kMostScalars = 1024;  // of all vertices of a call

struct Primitive {
  Modifiers word;
  const char* text;
  uint32_t corners;
  bool is_offered = true;
};
constexpr Primitive kPrimitives[] = {{kModPoint, "point", 1},
                                     {kModLine, "line", 2},
                                     {kModTriangle, "triangle", 3},
                                     {kModLineAdj, "lineadj", 4, false},
                                     {kModTriangleAdj, "triangleadj", 6, false}};

}  // namespace

bool GeometryShapes::refuse(SourceLocation location, const ir::EntryPoint& entry,
                            const std::string& what) {
  report(CheckId::kGeometryShader, location, {entry.name, what});
  return false;
}

// Leaves `number` alone if there is no such attribute.
bool GeometryShapes::read_number(const FunctionInfo& function, const char* name, uint32_t most,
                                 const ir::EntryPoint& entry, uint32_t& number) {
  const Attribute* attribute = find_attribute(function, name);
  if (!attribute) return true;
  if (attribute->arguments.size() != 1) {
    report(CheckId::kArgumentCount, attribute->location,
           {name, "1", std::to_string(attribute->arguments.size())});
    return false;
  }
  const auto value = lower_.constant_integer(attribute->arguments[0], function.scope,
                                             std::string("the number of [") + name + "]");
  if (!value) return false;
  if (*value < 1 || *value > most) {
    return refuse(attribute->arguments[0]->location, entry,
                  std::string("has [") + name + "(" + std::to_string(*value) +
                      ")]; the number must be 1 to " + std::to_string(most));
  }
  number = static_cast<uint32_t>(*value);
  return true;
}

bool GeometryShapes::read_attributes(const FunctionInfo& function, ir::EntryPoint& entry) {
  return read_number(function, "maxvertexcount", kMostVertices, entry,
                     entry.geometry.most_vertices) &&
         read_number(function, "instance", kMostInstances, entry, entry.geometry.instances);
}

bool GeometryShapes::take_primitive(const ParameterInfo& parameter, ir::EntryPoint& entry) {
  const SourceLocation location = parameter.decl->location;
  if (entry.geometry.corners != 0) return refuse(location, entry, "takes two primitives");
  for (const Primitive& primitive : kPrimitives) {
    if ((parameter.decl->modifiers & primitive.word) == 0) continue;
    if (!primitive.is_offered) {
      report(CheckId::kUnsupported, location,
             {std::string("'") + primitive.text + "' (primitives with adjacent vertices)"});
      return false;
    }
    if (!parameter.type->is_array() || parameter.type->count != primitive.corners) {
      return refuse(location, entry,
                    "takes '" + std::string(parameter.name) + "' of type '" +
                        to_string(parameter.type) + "'; a " + primitive.text + " is an array of " +
                        std::to_string(primitive.corners));
    }
    entry.geometry.corners = primitive.corners;
  }
  return true;
}

bool GeometryShapes::take_stream(const ParameterInfo& parameter, ir::EntryPoint& entry) {
  const SourceLocation location = parameter.decl->location;
  if (entry.geometry.output_corners != 0) {
    report(CheckId::kUnsupported, location, {"a second stream of a geometry shader"});
    return false;
  }
  if (!parameter.is_in || !parameter.is_out) {
    return refuse(location, entry,
                  "takes stream '" + std::string(parameter.name) + "' by value; write inout");
  }
  entry.geometry.output_corners = parameter.type->structure->stream_corners;
  return true;
}

bool GeometryShapes::check_shape(const FunctionInfo& function,
                                 const std::vector<ir::SignatureElement>& outputs,
                                 const ir::EntryPoint& entry) {
  const SourceLocation location = function.definition->location;
  if (entry.geometry.most_vertices == 0) return refuse(location, entry, "has no [maxvertexcount]");
  if (entry.geometry.corners == 0) {
    return refuse(location, entry, "takes no primitive: an array with point, line or triangle");
  }
  if (entry.geometry.output_corners == 0) return refuse(location, entry, "takes no stream");
  if (!function.result->is_void()) {
    return refuse(location, entry, "returns '" + to_string(function.result) + "'; it must be void");
  }
  const uint32_t scalars =
      outputs.empty() ? 0 : outputs.back().first_column + outputs.back().components;
  if (scalars * entry.geometry.most_vertices > kMostScalars) {
    return refuse(location, entry,
                  "writes " + std::to_string(entry.geometry.most_vertices) + " vertices of " +
                      std::to_string(scalars) + " scalars; together at most " +
                      std::to_string(kMostScalars) + " scalars");
  }
  return true;
}

}  // namespace kaamos::hlsl

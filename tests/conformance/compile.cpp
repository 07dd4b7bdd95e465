// SPDX-License-Identifier: MIT
#include "tests/conformance/compile.h"

#include <rtapi/shader_compiler.h>

namespace kaamos::conformance {

rtapi::Status compile(const std::string& source, const std::string& target,
                      std::optional<bool> payload_qualifiers) {
  rtapi::ShaderCompileOptions options;
  options.File = "rule.hlsl";
  options.Source = source;
  options.Target = target;
  options.Experimental = true;
  options.PayloadQualifiers = payload_qualifiers;
  // The front end alone accepts or refuses a source, so no C++ compiler is needed.
  options.Interpret = true;
  options.Spirv = false;
  return rtapi::CompileShaderLibrary(options).Status;
}

std::string shader_of(const std::string& stage, const std::string& statements) {
  std::string parameters;
  if (stage == "anyhit" || stage == "closesthit") parameters = "inout P p, A a";
  if (stage == "miss" || stage == "callable") parameters = "inout P p";
  return "RaytracingAccelerationStructure scene : register(t0);\n"
         "RWByteAddressBuffer words : register(u0);\n"
         "struct P { uint value; };\n"
         "struct A { float2 barycentrics; };\n"
         "[shader(\"" +
         stage + "\")]\nvoid Shader(" + parameters +
         ") {\n"
         "  RayDesc ray;\n"
         "  ray.Origin = float3(0, 0, 0);\n  ray.TMin = 0;\n"
         "  ray.Direction = float3(0, 0, 1);\n  ray.TMax = 1;\n  " +
         statements + "\n}\n";
}

}  // namespace kaamos::conformance

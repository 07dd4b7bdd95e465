// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/signatures.h"

#include <algorithm>

namespace kaamos::hlsl {

bool have_same_parameters(const FunctionInfo& one, const FunctionInfo& other) {
  return std::equal(one.parameters.begin(), one.parameters.end(), other.parameters.begin(),
                    other.parameters.end(), [](const ParameterInfo& a, const ParameterInfo& b) {
                      return same_type(a.type, b.type) && a.is_out == b.is_out &&
                             a.is_in == b.is_in;
                    });
}

std::string describe(const FunctionInfo& function) {
  std::string text = function.result ? to_string(function.result) + " " : "";
  text += function.qualified + "(";
  if (function.is_template) return text + "..)";
  for (size_t i = 0; i < function.parameters.size(); ++i) {
    const ParameterInfo& parameter = function.parameters[i];
    if (i > 0) text += ", ";
    if (parameter.is_out) text += parameter.is_in ? "inout " : "out ";
    text += to_string(parameter.type);
  }
  return text + ")";
}

}  // namespace kaamos::hlsl

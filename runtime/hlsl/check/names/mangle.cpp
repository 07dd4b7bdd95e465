// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/names/mangle.h"

#include <algorithm>
#include <vector>

#include "runtime/hlsl/check/names/symbols.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {
namespace {

// Names and types that were seen before are written as a digit.
class Mangler {
 public:
  // `name` is one component, or a whole template such as "?$vector@M$02@".
  void source_name(const std::string& name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found != names_.end()) {
      text += static_cast<char>('0' + (found - names_.begin()));
      return;
    }
    if (names_.size() < 10) names_.push_back(name);
    text += name;
    if (!name.starts_with("?$")) text += '@';
  }

  // Innermost component first.
  void qualified_name(std::string_view qualified) {
    std::vector<std::string> parts;
    int depth = 0;
    std::string part;
    for (size_t i = 0; i < qualified.size(); ++i) {
      if (qualified[i] == '<') ++depth;
      if (qualified[i] == '>') --depth;
      if (depth == 0 && qualified.substr(i, 2) == "::") {
        parts.push_back(part);
        part.clear();
        ++i;
      } else {
        part += qualified[i];
      }
    }
    parts.push_back(part);
    for (auto at = parts.rbegin(); at != parts.rend(); ++at) source_name(*at);
    text += '@';
  }

  void numeric(const Type* type) {
    static constexpr std::string_view kCodes[] = {
        "_N",       "F",        "G",        "H",        "I",        "_J",
        "_K",       "$f16@",    "M",        "N",        "_J",       "N",
        "$halff@",  "$min16f@", "$min10f@", "$min16i@", "$min12i@", "$min16ui@",
        "$min16f@", "$min10f@", "$min16i@", "$min12i@", "$min16ui@"};
    const std::string code(kCodes[static_cast<size_t>(type->scalar)]);
    if (type->is_scalar()) {
      text += code;
      return;
    }
    text += 'V';
    std::string name = type->is_matrix() ? "?$matrix@" : "?$vector@";
    name += code;
    if (type->is_matrix()) name += "$0" + mangle_number(type->rows);
    source_name(name + "$0" + mangle_number(type->columns) + "@");
    text += '@';
  }

  void type(const Type* of) {
    switch (of->kind) {
      case TypeKind::kNumeric:
        numeric(of);
        return;
      case TypeKind::kEnum:
        text += "W4";
        qualified_name(of->enumeration->name);
        return;
      case TypeKind::kStruct:
        if (of->is_stream()) {
          const std::string_view name = of->structure->name;
          text += 'V';
          source_name("?$" + std::string(name.substr(0, name.find('<'))) + "@" +
                      mangle_type(of->structure->stream_vertex) + "@");
          text += '@';
          return;
        }
        text += 'U';
        qualified_name(of->structure->name);
        return;
      case TypeKind::kArray: {
        std::string bounds;
        int dimensions = 0;
        const Type* element = of;
        for (; element->is_array(); element = element->element) {
          ++dimensions;
          bounds += mangle_number(element->count);
        }
        text += "Y" + mangle_number(dimensions) + bounds;
        type(element);
        return;
      }
      case TypeKind::kResource: {
        const std::string name(resource_name(of->resource));
        if (of->element) {
          text += 'V';
          const bool has_samples = is_multisampled(of->resource);
          source_name("?$" + name + "@" + mangle_type(of->element) + (has_samples ? "$0A@" : "") +
                      "@");
        } else {
          text += 'U';
          source_name(name);
        }
        text += '@';
        return;
      }
      default:
        text += 'X';
    }
  }

  void parameter(const MangledParameter& of) {
    Mangler fresh;
    if (of.is_reference) fresh.text += "AIA";
    fresh.type(of.type);
    const auto found = std::find(types_.begin(), types_.end(), fresh.text);
    if (found != types_.end()) {
      text += static_cast<char>('0' + (found - types_.begin()));
      return;
    }
    if (fresh.text.size() > 1 && types_.size() < 10) types_.push_back(fresh.text);
    if (of.is_reference) text += "AIA";
    type(of.type);
  }

  std::string text;

 private:
  std::vector<std::string> names_;
  std::vector<std::string> types_;
};

}  // namespace

std::string mangle_number(int64_t value) {
  std::string text = value < 0 ? "?" : "";
  uint64_t magnitude =
      value < 0 ? uint64_t{0} - static_cast<uint64_t>(value) : static_cast<uint64_t>(value);
  if (magnitude >= 1 && magnitude <= 10) {
    return text + static_cast<char>('0' + magnitude - 1);
  }
  if (magnitude == 0) return "A@";
  std::string digits;
  for (; magnitude; magnitude >>= 4) digits += static_cast<char>('A' + (magnitude & 15));
  std::reverse(digits.begin(), digits.end());
  return text + digits + "@";
}

std::string mangle_type(const Type* type) {
  Mangler mangler;
  mangler.type(type);
  return mangler.text;
}

std::string mangle(std::string_view qualified, const Type* result,
                   std::span<const MangledParameter> parameters, bool is_method,
                   std::string_view template_arguments) {
  Mangler mangler;
  mangler.text = "\01?";
  if (!template_arguments.empty()) {
    // The last component is replaced by a template name.
    const size_t angle = qualified.find('<');
    const std::string_view plain = qualified.substr(0, angle);
    const size_t colon = plain.rfind("::");
    const std::string last(colon == std::string_view::npos ? plain : plain.substr(colon + 2));
    mangler.source_name("?$" + last + "@" + std::string(template_arguments) + "@");
    if (colon == std::string_view::npos) {
      mangler.text += '@';
    } else {
      mangler.qualified_name(plain.substr(0, colon));
    }
  } else {
    mangler.qualified_name(qualified);
  }
  mangler.text += is_method ? "QAA" : "YA";
  const bool is_class = result->is_struct() || result->is_resource() ||
                        (result->is_numeric() && !result->is_scalar()) || result->is_enum();
  if (is_class) mangler.text += "?A";
  mangler.type(result);
  if (parameters.empty()) {
    mangler.text += 'X';
  } else {
    for (const MangledParameter& parameter : parameters) mangler.parameter(parameter);
    mangler.text += '@';
  }
  return mangler.text + "Z";
}

std::string mangle(const FunctionInfo& function) {
  std::vector<MangledParameter> parameters;
  for (const ParameterInfo& parameter : function.parameters) {
    parameters.push_back({parameter.type, parameter.is_out && parameter.type->is_numeric()});
  }
  std::string arguments;
  for (const TemplateValue& value : function.template_values) {
    arguments += value.type ? mangle_type(value.type)
                            : "$0" + mangle_number(static_cast<int64_t>(value.value->literal[0]));
  }
  return mangle(function.qualified, function.result, parameters,
                function.owner && !function.is_static, arguments);
}

}  // namespace kaamos::hlsl

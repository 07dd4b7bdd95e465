// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/lower/vk_names.h"

#include <utility>

#include "runtime/hlsl/check/lower/lowerer.h"
#include "runtime/hlsl/ir/builtin_types.h"

namespace kaamos::hlsl {
namespace {

constexpr std::string_view kScopes[] = {"CrossDeviceScope", "DeviceScope",     "WorkgroupScope",
                                        "SubgroupScope",    "InvocationScope", "QueueFamilyScope"};

struct VkFunction {
  std::string_view name;
  size_t lowest;  // number of arguments
  size_t highest;
  std::string_view ignored;
};
constexpr VkFunction kFunctions[] = {
    {"ReadClock", 1, 1, "there is no clock, so it gives 0"},
    {"RawBufferLoad", 1, 2, "nothing is loaded, so it gives 0"},
    {"RawBufferStore", 2, 3, "nothing is stored"},
    {"ext_execution_mode", 1, SIZE_MAX, "there are no execution modes"},
    {"ext_execution_mode_id", 1, SIZE_MAX, "there are no execution modes"},
};

}  // namespace

bool VkNames::is_vk_name(const QualifiedName& name) {
  return name.parts.size() == 2 && name.parts[0].identifier == "vk";
}

std::optional<Value> VkNames::vk_constant(const QualifiedName& name) {
  if (!is_vk_name(name)) return std::nullopt;
  for (uint32_t i = 0; i < std::size(kScopes); ++i) {
    if (name.last().identifier == kScopes[i]) {
      return rvalue(build_.uint32(i), types_.scalar(Scalar::kUint32));
    }
  }
  return std::nullopt;
}

std::optional<Value> VkNames::call_vk(const QualifiedName& name, std::vector<Value>& arguments,
                                      SourceLocation location) {
  if (!is_vk_name(name)) return std::nullopt;
  const NamePart& part = name.last();
  const VkFunction* found = nullptr;
  for (const VkFunction& function : kFunctions) {
    if (function.name == part.identifier) found = &function;
  }
  if (!found) return std::nullopt;
  const std::string spelled = "vk::" + std::string(found->name);
  if (!lower_.intrinsics.check_count(spelled, arguments.size(), found->lowest, found->highest,
                                     location)) {
    return error_value();
  }
  const bool is_load = found->name == "RawBufferLoad";
  const bool is_raw = is_load || found->name == "RawBufferStore";
  const Scalar first = is_raw ? Scalar::kUint64 : Scalar::kUint32;
  if (!lower_.conversions.convert(arguments[0], types_.scalar(first), arguments[0].location))
    return error_value();
  const Type* type = types_.scalar(Scalar::kUint32);
  if (part.has_template_arguments) {
    if (!is_raw || part.template_arguments.size() != 1) {
      report(CheckId::kNotATemplate, location, {spelled});
      return error_value();
    }
    type = names_.type_argument(part.template_arguments[0], body_.scope);
    if (type->is_error()) return error_value();
    if (contains_resource(type) || type->is_void()) {
      report(CheckId::kElementType, location,
             {spelled, "a type without resources", to_string(type)});
      return error_value();
    }
    if (!is_load && !lower_.conversions.convert(arguments[1], type, arguments[1].location))
      return error_value();
  }
  report(CheckId::kVkIgnored, location, {spelled, std::string(found->ignored)});
  at(location);
  if (found->name == "ReadClock") type = types_.scalar(Scalar::kUint64);
  const bool gives = is_load || found->name == "ReadClock";
  return gives ? rvalue(build_.zero(type->ir), type) : rvalue(build_.int32(0), types_.void_type());
}

}  // namespace kaamos::hlsl

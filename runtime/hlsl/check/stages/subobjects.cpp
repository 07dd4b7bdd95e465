// SPDX-License-Identifier: MIT
#include "runtime/hlsl/check/stages/subobjects.h"

#include "runtime/hlsl/check/lower/lowerer.h"

namespace kaamos::hlsl {
namespace {

struct Form {
  std::string_view name;
  uint32_t type;  // D3D12_STATE_SUBOBJECT_TYPE
  // One letter per argument: s string, i integer; the fixed `value`, if any, comes after them.
  std::string_view arguments;
  int value;  // D3D12_HIT_GROUP_TYPE; -1: none
};

// In the order of SubobjectKind.
constexpr Form kForms[] = {
    {"StateObjectConfig", 0, "i", -1},
    {"GlobalRootSignature", 1, "s", -1},
    {"LocalRootSignature", 2, "s", -1},
    {"SubobjectToExportsAssociation", 8, "ss", -1},
    {"RaytracingShaderConfig", 9, "ii", -1},
    {"RaytracingPipelineConfig", 10, "i", -1},
    {"RaytracingPipelineConfig1", 12, "ii", -1},
    {"TriangleHitGroup", 11, "ss", 0},
    {"ProceduralPrimitiveHitGroup", 11, "sss", 1},
};

}  // namespace

void Subobjects::declare_subobject(const SubobjectDecl* decl) {
  if (program_.link) return;  // each library keeps its own
  const Form& form = kForms[static_cast<size_t>(decl->subobject_kind)];
  ir::Subobject subobject;
  subobject.name = decl->name;
  subobject.type = form.type;
  subobject.location = locate(decl->location);
  for (const ir::Subobject& other : bench_.module.subobjects) {
    if (other.name == subobject.name) {
      report(CheckId::kRedefinition, decl->location, {std::string(decl->name)});
      return;
    }
  }
  std::vector<const Expr*> arguments;
  for (const Expr* argument : decl->arguments) {
    if (const auto* list = as<InitListExpr>(argument)) {
      arguments.insert(arguments.end(), list->elements.begin(), list->elements.end());
    } else {
      arguments.push_back(argument);
    }
  }
  if (arguments.size() != form.arguments.size()) {
    report(CheckId::kSubobjectCount, decl->location,
           {std::string(form.name), std::to_string(form.arguments.size()),
            std::to_string(arguments.size())});
    return;
  }
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (form.arguments[i] == 's') {
      const auto* text = as<StringLiteralExpr>(arguments[i]);
      if (!text) {
        report(CheckId::kSubobjectString, arguments[i]->location,
               {std::to_string(i + 1), std::string(form.name)});
        return;
      }
      subobject.strings.emplace_back(text->value);
      continue;
    }
    const auto value =
        lower_.constant_integer(arguments[i], program_.global, "an argument of a subobject");
    if (!value) return;
    if (*value < 0 || *value > 0xFFFFFFFFll) {
      report(CheckId::kSubobjectRange, arguments[i]->location, {std::to_string(*value)});
      return;
    }
    subobject.values.push_back(static_cast<uint32_t>(*value));
  }
  if (form.value >= 0) {
    subobject.values.push_back(static_cast<uint32_t>(form.value));
    if (subobject.strings.size() == 2) subobject.strings.emplace_back();
  }
  if (decl->subobject_kind == SubobjectKind::kRaytracingShaderConfig && subobject.values[1] > 32) {
    report(CheckId::kSubobjectRange, arguments[1]->location, {std::to_string(subobject.values[1])});
  }
  if ((decl->subobject_kind == SubobjectKind::kRaytracingPipelineConfig ||
       decl->subobject_kind == SubobjectKind::kRaytracingPipelineConfig1) &&
      subobject.values[0] > 31) {
    report(CheckId::kSubobjectRange, arguments[0]->location, {std::to_string(subobject.values[0])});
  }
  bench_.module.subobjects.push_back(std::move(subobject));
}

}  // namespace kaamos::hlsl

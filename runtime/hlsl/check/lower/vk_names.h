// SPDX-License-Identifier: MIT
//
// Names of DXC's namespace vk, which it has for SPIR-V only. What has no meaning here is accepted
// with a warning that says what is ignored. [DXC: docs/SPIR-V.rst]
#pragma once

#include <optional>
#include <vector>

#include "runtime/hlsl/check/lower/lower_part.h"

namespace kaamos::hlsl {

class VkNames : LowerPart {
 public:
  using LowerPart::LowerPart;

  std::optional<Value> vk_constant(const QualifiedName& name);
  std::optional<Value> call_vk(const QualifiedName& name, std::vector<Value>& arguments,
                               SourceLocation location);

 private:
  static bool is_vk_name(const QualifiedName& name);
};

}  // namespace kaamos::hlsl

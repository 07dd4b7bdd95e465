// SPDX-License-Identifier: MIT
//
// The rules for payload structs and the qualifiers of their fields. [DXR: Payload access
// qualifiers, Syntax]
#pragma once

#include "runtime/hlsl/check/names/names_part.h"

namespace kaamos::hlsl {

class PayloadRules : NamesPart {
 public:
  using NamesPart::NamesPart;

  void check_payload_struct(StructInfo* info);
  void check_payload_use(const Type* type, SourceLocation location);

 private:
  static bool has_raypayload(const StructInfo& structure);
  void check_payload_field(FieldInfo& field);
};

}  // namespace kaamos::hlsl

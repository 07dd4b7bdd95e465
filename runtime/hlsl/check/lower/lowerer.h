// SPDX-License-Identifier: MIT
//
// From syntax trees of bodies and expressions to IR. The lowerer asks Names what names and types
// mean; names ask it for the values of constants. Its parts share one Body.
#pragma once

#include <optional>
#include <string_view>

#include "runtime/hlsl/check/lower/atomics.h"
#include "runtime/hlsl/check/lower/bit_fields.h"
#include "runtime/hlsl/check/lower/body.h"
#include "runtime/hlsl/check/lower/body_rules.h"
#include "runtime/hlsl/check/lower/calls.h"
#include "runtime/hlsl/check/lower/conversions.h"
#include "runtime/hlsl/check/lower/counters.h"
#include "runtime/hlsl/check/lower/coverage.h"
#include "runtime/hlsl/check/lower/debugging.h"
#include "runtime/hlsl/check/lower/elements.h"
#include "runtime/hlsl/check/lower/expressions.h"
#include "runtime/hlsl/check/lower/hit_objects.h"
#include "runtime/hlsl/check/lower/initialisers.h"
#include "runtime/hlsl/check/lower/intrinsics.h"
#include "runtime/hlsl/check/lower/locals.h"
#include "runtime/hlsl/check/lower/multisampled.h"
#include "runtime/hlsl/check/lower/operators.h"
#include "runtime/hlsl/check/lower/overloads.h"
#include "runtime/hlsl/check/lower/packed_numbers.h"
#include "runtime/hlsl/check/lower/pixel_intrinsics.h"
#include "runtime/hlsl/check/lower/places.h"
#include "runtime/hlsl/check/lower/printing.h"
#include "runtime/hlsl/check/lower/ray_intrinsics.h"
#include "runtime/hlsl/check/lower/ray_queries.h"
#include "runtime/hlsl/check/lower/resources.h"
#include "runtime/hlsl/check/lower/short_circuits.h"
#include "runtime/hlsl/check/lower/statements.h"
#include "runtime/hlsl/check/lower/streams.h"
#include "runtime/hlsl/check/lower/textures.h"
#include "runtime/hlsl/check/lower/triangle_positions.h"
#include "runtime/hlsl/check/lower/vk_names.h"
#include "runtime/hlsl/check/lower/waves.h"
#include "runtime/hlsl/check/names/evaluator.h"
#include "runtime/hlsl/check/names/names.h"
#include "runtime/hlsl/check/names/workbench.h"

namespace kaamos::hlsl {

class Lowerer final : public Evaluator {
 public:
  Lowerer(Names& of, Workbench& with) : names(of), bench(with), body(with.build) {}
  Lowerer(const Lowerer&) = delete;
  Lowerer& operator=(const Lowerer&) = delete;

  // -- Evaluator
  std::optional<int64_t> constant_integer(const Expr* expression, Scope* scope,
                                          std::string_view purpose,
                                          const Type** type = nullptr) override;
  Value value_of(const Expr* expression, Scope* scope) override;
  uint64_t component_count(const InitListExpr* list, Scope* scope) override;

  Names& names;
  Workbench& bench;
  Body body;

  BodyRules body_rules{*this};
  Places places{*this};
  Elements elements{*this};
  BitFields bit_fields{*this};
  Conversions conversions{*this};
  Expressions expressions{*this};
  Operators operators{*this};
  ShortCircuits short_circuits{*this};
  Calls calls{*this};
  Overloads overloads{*this};
  Intrinsics intrinsics{*this};
  Atomics atomics{*this};
  Waves waves{*this};
  PackedNumbers packed_numbers{*this};
  PixelIntrinsics pixel_intrinsics{*this};
  RayIntrinsics ray_intrinsics{*this};
  RayQueries ray_queries{*this};
  HitObjects hit_objects{*this};
  TrianglePositions triangle_positions{*this};
  Streams streams{*this};
  Debugging debugging{*this};
  Printing printing{*this};
  Coverage coverage{*this};
  Resources resources{*this};
  Textures textures{*this};
  Multisampled multisampled{*this};
  Counters counters{*this};
  VkNames vk_names{*this};
  Statements statements{*this};
  Locals locals{*this};
  Initialisers initialisers{*this};
};

}  // namespace kaamos::hlsl

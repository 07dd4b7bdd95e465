// SPDX-License-Identifier: MIT
//
// The facts that a front end learns about functions, globals and resources while it lowers them.
// finish/ makes a module of them. A front end derives its own structs, with what it knows besides.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// A place in the source: a number that only the front end understands.
using SourcePlace = uint32_t;

// An operation that only some stages allow.
struct StageUse {
  SourcePlace place = 0;
  std::string_view name;
  uint32_t stages = 0;             // ir::StageBits
  bool is_implicit_level = false;  // a warning in other stages, which sample level 0
  bool is_derivative = false;      // in compute shaders: needs quads, as implicit levels do
  bool is_lenient = false;         // works in other stages, too, where DXC refuses it
};

struct BindingFacts {
  std::string name;
  const ir::Type* resource = nullptr;
  bool is_array = false;
  uint64_t count = 1;  // kUnboundedCount: unbounded
  uint8_t register_class = 0;
  bool has_register = false;
  uint32_t register_index = 0;
  bool has_space = false;
  uint32_t space = 0;
  uint32_t automatic_space = 0;  // if it has neither a register nor a space
  uint32_t size_bytes = 0;
  bool is_ordered = false;  // a RasterizerOrdered view
  SourcePlace place = 0;
  uint32_t unit = 0;  // which of the libraries that are linked
  bool is_automatic = false;
  bool reachable = false;
  uint32_t index = 0;  // in Module::bindings, once known
  std::vector<ir::Expr*> uses;
};
inline constexpr uint64_t kUnboundedCount = 0xFFFFFFFFu;
// The letters of registers, by BindingFacts::register_class.
inline constexpr char kClassLetters[] = {'t', 'u', 'b', 's'};

struct FunctionFacts;

struct GlobalFacts {
  ir::Variable* variable = nullptr;
  ir::Block start_up;  // initialises it when a shader starts, if an expression cannot
  FunctionFacts* initialiser = nullptr;  // what the initialiser does; null if there is none
};

// About a function's own body, or an initialiser's.
struct FunctionFacts {
  ir::Function* ir = nullptr;
  std::vector<FunctionFacts*> callees;
  std::vector<BindingFacts*> bindings;
  std::vector<GlobalFacts*> globals;
  std::vector<StageUse> stage_uses;
  bool traces = false;
  bool queries = false;
  bool hit_objects = false;
  bool calls_shader = false;
  bool ends_shader = false;
  uint32_t reported_bytes = 0;  // size of the largest attributes that it passes to ReportHit
  uint32_t reported_type = 0;   // ir::EntryPoint::attribute_type
  bool has_barrier = false;
  std::vector<ir::Stmt*> waves;            // kWave
  std::vector<ir::Expr*> implicit_levels;  // kSample
  std::vector<ir::Expr*> quads;            // kQuad
  bool uses_view_heap = false;
  bool uses_sampler_heap = false;
  bool is_import = false;     // without a body
  uint32_t import_index = 0;  // in Module::imports
  uint32_t visit_mark = 0;
  uint32_t stages = 0;  // of the entry points that reach it
};

}  // namespace kaamos::hlsl

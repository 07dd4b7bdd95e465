// SPDX-License-Identifier: MIT
//
// The last step of a front end: what the call graph says about each function, and what goes into
// the module. What nothing reaches is left out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/hlsl/builder/facts.h"
#include "runtime/hlsl/builder/ir_builder.h"
#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

struct ModuleFacts {
  // An entry point that is generated around a function of the source.
  struct Wrapper {
    ir::Function* function;
    const FunctionFacts* wrapped;
    uint32_t stage;
  };
  struct Entry {
    FunctionFacts* function;
    size_t index;  // in Module::entry_points
  };
  std::vector<FunctionFacts*> functions;  // callees before callers
  std::vector<Entry> entries;
  std::vector<FunctionFacts*> library_functions;  // for Module::library_functions
  std::vector<Wrapper> wrappers;
  std::vector<GlobalFacts*> globals;           // in the order of declaration
  std::vector<BindingFacts*> bindings;         // in the order of declaration
  std::vector<BindingFacts*> globals_buffers;  // those of them that are a $Globals
  // The static global that says whether a pixel may still write; null if there are no pixel
  // shaders.
  ir::Variable* live = nullptr;
  // Static global, which pixel shaders have as `not live`: IsHelperLane(). Null if none reads it.
  ir::Variable* is_helper = nullptr;
  // Static global of pixel shaders: whether [WaveOpsIncludeHelperLanes]. Null if none has that.
  ir::Variable* waves_of_helpers = nullptr;
  bool names_ordered_views = false;
  bool square_quads = false;    // those of compute shaders [square_quads.h]
  bool reserve_unused = false;  // registers of bindings that nothing reads are not given to others
};

// Takes reports of what is wrong with a module as a whole. The front end has the words for them.
class FinishReport {
 public:
  virtual ~FinishReport() = default;
  virtual bool has_errors() const = 0;
  virtual ir::Location locate(SourcePlace place) = 0;
  // The entry point reaches what its stage does not allow.
  virtual void stage_use(const StageUse& use, const ir::EntryPoint& entry) = 0;
  // The entry point takes derivatives, and its thread groups are not made of quads.
  virtual void no_quads(const StageUse& use, const ir::EntryPoint& entry) = 0;
  // The entry point reaches these, in the order of their variables.
  virtual void reached(const std::vector<GlobalFacts*>& globals, const ir::EntryPoint& entry) = 0;
  virtual void no_register(const BindingFacts& binding) = 0;
  // Two bindings of one shader may not share a register.
  virtual void overlap(const BindingFacts& first, const BindingFacts& second,
                       const std::string& shared_register, const ir::EntryPoint& entry) = 0;
};

// The module has its entry points, library functions and imports; it gets everything else.
void finish_module(ir::Module& module, IrBuilder& build, ModuleFacts& facts, FinishReport& report);

// Indices in Module::imports of what the function reaches.
std::vector<uint32_t> imports_of(const ir::Module& module, const FunctionFacts& function);

// Entry points that reach imports go to a list of their own, behind those that run.
void set_aside_unlinked(ir::Module& module);

}  // namespace kaamos::hlsl

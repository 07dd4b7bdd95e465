// SPDX-License-Identifier: MIT
//
// Compute, ray generation, vertex and pixel shaders on a CPU: several threads of a group,
// invocations of a row, vertices or pixels of a triangle run at once, one in each lane of vector
// registers (kaamos/shader/wide.h). The plan finds out whether an entry point can run that way,
// which of its values differ among the threads that run together (varying) and which do not
// (uniform), and where threads diverge. TraceRay runs for one thread after another.
//
// Threads diverge at a varying condition. The code under it runs for some of them, under a mask,
// while the others wait. A region is what runs under one mask, except that threads which have
// returned may still be in it: those no longer read anything. A variable is uniform if only uniform
// values are assigned to it, and only in the region that declares it, because then all its readers
// are present when it changes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Facts about a statement in one WideFunction.
struct WideFacts {
  // kIf, kSwitch: threads diverge. kLoop: threads leave it one by one. kBreak, kContinue, kReturn:
  // only the threads of a mask jump.
  bool masked = false;
  bool masked_continue = false;  // kLoop: threads begin its step one by one
  bool narrows = false;          // threads that were active before it may be gone after it
  bool blends = false;           // inactive threads may read what it writes
};

// A function for one choice of varying parameters.
struct WideFunction {
  const ir::Function* function = nullptr;
  bool has_all_threads = false;  // wherever it is called: no thread has left or waits elsewhere
  std::vector<bool> varying_parameters;
  std::unordered_set<const ir::Variable*> varying;  // locals and parameters
  std::unordered_set<const ir::Variable*> written;  // after their declaration
  std::unordered_map<const ir::Stmt*, WideFacts> facts;
  std::unordered_map<const ir::Stmt*, const WideFunction*> callees;  // for kCall
  bool varying_result = false;
  bool masked_return = false;  // threads return one by one

  // Returns whether the parameter can be read from the caller's copy: it takes many registers, and
  // nothing changes it while the function runs.
  bool only_reads(const ir::Variable* parameter) const;

  bool is_varying(const ir::Variable* variable) const;
  bool is_varying(const ir::Expr* expr) const;
};

// The functions of all entry points in a module that run wide.
class WidePlan {
 public:
  // The entry point's function, or null with the reason why it cannot run wide.
  const WideFunction* add(const ir::EntryPoint& entry, std::string& reason);
  // For a function's callee; null with the reason.
  const WideFunction* add(const ir::Function& function, const std::vector<bool>& varying_parameters,
                          std::string& reason, bool has_all_threads = false);

 private:
  std::map<std::tuple<const ir::Function*, bool, std::vector<bool>>, std::unique_ptr<WideFunction>>
      functions_;
};

// Returns whether it is a struct, or an array of structs, that holds a resource: lanes cannot each
// have their own.
bool holds_resource(const ir::Type* type);

}  // namespace kaamos::hlsl

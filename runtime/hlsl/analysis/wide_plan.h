// SPDX-License-Identifier: MIT
//
// Compute and ray generation shaders on a CPU: several threads of a group, or invocations of a row,
// at once, one in each lane of vector registers (kaamos/shader/wide.h). This finds out whether an
// entry point can run so, which of its values differ among the threads that run together (varying)
// and which do not (uniform), and where the threads part. TraceRay runs for one after the other.
//
// Threads part at a condition that is varying. What stands under it runs for some of them, under a
// mask; the others wait. A region is what runs under one mask, but for threads that have returned:
// those read nothing any more. A variable is uniform if only uniform values are assigned to it, and
// only in the region that declares it: its readers are then all there when it changes.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "runtime/hlsl/ir/ir.h"

namespace kaamos::hlsl {

// Of a statement, in one WideFunction.
struct WideFacts {
  // kIf, kSwitch: threads part. kLoop: they leave it one by one. kBreak, kContinue, kReturn: only
  // the threads of a mask go.
  bool masked = false;
  bool masked_continue = false;  // kLoop: threads begin its step one by one
  bool narrows = false;          // threads may be gone after it that were there before
  bool blends = false;           // what it writes is read by threads that are not there
};

// A function for one choice of which of its parameters are varying.
struct WideFunction {
  const ir::Function* function = nullptr;
  std::vector<bool> varying_parameters;
  std::unordered_set<const ir::Variable*> varying;  // locals and parameters
  std::unordered_set<const ir::Variable*> written;  // after their declaration
  std::unordered_map<const ir::Stmt*, WideFacts> facts;
  std::unordered_map<const ir::Stmt*, const WideFunction*> callees;  // of kCall
  bool varying_result = false;
  bool masked_return = false;  // threads return one by one

  // A parameter that can be read where the caller has it: many registers wide, and nothing changes
  // it while the function runs.
  bool only_reads(const ir::Variable* parameter) const;

  bool is_varying(const ir::Variable* variable) const;
  bool is_varying(const ir::Expr* expr) const;
};

// The functions of all entry points of a module that run wide.
class WidePlan {
 public:
  // The entry point's function, or null with the reason why it cannot run so.
  const WideFunction* add(const ir::EntryPoint& entry, std::string& reason);
  // For a function's callee; null with the reason.
  const WideFunction* add(const ir::Function& function, const std::vector<bool>& varying_parameters,
                          std::string& reason);

 private:
  std::map<std::pair<const ir::Function*, std::vector<bool>>, std::unique_ptr<WideFunction>>
      functions_;
};

// A struct, or array of them, that holds a resource: no lane can have its own.
bool holds_resource(const ir::Type* type);

}  // namespace kaamos::hlsl
